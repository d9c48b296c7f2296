"""A bar with a reduced head and J2, of which finite elements give an independent answer."""

from pathlib import Path

import finite_elements

SHOTS = [50, 90]  # m/s: the head folds onto its shoulder at 90
GEOMETRIES = ["axisymmetric", "3d"]
FIDELITIES = ["standard", "fine"]
COLUMNS = 8  # of the finite elements in the figure
# Soft metal that folds, where heads are hardest to get right: cells or particles across the rear.
SOFT_SHOT = 90  # m/s
SOFT_LEVELS = {"axisymmetric": [8, 12, 16, 24], "3d": [6, 7, 8, 9, 10, 12]}
FINEST_COLUMNS = 12  # of the finite elements in their table
TABLE = Path(__file__).parent.parent / "data" / "reduced_head_finite_elements.csv"

MATERIAL = {
    "strength": "j2",
    "equation_of_state": "linear",
    "initial_density": finite_elements.DENSITY,
    "bulk_modulus": finite_elements.BULK_MODULUS,
    "poisson_ratio": finite_elements.POISSON_RATIO,
    "taylor_quinney": finite_elements.HEATING_SHARE,
}


def head_words(metal, velocity, geometry, fidelity):
    """Arguments of `solver run`; one grain a point, as all would answer the same."""
    yield_stress, hardening_modulus = finite_elements.METALS[metal]
    material = MATERIAL | {
        "j2_yield_stress": yield_stress,
        "j2_hardening_modulus": hardening_modulus,
    }
    words = f"--shape reduced_head_4mm --velocity {velocity} --numerics grains_per_point=1"
    words += f" --geometry {geometry} --fidelity {fidelity}"
    return " ".join([words, *(f"--set {name}={value}" for name, value in material.items())])


def soft_head_words(geometry, elements):
    """Those of the soft metal, with so many cells or particles across the rear's radius."""
    words = head_words("soft", SOFT_SHOT, geometry, "fine")
    return f"{words} --numerics elements_across_radius={elements}"


def arguments_of_head(wildcards):
    return head_words("hard", wildcards.velocity, wildcards.geometry, wildcards.fidelity)


def arguments_of_soft_head(wildcards):
    return soft_head_words(wildcards.geometry, wildcards.elements)


def head_stem(velocity, geometry, fidelity):
    """Where an answer is: with .json and .h5."""
    return f"results/verification/heads/v{velocity}_{geometry}_{fidelity}"


def head_files(wildcards):
    return [
        head_stem(velocity, geometry, fidelity) + suffix
        for velocity in SHOTS
        for geometry in GEOMETRIES
        for fidelity in FIDELITIES
        for suffix in [".json", ".h5"]
    ]


def soft_head_answer(geometry, elements):
    return f"results/verification/heads/soft_{geometry}_{elements}.json"


def soft_head_answers(wildcards):
    return [
        soft_head_answer(geometry, elements)
        for geometry, levels in SOFT_LEVELS.items()
        for elements in levels
    ]
