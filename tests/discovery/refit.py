"""Adds the effect that a diagnosis names, fits again, and looks at the shots held back.

/usr/bin/python3 tests/discovery/refit.py --study tests/discovery/study --tables tables \\
    --out refits.json t001=signatures.h5

Reads nothing that is sealed. Fits by least squares on the whitened residuals, independent of
the C++ code: network alone, then network and the effect's signature.
"""

import argparse
import csv
import json
from pathlib import Path

import numpy as np
from error_model import PlainModel, Shots, sensitivities, whiten, whiteners
from hidden_signal import NOISE, SPECIMEN
from hide import read_candidates, read_signatures
from network import Network
from scipy.optimize import least_squares
from specimens import TRUTHS

STARTS = (0.25, 0.5, 0.75)  # of each parameter's range


def read_table(path: Path) -> tuple[Shots, np.ndarray, np.ndarray]:
    """Shots, measured sizes [mm] and which of them are fitted."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    numbers = [[float(row[size]) for size in NOISE] for row in rows]
    errors = [[float(row[f"{size}_sd"]) for size in NOISE] for row in rows]
    speeds = np.array([float(row["velocity_m_s"]) for row in rows])
    speed_sd = np.array([float(row["velocity_sd_m_s"]) for row in rows])
    shots = Shots([row["shape"] for row in rows], speeds, speed_sd, np.array(errors), SPECIMEN)
    return shots, np.array(numbers), np.array([row["use"] == "calibrate" for row in rows])


class Fit:
    """Least squares over the parameters, and over the amplitude of a candidate if there is one."""

    def __init__(self, model: PlainModel, measured: np.ndarray, signatures, candidate: dict | None):
        self._model, self._measured = model, measured
        self._signatures, self._candidate = signatures, candidate
        ranges = [model.network.ranges[name] for name in model.parameters]
        self._lowest, self._highest = np.array(ranges).T
        self.roots = whiteners(model, self.parameters(np.full(len(ranges), 0.5)))

    def parameters(self, share: np.ndarray) -> np.ndarray:
        """From shares of the ranges; the density's by its logarithm."""
        plain = self._lowest + share * (self._highest - self._lowest)
        logarithmic = self._lowest * (self._highest / self._lowest) ** share
        is_density = [name.startswith("rho_") for name in self._model.parameters]
        return np.where(is_density, logarithmic, plain)

    def predicted(self, model: PlainModel, theta: np.ndarray, amplitude: float) -> np.ndarray:
        """Sizes [mm] of the shots of `model`, with the candidate's change."""
        sizes = model.sizes(theta)
        if self._candidate is not None:
            for shape, chosen in model.by_shape():
                points = model.points(chosen, theta)
                change = self._signatures.change(shape, self._candidate["name"], points)
                sizes[chosen] += amplitude * change
        return sizes

    def solve(self) -> tuple[np.ndarray, float, float]:
        """Parameters, amplitude and chi^2 of the best of several starts."""
        best = None
        for _ in range(2):  # the velocity's part of the errors, once more at the first optimum
            for start in STARTS if best is None else [best.x[:-1]]:
                found = self._solve_from(start, best)
                if best is None or found.cost < best.cost:
                    best = found
            self.roots = whiteners(self._model, self.parameters(best.x[:-1]))
        theta, amplitude = self.parameters(best.x[:-1]), best.x[-1] * self._scale()
        return theta, amplitude, float(np.sum(self._residual(best.x) ** 2))

    def _scale(self) -> float:
        return 0.0 if self._candidate is None else abs(self._candidate["typical"])

    def _residual(self, x: np.ndarray) -> np.ndarray:
        sizes = self.predicted(self._model, self.parameters(x[:-1]), x[-1] * self._scale())
        return whiten(self.roots, self._measured - sizes)

    def _solve_from(self, start, best):
        count = len(self._model.parameters)
        low, high = np.zeros(count + 1), np.ones(count + 1)
        low[-1], high[-1] = -1.0, 1.0
        if self._candidate is not None:
            base, scale = self._candidate["base"], self._scale()
            low[-1] = (self._candidate["lowest"] - base) / scale
            high[-1] = (self._candidate["highest"] - base) / scale
        amplitude = 0.0 if best is None else best.x[-1]
        x = np.append(np.broadcast_to(start, count), np.clip(amplitude, low[-1], high[-1]))
        inside = np.clip(x, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
        return least_squares(self._residual, inside, bounds=(low, high))


def added(network, signatures, candidate: dict, table: Path) -> dict:
    """Both fits of a table: chi^2 on its fitted and its held-back shots, and parameters."""
    shots, measured, fitted = read_table(table)
    inside, outside = shots.subset(fitted), shots.subset(~fitted)
    ranges = {name: network.ranges[name] for name in TRUTHS}
    report: dict = {"effect": candidate["name"], "ranges": ranges}
    for key, chosen in (("without", None), ("with", candidate)):
        model = PlainModel(network, inside, list(TRUTHS))
        fit = Fit(model, measured[fitted], signatures, chosen)
        theta, amplitude, chi2 = fit.solve()
        held = PlainModel(network, outside, list(TRUTHS))
        rest = measured[~fitted] - fit.predicted(held, theta, amplitude)
        left_out = float(np.sum(whiten(whiteners(held, theta), rest) ** 2))
        report[key] = {
            "parameters": dict(zip(TRUTHS, theta, strict=True)),
            "amplitude": amplitude,
            "chi2": chi2,
            "left_out_chi2": left_out,
        }
        report.setdefault("information", _information(model, theta, fit.roots))
    return report


def _information(model: PlainModel, theta: np.ndarray, roots: np.ndarray) -> list:
    """J^T J over shares of the ranges: measures how far apart two sets of parameters are."""
    sensitivity = sensitivities(model, theta, roots)
    return (sensitivity.T @ sensitivity).tolist()


def named_effect(diagnosis: dict) -> str | None:
    """What to add: the first that the verdict names, if it flags and names one."""
    verdict = diagnosis["verdict"]
    return verdict["effects"][0] if verdict["flagged"] and verdict["effects"] else None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", type=Path, required=True)
    parser.add_argument("--tables", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("ids", nargs="+", help="table=file of its metal's paired runs")
    options = parser.parse_args()
    network = Network.from_file(options.study / "emulator.json")
    candidates = read_candidates(options.study)
    by_name = {item["name"]: item for item in candidates}
    reports = {}
    for name, pairs in (pair.split("=") for pair in options.ids):
        folder = options.tables / name
        effect = named_effect(json.loads((folder / "diagnosis.json").read_text()))
        if effect is not None:
            table = folder / "measurements.csv"
            signatures = read_signatures(Path(pairs), candidates, network)
            reports[name] = added(network, signatures, by_name[effect], table)
    options.out.write_text(json.dumps(reports, indent=1) + "\n")


if __name__ == "__main__":
    main()
