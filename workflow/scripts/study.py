"""Reads a study and cuts it into the configuration of each stage.

Each stage gets only the settings that concern it, so that a change of the sampler's
settings leaves the database and the network as they are.
"""

from pathlib import Path

from input_errors import InputError
from schema_check import fill_defaults, findings, load_schema
from yaml_lines import read_yaml

EXPERIMENTS = Path("experiments")
DESIGN_RANGES = ["velocity_m_s", "initial_diameter_mm", "length_to_diameter"]
DESIGN_RANGES += ["initial_temperature_K"]
LENGTH = ["initial_diameter_mm", "length_to_diameter"]
DIAMETER = ["initial_diameter_mm"]
OUTLINE_SCORES = [f"outline_pc_{k}" for k in range(1, 5)]  # of principal components, in mm


def load_study(name: str, experiments: Path = EXPERIMENTS) -> dict:
    """The validated content of experiments/<name>/study.yaml with its defaults."""
    path = experiments / name / "study.yaml"
    if not path.exists():
        known = sorted(folder.parent.name for folder in experiments.glob("*/study.yaml"))
        raise InputError(f"{path}: there is no such study. Known here: {', '.join(known)}.")
    return read_study(path)


def read_study(path: Path) -> dict:
    given, lines = read_yaml(path)
    schema = load_schema("study")
    found = findings(given, schema)
    study = fill_defaults(given, schema, schema) if not found else given
    found = found or _contradictions(study)
    if found:
        raise InputError("\n".join(sorted(_placed(path, lines, *item) for item in found)))
    return study


def _placed(path: Path, lines: dict, key: tuple, problem: str) -> str:
    """<file>, line n: <key> <problem>; a missing key gets the line of its group."""
    here = key
    while here and here not in lines:
        here = here[:-1]
    line = f", line {lines[here]}" if here else ""
    return f"{path}{line}: {'.'.join(map(str, key))} {problem}"


def _contradictions(study: dict) -> list[tuple[tuple, str]]:
    """What a schema cannot say: values that do not fit each other."""
    found = []
    for key in DESIGN_RANGES:
        lowest, highest = study["database"][key]
        if lowest > highest:
            problem = f"= [{lowest}, {highest}] (expected the lowest value first)."
            found.append((("database", key), problem))
    for name, parameter in study["parameters"].items():
        key = ("parameters", name)
        if parameter["lower"] >= parameter["upper"]:
            limits = f"{parameter['lower']} to {parameter['upper']}"
            found.append((key, f"has the range {limits} (expected lower < upper)."))
        if parameter["prior"] == "log_uniform" and parameter["lower"] <= 0:
            found.append((key, "has prior log_uniform from 0 (expected lower > 0)."))
    if study["database"]["chunks"] > study["database"]["runs"]:
        found.append((("database", "chunks"), "is more than `runs` (expected at most as many)."))
    for size in study["calibration"]["fit_sizes"]:
        if size not in study["emulator"]["outputs"]:
            problem = f"has {size!r}, which is not in emulator.outputs. Add it there."
            found.append((("calibration", "fit_sizes"), problem))
    if study["synthetic"] and not study["synthetic_note"]:
        found.append((("synthetic_note",), "is missing; say how the synthetic table was made."))
    return found


def is_radial(size: str) -> bool:
    """Whether a size scales with the diameter, and not with the length."""
    return "diameter" in size or size in OUTLINE_SCORES


def uses_outlines(study: dict) -> bool:
    """Whether measured outlines are compared, as scores of principal components."""
    return any(size in OUTLINE_SCORES for size in study["emulator"]["outputs"])


def design_settings(study: dict) -> dict:
    """What the design of the database depends on."""
    database = study["database"]
    parameters = {
        name: {key: parameter[key] for key in ("lower", "upper", "prior")}
        for name, parameter in study["parameters"].items()
    }
    ranges = {key: database[key] for key in DESIGN_RANGES}
    kept = {key: database[key] for key in ("runs", "seed", "shapes")}
    return {**kept, "ranges": ranges, "parameters": parameters}


def solver_settings(study: dict) -> dict:
    """solver.json"""
    return study["solver"]


def train_settings(study: dict) -> dict:
    """train.json"""
    inputs = [{"name": name} for name in DESIGN_RANGES]
    for name, parameter in study["parameters"].items():
        log = {"transform": "log10"} if parameter["prior"] == "log_uniform" else {}
        inputs.append({"name": name, **log})
    settings = dict(study["emulator"])
    outputs = [
        {"name": size, "divide_by": DIAMETER if is_radial(size) else LENGTH}
        for size in settings.pop("outputs")
    ]
    category = "shape" if len(study["database"]["shapes"]) > 1 else None
    return {"inputs": inputs, "category": category, "outputs": outputs, **settings}


def calibrate_settings(study: dict) -> dict:
    """calibrate.json"""
    parameters = [{"name": name, **values} for name, values in study["parameters"].items()]
    return {"parameters": parameters, **study["calibration"]}


def report_settings(study: dict) -> dict:
    """report.json: what only the page needs."""
    keys = ("title", "material", "about", "synthetic", "synthetic_note", "outlines")
    settings = {key: study[key] for key in keys}
    parameters = load_schema("study")["properties"]["parameters"]["properties"]
    settings["parameters"] = {
        name: {**values, "words": parameters[name]["description"], "unit": parameters[name]["unit"]}
        for name, values in study["parameters"].items()
    }
    return settings


STAGE_SETTINGS = {
    "solver": solver_settings,
    "train": train_settings,
    "calibrate": calibrate_settings,
    "report": report_settings,
}
