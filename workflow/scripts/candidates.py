"""What a diagnosis tries one by one: effects that are not in, and constants kept fixed.

An entry's amplitude is its value less `base`, the value at which it is absent.
"""

from pathlib import Path

import yaml

from input_errors import InputError, did_you_mean

CONSTANTS = Path(__file__).resolve().parent.parent / "constants.yaml"
SHARED = ("name", "symbol", "unit", "lowest", "highest", "prior", "description", "source")


def candidates(study: dict, effects: dict[str, dict], parameters: dict[str, dict]) -> list[dict]:
    """Entries of candidates.json; `effects` and `parameters` as the solver lists them."""
    return [
        *(_of_effect(entry) for entry in _effects_to_try(study, effects)),
        *_constants_to_try(study, parameters),
    ]


def typical_amplitudes(study: dict, effects: dict[str, dict]) -> dict[str, float]:
    """The amplitude of a plain signature run by candidate; a constant moves by its scale."""
    typical = {entry["name"]: entry["typical"] for entry in _effects_to_try(study, effects)}
    constants = known_constants()
    return typical | {
        name: constants[name]["prior"]["scale"] for name in _constant_names(study, constants)
    }


def _effects_to_try(study: dict, effects: dict[str, dict]) -> list[dict]:
    chosen = study["diagnosis"]["candidates"]
    inside = {effect["name"] for effect in study["revision"]}
    geometry = study["solver"]["geometry"]
    return [
        entry
        for name, entry in effects.items()
        if name not in inside
        and geometry in entry["geometries"]
        and (chosen == "all" or name in chosen)
    ]


def _of_effect(entry: dict) -> dict:
    kept = {key: entry[key] for key in (*SHARED, "signed", "equation")}
    return {**kept, "kind": "effect", "base": 0.0}


def known_constants() -> dict[str, dict]:
    """Priors and ranges of the constants that may be wrong, by name."""
    return yaml.safe_load(CONSTANTS.read_text(encoding="utf-8"))


def _constant_names(study: dict, constants: dict) -> list[str]:
    for name in study["diagnosis"]["constants"]:
        if name not in constants:
            raise InputError(
                f"study.yaml: diagnosis.constants has {name!r}, which workflow/constants.yaml "
                f"does not. {did_you_mean(name, list(constants))}"
            )
    return [name for name in study["diagnosis"]["constants"] if name not in study["parameters"]]


def _constants_to_try(study: dict, parameters: dict[str, dict]) -> list[dict]:
    constants = known_constants()
    entries = []
    for name in _constant_names(study, constants):
        entry = {key: parameters[name][key] for key in ("name", "symbol", "unit", "description")}
        entry |= constants[name]
        base = study["solver"]["material"].get(name, parameters[name]["default"])
        if not entry["lowest"] <= base <= entry["highest"]:
            raise InputError(
                f"study.yaml: solver.material.{name} = {base:g} is outside the values that a "
                f"diagnosis tries ({entry['lowest']:g} to {entry['highest']:g}). Change "
                "workflow/constants.yaml or leave it out of diagnosis.constants."
            )
        kind = {"kind": "constant", "base": base, "equation": parameters[name]["source"]}
        entries.append({**entry, **kind, "signed": entry["prior"]["kind"] != "half_normal"})
    return entries
