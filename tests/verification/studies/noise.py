"""Scatter of the sizes between seeds of the grain orientations, by setting and shape."""

import matplotlib
import numpy as np
import pandas as pd
from impact_runs import SHAPE_WORDS, SHAPES, SIZES, read_run
from impact_study import NOISE_SEEDS, NOISE_SETTINGS, NOISE_VELOCITY, noise_name

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DRAWN = SIZES[:5]


def setting_words(setting):
    geometry, elements, grains = setting
    plural = "s" if grains > 1 else ""
    return f"{geometry}, {elements} across the radius, {grains} grain{plural}"


def collect():
    """One row a setting, shape and size: mean [mm] and coefficient of variation [%]."""
    rows = []
    for setting in NOISE_SETTINGS:
        for shape in SHAPES:
            answers = [
                read_run(noise_name(setting, shape, seed)) for seed in NOISE_SEEDS[setting[0]]
            ]
            for size in SIZES:
                values = np.array([answer["sizes"][size] for answer in answers], dtype=float)
                rows.append(
                    {
                        "setting": setting_words(setting),
                        "shape": shape,
                        "size": size,
                        "seeds": len(values),
                        "mean_mm": values.mean(),
                        "variation_percent": 100 * values.std(ddof=1) / values.mean(),
                        "cpu_s": np.mean([answer["cpu_s"] for answer in answers]),
                    }
                )
    return pd.DataFrame(rows)


def draw(table, path):
    figure, axes = plt.subplots(1, len(SHAPES), figsize=(13, 4.2), sharey=True)
    settings = [setting_words(setting) for setting in NOISE_SETTINGS]
    for axis, shape in zip(axes, SHAPES):
        for k, setting in enumerate(settings):
            part = table[(table["shape"] == shape) & (table["setting"] == setting)]
            part = part.set_index("size").loc[DRAWN]
            places = np.arange(len(DRAWN)) + 0.8 * ((k + 0.5) / len(settings) - 0.5)
            axis.bar(places, part["variation_percent"], 0.75 / len(settings), label=setting)
        words = [size.removesuffix("_mm").replace("_", "\n") for size in DRAWN]
        axis.set_xticks(range(len(DRAWN)), words, fontsize=8)
        axis.set_title(f"{SHAPE_WORDS[shape]}, {NOISE_VELOCITY} m/s", fontsize=10)
        axis.set_yscale("log")
        axis.grid(axis="y", alpha=0.3)
    axes[0].set_ylabel("coefficient of variation between seeds [%]")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3, fontsize=9)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(path, dpi=110)


def main(table_path, figure_path):
    table = collect()
    table.round(4).to_csv(table_path, index=False)
    draw(table, figure_path)
    print(
        table.pivot_table(index=["setting", "shape"], columns="size", values="variation_percent")[
            SIZES
        ]
        .round(2)
        .to_string()
    )


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
