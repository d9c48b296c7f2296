"""Atomic units of the molecular dynamics (eV, A, atoms) in SI units by mass."""

from dataclasses import dataclass

ELEMENTARY_CHARGE = 1.602176634e-19  # C
DALTON = 1.66053906660e-27  # kg
PASCAL_A_EV_PER_A3 = ELEMENTARY_CHARGE * 1e30


@dataclass(frozen=True)
class AtomicUnits:
    mass: float  # of an atom [g/mol]

    def density(self, volume):
        """kg/m3 of A^3 by atom."""
        return self.mass * DALTON / (volume * 1e-30)

    def volume(self, density):
        """A^3 by atom of kg/m3."""
        return self.mass * DALTON / density * 1e30

    def energy(self, energy):
        """J/kg, or J/kg/K, of eV, or eV/K, by atom."""
        return energy * ELEMENTARY_CHARGE / (self.mass * DALTON)

    @staticmethod
    def pressure(pressure):
        """Pa of eV/A^3."""
        return pressure * PASCAL_A_EV_PER_A3
