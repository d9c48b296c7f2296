"""What the solver says of its effects and constants, and checks of their names."""

import json
import subprocess
from functools import cache
from pathlib import Path

from input_errors import InputError, did_you_mean
from yaml_lines import placed, read_yaml

SOLVER = Path("build/bin/solver")
MODELS = ("strength", "equation_of_state")
JOHNSON_COOK = ("jc_melting_temperature", "reference_temperature")  # the first is the higher one


@cache
def solver_list(what: str, solver: Path = SOLVER) -> dict[str, dict]:
    """The entries of `solver effects --json` or `solver parameters --json` by name."""
    try:
        run = subprocess.run([solver, what, "--json"], capture_output=True, text=True)
    except OSError as error:
        raise InputError(
            f"{solver}: cannot be run ({error.strerror}). Build it first: make build."
        ) from error
    if run.returncode:
        told = " ".join(run.stderr.split())
        raise InputError(f"{solver} {what} --json: failed ({told}). Build it anew: make build.")
    return {entry["name"]: entry for entry in json.loads(run.stdout)[what]}


def check_material(study: dict, path: Path) -> None:
    """The constants that study.yaml sets must be the solver's, and in its ranges. A study that
    sets none does not ask the solver.
    """
    given = study["solver"]["material"]
    if set(given) == set(MODELS):
        return
    known = solver_list("parameters")
    if given["strength"] == "johnson_cook":
        given = {name: known[name]["default"] for name in JOHNSON_COOK if name in known} | given
    problems = {name: _constant_problem(name, given, known) for name in given if name not in MODELS}
    lines = read_yaml(path)[1]
    told = [
        placed(path, lines, ("solver", "material", name), problem)
        for name, problem in problems.items()
        if problem
    ]
    if told:
        raise InputError("\n".join(told))


def _constant_problem(name: str, given: dict, known: dict[str, dict]) -> str:
    """What is wrong with a constant of the material, or an empty text."""
    if name not in known:
        return f"is not a constant of the material. {did_you_mean(name, [*known, *MODELS])}"
    lowest, highest = known[name]["lowest"], known[name]["highest"]
    unit = "" if known[name]["unit"] == "1" else f" {known[name]['unit']}"
    if not lowest <= given[name] <= highest:
        return f"= {given[name]:g} (expected {lowest:g} to {highest:g}{unit})."
    melting, reference = JOHNSON_COOK
    if name == melting and melting in given and given[melting] <= given.get(reference, 0):
        return f"= {given[melting]:g} (expected above {reference} = {given[reference]:g} K)."
    return ""


def check_effects(study: dict, path: Path, known: dict[str, dict]) -> None:
    """The effects that study.yaml names must be known and fit to its geometry."""
    lists = {("effects",): study["effects"]}
    candidates = study["diagnosis"]["candidates"]
    if candidates != "all":
        lists[("diagnosis", "candidates")] = candidates
    problems = []
    for key, names in lists.items():
        for index, name in enumerate(names):
            problem = effect_problem(name, study, known)
            if problem:
                line = read_yaml(path)[1].get((*key, index))
                problems.append(f"{path}, line {line}: {'.'.join(key)} {problem}")
    if problems:
        raise InputError("\n".join(problems))


def effect_problem(name: str, study: dict, known: dict[str, dict]) -> str:
    """What is wrong with an effect's name, or an empty text."""
    if name not in known:
        return f"has {name!r}, which is not an effect. {did_you_mean(name, list(known))}"
    geometry = study["solver"]["geometry"]
    if geometry not in known[name]["geometries"]:
        possible = " or ".join(known[name]["geometries"])
        return (
            f"has {name!r}, which the geometry {geometry} does not show "
            f"(expected solver.geometry: {possible})."
        )
    if name in study["parameters"]:
        return f"has {name!r}, which is calibrated already. Take it out of one of them."
    return ""
