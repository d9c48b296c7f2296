"""What halving the artificial viscosity or the hourglass control does to the sizes: means over
seeds, each compared with itself, and their standard errors."""

import matplotlib
import numpy as np
import pandas as pd
from impact_runs import SHAPE_WORDS, SHAPES, SIZES, read_run
from impact_study import (
    DISSIPATION_CHANGES,
    DISSIPATION_SETTINGS,
    DISSIPATION_VELOCITY,
    dissipation_names,
)

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DRAWN = SIZES[:5]
SETTING = ["geometry", "elements", "grains"]
WORDS = {"viscosity0.5": "half the viscosity", "hourglass0.5": "half the hourglass control"}


def halving(whole, halved):
    """What it changes in the sizes of the same seeds [%]: means and their standard errors."""
    before, after = (
        pd.DataFrame([answer["sizes"] for answer in answers], columns=SIZES).astype(float)
        for answers in (whole, halved)
    )
    change = 100 * (after / before - 1)
    row = {f"{size}_change_percent": change[size].mean() for size in SIZES}
    errors = change.std(ddof=1) / np.sqrt(len(change))
    return row | {f"{size}_standard_error_percent": errors[size] for size in SIZES}


def collect():
    """One row a setting, shape and change."""
    rows = []
    for setting in DISSIPATION_SETTINGS:
        for shape in SHAPES:
            answers = {
                change: [read_run(name) for name in dissipation_names(setting, shape, change)]
                for change in DISSIPATION_CHANGES
            }
            whole = answers[""]
            shares = {
                share: np.mean([answer["descriptors"][share] for answer in whole])
                for share in ("viscous_share", "hourglass_share")
            }
            for change in DISSIPATION_CHANGES[1:]:
                case = dict(zip(SETTING, setting)) | {"shape": shape, "seeds": len(whole)}
                row = halving(whole, answers[change])
                rows.append(case | {"change": change} | shares | row)
    return pd.DataFrame(rows)


def draw(table, path):
    figure, axes = plt.subplots(
        len(DISSIPATION_SETTINGS), len(SHAPES), figsize=(13, 12), sharex=True, sharey="row"
    )
    for row, setting in zip(axes, DISSIPATION_SETTINGS):
        of_setting = table[(table[SETTING] == setting).all(axis=1)]
        geometry, elements, grains = setting
        words = f"{geometry}, {elements} across the radius, {grains} grain{'s' * (grains > 1)}"
        for axis, shape in zip(row, SHAPES):
            part = of_setting[of_setting["shape"] == shape]
            for k, (_, line) in enumerate(part.iterrows()):
                axis.bar(
                    np.arange(len(DRAWN)) + 0.4 * k - 0.2,
                    [line[f"{size}_change_percent"] for size in DRAWN],
                    0.38,
                    yerr=[line[f"{size}_standard_error_percent"] for size in DRAWN],
                    error_kw={"elinewidth": 0.8},
                    label=WORDS[line["change"]],
                )
            axis.axhspan(-0.5, 0.5, color="0.92", zorder=0)
            axis.set_title(
                f"{SHAPE_WORDS[shape]}\n{words}\nviscous {100 * line['viscous_share']:.1f} %,"
                f" hourglass {100 * line['hourglass_share']:.1f} % of the energy",
                fontsize=9,
            )
            names = [size.removesuffix("_mm").replace("_", "\n") for size in DRAWN]
            axis.set_xticks(range(len(DRAWN)), names, fontsize=8)
    for axis in axes[:, 0]:
        axis.set_ylabel("change of the size [%]")
    axes[0, 0].legend(fontsize=8)
    figure.suptitle(f"{DISSIPATION_VELOCITY} m/s", fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main(table_path, figure_path):
    table = collect()
    table.round(4).to_csv(table_path, index=False)
    draw(table, figure_path)
    with pd.option_context("display.width", 300):
        print(table.round(3).to_string())


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
