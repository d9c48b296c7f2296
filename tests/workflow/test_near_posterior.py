"""A second round of runs where a first posterior lies, from which the network learns too."""

import json

import h5py
import numpy as np
import pytest
from tiny_study import STUDY_YAML, TABLE, write_study

from cost.model import study_cost
from input_errors import InputError
from make_near_design import WIDER, near_design
from measurements import read_measurements
from study import FIRST_BETTER_RUN, FIRST_NEAR_RUN, near_design_settings, read_study

NEAR = "  near_posterior: { runs: 8 }\n"
BETTER = "  better: { geometry: axisymmetric, fidelity: standard, runs: 8 }\n"
ROUND = {"first_train", "first_sample", "near_design", "near_runs", "with_near"}
BROAD = {"design", "runs", "merge"}


def with_keys(*keys: str) -> str:
    return STUDY_YAML.replace("  chunks: 2\n", f"  chunks: 2\n{''.join(keys)}")


def run_ids(path) -> list[int]:
    with h5py.File(path) as file:
        return list(file["run_id"][:])


def test_the_network_learns_from_them_too(copied):
    (copied.study / "study.yaml").write_text(with_keys(NEAR))
    planned = copied.planned_rules()
    assert ROUND | {"train", "sample"} <= planned and not planned & BROAD
    done = copied.run("results/tiny/emulator.json", "--show-failed-logs")
    assert done.returncode == 0, done.stdout
    near = [FIRST_NEAR_RUN + n for n in range(8)]
    assert run_ids(copied.results / "with_near.h5") == list(range(24)) + near
    told = json.loads((copied.results / "emulator.json").read_text())["validation"]
    first = json.loads((copied.results / "first_emulator.json").read_text())["validation"]
    assert first["training_rows"] + first["rows"] == 24
    assert told["training_rows"] + told["rows"] == 32
    # A revision takes them from the base.
    (copied.study / "study.yaml").write_text(with_keys(NEAR) + "effects: [anvil_friction]\n")
    planned = copied.planned_rules()
    assert BROAD <= planned and not planned & (ROUND - {"with_near"})


def test_they_are_of_the_better_solver_where_there_is_one(copied):
    (copied.study / "study.yaml").write_text(with_keys(BETTER, NEAR))
    done = copied.run("results/tiny/emulator.json", "--show-failed-logs")
    assert done.returncode == 0, done.stdout
    both = [FIRST_BETTER_RUN + n for n in range(8)] + [FIRST_NEAR_RUN + n for n in range(8)]
    with h5py.File(copied.results / "with_near.h5") as file:
        assert list(file["run_id"][:]) == both
        assert json.loads(file.attrs["configuration"])["fidelity"] == "standard"
    told = json.loads((copied.results / "emulator.json").read_text())["validation"]
    assert told["cheaper_rows"] == 24 and told["training_rows"] + told["rows"] == 40


@pytest.fixture
def asked(tmp_path):
    folder = write_study(tmp_path / "tiny", with_keys(NEAR.replace("8", "300")))
    study = read_study(folder / "study.yaml")
    return read_measurements(folder / "measurements.csv"), near_design_settings(study)


def draws(width: float) -> dict[str, np.ndarray]:
    normal = np.random.default_rng(3).standard_normal((3, 4000))
    return {
        "rho_immobile_initial[first]": 1e13 * np.exp(width * normal[0]),
        "rho_immobile_initial[second]": 3e12 * np.exp(width * normal[1]),
        "hardening_coefficient": (1.6 + 0.5 * width * normal[2]) ** 2,
    }


def test_they_repeat_the_shots_twice_as_wide_as_the_posterior(asked):
    rows, settings = asked
    given = draws(0.1)
    columns = near_design(rows, given, settings)
    table = {name: columns["inputs"][:, n] for n, name in enumerate(columns["names"])}
    assert list(table["velocity_m_s"][:5]) == [161, 169, 200, 190, 161]
    assert table["length_to_diameter"][3] == pytest.approx(25.4 / 7.62)
    second = np.arange(300) % 4 == 3
    for lot, mine in (("first", ~second), ("second", second)):
        logs = np.log(table["rho_immobile_initial"][mine])
        own = np.log(given[f"rho_immobile_initial[{lot}]"])
        assert logs.mean() == pytest.approx(own.mean(), abs=0.06)
        assert logs.std() == pytest.approx(WIDER * own.std(), rel=0.15)
    # The network sees the root of what starts at zero or above.
    roots = np.sqrt(table["hardening_coefficient"])
    assert roots.std() == pytest.approx(WIDER * 0.05, rel=0.15)
    assert len(set(columns["seed"])) == 300


def test_they_stay_within_what_the_other_runs_cover(asked):
    rows, settings = asked
    columns = near_design(rows, draws(1.0), settings)
    hardening = columns["inputs"][:, columns["names"].index("hardening_coefficient")]
    assert hardening.min() == 1 and hardening.max() == 5


def test_they_and_both_trainings_are_counted_in_the_cost(tmp_path):
    costs = []
    for keys in ((), (NEAR,)):
        folder = write_study(tmp_path / str(len(keys)), with_keys(*keys), TABLE)
        costs.append(study_cost(read_study(folder / "study.yaml")))
    plain, near = costs
    assert len(near.runs_s) == len(plain.runs_s) + 8
    assert near.sample_s == 2 * plain.sample_s and sum(near.train_s) > 2 * sum(plain.train_s)


def test_too_few_are_told_with_their_place(tmp_path):
    folder = write_study(tmp_path / "tiny", with_keys(NEAR.replace("8", "7")))
    with pytest.raises(InputError, match="line 15: database.near_posterior.runs"):
        read_study(folder / "study.yaml")
