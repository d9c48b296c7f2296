"""The smooth thermodynamic surface of a crystal through points of molecular dynamics.

The free energy of classical atoms in nearly harmonic wells, by atom, V its volume:
    F(V, T) = E0(V) - 3 k T ln T + T f1(V) - a2(V) T^2 - a3(V) T^3 / 2
gives
    E = E0 + 3 k T + a2 T^2 + a3 T^3,    P = -dE0/dV - T df1/dV + T^2 da2/dV + T^3 da3/dV / 2,
so energy, pressure and all moduli belong together exactly. E0 is that of the perfect lattice;
df1/dV, a2 and a3 are polynomials of ln V through all points at once (linear least squares).
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev

BOLTZMANN = 8.617333262e-5  # eV/K
DEGREE_OF_LATTICE = 16
DEGREES_OF_THERMAL_PARTS = (8, 6, 5)  # df1/dV, a2, a3


@dataclass(frozen=True)
class Surface:
    """Functions of y = ln V, V in A^3 by atom; energies in eV, temperatures in K."""

    lattice: Chebyshev  # E0
    linear: Chebyshev  # -df1/dV
    quadratic: Chebyshev  # a2
    cubic: Chebyshev  # a3

    def energy(self, volume, temperature):
        """E [eV] by atom."""
        y, t = np.log(volume), temperature
        thermal = 3 * BOLTZMANN * t + self.quadratic(y) * t**2 + self.cubic(y) * t**3
        return self.lattice(y) + thermal

    def pressure(self, volume, temperature):
        """P [eV/A^3]."""
        y, t = np.log(volume), temperature
        slopes = (-self.lattice.deriv()(y), self.quadratic.deriv()(y), self.cubic.deriv()(y) / 2)
        return (slopes[0] + t**2 * slopes[1] + t**3 * slopes[2]) / volume + t * self.linear(y)

    def heat_capacity(self, volume, temperature):
        """At constant volume [eV/K] by atom."""
        y, t = np.log(volume), temperature
        return 3 * BOLTZMANN + 2 * t * self.quadratic(y) + 3 * t**2 * self.cubic(y)

    def thermal_pressure_slope(self, volume, temperature):
        """(dP/dT) at constant volume [eV/A^3/K]."""
        y, t = np.log(volume), temperature
        slopes = 2 * t * self.quadratic.deriv()(y) + 1.5 * t**2 * self.cubic.deriv()(y)
        return self.linear(y) + slopes / volume

    def isothermal_modulus(self, volume, temperature):
        """-V (dP/dV) at constant temperature [eV/A^3]."""
        y, t = np.log(volume), temperature
        first = [-self.lattice.deriv(), self.quadratic.deriv(), self.cubic.deriv()]
        second = [-self.lattice.deriv(2), self.quadratic.deriv(2), self.cubic.deriv(2)]
        weights = (1, t**2, t**3 / 2)
        bent = sum(w * (s(y) - f(y)) for w, f, s in zip(weights, first, second)) / volume
        return -(bent + t * self.linear.deriv()(y))

    def adiabatic_modulus(self, volume, temperature):
        """-V (dP/dV) at constant entropy [eV/A^3]."""
        slope = self.thermal_pressure_slope(volume, temperature)
        heat = self.heat_capacity(volume, temperature)
        return (
            self.isothermal_modulus(volume, temperature) + temperature * volume * slope**2 / heat
        )

    def gruneisen(self, volume, temperature):
        slope = self.thermal_pressure_slope(volume, temperature)
        return volume * slope / self.heat_capacity(volume, temperature)

    def volume_at(self, pressure, temperature):
        """The volume of one pressure by Newton from the lattice's own of zero pressure."""
        volume = float(np.exp(self.lattice.domain.mean()))
        for _ in range(50):
            excess = self.pressure(volume, temperature) - pressure
            change = volume * excess / self.isothermal_modulus(volume, temperature)
            volume += float(np.clip(change, -0.05 * volume, 0.05 * volume))
            if abs(change) < 1e-12 * volume:
                return volume
        raise ArithmeticError(f"no volume of pressure {pressure} eV/A^3 at {temperature} K")


def fit_lattice(volumes, energies, pressures) -> Chebyshev:
    """E0 through energies and slopes of the perfect lattice alike."""
    y = np.log(volumes)
    domain = [y.min(), y.max()]
    values = _basis(DEGREE_OF_LATTICE, domain, y)
    slopes = _basis(DEGREE_OF_LATTICE, domain, y, derivative=1)
    rows = np.vstack([values, slopes])
    wanted = np.concatenate([energies, -pressures * volumes])
    return Chebyshev(np.linalg.lstsq(rows, wanted, rcond=None)[0], domain)


def fit_surface(lattice: Chebyshev, volumes, temperatures, energies, pressures) -> Surface:
    """`energies` and `pressures` without those of the perfect lattice, kinetic part included.

    Both scatter in proportion to the temperature, so they are divided by it.
    """
    domain, y, t = lattice.domain, np.log(volumes), temperatures
    counts = [degree + 1 for degree in DEGREES_OF_THERMAL_PARTS]
    parts = [_basis(degree, domain, y) for degree in DEGREES_OF_THERMAL_PARTS]
    slopes = [_basis(d, domain, y, derivative=1) for d in DEGREES_OF_THERMAL_PARTS]
    powers = [np.zeros_like(t), t, t**2]
    in_energy = np.hstack([power[:, None] * part for power, part in zip(powers, parts)])
    scale = volumes[:, None]
    in_pressure = np.hstack(
        [parts[0], t[:, None] * slopes[1] / scale, t[:, None] ** 2 * slopes[2] / scale / 2]
    )
    excess = energies / t - 3 * BOLTZMANN
    pressure = pressures / t
    coefficients = np.zeros(sum(counts))
    spread = (1.0, 1.0)
    for _ in range(3):  # The weights of the two kinds come from their own scatter.
        rows = np.vstack([in_energy / spread[0], in_pressure / spread[1]])
        wanted = np.concatenate([excess / spread[0], pressure / spread[1]])
        coefficients = np.linalg.lstsq(rows, wanted, rcond=None)[0]
        spread = (
            np.std(excess - in_energy @ coefficients),
            np.std(pressure - in_pressure @ coefficients),
        )
    split = np.split(coefficients, np.cumsum(counts)[:-1])
    return Surface(lattice, *(Chebyshev(part, domain) for part in split))


PARTS = ("lattice", "linear", "quadratic", "cubic")


def to_document(surface: Surface) -> dict:
    """Coefficients of Chebyshev polynomials over the domain of ln(V/A^3)."""
    parts = {name: getattr(surface, name).coef.tolist() for name in PARTS}
    return {"domain": surface.lattice.domain.tolist(), **parts}


def from_document(document: dict) -> Surface:
    domain = document["domain"]
    return Surface(*(Chebyshev(document[name], domain) for name in PARTS))


def _basis(degree: int, domain, y, derivative: int = 0):
    """Values of the Chebyshev polynomials up to `degree`, one column each."""
    columns = []
    for k in range(degree + 1):
        polynomial = Chebyshev.basis(k, domain)
        columns.append((polynomial.deriv(derivative) if derivative else polynomial)(y))
    return np.stack(columns, axis=-1)
