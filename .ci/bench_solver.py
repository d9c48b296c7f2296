"""Speed of the solver on this machine: every shape, geometry and setting, then two threads
against one. Usage: bench_solver.py SOLVER
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, "workflow/scripts")
from make_design import write_design  # noqa: E402

SHAPES = ["uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"]
SETTINGS = [
    ("axisymmetric", "coarse"),
    ("axisymmetric", "standard"),
    ("3d", "coarse"),
    ("3d", "standard"),
]
VELOCITY = 120  # [m/s]
BATCH_RUNS = 32
BATCH_REPEATS = 3
COLUMNS = (
    f"{'shape':<18}{'points':>8}{'steps':>8}{'nbrs':>6}{'CPU s':>8}{'1e6 updates/s':>15}"
    f"{'gradients':>11}{'plasticity':>12}{'forces':>8}{'motion':>8}{'KB/point':>10}"
)


def call(*command):
    """Standard output of a command that must not fail."""
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def impact_line(solver, shape, geometry, fidelity):
    """One impact as a line of the table."""
    question = ["--shape", shape, "--velocity", str(VELOCITY)]
    setting = ["--geometry", geometry, "--fidelity", fidelity]
    run = json.loads(call(solver, "run", *question, *setting, "--json"))
    grains = run["grains_per_point"]
    updates = run["grain_updates"] / grains / run["cpu_s"] / 1e6
    memory = run["memory_B"] / run["points"] / 1024
    shares = "".join(
        f"{100 * run['time_shares'][phase]:{width}.0f}%"
        for phase, width in [("gradients", 10), ("plasticity", 11), ("forces", 7), ("motion", 7)]
    )
    return (
        f"{shape:<18}{run['points']:8d}{run['steps']:8d}{run['neighbours']:6.0f}{run['cpu_s']:8.2f}"
        f"{updates:15.2f}{shares}{memory:10.1f}"
    )


def batch_seconds(solver, folder, threads):
    """Wall seconds of a batch of equal runs."""
    design = folder / "design.h5"
    out = folder / "database.h5"
    start = time.monotonic()
    files = [str(design), "--config", str(folder / "solver.json"), "--out", str(out)]
    call(solver, "batch", *files, "--threads", str(threads))
    seconds = time.monotonic() - start
    for file in folder.glob("database*"):
        file.unlink()
    return seconds


def equal_runs():
    """A design of equal uniform cylinders, for the batch."""
    names = ["velocity_m_s", "initial_diameter_mm", "length_to_diameter", "initial_temperature_K"]
    return {
        "run_id": np.arange(BATCH_RUNS),
        "seed": np.ones(BATCH_RUNS, dtype=np.int64),
        "shape": [SHAPES[0]] * BATCH_RUNS,
        "inputs": np.tile([90.0, 8.0, 5.0, 300.0], (BATCH_RUNS, 1)),
        "names": names,
    }


def main(solver):
    for geometry, fidelity in SETTINGS:
        print(f"\none impact at {VELOCITY} m/s, {geometry}, {fidelity}, one thread")
        print(COLUMNS)
        for shape in SHAPES:
            print(impact_line(solver, shape, geometry, fidelity), flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_design(folder / "design.h5", equal_runs())
        (folder / "solver.json").write_text(json.dumps({"fidelity": "coarse"}))
        ratios = []
        for _ in range(BATCH_REPEATS):
            one = batch_seconds(solver, folder, 1)
            ratios.append(one / batch_seconds(solver, folder, 2))
    best = max(ratios)
    print(
        f"\nbatch of {BATCH_RUNS} runs: two threads {best:.2f} times one (best of {BATCH_REPEATS})"
    )


if __name__ == "__main__":
    main(sys.argv[1])
