"""The energy of fast impacts: kinetic and total against time, and where it went."""

import h5py
import matplotlib
import pandas as pd
from impact_runs import RUNS, SHAPE_WORDS, SHAPES, read_run
from impact_study import ENERGY_SETTINGS, ENERGY_VELOCITY, energy_name

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def history(name):
    with h5py.File(RUNS / f"{name}.h5") as file:
        return pd.DataFrame(file["history"][:], columns=list(file["history"].attrs["names"]))


def collect():
    """One row a run: shares of the initial kinetic energy [%]."""
    rows = []
    for setting in ENERGY_SETTINGS:
        for shape in SHAPES:
            name = energy_name(setting, shape)
            answer = read_run(name)
            found = answer["descriptors"]
            initial = history(name)["kinetic_energy_J"][0]
            rows.append(
                {
                    "geometry": setting[0],
                    "shape": shape,
                    "status": answer["status"],
                    "initial_J": initial,
                    "plastic_percent": 100 * found["plastic_work_J"] / initial,
                    "viscous_percent": 100 * found["viscous_share"],
                    "hourglass_percent": 100 * found["hourglass_share"],
                    "energy_error_percent": 100 * found["energy_error"],
                }
            )
    return pd.DataFrame(rows)


def draw(table, path):
    figure, axes = plt.subplots(len(ENERGY_SETTINGS), len(SHAPES), figsize=(14, 6.5), sharey=True)
    for row, setting in zip(axes, ENERGY_SETTINGS):
        for axis, shape in zip(row, SHAPES):
            times = history(energy_name(setting, shape))
            initial = times["kinetic_energy_J"][0]
            found = table[(table["geometry"] == setting[0]) & (table["shape"] == shape)].iloc[0]
            axis.plot(times["time_us"], 100 * times["total_energy_J"] / initial, "k", label="total")
            axis.plot(times["time_us"], 100 * times["kinetic_energy_J"] / initial, label="kinetic")
            axis.set_title(
                f"{SHAPE_WORDS[shape]}, {setting[0]}\nplastic {found['plastic_percent']:.1f} %,"
                f" viscous {found['viscous_percent']:.2f} %,\nhourglass"
                f" {found['hourglass_percent']:.2f} %, lost or gained"
                f" {found['energy_error_percent']:.3f} %",
                fontsize=9,
            )
    for axis in axes[-1]:
        axis.set_xlabel("time [us]")
    for axis in axes[:, 0]:
        axis.set_ylabel("of the initial energy [%]")
    axes[0, 0].legend(fontsize=9)
    figure.suptitle(f"{ENERGY_VELOCITY} m/s, coarse", fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(table_path, figure_path):
    table = collect()
    table.round(4).to_csv(table_path, index=False)
    draw(table, figure_path)
    print(table.round(3).to_string())


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
