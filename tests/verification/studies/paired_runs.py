"""Reads paired runs: the change of sizes and outline with each parameter and each effect."""

import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "workflow" / "scripts"))

from outlines.basis import OutlineBasis, make_basis  # noqa: E402
from outlines.database import read_outlines, score_table  # noqa: E402
from study import DESIGN_RANGES, OUTLINE_SCORES  # noqa: E402


@dataclass
class Pairs:
    """One specimen: its run at the optimum, and what changes with each input [mm]."""

    shape: str
    shot: dict[str, float]
    base: dict[str, float]  # by size
    changes: dict[str, dict[str, float]]  # by input, then by size


@dataclass
class PairedRuns:
    pairs: list[Pairs]
    amplitudes: dict[str, float]  # by input: how far it was changed
    basis: OutlineBasis


def read_pairs(path):
    """Specimens of which every run stopped; shots are recognised by seed and shape."""
    basis = make_basis(*read_outlines(path))
    with h5py.File(path) as file:
        inputs, names = file["inputs"][:], list(file["inputs"].attrs["names"])
        sizes = np.hstack([file["outputs"][:], score_table(path, basis)])
        size_names = [*file["outputs"].attrs["names"], *OUTLINE_SCORES]
        shapes, seeds = file["shape"].asstr()[:], file["seed"][:]
        stopped = file["status"][:] == 0
    pairs, amplitudes = [], {}
    for seed in dict.fromkeys(seeds):
        rows = np.flatnonzero(seeds == seed)
        if not stopped[rows].all():
            continue
        base = np.median(inputs[rows], axis=0)  # each input differs in one row of many
        changes = {}
        for row in rows:
            changed = np.flatnonzero(inputs[row] != base)
            if len(changed) == 0:
                unchanged = row
            else:
                (index,) = changed
                amplitudes[names[index]] = inputs[row, index] - base[index]
                changes[names[index]] = row
        of_base = sizes[unchanged]
        pairs.append(
            Pairs(
                shape=str(shapes[unchanged]),
                shot={name: base[names.index(name)] for name in DESIGN_RANGES},
                base=dict(zip(size_names, of_base)),
                changes={
                    name: dict(zip(size_names, sizes[row] - of_base))
                    for name, row in changes.items()
                },
            )
        )
    return PairedRuns(pairs, amplitudes, basis)
