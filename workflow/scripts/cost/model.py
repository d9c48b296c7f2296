"""Processor time of the runs and stages of a study.

Costs of runs at one velocity spread as a lognormal: soft metal flows longer. `run_costs.csv` holds,
for each kind of run, the median at 100 m/s, the exponent of the velocity and the standard
deviation of the logarithm, fitted to the `database.h5.cost.csv` of studies that were computed.
"""

import csv
import math
from dataclasses import dataclass
from pathlib import Path
from statistics import NormalDist

from input_errors import InputError
from make_design import design
from study import better_design_settings, better_settings, design_settings

MEASURED = Path(__file__).resolve().parents[2] / "run_costs.csv"
REFERENCE_VELOCITY = 100  # [m/s]
# Of the study copper_measured, 1400 runs and 46 shots, on one core.
TRAINED_ROWS_PER_CPU_S = 520_000
SAMPLED_DRAWS_PER_CPU_S = 600
OTHER_STAGES_S = 20  # design, merging, comparing, report


@dataclass
class RunCost:
    runs: int  # that it was measured on
    median_s: float  # at 100 m/s
    exponent: float
    spread: float

    def seconds(self, velocity_m_s: float, share: float) -> float:
        """The cost that a share of the runs at this velocity stays below."""
        median = self.median_s * (velocity_m_s / REFERENCE_VELOCITY) ** self.exponent
        return median * math.exp(self.spread * NormalDist().inv_cdf(share))


@dataclass
class StudyCost:
    runs_s: list[float]  # of each run, in the order of the design
    shapes: list[str]
    train_s: list[float]  # of each member of the network
    sample_s: float
    measured_runs: int  # that the figures rest on, of the kind with the fewest

    @property
    def core_hours(self) -> float:
        everything = sum(self.runs_s) + sum(self.train_s) + self.sample_s + OTHER_STAGES_S
        return everything / 3600


def run_costs(path: Path = MEASURED) -> dict[tuple[str, str, str], RunCost]:
    """By geometry, fidelity and shape."""
    with path.open(newline="") as file:
        return {
            (row["geometry"], row["fidelity"], row["shape"]): RunCost(
                int(row["runs"]),
                float(row["cpu_s_at_100_m_s"]),
                float(row["velocity_exponent"]),
                float(row["spread"]),
            )
            for row in csv.DictReader(file)
        }


def study_cost(study: dict) -> StudyCost:
    """Of the base of a study, whatever of it was computed before."""
    parts = [(design(design_settings(study)), study["solver"])]
    if study["database"]["better"]:
        parts.append((design(better_design_settings(study)), better_settings(study)))
    known = run_costs()
    seconds, shapes, used = [], [], set()
    for columns, solver in parts:
        velocity = columns["names"].index("velocity_m_s")
        count = len(columns["shape"])
        shapes += columns["shape"]
        for run, shape in enumerate(columns["shape"]):
            kind = (solver["geometry"], solver["fidelity"], shape)
            if kind not in known:
                raise InputError(f"{MEASURED}: has no cost of {', '.join(kind)}. Add a line.")
            used.add(kind)
            # Shares of the golden ratio: evenly spread, and unrelated to the order of the runs.
            share = (run * 0.6180339887 + 0.5 / count) % 1
            seconds.append(known[kind].seconds(columns["inputs"][run, velocity], share))
    network, calibration = study["emulator"], study["calibration"]
    one_member = len(seconds) * network["epochs"] / TRAINED_ROWS_PER_CPU_S
    return StudyCost(
        runs_s=seconds,
        shapes=shapes,
        train_s=[one_member] * network["members"],
        sample_s=calibration["draws"] / SAMPLED_DRAWS_PER_CPU_S,
        measured_runs=min(known[kind].runs for kind in used),
    )
