"""What networks of the study `losses` learn from: coarse and standard runs of paper_design, as
`emulator train` takes them (emulator/training/samples.cpp), with a split of its own.
"""

from dataclasses import dataclass

import h5py
import numpy as np

TRANSFORMS = {"linear": lambda x: x, "log10": np.log10, "square_root": np.sqrt}
MARGIN = 0.1  # of the range, on either side of it, for outputs normalised to [0, 1]


@dataclass
class Samples:
    """Training and held-out rows: `inputs` as the network sees them, `sizes` divided by
    `divide_by`, `shapes`."""

    inputs: np.ndarray
    sizes: np.ndarray
    shapes: np.ndarray
    held_out: np.ndarray  # [rows], true or false


def read_runs(path, train):
    """Run ids, inputs [runs x inputs], shapes and divided outputs [runs x outputs] of the runs
    that stopped."""
    with h5py.File(path) as file:
        stopped = file["status"][:] == 0
        names = [str(name) for name in file["inputs"].attrs["names"]]
        inputs = {name: file["inputs"][:][stopped, k] for k, name in enumerate(names)}
        known = [str(name) for name in file["outputs"].attrs["names"]]
        outputs = file["outputs"][:][stopped]
        sizes = []
        for output in train["outputs"]:
            size = outputs[:, known.index(output["name"])]
            for name in output["divide_by"]:
                size = size / inputs[name]
            sizes.append(size)
        plain = np.array([inputs[one["name"]] for one in train["inputs"]]).T
        shapes = file[train["category"]].asstr()[:][stopped]
        return file["run_id"][:][stopped], plain, shapes, np.array(sizes).T


def split(run_ids, fraction, seed=0):
    """Held out or not, of the better runs, by an order of their run ids that depends on nothing
    else."""
    order = np.random.default_rng(seed).permutation(np.sort(run_ids))
    return np.isin(run_ids, order[: round(fraction * len(order))])


def samples_of(database, better, train):
    """`train`: the settings of `emulator train`."""
    coarse, fine = read_runs(database, train), read_runs(better, train)
    cheaper = np.r_[np.ones(len(coarse[0])), np.zeros(len(fine[0]))]
    plain, shapes, sizes = (np.concatenate([coarse[k], fine[k]]) for k in (1, 2, 3))
    held_out = np.zeros(len(cheaper), dtype=bool)
    held_out[len(coarse[0]) :] = split(fine[0], train["validation_fraction"])
    columns = []
    for one, values in zip(train["inputs"], plain.T):
        if np.ptp(values) > 1e-9 * np.abs(values).max():
            seen = TRANSFORMS[one.get("transform", "linear")](values)
            columns.append((seen - seen[~held_out].mean()) / seen[~held_out].std())
    hot = [shapes == shape for shape in np.unique(shapes)]
    return Samples(np.array([*columns, *hot, cheaper]).T, sizes, shapes, held_out)


def standard_scale(sizes):
    """Shift and scale that make the outputs' means 0 and deviations 1."""
    return sizes.mean(axis=0), sizes.std(axis=0)


def unit_scale(sizes):
    """Shift and scale that put the outputs into [0, 1], with room at both ends."""
    low, high = sizes.min(axis=0), sizes.max(axis=0)
    return low - MARGIN * (high - low), (1 + 2 * MARGIN) * (high - low)


def learning_rate(progress):
    """Share of the largest one, as emulator/training/train_member.cpp."""
    return min(progress / 0.02, 1) * 0.5 * (1 + np.cos(np.pi * progress))
