"""Which effects a table of 50 shots could show, by what is measured of each shot.

g is the change of all data with an effect at its typical size, J with the parameters, both in
standard errors of measurement; P projects on what no change of the parameters can do.
Identifiability is |P g| / |g|; the signal |P g| is how many standard errors the effect stands
out by when the parameters are refitted.
"""

import json

import h5py
import matplotlib
import numpy as np
import pandas as pd
from identifiability_runs import HOT_K, ROOM_K
from paired_runs import read_pairs

from make_synthetic_table import NOISE, TRUTH, VELOCITY_NOISE
from outlines.measured import MeasuredOutline
from outlines.projection import project
from size_kinds import OUTLINE_SCORES

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SHOTS = 50
# A careful outline: dots evenly up the specimen, each with its error, all with one scale.
DOTS, DOT_SD_MM, SCALE_SD = 20, 0.05, 0.005
CASES = {
    "sizes": (False, [ROOM_K]),
    "sizes, hot shots": (False, [ROOM_K, HOT_K]),
    "sizes, outlines": (True, [ROOM_K]),
    "sizes, outlines, hot shots": (True, [ROOM_K, HOT_K]),
}
TELLING = 3  # standard errors


def outline_errors(pair, basis):
    """Standard errors [mm] of the scores of a careful outline of this specimen."""
    diameter_mm, length_mm = pair.shot["initial_diameter_mm"], pair.base["final_length_mm"]
    share = (np.arange(DOTS) + 0.5) / DOTS
    scores = np.array([pair.base[name] for name in OUTLINE_SCORES]) / (diameter_mm / 2)
    measured = MeasuredOutline(
        height_mm=share * length_mm,
        radius_mm=basis.outline(pair.shape, scores, share) * diameter_mm / 2,
        radius_sd_mm=np.full(DOTS, DOT_SD_MM),
        length_mm=length_mm,
        length_sd_mm=NOISE["final_length_mm"] * length_mm,
    )
    return project(measured, basis, pair.shape, diameter_mm, SCALE_SD).sd


def velocity_slopes(pairs, sizes):
    """Of each specimen, change of its sizes with velocity [mm/(m/s)], from its neighbours."""
    slopes = [None] * len(pairs)
    keys = {(pair.shape, pair.shot["initial_temperature_K"]) for pair in pairs}
    for key in keys:
        mine = [
            index
            for index, pair in enumerate(pairs)
            if (pair.shape, pair.shot["initial_temperature_K"]) == key
        ]
        mine.sort(key=lambda index: pairs[index].shot["velocity_m_s"])
        velocity = [pairs[index].shot["velocity_m_s"] for index in mine]
        values = np.array([[pairs[index].base[size] for size in sizes] for index in mine])
        for index, slope in zip(mine, np.gradient(values, velocity, axis=0)):
            slopes[index] = slope
    return slopes


def whitened_changes(runs, with_outlines, temperatures):
    """By input: the change of all data, in standard errors, one after the other [data]."""
    specimens = [
        specimen
        for specimen in runs.specimens
        if specimen.shot["initial_temperature_K"] in temperatures
    ]
    paired = sum(bool(specimen.changes) for specimen in specimens)
    sizes = [*NOISE, *(OUTLINE_SCORES if with_outlines else [])]
    changes = {name: [] for name in runs.amplitudes}
    for pair, slope in zip(specimens, velocity_slopes(specimens, sizes)):
        if not pair.changes:
            continue
        sd = [relative * pair.base[size] for size, relative in NOISE.items()]
        if with_outlines:
            sd = [*sd, *outline_errors(pair, runs.basis)]
        of_velocity = slope * VELOCITY_NOISE * pair.shot["velocity_m_s"]
        errors = np.diag(np.square(sd)) + np.outer(of_velocity, of_velocity)
        root = np.linalg.cholesky(errors)
        for name, change in pair.changes.items():
            values = np.array([change[size] for size in sizes])
            changes[name].append(np.linalg.solve(root, values))
    shots_a_specimen = SHOTS / paired
    return {
        name: np.concatenate(parts) * shots_a_specimen**0.5 for name, parts in changes.items()
    }


def outside_span(parameters, effect):
    """P g: what of an effect no change of the parameters [data x parameters] can do."""
    basis, _ = np.linalg.qr(parameters)
    return effect - basis @ (basis.T @ effect)


def tabulate(runs):
    """One row an effect and case."""
    rows = []
    for case, (with_outlines, temperatures) in CASES.items():
        changes = whitened_changes(runs, with_outlines, temperatures)
        parameters = np.column_stack([changes[name] for name in TRUTH])
        for name, amplitude in runs.amplitudes.items():
            if name not in TRUTH:
                left = np.linalg.norm(outside_span(parameters, changes[name]))
                whole = np.linalg.norm(changes[name])
                rows.append(
                    {
                        "effect": name,
                        "amplitude": amplitude,
                        "measured": case,
                        "identifiability": left / whole if whole > 0 else 0.0,
                        "whole_signal": whole,
                        "signal": left,
                    }
                )
    return pd.DataFrame(rows)


def draw(table, caption, path):
    effects = list(dict.fromkeys(table["effect"]))
    first = table[table["measured"] == "sizes"].set_index("effect")["signal"]
    effects.sort(key=lambda effect: first[effect])
    figure, axes = plt.subplots(1, 2, figsize=(11, 1.6 + 0.42 * len(effects)), sharey=True)
    height = 0.8 / len(CASES)
    for k, case in enumerate(CASES):
        part = table[table["measured"] == case].set_index("effect").loc[effects]
        places = np.arange(len(effects)) + height * ((len(CASES) - 1) / 2 - k)
        for axis, column in zip(axes, ["identifiability", "signal"]):
            axis.barh(places, part[column], height, label=case)
    axes[0].set_yticks(range(len(effects)), [effect.replace("_", " ") for effect in effects])
    axes[0].set_xlabel("identifiability |P g| / |g|")
    axes[0].set_xlim(0, 1)
    axes[1].set_xlabel(f"signal of {SHOTS} shots [standard errors]")
    axes[1].set_xscale("log")
    axes[1].axvline(TELLING, color="0.4", lw=1)
    for axis in axes:
        axis.grid(axis="x", alpha=0.3)
    axes[1].legend(fontsize=8, loc="lower right")
    figure.suptitle(caption, fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(database, table_path, figure_path):
    runs = read_pairs(database)
    with h5py.File(database) as file:
        count = len(file["status"])
        fidelity = json.loads(file.attrs["configuration"])["fidelity"]
        version = json.loads(file.attrs["provenance"])["revision"]
    table = tabulate(runs)
    table.to_csv(table_path, index=False, float_format="%.4g")
    caption = (
        f"Effects at their typical size beside optimum (ii): {len(runs.pairs)} specimens, {count} "
        f"axisymmetric runs, {fidelity}, solver {version}"
    )
    draw(table, caption, figure_path)
    for column in ["identifiability", "signal"]:
        print(column)
        print(table.pivot_table(index="effect", columns="measured", values=column).round(3))


if __name__ == "__main__":
    main(snakemake.input.database, *snakemake.output)  # noqa: F821
