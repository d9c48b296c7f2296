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
CASES = [(shape, velocity) for shape in SHAPES for velocity in VELOCITIES]


def means(table, geometry, elements):
    """By shape and velocity: the sizes [mm], their standard errors [mm], CPU seconds."""
    grains = 4 if geometry == "3d" else 16
    kind = (table["geometry"] == geometry) & (table["elements"] == elements)
    part = table[kind & (table["grains"] == grains)].set_index(["shape", "velocity_m_s"])
    part = part.loc[CASES]
    scatter = part[[f"{size}_scatter_percent" for size in SIZES]].set_axis(SIZES, axis=1) / 100
    errors = (part[SIZES] * scatter).div(np.sqrt(part["seeds"]), axis=0)
    return part[SIZES], errors, part["cpu_s"]


def finest_cells(table):
    return table.loc[table["geometry"] == "axisymmetric", "elements"].max()


def deviations(table):
    """One row a fidelity of the particles, shape, velocity and size: percent of the cells' size."""
    cells, cells_error, _ = means(table, "axisymmetric", finest_cells(table))
    rows = []
    for elements, fidelity in FIDELITIES.items():
        particles, error, _ = means(table, "3d", elements)
        for case in CASES:
            for size in SIZES:
                limit = cells.loc[case, size]
                spread = np.hypot(error.loc[case, size], cells_error.loc[case, size])
                rows.append(
                    {
                        "particles": fidelity,
                        "shape": case[0],
                        "velocity_m_s": case[1],
                        "size": size,
                        "deviation_percent": 100 * (particles.loc[case, size] / limit - 1),
                        "standard_error_percent": 100 * spread / limit,
                    }
                )
    return pd.DataFrame(rows)


def draw_deviations(axis, rows, size):
    places = np.arange(len(CASES)) + np.repeat(0.5 * np.arange(len(SHAPES)), len(VELOCITIES))
    axis.axhspan(-WANTED, WANTED, color="0.92", zorder=0)
    axis.axhline(0, color="0.6", linewidth=0.8, zorder=0)
    for shift, fidelity, marker in [(-0.14, "standard", "o"), (0.14, "fine", "s")]:
        part = rows[(rows["size"] == size) & (rows["particles"] == fidelity)]
        axis.errorbar(
            places + shift,
            part["deviation_percent"],
            part["standard_error_percent"],
            marker=marker,
            markersize=4,
            linestyle="",
            label=f"3d, {fidelity}",
        )
    axis.set_yscale("symlog", linthresh=2)
    axis.set_ylim(-40, 40)
    ticks = [-30, -10, -3, -1, 0, 1, 3, 10, 30]
    axis.set_yticks(ticks, [str(tick) for tick in ticks])
    axis.set_xticks(places, [str(velocity) for _, velocity in CASES], fontsize=8)
    axis.set_title(size.removesuffix("_mm").replace("_", " "), fontsize=10)
    return places


def draw_costs(axis, table, places):
    kinds = [("axisymmetric", 8, "standard"), ("axisymmetric", finest_cells(table), "finest")]
    kinds += [("3d", elements, fidelity) for elements, fidelity in FIDELITIES.items()]
    for geometry, elements, words in kinds:
        *_, cpu_s = means(table, geometry, elements)
        axis.plot(places, cpu_s, "o", markersize=4, label=f"{geometry}, {words}")
    axis.set_yscale("log")
    axis.set_ylim(top=20 * cpu_s.max())  # room for the legend
    axis.set_xticks(places, [str(velocity) for _, velocity in CASES], fontsize=8)
    axis.set_title("cost of a run [CPU s]", fontsize=10)
    axis.grid(axis="y", alpha=0.3)
    axis.legend(fontsize=8, ncol=2, loc="upper left")


def draw(table, rows, path):
    figure, axes = plt.subplots(2, 3, figsize=(13, 7))
    for axis, size in zip(axes.flat, DRAWN):
        places = draw_deviations(axis, rows, size)
    draw_costs(axes.flat[-1], table, places)
    for axis in axes.flat:
        for k, shape in enumerate(SHAPES):
            axis.annotate(
                SHAPE_WORDS[shape],
                (places[len(VELOCITIES) * k + 1], -0.13),
                xycoords=("data", "axes fraction"),
                ha="center",
                va="top",
                fontsize=8,
            )
    for axis in axes[:, 0]:
        axis.set_ylabel("from the finest cells [%]")
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
