"""Figures of the study network_errors."""

import sys

import matplotlib
import numpy as np

sys.path.append("workflow/scripts")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402

from error_spreads import BOTH, MEMBERS, NEAREST, NORMAL  # noqa: E402
from report.words import SIZE_WORDS, shape_words  # noqa: E402

AXES = {
    "hardening_coefficient": "hardening coefficient AI",
    "immobilization_velocity": "immobilization velocity VI [m/s]",
    "velocity_m_s": "impact velocity [m/s]",
    "log10_rho_immobile_initial": "log10 ρI(0) [1/m²]",
}
COLOURS = {  # of one hue for a spread, darker where it is scaled
    (MEMBERS, "as it is"): "#9ecae1",
    (MEMBERS, "to 68 %"): "#3182bd",
    (NEAREST, "as it is"): "#fdae6b",
    (NEAREST, "to 68 %"): "#e6550d",
    (NEAREST, "likelihood"): "#7f2704",
    (BOTH, "to 68 %"): "#31a354",
}


def draw_correlation(runs, table, path):
    """Network against solver, as the source paper's Figure 12."""
    figure, axes = plt.subplots(2, 3, figsize=(11, 7.4))
    for column, (axis, name) in enumerate(zip(axes.flat, runs.names)):
        solver = (runs.solver * runs.divisors)[:, column]
        network = (runs.network * runs.divisors)[:, column]
        for number, shape in enumerate(np.unique(runs.shapes)):
            own = runs.shapes == shape
            style = {"ms": 4, "mew": 0, "alpha": 0.6, "color": f"C{number}"}
            axis.plot(solver[own], network[own], "o", label=shape_words(shape), **style)
        ends = [min(np.nanmin(solver), np.nanmin(network[np.isfinite(solver)]))]
        ends.append(max(np.nanmax(solver), np.nanmax(network[np.isfinite(solver)])))
        axis.plot(ends, ends, "0.3", lw=0.7, zorder=0)
        found = table[(table["output"] == name) & (table["shape"] == "all")].iloc[0]
        told = (
            f"RMS {found['rms_percent_of_mean']:.2f} % of the mean,\n"
            f"{found['rms_percent_of_range']:.2f} % of the range"
        )
        axis.text(0.97, 0.04, told, transform=axis.transAxes, ha="right", fontsize=8)
        axis.set_title(SIZE_WORDS[name], fontsize=10)
        axis.set_xlabel("solver [mm]", fontsize=9)
        axis.set_ylabel("network [mm]", fontsize=9)
        axis.set_aspect("equal", adjustable="datalim")
    for axis in axes.flat[len(runs.names) :]:
        axis.axis("off")
        handles, labels = axes.flat[0].get_legend_handles_labels()
        axis.legend(handles, labels, loc="center", fontsize=10, markerscale=2, frameon=False)
    figure.suptitle(f"{len(runs.shapes)} held-out runs", fontsize=11)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def draw_map(axis, regions, norm):
    """RMS of cells of equal size on the page, whatever their edges; numbers of runs below."""
    rows = regions.drop_duplicates("first_from")
    columns = regions.drop_duplicates("second_from")
    shape = (len(rows), len(columns))
    rms = regions["rms_percent_of_mean"].to_numpy().reshape(shape).T
    counts = regions["runs"].to_numpy().reshape(shape).T
    axis.pcolormesh(np.ma.masked_invalid(rms), norm=norm, cmap="YlOrRd", edgecolors="white")
    for (j, i), value in np.ndenumerate(rms):
        text = f"{value:.2g} %\n{counts[j, i]} runs" if counts[j, i] else "no run"
        dark = counts[j, i] and norm(value) > 0.6
        style = {"ha": "center", "va": "center", "fontsize": 8}
        axis.text(i + 0.5, j + 0.5, text, color="white" if dark else "0.15", **style)
    for which, part, setter in (("first", rows, "x"), ("second", columns, "y")):
        edges = [*part[f"{which}_from"], part[f"{which}_to"].iloc[-1]]
        getattr(axis, f"set_{setter}ticks")(range(len(edges)), [f"{edge:g}" for edge in edges])
        getattr(axis, f"set_{setter}label")(AXES[part[which].iloc[0]])
    axis.set_facecolor("0.95")
    axis.set_title("RMS error, % of the mean size, and held-out runs", fontsize=10)


def draw_left_out(axis, table):
    share = 100 * table["share"]
    axis.plot(share, table["rms_percent_of_mean"], "o-", label="of the mean size")
    axis.plot(share, table["rms_percent_of_range"], "s-", label="of the range")
    axis.set_ylim(0)
    axis.set_xlabel("worst runs left out [%]")
    axis.set_ylabel("RMS error [%]")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    axis.set_title("Error without the worst runs", fontsize=10)


def draw_spread(axis, runs, spread, factor):
    """Error against the spread between members, both in units of the output's RMS error."""
    errors = np.abs(runs.network - runs.solver)
    unit = np.sqrt(np.nanmean(np.square(errors), axis=0))
    for number, shape in enumerate(np.unique(runs.shapes)):
        own = runs.shapes == shape
        points = (spread / unit)[own].ravel(), (errors / unit)[own].ravel()
        axis.plot(*points, ".", ms=3, alpha=0.5, color=f"C{number}", label=shape_words(shape))
    ends = np.array([np.min(spread / unit), np.max(spread / unit)])
    axis.plot(ends, ends, "0.2", lw=0.8, label="1 spread")
    axis.plot(ends, factor * ends, "0.2", lw=0.8, ls="--", label=f"{factor:.2f} spreads")
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_ylim(1e-3)
    axis.set_xlabel("spread between members / RMS error")
    axis.set_ylabel("|error| / RMS error")
    axis.legend(fontsize=7, markerscale=3, loc="lower right")
    axis.set_title("Does the spread tell the error?", fontsize=10)


def draw_coverage(axis, coverage, count):
    """Share of errors within `count` spreads, by output."""
    names = coverage["output"].unique()
    width = 0.8 / len(COLOURS)
    for number, ((spread, scaled), colour) in enumerate(COLOURS.items()):
        part = coverage[(coverage["spread"] == spread) & (coverage["scaled"] == scaled)]
        places = np.arange(len(names)) + (number + 0.5) * width - 0.4
        label = f"{spread}, x {part['factor'].iloc[0]:.2f}"
        label += " (likelihood)" if scaled == "likelihood" else ""
        axis.bar(places, 100 * part[f"within_{count}"], width, color=colour, label=label)
    axis.axhline(100 * NORMAL[count], color="0.2", lw=0.8, ls="--")
    words = [SIZE_WORDS.get(name, f"{name} outputs").replace(" ", "\n") for name in names]
    axis.set_xticks(range(len(names)), words, fontsize=8)
    lowest = 100 * coverage[f"within_{count}"].min()
    axis.set_ylim(max(0, lowest - 15), 100)
    axis.set_ylabel(f"errors within {count} spread{'s' if count > 1 else ''} [%]")
    axis.set_title(f"Other half of the runs; dashed: normal errors, {100 * NORMAL[count]:.0f} %")
    axis.title.set_fontsize(10)


def draw_errors(runs, spreads, tables, path):
    figure, axes = plt.subplots(2, 3, figsize=(16, 9))
    filled = [cells["rms_percent_of_mean"].dropna() for cells in tables["regions"]]
    norm = LogNorm(min(part.min() for part in filled), max(part.max() for part in filled))
    for axis, regions in zip(axes[0], tables["regions"]):
        draw_map(axis, regions, norm)
    draw_left_out(axes[0, 2], tables["left_out"])
    coverage = tables["coverage"]
    scaled = coverage[(coverage["spread"] == MEMBERS) & (coverage["scaled"] == "to 68 %")]
    draw_spread(axes[1, 0], runs, spreads[MEMBERS], scaled["factor"].iloc[0])
    draw_coverage(axes[1, 1], coverage, 1)
    draw_coverage(axes[1, 2], coverage, 2)
    handles, labels = axes[1, 1].get_legend_handles_labels()
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.legend(handles, labels, loc="lower right", ncol=len(labels), fontsize=8, frameon=False)
    figure.savefig(path, dpi=85)
