"""Writes the designs of the signature runs: pairs of runs with and without each candidate.

A point is a shot that the table might hold, with parameters drawn from the posterior. Its
runs share packing and grain orientations: the first has no candidate, each of the others
one. A second design repeats the first runs alone, for the next finer fidelity.
"""

from pathlib import Path

import h5py
import numpy as np

from json_file import read_json
from make_design import write_design
from measurements import read_measurements
from shot_inputs import SHOT_INPUTS
from stage_log import logged_to


def shapes_in_use(rows: list[dict]) -> list[str]:
    return list(dict.fromkeys(row["shape"] for row in rows if row["use"] != "ignore"))


def points(rows: list[dict], points_per_shape: int) -> list[dict]:
    """Shots to compute: {"shape", "lot", the shot inputs}.

    Of each shape, velocities evenly from the lowest to the highest of the table; lots take
    turns, and the specimen is that of the lot's shot with the nearest velocity.
    """
    found = []
    for shape in shapes_in_use(rows):
        shots = [row for row in rows if row["shape"] == shape and row["use"] != "ignore"]
        lots = list(dict.fromkeys(shot["lot"] for shot in shots))
        velocities = [shot["velocity_m_s"] for shot in shots]
        ladder = np.linspace(min(velocities), max(velocities), points_per_shape)
        for index, velocity in enumerate(ladder):
            lot = lots[index % len(lots)]
            own = [shot for shot in shots if shot["lot"] == lot]
            shot = min(own, key=lambda one: abs(one["velocity_m_s"] - velocity))
            ratio = shot["initial_length_mm"] / shot["initial_diameter_mm"]
            inputs = [velocity, shot["initial_diameter_mm"], ratio]
            inputs.append(shot["initial_temperature_K"])
            found.append({"shape": shape, "lot": lot, **dict(zip(SHOT_INPUTS, inputs))})
    return found


def amplitude(candidate: dict, typical: float, turn: int) -> float:
    """Value less base: typical and two widths of the prior in turn, then both the other way.

    An effect of one sign only keeps it. Two levels show the curvature; beyond them, where the
    prior expects nothing, sizes are no longer linear in the amplitude and runs are long.
    """
    above = candidate["highest"] - candidate["base"]
    below = candidate["lowest"] - candidate["base"]
    sign = -1 if turn % 4 > 1 and candidate["signed"] and below < 0 else 1
    far = np.copysign(2 * candidate["prior"]["scale"], typical)
    return float(np.clip(sign * (far if turn % 2 else typical), below, above))


def parameters_of(names: list[str], draws: dict[str, np.ndarray], lot: str, index: int) -> list:
    """One draw of the posterior, the lot's own value where a parameter is per lot."""
    return [float(draws[f"{name}[{lot}]" if name not in draws else name][index]) for name in names]


def signature_design(
    rows: list[dict], draws: dict[str, np.ndarray], parameters: list[str], settings: dict
) -> dict:
    """Columns of the design. `settings`: points_per_shape, seed, candidates, typical."""
    candidates = settings["candidates"]
    base = [candidate["base"] for candidate in candidates]
    places = points(rows, settings["points_per_shape"])
    count = len(next(iter(draws.values())))
    inputs, shapes, seeds = [], [], []
    seed_of_point = np.random.default_rng([settings["seed"], len(places), 1])
    seeds_of_points = seed_of_point.integers(1, 2**31, size=len(places))
    for index, place in enumerate(places):
        # Draws have no order, so that evenly spaced ones are as good as any.
        draw = (2 * index + 1) * count // (2 * len(places))
        shot = [place[name] for name in SHOT_INPUTS]
        shot += parameters_of(parameters, draws, place["lot"], draw)
        turn = index % settings["points_per_shape"]
        for changed in range(-1, len(candidates)):
            values = list(base)
            if changed >= 0:
                candidate = candidates[changed]
                typical = settings["typical"][candidate["name"]]
                values[changed] += amplitude(candidate, typical, turn)
            inputs.append(shot + values)
        shapes += [place["shape"]] * (1 + len(candidates))
        seeds += [seeds_of_points[index]] * (1 + len(candidates))
    names = [*SHOT_INPUTS, *parameters, *(candidate["name"] for candidate in candidates)]
    return {
        "run_id": np.arange(len(inputs), dtype=np.int64),
        "seed": np.array(seeds, dtype=np.int64),
        "shape": shapes,
        "inputs": np.array(inputs),
        "names": names,
    }


def base_rows(design: dict, candidate_count: int) -> dict:
    """The first run of each point, with its number."""
    rows = np.arange(0, len(design["run_id"]), 1 + candidate_count)
    kept = {name: design[name][rows] for name in ("run_id", "seed", "inputs")}
    return {**kept, "shape": [design["shape"][row] for row in rows], "names": design["names"]}


def read_draws(path: Path) -> dict[str, np.ndarray]:
    with h5py.File(path) as file:
        names = [str(name) for name in file["draws"].attrs["names"]]
        columns = file["draws"][:]
    return {name: columns[:, index] for index, name in enumerate(names)}


def write(inputs: dict, outputs: dict, settings: dict) -> None:
    candidates = read_json(inputs["candidates"])["candidates"]
    calibrate = read_json(inputs["settings"])
    design = signature_design(
        read_measurements(Path(inputs["measurements"])),
        read_draws(Path(inputs["posterior"])),
        [parameter["name"] for parameter in calibrate["parameters"]],
        {**settings, "candidates": candidates},
    )
    write_design(Path(outputs["design"]), design)
    write_design(Path(outputs["finer"]), base_rows(design, len(candidates)))


if __name__ == "__main__":
    with logged_to(snakemake.log[0]):  # noqa: F821
        write(
            dict(snakemake.input.items()),  # noqa: F821
            dict(snakemake.output.items()),  # noqa: F821
            snakemake.params.settings,  # noqa: F821
        )
