"""What cheaper and better runs buy: the network's error on better runs that no training saw,
against the processor time of the runs that it learnt from.
"""

import io
import json
import subprocess
from pathlib import Path

import h5py
import matplotlib
import numpy as np
import pandas as pd

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter  # noqa: E402

from hardening_metal import HARDENING  # noqa: E402

HELD_OUT = 350  # better runs, the last ones of the design
EPOCHS = 1000
MEMBERS = 2
CHEAPER = [0, 600, 2400, 4800]  # runs learnt from; the last half is denser near zero
BETTER = [0, 100, 200, 400]
LABELS = {
    0: "better runs alone",
    600: "+ 600 coarse runs",
    2400: "+ 2400 coarse runs",
    4800: "+ 2400 where metal hardly hardens",
}


def write_rows(source, rows, path):
    """Some rows of a database, in a database of their own."""
    with h5py.File(source) as whole, h5py.File(path, "w") as part:
        for key, value in whole.attrs.items():
            part.attrs[key] = value
        for name, data in whole.items():
            made = part.create_dataset(name, data=data[:][rows], dtype=data.dtype)
            for key, value in data.attrs.items():
                made.attrs[key] = value


def cpu_seconds(database, rows):
    with h5py.File(database) as file:
        ids = file["run_id"][:][rows]
    costs = pd.read_csv(f"{database}.cost.csv").set_index("run_id")["cpu_s"]
    return float(costs.loc[ids].sum())


def error_of(emulator, held_out):
    """RMS and largest relative error [%] over all outputs and shapes, and by output."""
    told = subprocess.run(
        ["build/bin/emulator", "validate", emulator, held_out],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    table = pd.read_csv(io.StringIO(told))
    whole = table[table["output"] == "all"].iloc[0]
    parts = table[table["output"] != "all"].groupby("output")["rms_percent"].mean()
    return {
        "rms_percent": whole["rms_percent"],
        "largest_percent": whole["largest_percent"],
        **{f"{name}_rms_percent": value for name, value in parts.items()},
    }


def hardening_rows(path):
    """Runs whose metal hardens."""
    with h5py.File(path) as file:
        names = [str(name) for name in file["inputs"].attrs["names"]]
        inputs = file["inputs"][:]
    above = [inputs[:, names.index(name)] > least for name, least in HARDENING.items()]
    return np.flatnonzero(np.all(above, axis=0))


def sizes_of(path, names):
    """Sizes by run id; none of a run that did not stop."""
    with h5py.File(path) as file:
        known = [str(name) for name in file["outputs"].attrs["names"]]
        sizes = file["outputs"][:][:, [known.index(name) for name in names]]
        sizes[file["status"][:] != 0] = np.nan
        table = pd.DataFrame(sizes, index=file["run_id"][:], columns=names)
        table["shape"] = file["shape"].asstr()[:]
    return table


def outputs_of(train):
    """Names of the sizes that a network with these settings learns."""
    return [output["name"] for output in json.loads(Path(train).read_text())["outputs"]]


def solver_scatter(better, repeats, names):
    """Scatter of one run about the mean over grains [%], as the network's error is counted: of each
    output's mean by shape. No network can be nearer to single runs."""
    again = sizes_of(repeats, names)
    first = sizes_of(better, names).loc[again.index]
    hardening = again.index[hardening_rows(repeats)]
    rows = []
    for words, chosen in (("all", again.index), ("hardening", hardening)):
        one, other = first.loc[chosen], again.loc[chosen]
        means = one.groupby("shape")[names].transform("mean")
        deviation = 100 * (one[names] - other[names]) / means / np.sqrt(2)
        parts = {name: np.sqrt((deviation[name] ** 2).mean()) for name in names}
        whole = deviation.to_numpy().ravel()
        whole = whole[np.isfinite(whole)]
        rows.append(
            {
                "runs": words,
                "n": len(chosen),
                "rms_percent": np.sqrt(np.mean(whole**2)),
                "largest_percent": np.abs(whole).max(),
                **{f"{name}_rms_percent": value for name, value in parts.items()},
            }
        )
    return pd.DataFrame(rows)


def compare(files, folder, cheaper_counts, better_counts, held_out_count):
    """One row for each number of cheaper and better runs that a network learnt from. `files`: the
    cheaper runs, the better ones, whose last are held out, and the settings of the training."""
    database, better, train = files
    folder.mkdir(parents=True, exist_ok=True)
    with h5py.File(database) as file:
        cheap_count = len(file["run_id"])
    with h5py.File(better) as file:
        better_count = len(file["run_id"])
    held_out = folder / "held_out.h5"
    write_rows(better, np.arange(better_count - held_out_count, better_count), held_out)
    hardening = folder / "held_out_hardening.h5"
    write_rows(held_out, hardening_rows(held_out), hardening)
    settings = {**json.loads(Path(train).read_text()), "epochs": EPOCHS, "members": MEMBERS}
    settings["validation_fraction"] = 0.15
    (folder / "train.json").write_text(json.dumps(settings))
    rows = []
    for cheap in cheaper_counts:
        for good in (n for n in better_counts if n + cheap and n <= better_count - held_out_count):
            files = []
            seconds = 0.0
            for source, count, most in [(database, cheap, cheap_count), (better, good, good)]:
                if not count:
                    continue
                chosen = np.arange(min(count, most))
                files.append(folder / f"{Path(source).stem}_{count}.h5")
                write_rows(source, chosen, files[-1])
                seconds += cpu_seconds(source, chosen)
            emulator = folder / f"c{cheap}_b{good}.json"
            command = ["build/bin/emulator", "train", files[0], "--out", emulator]
            command += ["--better", files[1]] if len(files) > 1 else []
            subprocess.run([*command, "--config", folder / "train.json"], check=True)
            counts = {"cheaper_runs": cheap, "better_runs": good, "core_hours": seconds / 3600}
            softer_left_out = error_of(emulator, hardening)
            rows.append(
                {
                    **counts,
                    **error_of(emulator, held_out),
                    **{f"hardening_{name}": value for name, value in softer_left_out.items()},
                }
            )
    return pd.DataFrame(rows)


def draw(table, scatter, path, labels, better):
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), sharex=True)
    titles = {"rms_percent": "RMS", "largest_percent": "largest"}
    for axis, (column, title) in zip(axes, titles.items()):
        for cheap, part in table.groupby("cheaper_runs"):
            line = part.sort_values("better_runs")
            axis.plot(line["core_hours"], line[column], "o-", label=labels[cheap])
            for _, row in line.iterrows():
                spot = (row["core_hours"], row[column])
                text = f"{int(row['better_runs'])}"
                axis.annotate(text, spot, (4, 4), textcoords="offset points", fontsize=8)
        floor = scatter.loc[scatter["runs"] == "all", column].item()
        axis.axhline(floor, color="0.5", ls="--", lw=1)
        axis.text(
            0.02,
            floor,
            "scatter of the solver's own runs",
            transform=axis.get_yaxis_transform(),
            va="bottom",
            fontsize=8,
            color="0.4",
        )
        axis.set_yscale("log")
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.set_xlabel("runs learnt from [core-hours]")
        axis.set_ylabel(f"{title} error on held-out {better} runs [%]")
        axis.grid(alpha=0.3, which="both")
    lines, words = axes[0].get_legend_handles_labels()
    title = f"numbers: {better} runs"
    figure.legend(lines, words, title=title, loc="lower center", ncol=len(words), fontsize=8)
    figure.tight_layout(rect=(0, 0.13, 1, 1))
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    given, made = snakemake.input, snakemake.output  # noqa: F821
    files = (given.database, given.better, given.train)
    found = compare(files, Path(made.table).with_suffix(""), CHEAPER, BETTER, HELD_OUT)
    found.round(4).to_csv(made.table, index=False)
    scatter = solver_scatter(given.better, given.repeats, outputs_of(given.train))
    scatter.round(4).to_csv(made.scatter, index=False)
    draw(found, scatter, made.figure, LABELS, "standard")
