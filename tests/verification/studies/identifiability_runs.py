"""Paired runs that tell which effects a table of shots could show: what is computed.

Of each specimen there is a run at the optimum, one with each calibrated parameter raised and
one with each effect, all with the same grain orientations, so that their differences are the
parameter's and the effect's own.
"""

import itertools
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "workflow" / "scripts"))

from impact_runs import SHAPES  # noqa: E402
from make_synthetic_table import DIAMETER_MM, LENGTH_MM, TRUTH  # noqa: E402
from shot_inputs import SHOT_INPUTS  # noqa: E402

FIDELITY = "coarse"
VELOCITIES_M_S = [40, 60, 80, 100, 120]
ROOM_K, HOT_K = 300, 600
SEED = 1
# A step that moves the sizes by some per cent, as an effect does, and not by a whole range.
RAISED = {
    "rho_immobile_initial": 1.5 * TRUTH["rho_immobile_initial"],
    "hardening_coefficient": TRUTH["hardening_coefficient"] + 0.4,
    "immobilization_velocity": TRUTH["immobilization_velocity"] + 0.15,
}


def listed_effects(solver="build/bin/solver"):
    """{name: amplitude} of the effects that axisymmetric runs have, at their typical size."""
    command = [solver, "effects", "--json"]
    listed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return {
        effect["name"]: effect["typical"]
        for effect in listed["effects"]
        if "axisymmetric" in effect["geometries"]
    }


def paired_design(effects, base=0.0):
    """Columns of the design, as `write_design` wants them; `effects`: {input: value}, each
    `base` but in the runs that show it."""
    fixed = {"initial_diameter_mm": DIAMETER_MM, "length_to_diameter": LENGTH_MM / DIAMETER_MM}
    names = [*SHOT_INPUTS, *TRUTH, *effects]
    changes = [{}, *({name: value} for name, value in {**RAISED, **effects}.items())]
    rows, shapes, seeds = [], [], []
    specimens = itertools.product([ROOM_K, HOT_K], SHAPES, VELOCITIES_M_S)
    for number, (temperature, shape, velocity) in enumerate(specimens):
        shot = {"velocity_m_s": velocity, "initial_temperature_K": temperature, **fixed}
        without = {**shot, **TRUTH, **dict.fromkeys(effects, base)}
        for change in changes:
            rows.append([{**without, **change}[name] for name in names])
            shapes.append(shape)
            seeds.append(SEED + number)
    return {
        "run_id": np.arange(len(rows), dtype=np.int64),
        "seed": np.array(seeds, dtype=np.int64),
        "shape": shapes,
        "inputs": np.array(rows, dtype=float),
        "names": names,
    }
