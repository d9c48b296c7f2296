"""The stages' programs on the files of a study, without Snakemake, and how to kill them."""

import json
import os
import random
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

# Runs of a J2 metal take hundredths of a second.
QUICK_RUNS = {"fidelity": "coarse", "material": {"strength": "j2", "equation_of_state": "linear"}}


@dataclass
class Stage:
    """A program that writes `out`."""

    command: list[str]
    out: Path

    def with_config(self, path: Path, content: dict) -> "Stage":
        path.write_text(json.dumps(content))
        command = list(self.command)
        command[command.index("--config") + 1] = str(path)
        return Stage(command, self.out)


@dataclass
class Ended:
    killed: bool
    said: str
    wall_s: float
    cpu_s: float


def stages(program, results: Path, folder: Path) -> dict[str, Stage]:
    """Each stage with what went before it in `results`, writing to `folder`."""
    config = results / "config"
    table = results.parents[1] / "experiments" / results.name / "measurements.csv"
    model = ["--emulator", results / "emulator.json", "--measurements", table]
    model += ["--config", config / "calibrate.json", "--threads", 2]
    chunks = sorted((results / "chunks").glob("*.h5"))
    solver, threads = config / "solver.json", ["--threads", 2]
    found = {
        "0.h5": ["solver", "batch", results / "design.h5", "--config", solver, *threads],
        "database.h5": ["solver", "merge", *chunks],
        "emulator.json": ["emulator", "train", results / "database.h5", *threads],
        "posterior.h5": ["calibrate", "sample", *model],
        "comparison.json": ["calibrate", "compare", "--posterior", results / "posterior.h5"],
    }
    found["emulator.json"] += ["--config", config / "train.json"]
    found["comparison.json"] += model[:-2]
    names = ["runs", "merge", "train", "sample", "compare"]
    return {
        name: Stage(
            [program(binary), *map(str, arguments), "--out", str(folder / out)], folder / out
        )
        for name, (out, (binary, *arguments)) in zip(names, found.items())
    }


def ended(command: list[str], kill_when: Callable[[float], bool] | None = None) -> Ended:
    """Runs the command to its end, or to `kill -9` of all its processes once `kill_when`,
    which is told the seconds since the start, says so.
    """
    start = time.monotonic()
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)
    while kill_when and not _has_ended(process.pid):
        if kill_when(time.monotonic() - start):
            os.killpg(process.pid, signal.SIGKILL)  # not reaped yet: the number is its own
            break
        time.sleep(0.002)
    said = process.stderr.read()
    process.stderr.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    killed = process.returncode == -signal.SIGKILL
    assert killed or process.returncode == 0, said
    return Ended(killed, said, time.monotonic() - start, usage.ru_utime + usage.ru_stime)


def _has_ended(pid: int) -> bool:
    return os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None


def random_moments(name: str, longest: float, count: int) -> list[float]:
    """The same shares of `longest` in every test run."""
    source = random.Random(name)
    return [source.uniform(0, longest) for _ in range(count)]
