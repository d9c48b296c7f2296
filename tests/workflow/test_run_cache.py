"""Finished runs that studies share: a second study computes only what the first has not."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from stage_commands import QUICK_RUNS
from tiny_study import STUDY_YAML, copy_workspace, make_workspace, write_study

from json_file import write_json
from make_design import design, write_design

RUNS = 12


def columns(first: int, seed: int = 1) -> dict:
    """Twelve runs of a long design, from row `first`, numbered anew."""
    ranges = {"velocity_m_s": [40, 90], "initial_diameter_mm": [6, 6.5]}
    ranges |= {"length_to_diameter": [1, 1.2], "initial_temperature_K": [300, 300]}
    settings = {"seed": seed, "shapes": ["uniform_cylinder"], "runs": 3 * RUNS}
    whole = design({**settings, "parameters": {}, "ranges": ranges})
    rows = slice(first, first + RUNS)
    part = {name: whole[name][rows] for name in ("seed", "shape", "inputs")}
    return {"run_id": np.arange(RUNS), "names": whole["names"], **part}


@pytest.fixture
def batch(program, tmp_path):
    """Runs twelve rows from `first`; gives the database's bytes and what the solver said."""
    write_json(tmp_path / "solver.json", QUICK_RUNS)

    def run(first: int, cache: str, seed: int = 1, solver: str = program("solver")):
        write_design(tmp_path / "design.h5", columns(first, seed))
        out = tmp_path / "database.h5"
        command = [solver, "batch", tmp_path / "design.h5", "--out", out]
        command += ["--config", tmp_path / "solver.json", "--threads", "2"]
        command += ["--cache", tmp_path / cache] if cache else []
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return out.read_bytes(), done.stderr

    return run


def test_an_overlapping_design_reruns_only_the_difference(batch):
    first, said = batch(0, "cache")
    assert "in the cache" not in said
    alone, _ = batch(4, "")
    shared, said = batch(4, "cache")
    assert "8 of 12 runs are in the cache" in said and "4/4 (100 %)" in said
    assert shared == alone
    again, said = batch(0, "cache")
    assert "12 of 12 runs are in the cache" in said
    assert again == first
    assert "in the cache" not in batch(0, "cache", seed=2)[1]


@pytest.fixture
def other_solver(program, tmp_path):
    """The solver as if built of other sources: the digest of its code is another."""
    solver = Path(program("solver"))
    told = subprocess.run([solver, "--version"], capture_output=True, text=True).stdout
    code = told.split()[-1].encode()
    content = solver.read_bytes()
    assert content.count(code) == 1
    other = tmp_path / "other_solver"
    other.write_bytes(content.replace(code, b"0123456789abcdef"))
    other.chmod(0o755)
    told = subprocess.run([other, "--version"], capture_output=True, text=True).stdout
    assert told.split()[-1] == "0123456789abcdef"
    return str(other)


def test_a_solver_of_other_sources_shares_no_run(batch, other_solver, tmp_path):
    """Though its runs are the same here: nobody could know."""
    first, said = batch(0, "cache")
    assert "in the cache" not in said
    again, said = batch(0, "cache", solver=other_solver)
    assert "in the cache" not in said and f"{RUNS}/{RUNS} (100 %)" in said
    assert len(list((tmp_path / "cache").rglob("*.json"))) == 2 * RUNS
    for solver in ({}, {"solver": other_solver}):  # each finds its own again
        assert f"{RUNS} of {RUNS} runs are in the cache" in batch(0, "cache", **solver)[1]
    # What the other one kept alone the first does not find.
    batch(RUNS, "cache", solver=other_solver)
    assert "in the cache" not in batch(RUNS, "cache")[1]


def test_another_simd_variant_does_not_share_runs(batch, monkeypatch):
    monkeypatch.setenv("TAYLORCAL_SIMD", "v2")
    first, _ = batch(0, "cache")
    assert batch(0, "cache")[0] == first
    monkeypatch.delenv("TAYLORCAL_SIMD")
    alone, _ = batch(0, "")
    assert batch(0, "cache")[0] == alone


def test_two_users_fill_one_cache_at_once(program, tmp_path):
    write_json(tmp_path / "solver.json", QUICK_RUNS)
    write_design(tmp_path / "design.h5", columns(0))
    environment = {**os.environ, "TAYLORCAL_RUN_CACHE": str(tmp_path / "cache")}
    command = [program("solver"), "batch", tmp_path / "design.h5", "--threads", "2"]
    command += ["--config", tmp_path / "solver.json", "--out"]
    users = [
        subprocess.Popen([*command, tmp_path / out], env=environment, stderr=subprocess.DEVNULL)
        for out in ("a.h5", "b.h5")
    ]
    assert [user.wait() for user in users] == [0, 0]
    assert (tmp_path / "a.h5").read_bytes() == (tmp_path / "b.h5").read_bytes()
    entries = [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    assert len(entries) == RUNS and all(path.suffix == ".json" for path in entries)


def test_a_cache_that_cannot_be_written_costs_no_run(batch, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(AssertionError, match="no folder for the cache of runs"):
        batch(0, "file")


def test_a_study_uses_the_cache_of_its_configuration(finished, program, build, tmp_path):
    """Fewer chunks of the same design: the runs are those of the study before."""
    copied = copy_workspace(finished, tmp_path / "copy")
    config = tmp_path / "config.json"
    write_json(config, {"run_cache": str(tmp_path / "cache")})
    target = "results/tiny/chunks/0.h5"
    assert copied.run("--force", target, "--configfile", str(config)).returncode == 0
    other = make_workspace(tmp_path / "other", build)
    write_study(other.study, STUDY_YAML.replace("chunks: 2", "chunks: 4"))
    done = other.run(target, "--configfile", str(config))
    assert done.returncode == 0, done.stdout
    assert "6 of 6 runs are in the cache" in (other.results / "logs" / "runs_0.log").read_text()
