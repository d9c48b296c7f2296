"""Errors of a network in percent, on two scales.

`mean`: of the mean size of the run's shape, as `emulator train` counts them; a size that differs
little between runs, such as the final length, makes it small. `range`: of the output's range over
the runs of all shapes, as of a network whose outputs are normalised to [0, 1].
"""

import numpy as np
import pandas as pd

SCALES = {"mean": "the mean size", "range": "the range"}
PAPER = {"rms": 0.4, "largest": 4.6}  # [%], the source paper's: it does not say of what


def percent_errors(solver, network, shapes):
    """Network less solver [%] by scale, each [runs x outputs]; NaN where the solver has none."""
    means = np.empty_like(solver)
    for shape in np.unique(shapes):
        means[shapes == shape] = np.nanmean(np.abs(solver[shapes == shape]), axis=0)
    ranges = np.nanmax(solver, axis=0) - np.nanmin(solver, axis=0)
    return {"mean": 100 * (network - solver) / means, "range": 100 * (network - solver) / ranges}


def rms(errors):
    return float(np.sqrt(np.nanmean(np.square(errors))))


def largest(errors):
    return float(np.nanmax(np.abs(errors)))


def figures_of(errors, rows=slice(None), columns=slice(None)):
    """RMS and largest error [%] on both scales of some runs and outputs."""
    found = {"n": int(np.isfinite(errors["mean"][rows, columns]).sum())}
    for scale in SCALES:
        part = errors[scale][rows, columns]
        found[f"rms_percent_of_{scale}"] = rms(part) if found["n"] else np.nan
        found[f"largest_percent_of_{scale}"] = largest(part) if found["n"] else np.nan
    return found


def error_table(errors, names, shapes):
    """One row for each output and shape, for each of them alone, and for all."""
    rows = []
    for column, output in [*enumerate(names), (slice(None), "all")]:
        for shape in [*np.unique(shapes), "all"]:
            chosen = slice(None) if shape == "all" else shapes == shape
            if isinstance(chosen, slice) or np.isfinite(errors["mean"][chosen, column]).any():
                figures = figures_of(errors, chosen, column)
                rows.append({"output": output, "shape": shape, **figures})
    return pd.DataFrame(rows)


def without_worst(errors, shares):
    """RMS [%] of the runs that are left when the worst share of them is left out, on each scale;
    the worst: by the sum of squares over the outputs."""
    rows = []
    for share in shares:
        row = {"share": share}
        for scale, values in errors.items():
            order = worst_first(values)
            row["left_out"] = round(share * len(order))
            row[f"rms_percent_of_{scale}"] = rms(values[order[row["left_out"] :]])
        rows.append(row)
    return pd.DataFrame(rows)


def worst_first(values):
    """Runs of errors [runs x outputs] in falling order of their sum of squares."""
    return np.argsort(-np.nansum(np.square(values), axis=1), kind="stable")


def by_region(errors, inputs, edges):
    """Errors of the runs in each cell of two inputs; `edges` by input, the last cell closed."""
    cells = {
        name: np.clip(np.searchsorted(values, inputs[name], side="right") - 1, 0, len(values) - 2)
        for name, values in edges.items()
    }
    (first, first_edges), (second, second_edges) = edges.items()
    rows = []
    for i in range(len(first_edges) - 1):
        for j in range(len(second_edges) - 1):
            inside = (cells[first] == i) & (cells[second] == j)
            place = {
                "first": first,
                "first_from": first_edges[i],
                "first_to": first_edges[i + 1],
                "second": second,
                "second_from": second_edges[j],
                "second_to": second_edges[j + 1],
            }
            figures = figures_of(errors, inside)
            rows.append({**place, "runs": int(inside.sum()), **figures})
    return pd.DataFrame(rows)
