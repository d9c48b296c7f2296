"""Particles against the finest axisymmetric cells: how far the two geometries part, and what
each costs.

Reads the table of the study `convergence`; a deviation's standard error is that of the seeds of
both.
"""

import matplotlib
import numpy as np
import pandas as pd
from impact_runs import SHAPE_WORDS, SHAPES, SIZES
from impact_study import COMPARED_PARTICLES, VELOCITIES

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DRAWN = [
    "final_length_mm",
    "head_length_mm",
    "transition_diameter_mm",
    "impact_diameter_mm",
    "undeformed_length_mm",
]
WANTED = 0.5  # [%]
FIDELITIES = dict(zip(COMPARED_PARTICLES, ["standard", "fine"]))
STYLES = {"standard": ("o", "tab:blue"), "fine": ("s", "tab:orange")}
CASES = [(shape, velocity) for shape in SHAPES for velocity in VELOCITIES]
# Of the cases along an axis: shapes stand apart.
PLACES = np.arange(len(CASES)) + np.repeat(0.5 * np.arange(len(SHAPES)), len(VELOCITIES))


def rows_of(table, geometry, grains, elements):
    """By shape and velocity, in the order of CASES."""
    kind = (table["geometry"] == geometry) & (table["grains"] == grains)
    part = table[kind & (table["elements"] == elements)]
    return part.set_index(["shape", "velocity_m_s"]).loc[CASES]


def cells_of(table, elements=None):
    """Those of axisymmetric cells, the finest unless told."""
    if elements is None:
        elements = table.loc[table["geometry"] == "axisymmetric", "elements"].max()
    return rows_of(table, "axisymmetric", 16, elements)


def relative_errors(part):
    """Standard errors of the seeds' means [%], a column a size."""
    scatter = part[[f"{size}_scatter_percent" for size in SIZES]].set_axis(SIZES, axis=1)
    return scatter.div(np.sqrt(part["seeds"]), axis=0)


def deviations(table):
    """One row a fidelity of the particles, shape, velocity and size: percent of the cells' size."""
    cells_error = relative_errors(cells_of(table))
    parts = []
    for elements, fidelity in FIDELITIES.items():
        particles = rows_of(table, "3d", 4, elements)
        errors = np.hypot(relative_errors(particles), cells_error)
        for size in SIZES:
            columns = {
                "particles": fidelity,
                "size": size,
                "deviation_percent": particles[f"{size}_deviation_percent"],
                "standard_error_percent": errors[size],
            }
            parts.append(pd.DataFrame(columns).reset_index())
    return pd.concat(parts, ignore_index=True)


def draw_deviations(axis, rows, size):
    axis.axhspan(-WANTED, WANTED, color="0.92", zorder=0)
    axis.axhline(0, color="0.6", linewidth=0.8, zorder=0)
    for shift, (fidelity, (marker, colour)) in zip((-0.14, 0.14), STYLES.items()):
        part = rows[(rows["size"] == size) & (rows["particles"] == fidelity)]
        axis.errorbar(
            PLACES + shift,
            part["deviation_percent"],
            part["standard_error_percent"],
            marker=marker,
            color=colour,
            markersize=4,
            linestyle="",
            label=f"3d, {fidelity}",
        )
    axis.set_yscale("symlog", linthresh=2)
    axis.set_ylim(-40, 40)
    ticks = [-30, -10, -3, -1, 0, 1, 3, 10, 30]
    axis.set_yticks(ticks, [str(tick) for tick in ticks])
    axis.set_title(size.removesuffix("_mm").replace("_", " "), fontsize=10)


def draw_costs(axis, table):
    kinds = [
        ("axisymmetric, standard", cells_of(table, 8), ("^", "0.6")),
        ("axisymmetric, finest", cells_of(table), ("v", "0.2")),
    ]
    for elements, fidelity in FIDELITIES.items():
        particles = rows_of(table, "3d", 4, elements)
        kinds.append((f"3d, {fidelity}", particles, STYLES[fidelity]))
    for words, part, (marker, colour) in kinds:
        style = {"marker": marker, "color": colour, "markersize": 4, "linestyle": ""}
        axis.plot(PLACES, part["cpu_s"], label=words, **style)
    axis.set_yscale("log")
    axis.set_ylim(top=20 * axis.get_ylim()[1])  # room for the legend
    axis.set_title("cost of a run [CPU s]", fontsize=10)
    axis.grid(axis="y", alpha=0.3)
    axis.legend(fontsize=8, ncol=2, loc="upper left")


def draw(table, rows, path):
    figure, axes = plt.subplots(2, 3, figsize=(13, 7))
    for axis, size in zip(axes.flat, DRAWN):
        draw_deviations(axis, rows, size)
    draw_costs(axes.flat[-1], table)
    for axis in axes.flat:
        axis.set_xticks(PLACES, [str(velocity) for _, velocity in CASES], fontsize=8)
        for k, shape in enumerate(SHAPES):
            axis.annotate(
                SHAPE_WORDS[shape],
                (PLACES[len(VELOCITIES) * k + 1], -0.1),
                xycoords=("data", "axes fraction"),
                ha="center",
                va="top",
                fontsize=8,
            )
    for axis in axes[-1]:
        axis.set_xlabel("impact velocity [m/s]", labelpad=18)
    for axis in axes[:, 0]:
        axis.set_ylabel("from the finest cells [%], linear to 2")
    axes[0, 0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main(convergence_path, table_path, figure_path):
    table = pd.read_csv(convergence_path)
    rows = deviations(table)
    rows.round(4).to_csv(table_path, index=False)
    draw(table, rows, figure_path)
    wide = rows.pivot_table(
        index=["particles", "shape", "velocity_m_s"],
        columns="size",
        values=["deviation_percent", "standard_error_percent"],
        sort=False,
    )
    for value in ["deviation_percent", "standard_error_percent"]:
        print(f"particles against the finest cells, {value}:")
        print(wide[value][SIZES].round(2).to_string())


if __name__ == "__main__":
    main(snakemake.input.table, *snakemake.output)  # noqa: F821
