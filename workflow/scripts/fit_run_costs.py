#!/usr/bin/python3
"""Fits run_costs.csv to runs that were computed, or adds kinds of runs to it.

    workflow/scripts/fit_run_costs.py DATABASE.h5... > run_costs.csv

Beside each database lies its `.cost.csv`. CPU seconds at the velocity v spread as a lognormal about
median (v / 100 m/s)^exponent. Fewer than 30 runs of a kind do not tell exponent and spread: these
are then those of the same shape in the kind with the most runs.
"""

import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from cost.model import REFERENCE_VELOCITY

ENOUGH_RUNS = 30
COLUMNS = ["geometry", "fidelity", "shape", "runs"]
COLUMNS += ["cpu_s_at_100_m_s", "velocity_exponent", "spread"]
GEOMETRIES, FIDELITIES = ["axisymmetric", "3d"], ["coarse", "standard", "fine"]
SHAPES = ["uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"]


@dataclass
class Fit:
    runs: int
    median_s: float
    exponent: float
    spread: float


def measured(path: Path) -> dict[tuple, list[tuple[float, float]]]:
    """By geometry, fidelity and shape: velocity and CPU seconds of each run."""
    with Path(f"{path}.cost.csv").open(newline="") as file:
        cost = {int(row["run_id"]): float(row["cpu_s"]) for row in csv.DictReader(file)}
    found: dict[tuple, list] = {}
    with h5py.File(path) as file:
        configuration = json.loads(file.attrs["provenance"])["configuration"]
        column = list(file["inputs"].attrs["names"]).index("velocity_m_s")
        rows = zip(file["run_id"][:], file["shape"].asstr()[:], file["inputs"][:, column])
        for run, shape, velocity in rows:
            kind = (configuration["geometry"], configuration["fidelity"], shape)
            found.setdefault(kind, []).append((velocity, cost[int(run)]))
    return found


def fit(runs: list[tuple[float, float]], like: Fit | None) -> Fit:
    """`like`: whose exponent and spread a few runs take."""
    velocity, seconds = np.log(np.array(runs)).T
    velocity -= np.log(REFERENCE_VELOCITY)
    if like:
        median = np.mean(seconds - like.exponent * velocity)
        return Fit(len(runs), np.exp(median), like.exponent, like.spread)
    exponent, median = np.polyfit(velocity, seconds, 1)
    rest = seconds - median - exponent * velocity
    return Fit(len(runs), np.exp(median), exponent, rest.std(ddof=2))


def fits(paths: list[Path]) -> dict[tuple, Fit]:
    kinds: dict[tuple, list] = {}
    for path in paths:
        for kind, runs in measured(path).items():
            kinds.setdefault(kind, []).extend(runs)
    found: dict[tuple, Fit] = {}
    for kind in sorted(kinds, key=lambda kind: -len(kinds[kind])):
        same_shape = [found[other] for other in found if other[2] == kind[2]]
        few = len(kinds[kind]) < ENOUGH_RUNS
        found[kind] = fit(kinds[kind], same_shape[0] if few else None)
    return found


def place(kind: tuple) -> tuple[int, int, int]:
    return GEOMETRIES.index(kind[0]), FIDELITIES.index(kind[1]), SHAPES.index(kind[2])


def main() -> None:
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(COLUMNS)
    found = fits([Path(name) for name in sys.argv[1:]])
    for kind in sorted(found, key=place):
        one = found[kind]
        figures = [f"{one.median_s:.3g}", f"{one.exponent:.2f}", f"{one.spread:.2f}"]
        table.writerow([*kind, one.runs, *figures])


if __name__ == "__main__":
    main()
