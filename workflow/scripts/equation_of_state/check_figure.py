"""Molecular dynamics, network and analytic copper beside measured copper, drawn."""

from pathlib import Path

import matplotlib
import numpy as np
from equation_of_state import checks, properties
from equation_of_state.properties import Rest
from equation_of_state.table import States

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"scaled": "#7f7f7f", "network": "#d62728", "analytic": "#1f77b4"}
WORDS = {"scaled": "molecular dynamics", "network": "network", "analytic": "analytic"}
STYLES = {"scaled": "-", "network": "--", "analytic": "-"}


def draw(path: Path, states: States, scale: float, models: dict, metal: Rest) -> None:
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.2), constrained_layout=True)
    _isotherms(axes[0, 0], states, scale, models["network"])
    _hugoniot(axes[0, 1], models, metal)
    _modulus(axes[1, 0], models, metal)
    _expansion(axes[1, 1], models, metal)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _isotherms(axis, states: States, scale: float, network) -> None:
    for temperature, colour in ((300, "#1f77b4"), (700, "#ff7f0e"), (1300, "#d62728")):
        rows = states["temperature_K"] == temperature
        if not rows.any():
            continue
        density = states["density_kg_m3"][rows] * scale
        pressure = states["pressure_Pa"][rows] * scale / 1e9
        axis.plot(density, pressure, ".", color=colour, ms=6, alpha=0.35, label=f"{temperature} K")
        answer = network.at(density, states["smooth_energy_J_kg"][rows]).pressure / 1e9
        axis.plot(density, answer, color="black", lw=0.7)
    axis.plot([], [], color="black", lw=0.7, label="network")
    axis.set(xlabel="density, kg/m3", ylabel="pressure, GPa")
    axis.set_title("Isotherms: molecular dynamics (points), network (lines)", fontsize=10)
    axis.legend(fontsize=8)


def _hugoniot(axis, models: dict, metal: Rest) -> None:
    up = checks.PARTICLE_SPEEDS
    measured = checks.measured_shock_speed(up)
    axis.axhline(0, color="black", lw=1, label="measured, Us = 3.94 + 1.489 up")
    for name, model in models.items():
        off = 100 * (checks.hugoniot(model, metal) / measured - 1)
        axis.plot(up, off, STYLES[name], color=COLOURS[name], label=WORDS[name])
    axis.set(xlabel="particle speed, m/s (1200: 61 GPa)", ylabel="error of the shock speed, %")
    axis.set_ylim(-3, 3)
    axis.set_title("Hugoniot from 300 K", fontsize=10)
    axis.legend(fontsize=8)


def _modulus(axis, models: dict, metal: Rest) -> None:
    density = metal.density * np.linspace(0.93, 1.35, 106)
    start = int(np.argmin(np.abs(density - metal.density)))
    for name, model in models.items():
        above = properties.isentrope(model, density[start:], 0.0)
        below = properties.isentrope(model, density[start::-1], 0.0)
        energy = np.concatenate([below[:0:-1], above])
        state = model.at(density, energy)
        axis.plot(
            state.pressure / 1e9,
            state.modulus / 1e9,
            STYLES[name],
            color=COLOURS[name],
            label=WORDS[name],
        )
    known = checks.MEASURED["bulk_modulus_GPa"]
    axis.plot([0], [known], "k+", ms=10, label="measured at zero pressure")
    axis.set(xlabel="pressure, GPa", ylabel="adiabatic bulk modulus, GPa")
    axis.set_title("Isentrope from 300 K", fontsize=10)
    axis.legend(fontsize=8)


def _expansion(axis, models: dict, metal: Rest) -> None:
    temperatures = np.arange(120, 1281, 40)
    for name, model in models.items():
        near, strain = metal, []
        for temperature in temperatures:
            near = properties.at_rest(model, float(temperature), near)
            strain.append(100 * np.log(metal.density / near.density) / 3)
        axis.plot(temperatures, strain, STYLES[name], color=COLOURS[name], label=WORDS[name])
    reach = np.array([200, 400])
    known = checks.MEASURED["linear_expansion_1e-6_per_K"]
    axis.plot(reach, 1e-4 * known * (reach - 300), "k", lw=2, label="measured slope at 300 K")
    axis.set(xlabel="temperature, K", ylabel="linear expansion from 300 K, %")
    axis.set_title("Zero pressure", fontsize=10)
    axis.legend(fontsize=8)
