"""Names of impacts, such as `axisymmetric_n12_g16_truncated_cone_v90_s1`, and what they say.

A further part `hourglass0.15` or `viscosity0.5` scales that coefficient.
"""

import json
import re
from pathlib import Path

SHAPES = ["uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"]
SHAPE_WORDS = {
    "uniform_cylinder": "uniform cylinder",
    "reduced_head_4mm": "4-mm head",
    "reduced_head_3mm": "3-mm head",
    "truncated_cone": "cone",
}
SIZES = [
    "final_length_mm",
    "impact_diameter_mm",
    "head_length_mm",
    "rear_length_mm",
    "transition_diameter_mm",
    "undeformed_length_mm",
    "diameter_at_0p2L0_mm",
]
# The solver's own coefficients.
VISCOSITY = {
    "axisymmetric": {"linear_viscosity": 0.04, "quadratic_viscosity": 1.0},
    "3d": {"linear_viscosity": 0.0, "quadratic_viscosity": 1.0},
}
HOURGLASS = {"axisymmetric": 0.1, "3d": 1.0}
COARSE_COLUMNS = 5  # of the coarse axisymmetric setting, which cuts heads less finely

RUNS = Path("results/verification/runs")
NAME = re.compile(
    r"(?P<geometry>axisymmetric|3d)_n(?P<elements>\d+)_g(?P<grains>\d+)_(?P<shape>\w+?)"
    r"_v(?P<velocity>[\d.]+)_s(?P<seed>\d+)(?:_(?P<what>viscosity|hourglass)(?P<factor>[\d.]+))?"
)


def run_name(geometry, elements, grains, shape, velocity, seed=1, change=""):
    """`change`: "", or such as "viscosity0.5"."""
    name = f"{geometry}_n{elements}_g{grains}_{shape}_v{velocity:g}_s{seed}"
    return f"{name}_{change}" if change else name


def arguments_of(wildcards):
    """Command line of `solver run` for the name `wildcards.run`."""
    name = wildcards.run
    parts = NAME.fullmatch(name)
    if parts is None:
        raise ValueError(f"{name} is not the name of a run (expected {NAME.pattern})")
    numerics = {"elements_across_radius": parts["elements"], "grains_per_point": parts["grains"]}
    if parts["what"] == "viscosity":
        factor = float(parts["factor"])
        own = VISCOSITY[parts["geometry"]]
        numerics |= {key: value * factor for key, value in own.items()}
    elif parts["what"] == "hourglass":
        numerics["hourglass"] = HOURGLASS[parts["geometry"]] * float(parts["factor"])
    columns = int(parts["elements"]) if parts["geometry"] == "axisymmetric" else None
    coarse = columns is not None and columns <= COARSE_COLUMNS
    words = [
        f"--geometry {parts['geometry']} --fidelity {'coarse' if coarse else 'fine'}",
        f"--shape {parts['shape']} --velocity {parts['velocity']} --seed {parts['seed']}",
    ]
    return " ".join(words + [f"--numerics {key}={value}" for key, value in numerics.items()])


def files_of(names):
    """Where the answers of these runs are."""
    return [str(RUNS / f"{name}.json") for name in names]


def read_run(name):
    """The answer of `solver run --json`."""
    return json.loads((RUNS / f"{name}.json").read_text())
