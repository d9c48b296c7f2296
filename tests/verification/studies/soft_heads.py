"""A soft head that folds: our sizes against the number of cells or particles, and the limit.

The limit is that of finite elements (`data/reduced_head_finite_elements.csv`).
"""

import json
from pathlib import Path

import finite_elements
import matplotlib
import pandas as pd
from head_runs import FINEST_COLUMNS, SOFT_LEVELS, SOFT_SHOT, TABLE, soft_head_answer

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

WORDS = {"axisymmetric": "cells", "3d": "particles"}
STYLES = {"axisymmetric": "o-", "3d": "^--"}


def collect():
    """One row a run: sizes [mm] and how far they are from the finite elements' [%]."""
    theirs = finite_elements.computed(TABLE, "soft", SOFT_SHOT, FINEST_COLUMNS)
    rows = []
    for geometry, levels in SOFT_LEVELS.items():
        for elements in levels:
            answer = json.loads(Path(soft_head_answer(geometry, elements)).read_text())
            sizes = {name: answer["sizes"][name] for name in theirs}
            deviations = {
                name.replace("_mm", "_deviation_percent"): 100 * (sizes[name] / theirs[name] - 1)
                for name in theirs
            }
            case = {"geometry": geometry, "elements": elements}
            rows.append(case | sizes | deviations)
    return pd.DataFrame(rows)


def draw(table, path):
    figure, axes = plt.subplots(1, len(SOFT_LEVELS), figsize=(11, 4.5), sharey=True)
    for axis, (geometry, part) in zip(axes, table.groupby("geometry", sort=False)):
        for name in finite_elements.SIZES:
            deviation = part[name.replace("_mm", "_deviation_percent")]
            words = name.removesuffix("_mm").replace("_", " ")
            axis.plot(part["elements"], deviation, STYLES[geometry], label=words)
        axis.axhspan(-0.5, 0.5, color="0.9", zorder=0)
        axis.axhline(0, color="0.5", lw=0.8)
        axis.set_title(f"4-mm head, soft J2, {SOFT_SHOT} m/s: {geometry}", fontsize=10)
        axis.set_xlabel(f"{WORDS[geometry]} across the rear's radius")
    axes[0].set_ylabel("from finite elements [%]; grey: 0.5 %")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(table_path, figure_path):
    table = collect()
    table.round(4).to_csv(table_path, index=False)
    draw(table, figure_path)
    print(table.round(3).to_string(index=False))


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
