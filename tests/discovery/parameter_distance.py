"""How far fitted parameters are from the true ones, by what they predict.

Parameters make up for each other along curved ridges: two sets may be far apart and predict the
same sizes. A metric that is linear at one of them, as `judge.moves_toward_truth` has it, takes
such a pair for tens of standard errors.
"""

from pathlib import Path

import numpy as np
from error_model import PlainModel, whiten, whiteners
from network import Network
from refit import read_table
from specimens import TRUTHS


def distances_to_truth(network: Network, table: Path, refit: dict, truth: dict) -> dict:
    """{"with", "without"}: sum of squares of the whitened differences between the sizes that the
    network predicts for the fitted shots at a fit's parameters and at the true ones, no effect on.
    """
    shots, _, fitted = read_table(table)
    model = PlainModel(network, shots.subset(fitted), list(TRUTHS))
    true = np.array([truth["parameters"][name] for name in TRUTHS])
    roots = whiteners(model, true)

    def distance(which: str) -> float:
        found = np.array([refit[which]["parameters"][name] for name in TRUTHS])
        return float(np.sum(whiten(roots, model.sizes(found) - model.sizes(true)) ** 2))

    return {which: distance(which) for which in ("with", "without")}
