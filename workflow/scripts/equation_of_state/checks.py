"""Numbers that tell how good an equation of state is: beside measured copper, and within itself."""

import numpy as np
from equation_of_state import properties
from equation_of_state.models import EquationOfState
from equation_of_state.properties import Rest

# Copper at 300 K. Density and Hugoniot: Marsh (ed.), LASL Shock Hugoniot Data, 1980. Modulus:
# Overton and Gaffney, Phys. Rev. 98, 969 (1955). Expansion: Touloukian et al., Thermophysical
# Properties of Matter 12, 1975. Heat: Arblaster, J. Phase Equilib. Diffus. 36, 422 (2015).
MEASURED = {
    "density_kg_m3": 8930,
    "bulk_modulus_GPa": 137.1,
    "bulk_sound_speed_m_s": 3918,
    "linear_expansion_1e-6_per_K": 16.6,
    "heat_capacity_J_kg_K": 385,
    "gruneisen": 1.99,
}
# The last two follow from the others: c = sqrt(K/rho), Gamma = 3 alpha K/(rho cp).


def measured_shock_speed(particle_speed):
    return 3940 + 1.489 * particle_speed


HOTTEST_LEARNT = 1300  # K
# To 60 GPa.
PARTICLE_SPEEDS = np.array([100, 200, 400, 600, 800, 1000, 1200])


def at_room(eos: EquationOfState, near: Rest) -> dict[str, float]:
    rest = properties.at_rest(eos, 300, near)
    modulus = float(eos.at(rest.density, rest.energy).modulus)
    return {
        "density_kg_m3": rest.density,
        "bulk_modulus_GPa": modulus / 1e9,
        "bulk_sound_speed_m_s": float(np.sqrt(modulus / rest.density)),
        "linear_expansion_1e-6_per_K": 1e6 * properties.linear_expansion(eos, 300, near),
        "heat_capacity_J_kg_K": properties.heat_capacity(eos, 300, near),
        "gruneisen": properties.gruneisen(eos, rest),
    }


def hugoniot(eos: EquationOfState, near: Rest) -> np.ndarray:
    rest = properties.at_rest(eos, 300, near)
    return np.array([properties.shock_speed(eos, float(up), rest) for up in PARTICLE_SPEEDS])


def own_modulus(eos: EquationOfState, density, energy):
    """rho (dP/drho) at constant entropy, from the pressure alone."""
    d, e = 5.0, 5e3  # kg/m3, J/kg
    by_density = (eos.at(density + d, energy).pressure - eos.at(density - d, energy).pressure) / d
    by_energy = (eos.at(density, energy + e).pressure - eos.at(density, energy - e).pressure) / e
    pressure = eos.at(density, energy).pressure
    return (density * by_density + pressure / density * by_energy) / 2


def gruneisen_of_pressure_and_of_temperature(eos: EquationOfState, density, energy):
    """(dP/dE)/rho, and d ln T/d ln rho on the isentrope: one number if an entropy exists."""
    d, e = 5.0, 5e3
    of_pressure = eos.at(density, energy + e).pressure - eos.at(density, energy - e).pressure
    here = eos.at(density, energy)
    by_density = eos.at(density + d, energy).temperature - eos.at(density - d, energy).temperature
    by_energy = eos.at(density, energy + e).temperature - eos.at(density, energy - e).temperature
    along = by_density / (2 * d) + here.pressure / density**2 * by_energy / (2 * e)
    return of_pressure / (2 * e) / density, density / here.temperature * along


def consistency(eos: EquationOfState, density, energy) -> dict[str, float]:
    """Root mean squares and largest values over states."""
    modulus = eos.at(density, energy).modulus
    error = modulus / own_modulus(eos, density, energy) - 1
    first, second = gruneisen_of_pressure_and_of_temperature(eos, density, energy)
    return {
        "modulus_rms_percent": 100 * rms(error),
        "modulus_largest_percent": 100 * float(np.abs(error).max()),
        "gruneisen_rms": rms(first - second),
        "gruneisen_largest": float(np.abs(first - second).max()),
    }


def isentropes(network: EquationOfState, dynamics: EquationOfState, near: Rest) -> list[dict]:
    """The network's isentropes from rest, by P dV, beside those of molecular dynamics."""
    rows = []
    for temperature in (300.0, 700.0, 1200.0):
        start = properties.at_rest(dynamics, temperature, near)
        for share, steps in ((0.96, 60), (1.05, 60), (1.30, 240)):
            densities = np.linspace(start.density, start.density * share, steps)
            ours = properties.isentrope(network, densities, start.energy)
            theirs = properties.isentrope(dynamics, densities, start.energy)
            last = densities[-1]
            known, ours_there = dynamics.at(last, theirs[-1]), network.at(last, ours[-1])
            if known.temperature > HOTTEST_LEARNT + 50:
                continue
            rows.append(
                {
                    "temperature_K": temperature,
                    "density_ratio": share,
                    "pressure_GPa": float(known.pressure) / 1e9,
                    "work_kJ_kg": (theirs[-1] - start.energy) / 1e3,
                    "work_error_J_kg": ours[-1] - theirs[-1],
                    "temperature_end_K": float(known.temperature),
                    "temperature_error_K": float(ours_there.temperature - known.temperature),
                    "pressure_error_MPa": float(ours_there.pressure - known.pressure) / 1e6,
                }
            )
    return rows


def rms(values) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
