"""A bar with a reduced head and J2, of which finite elements give an independent answer."""

import finite_elements

SHOTS = [50, 90]  # m/s: the head folds onto its shoulder at 90
GEOMETRIES = ["axisymmetric", "3d"]
FIDELITIES = ["standard", "fine"]
COLUMNS = 8  # of the finite elements in the figure

MATERIAL = {
    "strength": "j2",
    "j2_yield_stress": finite_elements.YIELD_STRESS,
    "j2_hardening_modulus": finite_elements.HARDENING_MODULUS,
    "equation_of_state": "linear",
    "initial_density": finite_elements.DENSITY,
    "bulk_modulus": finite_elements.BULK_MODULUS,
    "poisson_ratio": finite_elements.POISSON_RATIO,
    "taylor_quinney": finite_elements.HEATING_SHARE,
}


def head_words(velocity, geometry, fidelity):
    """Arguments of `solver run`; one grain a point, as all would answer the same."""
    words = f"--shape reduced_head_4mm --velocity {velocity} --numerics grains_per_point=1"
    words += f" --geometry {geometry} --fidelity {fidelity}"
    return " ".join([words, *(f"--set {name}={value}" for name, value in MATERIAL.items())])


def arguments_of_head(wildcards):
    return head_words(wildcards.velocity, wildcards.geometry, wildcards.fidelity)


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
