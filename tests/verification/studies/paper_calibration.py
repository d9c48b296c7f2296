"""The source paper's calibration beside ours: maps of the posterior for all rows and for parts of
them (its Figures 13, A3, A4), how both converge with the draws, and a table of figures.
"""

import json
import re
from pathlib import Path

import h5py
import matplotlib
import numpy as np
import pandas as pd

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import NullFormatter  # noqa: E402

PAIRS = [
    ("rho_immobile_initial", "hardening_coefficient"),
    ("rho_immobile_initial", "immobilization_velocity"),
    ("hardening_coefficient", "immobilization_velocity"),
]
WORDS = {
    "rho_immobile_initial": "ρI(0) [1/m²]",
    "hardening_coefficient": "AI",
    "immobilization_velocity": "VI [m/s]",
}
PARTS = {
    "": "all rows and sizes",
    "shape_uniform_cylinder": "uniform cylinders",
    "shape_reduced_head_4mm": "4-mm heads",
    "shape_reduced_head_3mm": "3-mm heads",
    "shape_truncated_cone": "truncated cones",
    "final_length": "length alone",
    "impact_diameter": "impact diameter alone",
    "other_sizes": "the other three sizes",
}
TRUTH = {
    "rho_immobile_initial": 6.3e12,
    "hardening_coefficient": 2.8,
    "immobilization_velocity": 0.4,
}
# Alike for all parts of the table, so that widths can be compared.
SHOWN = {
    "rho_immobile_initial": (7e11, 6e13),
    "hardening_coefficient": (0.8, 7),
    "immobilization_velocity": (0, 5),
}
SHARE = 0.95  # of the posterior, inside the line
ENOUGH = 1000  # effective draws for a map
PAPER = {"rms": "0.4", "largest": "4.6", "rate": "5e4", "hours": "7"}


def group_of(part):
    return f"subsets/{part}/" if part else ""


def level_that_holds(density, share):
    """The density above which `share` of the mass lies; cells have equal areas."""
    falling = np.sort(density.ravel())[::-1]
    mass = np.cumsum(falling) / falling.sum()
    return falling[min(np.searchsorted(mass, share), len(falling) - 1)]


def draw_maps(posterior, adapted, path):
    """`adapted`: a posterior of adapted draws, whose map of all rows is shown where plain draws
    are too few for one."""
    plain = posterior.attrs["effective_sample_size"] >= ENOUGH
    figure, axes = plt.subplots(len(PAIRS), len(PARTS), figsize=(20, 8.2))
    for row, (x, y) in zip(axes, PAIRS):
        for axis, (part, words) in zip(row, PARTS.items()):
            source = adapted if part == "" and not plain else posterior
            group = source[f"{group_of(part)}maps_2d/{x}__{y}"]
            edges = [group["x_edges"][:], group["y_edges"][:]]
            density = group["density"][:].T
            axis.pcolormesh(*edges, density, cmap="Blues", vmin=0)
            centres = [(edge[1:] + edge[:-1]) / 2 for edge in edges]
            level = level_that_holds(density, SHARE)
            axis.contour(*centres, density, levels=[level], colors="0.2", linewidths=0.8)
            axis.plot(TRUTH[x], TRUTH[y], "r+", markersize=9)
            axis.set(xlim=SHOWN[x], ylim=SHOWN[y], facecolor=plt.get_cmap("Blues")(0))
            if x == "rho_immobile_initial":
                axis.set_xscale("log")
                axis.xaxis.set_minor_formatter(NullFormatter())
            if part == "":
                axis.set_ylabel(WORDS[y])
            else:
                axis.tick_params(labelleft=False)
            if (x, y) == PAIRS[0]:
                axis.set_title(words, fontsize=10)
            axis.set_xlabel(WORDS[x])
    how = "plain draws" if plain else "adapted draws, plain ones are too few"
    figure.suptitle(
        "Posterior of the synthetic table by parts; line: 95 % of it, red: what made the table. "
        f"All rows: {how}; parts: adapted draws",
        fontsize=11,
    )
    figure.tight_layout()
    figure.savefig(path, dpi=75)


def draw_convergence(table, path):
    means = [name for name in table.columns if name.startswith("mean ")]
    figure, axes = plt.subplots(1, len(means) + 1, figsize=(12, 3))
    shown = table[table["effective_sample_size"] > 1]
    for axis, name in zip(axes, means):
        sd = shown["sd " + name.removeprefix("mean ")]
        axis.errorbar(shown["draws"], shown[name], sd, fmt="o-", capsize=3)
        size = name.removeprefix("mean ")
        key = size.removeprefix("log10 ")
        true = np.log10(TRUTH[key]) if key != size else TRUTH[key]
        axis.axhline(true, color="tab:red", linewidth=0.8)
        axis.set_title(f"{'log10 ' if key != size else ''}{WORDS[key]}", fontsize=9)
    axes[-1].loglog(table["draws"], table["effective_sample_size"], "o-")
    axes[-1].set_title("effective draws", fontsize=9)
    figure.suptitle("Synthetic table: means and deviations; red: what made it", fontsize=10)
    for axis in axes:
        axis.set_xscale("log")
        axis.set_xlabel("plain draws", fontsize=8)
        axis.tick_params(labelsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def convergence(posterior):
    data = posterior["convergence"]
    return pd.DataFrame(data[:], columns=[str(name) for name in data.attrs["names"]])


def widths(posterior):
    """By part of the table: mean and deviation of each parameter."""
    lines = ["part of the table              log10 rho_I(0)        AI             VI m/s"]
    for part, words in PARTS.items():
        name = "convergence" if part == "" else f"{group_of(part)}summary"
        data = posterior[name]
        line = dict(zip(data.attrs["names"], data[-1]))
        cells = [
            f"{line['mean ' + key]:6.2f} +- {line['sd ' + key]:4.2f}"
            for key in ("log10 " + PAIRS[0][0], PAIRS[0][1], PAIRS[1][1])
        ]
        lines.append(f"{words:28s} " + "   ".join(cells))
    return lines


def rate_of(log):
    """Plain draws, and how many of them a second and thread."""
    found = re.search(r"([\d.e+]+) plain draws in ([\d.]+) s, ([\d.e+]+) a second", log)
    return float(found[1]), float(found[3])


def report(emulator, posterior, log):
    judged = json.loads(Path(emulator).read_text())["validation"]
    draws, rate = rate_of(Path(log).read_text())
    with h5py.File(posterior) as file:
        bound = float(file.attrs["dropped_mass_bound"])
        rows = float(file.attrs["rows_per_draw"])
        effective = float(file.attrs["effective_sample_size"])
        parts = widths(file)
    hours = 1e10 / rate / 2 / 3600 if rate else np.nan
    return "\n".join(
        [
            "                                        paper   ours",
            f"network, RMS of held-out runs, %        {PAPER['rms']:>5}   "
            f"{100 * judged['rms_relative']:.2f}   (the second round's among them)",
            f"network, largest error, %               {PAPER['largest']:>5}   "
            f"{100 * judged['largest_relative']:.1f}",
            f"plain draws a second and core           {PAPER['rate']:>5}   {rate:.2g}",
            f"hours for 1e10 draws                    {PAPER['hours']:>5}   {hours:.1f}"
            "   (eight cores; two cores, from the rate)",
            f"plain draws here                        1e10    {draws:.3g},"
            f" {effective:.0f} effective",
            f"rows looked at for each draw            50      {rows:.2f}",
            f"posterior in the draws dropped early    -       below {bound:.1g}",
            "",
            *parts,
            "",
            "The table is synthetic: our solver's, with log10 6.3e12 = 12.80, AI 2.8, VI 0.4 m/s.",
        ]
    )


if __name__ == "__main__":
    inputs, outputs = snakemake.input, snakemake.output  # noqa: F821
    Path(outputs.text).write_text(report(inputs.emulator, inputs.posterior, inputs.log) + "\n")
    with h5py.File(inputs.posterior) as file, h5py.File(inputs.adapted) as adapted:
        draw_maps(file, adapted, outputs.maps)
        table = convergence(file)
    table.to_csv(outputs.table, index=False)
    draw_convergence(table, outputs.convergence)
