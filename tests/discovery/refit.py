"""Adds the effect that a diagnosis names, fits again, and looks at the shots held back.

/usr/bin/python3 tests/discovery/refit.py --study tests/discovery/study --tables tables \\
    --out refits.json t001=signatures.h5

Reads nothing that is sealed. Fits by least squares on the whitened residuals, independent of
the C++ code: network alone, then network and the effect's signature. Looks at the shots that the
table holds back, and at every shot in turn with a fifth of them left out.
"""

import argparse
import csv
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from error_model import PlainModel, Shots, sensitivities, whiten, whiteners
from hidden_signal import NOISE, SPECIMEN
from hide import read_candidates, read_signatures
from network import Network
from scipy.optimize import least_squares
from specimens import TRUTHS

STARTS = (0.25, 0.5, 0.75)  # of each parameter's range
AMPLITUDE_STARTS = (0.1, 1.0)  # of the candidate's usual one: from its bound nothing moves
FOLDS = 5
TOLERANCE = 1e-6  # relative, of chi^2 and of the place


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
                name = self._candidate["name"]
                change = self._signatures.change(shape, name, points, amplitude)
                sizes[chosen] += amplitude * change
        return sizes

    def solve(self, first=None) -> "Optimum":
        """The best of several starts, or the one reached from `first`."""
        starts = self._starts() if first is None else [first.place]
        for _ in range(2):  # the velocity's part of the errors, once more at the first optimum
            found = min((self._solve_from(start) for start in starts), key=lambda fit: fit.cost)
            self.roots = whiteners(self._model, self.parameters(found.x[:-1]))
            starts = [found.x]
        theta, amplitude = self.parameters(found.x[:-1]), found.x[-1] * self._scale()
        return Optimum(found.x, theta, amplitude, float(np.sum(self._residual(found.x) ** 2)))

    def _starts(self) -> list[np.ndarray]:
        count = len(self._model.parameters)
        amplitudes = (0.0,) if self._candidate is None else AMPLITUDE_STARTS
        sign = 1.0 if self._candidate is None else np.sign(self._candidate["typical"])
        return [np.append(np.full(count, s), sign * a) for s in STARTS for a in amplitudes]

    def _scale(self) -> float:
        return 0.0 if self._candidate is None else abs(self._candidate["typical"])

    def _residual(self, x: np.ndarray) -> np.ndarray:
        sizes = self.predicted(self._model, self.parameters(x[:-1]), x[-1] * self._scale())
        return whiten(self.roots, self._measured - sizes)

    def _solve_from(self, start: np.ndarray):
        count = len(self._model.parameters)
        low, high = np.zeros(count + 1), np.ones(count + 1)
        low[-1], high[-1] = -1.0, 1.0
        if self._candidate is not None:
            base, scale = self._candidate["base"], self._scale()
            low[-1] = (self._candidate["lowest"] - base) / scale
            high[-1] = (self._candidate["highest"] - base) / scale
        inside = np.clip(start, low + 1e-6 * (high - low), high - 1e-6 * (high - low))
        return least_squares(
            self._residual, inside, bounds=(low, high), ftol=TOLERANCE, xtol=TOLERANCE
        )


@dataclass(frozen=True)
class Optimum:
    """The best place of a fit."""

    place: np.ndarray  # shares of the ranges, amplitude over the usual one
    theta: np.ndarray
    amplitude: float
    chi2: float


class Table:
    """A table and what may be added to explain it."""

    def __init__(self, network, signatures, path: Path):
        self.network, self._signatures = network, signatures
        self.shots, self.measured, self.fitted = read_table(path)

    def model(self, chosen: np.ndarray) -> PlainModel:
        return PlainModel(self.network, self.shots.subset(chosen), list(TRUTHS))

    def fit(self, chosen: np.ndarray, candidate: dict | None) -> Fit:
        return Fit(self.model(chosen), self.measured[chosen], self._signatures, candidate)

    def chi2_left_out(self, fitted: np.ndarray, candidate: dict | None, first: Optimum) -> float:
        """Of the shots not `fitted`, whitened at what the others say; the fit starts at `first`."""
        fit = self.fit(fitted, candidate)
        best = fit.solve(first)
        held = self.model(~fitted)
        rest = self.measured[~fitted] - fit.predicted(held, best.theta, best.amplitude)
        return float(np.sum(whiten(whiteners(held, best.theta), rest) ** 2))

    def folds(self) -> list[np.ndarray]:
        """Which shots are left out together: every fifth by shape and velocity."""
        order = np.lexsort([self.shots.velocities, self.shots.shapes])
        rank = np.empty(len(order), dtype=int)
        rank[order] = np.arange(len(order))
        return [rank % FOLDS == fold for fold in range(FOLDS)]


def added(network, signatures, candidate: dict, path: Path) -> dict:
    """Both fits of a table: parameters, chi^2 on its fitted and its held-back shots, and chi^2 of
    all shots, each predicted from four fifths of the others.
    """
    table = Table(network, signatures, path)
    ranges = {name: network.ranges[name] for name in TRUTHS}
    report: dict = {"effect": candidate["name"], "ranges": ranges}
    everything = np.ones_like(table.fitted)
    for key, chosen in (("without", None), ("with", candidate)):
        fit = table.fit(table.fitted, chosen)
        best = fit.solve()
        whole = table.fit(everything, chosen).solve(best)
        turns = [table.chi2_left_out(~fold, chosen, whole) for fold in table.folds()]
        report[key] = {
            "parameters": dict(zip(TRUTHS, best.theta, strict=True)),
            "amplitude": best.amplitude,
            "chi2": best.chi2,
            "left_out_chi2": table.chi2_left_out(table.fitted, chosen, best),
            "left_out_in_turn_chi2": sum(turns),
        }
        report.setdefault("information", _information(table, best.theta, fit.roots))
    return report


def _information(table: Table, theta: np.ndarray, roots: np.ndarray) -> list:
    """J^T J over shares of the ranges: measures how far apart two sets of parameters are."""
    sensitivity = sensitivities(table.model(table.fitted), theta, roots)
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
