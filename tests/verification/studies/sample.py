"""A random sample over the paper's Table 2: which runs end, which do not, and why."""

import json
import re

import h5py
import matplotlib
import numpy as np
import pandas as pd
from impact_runs import SHAPE_WORDS, SHAPES
from sample_runs import PARAMETERS, command_of

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

STATUSES = ["stopped", "not_stopped", "failed", "over_cpu_limit"]  # 0, 1, 2, 3
MARKS = {"stopped": ("o", "C0"), "not_stopped": ("s", "C1"), "failed": ("X", "C3")}
MARKS["over_cpu_limit"] = ("^", "C4")
WORDS = {"stopped": "stopped", "not_stopped": "not stopped", "failed": "failed"}
WORDS["over_cpu_limit"] = "over its limit of processor time"
NUMBER = re.compile(r"\d[\d.]*(?:e[-+]?\d+)?")


def texts(values):
    return [value.decode() for value in values]


def collect(path):
    """One row a run: inputs, status, reason, descriptors and cost, and the fidelity."""
    with h5py.File(path) as file:
        rows = pd.DataFrame(file["inputs"][:], columns=list(file["inputs"].attrs["names"]))
        descriptors = list(file["descriptors"].attrs["names"])
        rows[descriptors] = file["descriptors"][:]
        for name in ["run_id", "seed", "steps"]:
            rows[name] = file[name][:]
        rows["shape"] = texts(file["shape"][:])
        rows["status"] = [STATUSES[status] for status in file["status"][:]]
        rows["reason"] = texts(file["reason"][:])
        fidelity = json.loads(file.attrs["configuration"])["fidelity"]
    costs = pd.read_csv(f"{path}.cost.csv")
    return rows.merge(costs, on="run_id", validate="one_to_one"), fidelity


def kind_of(reason):
    """A reason without its figures and place."""
    return NUMBER.sub("n", re.sub(r" at r = .*| after .*| \(.*", "", reason))


def summarise(runs):
    """One row a shape, and one for all."""
    rows = []
    for shape in [*SHAPES, "all"]:
        part = runs if shape == "all" else runs[runs["shape"] == shape]
        lost = part[part["status"] != "stopped"]
        kinds = lost["reason"].map(kind_of).value_counts()
        rows.append(
            {
                "shape": shape,
                "runs": len(part),
                **{status: (part["status"] == status).sum() for status in STATUSES},
                "largest_energy_error": part.loc[part["status"] == "stopped", "energy_error"].max(),
                "cpu_s": part["cpu_s"].sum(),
                "reasons": "; ".join(f"{count} x {kind}" for kind, count in kinds.items()),
            }
        )
    return pd.DataFrame(rows)


def lost_runs(runs, fidelity):
    """The runs that did not end as they should, with what computes them again."""
    lost = runs[runs["status"] != "stopped"].copy()
    lost["command"] = [command_of(run, fidelity) for run in lost.to_dict("records")]
    columns = ["run_id", "shape", "velocity_m_s", *PARAMETERS, "status", "reason", "command"]
    return lost[columns]


def scatter(axis, runs, x, y):
    for status in STATUSES:
        part = runs[runs["status"] == status]
        marker, colour = MARKS[status]
        axis.scatter(
            part[x],
            part[y],
            s=16 if status == "stopped" else 50,
            c=colour,
            marker=marker,
            label=f"{WORDS[status]} ({len(part)})",
            zorder=2 if status == "stopped" else 3,
        )


def draw(runs, fidelity, path):
    figure, axes = plt.subplots(2, len(SHAPES), figsize=(14, 7))
    # What was lost at once has no energy balance, or one beyond all bounds.
    shown = runs.assign(percent=100 * runs["energy_error"].fillna(1).clip(1e-6, 1))
    for column, shape in zip(axes.T, SHAPES):
        part = shown[shown["shape"] == shape]
        scatter(column[0], part, "velocity_m_s", "percent")
        column[0].set_title(f"{SHAPE_WORDS[shape]}, {len(part)} runs", fontsize=10)
        column[0].set_yscale("log")
        column[0].set_ylim(5e-5, 200)
        column[0].axhline(2, color="0.6", lw=1)
        column[0].set_xlabel("velocity [m/s]")
        column[0].legend(fontsize=8)
        scatter(column[1], part, "rho_immobile_initial", "hardening_coefficient")
        column[1].set_xscale("log")
        column[1].set_xlabel("initial immobilized density [1/m2]")
    axes[0, 0].set_ylabel("energy error [%] (grey: given up)")
    axes[1, 0].set_ylabel("hardening coefficient")
    seconds = runs["cpu_s"].sum()
    figure.suptitle(
        f"{len(runs)} axisymmetric runs over Table 2, {fidelity}, {seconds:.0f} s of processor"
        f" time, median {np.median(runs['cpu_s']):.2f} s",
        fontsize=11,
    )
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main(database, table_path, lost_path, figure_path):
    runs, fidelity = collect(database)
    table = summarise(runs)
    table.to_csv(table_path, index=False, float_format="%.4g")
    lost_runs(runs, fidelity).to_csv(lost_path, index=False, float_format="%.6g")
    draw(runs, fidelity, figure_path)
    print(table.to_string(index=False))


if __name__ == "__main__":
    main(snakemake.input.database, *snakemake.output)  # noqa: F821
