"""States of the smooth surface as a database that `emulator train` learns from."""

from pathlib import Path

import h5py
import numpy as np
from atomic_file import written_whole
from equation_of_state.models import Dynamics
from equation_of_state.table import States

INPUTS = ("density_kg_m3", "energy_J_kg")
OUTPUTS = ("pressure_Pa", "temperature_K", "bulk_modulus_Pa")


def learnt_densities(states: States) -> np.ndarray:
    """Densities of molecular dynamics at which every isotherm still has a crystal."""
    temperatures, densities = states["temperature_K"], states["density_kg_m3"]
    loosest = max(densities[temperatures == t].min() for t in np.unique(temperatures))
    return np.unique(densities[densities >= loosest])


def learnt_rows(dynamics: Dynamics, states: States, temperatures) -> tuple[np.ndarray, np.ndarray]:
    """Inputs and outputs, one row a state, densities scaled as `dynamics` says."""
    density, temperature = (
        grid.ravel()
        for grid in np.meshgrid(
            learnt_densities(states) * dynamics.scale, np.array(temperatures, float)
        )
    )
    state = dynamics.at_temperature(density, temperature)
    energy = dynamics.energy(density, temperature)
    return np.stack([density, energy], axis=1), np.stack(state, axis=1)


def write_database(path: Path, inputs: np.ndarray, outputs: np.ndarray) -> None:
    with written_whole(path) as partial, h5py.File(partial, "w") as file:
        file.attrs["schema"] = "taylorcal/database/1"
        file["run_id"] = np.arange(len(inputs), dtype=np.int64)
        file["status"] = np.zeros(len(inputs), dtype=np.int64)
        for name, names, rows in (("inputs", INPUTS, inputs), ("outputs", OUTPUTS, outputs)):
            file[name] = rows
            file[name].attrs["names"] = list(names)
