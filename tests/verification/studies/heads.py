"""Heads with J2: our outlines and sizes beside those of finite elements."""

import json
from pathlib import Path

import finite_elements
import h5py
import matplotlib
import pandas as pd
from head_runs import COLUMNS, FIDELITIES, GEOMETRIES, SHOTS, head_stem

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

DRAWN = {"finite elements": "k-", "axisymmetric, fine": "C0-", "3d, fine": "C1--"}
TOP = {50: 9.5, 90: 6.5}  # of the part that is shown [mm]


def ours(velocity, geometry, fidelity):
    """A row of sizes, and height and radius of the outline [mm]."""
    stem = head_stem(velocity, geometry, fidelity)
    sizes = json.loads(Path(stem + ".json").read_text())["sizes"]
    with h5py.File(stem + ".h5") as file:
        outline = file["outline"][:]
    return {name: sizes[name] for name in finite_elements.SIZES}, outline


def collect():
    """Rows by shot and method, and the outlines by the same."""
    rows, outlines = [], {}
    for velocity in SHOTS:
        theirs, bar = finite_elements.impact(COLUMNS, velocity, "hard")
        answers = {"finite elements": (theirs, bar.outline())}
        for geometry in GEOMETRIES:
            for fidelity in FIDELITIES:
                answers[f"{geometry}, {fidelity}"] = ours(velocity, geometry, fidelity)
        for method, (sizes, outline) in answers.items():
            deviations = {
                name.replace("_mm", "_deviation_percent"): 100 * (sizes[name] / theirs[name] - 1)
                for name in finite_elements.SIZES
            }
            rows.append({"velocity_m_s": velocity, "method": method, **sizes, **deviations})
            outlines[velocity, method] = outline
    return pd.DataFrame(rows), outlines


def draw(table, outlines, path):
    figure, axes = plt.subplots(1, len(SHOTS), figsize=(11, 7))
    for axis, velocity in zip(axes, SHOTS):
        for method, style in DRAWN.items():
            height, radius = outlines[velocity, method].T
            row = table[(table["velocity_m_s"] == velocity) & (table["method"] == method)].iloc[0]
            label = f"{method}: head {row['head_length_mm']:.3f} mm"
            axis.plot(radius, height, style, lw=1.2, label=label)
        axis.set(xlim=(0, 5), ylim=(0, TOP[velocity]), aspect="equal")
        axis.set_title(f"4-mm head, J2, {velocity} m/s", fontsize=10)
        axis.set_xlabel("radius [mm]")
        axis.set_ylabel("height from the impact face [mm]")
        axis.legend(fontsize=8, loc="upper left")
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(table_path, figure_path):
    table, outlines = collect()
    table.round(4).to_csv(table_path, index=False)
    draw(table, outlines, figure_path)
    print(table.round(3).to_string(index=False))


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
