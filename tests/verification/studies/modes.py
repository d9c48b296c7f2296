"""The solver itself at the modes of the posterior against the table (the source paper's Figures 14,
15, A1, A2), and what separates the modes.
"""

import sys
from pathlib import Path

import h5py
import matplotlib
import numpy as np

from draw_modes import APART, modes_of

sys.path.append("workflow/scripts")

from json_file import read_json  # noqa: E402
from make_confirmation import confirmation, read_runs  # noqa: E402
from make_confirmation_design import shots_in_use  # noqa: E402
from measurements import read_measurements  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {
    "uniform_cylinder": "C0",
    "reduced_head_4mm": "C1",
    "reduced_head_3mm": "C2",
    "truncated_cone": "C3",
}


def runs_of_mode(path: Path, mode: int, ids: list[str]) -> dict[str, dict]:
    """Sizes of each shot of one mode, by the shot's id."""
    numbered = {APART * mode + place: name for place, name in enumerate(ids)}
    with h5py.File(path) as file:
        known = {int(number) for number in file["run_id"][:]}
    if not known >= numbered.keys():
        raise ValueError(f"{path} lacks runs of mode {mode}; make it again.")
    everything = read_runs(path, {**dict.fromkeys(known, ""), **numbered})
    return {name: everything[name] for name in ids}


def place_in_words(place: dict[str, np.ndarray]) -> str:
    return ", ".join(
        f"{name} {float(value[0]):.3g}"
        for name, value in place.items()
        if name != "unexplained_spread"
    )


def draw(table, modes, runs, sizes, path):
    figure, axes = plt.subplots(
        len(modes), len(sizes), figsize=(3.1 * len(sizes), 3.1 * len(modes)), squeeze=False
    )
    for line, (share, _), answers in zip(axes, modes, runs):
        for axis, size in zip(line, sizes):
            for shape, colour in COLOURS.items():
                shots = sorted(
                    (row for row in table if row["shape"] == shape and row.get(size)),
                    key=lambda row: row["velocity_m_s"],
                )
                velocity = [shot["velocity_m_s"] for shot in shots]
                error = [2 * shot[f"{size}_sd"] for shot in shots]
                axis.errorbar(
                    velocity, [s[size] for s in shots], error, fmt=".", color=colour, ms=4, lw=0.7
                )
                axis.plot(
                    velocity,
                    [answers[shot["id"]]["sizes"].get(size, np.nan) for shot in shots],
                    color=colour,
                    lw=1,
                    label=shape.replace("_", " "),
                )
            axis.set_title(size.replace("_", " ").replace(" mm", ", mm"), fontsize=9)
            axis.tick_params(labelsize=7)
        line[0].set_ylabel(f"mode with {100 * share:.0f} %", fontsize=9)
    for axis in axes[-1]:
        axis.set_xlabel("velocity, m/s", fontsize=8)
    axes[0][0].legend(fontsize=6)
    figure.suptitle(
        "Lines: the solver at the modes of the posterior. Points: the synthetic table, two "
        "standard errors",
        fontsize=10,
    )
    figure.tight_layout()
    figure.savefig(path, dpi=90)


def by_size(found: dict) -> dict[str, float]:
    """Whitened RMS of each size over all shots."""
    values: dict[str, list[float]] = {}
    for shot in found["shots"]:
        for cell in shot["sizes"]:
            values.setdefault(cell["size"], []).append(cell["whitened"])
    return {size: float(np.sqrt(np.mean(np.square(parts)))) for size, parts in values.items()}


if __name__ == "__main__":
    inputs, outputs = snakemake.input, snakemake.output  # noqa: F821
    table = shots_in_use(read_measurements(Path(inputs.measurements)))
    modes = modes_of(Path(inputs.posterior))
    comparison = read_json(inputs.comparison)
    ids = [row["id"] for row in table]
    runs = [runs_of_mode(Path(inputs.runs), mode, ids) for mode in range(len(modes))]
    lines = ["The solver at the modes against the synthetic table, whitened RMS:"]
    for (share, place), answers in zip(modes, runs):
        found = confirmation(comparison, answers)
        parts = ", ".join(f"{size} {value:.2f}" for size, value in by_size(found).items())
        fit, held = (found["misfit"][use]["whitened_rms"] for use in ("calibrate", "validate"))
        lines.append(f"{100 * share:3.0f} %  {place_in_words(place)}")
        lines.append(f"       fitted {fit:.2f}, held back {held:.2f}; {parts}")
    Path(outputs.text).write_text("\n".join(lines) + "\n")
    sizes = list(by_size(confirmation(comparison, runs[0])))
    draw(table, modes, runs, sizes, outputs.figure)
