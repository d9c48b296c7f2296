"""How visible a hidden effect is in a table: its signal beyond what the parameters absorb."""

import numpy as np
from error_model import PlainModel, Shots, beyond_parameters, sensitivities, whiten, whiteners
from make_synthetic_table import NOISE, VELOCITY_NOISE
from specimens import DIAMETER_MM, LENGTH_MM, TEMPERATURE_K, ShotSet

SPECIMEN = {
    "initial_diameter_mm": DIAMETER_MM,
    "length_to_diameter": LENGTH_MM / DIAMETER_MM,
    "initial_temperature_K": TEMPERATURE_K,
}


class SignalTable:
    """A table whitened at some parameters; signals are what those cannot absorb."""

    def __init__(self, network, shots: Shots, parameters: dict):
        theta = np.array(list(parameters.values()))
        self.model, self.theta = PlainModel(network, shots, list(parameters)), theta
        self.roots = whiteners(self.model, theta)
        self.sensitivity = sensitivities(self.model, theta, self.roots)

    @classmethod
    def of_set(cls, network, shots: ShotSet) -> "SignalTable":
        """The table of a set of shots as it is without noise, at the truth."""
        velocities = shots.velocities
        sd = np.ones((len(shots.shapes), len(NOISE)))
        table = Shots(shots.shapes, velocities, VELOCITY_NOISE * velocities, sd, SPECIMEN)
        model = PlainModel(network, table, list(shots.parameters))
        sizes = model.sizes(np.array(list(shots.parameters.values())))
        sd *= sizes * np.array(list(NOISE.values()))
        return cls(network, table, shots.parameters)

    def signal(self, change: np.ndarray) -> np.ndarray:
        """P L^-1 of a change of the sizes [mm], a row a shot."""
        return beyond_parameters(self.sensitivity, whiten(self.roots, change))

    def changes(self, signatures, candidate: str) -> np.ndarray:
        """The change that the signatures predict [mm per unit of amplitude], a row a shot."""
        change = np.empty((len(self.model.shots.shapes), len(NOISE)))
        for shape, chosen in self.model.by_shape():
            points = self.model.points(chosen, self.theta)
            change[chosen] = signatures.change(shape, candidate, points)
        return change

    def identifiability(self, signatures, candidate: str) -> float:
        """|P g| / |g|: 0 where a change of the parameters looks the same."""
        change = self.changes(signatures, candidate)
        whole = np.linalg.norm(whiten(self.roots, change))
        return float(np.linalg.norm(self.signal(change)) / whole) if whole > 0 else 0.0

    def likeness(self, signatures, candidate: str, others: list[str]) -> tuple[str, float]:
        """The other candidate whose signal is most alike, and |cos| between the two."""
        own = self.signal(self.changes(signatures, candidate))
        found = ("", 0.0)
        for other in others:
            its = self.signal(self.changes(signatures, other))
            length = np.linalg.norm(own) * np.linalg.norm(its)
            cosine = float(abs(own @ its) / length) if length > 0 else 0.0
            found = max(found, (other, cosine), key=lambda item: item[1])
        return found


def visible_amplitude(table: SignalTable, signatures, candidate: dict, sigmas: float) -> float:
    """Amplitude whose signal is `sigmas` standard errors; the range may allow less."""
    unit = np.linalg.norm(table.signal(table.changes(signatures, candidate["name"])))
    return float(sigmas / unit) if unit > 0 else float("inf")


def drawn_amplitude(candidate: dict, random: np.random.Generator) -> float:
    """Magnitude drawn from the candidate's prior."""
    prior = candidate["prior"]
    if prior["kind"] == "uniform":
        return float(random.uniform(0, candidate["highest"]))
    return float(abs(random.normal()) * prior["scale"])
