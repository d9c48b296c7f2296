"""What the loss of the training does to the network's error: squared error of standardised outputs,
as ours, and cross-entropy of outputs normalised to [0, 1] behind a sigmoid, as the source paper's;
the squared error of that sigmoid tells what the loss does from what the sigmoid does.
"""

import json
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd

from error_scales import PAPER, SCALES, figures_of, percent_errors
from loss_samples import samples_of

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

EPOCHS = 500
RATES = [0.003, 0.01]  # largest learning rates
SEEDS = [1, 2, 3]
FIGURES = {  # of figures_of, in columns of the text
    f"{figure}_percent_of_{scale}": (f"{word}, % of {SCALES[scale]}", digits)
    for scale in SCALES
    for figure, word, digits in (("rms", "RMS", 2), ("largest", "largest", 1))
}


def compare(samples, losses, train):
    """One row for each network that `train` makes."""
    networks = [(loss, rate, seed) for loss in losses for rate in RATES for seed in SEEDS]
    answers = train(samples, networks, EPOCHS)
    sizes, shapes = samples.sizes[samples.held_out], samples.shapes[samples.held_out]
    rows = []
    for (loss, rate, seed), answer in zip(networks, answers):
        row = {"loss": loss, "learning_rate": rate, "seed": seed, "epochs": EPOCHS}
        rows.append({**row, **figures_of(percent_errors(sizes, answer, shapes))})
    return pd.DataFrame(rows)


def words(table, samples):
    """Mean, lowest and highest of the seeds, by loss and learning rate."""
    learnt, judged = np.sum(~samples.held_out), np.sum(samples.held_out)
    lines = [
        f"7 x 21 neurons, {table['epochs'].iloc[0]} epochs, {learnt} runs to learn from, {judged}"
        f" held out; mean of {table['seed'].nunique()} seeds (lowest to highest)",
        f"{'loss':30s}{'rate':>6s}" + "".join(f"{head:>26s}" for head, _ in FIGURES.values()),
    ]
    for (loss, rate), part in table.groupby(["loss", "learning_rate"], sort=False):
        line = f"{loss:30s}{rate:6g}"
        for column, (_, digits) in FIGURES.items():
            low, mean, high = (
                f"{value:.{digits}f}" for value in part[column].agg(["min", "mean", "max"])
            )
            line += f"{f'{mean} ({low} to {high})':>26s}"
        lines.append(line)
    source = f"RMS {PAPER['rms']} %, largest {PAPER['largest']} %"
    lines.append(f"The source paper: {source}, of what it does not say.")
    return "\n".join(lines)


def draw(table, path):
    figure, axes = plt.subplots(1, len(FIGURES), figsize=(15, 3.6))
    kinds = list(table.groupby(["loss", "learning_rate"], sort=False))
    for axis, (column, (title, _)) in zip(axes, FIGURES.items()):
        for place, ((loss, _), part) in enumerate(kinds):
            colour = f"C{list(table['loss'].unique()).index(loss)}"
            axis.plot(part[column], [place] * len(part), "o", color=colour, alpha=0.6)
            axis.plot(part[column].mean(), place, "|", color=colour, ms=18, mew=2)
        axis.set_yticks(range(len(kinds)), [""] * len(kinds))
        axis.invert_yaxis()
        axis.set_xlim(0)
        axis.set_title(f"{title} [%]".replace(", %", ""), fontsize=10)
        axis.grid(alpha=0.3)
    axes[0].set_yticklabels([f"{loss},\nrate {rate:g}" for (loss, rate), _ in kinds], fontsize=8)
    figure.suptitle(
        f"{table['epochs'].iloc[0]} epochs; dots: seeds, strokes: their mean", fontsize=10
    )
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
