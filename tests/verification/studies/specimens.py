"""The four specimens before and after a shot at 90 m/s, with the sizes that are measured."""

import h5py
import matplotlib
from impact_runs import RUNS, SHAPE_WORDS, SHAPES, files_of, read_run, run_name

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

VELOCITY = 90  # [m/s]
LENGTH, RADIUS = 40, 4  # before the shot [mm]
# Of each shape, shares of length and radius: outline from the anvil up, height of the section.
BEFORE = {
    "uniform_cylinder": ([(0, 1), (1, 1)], 0.25),
    "reduced_head_4mm": ([(0, 0.5), (0.25, 0.5), (0.25, 1), (1, 1)], 0.25),
    "reduced_head_3mm": ([(0, 0.375), (0.25, 0.375), (0.25, 1), (1, 1)], 0.25),
    "truncated_cone": ([(0, 0.25), (0.5, 1), (1, 1)], 0.5),
}
APART = 22  # between the axes of two drawings [mm]
COPPER, INK = "#d9a577", "0.25"


def specimen_runs():
    """Names of the runs that are drawn, by shape: axisymmetric, as cells of `standard`."""
    return {shape: run_name("axisymmetric", 8, 16, shape, VELOCITY) for shape in SHAPES}


def specimen_files(wildcards):
    """Where their answers are."""
    return files_of(specimen_runs().values())


def mirrored(heights, radii, middle):
    """x and y of a closed outline about the axis x = middle."""
    x = [middle + r for r in radii] + [middle - r for r in reversed(radii)]
    return x, [*heights, *reversed(heights)]


def measure(axis, start, end, words, aside=(0.7, 0), turned=0):
    """An arrow between the ends of a size, and its name."""
    style = {"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", start, end, arrowprops=style)
    middle = [(a + b) / 2 + d for a, b, d in zip(start, end, aside)]
    centred = {"ha": "center", "va": "top"} if aside[0] == 0 else {"ha": "left", "va": "center"}
    axis.text(*middle, words, fontsize=7.5, color=INK, rotation=turned, **centred)


def draw_shape(axis, shape, name, middle):
    """Grey what was fired, copper what is left; returns the sizes [mm] after the shot."""
    points, section = BEFORE[shape]
    heights, radii = zip(*[(LENGTH * h, RADIUS * r) for h, r in points])
    axis.plot(*mirrored(heights, radii, middle), color="0.6", linewidth=0.9, linestyle="--")
    axis.plot([middle - 5, middle + 5], [section * LENGTH] * 2, color="0.8", linewidth=0.7)
    with h5py.File(RUNS / f"{name}.h5") as file:
        outline = file["outline"][:]
    x, y = mirrored(outline[:, 0].tolist(), outline[:, 1].tolist(), middle)
    axis.fill(x, y, facecolor=COPPER, edgecolor=INK, linewidth=0.8)
    axis.text(middle, LENGTH + 1.5, SHAPE_WORDS[shape], ha="center", fontsize=10)
    return read_run(name)["sizes"]


def main(path):
    figure, axis = plt.subplots(figsize=(11, 5.6))
    for k, (shape, name) in enumerate(specimen_runs().items()):
        middle = APART * k
        sizes = draw_shape(axis, shape, name, middle)
        length, head = sizes["final_length_mm"], sizes["head_length_mm"]
        face, section = sizes["impact_diameter_mm"] / 2, sizes["transition_diameter_mm"] / 2
        right = middle + 5.6
        measure(axis, (middle - face, -1), (middle + face, -1), "face", (0, -0.5))
        measure(axis, (right, 0), (right, head), "head length")
        measure(axis, (right, head), (right, length), "rear length")
        measure(axis, (middle - 5.6, 0), (middle - 5.6, length), "length", (-4.6, 0))
        measure(axis, (middle - section, head), (middle + section, head), "section", (0, -0.3))
        undeformed = length - sizes["undeformed_length_mm"]
        measure(
            axis, (middle + 1, undeformed), (middle + 1, length), "undeformed length", (-2.4, 0), 90
        )
    axis.axhline(0, color=INK, linewidth=2.5)
    axis.set(aspect="equal", xlim=(-11, 3 * APART + 14), ylim=(-4, LENGTH + 4))
    axis.set_axis_off()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main(snakemake.output[0])  # noqa: F821
