"""Johnson-Cook bars: our outlines and sizes beside the published ones."""

import json
from pathlib import Path

import h5py
import matplotlib
import pandas as pd
from bar_runs import FIDELITIES, SHOTS, bar_stem

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DATA = Path("tests/verification/data")
TITLES = {"ofhc_copper": "OFHC copper", "steel_42CrMo4": "42CrMo4 steel"}
STYLES = {"axisymmetric": "C0-", "3d": "C1--"}
SIZES = ["final_length_mm", "impact_diameter_mm"]


def ours(bar, velocity, geometry):
    """A row of sizes as in the table of published ones."""
    answer = json.loads(Path(bar_stem(bar, velocity, geometry) + ".json").read_text())
    return {
        "bar": bar,
        "velocity_m_s": velocity,
        "kind": "ours",
        "by": f"{geometry}, {FIDELITIES[geometry]}",
        **{size: answer["sizes"][size] for size in SIZES},
        **{
            name: answer["descriptors"][name]
            for name in ["largest_temperature_K", "largest_plastic_strain"]
        },
    }


def collect():
    """Published rows, and ours."""
    rows = [ours(*shot, geometry) for shot in SHOTS for geometry in FIDELITIES]
    table = pd.concat([pd.read_csv(DATA / "taylor_bars_johnson_cook.csv"), pd.DataFrame(rows)])
    return table.sort_values(["bar", "velocity_m_s", "kind"], kind="stable")


def draw_shot(axis, bar, velocity, table):
    for geometry, style in STYLES.items():
        with h5py.File(bar_stem(bar, velocity, geometry) + ".h5") as file:
            height, radius = file["outline"][:].T
        label = f"ours, {geometry}, {FIDELITIES[geometry]}: {height.max():.2f} mm"
        axis.plot(height, radius, style, label=label)
    part = table[(table["bar"] == bar) & (table["velocity_m_s"] == velocity)]
    for _, row in part[part["kind"] == "computed"].iterrows():
        label = f"computed, {row['by']}: {row['final_length_mm']:.2f} mm"
        axis.axvline(row["final_length_mm"], color="0.5", ls=":", label=label)
        axis.plot(0, row["impact_diameter_mm"] / 2, "k_", ms=14, clip_on=False)
    for _, row in part[part["kind"] == "measured"].iterrows():
        outlines = pd.read_csv(DATA / "copper_outlines_johnson_cook_1983.csv")
        dots = outlines[outlines["velocity_m_s"] == velocity]
        label = f"measured: {row['final_length_mm']:.2f} mm"
        axis.plot(dots["height_from_impact_face_mm"], dots["radius_mm"], "k.", label=label)
    axis.set_title(f"{TITLES[bar]}, {velocity} m/s", fontsize=10)


def draw(table, path):
    figure, axes = plt.subplots(2, 2, figsize=(12, 8))
    for axis, (bar, velocity) in zip(axes.flat, SHOTS):
        draw_shot(axis, bar, velocity, table)
        axis.set_ylim(3, None)
        axis.set_xlim(0, None)
        axis.legend(fontsize=8, loc="upper right")
        axis.set_xlabel("height from the impact face [mm]")
        axis.set_ylabel("radius [mm]")
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(table_path, figure_path):
    table = collect()
    table.round(3).to_csv(table_path, index=False)
    draw(table, figure_path)
    print(table.round(2).to_string(index=False))


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
