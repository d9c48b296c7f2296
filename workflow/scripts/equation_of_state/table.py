"""The table of states: what molecular dynamics measured beside the smooth surface through it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from atomic_file import write_text
from equation_of_state.isotherms import Isotherm
from equation_of_state.surface import Surface, fit_lattice, fit_surface
from equation_of_state.units import AtomicUnits

COLUMNS = (
    "temperature_K",
    "density_kg_m3",
    "energy_J_kg",  # means of the molecular dynamics
    "pressure_Pa",
    "smooth_energy_J_kg",  # of the surface at this temperature and density
    "smooth_pressure_Pa",
    "bulk_modulus_Pa",  # adiabatic
)
REFERENCE_TEMPERATURE = 300  # K; the energy is zero there at zero pressure


@dataclass(frozen=True)
class States:
    """Rows of the table, one array a column of COLUMNS; densities of the potential's own metal."""

    columns: dict[str, np.ndarray]
    reference_density: float  # at zero pressure and 300 K [kg/m3]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]


def surface_through(isotherms: list[Isotherm]) -> Surface:
    longest = max(isotherms, key=lambda isotherm: len(isotherm.volume))
    lattice = fit_lattice(longest.volume, longest.lattice_energy, longest.lattice_pressure)
    joined = {
        name: np.concatenate([getattr(isotherm, name) for isotherm in isotherms])
        for name in ("volume", "thermal_energy", "thermal_pressure")
    }
    temperatures = np.concatenate(
        [np.full(len(isotherm.volume), isotherm.temperature) for isotherm in isotherms]
    )
    return fit_surface(
        lattice,
        joined["volume"],
        temperatures,
        joined["thermal_energy"],
        joined["thermal_pressure"],
    )


def states_of(isotherms: list[Isotherm], surface: Surface, units: AtomicUnits) -> States:
    resting = surface.volume_at(0, REFERENCE_TEMPERATURE)
    zero = surface.energy(resting, REFERENCE_TEMPERATURE)
    parts = []
    for isotherm in isotherms:
        v, t = isotherm.volume, isotherm.temperature
        parts.append(
            (
                np.full(len(v), float(t)),
                units.density(v),
                units.energy(isotherm.lattice_energy + isotherm.thermal_energy - zero),
                units.pressure(isotherm.lattice_pressure + isotherm.thermal_pressure),
                units.energy(surface.energy(v, t) - zero),
                units.pressure(surface.pressure(v, t)),
                units.pressure(surface.adiabatic_modulus(v, t)),
            )
        )
    arrays = [np.concatenate(column) for column in zip(*parts)]
    return States(dict(zip(COLUMNS, arrays)), units.density(resting))


def write_states(path: Path, states: States) -> None:
    lines = [",".join(COLUMNS)]
    for row in zip(*(states[name] for name in COLUMNS)):
        lines.append(",".join(f"{value:.9g}" for value in row))
    write_text(path, "\n".join(lines) + "\n")


def read_states(path: Path, reference_density: float) -> States:
    table = np.genfromtxt(path, delimiter=",", names=True)
    return States({name: table[name] for name in COLUMNS}, reference_density)
