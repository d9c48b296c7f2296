"""`make kills`: 300 runs whose workflow is killed 20 times, at random moments of each stage."""

import os
import random
import re
import time
from collections.abc import Callable

import pytest
from tiny_study import STUDY_YAML, Workspace, make_workspace, write_study
from workflow_kills import TARGET, kill, results_of, start

RUNS, CHUNKS = 300, 6
# Of the runs so many that they last through their kills, of the others some seconds.
LARGER = {"runs: 24": f"runs: {RUNS}", "chunks: 2": f"chunks: {CHUNKS}"}
LARGER |= {"epochs: 60": "epochs: 40000", "draws: 2000": "draws: 4000000"}
KILLS = {"runs": 13, "train": 4, "sample": 3}
WAIT_S = 300

pytestmark = pytest.mark.skipif("TAYLORCAL_KILLS" not in os.environ, reason="make kills: minutes")


def finished_runs(workspace: Workspace) -> int:
    """Those in journals, and those of chunks that are complete."""
    chunks = workspace.results / "chunks"
    journals = list(chunks.glob("*.journal.jsonl"))
    lines = sum(max(0, path.read_bytes().count(b"\n") - 1) for path in journals)
    return lines + RUNS // CHUNKS * len(list(chunks.glob("*.h5")))


def after_some_runs(workspace: Workspace, source: random.Random) -> Callable[[], bool]:
    """Between 1 and 18 runs later; 13 times the mean leaves some of the 300."""
    wanted = finished_runs(workspace) + source.randint(1, 18)
    return lambda: finished_runs(workspace) >= wanted


def amid(rule: str, workspace: Workspace, source: random.Random) -> Callable[[], bool]:
    """Up to two seconds after the rule's program began anew, as its log tells."""
    log, begun = workspace.results / "logs" / f"{rule}.log", []
    before, share = log.stat().st_mtime_ns if log.exists() else 0, source.uniform(0, 2)

    def is_time() -> bool:
        if not begun and log.exists() and log.stat().st_mtime_ns > before:
            begun.append(time.monotonic())
        return bool(begun) and time.monotonic() > begun[0] + share

    return is_time


def killed_when(workspace: Workspace, is_time: Callable[[], bool]) -> None:
    process = start(workspace, TARGET)
    deadline = time.monotonic() + WAIT_S
    while not is_time():
        assert process.poll() is None, f"it ended before its kill: {process.communicate()[0]}"
        assert time.monotonic() < deadline
        time.sleep(0.01)
    kill(process)
    assert not (workspace.folder / TARGET).exists()
    assert workspace.run("--unlock").returncode == 0


def test_300_runs_survive_20_kills_with_the_same_results(program, fresh):
    study = STUDY_YAML
    for old, new in LARGER.items():
        study = study.replace(old, new)
    reference = make_workspace(fresh.folder.parent / "whole", fresh.folder / "build")
    for workspace in (fresh, reference):
        write_study(workspace.study, study)
    assert reference.run(TARGET).returncode == 0
    source, went_on = random.Random(1), []
    for stage, kills in KILLS.items():
        for _ in range(kills):
            is_time = after_some_runs if stage == "runs" else lambda *of: amid(stage, *of)
            killed_when(fresh, is_time(fresh, source))
            log = fresh.results / "logs" / f"{stage}.log"
            said = log.read_text() if log.exists() else ""
            went_on += re.findall(r"goes on after.*", said)
    done = fresh.run("--rerun-incomplete", "--show-failed-logs", TARGET)
    assert done.returncode == 0, done.stdout
    assert results_of(fresh) == results_of(reference)
    print(f"{sum(KILLS.values())} kills; all results have the same bytes. Among what was said:")
    print("\n".join(went_on))
