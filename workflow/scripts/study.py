"""Reads a study and cuts it into the configuration of each stage.

Each stage gets only the settings that concern it, so that a change of the sampler's
settings leaves the database and the network as they are.
"""

import re
from pathlib import Path

from contradictions import contradictions, not_finite
from input_errors import InputError, did_you_mean
from schema_check import fill_defaults, findings, load_schema
from shot_inputs import SHOT_INPUTS
from size_kinds import OUTLINE_SCORES, is_radial
from yaml_lines import placed, read_yaml

EXPERIMENTS = Path("experiments")
NAME = re.compile("[A-Za-z][A-Za-z0-9_]*")  # --config makes a number of 2024 and 1e3
LENGTH = ["initial_diameter_mm", "length_to_diameter"]
DIAMETER = ["initial_diameter_mm"]
FIDELITIES = ["coarse", "standard", "fine"]
FIRST_BETTER_RUN = 100_000_000  # beyond those of any revision: no number is used twice
FIRST_NEAR_RUN = 150_000_000
FIRST_FURTHER_RUN = 50_000_000  # and a million for each part: see the schema
RUNS_OF_A_PART = 1_000_000


def load_study(name: str, experiments: Path = EXPERIMENTS) -> dict:
    """The validated content of experiments/<name>/study.yaml with its defaults."""
    if not NAME.fullmatch(str(name)):
        raise InputError(
            f"study = {name} (expected a folder of {experiments}/ with a name of letters, digits "
            f"and _ that begins with a letter). {_hint(name, experiments)}"
        )
    path = experiments / name / "study.yaml"
    if not path.exists():
        raise InputError(f"{path}: there is no such study. {_hint(name, experiments)}")
    return read_study(path)


def name_of_study(given: str) -> str:
    """As a shell completes it, experiments/tiny/ is the study tiny."""
    return given.removeprefix("./").removeprefix(f"{EXPERIMENTS}/").rstrip("/")


def _hint(name: str, experiments: Path) -> str:
    return did_you_mean(name, [folder.parent.name for folder in experiments.glob("*/study.yaml")])


def read_study(path: Path) -> dict:
    given, lines = read_yaml(path)
    schema = load_schema("study")
    found = not_finite(given) + findings(given, schema)
    study = fill_defaults(given, schema, schema) if not found else given
    found = found or contradictions(study)
    if found:
        places = [placed(path, lines, *item) for item in found]
        raise InputError("\n".join(sorted(dict.fromkeys(places))))
    study["database"].setdefault("runs_per_effect", max(4, study["database"]["runs"] // 4))
    study["emulator"].setdefault("epochs_of_revision", -(-study["emulator"]["epochs"] // 3))
    return at_revision(study, [])


def at_revision(study: dict, effects: list[dict]) -> dict:
    """The study as one of its revisions sees it: `revision` holds what `solver effects`
    says of each effect that is in; none is in the base.
    """
    return {**study, "revision": effects}


def uses_outlines(study: dict) -> bool:
    """Whether measured outlines are compared, as scores of principal components."""
    return any(size in OUTLINE_SCORES for size in study["emulator"]["outputs"])


def database_parts(study: dict) -> list[dict]:
    """Shapes and ranges that the database covers: its own, then those of each further part."""
    database = study["database"]
    own = {key: database[key] for key in ("shapes", *SHOT_INPUTS)}
    return [own] + [{key: part.get(key, own[key]) for key in own} for part in database["further"]]


def all_shapes(study: dict) -> list[str]:
    return list(dict.fromkeys(s for part in database_parts(study) for s in part["shapes"]))


def design_settings(study: dict) -> dict:
    """What the design of the database depends on."""
    database = study["database"]
    parameters = {
        name: {**covered_range(name, study), "prior": parameter["prior"]}
        for name, parameter in study["parameters"].items()
    }
    settings = {key: database[key] for key in ("seed", "shapes")}
    settings |= {"runs": new_runs(study), "parameters": parameters}
    settings["ranges"] = {key: database[key] for key in SHOT_INPUTS}
    if study["revision"]:
        parts = database_parts(study)
        settings["shapes"] = all_shapes(study)
        for key in SHOT_INPUTS:
            limits = [limit for part in parts for limit in part[key]]
            settings["ranges"][key] = [min(limits), max(limits)]
        earlier = len(study["revision"]) - 1
        settings["first_run"] = database["runs"] + earlier * database["runs_per_effect"]
        settings["effects"] = {
            effect["name"]: {"lower": effect["lowest"], "upper": effect["highest"]}
            for effect in study["revision"]
        }
    return settings


def better_design_settings(study: dict) -> dict:
    """The same for the runs of the better solver, which has no runs of an effect."""
    settings = design_settings(at_revision(study, []))
    return {**settings, "runs": study["database"]["better"]["runs"], "first_run": FIRST_BETTER_RUN}


def further_design_settings(study: dict, part: int) -> dict:
    """The same for a further part of the database, which revisions take from the base."""
    settings = design_settings(at_revision(study, []))
    covered = database_parts(study)[1 + part]
    settings |= {"shapes": covered.pop("shapes"), "ranges": covered}
    given = study["database"]["further"][part]
    settings |= {key: given[key] for key in ("runs", "spacing") if key in given}
    return {**settings, "first_run": FIRST_FURTHER_RUN + part * RUNS_OF_A_PART}


def near_design_settings(study: dict) -> dict:
    """What the runs near a first posterior depend on besides it and the table."""
    parameters = {
        name: {"transform": "linear", **covered_range(name, study), **_transform_of(parameter)}
        for name, parameter in study["parameters"].items()
    }
    settings = {"seed": study["database"]["seed"], "parameters": parameters}
    runs = study["database"]["near_posterior"]["runs"]
    return {**settings, "runs": runs, "first_run": FIRST_NEAR_RUN}


def covered_range(name: str, study: dict) -> dict:
    """Range of a parameter that the runs cover: that of its prior, unless `database` says more."""
    prior = study["parameters"][name]
    lower, upper = study["database"]["parameters"].get(name, (prior["lower"], prior["upper"]))
    return {"lower": lower, "upper": upper}


def new_runs(study: dict) -> int:
    """Runs that the database of this revision has beyond those of the one before."""
    return study["database"]["runs_per_effect" if study["revision"] else "runs"]


def chunk_count(study: dict) -> int:
    return min(study["database"]["chunks"], new_runs(study))


def solver_settings(study: dict) -> dict:
    """solver.json"""
    return study["solver"]


def better_settings(study: dict) -> dict:
    """solver_better.json: what the network answers as; `solver` where there is no better one."""
    better = study["database"]["better"] or {}
    return {**study["solver"], **{key: value for key, value in better.items() if key != "runs"}}


def finer_settings(study: dict) -> dict:
    """solver_finer.json: the same at the next fidelity, to see the solver's own error."""
    finer = FIDELITIES[FIDELITIES.index(study["solver"]["fidelity"]) + 1]
    return {**study["solver"], "fidelity": finer}


def has_finer(study: dict) -> bool:
    """A network that runs of a better solver have corrected has no such error to look for."""
    return not study["database"]["better"] and study["solver"]["fidelity"] != FIDELITIES[-1]


def train_settings(study: dict) -> dict:
    """train.json"""
    inputs = [{"name": name} for name in SHOT_INPUTS]
    for name, parameter in study["parameters"].items():
        inputs.append({"name": name, **_transform_of(parameter)})
    inputs += [{"name": effect["name"]} for effect in study["revision"]]
    settings = dict(study["emulator"])
    epochs_of_revision = settings.pop("epochs_of_revision")
    if study["revision"]:
        settings["epochs"] = epochs_of_revision
    outputs = [
        {"name": size, "divide_by": DIAMETER if is_radial(size) else LENGTH}
        for size in settings.pop("outputs")
    ]
    category = "shape" if len(all_shapes(study)) > 1 else None
    return {"inputs": inputs, "category": category, "outputs": outputs, **settings}


def _transform_of(parameter: dict) -> dict:
    """A parameter that starts near zero matters most there: without hardening or without
    immobilization the metal flows into a disc."""
    if parameter["prior"] == "log_uniform":
        return {"transform": "log10"}
    return {"transform": "square_root"} if parameter["lower"] >= 0 else {}


def calibrate_settings(study: dict) -> dict:
    """calibrate.json"""
    parameters = [{"name": name, **values} for name, values in study["parameters"].items()]
    parameters += [_amplitude(effect) for effect in study["revision"]]
    return {"parameters": parameters, **study["calibration"]}


def _amplitude(effect: dict) -> dict:
    """An effect's amplitude as a parameter: its prior is part of the effect's entry."""
    prior = effect["prior"]
    scale = {"scale": prior["scale"]} if prior["kind"] in ("half_normal", "normal") else {}
    limits = {"lower": effect["lowest"], "upper": effect["highest"]}
    return {"name": effect["name"], **limits, "prior": prior["kind"], **scale, "scope": "shared"}


def report_settings(study: dict) -> dict:
    """report.json: what only the page needs."""
    keys = ("title", "material", "about", "synthetic", "synthetic_note", "outlines")
    settings = {key: study[key] for key in keys}
    parameters = load_schema("study")["properties"]["parameters"]["properties"]
    settings["parameters"] = {
        name: {**values, "words": parameters[name]["description"], "unit": parameters[name]["unit"]}
        for name, values in study["parameters"].items()
    }
    if study["revision"]:
        settings["effects"] = [effect["name"] for effect in study["revision"]]
    for effect in study["revision"]:
        words = {"words": effect["description"], "unit": effect["unit"]}
        settings["parameters"][effect["name"]] = {**_amplitude(effect), **words}
    return settings


STAGE_SETTINGS = {
    "solver": solver_settings,
    "solver_better": better_settings,
    "solver_finer": finer_settings,
    "train": train_settings,
    "calibrate": calibrate_settings,
    "report": report_settings,
}
