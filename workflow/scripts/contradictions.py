"""What the schema of study.yaml cannot say: numbers that are none, and values that do not fit
each other. The programs refuse the same, but only after Snakemake has removed older results.
"""

import math

from candidates import known_constants
from input_errors import did_you_mean
from shape_names import shape_problem
from shot_inputs import SHOT_INPUTS

Found = list[tuple[tuple, str]]  # path of the key, what is wrong with it
MOST_PLAIN_PARAMETERS = 4
SHORTEST_MM, LONGEST_MM = 0.1, 1000  # specimens that the solver computes


def not_finite(content, path: tuple = ()) -> Found:
    """YAML knows .nan and .inf, and a nan passes every test of a range."""
    if isinstance(content, float) and not math.isfinite(content):
        return [(path, f"= {content} (expected a finite number).")]
    items = content.items() if isinstance(content, dict) else ()
    items = enumerate(content) if isinstance(content, list) else items
    return [found for key, value in items for found in not_finite(value, (*path, key))]


def contradictions(study: dict) -> Found:
    """Of a study that its schema has passed."""
    return [
        *_of_priors(study),
        *_uncovered_priors(study),
        *_of_material(study),
        *_of_database(study),
        *_of_parts(study),
        *_of_calibration(study),
        *_of_draws(study),
        *_of_constants(study),
        *_of_words(study),
    ]


def _of_priors(study: dict) -> Found:
    found = []
    for name, parameter in study["parameters"].items():
        key = ("parameters", name)
        if parameter["lower"] >= parameter["upper"]:
            limits = f"{parameter['lower']} to {parameter['upper']}"
            found.append((key, f"has the range {limits} (expected lower < upper)."))
        if parameter["prior"] == "log_uniform" and parameter["lower"] <= 0:
            found.append((key, "has prior log_uniform from 0 (expected lower > 0)."))
    return found


def _uncovered_priors(study: dict) -> Found:
    """The network answers only where it has seen runs."""
    found = []
    for name, (lowest, highest) in study["database"]["parameters"].items():
        key = ("database", "parameters", name)
        if name not in study["parameters"]:
            found.append((key, "is not calibrated (expected a name of `parameters`). Drop it."))
            continue
        prior = study["parameters"][name]
        if not lowest <= prior["lower"] <= prior["upper"] <= highest:
            limits = f"{prior['lower']} to {prior['upper']}"
            problem = f"= [{lowest}, {highest}] does not cover the prior, {limits}. Widen it."
            found.append((key, problem))
        if prior["prior"] == "log_uniform" and lowest <= 0:
            found.append((key, f"= [{lowest}, {highest}] has no logarithms (expected above 0)."))
    return found


def _of_material(study: dict) -> Found:
    problem = "is calibrated: each run has a value of its own. Take it out of one of them."
    material = study["solver"]["material"]
    return [
        (("solver", "material", name), problem) for name in study["parameters"] if name in material
    ]


def _of_database(study: dict) -> Found:
    found = []
    database = study["database"]
    own = set(SHOT_INPUTS) | {"shapes"}
    if database["better"] and any(own & set(part) for part in database["further"]):
        problem = "has no runs of the better solver. Widen the ranges of the database itself."
        found.append((("database", "further"), problem))
    better = database["better"]
    if better and all(better[key] == study["solver"][key] for key in ("geometry", "fidelity")):
        problem = "is the solver of the other runs. Choose a finer one, or leave `better` out."
        found.append((("database", "better"), problem))
    if database["chunks"] > database["runs"]:
        found.append((("database", "chunks"), "is more than `runs` (expected at most as many)."))
    return found


def _of_parts(study: dict) -> Found:
    """Of the ranges and shapes of the database and of each further part."""
    found = []
    database = study["database"]
    parts = [((), database)] + [(("further", n), p) for n, p in enumerate(database["further"])]
    for place, part in parts:
        key = ("database", *place)
        for name in [name for name in SHOT_INPUTS if name in part]:
            lowest, highest = part[name]
            if lowest > highest:
                problem = f"= [{lowest}, {highest}] (expected the lowest value first)."
                found.append(((*key, name), problem))
        for index, shape in enumerate(part.get("shapes", [])):
            problem = shape_problem(shape)
            found += [((*key, "shapes", index), f"= {shape!r}: {problem}")] if problem else []
        found += _of_lengths(key, {**database, **part})
    return found


def _of_lengths(key: tuple, part: dict) -> Found:
    diameters, ratios = part["initial_diameter_mm"], part["length_to_diameter"]
    lengths = [diameter * ratio for diameter, ratio in zip(diameters, ratios)]
    if SHORTEST_MM <= lengths[0] and lengths[1] <= LONGEST_MM:
        return []
    problem = (
        f"= {ratios} with initial_diameter_mm = {diameters} has specimens {lengths[0]:g} to "
        f"{lengths[1]:g} mm long (expected {SHORTEST_MM:g} to {LONGEST_MM:g}). Narrow one of them."
    )
    return [((*key, "length_to_diameter"), problem)]


def _of_calibration(study: dict) -> Found:
    found = []
    for size in study["calibration"]["fit_sizes"]:
        if size not in study["emulator"]["outputs"]:
            problem = f"has {size!r}, which is not in emulator.outputs. Add it there."
            found.append((("calibration", "fit_sizes"), problem))
    grid = (study["calibration"]["unexplained_spread"] or {}).get("grid", [0])
    if grid[0] != 0 or grid != sorted(grid):
        problem = f"= {grid} (expected rising values from 0, as in [0, 0.005, 0.01, 0.02, 0.04])."
        found.append((("calibration", "unexplained_spread", "grid"), problem))
    return found


def _of_draws(study: dict) -> Found:
    """What plain draws and the paper's likelihood cannot do."""
    found = []
    settings, parameters = study["calibration"], study["parameters"]
    plain = settings["draws_from"] == "prior"
    if settings["draw_sequence"] == "sobol" and not plain:
        problem = "= sobol is for plain draws (expected draws_from: prior beside it)."
        found.append((("calibration", "draw_sequence"), problem))
    if settings.get("network_errors") == "common" and (plain or settings["likelihood"] == "paper"):
        problem = (
            "= common cannot go with draws_from: prior or likelihood: paper, which go row by row "
            "(expected independent)."
        )
        found.append((("calibration", "network_errors"), problem))
    per_lot = [name for name, entry in parameters.items() if entry["scope"] == "per_lot"]
    count = len(parameters) + len(study["effects"])
    if plain and (per_lot or count > MOST_PLAIN_PARAMETERS):
        told = f"{', '.join(per_lot)} per_lot" if per_lot else f"{count}, effects included"
        problem = (
            f"= prior is for at most {MOST_PLAIN_PARAMETERS} shared parameters (found {told}). "
            "Use adapted."
        )
        found.append((("calibration", "draws_from"), problem))
    return found


def _of_constants(study: dict) -> Found:
    known = list(known_constants())
    return [
        (
            ("diagnosis", "constants", index),
            f"= {name!r}, which workflow/constants.yaml has not. {did_you_mean(name, known)}",
        )
        for index, name in enumerate(study["diagnosis"]["constants"])
        if name not in known
    ]


def _of_words(study: dict) -> Found:
    if study["synthetic"] and not study["synthetic_note"]:
        return [(("synthetic_note",), "is missing; say how the synthetic table was made.")]
    return []
