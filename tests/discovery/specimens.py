"""Sets of shots: each set is one metal (hidden parameters) and the specimens shot with it.

All tables of a set share its runs of the plain model, so that a hidden effect's signal is the
difference of two runs with the same grains.
"""

from dataclasses import dataclass

import numpy as np
from make_synthetic_table import DIAMETER_MM, LENGTH_MM, TEMPERATURE_K
from shot_inputs import SHOT_INPUTS

SHAPES = ["uniform_cylinder", "reduced_head_4mm", "truncated_cone"]
VELOCITIES_A_SHAPE = 8
VELOCITY_RANGE_M_S = (45.0, 125.0)
# Well inside the study's ranges: a truth at the edge would test the prior, not the diagnosis.
TRUTHS = {
    "rho_immobile_initial": (2e12, 1.5e13),
    "hardening_coefficient": (1.9, 3.9),
    "immobilization_velocity": (0.3, 1.4),
}
# Neither the database's coarse (5 and 8) nor the finer signatures' standard (8 and 16).
NUMERICS = (
    {"elements_across_radius": 6, "grains_per_point": 16},
    {"elements_across_radius": 7, "grains_per_point": 4},
)


@dataclass(frozen=True)
class ShotSet:
    """One metal and its shots; `velocities` [m/s] are the true ones."""

    index: int
    parameters: dict
    numerics: dict
    shapes: list
    velocities: np.ndarray
    seeds: np.ndarray

    def points(self, shape: str, velocities: np.ndarray | None = None) -> dict:
        """Inputs of the network for this set's shots of a shape."""
        chosen = np.array([known == shape for known in self.shapes])
        true = self.velocities if velocities is None else velocities
        return {
            "velocity_m_s": true[chosen],
            "initial_diameter_mm": DIAMETER_MM,
            "length_to_diameter": LENGTH_MM / DIAMETER_MM,
            "initial_temperature_K": TEMPERATURE_K,
        }


def shot_set(index: int, seed: int) -> ShotSet:
    """Set `index` of the collection that `seed` draws."""
    random = np.random.default_rng([seed, 1, index])
    density, *others = TRUTHS.items()
    parameters = {density[0]: float(np.exp(random.uniform(*np.log(density[1]))))}
    parameters |= {name: float(random.uniform(*limits)) for name, limits in others}
    lowest, highest = VELOCITY_RANGE_M_S
    # One velocity somewhere in each of equal intervals.
    share = np.arange(VELOCITIES_A_SHAPE) + random.uniform(size=(len(SHAPES), VELOCITIES_A_SHAPE))
    velocities = lowest + (highest - lowest) * share.ravel() / VELOCITIES_A_SHAPE
    return ShotSet(
        index,
        parameters,
        NUMERICS[index % len(NUMERICS)],
        [shape for shape in SHAPES for _ in range(VELOCITIES_A_SHAPE)],
        np.round(velocities, 2),
        random.integers(1, 2**31, size=velocities.size),
    )


def design_of(shots: ShotSet, settings: dict) -> dict:
    """Design of the set's runs; `settings`: effects or constants over the plain model."""
    point = [DIAMETER_MM, LENGTH_MM / DIAMETER_MM, TEMPERATURE_K]
    point += [*shots.parameters.values(), *settings.values()]
    return {
        "run_id": np.arange(len(shots.shapes), dtype=np.int64),
        "seed": shots.seeds.astype(np.int64),
        "shape": shots.shapes,
        "inputs": np.array([[velocity, *point] for velocity in shots.velocities]),
        "names": [*SHOT_INPUTS, *shots.parameters, *settings],
    }
