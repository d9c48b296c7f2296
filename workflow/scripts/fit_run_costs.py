#!/usr/bin/python3
"""Fits run_costs.csv to runs that were computed, or adds kinds of runs to it.

    workflow/scripts/fit_run_costs.py DATABASE.h5... > run_costs.csv

Beside each database lies its `.cost.csv`. CPU seconds at the velocity v spread as a lognormal about
median (v / 100 m/s)^exponent. Fewer than 30 runs of a kind tell neither exponent nor spread: these
are then those of the same shape in the kind that has the most of the same impacts among its many
runs, and the median is that kind's times what the few cost more than those.
"""

import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from cost.model import REFERENCE_VELOCITY
from database_costs import read_costs
from shape_names import PAPER_SHAPES

ENOUGH_RUNS = 30
COLUMNS = ["geometry", "fidelity", "shape", "runs"]
COLUMNS += ["cpu_s_at_100_m_s", "velocity_exponent", "spread"]
GEOMETRIES, FIDELITIES = ["axisymmetric", "3d"], ["coarse", "standard", "fine"]


@dataclass
class Fit:
    runs: int
    median_s: float
    exponent: float
    spread: float


@dataclass
class Run:
    inputs: tuple  # the same in another kind: the same impact
    velocity_m_s: float
    cpu_s: float


def measured(path: Path) -> dict[tuple, list[Run]]:
    """By geometry, fidelity and shape; without runs whose cost is not known."""
    cost = read_costs(path)
    found: dict[tuple, list] = {}
    with h5py.File(path) as file:
        configuration = json.loads(file.attrs["provenance"])["configuration"]
        column = list(file["inputs"].attrs["names"]).index("velocity_m_s")
        rows = zip(file["run_id"][:], file["shape"].asstr()[:], file["inputs"][:])
        for run, shape, inputs in rows:
            if int(run) not in cost:
                continue
            kind = (configuration["geometry"], configuration["fidelity"], shape)
            one = Run(tuple(inputs), inputs[column], cost[int(run)])
            found.setdefault(kind, []).append(one)
    return found


def fit(runs: list[Run]) -> Fit:
    velocity = np.log([run.velocity_m_s / REFERENCE_VELOCITY for run in runs])
    seconds = np.log([run.cpu_s for run in runs])
    exponent, median = np.polyfit(velocity, seconds, 1)
    rest = seconds - median - exponent * velocity
    return Fit(len(runs), np.exp(median), exponent, rest.std(ddof=2))


def fit_beside(runs: list[Run], others: list[Run], like: Fit) -> Fit:
    """A few runs by what they cost more than the same impacts among `others`, fitted by `like`."""
    cheaper = {run.inputs: run.cpu_s for run in others}
    ratios = [run.cpu_s / cheaper[run.inputs] for run in runs if run.inputs in cheaper]
    factor = np.exp(np.mean(np.log(ratios)))
    return Fit(len(ratios), like.median_s * factor, like.exponent, like.spread)


def fits(paths: list[Path]) -> dict[tuple, Fit]:
    kinds: dict[tuple, list[Run]] = {}
    for path in paths:
        for kind, runs in measured(path).items():
            kinds.setdefault(kind, []).extend(runs)
    found = {kind: fit(runs) for kind, runs in kinds.items() if len(runs) >= ENOUGH_RUNS}
    many = list(found)
    for kind in set(kinds) - set(many):
        impacts = {run.inputs for run in kinds[kind]}

        def shared(other):
            return sum(run.inputs in impacts for run in kinds[other])

        beside = max((k for k in many if k[2] == kind[2]), key=shared, default=None)
        if beside is None or shared(beside) == 0:
            sys.exit(
                f"{' '.join(kind)}: {len(kinds[kind])} runs, and no kind of {ENOUGH_RUNS} or more"
                " has the same impacts. Give a database of many runs that has them, too."
            )
        found[kind] = fit_beside(kinds[kind], kinds[beside], found[beside])
    return found


def place(kind: tuple) -> tuple:
    """The paper's shapes first, others by their names."""
    shapes = [*PAPER_SHAPES, kind[2]]
    return GEOMETRIES.index(kind[0]), FIDELITIES.index(kind[1]), shapes.index(kind[2]), kind[2]


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
