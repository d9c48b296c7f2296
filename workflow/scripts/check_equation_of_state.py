"""Sets molecular dynamics, the network and the analytic copper beside measured copper."""

from pathlib import Path

import h5py
import numpy as np
from atomic_file import write_text
from equation_of_state import checks, check_figure
from equation_of_state.models import Analytic, Dynamics, Network
from equation_of_state.properties import Rest
from equation_of_state.table import read_states
from json_file import read_json
from stage_log import logged_to

TITLES = {
    "density_kg_m3": "density, kg/m3",
    "bulk_modulus_GPa": "adiabatic bulk modulus, GPa",
    "bulk_sound_speed_m_s": "sound speed sqrt(K/rho), m/s",
    "linear_expansion_1e-6_per_K": "linear expansion, 1e-6/K",
    "heat_capacity_J_kg_K": "heat capacity at P = 0, J/kg/K",
    "gruneisen": "Grueneisen coefficient",
}


def room_table(models: dict, near: dict) -> list[str]:
    values = {name: checks.at_room(model, near[name]) for name, model in models.items()}
    lines = ["| at 300 K, zero pressure | measured | " + " | ".join(models) + " |"]
    lines.append("|---" * (len(models) + 2) + "|")
    for key, title in TITLES.items():
        cells = [f"{values[name][key]:.5g}" for name in models]
        lines.append(f"| {title} | {checks.MEASURED[key]:g} | " + " | ".join(cells) + " |")
    return lines


def hugoniot_table(models: dict, near: dict) -> list[str]:
    measured = checks.measured_shock_speed(checks.PARTICLE_SPEEDS)
    lines = ["| up, m/s | P measured, GPa | Us measured, m/s | " + " | ".join(models) + " |"]
    lines.append("|---" * (len(models) + 3) + "|")
    speeds = {name: checks.hugoniot(model, near[name]) for name, model in models.items()}
    for k, up in enumerate(checks.PARTICLE_SPEEDS):
        off = [f"{100 * (speeds[name][k] / measured[k] - 1):+.2f} %" for name in models]
        pressure = 8930 * measured[k] * up / 1e9
        lines.append(f"| {up} | {pressure:.1f} | {measured[k]:.0f} | " + " | ".join(off) + " |")
    return lines


def consistency_table(network: Network, inputs, outputs) -> list[str]:
    density, energy = inputs.T
    pressure, temperature, _ = outputs.T
    parts = {
        "all rows": np.ones(len(density), bool),
        "without the outer 5 % of the densities": (density > np.quantile(density, 0.05))
        & (density < np.quantile(density, 0.95)),
        "Taylor tests: within 5 GPa of zero pressure, 150-1250 K": (np.abs(pressure) < 5e9)
        & (temperature > 150)
        & (temperature < 1250),
    }
    lines = [
        "| rows | n | K beside rho dP/drho at constant S: RMS, largest | Grueneisen"
        " coefficient of P less that of T: RMS, largest |",
        "|---|---|---|---|",
    ]
    for title, rows in parts.items():
        c = checks.consistency(network, density[rows], energy[rows])
        lines.append(
            f"| {title} | {rows.sum()} | {c['modulus_rms_percent']:.2f} %,"
            f" {c['modulus_largest_percent']:.1f} % | {c['gruneisen_rms']:.3f},"
            f" {c['gruneisen_largest']:.2f} |"
        )
    return lines


def error_table(network: Network, inputs, outputs) -> list[str]:
    answers = np.stack(network.at(*inputs.T), axis=-1)
    error = answers - outputs
    units = (("P, MPa", 1e6), ("T, K", 1.0), ("K, MPa", 1e6))
    lines = ["| network less its rows | RMS | largest |", "|---|---|---|"]
    for k, (title, unit) in enumerate(units):
        largest = np.abs(error[:, k]).max() / unit
        lines.append(f"| {title} | {checks.rms(error[:, k]) / unit:.3g} | {largest:.3g} |")
    return lines


def isentrope_table(network: Network, dynamics: Dynamics, near: Rest) -> list[str]:
    lines = [
        "| from rest at | to rho/rho_rest | P, GPa | work, kJ/kg | error of the work, J/kg |"
        " of T, K | of P, MPa |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in checks.isentropes(network, dynamics, near):
        lines.append(
            f"| {row['temperature_K']:.0f} K | {row['density_ratio']:g} | {row['pressure_GPa']:.1f}"
            f" | {row['work_kJ_kg']:.1f} | {row['work_error_J_kg']:+.0f}"
            f" | {row['temperature_error_K']:+.2f} | {row['pressure_error_MPa']:+.0f} |"
        )
    return lines


def main(inputs, outputs) -> None:
    provenance = read_json(inputs.provenance)
    scale = provenance["scale_of_density"]
    dynamics = Dynamics.from_provenance(provenance)
    network = Network.from_file(Path(inputs.network))
    metal = Rest(provenance["settings"]["density_kg_m3"], 0.0)
    models = {
        "molecular dynamics": Dynamics.from_provenance(provenance, scaled=False),
        "scaled": dynamics,
        "network": network,
        "analytic": Analytic(),
    }
    near = dict.fromkeys(models, metal)
    near["molecular dynamics"] = Rest(provenance["density_of_molecular_dynamics_kg_m3"], 0.0)
    with h5py.File(inputs.database) as file:
        rows = file["inputs"][:], file["outputs"][:]
    parts = [
        ("Beside measured copper", room_table(models, near)),
        ("Hugoniot: error of the shock speed", hugoniot_table(models, near)),
        ("What the network answers for its rows", error_table(network, *rows)),
        ("Whether the network's answers belong together", consistency_table(network, *rows)),
        ("Along isentropes, dE = P/rho^2 drho", isentrope_table(network, dynamics, metal)),
    ]
    text = "\n\n".join("## " + title + "\n" + "\n".join(lines) for title, lines in parts)
    write_text(outputs.table, text + "\n")
    states = read_states(Path(inputs.table), provenance["density_of_molecular_dynamics_kg_m3"])
    del models["molecular dynamics"]
    check_figure.draw(Path(outputs.figure), states, scale, models, metal)


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        main(snakemake.input, snakemake.output)  # noqa: F821
