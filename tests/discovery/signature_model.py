"""What each candidate changes in the sizes of a shot, smooth in velocity and parameters.

From paired runs (same specimen and grains, one candidate changed): for each shape,
candidate and size a small regression of the change for a unit of amplitude, which itself
varies with the amplitude where several were run.
"""

from pathlib import Path

import h5py
import numpy as np

SHOT = "velocity_m_s"
BEYOND = 1.5  # half widths from the middle of the amplitudes run: further the bend is held


class SignatureModel:
    """d_k(shape, v, theta, kappa) [mm per unit of amplitude] for the candidates of a study."""

    def __init__(self, pairs: dict, parameters: list[str]):
        self._parameters = parameters
        self._centre, self._width = _scaling(pairs, parameters)
        self._amplitudes = {key: _middle(amplitudes) for key, (_, amplitudes, _) in pairs.items()}
        self._fits = {key: self._fit(key, *table) for key, table in pairs.items()}

    def change(self, shape: str, candidate: str, points: dict, amplitude=None) -> np.ndarray:
        """Sizes' change [mm per unit], one row a point, columns as the signatures' outputs.

        Of `amplitude`; by default of the middle one of the runs.
        """
        columns = [points[SHOT], *(points[name] for name in self._parameters)]
        columns = np.atleast_2d(np.stack(np.broadcast_arrays(*columns), axis=-1))
        key = shape, candidate
        if amplitude is None:
            amplitude = self._amplitudes[key][0]
        return self._features(key, columns, np.full(len(columns), amplitude)) @ self._fits[key]

    def _features(self, key, columns: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
        """1, v, v^2, the parameters and the amplitude, all scaled to about -1..1."""
        scaled = (_shown(columns, self._parameters) - self._centre) / self._width
        middle, half_width = self._amplitudes[key]
        bent = np.clip((amplitudes - middle) / half_width, -BEYOND, BEYOND)[:, None]
        speed = scaled[:, :1]
        return np.hstack([np.ones_like(speed), scaled, speed**2, bent])

    def _fit(self, key, columns, amplitudes, changes: np.ndarray) -> np.ndarray:
        features = self._features(key, columns, amplitudes)
        # A weak ridge: a dozen pairs would leave some direction nearly free.
        ridge = 1e-3 * len(features) * np.eye(features.shape[1])
        ridge[0, 0] = 0
        return np.linalg.solve(features.T @ features + ridge, features.T @ changes)


def read_pairs(path: Path, candidates: list[dict], parameters: list[str], sizes: list[str]) -> dict:
    """(shape, candidate) -> velocity and parameters, amplitudes, changes [mm per unit] of pairs
    of finished runs.
    """
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
            amplitude = away[row, which]
            change = (outputs[row, columns] - base) / amplitude
            pairs.setdefault((shape[row], candidates[which]["name"]), []).append(
                (shown[row], amplitude, change)
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


def _middle(amplitudes: np.ndarray) -> tuple[float, float]:
    """Middle and half width; a single amplitude shows no bend."""
    lowest, highest = float(amplitudes.min()), float(amplitudes.max())
    width = (highest - lowest) / 2
    return (lowest + highest) / 2, width if width > 1e-9 * abs(highest) else np.inf


def _scaling(pairs: dict, parameters: list[str]) -> tuple[np.ndarray, np.ndarray]:
    everything = _shown(np.vstack([columns for columns, *_ in pairs.values()]), parameters)
    lowest, highest = everything.min(axis=0), everything.max(axis=0)
    return (lowest + highest) / 2, np.maximum((highest - lowest) / 2, 1e-12)
