"""A workflow that is started, and killed as a lost machine loses it."""

import os
import signal
import subprocess

from tiny_study import STUDY, Workspace

RESULTS = ["database.h5", "emulator.json", "posterior.h5", "comparison.json"]
TARGET = f"results/{STUDY}/comparison.json"


def results_of(workspace: Workspace) -> dict[str, bytes]:
    return {name: (workspace.results / name).read_bytes() for name in RESULTS}


def start(workspace: Workspace, *options: str) -> subprocess.Popen:
    return subprocess.Popen(
        workspace.command("--rerun-incomplete", *options),
        cwd=workspace.folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )


def kill(process: subprocess.Popen) -> None:
    """Ends the workflow and all its jobs."""
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
