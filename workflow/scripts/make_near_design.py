"""Writes near_design.h5: the shots of the table with parameters near a first posterior.

The first network errs, so that the values which made the table may lie beyond the posterior that
it gives: the runs cover twice its width.
"""

import math
from pathlib import Path

import numpy as np

from make_confirmation_design import shots_in_use
from make_design import write_design
from make_signature_design import read_draws
from measurements import read_measurements
from shot_inputs import SHOT_INPUTS
from stage_log import logged_to

WIDER = 2  # deviations from the mean, of the posterior's

# One by one: numpy's own may differ in the last bit by where in memory the values lie.
PLAIN_AND_BACK = {
    "log10": (np.vectorize(math.log), np.vectorize(math.exp)),
    "square_root": (np.sqrt, np.square),
    "linear": (np.asarray, np.asarray),
}


def widened(draws: np.ndarray, parameter: dict) -> np.ndarray:
    """Draws WIDER times as far from their mean, as the network sees them, within the range."""
    plain, back = PLAIN_AND_BACK[parameter["transform"]]
    lower, upper = parameter["lower"], parameter["upper"]
    values = plain(draws)
    mean = values.mean()
    wide = np.clip(mean + WIDER * (values - mean), plain(lower), plain(upper))
    return np.clip(back(wide), lower, upper)  # rounding must not leave the range


def near_design(rows: list[dict], draws: dict[str, np.ndarray], settings: dict) -> dict:
    """Columns of the design. `settings`: runs, first_run, seed, parameters with their ranges and
    transforms."""
    runs, in_use = settings["runs"], shots_in_use(rows)
    shots = [in_use[run % len(in_use)] for run in range(runs)]
    count = len(next(iter(draws.values())))
    # Draws have no order, so that evenly spaced ones are as good as any.
    chosen = (2 * np.arange(runs) + 1) * count // (2 * runs)
    inputs = np.empty((runs, len(SHOT_INPUTS) + len(settings["parameters"])))
    for run, shot in enumerate(shots):
        ratio = shot["initial_length_mm"] / shot["initial_diameter_mm"]
        values = {**shot, "length_to_diameter": ratio}
        inputs[run, : len(SHOT_INPUTS)] = [values[name] for name in SHOT_INPUTS]
    lots = np.array([shot["lot"] for shot in shots])
    for column, (name, parameter) in enumerate(settings["parameters"].items(), len(SHOT_INPUTS)):
        for lot in np.unique(lots):
            own = draws[name if name in draws else f"{name}[{lot}]"]
            members = lots == lot
            values = widened(own, parameter)
            inputs[members, column] = values[chosen[members]]
    seed = [settings["seed"], settings["first_run"]]
    return {
        "run_id": settings["first_run"] + np.arange(runs, dtype=np.int64),
        "seed": np.random.default_rng(seed).integers(1, 2**31, size=runs).astype(np.int64),
        "shape": [shot["shape"] for shot in shots],
        "inputs": inputs,
        "names": [*SHOT_INPUTS, *settings["parameters"]],
    }


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        columns = near_design(
            read_measurements(Path(snakemake.input.measurements)),  # noqa: F821
            read_draws(Path(snakemake.input.posterior)),  # noqa: F821
            snakemake.params.settings,  # noqa: F821
        )
        write_design(Path(snakemake.output[0]), columns)  # noqa: F821
