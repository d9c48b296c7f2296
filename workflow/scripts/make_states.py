"""Writes the table of states, the database of them and where they come from."""

import platform
import subprocess
from datetime import date
from pathlib import Path

import numpy as np
from equation_of_state.database import learnt_rows, write_database
from equation_of_state.isotherms import ATOMS, Isotherm, read_isotherm
from equation_of_state.models import Dynamics
from equation_of_state.surface import Surface, to_document
from equation_of_state.table import (
    REFERENCE_TEMPERATURE,
    States,
    states_of,
    surface_through,
    write_states,
)
from equation_of_state.units import AtomicUnits
from file_digest import sha256_of
from json_file import write_json
from stage_log import logged_to


def lammps_version() -> str:
    told = subprocess.run(["lmp", "-h"], capture_output=True, text=True, check=True).stdout
    return next(line.strip() for line in told.splitlines() if "Simulator" in line)


def processor() -> str:
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    return next((x.split(": ")[1] for x in lines if x.startswith("model name")), "unknown")


def scatter(isotherms: list[Isotherm], surface: Surface, units: AtomicUnits) -> list[dict]:
    """By isotherm: RMS distance of the means of molecular dynamics from the surface."""
    rows = []
    for i in isotherms:
        energy = i.lattice_energy + i.thermal_energy - surface.energy(i.volume, i.temperature)
        pressure = i.lattice_pressure + i.thermal_pressure
        pressure = pressure - surface.pressure(i.volume, i.temperature)
        rows.append(
            {
                "temperature_K": i.temperature,
                "points": len(i.volume),
                "energy_J_kg": float(units.energy(np.sqrt(np.mean(energy**2)))),
                "mean_energy_J_kg": float(units.energy(np.mean(energy))),
                "pressure_MPa": float(units.pressure(np.sqrt(np.mean(pressure**2))) / 1e6),
                "mean_pressure_MPa": float(units.pressure(np.mean(pressure)) / 1e6),
                "lowest_pressure_GPa": float(
                    units.pressure(np.min(surface.pressure(i.volume, i.temperature))) / 1e9
                ),
            }
        )
    return rows


def provenance(settings: dict, potential: Path, states: States, isotherms, surface) -> dict:
    units = AtomicUnits(settings["atomic_mass_g_mol"])
    shipped = Path(settings["potential"])
    resting = surface.volume_at(0, REFERENCE_TEMPERATURE)
    return {
        "schema": "taylorcal/equation_of_state/1",
        "settings": settings,
        "atoms": ATOMS,
        "simulator": lammps_version(),
        "machine": f"{processor()}, {platform.system()} {platform.machine()}, 1 core",
        "date": date.today().isoformat(),
        "potential_sha256": sha256_of(shipped),
        "embedded_atoms_sha256": sha256_of(potential),
        "zero_of_energy": "300 K and zero pressure on the smooth surface",
        "zero_of_energy_eV": float(surface.energy(resting, REFERENCE_TEMPERATURE)),
        "density_of_molecular_dynamics_kg_m3": states.reference_density,
        "scale_of_density": settings["density_kg_m3"] / states.reference_density,
        "scatter_about_the_surface": scatter(isotherms, surface, units),
        "surface": to_document(surface),
    }


def main(settings: dict, lattice, moving, potential, outputs) -> None:
    temperatures = settings["temperatures_K"]
    isotherms = [
        read_isotherm(float(t), Path(a), Path(b)) for t, a, b in zip(temperatures, lattice, moving)
    ]
    surface = surface_through(isotherms)
    states = states_of(isotherms, surface, AtomicUnits(settings["atomic_mass_g_mol"]))
    record = provenance(settings, Path(potential), states, isotherms, surface)
    learnt = learnt_rows(
        Dynamics.from_provenance(record), states, settings["learnt_temperatures_K"]
    )
    write_states(Path(outputs.table), states)
    write_database(Path(outputs.database), *learnt)
    write_json(outputs.provenance, record)


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        main(
            snakemake.params.settings,  # noqa: F821
            snakemake.input.lattice,  # noqa: F821
            snakemake.input.moving,  # noqa: F821
            snakemake.input.potential,  # noqa: F821
            snakemake.output,  # noqa: F821
        )
