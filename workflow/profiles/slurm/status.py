#!/usr/bin/python3
"""Tells Snakemake how a Slurm job does: running, success or failed."""

import re
import subprocess
import sys

ENDED_WELL = "COMPLETED"
GOING_ON = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "RESIZING"}
GOING_ON |= {"REQUEUE_HOLD", "SIGNALING", "STAGE_OUT", "STOPPED"}


def state_of(job: str) -> str:
    """Slurm's word; empty when neither the controller nor the accounting knows the job."""
    told = _answer("scontrol", "--oneliner", "show", "job", job)
    found = re.search(r"\bJobState=(\w+)", told)
    if found:
        return found[1]
    # The controller forgets a job some minutes after its end; accounting may not be there.
    told = _answer(
        "sacct", "--noheader", "--parsable2", "--allocations", "--format=State", "-j", job
    )
    return told.split()[0] if told.split() else ""


def _answer(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True).stdout
    except OSError:
        return ""


def verdict(state: str) -> str:
    if state == ENDED_WELL:
        return "success"
    return "running" if state in GOING_ON else "failed"


if __name__ == "__main__":
    print(verdict(state_of(sys.argv[1])))
