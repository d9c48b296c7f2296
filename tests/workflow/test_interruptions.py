"""A workflow that is killed, meets a full disk or damaged files, or is started twice.

The heaviest, 300 runs whose workflow is killed 20 times, is in test_many_kills.py.
"""

import os
import random
import signal
import subprocess
import sys
import time

import pytest
from stage_commands import QUICK_RUNS, ended, stages
from tiny_study import STUDY, Workspace
from workflow_kills import TARGET, kill, results_of, start

WAIT_S = 120
TAYLORCAL = [sys.executable, "workflow/taylorcal"]


def run_killing(workspace: Workspace, kills: int) -> int:
    """Runs the study, killing it again and again; returns how often it was killed."""
    source, done = random.Random(STUDY), 0
    for _ in range(kills):
        process = start(workspace, TARGET)
        try:
            process.communicate(timeout=source.uniform(2, 8))
            return done
        except subprocess.TimeoutExpired:
            kill(process)
            done += 1
            assert workspace.run("--unlock").returncode == 0
    return done


def test_a_workflow_killed_at_random_moments_gives_the_same_results(finished, fresh):
    assert run_killing(fresh, 3) >= 2
    done = fresh.run("--rerun-incomplete", "--show-failed-logs", TARGET)
    assert done.returncode == 0, done.stdout
    assert results_of(fresh) == results_of(finished)


def wait_for(condition, what: str) -> None:
    deadline = time.monotonic() + WAIT_S
    while not condition():
        assert time.monotonic() < deadline, f"waited {WAIT_S} s for {what}"
        time.sleep(0.05)


def test_a_second_workflow_on_the_study_is_refused_until_the_first_ends(fresh):
    def taylorcal(*arguments):
        command = [*TAYLORCAL, *arguments]
        return subprocess.run(command, cwd=fresh.folder, capture_output=True, text=True)

    first = start(fresh, TARGET)
    locks = fresh.folder / ".snakemake" / "locks"
    wait_for(lambda: locks.exists() and len(list(locks.iterdir())) == 2, "the lock")
    second = fresh.run("--rerun-incomplete", TARGET)
    assert second.returncode != 0 and "Directory cannot be locked" in second.stdout
    refused = taylorcal("calibrate", STUDY)
    assert refused.returncode != 0
    assert f"another workflow is computing it (process {first.pid})" in refused.stderr
    assert "Stop it first" in taylorcal("unlock", STUDY).stderr
    kill(first)
    refused = taylorcal("calibrate", STUDY)
    assert refused.returncode != 0
    assert f"If none runs: workflow/taylorcal unlock {STUDY}" in refused.stderr
    assert taylorcal("unlock", STUDY).returncode == 0
    assert not locks.exists() or not list(locks.iterdir())


@pytest.fixture
def small_disk(tmp_path):
    """A disk of 300 kB."""
    if os.geteuid() != 0:
        pytest.skip("mounting a small disk needs root")
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=300k", "tmpfs", str(disk)]
    mounted = subprocess.run(mount, capture_output=True, text=True)
    if mounted.returncode:
        pytest.skip(f"a small disk cannot be mounted here: {mounted.stderr.strip()}")
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


@pytest.mark.parametrize("name", ["runs", "merge", "train", "sample", "compare"])
@pytest.mark.parametrize("room", [0, 8192])
def test_a_full_disk_is_named_and_the_stage_goes_on_later(
    program, finished, small_disk, tmp_path, name, room
):
    whole, stage = (
        stages(program, finished.results, folder)[name] for folder in (tmp_path, small_disk)
    )
    if name == "runs":
        whole, stage = (
            made.with_config(tmp_path / "quick.json", QUICK_RUNS) for made in (whole, stage)
        )
    ended(whole.command)
    ballast = small_disk / "ballast"
    free = os.statvfs(small_disk)
    ballast.write_bytes(bytes(free.f_bavail * free.f_frsize - room))
    done = subprocess.run(stage.command, capture_output=True, text=True)
    assert done.returncode not in (0, -signal.SIGSEGV, -signal.SIGABRT), done.stderr
    last = done.stderr.strip().splitlines()[-1]
    assert stage.out.name in last and ("No space" in last or "space" in last or "full" in last)
    assert not stage.out.exists()
    ballast.unlink()
    said = ended(stage.command).said
    if name == "runs" and room:
        assert "in the journal already" in said
    assert stage.out.read_bytes() == whole.out.read_bytes()


DAMAGED = {
    "merge": ["chunks/0.h5"],
    "train": ["database.h5", "config/train.json"],
    "sample": ["emulator.json", "config/calibrate.json"],
    "compare": ["posterior.h5", "emulator.json"],
}


@pytest.mark.parametrize("name, file", [(name, file) for name in DAMAGED for file in DAMAGED[name]])
@pytest.mark.parametrize("share", [0, 0.5, 0.999])
def test_a_truncated_file_is_refused_by_name(program, copied, tmp_path, name, file, share):
    stage = stages(program, copied.results, tmp_path)[name]
    path = copied.results / file
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole) - 1)] if share else b"")
    done = subprocess.run(stage.command, capture_output=True, text=True)
    assert done.returncode == 1, done.stderr
    assert path.name in done.stderr
    assert not stage.out.exists()


def test_a_truncated_journal_costs_only_its_last_run(program, finished, tmp_path):
    stage = stages(program, finished.results, tmp_path)["runs"]
    stage = stage.with_config(tmp_path / "quick.json", QUICK_RUNS)
    ended(stage.command)
    whole = stage.out.read_bytes()
    stage.out.unlink()
    journal = tmp_path / "0.h5.journal.jsonl"
    enough = ended(
        stage.command, lambda _: journal.exists() and journal.read_bytes().count(b"\n") > 4
    )
    assert enough.killed
    lines = journal.read_bytes().split(b"\n")
    journal.write_bytes(b"\n".join(lines[:4]) + b"\n" + lines[4][:-20])
    assert "3 of 24 runs are in the journal already" in ended(stage.command).said
    assert stage.out.read_bytes() == whole
