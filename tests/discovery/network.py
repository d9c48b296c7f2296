"""The study's network in numpy: sizes of shots at parameters, after the recipe in emulator.json."""

import json
from pathlib import Path

import numpy as np


_TRANSFORMS = {"linear": np.asarray, "log10": np.log10, "square_root": np.sqrt}


class Network:
    """Sizes [mm] from (shape, inputs), and the network's own error covariance by shape."""

    def __init__(self, document: dict):
        self.inputs = document["inputs"]
        self.outputs = [output["name"] for output in document["outputs"]]
        self.ranges = {item["name"]: (item["lower"], item["upper"]) for item in self.inputs}
        self._shapes = document["category"]["values"]
        self._layers = [
            (np.array(layer["weights"]), np.array(layer["bias"]))
            for layer in document["members"][document["best"]]["layers"]
        ]
        self._scaling = [
            (output["scale"], output["shift"], output["divide_by"])
            for output in document["outputs"]
        ]
        self._covariance = document["validation"]["covariance"]

    @classmethod
    def from_file(cls, path: Path) -> "Network":
        return cls(json.loads(Path(path).read_text()))

    def sizes(self, shape: str, points: dict) -> np.ndarray:
        """Sizes [mm], one row a point, columns as `outputs`; `points`: input name -> values."""
        columns = np.broadcast_arrays(*(points[item["name"]] for item in self.inputs))
        named = {item["name"]: column for item, column in zip(self.inputs, columns, strict=True)}
        standard = [_standard(item, named[item["name"]]) for item in self.inputs if item["used"]]
        one_hot = [np.full(columns[0].shape, float(shape == known)) for known in self._shapes]
        values = np.stack(standard + one_hot, axis=-1)
        for index, (weights, bias) in enumerate(self._layers):
            values = values @ weights.T + bias
            if index + 1 < len(self._layers):
                values = values / (1 + np.exp(-values))  # SiLU
        for column, (scale, shift, divide_by) in enumerate(self._scaling):
            values[..., column] = values[..., column] * scale + shift
            for name in divide_by:
                values[..., column] *= named[name]
        return values

    def covariance(self, shape: str, point: dict) -> np.ndarray:
        """Held-out error covariance [mm^2] between `outputs`; zero where it is not known."""
        known = self._covariance[shape]
        whole = np.zeros((len(self.outputs), len(self.outputs)))
        at = [self.outputs.index(name) for name in known["outputs"]]
        whole[np.ix_(at, at)] = known["matrix"]
        divisors = [np.prod([point[name] for name in by]) for _, _, by in self._scaling]
        return whole * np.outer(divisors, divisors)


def _standard(item: dict, values: np.ndarray) -> np.ndarray:
    return (_TRANSFORMS[item["transform"]](values) - item["shift"]) / item["scale"]
