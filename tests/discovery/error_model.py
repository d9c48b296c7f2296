"""Whitened sizes of a table: residuals, sensitivities and what the parameters cannot absorb.

C = diag(sd^2) + (df/dv)(df/dv)^T sd_v^2 + E_shape for each shot, as the calibration has it.
"""

from dataclasses import dataclass

import numpy as np

VELOCITY_STEP = 0.01  # relative, central difference for df/dv
PARAMETER_STEP = 0.02  # of a parameter's range


@dataclass(frozen=True)
class Shots:
    """Shots as a table tells them: `velocities` measured, sd [mm] a row a shot."""

    shapes: list
    velocities: np.ndarray
    velocity_sd: np.ndarray
    sd: np.ndarray
    specimen: dict  # diameter, length over diameter, temperature

    def subset(self, chosen: np.ndarray) -> "Shots":
        shapes = [shape for shape, keep in zip(self.shapes, chosen, strict=True) if keep]
        parts = (self.velocities[chosen], self.velocity_sd[chosen], self.sd[chosen])
        return Shots(shapes, *parts, self.specimen)


class PlainModel:
    """The network over all shots of a table."""

    def __init__(self, network, shots: Shots, parameters: list[str]):
        self.network, self.shots, self.parameters = network, shots, parameters

    def sizes(self, theta: np.ndarray, factor: float = 1.0) -> np.ndarray:
        """Sizes [mm], a row a shot, with all velocities times `factor`."""
        shown = np.empty((len(self.shots.shapes), len(self.network.outputs)))
        for shape, chosen in self.by_shape():
            shown[chosen] = self.network.sizes(shape, self.points(chosen, theta, factor))
        return shown

    def points(self, chosen: np.ndarray, theta: np.ndarray, factor: float = 1.0) -> dict:
        values = dict(zip(self.parameters, theta, strict=True))
        speeds = self.shots.velocities[chosen] * factor
        return {"velocity_m_s": speeds, **self.shots.specimen, **values}

    def by_shape(self):
        names = np.array(self.shots.shapes)
        for shape in dict.fromkeys(self.shots.shapes):
            yield shape, names == shape


def whiteners(model: PlainModel, theta: np.ndarray) -> np.ndarray:
    """L^-1 of each shot's covariance C = L L^T; shape (shots, sizes, sizes)."""
    step = model.sizes(theta, 1 + VELOCITY_STEP) - model.sizes(theta, 1 - VELOCITY_STEP)
    slope = step / (2 * VELOCITY_STEP * model.shots.velocities[:, None])
    slope *= model.shots.velocity_sd[:, None]
    covariances = slope[:, :, None] * slope[:, None, :]
    for index, shape in enumerate(model.shots.shapes):
        covariances[index] += np.diag(model.shots.sd[index] ** 2)
        covariances[index] += model.network.covariance(shape, model.shots.specimen)
    return np.linalg.inv(np.linalg.cholesky(covariances))


def whiten(inverse_roots: np.ndarray, sizes: np.ndarray) -> np.ndarray:
    """All sizes of all shots as one whitened vector."""
    return np.einsum("nij,nj->ni", inverse_roots, sizes).ravel()


def sensitivities(model: PlainModel, theta: np.ndarray, inverse_roots: np.ndarray) -> np.ndarray:
    """J: whitened df/dtheta, a column a parameter, for steps of its whole range."""
    columns = []
    for index, name in enumerate(model.parameters):
        step = np.zeros_like(theta)
        lowest, highest = model.network.ranges[name]
        step[index] = min(PARAMETER_STEP * (highest - lowest), 0.1 * theta[index])
        rise = model.sizes(theta + step) - model.sizes(theta - step)
        columns.append(whiten(inverse_roots, rise / (2 * step[index])) * (highest - lowest))
    return np.stack(columns, axis=1)


def beyond_parameters(sensitivity: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """P g: the part of a whitened vector that no change of parameters makes."""
    basis, _ = np.linalg.qr(sensitivity)
    return vector - basis @ (basis.T @ vector)
