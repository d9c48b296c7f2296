"""What tells how large a network's error is, and how well: the spread between members, and the
errors of the held-out runs next to a point, which is what the likelihood takes.
"""

import numpy as np
import pandas as pd

NORMAL = {1: 0.6827, 2: 0.9545}  # share of normal errors within so many standard deviations
NEIGHBOURS = 30  # as emulator/inference/held_out.hpp
WEIGHT_OF_ALL = 5  # as emulator/training/covariance.cpp
MEMBERS = "between members"
NEAREST = "of the nearest runs"
BOTH = "both"  # their geometric mean
HELD_OUT_UNDERSTATE = 3  # the likelihood's factor on the variance, see calibrate/README.md


def member_spread(members):
    """Standard deviation between the answers of members [members x runs x outputs]."""
    return members.std(axis=0, ddof=1)


def local_spread(errors, shapes, places):
    """Root mean square [runs x outputs] of the errors of the nearest other runs of the same shape;
    the mean square of the whole shape counts as one run more. The run itself is left out."""
    squares = np.square(errors)
    present = np.isfinite(squares)
    filled = np.where(present, squares, 0)
    spread = np.full(errors.shape, np.nan)
    for shape in np.unique(shapes):
        rows = np.flatnonzero(shapes == shape)
        known = present[rows].any(axis=0)
        complete = rows[present[rows][:, known].all(axis=1)]
        for run in rows:
            others = complete[complete != run]
            pooled = (filled.sum(axis=0) - filled[run]) / np.maximum(
                present.sum(axis=0) - present[run], 1
            )
            own = filled[rows].sum(axis=0) - filled[run] + WEIGHT_OF_ALL * pooled
            whole = own / (present[rows].sum(axis=0) - present[run] + WEIGHT_OF_ALL)
            if len(others) > NEIGHBOURS:
                away = np.square(places[others] - places[run]).sum(axis=1)
                near = others[np.argsort(away, kind="stable")[:NEIGHBOURS]]
                whole = (whole + filled[near].sum(axis=0)) / (NEIGHBOURS + 1)
            spread[run, known] = np.sqrt(whole[known])
    return spread


def halves(runs, seed=1):
    """Two halves of the runs: one for the factor, one for showing what it does."""
    order = np.random.default_rng(seed).permutation(runs)
    return order[: runs // 2], order[runs // 2 :]


def factor_of(errors, spread):
    """The factor with which 68 % of the errors are within one spread."""
    ratio = np.abs(errors) / spread
    return float(np.nanquantile(ratio, NORMAL[1]))


def coverage(errors, spread):
    """Shares of errors within 1 and 2 spreads."""
    ratio = np.abs(errors) / spread
    known = ratio[np.isfinite(ratio)]
    return {f"within_{count}": float(np.mean(known <= count)) for count in NORMAL}


def log_density(errors, spread):
    """Mean ln of the normal density of errors in units of their own RMS by column: higher is
    better, and it tells spreads of like coverage apart."""
    scale = np.sqrt(np.nanmean(np.square(errors), axis=0))
    terms = -0.5 * np.square(errors / spread) - np.log(spread / scale * np.sqrt(2 * np.pi))
    return float(np.nanmean(terms))


def coverage_table(errors, names, spreads):
    """One row for each spread of `spreads` (by MEMBERS, NEAREST, BOTH), factor and output: how the
    second half of the runs is covered."""
    first, second = halves(len(errors))
    rows = []
    for words, spread in spreads.items():
        factors = {"as it is": 1.0, "to 68 %": factor_of(errors[first], spread[first])}
        if words == NEAREST:
            factors["likelihood"] = np.sqrt(HELD_OUT_UNDERSTATE)
        for scaled, factor in factors.items():
            judged = factor * spread[second]
            for column, output in [*enumerate(names), (slice(None), "all")]:
                found = coverage(errors[second][:, column], judged[:, column])
                density = log_density(errors[second], judged) if output == "all" else np.nan
                row = {"spread": words, "scaled": scaled, "factor": factor, "output": output}
                rows.append({**row, **found, "log_density": density})
    return pd.DataFrame(rows)
