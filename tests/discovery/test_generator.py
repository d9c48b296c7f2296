"""The blind tables: reproducible, silent about what they hide, with the noise they state."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from candidate_lists import kept_rows
from corruption import corrupted, swapped_digits
from hidden_signal import NOISE, VELOCITY_NOISE
from hide import SIGMAS
from make_tables import Generator, write_table
from measurements import read_measurements
from plan import ALL, NULLS_A_SET, SEED, SETS, SIX_SIGMA, list_names, plan
from specimens import shot_set
from toy_study import CANDIDATES, EFFECTS

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def made(toy):
    """(table, rows, truth) of every table."""
    return [(table, *toy.generator.make(table)) for table in toy.generator.tables()]


def of_kind(made, kind):
    return [item for item in made if item[0].kind == kind]


def test_the_same_seed_gives_the_same_tables(toy, made, tmp_path):
    again = Generator(toy.study, toy.runs, toy.signatures)
    for place, (table, rows, truth) in enumerate(made[::40]):
        rows_again, truth_again = again.make(table)
        write_table(tmp_path / "a" / f"{place}.csv", rows)
        write_table(tmp_path / "b" / f"{place}.csv", rows_again)
        first = (tmp_path / "a" / f"{place}.csv").read_bytes()
        assert first == (tmp_path / "b" / f"{place}.csv").read_bytes()
        assert truth == truth_again


def test_tables_of_a_variant_differ_in_noise(made):
    texts = {json.dumps(rows) for _, rows, _ in made}
    assert len(texts) == len(made)


def test_there_are_enough_tables_of_each_kind(made):
    kinds = [table.kind for table, _, _ in made]
    assert kinds.count("null") >= 100
    for effect in EFFECTS:
        assert sum(list(truth["effects"]) == [effect] for _, _, truth in made) >= 3
    for kind in ("two effects", "outside", "twins", "bad shot", "bias", "understated errors"):
        assert kinds.count(kind) >= 3


def test_no_table_tells_what_it_hides(toy, made, tmp_path):
    names = [item["name"] for item in CANDIDATES]
    words = [*names, "outside", "johnson", "linear_hardening", SIX_SIGMA, "null", "bias"]
    for table, rows, _ in made:
        text = json.dumps(rows) + table.id
        assert not [word for word in words if word in text]


def test_the_order_of_the_tables_tells_nothing(made):
    kinds = np.array([table.kind == "null" for table, _, _ in made])
    # A run of one kind as long as this has a chance below 1e-6 in a shuffled list.
    longest = max(len(part) for part in "".join("x" if k else " " for k in kinds).split())
    assert longest < 25


def test_names_of_candidate_lists_tell_nothing(toy):
    names = list_names(toy.generator.tables())
    assert ALL in names
    assert not any(effect in name for name in names.values() for effect in EFFECTS)


def test_the_noise_has_the_stated_spread(made):
    """Over all tables without anything hidden: measured / true - 1, size by size."""
    nulls = of_kind(made, "null")
    shown = {size: [] for size in [*NOISE, "velocity_m_s"]}
    true: dict = {}
    for table, rows, _ in nulls:
        shots = shot_set(table.variant.shot_set, SEED)
        for index, row in enumerate(rows):
            speed = float(row["velocity_m_s"]) / shots.velocities[index] - 1
            shown["velocity_m_s"].append(speed / VELOCITY_NOISE)
            for size in NOISE:
                true.setdefault((table.variant, index, size), []).append(float(row[size]))
    for (_, _, size), values in true.items():
        shown[size].extend((np.array(values) / np.mean(values) - 1) / NOISE[size])
    repeats = NULLS_A_SET  # tables of a set, whose mean stands for the true value
    for size, values in shown.items():
        spread = np.std(values) * (
            1 if size == "velocity_m_s" else (repeats / (repeats - 1)) ** 0.5
        )
        assert spread == pytest.approx(1, abs=0.06), size


def test_the_table_states_its_errors(made):
    for _, rows, _ in made[:5]:
        for row in rows:
            for size, relative in NOISE.items():
                assert float(row[f"{size}_sd"]) == pytest.approx(relative * float(row[size]), 1e-2)


def test_tables_are_read_by_the_product(made, tmp_path):
    for table, rows, _ in made[::25]:
        write_table(tmp_path / table.id / "measurements.csv", rows)
        read = read_measurements(tmp_path / table.id / "measurements.csv")
        assert len(read) == len(rows)
        assert {row["use"] for row in read} == {"calibrate", "validate"}


def test_amplitudes_reach_the_signal_asked_for(made):
    """In a study whose effects are linear the runs' signal is what was aimed at."""
    for _, _, truth in of_kind(made, "effect"):
        if truth["strength"] == SIX_SIGMA:
            assert truth["signal_sd"] == pytest.approx(SIGMAS[SIX_SIGMA], rel=0.05)


def test_a_plain_table_hides_nothing(made):
    for _, _, truth in of_kind(made, "null"):
        assert truth["effects"] == {} and truth["signal_sd"] == 0 and truth["corrupted"] is None


def test_truths_lie_inside_the_ranges_and_differ(toy):
    sets = [shot_set(index, SEED) for index in range(SETS)]
    densities = [shots.parameters["rho_immobile_initial"] for shots in sets]
    assert len(set(densities)) == len(sets)
    for shots in sets:
        for name, value in shots.parameters.items():
            lowest, highest = toy.network.ranges[name]
            assert lowest < value < highest


def test_swapped_digits_change_a_number_noticeably():
    assert swapped_digits("37.5200") == "35.7200"
    assert swapped_digits("4.4444") is None


def test_one_number_of_one_fitted_shot_is_wrong(made):
    for _, rows, truth in of_kind(made, "bad shot"):
        told = truth["corrupted"]
        row = next(row for row in rows if row["id"] == told["id"])
        assert row["use"] == "calibrate"
        assert row[told["size"]] == told["wrong"] != told["right"]


def test_corruption_changes_one_cell_alone():
    rows = [{"use": "calibrate", "id": "a", **{size: "20.1234" for size in NOISE}}] * 3
    changed, _ = corrupted(rows, np.random.default_rng(5))
    cells = [(i, key) for i, row in enumerate(rows) for key in row if changed[i][key] != row[key]]
    assert len(cells) == 1


def test_a_list_without_an_effect_has_none_of_its_runs():
    inputs = np.array([[1.0, 0.0, 0.0], [1.0, 0.5, 0.0], [1.0, 0.0, 0.5]])
    rows = kept_rows(inputs, ["velocity_m_s", "a", "b"], [{"name": "b", "base": 0.0}])
    assert rows.tolist() == [True, True, False]


def test_the_plan_is_the_same_every_time():
    assert plan(EFFECTS, ["phonon_drag"]) == plan(EFFECTS, ["phonon_drag"])


def test_the_commands_write_tables_lists_and_sealed_truths(toy, tmp_path):
    """As the workflow calls them."""
    environment = {"PYTHONPATH": str(HERE.parents[1] / "workflow" / "scripts")}
    tables, sealed, lists = (tmp_path / name for name in ("tables", "sealed", "lists"))
    folders = ["--runs", toy.runs, "--signatures", toy.signatures, "--tables", tables]
    ids = [table.id for table in toy.generator.tables()][:20]
    commands = [["make_tables.py", *folders, "--sealed", sealed, *ids]]
    pairs = ["--signatures", toy.study / "signatures.h5"]
    pairs += ["--finer", toy.study / "signatures_finer.h5"]
    names = list_names(toy.generator.tables())
    for name in names.values():
        commands.append(["candidate_lists.py", *pairs, "--list", name, "--out", lists / name])
    for script, *options in commands:
        command = [sys.executable, HERE / script, "--study", toy.study, *options]
        subprocess.run(command, check=True, env=environment)
    assert [path.parent.name for path in sorted(tables.glob("*/measurements.csv"))] == ids
    assert [path.stem for path in sorted(sealed.glob("*.json"))] == ids
    texts = [path.read_text() for path in tables.rglob("*") if path.is_file()]
    assert not any(effect in text for text in texts for effect in EFFECTS)
    for which, name in names.items():
        effect = which.removeprefix("without ")
        if effect in EFFECTS:
            assert f'"{effect}"' not in (lists / name / "candidates.json").read_text()
            assert effect.encode() not in (lists / name / "signatures.h5").read_bytes()
