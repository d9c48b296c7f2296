"""Runs of a better solver correct a network that cheaper ones have taught."""

import json

import h5py
import pytest
from tiny_study import STUDY_YAML

from input_errors import InputError
from study import FIRST_BETTER_RUN, better_design_settings, has_finer, read_study

BETTER = "  runs: 24\n  better: { geometry: axisymmetric, fidelity: standard, runs: 8 }\n"
CHEAPER = {"design", "runs", "merge"}


def test_the_network_answers_as_the_better_solver_and_keeps_the_cheaper_runs(copied):
    study = copied.study / "study.yaml"
    study.write_text(study.read_text().replace("  runs: 24\n", BETTER))
    planned = copied.planned_rules()
    assert {"better_design", "better_runs", "better", "train", "sample"} <= planned
    assert not planned & CHEAPER
    done = copied.run(f"results/{copied.study.name}/emulator.json", "--show-failed-logs")
    assert done.returncode == 0, done.stdout
    with h5py.File(copied.results / "better.h5") as file:
        assert json.loads(file.attrs["configuration"])["fidelity"] == "standard"
        assert list(file["run_id"][:]) == [FIRST_BETTER_RUN + n for n in range(8)]
        stopped = int((file["status"][:] == 0).sum())
    emulator = json.loads((copied.results / "emulator.json").read_text())
    assert emulator["corrects_cheaper_runs"]
    told = emulator["validation"]
    assert told["cheaper_rows"] == 24
    assert told["training_rows"] + told["rows"] == 24 + stopped
    assert told["rows"] <= 2  # a share of the better ones alone


def test_a_better_solver_is_another_one(tmp_path):
    path = tmp_path / "study.yaml"
    path.write_text(STUDY_YAML.replace("  runs: 24\n", BETTER.replace("standard", "coarse")))
    with pytest.raises(InputError, match="line 14: database.better is the solver of the other"):
        read_study(path)


def test_runs_of_the_better_solver_cover_the_same_ranges(tmp_path):
    path = tmp_path / "study.yaml"
    path.write_text(STUDY_YAML.replace("  runs: 24\n", BETTER))
    study = read_study(path)
    settings = better_design_settings(study)
    assert settings["runs"] == 8 and settings["first_run"] == FIRST_BETTER_RUN
    assert settings["ranges"]["velocity_m_s"] == [100, 210]
    assert not has_finer(study)
