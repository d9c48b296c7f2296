"""The network's likelihood in plain numpy, written again from the definitions.

It shares no code with `calibrate`: what the two agree on is not an accident of either.
"""

import csv
import json
from pathlib import Path

import numpy as np

SHOT_INPUTS = {
    "velocity_m_s": lambda row: float(row["velocity_m_s"]),
    "initial_diameter_mm": lambda row: float(row["initial_diameter_mm"]),
    "length_to_diameter": lambda row: float(row["initial_length_mm"])
    / float(row["initial_diameter_mm"]),
    "initial_temperature_K": lambda row: float(row["initial_temperature_K"]),
}


HELD_OUT_UNDERSTATE = 3  # see calibrate/README.md
TRANSFORMS = {"linear": np.asarray, "log10": np.log10, "square_root": np.sqrt}
NEIGHBOURS = 30  # held-out runs that tell the error near a point


class Network:
    """The best member of an emulator file."""

    def __init__(self, path: Path):
        model = json.loads(Path(path).read_text())
        self.inputs, self.outputs = model["inputs"], model["outputs"]
        self.shapes = model["category"]["values"]
        layers = model["members"][model["best"]]["layers"]
        self.layers = [(np.array(x["weights"]), np.array(x["bias"])) for x in layers]
        self.covariances = model["validation"]["covariance"]
        self.held_out = model["validation"].get("held_out")

    def sizes(self, shape, values: dict) -> np.ndarray:
        """Outputs [points x outputs] in mm; shape and each value are one or an array."""
        values = {name: np.asarray(value, float) for name, value in values.items()}
        points = max(value.size for value in values.values())
        columns = [np.broadcast_to(column, points) for column in self.seen(values)]
        hot = [np.broadcast_to(np.equal(shape, name).astype(float), points) for name in self.shapes]
        signal = np.vstack([*columns, *hot])
        for number, (weights, bias) in enumerate(self.layers):
            signal = weights @ signal + bias[:, None]
            if number + 1 < len(self.layers):
                signal = signal / (1 + np.exp(-signal))
        result = []
        for output, line in zip(self.outputs, signal):
            line = line * output["scale"] + output["shift"]
            for name in output["divide_by"]:
                line = line * values[name]
            result.append(line)
        return np.array(result).T

    def seen(self, values: dict) -> list:
        """The used inputs as the network sees them."""
        columns = []
        for info in self.inputs:
            if not info.get("used", True):
                continue
            value = TRANSFORMS[info["transform"]](values[info["name"]])
            columns.append((value - info["shift"]) / info["scale"])
        return columns

    def error_covariance(self, shape: str, names: list, values: dict) -> np.ndarray:
        """Covariance [mm^2] of the solver's minus the network's sizes near a point: of the
        nearest held-out runs, that of all runs of the shape counted as one more.
        """
        entry = self.covariances[shape]
        at = [entry["outputs"].index(name) for name in names]
        matrix = np.array(entry["matrix"])[np.ix_(at, at)]
        if self.held_out:
            own = np.equal(self.held_out["categories"], shape)
            every = [output["name"] for output in self.outputs]
            columns = [every.index(name) for name in entry["outputs"]]
            errors = np.array(self.held_out["errors"], float)[own][:, columns]
            places = np.array(self.held_out["places"], float)[own]
            known = np.isfinite(errors).all(axis=1)
            if known.sum() > NEIGHBOURS:
                away = ((places[known] - self.seen(values)) ** 2).sum(axis=1)
                near = errors[known][np.argsort(away)[:NEIGHBOURS]][:, at]
                matrix = (matrix + near.T @ near) / (NEIGHBOURS + 1)
        by_name = {output["name"]: output for output in self.outputs}
        scale = [np.prod([values[i] for i in by_name[n]["divide_by"]]) for n in names]
        return HELD_OUT_UNDERSTATE * matrix * np.outer(scale, scale)


class TableLikelihood:
    """ln of likelihood times prior mass of the spread, for points of the unit cube."""

    def __init__(self, emulator: Path, table: Path, config: dict, reference: np.ndarray):
        """`reference`: plain parameters at which the velocity's influence and the network's error
        are taken.
        """
        self.network = Network(emulator)
        self.parameters = config["parameters"]
        self.levels, self.log_mass = self._spread(config.get("unexplained_spread"))
        self.rows = []
        names = [output["name"] for output in self.network.outputs]
        with open(table, newline="") as file:
            for row in csv.DictReader(file):
                if row["use"] == "calibrate":
                    self._add_row(row, names, config, reference)

    def plain(self, units: np.ndarray) -> np.ndarray:
        columns = []
        for parameter, unit in zip(self.parameters, np.atleast_2d(units).T):
            low, high = parameter["lower"], parameter["upper"]
            if parameter.get("prior") == "log_uniform":
                columns.append(low * (high / low) ** unit)
            else:
                columns.append(low + (high - low) * unit)
        return np.array(columns).T

    def __call__(self, units: np.ndarray) -> np.ndarray:
        plain = self.plain(units)
        by_level = np.tile(self.log_mass, (len(plain), 1))
        # All rows go through the network in one block, row by row.
        shapes = np.repeat([row[0]["shape"] for row in self.rows], len(plain))
        values = {
            name: np.repeat([row[0]["values"][name] for row in self.rows], len(plain))
            for name in SHOT_INPUTS
        }
        for parameter, column in zip(self.parameters, plain.T):
            values[parameter["name"]] = np.tile(column, len(self.rows))
        predicted = self.network.sizes(shapes, values).reshape(len(self.rows), len(plain), -1)
        for sizes, (_, at, measured, inverses, norms) in zip(predicted, self.rows):
            residual = measured - sizes[:, at]
            for level, (inverse, norm) in enumerate(zip(inverses, norms)):
                chi2 = ((residual @ inverse) * residual).sum(axis=1)
                by_level[:, level] += norm - 0.5 * chi2
        largest = by_level.max(axis=1)
        return largest + np.log(np.exp(by_level - largest[:, None]).sum(axis=1))

    def _predict(self, shot: dict, plain: np.ndarray) -> np.ndarray:
        values = dict(shot["values"])
        for parameter, column in zip(self.parameters, plain.T):
            values[parameter["name"]] = column
        return self.network.sizes(shot["shape"], values)

    def _add_row(self, row: dict, names: list, config: dict, reference: np.ndarray) -> None:
        sizes = [name for name in config["fit_sizes"] if row[name]]
        values = {name: read(row) for name, read in SHOT_INPUTS.items()}
        shot = {"shape": row["shape"], "values": values}
        at = [names.index(name) for name in sizes]
        measured = np.array([float(row[name]) for name in sizes])
        sd = np.array([float(row[name + "_sd"]) for name in sizes])
        velocity = values["velocity_m_s"]
        sd_velocity = float(row["velocity_sd_m_s"] or config["velocity_sd_relative"] * velocity)
        info = next(i for i in self.network.inputs if i["name"] == "velocity_m_s")
        ends = max(0.99 * velocity, info["lower"]), min(1.01 * velocity, info["upper"])
        low, high = (
            self._predict(
                {"shape": row["shape"], "values": {**values, "velocity_m_s": end}},
                np.atleast_2d(reference),
            )[0, at]
            for end in ends
        )
        slope = (high - low) / (ends[1] - ends[0])
        fixed = np.diag(sd**2) + np.outer(slope, slope) * sd_velocity**2
        point = {info["name"]: x for info, x in zip(config["parameters"], reference)}
        fixed += self.network.error_covariance(row["shape"], sizes, {**values, **point})
        inverses, norms = [], []
        for spread in self.levels:
            covariance = fixed + spread**2 * np.diag(measured**2)
            inverses.append(np.linalg.inv(covariance))
            norms.append(-0.5 * np.linalg.slogdet(2 * np.pi * covariance)[1])
        self.rows.append((shot, at, measured, inverses, norms))

    @staticmethod
    def _spread(spread):
        from math import erfc, inf, log, sqrt

        if spread is None:
            return [0.0], np.array([0.0])
        grid, scale = spread["grid"], spread["prior_scale"] * sqrt(2)
        edges = [0, *(0.5 * (a + b) for a, b in zip(grid, grid[1:])), inf]
        masses = [erfc(a / scale) - erfc(b / scale) for a, b in zip(edges, edges[1:])]
        return grid, np.array([log(max(mass, 1e-300)) for mass in masses])
