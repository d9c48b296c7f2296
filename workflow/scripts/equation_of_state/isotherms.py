"""Reads the isotherms that molecular dynamics left."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from equation_of_state.surface import BOLTZMANN

ATOMS = 500
CELLS_ALONG_AN_EDGE = 5
PER_BAR = 6.241509074e-7  # 1 bar in eV/A^3
# A walk along an isotherm ends where atoms leave their sites: mean square displacement within a
# point's time over the square of the distance of neighbours. It is twice that about the sites, so
# this is a Lindemann ratio of 0.17; copper melts at 0.13 when it has a surface to melt from.
LOST_SITE = 0.055
POINTS_BEFORE = 4  # that led there


@dataclass
class Isotherm:
    """Points of one temperature as far as the crystal holds; eV and A by atom."""

    temperature: float
    volume: np.ndarray
    lattice_energy: np.ndarray
    lattice_pressure: np.ndarray
    thermal_energy: np.ndarray  # beyond the lattice's, with the kinetic part
    thermal_pressure: np.ndarray


def read_isotherm(temperature: float, lattice_file: Path, moving_file: Path) -> Isotherm:
    """The potential parts of N atoms are those of N - 1 free ones: the crystal as a whole rests."""
    lattice = np.loadtxt(lattice_file, ndmin=2)
    moving = np.loadtxt(moving_file, ndmin=2)
    edge = moving[:, 0]
    spacing = edge / CELLS_ALONG_AN_EDGE / np.sqrt(2)
    lost = np.flatnonzero(moving[:, 3] > LOST_SITE * spacing**2)
    moving = moving[: max(lost[0] - POINTS_BEFORE, 0)] if lost.size else moving
    lattice = lattice[: len(moving)]
    if not np.allclose(lattice[:, 0], moving[:, 0], rtol=1e-9):
        raise ValueError(f"{moving_file}: edges are not those of {lattice_file}. Run it anew.")
    volume = moving[:, 0] ** 3 / ATOMS
    free = ATOMS / (ATOMS - 1)
    potential = (moving[:, 1] - lattice[:, 1]) * free
    virial = (moving[:, 2] - lattice[:, 2]) * PER_BAR * free
    kinetic = BOLTZMANN * temperature
    return Isotherm(
        temperature,
        volume,
        lattice[:, 1],
        lattice[:, 2] * PER_BAR,
        potential + 1.5 * kinetic,
        virial + kinetic / volume,
    )
