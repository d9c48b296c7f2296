"""Writes design.h5: the runs of the database, spread evenly over the study's ranges."""

import math
from pathlib import Path

import h5py
import numpy as np

from atomic_file import written_whole
from stage_log import logged_to


EDGE_RUNS = 3  # of each shape on either end of each range


def design(settings: dict) -> dict:
    """Columns of the design."""
    axes = [(name, *limits, "even") for name, limits in settings["ranges"].items()]
    axes += [
        (name, values["lower"], values["upper"], _spacing(values, settings))
        for name, values in settings["parameters"].items()
    ]
    axes += [
        (name, values["lower"], values["upper"], "even")
        for name, values in settings.get("effects", {}).items()
    ]
    first_run = settings.get("first_run", 0)
    # The runs of a revision continue the numbers of those before and repeat none.
    seed = [settings["seed"], first_run] if first_run else [settings["seed"]]
    shapes, runs = settings["shapes"], settings["runs"]
    varying = [index for index, (_, lower, upper, _) in enumerate(axes) if lower < upper]
    points = _interleaved_sobol(len(varying), runs, len(shapes), seed)
    inputs = np.empty((runs, len(axes)))
    for index, (_, lower, upper, spacing) in enumerate(axes):
        share = points[:, varying.index(index)] if index in varying else np.zeros(runs)
        if spacing == "logarithmic":
            # One by one: on some processors numpy's own powers differ in the last bit by
            # where in memory the shares lie.
            values = lower * np.array([math.pow(upper / lower, part) for part in share])
        elif spacing == "square_root":
            values = (lower**0.5 + (upper**0.5 - lower**0.5) * share) ** 2
        else:
            values = lower + (upper - lower) * share
        inputs[:, index] = np.clip(values, lower, upper)  # rounding must not leave the range
    seeds = np.random.default_rng(seed).integers(1, 2**31, size=runs)
    return {
        "run_id": np.arange(first_run, first_run + runs, dtype=np.int64),
        "seed": seeds.astype(np.int64),
        "shape": [shapes[run % len(shapes)] for run in range(runs)],
        "inputs": inputs,
        "names": [axis[0] for axis in axes],
    }


def _spacing(parameter: dict, settings: dict) -> str:
    """How a parameter's values are spread: as its prior, or denser towards zero where asked."""
    if parameter["prior"] == "log_uniform":
        return "logarithmic"
    dense = settings.get("spacing") == "square_root" and parameter["lower"] >= 0
    return "square_root" if dense else "even"


def _interleaved_sobol(dimensions: int, runs: int, shapes: int, seed: list[int]) -> np.ndarray:
    """Points of the unit cube; each shape has a sequence of its own, row n belongs to shape
    n mod `shapes`. The cube is a little smaller than the sequence's, and points beyond it are
    moved to its faces: a network that has seen the ends of a range need not extrapolate.
    """
    # Here, since the rules import this module and are to be read without this slow one.
    from scipy.stats import qmc

    points = np.empty((runs, dimensions))
    for shape in range(shapes):
        rows = len(range(shape, runs, shapes))
        powers = max(rows - 1, 1).bit_length()
        engine = qmc.Sobol(dimensions, seed=np.random.default_rng([*seed, shape]))
        stretch = 1 + 2 * EDGE_RUNS / rows
        points[shape::shapes] = 0.5 + stretch * (engine.random_base2(powers)[:rows] - 0.5)
    return np.clip(points, 0, 1)


def write_design(path: Path, columns: dict) -> None:
    text = h5py.string_dtype(encoding="utf-8")
    with written_whole(path) as partial, h5py.File(partial, "w") as file:
        file.attrs["schema"] = "taylorcal/design/1"
        for name in ("run_id", "seed", "inputs"):
            # No time stamps: the same design has the same bytes.
            file.create_dataset(name, data=columns[name], track_times=False)
        file.create_dataset("shape", data=columns["shape"], dtype=text, track_times=False)
        file["inputs"].attrs.create("names", columns["names"], dtype=text)


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write_design(Path(snakemake.output[0]), design(snakemake.params.settings))  # noqa: F821
