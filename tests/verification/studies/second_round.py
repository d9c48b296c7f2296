"""What the second round of runs of paper_design did: the network's errors near the posterior, and
the posterior itself, before and after, beside the values that made the table.
"""

import json
import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

from error_scales import figures_of, percent_errors
from held_out_runs import among, answers, held_out_runs, part_of, standardised
from paper_calibration import PAIRS, TRUTH, WORDS

sys.path.append("workflow/scripts")
from report.words import SIZE_WORDS, shape_words  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

ROUNDS = {"first": "first network", "second": "with runs near its posterior"}
COLOURS = {"first": "0.6", "second": "C0"}
QUANTILES = [0.025, 0.5, 0.975]


def errors_near(first, second, near):
    """Percent errors of both networks on the second round's runs that neither learnt from, and the
    runs."""
    runs = held_out_runs(second)
    runs = part_of(runs, among(runs, near))
    places = standardised(first["inputs"], runs.inputs)
    before = answers(first, places, runs.shapes)[first["best"]]
    told = {"first": before, "second": runs.network}
    return runs, {
        name: percent_errors(runs.solver, network, runs.shapes) for name, network in told.items()
    }


def read_draws(path):
    with h5py.File(path) as file:
        names = [str(name) for name in file["draws"].attrs["names"]]
        return dict(zip(names, file["draws"][:].T))


def error_lines(runs, errors):
    shapes = np.unique(runs.shapes)
    lines = [
        f"RMS error on {len(runs.shapes)} runs near the first posterior from which neither network"
        " learnt, % of the mean size there:",
        f"{'':22s}" + "".join(f"{shape_words(shape):>22s}" for shape in shapes),
    ]
    for column, size in enumerate(runs.names):
        cells = []
        for shape in shapes:
            rows = runs.shapes == shape
            first, second = (
                figures_of(errors[name], rows, column)["rms_percent_of_mean"] for name in ROUNDS
            )
            cells.append(f"{first:14.2f} > {second:5.2f}")
        lines.append(f"{SIZE_WORDS[size]:22s}" + "".join(cells))
    whole = [figures_of(errors[name])["rms_percent_of_mean"] for name in ROUNDS]
    return [*lines, f"all: {whole[0]:.2f} before, {whole[1]:.2f} after the second round"]


def interval_lines(draws):
    lines = ["", "Posterior: median, 95 % interval; what made the table"]
    for name, truth in TRUTH.items():
        for key, words in ROUNDS.items():
            low, middle, high = np.quantile(draws[key][name], QUANTILES)
            inside = "" if low <= truth <= high else "  (outside)"
            lines.append(
                f"{name:26s}{words:30s}{middle:9.3g}  {low:9.3g} to {high:9.3g};"
                f" {truth:g}{inside}"
            )
    return lines


def draw(runs, errors, draws, path):
    figure, axes = plt.subplots(1, 1 + len(PAIRS), figsize=(15, 3.9))
    shapes = np.unique(runs.shapes)
    for key, offset in zip(ROUNDS, (-0.2, 0.2)):
        values = [
            figures_of(errors[key], runs.shapes == shape)["rms_percent_of_mean"] for shape in shapes
        ]
        bars = np.arange(len(shapes)) + offset
        axes[0].bar(bars, values, 0.38, color=COLOURS[key], label=ROUNDS[key])
    axes[0].set_xticks(
        np.arange(len(shapes)), [shape_words(shape) for shape in shapes], rotation=20
    )
    axes[0].set_ylabel("RMS error near the posterior [%]")
    axes[0].set_ylim(top=1.3 * axes[0].get_ylim()[1])  # room for the legend
    axes[0].legend(fontsize=8)
    for axis, (x, y) in zip(axes[1:], PAIRS):
        for key in ROUNDS:
            axis.plot(draws[key][x], draws[key][y], ".", ms=2, alpha=0.3, color=COLOURS[key])
        axis.plot(TRUTH[x], TRUTH[y], "r+", ms=12, mew=2)
        if x == "rho_immobile_initial":
            axis.set_xscale("log")
            axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 4, 6)))
            axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0e}"))
            axis.xaxis.set_minor_formatter(NullFormatter())
        axis.set_xlabel(WORDS[x])
        axis.set_ylabel(WORDS[y])
    figure.suptitle("A second round of runs; red: what made the synthetic table", fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    given, made = snakemake.input, snakemake.output  # noqa: F821
    models = [json.loads(Path(path).read_text()) for path in (given.first, given.emulator)]
    runs, errors = errors_near(*models, given.near)
    draws = {"first": read_draws(given.first_posterior), "second": read_draws(given.posterior)}
    lines = error_lines(runs, errors) + interval_lines(draws)
    Path(made.text).write_text("\n".join(lines) + "\n")
    draw(runs, errors, draws, made.figure)
