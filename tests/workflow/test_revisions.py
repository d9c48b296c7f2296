"""An effect added makes a revision of a finished study; the base is not computed again."""

import json
import os
import subprocess
from pathlib import Path

import h5py
import jsonschema
import numpy as np
import pytest
from stub_lists import effect
from tiny_study import NEW_ROW, ROOT, Workspace, copy_workspace

from study import load_study

# A constant of the material in the place of an effect: cheap, and with a visible answer.
EFFECT = "initial_yield_stress"
LISTED = effect(EFFECT, highest=1e8, prior={"kind": "half_normal", "scale": 3e7}, typical=2e7)
HOME = f"revisions/{EFFECT}"
DIAGNOSIS = "\ndiagnosis: { points_per_shape: 4, constants: [drag_slope] }\n"


def put_solver(workspace: Workspace, real: Path) -> None:
    """A solver that lists the effect; as old as a program that was never rebuilt."""
    folder = workspace.folder / "build" / "bin"
    (workspace.folder / "build").unlink()
    folder.mkdir(parents=True)
    for program in ("emulator", "calibrate"):
        (folder / program).symlink_to(real / program)
    listing = workspace.folder / "effects.json"
    listing.write_text(json.dumps({"effects": [LISTED]}))
    solver = folder / "solver"
    script = f'[ "$1" = effects ] && exec cat {listing}\nexec {real / "solver"} "$@"\n'
    solver.write_text(f"#!/bin/sh\n{script}")
    solver.chmod(0o755)
    os.utime(solver, (1, 1))


def taylorcal(workspace: Workspace, *words: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [ROOT / "workflow" / "taylorcal", *words],
        cwd=workspace.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def states(folder: Path) -> dict[str, tuple]:
    """Size and time of each file that the base has."""
    return {
        str(path.relative_to(folder)): (path.stat().st_size, path.stat().st_mtime_ns)
        for path in folder.rglob("*")
        if path.is_file() and "revisions" not in path.parts
    }


@pytest.fixture(scope="module")
def revised(finished, build, tmp_path_factory):
    """The finished study with the effect added and computed, and the base's files before."""
    workspace = copy_workspace(finished, tmp_path_factory.mktemp("revised") / "study")
    put_solver(workspace, build.resolve() / "bin")
    study = workspace.study / "study.yaml"
    study.write_text(study.read_text() + DIAGNOSIS)
    before = states(workspace.results)
    assert workspace.planned_rules() == set()
    told = taylorcal(workspace, "add-effect", "tiny", EFFECT)
    assert told.returncode == 0, told.stdout
    assert "6 runs of the solver" in told.stdout and HOME in told.stdout
    planned = workspace.run("--dry-run").stdout
    done = taylorcal(workspace, "calibrate", "tiny", "--cores", "2")
    assert done.returncode == 0, done.stdout
    return workspace, before, planned, done.stdout


@pytest.fixture
def again(revised, tmp_path):
    """A copy of the revised study that a test may change."""
    return copy_workspace(revised[0], tmp_path / "again")


def test_adding_an_effect_plans_nothing_of_the_base(revised):
    _, _, planned, _ = revised
    outputs = [line.split()[1] for line in planned.splitlines() if "    output:" in line]
    new = ("ladder.json", "confirmation")
    assert any(HOME in output for output in outputs)
    for output in outputs:
        assert HOME in output or output.rpartition("/")[2].startswith(new), output


def test_the_base_keeps_every_file(revised):
    workspace, before, _, _ = revised
    after = states(workspace.results)
    assert {name: after[name] for name in before} == before


def test_only_the_new_runs_are_computed_and_the_old_ones_join(revised):
    workspace, _, _, _ = revised
    home = workspace.results / HOME
    new = []
    for chunk in sorted((home / "chunks").glob("*.h5")):
        with h5py.File(chunk) as file:
            new += list(file["run_id"][:])
    assert new == list(range(24, 30))
    with h5py.File(workspace.results / "database.h5") as file:
        old_inputs, old_outputs = file["inputs"][:], file["outputs"][:]
    with h5py.File(home / "database.h5") as file:
        assert list(file["inputs"].attrs["names"])[-1] == EFFECT
        inputs, outputs = file["inputs"][:], file["outputs"][:]
    assert len(inputs) == 30
    assert (inputs[:24, :-1] == old_inputs).all() and (inputs[:24, -1] == 0).all()
    assert np.array_equal(outputs[:24], old_outputs, equal_nan=True)
    assert inputs[24:, -1].min() == 0 and inputs[24:, -1].max() == 1e8


def test_the_network_and_the_posterior_gain_the_amplitude(revised):
    workspace, _, _, _ = revised
    home = workspace.results / HOME
    emulator = json.loads((home / "emulator.json").read_text())
    old = json.loads((workspace.results / "emulator.json").read_text())
    assert [entry["name"] for entry in emulator["inputs"]][-1] == EFFECT
    assert emulator["outputs"] == old["outputs"]
    assert "from" in emulator["provenance"]
    width = len(old["members"][0]["layers"][0]["bias"])
    assert len(emulator["members"][0]["layers"][0]["bias"]) == width
    with h5py.File(home / "posterior.h5") as file:
        names = list(file["draws"].attrs["names"])
        amplitude = file["draws"][:, names.index(EFFECT)]
    assert amplitude.min() >= 0 and amplitude.max() <= 1e8
    assert np.mean(amplitude > 6e7) < 0.3  # half normal, not uniform


LADDER = {
    "type": "object",
    "required": ["schema", "revisions"],
    "properties": {
        "revisions": {
            "items": {
                "required": [
                    *("id", "effects", "misfit", "groups", "log_evidence", "log_evidence_sd"),
                    *("parameters", "new_runs", "shift_sd", "confirmed"),
                ],
                "properties": {
                    "misfit": {"required": ["calibrate", "validate"]},
                    "log_evidence": {"type": "number"},
                    "shift_sd": {"additionalProperties": {"type": "number"}},
                },
            },
        },
    },
}


def test_the_ladder_has_a_rung_for_each_revision(revised):
    workspace, _, _, told = revised
    ladder = json.loads((workspace.results / "ladder.json").read_text())
    jsonschema.validate(ladder, LADDER)
    base, rung = ladder["revisions"]
    assert [base["id"], rung["id"]] == ["base", EFFECT]
    assert [base["new_runs"], rung["new_runs"]] == [24, 6]
    assert set(rung["shift_sd"]) >= {"hardening_coefficient", "rho_immobile_initial[first]"}
    assert rung["parameters"][-1]["name"] != base["parameters"][-1]["name"] or len(
        rung["parameters"]
    ) > len(base["parameters"])
    assert "misfit in standard errors" in told and "ladder.json" in told


def test_the_solver_confirms_each_shot(revised):
    workspace, _, _, _ = revised
    for home in (workspace.results, workspace.results / HOME):
        found = json.loads((home / "confirmation.json").read_text())
        assert [shot["id"] for shot in found["shots"]] == ["a1", "a2", "a3", "b1"]
        assert found["misfit"]["calibrate"]["n"] == 6
        for shot in found["shots"]:
            for cell in shot["sizes"]:
                assert cell["solver"] == pytest.approx(cell["network"], rel=0.2)


def test_a_revised_study_is_finished(revised):
    assert revised[0].planned_rules() == set()


def test_dropping_the_effect_computes_nothing(again):
    told = taylorcal(again, "drop-effect", "tiny", EFFECT)
    assert told.returncode == 0, told.stdout
    assert again.planned_rules() == {"ladder", "all"}
    assert again.run().returncode == 0
    ladder = json.loads((again.results / "ladder.json").read_text())
    assert [rung["id"] for rung in ladder["revisions"]] == ["base"]
    # Back again: the revision's results are still there.
    assert taylorcal(again, "add-effect", "tiny", EFFECT).returncode == 0
    assert again.planned_rules() == {"ladder", "all"}


def test_a_new_row_reruns_no_run_of_the_database(again):
    with (again.study / "measurements.csv").open("a") as file:
        file.write(NEW_ROW)
    rules = again.planned_rules()
    assert {"sample", "compare", "confirmation_runs", "ladder"} <= rules
    assert not {"design", "runs", "merge", "train"} & rules


def test_commands_refuse_what_they_do_not_know(again):
    told = taylorcal(again, "add-effect", "tiny", "initial_yeld_stress")
    assert told.returncode == 1
    assert "study.yaml" in told.stdout and f"Did you mean {EFFECT!r}?" in told.stdout
    assert "Traceback" not in told.stdout
    told = taylorcal(again, "add-effect", "tiny", EFFECT)
    assert told.returncode == 1 and "already" in told.stdout
    told = taylorcal(again, "drop-effect", "tiny", "rust")
    assert told.returncode == 1 and f"'rust' is not among the effects ({EFFECT})" in told.stdout
    told = taylorcal(again, "diagnose", "teeny")
    assert told.returncode == 1 and "there is no such study" in told.stdout


def test_an_unknown_effect_stops_before_anything_runs(again):
    path = again.study / "study.yaml"
    path.write_text(path.read_text().replace(f"effects: [{EFFECT}]", "effects: [frost]"))
    done = again.run("--dry-run")
    assert done.returncode != 0
    assert "line 8: effects has 'frost', which is not an effect" in done.stdout
    assert "Traceback" not in done.stdout


def test_signatures_are_pairs_at_two_fidelities(again):
    base = "results/tiny"
    done = again.run(f"{base}/signatures.h5", f"{base}/signatures_finer.h5")
    assert done.returncode == 0, done.stdout
    candidates = json.loads((again.results / "candidates.json").read_text())["candidates"]
    assert [entry["name"] for entry in candidates] == [EFFECT, "drag_slope"]
    with h5py.File(again.results / "signatures.h5") as file:
        inputs, sizes = file["inputs"][:], file["outputs"][:, 0]
        assert list(file["inputs"].attrs["names"])[-2:] == [EFFECT, "drag_slope"]
        assert len(inputs) == 12 and (file["status"][:] == 0).all()
    with h5py.File(again.results / "signatures_finer.h5") as file:
        assert list(file["run_id"][:]) == [0, 3, 6, 9]
        assert json.loads(file.attrs["configuration"])["fidelity"] == "standard"
        finer = file["outputs"][:, 0]
    assert (inputs[::3, -1] == 2.5e-8).all()
    assert (sizes[1::3] > sizes[::3]).all(), "a stronger metal stays longer"
    assert finer == pytest.approx(sizes[::3], rel=0.02)
    planned = again.run("--dry-run", f"{base}/signatures.h5", f"{base}/signatures_finer.h5")
    assert "Nothing to be done" in planned.stdout


def test_a_diagnosis_asks_for_everything_it_needs(again):
    done = taylorcal(again, "diagnose", "tiny", "--dry-run")
    assert done.returncode == 0, done.stdout
    for rule in ("signature_design", "signature_runs", "signatures_finer", "next_experiment"):
        assert rule in done.stdout
    assert "train" not in done.stdout.split()
    assert load_study("tiny", again.folder / "experiments")["effects"] == [EFFECT]
