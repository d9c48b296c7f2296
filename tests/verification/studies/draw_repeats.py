"""Writes runs that repeat some others with other grains: how far one run is from another."""

import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.append("workflow/scripts")

from make_design import write_design  # noqa: E402

REPEATED = 120  # the last runs, which no network of the study learns from
OTHER_GRAINS = 1_000_003  # added to the seed


def repeats(path: Path) -> dict:
    """Columns of a design: the same shots and metals, other seeds."""
    with h5py.File(path) as file:
        rows = np.arange(len(file["run_id"]))[-REPEATED:]
        return {
            "run_id": file["run_id"][:][rows],
            "seed": (file["seed"][:][rows] + OTHER_GRAINS) % 2**31,
            "shape": [str(shape) for shape in file["shape"].asstr()[:][rows]],
            "inputs": file["inputs"][:][rows],
            "names": [str(name) for name in file["inputs"].attrs["names"]],
        }


if __name__ == "__main__":
    write_design(Path(snakemake.output[0]), repeats(Path(snakemake.input[0])))  # noqa: F821
