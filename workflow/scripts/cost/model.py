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
from shape_names import paper_shape_like
from study import better_settings, database_parts

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
    database = study["database"]
    covered = database_parts(study)
    counts = [database["runs"], *(part["runs"] for part in database["further"])]
    parts = [(runs, part, study["solver"]) for runs, part in zip(counts, covered, strict=True)]
    if database["better"]:
        parts.append((database["better"]["runs"], covered[0], better_settings(study)))
    rounds = 1
    if database["near_posterior"]:
        rounds = 2
        parts.append((database["near_posterior"]["runs"], covered[0], better_settings(study)))
    known = run_costs()
    seconds, shapes, used = [], [], set()
    for runs, part, solver in parts:
        for run in range(runs):
            shape = part["shapes"][run % len(part["shapes"])]
            kind = (solver["geometry"], solver["fidelity"], shape)
            if kind not in known:
                kind = (*kind[:2], paper_shape_like(shape))
            if kind not in known:
                raise InputError(f"{MEASURED}: has no cost of {', '.join(kind)}. Add a line.")
            used.add(kind)
            shapes.append(shape)
            # Evenly spread pairs (R2 of M. Roberts) in place of the design, which takes long.
            lowest, highest = part["velocity_m_s"]
            velocity = lowest + (highest - lowest) * ((0.7548776662 * run + 0.5) % 1)
            share = (0.5698402910 * run + 0.5) % 1
            seconds.append(known[kind].seconds(velocity, share))
    network, calibration = study["emulator"], study["calibration"]
    one_member = len(seconds) * network["epochs"] / TRAINED_ROWS_PER_CPU_S
    return StudyCost(
        runs_s=seconds,
        shapes=shapes,
        train_s=[one_member * rounds] * network["members"],
        sample_s=rounds * calibration["draws"] / SAMPLED_DRAWS_PER_CPU_S,
        measured_runs=min(known[kind].runs for kind in used),
    )
