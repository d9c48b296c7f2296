"""`database.further`: shots of another shape or beyond a range cost runs there, and no other."""

import h5py
import numpy as np
import pytest
from tiny_study import NEW_ROW, STUDY_YAML, write_study

from input_errors import InputError
from measurements import check_against_study, read_measurements
from study import at_revision, design_settings, further_design_settings, read_study, train_settings

AFTERWARDS = {"merge", "train", "sample", "compare", "report"}
OWN = "reduced_head_5mm_by_12mm"  # with measures that the paper has not
SHAPE = f"    - {{ shapes: [{OWN}], runs: 4 }}\n"
VELOCITY = "    - { velocity_m_s: [210, 240], runs: 4 }\n"


def with_parts(*parts: str) -> str:
    return STUDY_YAML.replace("  chunks: 2\n", f"  chunks: 2\n  further:\n{''.join(parts)}")


@pytest.mark.parametrize(
    "part, row",
    [
        (SHAPE, NEW_ROW.replace("uniform_cylinder", OWN)),
        (VELOCITY, NEW_ROW.replace(",130,", ",230,")),
    ],
    ids=["a new shape", "a velocity outside the range"],
)
def test_its_part_of_the_database_alone_is_computed(copied, part, row):
    (copied.study / "study.yaml").write_text(with_parts(part))
    with (copied.study / "measurements.csv").open("a") as file:
        file.write(row)
    planned = copied.planned_rules() - {"settings", "all"}
    assert planned == {"further_design", "further_runs"} | AFTERWARDS


def test_what_was_computed_stays_as_it_was(copied):
    before = {path: path.read_bytes() for path in (copied.results / "chunks").glob("*.h5")}
    with h5py.File(copied.results / "database.h5") as file:
        runs, outputs = file["run_id"][:], file["outputs"][:]
    (copied.study / "study.yaml").write_text(with_parts(SHAPE, VELOCITY))
    done = copied.run("--show-failed-logs", "results/tiny/comparison.json")
    assert done.returncode == 0, done.stdout
    assert before == {path: path.read_bytes() for path in (copied.results / "chunks").glob("*.h5")}
    with h5py.File(copied.results / "database.h5") as file:
        known = np.isin(file["run_id"][:], runs)
        assert known.sum() == len(runs) == 24 and (~known).sum() == 8
        np.testing.assert_array_equal(file["outputs"][:][known], outputs)
        shapes = file["shape"].asstr()[:][~known]
        velocity = file["inputs"][:][
            ~known, list(file["inputs"].attrs["names"]).index("velocity_m_s")
        ]
    assert list(shapes) == [OWN] * 4 + ["uniform_cylinder"] * 4
    assert velocity[4:].min() >= 210 and velocity[4:].max() <= 240
    # One part more leaves the others as they are.
    (copied.study / "study.yaml").write_text(with_parts(SHAPE, VELOCITY, VELOCITY))
    told = copied.run("--dry-run").stdout
    assert "further_chunks/2.h5" in told and "output: results/tiny/further_chunks/1.h5" not in told


def test_a_shot_must_lie_within_one_part(tmp_path):
    table = write_study(tmp_path / "tiny", with_parts(SHAPE, VELOCITY)) / "measurements.csv"
    study = read_study(tmp_path / "tiny" / "study.yaml")
    whole = table.read_text()
    table.write_text(whole + NEW_ROW.replace(",130,", ",230,"))
    check_against_study(read_measurements(table), study, table)
    fast_head = NEW_ROW.replace(",130,", ",230,").replace("uniform_cylinder", OWN)
    table.write_text(whole + fast_head)
    with pytest.raises(InputError, match="Add runs"):
        check_against_study(read_measurements(table), study, table)


def test_parts_have_numbers_of_their_own_and_revisions_cover_all(tmp_path):
    study = read_study(write_study(tmp_path / "tiny", with_parts(SHAPE, VELOCITY)) / "study.yaml")
    first = [further_design_settings(study, part)["first_run"] for part in (0, 1)]
    assert first == [50_000_000, 51_000_000]
    assert train_settings(study)["category"] == "shape"
    effect = {"name": "anvil_friction", "lowest": 0, "highest": 1}
    of_effect = design_settings(at_revision(study, [effect]))
    assert of_effect["shapes"] == ["uniform_cylinder", OWN]
    assert of_effect["ranges"]["velocity_m_s"] == [100, 240]
    assert design_settings(study)["ranges"]["velocity_m_s"] == [100, 210]


def test_beside_better_runs_a_part_may_be_denser_but_not_wider(tmp_path):
    dense = "    - { runs: 8, spacing: square_root }\n"
    better = "  better: { geometry: axisymmetric, fidelity: standard, runs: 8 }\n  further:\n"

    def read(part):
        text = with_parts(part).replace("  further:\n", better)
        return read_study(write_study(tmp_path / "tiny", text) / "study.yaml")

    study = read(dense)
    assert further_design_settings(study, 0)["spacing"] == "square_root"
    assert "spacing" not in design_settings(study)
    for wider in (SHAPE, VELOCITY):
        with pytest.raises(InputError, match="database.further has no runs of the better solver"):
            read(wider)


@pytest.mark.parametrize(
    "part, problem",
    [
        ("    - { velocity_m_s: [240, 210], runs: 4 }\n", "expected the lowest value first"),
        ("    - { velocity_ms: [210, 240], runs: 4 }\n", "velocity_m_s"),
        ("    - { shapes: [cube], runs: 4 }\n", "shapes"),
        ("    - { shapes: [truncated_cone] }\n", "runs"),
    ],
)
def test_a_wrong_part_is_told_with_its_place(tmp_path, part, problem):
    with pytest.raises(InputError, match=problem) as told:
        read_study(write_study(tmp_path / "tiny", with_parts(part)) / "study.yaml")
    assert "study.yaml, line 16: database.further.0" in str(told.value)
