"""Sizes against the number of cells or particles: table, deviations from the finest, figure.

Rows of the geometry `extrapolated` hold the limit of infinitely many cells and, as its scatter,
the standard error that the seeds leave it.
"""

import matplotlib
import numpy as np
import pandas as pd
from impact_runs import COARSE_COLUMNS, SHAPE_WORDS, SHAPES, SIZES, read_run
from impact_study import SERIES, VELOCITIES, convergence_cases, convergence_names

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

DRAWN = SIZES[:6]
# By grains a point.
STYLES = {
    ("axisymmetric", 16): {"marker": "o", "linestyle": "-"},
    ("3d", 1): {"marker": "s", "linestyle": ":"},
    ("3d", 4): {"marker": "^", "linestyle": "--"},
    ("3d", 16): {"marker": "v", "linestyle": "-."},
}
COLOURS = dict(zip(SIZES, plt.get_cmap("tab10").colors))
LIMIT_PLACE = 18.5  # of the extrapolated sizes among the numbers of cells


def mean_row(answers):
    """What several seeds of one case answer: means, and each size's scatter between them [%]."""
    sizes = pd.DataFrame([answer["sizes"] for answer in answers], columns=SIZES).astype(float)
    row = {
        key: np.mean([answer[key] for answer in answers]) for key in ["points", "steps", "cpu_s"]
    }
    row["status"] = " ".join(sorted({answer["status"] for answer in answers}))
    scatter = 100 * sizes.std(ddof=1) / sizes.mean()
    return row | dict(sizes.mean()) | {f"{size}_scatter_percent": scatter[size] for size in SIZES}


def collect():
    """One row a case: what it was, its sizes [mm] and its cost."""
    rows = []
    for series in SERIES:
        geometry, grains, *_ = series
        for elements, shape, velocity in convergence_cases(series):
            names = convergence_names(series, (elements, shape, velocity))
            case = {
                "geometry": geometry,
                "grains": grains,
                "elements": elements,
                "shape": shape,
                "velocity_m_s": velocity,
                "seeds": len(names),
            }
            rows.append(case | mean_row([read_run(name) for name in names]))
    return pd.DataFrame(rows)


def extrapolated(part):
    """A case's sizes in infinitely many cells: a line in the width of the refined cells.

    First order, for the slowest sizes: foot and undeformed length. A size's variance is that
    of its seeds, pooled over the widths.
    """
    cells = part[(part["geometry"] == "axisymmetric") & (part["elements"] > COARSE_COLUMNS)]
    line = np.column_stack([np.ones(len(cells)), 1 / cells["elements"]])
    weights = np.linalg.pinv(line)[0]
    row = dict(cells.iloc[0][["shape", "velocity_m_s", "grains"]]) | {"geometry": "extrapolated"}
    for size in SIZES:
        values = cells[size].to_numpy(float)
        scatter = values * cells[f"{size}_scatter_percent"].to_numpy(float) / 100
        error = np.sqrt((weights**2).sum() * np.mean(scatter**2 / cells["seeds"]))
        row[size] = weights @ values
        row[f"{size}_scatter_percent"] = 100 * error / row[size]
    return row


def add_limits(table):
    """Adds a row of extrapolated sizes for each shape and velocity."""
    limits = [
        extrapolated(part) for _, part in table.groupby(["shape", "velocity_m_s"], sort=False)
    ]
    return pd.concat([table, pd.DataFrame(limits)], ignore_index=True)


def limit_of(part):
    """{size: value} of a case in the finest axisymmetric cells."""
    cells = part[part["geometry"] == "axisymmetric"]
    return cells.loc[cells["elements"].idxmax(), SIZES]


def add_deviations(table):
    """Adds each size's deviation from its case's limit [%]."""
    table = table.copy()
    for _, part in table.groupby(["shape", "velocity_m_s"]):
        limit = limit_of(part)
        for size in SIZES:
            deviation = 100 * (part[size] / limit[size] - 1)
            table.loc[part.index, f"{size}_deviation_percent"] = deviation.astype(float)
    return table


def from_extrapolated(table):
    """How far the refined axisymmetric cells' sizes are from the extrapolated ones [%]."""
    case = ["shape", "velocity_m_s"]
    limits = table[table["geometry"] == "extrapolated"].set_index(case)[SIZES]
    cells = table[(table["geometry"] == "axisymmetric") & (table["elements"] > COARSE_COLUMNS)]
    sizes = cells.set_index([*case, "elements"])[SIZES].astype(float)
    return 100 * (sizes / limits.astype(float) - 1)


def legend_handles():
    """A colour for each size, a style for each geometry and number of grains."""
    sizes = [
        Line2D([], [], color=COLOURS[size], label=size.removesuffix("_mm").replace("_", " "))
        for size in DRAWN
    ]
    series = []
    for (geometry, grains), style in STYLES.items():
        words = f"{geometry}, {grains} grain{'s' if grains > 1 else ''} a point"
        series.append(Line2D([], [], color="0.3", markersize=4, label=words, **style))
    limit = Line2D(
        [], [], color="0.3", marker="_", linestyle="", label="axisymmetric, extrapolated"
    )
    return sizes + series + [limit]


def draw(table, path):
    figure, axes = plt.subplots(len(SHAPES), len(VELOCITIES), figsize=(11, 12), sharex=True)
    for row, shape in zip(axes, SHAPES):
        for axis, velocity in zip(row, VELOCITIES):
            case = table[(table["shape"] == shape) & (table["velocity_m_s"] == velocity)]
            for (geometry, grains), style in STYLES.items():
                part = case[(case["geometry"] == geometry) & (case["grains"] == grains)]
                for size in DRAWN:
                    axis.plot(
                        part["elements"],
                        part[f"{size}_deviation_percent"],
                        markersize=4,
                        color=COLOURS[size],
                        **style,
                    )
            limit = case[case["geometry"] == "extrapolated"].iloc[0]
            for k, size in enumerate(DRAWN):
                axis.errorbar(
                    LIMIT_PLACE + 0.25 * (k - (len(DRAWN) - 1) / 2),
                    limit[f"{size}_deviation_percent"],
                    limit[f"{size}_scatter_percent"],
                    marker="_",
                    color=COLOURS[size],
                )
            axis.axhspan(-1, 1, color="0.92", zorder=0)
            axis.set_title(f"{SHAPE_WORDS[shape]}, {velocity} m/s", fontsize=10)
            axis.set_yscale("symlog", linthresh=2)
            axis.set_ylim(-60, 60)
            axis.set_yticks([-30, -10, -2, -1, 0, 1, 2, 10, 30])
            axis.set_yticklabels(["-30", "-10", "-2", "-1", "0", "1", "2", "10", "30"])
            axis.set_xticks([*range(4, 17, 4), LIMIT_PLACE], ["4", "8", "12", "16", r"$\infty$"])
    for axis in axes[-1]:
        axis.set_xlabel("nominal cells or particles across")
    for axis in axes[:, 0]:
        axis.set_ylabel("from the finest cells [%]")
    figure.legend(handles=legend_handles(), loc="lower center", ncol=3, fontsize=9)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    figure.savefig(path, dpi=110)


def main(table_path, figure_path):
    table = add_deviations(add_limits(collect()))
    table.round(4).to_csv(table_path, index=False)
    draw(table, figure_path)
    columns = [f"{size}_deviation_percent" for size in DRAWN]
    worst = table.groupby(["geometry", "grains", "elements"])[columns].agg(lambda x: x.abs().max())
    print(worst.round(2).to_string())
    print("from the extrapolated sizes [%]:")
    print(from_extrapolated(table).round(2).to_string())
    print(
        table.groupby(["geometry", "grains", "elements", "shape"])["cpu_s"]
        .max()
        .round(1)
        .to_string()
    )


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
