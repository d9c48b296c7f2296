"""The source paper's statements beside our own figures, and plots like its Figures 16-23.

Everything drawn here is computed by taylorcal; the paper's figures are the numbers of the table.
"""

from pathlib import Path

import h5py
import matplotlib
import numpy as np
from impact_runs import RUNS, SHAPE_WORDS, read_run
from paper_statements import (
    ELEMENTS,
    GRAINS,
    SOLID_ELEMENTS,
    SOLID_GRAINS,
    STATEMENTS,
    axisymmetric_name,
    solid_name,
)

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import PathPatch  # noqa: E402
from matplotlib.path import Path as Outline  # noqa: E402

TOP_SPEEDS = {
    "uniform_cylinder": 117.6,
    "reduced_head_4mm": 112.4,
    "reduced_head_3mm": 120,
    "truncated_cone": 125,
}
FIELDS = [
    ("equivalent_plastic_strain", "plastic strain", "viridis"),
    ("temperature_K", "temperature [K]", "inferno"),
    ("von_mises_GPa", "von Mises stress [GPa]", "cividis"),
    ("grain_diameter_um", "grain diameter [um]", "viridis_r"),
    ("weakened_fraction", "weakened fraction", "magma"),
]


COMMENTS = [
    "",
    "Where we differ: rates of (r, z) are those of the foot's rim averaged over 1 us, rates of",
    "3d are those of the lowest layer between two records of the history, which lowers peaks of",
    "some 100 ns in both. Our annihilated energy, from which grain size and weakened fraction",
    "follow, is twice the paper's in the uniform cylinder; the paper's figures are read off",
    "maps whose place is not stated, ours are extremes over the specimen. The mean von Mises",
    "stress is, at half the stop time, that of the part that deforms in (r, z), and of the part",
    "that has deformed by 5 % in 3d. Heads and cone stay cooler than stated but for the cone's",
    "tip, whose hottest particle in 3d ends above copper's melting point (1358 K): the model",
    "does not melt.",
]


def table():
    lines = [
        "The paper's statements at its optimum (ii) and ours (axisymmetric,",
        f"{ELEMENTS} cells across the radius, {GRAINS} grains each;",
        f"3d, {SOLID_ELEMENTS} particles across the radius, {SOLID_GRAINS} grain each).",
        "",
        f"{'case':<28}{'':<32}{'paper':>12}{'(r, z)':>10}{'3d':>10}",
    ]
    for s in STATEMENTS:
        ours = [
            s.scale * read_run(name(s.shape, s.velocity))["descriptors"][s.descriptor]
            for name in (axisymmetric_name, solid_name)
        ]
        case = f"{SHAPE_WORDS[s.shape]}, {s.velocity:g} m/s"
        lines.append(
            f"{case:<28}{s.what:<32}{s.stated:>12}" + "".join(f"{value:>10.3g}" for value in ours)
        )
    return "\n".join(lines + COMMENTS) + "\n"


def draw_section(axis, file, field, colours):
    """The middle section: a field between the outline's two halves."""
    height, radius = file["outline"][:].T
    corners = np.concatenate([np.c_[radius, height], np.c_[-radius, height][::-1]])
    r, z = file["fields/x_mm"][:], file["fields/z_mm"][:]
    values = file[f"fields/{field}"][:]
    drawn = axis.tricontourf(
        np.concatenate([r, -r]), np.concatenate([z, z]), np.tile(values, 2), 24, cmap=colours
    )
    edge = PathPatch(Outline(corners), facecolor="none", edgecolor="0.3", linewidth=0.6)
    axis.add_patch(edge)
    for part in drawn.collections:
        part.set_clip_path(edge)
    axis.set_aspect("equal")
    axis.set_xlim(-1.15 * radius.max(), 1.15 * radius.max())
    axis.set_ylim(0, 1.02 * height.max())
    axis.figure.colorbar(drawn, ax=axis, shrink=0.8, format="%.3g")


def draw_sections(path):
    figure, axes = plt.subplots(
        len(TOP_SPEEDS), len(FIELDS), figsize=(15, 22), layout="constrained"
    )
    for row, (shape, velocity) in zip(axes, TOP_SPEEDS.items()):
        with h5py.File(RUNS / f"{axisymmetric_name(shape, velocity)}.h5") as file:
            for axis, (field, words, colours) in zip(row, FIELDS):
                draw_section(axis, file, field, colours)
                axis.set_title(words, fontsize=10)
        row[0].set_ylabel(f"{SHAPE_WORDS[shape]}, {velocity:g} m/s\nz [mm]")
    figure.suptitle("Middle section after the impact, computed by taylorcal (axisymmetric)")
    figure.savefig(path, dpi=70, bbox_inches="tight")


def draw_rates(path):
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.5), layout="constrained")
    for shape, velocity in TOP_SPEEDS.items():
        for name, style in [(axisymmetric_name, "-"), (solid_name, ":")]:
            with h5py.File(RUNS / f"{name(shape, velocity)}.h5") as file:
                names = [str(word) for word in file["history"].attrs["names"]]
                history = dict(zip(names, file["history"][:].T))
            label = f"{SHAPE_WORDS[shape]}, {velocity:g} m/s" if style == "-" else None
            colour = f"C{list(TOP_SPEEDS).index(shape)}"
            time = history["time_us"]
            axes[0].plot(
                time,
                history["radial_strain_rate_per_s"] / 1e4,
                style,
                color=colour,
                label=label,
                lw=1,
            )
            axes[1].plot(time, history["largest_temperature_K"], style, color=colour, lw=1)
    axes[0].set_ylabel("radial strain rate of the contact spot [1e4 1/s]")
    axes[1].set_ylabel("largest temperature [K]")
    for axis in axes:
        axis.set_xlabel("time [us]")
    axes[0].legend(fontsize=9, title="solid: axisymmetric, dotted: 3d")
    figure.savefig(path, dpi=110)


def main(table_path, sections_path, rates_path):
    text = table()
    Path(table_path).write_text(text)
    print(text)
    draw_sections(sections_path)
    draw_rates(rates_path)


if __name__ == "__main__":
    main(*snakemake.output)  # noqa: F821
