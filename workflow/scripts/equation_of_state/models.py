"""Equations of state by (density [kg/m3], energy [J/kg]), as the solver asks them."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol

import numpy as np
from equation_of_state.surface import Surface, from_document
from equation_of_state.units import AtomicUnits


class State(NamedTuple):
    pressure: np.ndarray  # Pa
    temperature: np.ndarray  # K
    modulus: np.ndarray  # adiabatic [Pa]


class EquationOfState(Protocol):
    def at(self, density, energy) -> State:
        ...


class Network:
    """The network of `emulator train`, after the recipe in its file, in double precision."""

    def __init__(self, document: dict):
        self._inputs = document["inputs"]
        self._outputs = document["outputs"]
        member = document["members"][document["best"]]
        self._layers = [
            (np.array(layer["weights"]), np.array(layer["bias"])) for layer in member["layers"]
        ]

    @classmethod
    def from_file(cls, path: Path) -> "Network":
        return cls(json.loads(Path(path).read_text(encoding="utf-8")))

    def at(self, density, energy) -> State:
        columns = np.broadcast_arrays(density, energy)
        values = np.stack(
            [(c - i["shift"]) / i["scale"] for c, i in zip(columns, self._inputs)], axis=-1
        )
        for index, (weights, bias) in enumerate(self._layers):
            values = values @ weights.T + bias
            if index + 1 < len(self._layers):
                values = values / (1 + np.exp(-values))  # SiLU
        return State(
            *(values[..., k] * o["scale"] + o["shift"] for k, o in enumerate(self._outputs))
        )


@dataclass(frozen=True)
class Dynamics:
    """The smooth surface through molecular dynamics, densities times `scale`."""

    surface: Surface
    units: AtomicUnits
    zero_of_energy: float  # eV by atom
    scale: float = 1.0

    @classmethod
    def from_provenance(cls, provenance: dict, scaled: bool = True) -> "Dynamics":
        """The surface of a provenance.json, of the metal's density or the potential's own."""
        units = AtomicUnits(provenance["settings"]["atomic_mass_g_mol"])
        surface = from_document(provenance["surface"])
        scale = provenance["scale_of_density"] if scaled else 1.0
        return cls(surface, units, provenance["zero_of_energy_eV"], scale)

    def at(self, density, energy) -> State:
        density, energy = np.broadcast_arrays(density, energy)
        volume = self.units.volume(density / self.scale)
        temperature = np.full(density.shape, 300.0)
        for _ in range(30):
            here = self.energy(density, temperature)
            heat = self.units.energy(self.surface.heat_capacity(volume, temperature))
            temperature = temperature + (energy - here) / heat
        return self.at_temperature(density, temperature)

    def at_temperature(self, density, temperature) -> State:
        volume = self.units.volume(density / self.scale)
        pressure = self.surface.pressure(volume, temperature)
        modulus = self.surface.adiabatic_modulus(volume, temperature)
        to_pascal = self.scale * self.units.pressure(1.0)
        return State(pressure * to_pascal, temperature, modulus * to_pascal)

    def energy(self, density, temperature):
        volume = self.units.volume(density / self.scale)
        return self.units.energy(self.surface.energy(volume, temperature) - self.zero_of_energy)


class Analytic:
    """The solver's own copper; solver/material/copper_equation_of_state.hpp explains it."""

    RHO0, C0, SLOPE, GAMMA, HEAT, T0 = 8930.0, 3940.0, 1.489, 1.96, 385.0, 300.0

    def __init__(self):
        rho0, gamma = self.RHO0, self.GAMMA
        modulus = rho0 * self.C0**2
        pressure = -gamma * rho0 * self.HEAT * self.T0
        cold = modulus + gamma * pressure
        curvature = (4 * self.SLOPE - 1) * modulus + gamma * (gamma - 1) * pressure
        self._a = (
            3 * pressure / rho0,
            4.5 * (cold - 5 / 3 * pressure) / rho0,
            4.5 * (curvature - 4 * cold + 35 / 9 * pressure) / rho0,
        )

    def at(self, density, energy) -> State:
        density, energy = np.broadcast_arrays(np.asarray(density, float), energy)
        a1, a2, a3 = self._a
        edge = np.cbrt(density / self.RHO0) ** 2
        f, rate = (edge - 1) / 2, edge / 3
        slope = a1 + f * (2 * a2 + 3 * f * a3)
        cold = density * rate * slope
        modulus = 5 / 3 * cold + density * rate**2 * (2 * a2 + 6 * f * a3)
        heat = energy - f * (a1 + f * (a2 + f * a3)) + self.HEAT * self.T0
        thermal = self.GAMMA * self.RHO0 * heat
        modulus = modulus + self.GAMMA * self.RHO0 / density * thermal
        return State(cold + thermal, heat / self.HEAT, modulus)
