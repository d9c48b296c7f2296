"""What can be measured of a metal, from its equation of state."""

from typing import NamedTuple

import numpy as np
from equation_of_state.models import EquationOfState
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root


class Rest(NamedTuple):
    density: float  # kg/m3
    energy: float  # J/kg


def at_rest(eos: EquationOfState, temperature: float, near: Rest) -> Rest:
    """The state of zero pressure at a temperature."""

    def misses(x):
        state = eos.at(near.density * (1 + x[0]), near.energy + 4e5 * x[1])
        return [float(state.pressure) / 1e11, (float(state.temperature) - temperature) / 1e3]

    found = root(misses, [0.0, 0.0], tol=1e-13)
    if max(abs(value) for value in misses(found.x)) > 1e-9:
        raise ArithmeticError(f"no state of zero pressure at {temperature} K")
    return Rest(near.density * (1 + found.x[0]), near.energy + 4e5 * found.x[1])


def linear_expansion(eos: EquationOfState, temperature: float, near: Rest) -> float:
    """1/K at zero pressure."""
    cold = at_rest(eos, temperature - 10, near)
    hot = at_rest(eos, temperature + 10, near)
    return float(np.log(cold.density / hot.density) / 60)


def heat_capacity(eos: EquationOfState, temperature: float, near: Rest) -> float:
    """At zero pressure [J/kg/K]."""
    cold = at_rest(eos, temperature - 10, near)
    hot = at_rest(eos, temperature + 10, near)
    return (hot.energy - cold.energy) / 20


def gruneisen(eos: EquationOfState, rest: Rest, step: float = 2e4) -> float:
    """(dP/dE)/rho at constant density."""
    above = eos.at(rest.density, rest.energy + step).pressure
    below = eos.at(rest.density, rest.energy - step).pressure
    return float((above - below) / (2 * step) / rest.density)


def shock_speed(eos: EquationOfState, particle_speed: float, rest: Rest) -> float:
    """m/s, from the jump conditions into metal at rest."""

    def excess(speed: float) -> float:
        density = rest.density * speed / (speed - particle_speed)
        energy = rest.energy + 0.5 * particle_speed**2
        momentum = rest.density * speed * particle_speed
        return float(eos.at(density, energy).pressure) - momentum

    return float(brentq(excess, 3300 + 1.35 * particle_speed, 4500 + 1.7 * particle_speed))


def isentrope(eos: EquationOfState, densities: np.ndarray, energy: float) -> np.ndarray:
    """Energies along dE = P/rho^2 drho from `energy` at the first density."""

    def slope(rho, e):
        return [float(eos.at(rho, e[0]).pressure) / rho**2]

    ends = (densities[0], densities[-1])
    path = solve_ivp(slope, ends, [energy], t_eval=densities, rtol=1e-9, atol=1e-3)
    return path.y[0]
