"""Writes the runs of every shot of a table at every mode of its posterior."""

import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.append("workflow/scripts")

from json_file import read_json  # noqa: E402
from make_confirmation_design import confirmation_design  # noqa: E402
from make_design import write_design  # noqa: E402
from measurements import read_measurements  # noqa: E402

LEAST_SHARE = 0.02  # of the posterior, for a mode to count
APART = 1000  # run ids of a mode and of the next


def modes_of(posterior: Path) -> list[tuple[float, dict[str, np.ndarray]]]:
    """Share and place of each mode, the largest first."""
    with h5py.File(posterior) as file:
        names = [str(name) for name in file["maxima"].attrs["names"]]
        places, shares = file["maxima"][:], file["maxima_share"][:]
    return [
        (float(share), {name: place[i : i + 1] for i, name in enumerate(names)})
        for place, share in zip(places, shares, strict=True)
        if share >= LEAST_SHARE
    ]


def design_of(rows: list[dict], modes, parameters: list[str]) -> dict:
    parts = [
        confirmation_design(rows, place, parameters, seed) for seed, (_, place) in enumerate(modes)
    ]
    return {
        "run_id": np.concatenate([APART * i + part["run_id"] for i, part in enumerate(parts)]),
        "seed": np.concatenate([part["seed"] for part in parts]),
        "shape": [shape for part in parts for shape in part["shape"]],
        "inputs": np.concatenate([part["inputs"] for part in parts]),
        "names": parts[0]["names"],
    }


if __name__ == "__main__":
    settings = read_json(snakemake.input.settings)  # noqa: F821
    columns = design_of(
        read_measurements(Path(snakemake.input.measurements)),  # noqa: F821
        modes_of(Path(snakemake.input.posterior)),  # noqa: F821
        [parameter["name"] for parameter in settings["parameters"]],
    )
    write_design(Path(snakemake.output[0]), columns)  # noqa: F821
