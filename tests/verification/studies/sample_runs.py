"""The random sample over the whole of the paper's Table 2: what it computes, and how."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3] / "workflow" / "scripts"))

from impact_runs import SHAPES  # noqa: E402
from make_design import design  # noqa: E402

RUNS = 500
FIDELITY = "coarse"
SEED = 1
PARAMETERS = {
    "rho_immobile_initial": {"lower": 1e10, "upper": 1e15, "prior": "log_uniform"},
    "hardening_coefficient": {"lower": 0, "upper": 10, "prior": "uniform"},
    "immobilization_velocity": {"lower": 0, "upper": 5, "prior": "uniform"},
}


def sample_design(runs):
    """A Sobol sequence for each shape, ends of the ranges included, shapes in turn."""
    return design(
        {
            "ranges": {
                "velocity_m_s": [10, 150],
                "initial_diameter_mm": [8, 8],
                "length_to_diameter": [5, 5],
                "initial_temperature_K": [300, 300],
            },
            "parameters": PARAMETERS,
            "shapes": SHAPES,
            "runs": runs,
            "seed": SEED,
        }
    )


def command_of(run, fidelity):
    """Command line that computes a run (a row of the sample's table) again."""
    values = [f"--set {name}={run[name]:.17g}" for name in PARAMETERS]
    words = [
        f"solver run --geometry axisymmetric --fidelity {fidelity} --shape {run['shape']}",
        f"--velocity {run['velocity_m_s']:.17g} --seed {run['seed']}",
    ]
    return " ".join(words + values)
