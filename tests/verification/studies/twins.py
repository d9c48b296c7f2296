"""Do the intervals hold what made the table? Twins of paper_design, each of another metal, made by
the solver with other grains than the database and with noise, and calibrated by the network. The
first twins show how far the network's error at one shot is that at the next one.
"""

import io
import json
import subprocess
from pathlib import Path

import h5py
import matplotlib
import numpy as np
import pandas as pd
import yaml

from twin_tables import LOOKED_AT, SHOTS, twin_designs, write_twin

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from make_synthetic_table import NOISE  # noqa: E402
from scipy.stats import binom  # noqa: E402

INSIDE = (0.5, 0.95)  # shares of the posterior
WORDS = {
    "rho_immobile_initial": "log10 ρI(0) [1/m²]",
    "hardening_coefficient": "AI",
    "immobilization_velocity": "VI [m/s]",
}


def sizes_of(path):
    """Sizes of the noise by run id; none of a run that did not stop."""
    with h5py.File(path) as file:
        names = [str(name) for name in file["outputs"].attrs["names"]]
        sizes = file["outputs"][:][:, [names.index(size) for size in NOISE]]
        sizes[file["status"][:] != 0] = np.nan
        return sizes[np.argsort(file["run_id"][:])]


def sample(folder, twin, emulator, settings):
    """Draws [draws x parameters] of one twin and their names."""
    config, out = folder / "calibrate.json", folder / f"{twin:02d}.h5"
    config.write_text(json.dumps(settings))
    command = ["build/bin/calibrate", "sample", "--emulator", emulator, "--config", config]
    command += ["--measurements", folder / f"{twin:02d}.csv", "--out", out]
    subprocess.run(command, check=True)
    with h5py.File(out) as file:
        names = [str(name) for name in file["draws"].attrs["names"]]
        return file["draws"][:], names, float(file.attrs["effective_sample_size"])


def judged(draws, truth):
    """Where the truth lies among the draws of one parameter."""
    below = float(np.mean(draws < truth))
    row = {"truth": truth, "median": np.median(draws), "below": below}
    for share in INSIDE:
        low, high = np.quantile(draws, [(1 - share) / 2, (1 + share) / 2])
        row |= {f"low_{share:g}": low, f"high_{share:g}": high}
        row[f"inside_{share:g}"] = bool(low <= truth <= high)
    return row


def calibrated(runs, study, emulator, settings, folder):
    folder.mkdir(parents=True, exist_ok=True)
    sizes = sizes_of(runs)
    rows = []
    for twin, design in enumerate(twin_designs(study["parameters"])):
        own = sizes[twin * SHOTS : (twin + 1) * SHOTS]
        shots = write_twin(folder / f"{twin:02d}.csv", design, own, twin)
        draws, names, effective = sample(folder, twin, emulator, settings)
        truth = dict(zip(design["names"], design["inputs"][0]))
        for name in study["parameters"]:
            values, true = draws[:, names.index(name)], truth[name]
            if name == "rho_immobile_initial":
                values, true = np.log10(values), np.log10(true)
            facts = {"twin": twin, "parameter": name, "shots": shots, "effective": effective}
            rows.append({**facts, **judged(values, true)})
    return pd.DataFrame(rows)


def network_errors(runs, emulator, folder):
    """Solver less network [mm], [twin, shape, place in the velocities, size]; NaN: no such run."""
    with h5py.File(runs) as file:
        names = [str(name) for name in file["inputs"].attrs["names"]]
        points = pd.DataFrame(file["inputs"][:], columns=names)
        points.insert(0, "shape", file["shape"].asstr()[:])
        order = np.argsort(file["run_id"][:])
    points.to_csv(folder / "points.csv", index=False)
    command = ["build/bin/emulator", "predict", emulator, folder / "points.csv"]
    told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    answers = pd.read_csv(io.StringIO(told))[list(NOISE)].to_numpy()[order]
    shapes = points["shape"].nunique()
    return (sizes_of(runs) - answers).reshape(-1, shapes, SHOTS // shapes, len(NOISE))


def correlation_words(errors):
    """How errors of the looked-at twins belong together: by distance in velocity, and of shapes."""
    kept = errors[:LOOKED_AT]
    size = np.sqrt(np.nanmean(kept**2, axis=2, keepdims=True))
    # Metals next to none of the database's are left out: their errors are all of one kind.
    usual = size < 3 * np.nanmedian(size, axis=0)
    scaled = np.where(usual, kept / size, np.nan)
    count = scaled.shape[2]
    lags = [
        np.nanmean(scaled[:, :, lag:] * scaled[:, :, : count - lag])
        for lag in range(count // 2 + 1)
    ]
    between = [
        np.nanmean(scaled[:, a] * scaled[:, b]) for a in range(scaled.shape[1]) for b in range(a)
    ]
    return (
        f"correlation of the network's errors at shots 0, 1, 2 ... velocities apart (of {count}): "
        + ", ".join(f"{value:.2f}" for value in lags)
        + f"; between shapes {np.mean(between):.2f}"
    )


def coverage_words(table, title):
    """How many truths lie inside the intervals, and what chance alone gives."""
    lines = [f"{title + ', inside of':32s} 50 %     95 %    of"]
    parts = [(WORDS[name], part) for name, part in table.groupby("parameter", sort=False)]
    for name, part in [*parts, ("all", table)]:
        counts = [int(part[f"inside_{share:g}"].sum()) for share in INSIDE]
        lines.append(f"{name:30s} {counts[0]:6d} {counts[1]:8d}    {len(part)}")
    least, most = (int(binom.ppf(tail, len(table), 0.95)) for tail in (0.025, 0.975))
    lines.append(f"95 % intervals of {len(table)} independent numbers: {least} to {most}")
    return "\n".join(lines)


def words(table, errors):
    looked_at = table["twin"] < LOOKED_AT
    return "\n".join(
        [
            coverage_words(table[~looked_at], "new twins"),
            coverage_words(table[looked_at], "twins looked at"),
            correlation_words(errors),
        ]
    )


def draw(table, path):
    figure, axes = plt.subplots(1, 4, figsize=(15, 3.8))
    for axis, (name, part) in zip(axes, table.groupby("parameter", sort=False)):
        for _, row in part.iterrows():
            colour = "C0" if row["inside_0.95"] else "C3"
            axis.plot([row["truth"]] * 2, [row["low_0.95"], row["high_0.95"]], colour, lw=1)
            axis.plot([row["truth"]] * 2, [row["low_0.5"], row["high_0.5"]], colour, lw=3)
        ends = [part["truth"].min(), part["truth"].max()]
        axis.plot(ends, ends, "0.6", lw=0.8)
        axis.set_title(WORDS[name])
        axis.set_xlabel("truth")
    axes[0].set_ylabel("posterior, 50 and 95 %")
    axes[3].hist(table["below"], bins=np.linspace(0, 1, 11), color="C0", alpha=0.7)
    axes[3].axhline(len(table) / 10, color="0.4", lw=0.8)
    axes[3].set_title("share of draws below the truth")
    figure.suptitle("Synthetic twins; red: the truth is outside of the 95 % interval", fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    inputs, outputs = snakemake.input, snakemake.output  # noqa: F821
    found = calibrated(
        inputs.runs,
        yaml.safe_load(Path(inputs.study).read_text()),
        inputs.emulator,
        json.loads(Path(inputs.settings).read_text()),
        Path(outputs.table).with_suffix(""),
    )
    found.round(5).to_csv(outputs.table, index=False)
    errors = network_errors(inputs.runs, inputs.emulator, Path(outputs.table).with_suffix(""))
    Path(outputs.text).write_text(words(found, errors) + "\n")
    draw(found, outputs.figure)
