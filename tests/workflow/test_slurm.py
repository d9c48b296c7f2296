"""A study through the profile for Slurm, on a cluster of this machine alone, with a job killed."""

import os
import subprocess
import sys
import time

import pytest
from loopback_slurm import LoopbackSlurm, why_not
from tiny_study import ROOT, SNAKEMAKE, STUDY

sys.path.insert(0, str(ROOT / "workflow" / "profiles" / "slurm"))
from status import verdict  # noqa: E402

PROFILE = "workflow/profiles/slurm"
RESULTS = ["chunks/0.h5", "chunks/1.h5", "database.h5", "emulator.json", "posterior.h5"]
LONGEST_S = 280


@pytest.fixture
def slurm(tmp_path):
    problem = why_not()
    if problem:
        pytest.skip(problem)
    folder = tmp_path / "slurm"
    folder.mkdir()
    cluster = LoopbackSlurm(folder)
    try:
        cluster.start()
        yield cluster
    except (TimeoutError, OSError) as error:
        pytest.skip(f"no Slurm can be started here: {error}")
    finally:
        cluster.stop()


def test_a_study_on_a_cluster_survives_a_killed_job(slurm, finished, fresh, tmp_path):
    small = ["--set-threads", "runs=2", "train=2", "sample=2", "--latency-wait", "5"]
    small += ["--default-resources", "mem_mb=500", "runtime=10"]
    options = [f"results/{STUDY}/comparison.json", "--profile", PROFILE, *small]
    command = [SNAKEMAKE, *options, "--config", f"study={STUDY}"]
    with (tmp_path / "log").open("w") as log:
        process = subprocess.Popen(
            command, cwd=fresh.folder, env=slurm.environment, stdout=log, stderr=log
        )
        killed = kill_a_job_amid_its_runs(slurm, fresh, process)
        assert process.wait(LONGEST_S) == 0, (tmp_path / "log").read_text()
    said = (tmp_path / "log").read_text()
    assert f"external jobid '{killed}'" in said and "Trying to restart job" in said
    assert said.count("Submitted job") == 2 + 1 + 2, "two chunks, one again, training, sampling"
    for name in RESULTS:
        assert (fresh.results / name).read_bytes() == (finished.results / name).read_bytes(), name


def kill_a_job_amid_its_runs(slurm, workspace, process) -> str:
    """Cancels the first job that has a run in its journal; returns the job's number."""
    deadline = time.monotonic() + LONGEST_S
    while process.poll() is None and time.monotonic() < deadline:
        for journal in (workspace.results / "chunks").glob("*.journal.jsonl"):
            if journal.read_bytes().count(b"\n") > 2:
                job = slurm.call("squeue", "-h", "-t", "RUNNING", "-o", "%i").split()[0]
                slurm.call("scancel", "--signal=KILL", "--full", job)
                return job
        time.sleep(0.02)
    raise AssertionError("no job was seen amid its runs")


@pytest.mark.parametrize(
    "state, word",
    [("COMPLETED", "success"), ("PENDING", "running"), ("COMPLETING", "running")]
    + [(state, "failed") for state in ("CANCELLED", "TIMEOUT", "OUT_OF_MEMORY", "NODE_FAIL", "")],
)
def test_states_of_slurm_are_told_to_snakemake(state, word):
    assert verdict(state) == word


def test_the_status_script_can_be_run():
    assert os.access(ROOT / PROFILE / "status.py", os.X_OK)
