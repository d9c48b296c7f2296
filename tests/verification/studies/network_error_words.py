"""The study network_errors in words: tables as `make paper-calibration` prints them."""

import sys

import numpy as np

from error_scales import PAPER, SCALES, worst_first
from error_spreads import HELD_OUT_UNDERSTATE, NORMAL
from hardening_metal import HARDENING

sys.path.append("workflow/scripts")
from report.words import SIZE_WORDS, shape_words  # noqa: E402


def shape_lines(table, scale):
    """RMS (largest) by output and shape on a scale."""
    shapes = table["shape"].unique()
    words = [shape_words(shape) for shape in shapes]
    lines = [f"{'% of ' + SCALES[scale]:22s}" + "".join(f"{word:>18s}" for word in words)]
    for output, part in table.groupby("output", sort=False):
        cells = part.set_index("shape").reindex(shapes)
        line = f"{SIZE_WORDS.get(output, output + ' outputs'):22s}"
        for rms, most in cells[[f"rms_percent_of_{scale}", f"largest_percent_of_{scale}"]].values:
            line += f"{rms:9.2f} {f'({most:.1f})':>8s}"
        lines.append(line)
    return lines


def region_lines(regions):
    """RMS and runs in each cell of two inputs."""
    first, second = regions[["first", "second"]].iloc[0]
    columns = [f"{a:g} to {b:g}" for a, b in zip(*edges_of(regions, "second"))]
    lines = [f"{first} (down), {second} (across)"]
    lines.append(" " * 14 + "".join(f"{word:>14s}" for word in columns))
    for (low, high), part in regions.groupby(["first_from", "first_to"], sort=False):
        cells = [
            f"{rms:.2f} ({runs})" if runs else "-"
            for rms, runs in zip(part["rms_percent_of_mean"], part["runs"])
        ]
        lines.append(f"{f'{low:g} to {high:g}':14s}" + "".join(f"{cell:>14s}" for cell in cells))
    return lines


def edges_of(regions, which):
    """Lower and upper ends of the cells of the `first` or `second` input."""
    unique = regions.drop_duplicates(f"{which}_from")
    return unique[f"{which}_from"], unique[f"{which}_to"]


def coverage_lines(coverage):
    lines = [f"{'spread':26s}{'factor':>8s}{'1 spread':>10s}{'2':>7s}{'ln p':>8s}"]
    for _, row in coverage[coverage["output"] == "all"].iterrows():
        lines.append(
            f"{row['spread']:26s}{row['factor']:8.2f}{100 * row['within_1']:8.0f} %"
            f"{100 * row['within_2']:5.0f} %{row['log_density']:8.2f}"
            + ("  (the likelihood's)" if row["scaled"] == "likelihood" else "")
        )
    lines.append(f"{'normal errors':34s}{100 * NORMAL[1]:8.0f} %{100 * NORMAL[2]:5.0f} %")
    return lines


def soft_runs(inputs):
    """Runs whose metal hardly hardens."""
    return np.any([inputs[name] <= least for name, least in HARDENING.items()], axis=0)


def words(model, runs, errors, tables):
    layers = model["members"][runs.best]["layers"]
    layout = f"{len(layers) - 1} x {len(layers[0]['bias'])} neurons"
    learnt = model["validation"]["training_rows"]
    whole = tables["errors"].iloc[-1]
    worst = worst_first(errors["mean"])[: tables["left_out"]["left_out"].iloc[-1]]
    soft = soft_runs(runs.inputs)
    left_out = [
        f"{f'without the worst {100 * row.share:g} %' if row.share else 'all runs':22s}"
        f"{row.rms_percent_of_mean:18.2f}{row.rms_percent_of_range:18.2f}"
        for row in tables["left_out"].itertuples()
    ]
    return "\n".join(
        [
            f"Network of {layout}, best of {len(runs.members)} members; learnt from {learnt} runs,"
            f" judged by {len(runs.shapes)} held out. RMS (largest) error:",
            "",
            *shape_lines(tables["errors"], "mean"),
            "",
            *shape_lines(tables["errors"], "range"),
            "",
            f"The source paper has {PAPER['rms']} ({PAPER['largest']}) % and does not say of what."
            " Its loss, cross-entropy, needs outputs",
            "normalised to [0, 1], whose errors are parts of the range: here"
            f" {whole['rms_percent_of_range']:.2f} ({whole['largest_percent_of_range']:.1f}) %.",
            "",
            f"{'RMS, %':22s}{'of the mean size':>18s}{'of the range':>18s}",
            *left_out,
            f"{soft[worst].sum()} of the worst {len(worst)} runs, and {soft.sum()} of all"
            f" {len(soft)}, have AI below {HARDENING['hardening_coefficient']:g} or VI below"
            f" {HARDENING['immobilization_velocity']:g} m/s.",
            "",
            "RMS, % of the mean size, of all outputs by region (held-out runs in it):",
            *(line for cells in tables["regions"] for line in [*region_lines(cells), ""]),
            "Errors within 1 and 2 spreads: half of the runs give the factor to 68 %, the others"
            " judge:",
            *coverage_lines(tables["coverage"]),
            "Between members: standard deviation of their answers. Of the nearest runs: RMS as the"
            " likelihood has it,",
            f"which takes its square times {HELD_OUT_UNDERSTATE}; the run itself is left out. Both:"
            " their geometric mean. ln p: mean log density of a",
            "normal error of that spread, higher is better.",
        ]
    )
