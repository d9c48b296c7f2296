"""What each candidate changes in the sizes of a shot, smooth in velocity and parameters.

From paired runs (same specimen and grains, one candidate changed): for each shape,
candidate and size a small regression of the change for a unit of amplitude.
"""

from pathlib import Path

import h5py
import numpy as np

SHOT = "velocity_m_s"


class SignatureModel:
    """d_k(shape, v, theta) [mm per unit of amplitude] for the candidates of a study."""

    def __init__(self, pairs: dict, parameters: list[str]):
        self._parameters = parameters
        self._centre, self._width = _scaling(pairs, parameters)
        self._fits = {key: self._fit(*table) for key, table in pairs.items()}

    def change(self, shape: str, candidate: str, points: dict) -> np.ndarray:
        """Sizes' change [mm per unit], one row a point, columns as the signatures' outputs."""
        columns = [points[SHOT], *(points[name] for name in self._parameters)]
        columns = np.stack(np.broadcast_arrays(*columns), axis=-1)
        return self._features(np.atleast_2d(columns)) @ self._fits[shape, candidate]

    def _features(self, columns: np.ndarray) -> np.ndarray:
        """1, v, v^2 and the parameters, all scaled to about -1..1."""
        scaled = (_shown(columns, self._parameters) - self._centre) / self._width
        speed = scaled[:, :1]
        return np.hstack([np.ones_like(speed), scaled, speed**2])

    def _fit(self, columns: np.ndarray, changes: np.ndarray) -> np.ndarray:
        features = self._features(columns)
        # A weak ridge: a dozen pairs would leave some direction nearly free.
        ridge = 1e-3 * len(features) * np.eye(features.shape[1])
        ridge[0, 0] = 0
        return np.linalg.solve(features.T @ features + ridge, features.T @ changes)


def read_pairs(path: Path, candidates: list[dict], parameters: list[str], sizes: list[str]) -> dict:
    """(shape, candidate) -> (velocity and parameters, changes [mm per unit]) of finished pairs."""
    with h5py.File(path) as file:
        shape, seed = file["shape"].asstr()[:], file["seed"][:]
        inputs, names = file["inputs"][:], list(file["inputs"].attrs["names"])
        outputs = file["outputs"][:]
        columns = [list(file["outputs"].attrs["names"]).index(size) for size in sizes]
        finished = file["status"][:] == 0
    shown = inputs[:, [names.index(name) for name in [SHOT, *parameters]]]
    away = np.stack(
        [inputs[:, names.index(item["name"])] - item["base"] for item in candidates], axis=1
    )
    plain = {}
    for row in np.flatnonzero(finished & ~away.any(axis=1)):
        plain[shape[row], seed[row], *shown[row]] = outputs[row, columns]
    pairs: dict = {}
    for row in np.flatnonzero(finished & (np.count_nonzero(away, axis=1) == 1)):
        base = plain.get((shape[row], seed[row], *shown[row]))
        if base is not None:
            which = int(np.flatnonzero(away[row])[0])
            change = (outputs[row, columns] - base) / away[row, which]
            pairs.setdefault((shape[row], candidates[which]["name"]), []).append(
                (shown[row], change)
            )
    return {
        key: tuple(np.array(part) for part in zip(*rows, strict=True))
        for key, rows in pairs.items()
    }


def _shown(columns: np.ndarray, parameters: list[str]) -> np.ndarray:
    """Densities by their logarithm."""
    shown = np.array(columns, dtype=float)
    for index, name in enumerate(parameters):
        if name.startswith("rho_"):
            shown[:, index + 1] = np.log10(shown[:, index + 1])
    return shown


def _scaling(pairs: dict, parameters: list[str]) -> tuple[np.ndarray, np.ndarray]:
    everything = _shown(np.vstack([columns for columns, _ in pairs.values()]), parameters)
    lowest, highest = everything.min(axis=0), everything.max(axis=0)
    return (lowest + highest) / 2, np.maximum((highest - lowest) / 2, 1e-12)
