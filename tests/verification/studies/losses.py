"""What the loss of the training does to the network's error: squared error of standardised outputs,
as ours, and cross-entropy of outputs normalised to [0, 1] behind a sigmoid, as the source paper's;
the squared error of that sigmoid tells what the loss does from what the sigmoid does.
"""

import json
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd

from error_scales import PAPER, SCALES, figures_of, percent_errors, without_worst
from loss_samples import samples_of

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import LogLocator, NullFormatter  # noqa: E402

EPOCHS = 500
RATES = [0.003, 0.01]  # largest learning rates
SEEDS = [1, 2, 3]
WORST = 0.01  # of the runs, left out in a further RMS: one run can make most of it
FIGURES = {  # columns of the table: heads and digits in the text
    f"{figure}_percent_of_{scale}": (f"{word} of {SCALES[scale]}", digits)
    for scale in SCALES
    for figure, word, digits in (
        ("rms", "RMS", 2),
        ("usual_rms", "RMS but 1 %", 2),
        ("largest", "largest", 1),
    )
}


def compare(samples, losses, train):
    """One row for each network that `train` makes."""
    networks = [(loss, rate, seed) for loss in losses for rate in RATES for seed in SEEDS]
    answers = train(samples, networks, EPOCHS)
    sizes, shapes = samples.sizes[samples.held_out], samples.shapes[samples.held_out]
    rows = []
    for (loss, rate, seed), answer in zip(networks, answers):
        row = {"loss": loss, "learning_rate": rate, "seed": seed, "epochs": EPOCHS}
        errors = percent_errors(sizes, answer, shapes)
        usual = without_worst(errors, [WORST]).iloc[0]
        for scale in SCALES:
            row[f"usual_rms_percent_of_{scale}"] = usual[f"rms_percent_of_{scale}"]
        rows.append({**row, **figures_of(errors)})
    return pd.DataFrame(rows)


def words(table, samples):
    """Median, lowest and highest of the seeds, by loss and learning rate."""
    learnt, judged = np.sum(~samples.held_out), np.sum(samples.held_out)
    lines = [
        f"7 x 21 neurons, {table['epochs'].iloc[0]} epochs, {learnt} runs to learn from, {judged}"
        f" held out; errors in %, median of {table['seed'].nunique()} seeds (lowest to highest)",
        f"but 1 %: without the worst {100 * WORST:g} % of the runs, of each network its own",
    ]
    for scale in SCALES:
        heads = [(name, *FIGURES[name]) for name in FIGURES if name.endswith(scale)]
        lines += ["", f"{'loss':30s}{'rate':>6s}" + "".join(f"{head:>29s}" for _, head, _ in heads)]
        for (loss, rate), part in table.groupby(["loss", "learning_rate"], sort=False):
            line = f"{loss:30s}{rate:6g}"
            for column, _, digits in heads:
                low, middle, high = (
                    f"{value:.{digits}f}" for value in part[column].agg(["min", "median", "max"])
                )
                line += f"{f'{middle} ({low} to {high})':>29s}"
            lines.append(line)
    source = f"RMS {PAPER['rms']} %, largest {PAPER['largest']} %"
    return "\n".join([*lines, "", f"The source paper: {source}, of what it does not say."])


def draw(table, path):
    figure, axes = plt.subplots(2, 3, figsize=(13, 6.4), sharex="col")
    kinds = list(table.groupby(["loss", "learning_rate"], sort=False))
    losses = list(table["loss"].unique())
    for axis, (column, (title, _)) in zip(axes.flat, FIGURES.items()):
        for place, ((loss, _), part) in enumerate(kinds):
            colour = f"C{losses.index(loss)}"
            axis.plot(part[column], [place] * len(part), "o", color=colour, alpha=0.6)
            axis.plot(part[column].median(), place, "|", color=colour, ms=18, mew=2)
        axis.set_xscale("log")
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.set_yticks(range(len(kinds)), [""] * len(kinds))
        axis.set_ylim(len(kinds) - 0.5, -0.5)
        axis.set_title(title.replace(" but 1 %", ", worst 1 % left out,"), fontsize=10)
        axis.grid(alpha=0.3, which="both")
    for row in axes:
        names = [f"{loss},\nrate {rate:g}" for (loss, rate), _ in kinds]
        row[0].set_yticklabels(names, fontsize=8)
    for axis in axes[1]:
        axis.set_xlabel("error on held-out runs [%]")
    title = f"{table['epochs'].iloc[0]} epochs; dots: seeds, strokes: their median"
    figure.suptitle(title, fontsize=10)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    from loss_networks import LOSSES, train

    inputs, outputs = snakemake.input, snakemake.output  # noqa: F821
    settings = json.loads(Path(inputs.train).read_text())
    samples = samples_of(inputs.database, inputs.better, settings)
    found = compare(samples, LOSSES, train)
    found.round(4).to_csv(outputs.table, index=False)
    Path(outputs.text).write_text(words(found, samples) + "\n")
    draw(found, outputs.figure)
