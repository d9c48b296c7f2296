"""Writes confirmation_design.h5: every shot in use at the posterior's best maximum.

A row's number is its shot's place among the shots in use, in the order of the table.
"""

from pathlib import Path

import h5py
import numpy as np

from json_file import read_json
from make_design import write_design
from make_signature_design import parameters_of
from measurements import read_measurements
from shot_inputs import SHOT_INPUTS
from stage_log import logged_to


def shots_in_use(rows: list[dict]) -> list[dict]:
    return [row for row in rows if row["use"] != "ignore"]


def confirmation_design(
    rows: list[dict], maximum: dict[str, np.ndarray], parameters: list[str], seed: int
) -> dict:
    """Columns of the design. `maximum`: arrays of one value, by the posterior's names."""
    shots = shots_in_use(rows)
    inputs = []
    for shot in shots:
        ratio = shot["initial_length_mm"] / shot["initial_diameter_mm"]
        values = {**shot, "length_to_diameter": ratio}
        own = parameters_of(parameters, maximum, shot["lot"], 0)
        inputs.append([values[name] for name in SHOT_INPUTS] + own)
    # Other grain orientations than those of the database, which the network has learnt.
    seeds = np.random.default_rng([seed, len(shots), 2]).integers(1, 2**31, size=len(shots))
    return {
        "run_id": np.arange(len(shots), dtype=np.int64),
        "seed": seeds.astype(np.int64),
        "shape": [shot["shape"] for shot in shots],
        "inputs": np.array(inputs),
        "names": [*SHOT_INPUTS, *parameters],
    }


def read_maximum(path: Path) -> dict[str, np.ndarray]:
    with h5py.File(path) as file:
        names = [str(name) for name in file["maxima"].attrs["names"]]
        best = file["maxima"][0]
    return {name: best[index : index + 1] for index, name in enumerate(names)}


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        settings = read_json(snakemake.input.settings)  # noqa: F821
        columns = confirmation_design(
            read_measurements(Path(snakemake.input.measurements)),  # noqa: F821
            read_maximum(Path(snakemake.input.posterior)),  # noqa: F821
            [parameter["name"] for parameter in settings["parameters"]],
            snakemake.params.seed,  # noqa: F821
        )
        write_design(Path(snakemake.output[0]), columns)  # noqa: F821
