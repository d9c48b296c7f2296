"""Free-surface velocities of flyer plates: ours against the measured one, and the paper's three."""

import matplotlib
import pandas as pd
from plate_runs import DENSITIES, MEASURED, PAPER, plate_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DATA = "tests/verification/data/flyer_plate_copper_308_m_s.csv"


def draw_ours(axis, experiment):
    for density, colour in zip(DENSITIES, ["C0", "C3"]):
        table = pd.read_csv(plate_file(experiment, density))
        axis.plot(
            table["time_us"],
            table["free_surface_velocity_m_s"],
            color=colour,
            lw=1.2,
            label=f"model, {density} 1/m2 per slip system",
        )


def main(figure_path):
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.5))
    measured = pd.read_csv(DATA)
    for axis in axes[0]:
        axis.plot(measured["time_us"], measured["ufs_m_s"], "k.", ms=4, label="measured")
        draw_ours(axis, MEASURED)
    axes[0, 0].set_title(
        "1.78 mm on 4.00 mm annealed copper, 308 m/s (Thomas et al. 2016)", size=10
    )
    axes[0, 0].annotate(
        "spall: the plate breaks,\nthe model cannot",
        (1.82, 228),
        (2.05, 120),
        arrowprops={"arrowstyle": "->"},
        fontsize=9,
    )
    axes[0, 0].legend(fontsize=8, loc="center left")
    axes[0, 1].set_title("its precursor and rise", size=10)
    axes[0, 1].set_xlim(0.78, 1.05)
    for experiment in PAPER:
        draw_ours(axes[1, 0], experiment)
        draw_ours(axes[1, 1], experiment)
    speeds = ", ".join(experiment.split("_")[1] for experiment in PAPER)
    axes[1, 0].set_title(f"0.56 mm on 2.47 mm, {speeds} m/s (model only)", size=10)
    axes[1, 1].set_title("their precursors", size=10)
    axes[1, 1].set_xlim(0.45, 0.75)
    axes[1, 1].set_ylim(0, 120)
    for axis in axes.flat:
        axis.set_xlabel("time after the impact [us]")
        axis.set_ylabel("free-surface velocity [m/s]")
    figure.tight_layout()
    figure.savefig(figure_path, dpi=100)


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
