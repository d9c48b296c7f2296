"""Tables whose truth is known: twins of paper_design, each of a metal drawn from the prior."""

import sys
from pathlib import Path

import numpy as np
from scipy.stats import qmc

sys.path.append("workflow/scripts")

from make_synthetic_table import TableDesign, table_rows, write_table  # noqa: E402

LOOKED_AT = 20  # twins that told how the network's errors belong together
TWINS = 40  # the others judge the intervals
SHOTS = 40  # of each
SEED = 2023
SOURCE = "synthetic: made by taylorcal's solver (axisymmetric, coarse), parameters from the prior"


def truths(parameters: dict) -> list[dict[str, float]]:
    """One metal a twin; of either part a Latin hypercube over the priors of `parameters`."""
    units = np.concatenate(
        [
            qmc.LatinHypercube(d=len(parameters), seed=SEED + part).random(count)
            for part, count in enumerate((LOOKED_AT, TWINS - LOOKED_AT))
        ]
    )
    metals = []
    for row in units:
        metal = {}
        for unit, (name, prior) in zip(row, parameters.items(), strict=True):
            low, high = float(prior["lower"]), float(prior["upper"])
            is_log = prior["prior"] == "log_uniform"
            metal[name] = low * (high / low) ** unit if is_log else low + (high - low) * unit
        metals.append(metal)
    return metals


def twin_designs(parameters: dict) -> list[dict]:
    """Columns of the runs of each twin; run ids go on from one to the next."""
    designs = []
    for twin, truth in enumerate(truths(parameters)):
        design = TableDesign(SEED + twin, shots=SHOTS, truth=truth).columns()
        design["run_id"] = design["run_id"] + twin * SHOTS
        designs.append(design)
    return designs


def joined(designs: list[dict]) -> dict:
    """One design of all."""
    return {
        "run_id": np.concatenate([design["run_id"] for design in designs]),
        "seed": np.concatenate([design["seed"] for design in designs]),
        "shape": [shape for design in designs for shape in design["shape"]],
        "inputs": np.concatenate([design["inputs"] for design in designs]),
        "names": designs[0]["names"],
    }


def write_twin(path: Path, design: dict, sizes: np.ndarray, twin: int) -> int:
    """The table of one twin with noise; shots of metal too soft to stop are left out. How many
    there are in it."""
    rows = table_rows(design, sizes, SOURCE, SEED + twin)
    fired = [row for row, values in zip(rows, sizes, strict=True) if np.isfinite(values).all()]
    write_table(path, [{**row, "use": "calibrate"} for row in fired])
    return len(fired)
