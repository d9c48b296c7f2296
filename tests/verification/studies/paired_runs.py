"""Reads paired runs: the change of sizes and outline with each parameter and each effect."""

import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "workflow" / "scripts"))

from outlines.basis import OutlineBasis, make_basis  # noqa: E402
from outlines.database import read_outlines, score_table  # noqa: E402
from shot_inputs import SHOT_INPUTS  # noqa: E402
from size_kinds import OUTLINE_SCORES  # noqa: E402


@dataclass
class Pairs:
    """One specimen: its run at the optimum, and what changes with each input [mm]; nothing where
    one of its runs did not stop."""

    shape: str
    shot: dict[str, float]
    base: dict[str, float]  # by size
    changes: dict[str, dict[str, float]]  # by input, then by size


@dataclass
class PairedRuns:
    specimens: list[Pairs]  # whose run at the optimum stopped
    amplitudes: dict[str, float]  # by input: how far it was changed
    basis: OutlineBasis

    @property
    def pairs(self) -> list[Pairs]:
        """Specimens of which every run stopped."""
        return [specimen for specimen in self.specimens if specimen.changes]


def read_pairs(path):
    """Specimens and their changes; shots are recognised by seed and shape."""
    basis = make_basis(*read_outlines(path))
    with h5py.File(path) as file:
        inputs, names = file["inputs"][:], list(file["inputs"].attrs["names"])
        sizes = np.hstack([file["outputs"][:], score_table(path, basis)])
        size_names = [*file["outputs"].attrs["names"], *OUTLINE_SCORES]
        shapes, seeds = file["shape"].asstr()[:], file["seed"][:]
        stopped = file["status"][:] == 0
    specimens, amplitudes = [], {}
    for seed in dict.fromkeys(seeds):
        rows = np.flatnonzero(seeds == seed)
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
        if not stopped[unchanged]:
            continue
        of_base = sizes[unchanged]
        specimens.append(
            Pairs(
                shape=str(shapes[unchanged]),
                shot={name: base[names.index(name)] for name in SHOT_INPUTS},
                base=dict(zip(size_names, of_base)),
                changes={
                    name: dict(zip(size_names, sizes[row] - of_base))
                    for name, row in changes.items()
                    if stopped[rows].all()
                },
            )
        )
    return PairedRuns(specimens, amplitudes, basis)
