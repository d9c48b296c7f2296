"""Checks data against a JSON schema and words each finding as value, expectation, remedy."""

from pathlib import Path

import jsonschema
import yaml

from input_errors import did_you_mean

UNIT_WORDS = set("m mm cm km um nm in inch ft s ms us min h K C F degC kg g m2 m3 per".split())
# JSON schemas take 24.0 for a whole number; the programs do not.
_whole = jsonschema.Draft202012Validator.TYPE_CHECKER.redefine(
    "integer", lambda _, value: isinstance(value, int) and not isinstance(value, bool)
)
_Validator = jsonschema.validators.extend(jsonschema.Draft202012Validator, type_checker=_whole)
SCHEMAS = Path(__file__).resolve().parent.parent / "schemas"


PATTERN_WORDS = {
    "^[A-Za-z0-9_.-]+$": "letters a to z, digits, points, - and _, without spaces",
    "^[a-z0-9_]+$": "small letters a to z, digits and _, without spaces",
    "\\.csv$": "the name of a file that ends in .csv",
    "^all$": "all, or a list of names",
}


def load_schema(name: str) -> dict:
    return yaml.safe_load((SCHEMAS / f"{name}.schema.yaml").read_text())


def fill_defaults(value: dict, schema: dict, root: dict) -> dict:
    """A copy of `value` with the defaults of the schema where a key is absent."""
    filled = dict(value)
    for key, sub in schema.get("properties", {}).items():
        sub = {**_resolve(sub, root), **sub}
        if key not in filled and "default" in sub:
            filled[key] = sub["default"]
        if isinstance(filled.get(key), dict):
            filled[key] = fill_defaults(filled[key], sub, root)
    return filled


def _resolve(schema: dict, root: dict) -> dict:
    if "$ref" not in schema:
        return schema
    return root["$defs"][schema["$ref"].rsplit("/", 1)[1]]


def findings(value: dict, schema: dict) -> list[tuple[tuple, str]]:
    """(path of the key, what is wrong with it) for each violation."""
    found = []
    for error in _Validator(schema).iter_errors(value):
        found.extend(_worded(error))
    return found


def _worded(error) -> list[tuple[tuple, str]]:
    path = tuple(error.absolute_path)
    rule, given = error.validator, error.instance
    unit = _unit(error.schema)
    if rule == "additionalProperties":
        known = list(error.schema["properties"])
        unknown = [key for key in given if key not in known]
        return [((*path, key), _unknown_key(key, known)) for key in unknown]
    if rule == "required":
        missing = [key for key in error.validator_value if key not in given]
        return [((*path, key), _missing_key(key, list(given))) for key in missing]
    if rule == "dependentRequired":
        partners = error.validator_value.items()
        return [
            ((*path, there), f"is given without {absent}. Give both or neither.")
            for there, wanted in partners
            for absent in wanted
            if there in given and absent not in given
        ]
    if rule == "enum":
        known = [str(word) for word in error.validator_value]
        return [(path, f"= {given!r} is not a known word. {did_you_mean(given, known)}")]
    if rule == "pattern" and "words" in error.schema:
        hint = did_you_mean(given, error.schema["words"])
        return [(path, f"= {given!r} is not a known word. {hint} {error.schema['words_note']}")]
    if rule == "pattern":
        expected = PATTERN_WORDS.get(error.validator_value, f"text like {error.validator_value}")
        return [(path, f"= {given!r} (expected {expected}).")]
    if rule == "type":
        hint = _quotes_hint(given, error.validator_value) or _text_hint(given)
        return [(path, f"= {given!r} (expected {_type_name(error)}).{hint}")]
    if rule == "uniqueItems":
        twice = next(item for item in given if given.count(item) > 1)
        return [(path, f"holds {twice!r} twice. Keep one.")]
    bounds = {
        "minimum": "at least",
        "exclusiveMinimum": "above",
        "maximum": "at most",
        "exclusiveMaximum": "below",
        "minItems": "a list with a length of at least",
        "maxItems": "a list with a length of at most",
    }
    if rule in bounds:
        return [(path, f"= {given!r} (expected {bounds[rule]} {error.validator_value}{unit}).")]
    return [(path, f"= {given!r}: {error.message}")]


def _unknown_key(key: str, known: list[str]) -> str:
    """A wrong unit is the usual slip, so the stem is compared before the whole word."""
    stem_mates = [name for name in known if _stem(name) == _stem(str(key))]
    if stem_mates:
        return (
            f"is not a known key: its unit is not understood. "
            f"Did you mean {stem_mates[0]!r}? Convert the value to that unit."
        )
    return f"is not a known key. {did_you_mean(key, known)}"


def _stem(key: str) -> str:
    """The name without its unit: velocity_km_s -> velocity."""
    words = key.split("_")
    while len(words) > 1 and words[-1] in UNIT_WORDS:
        words.pop()
    return "_".join(words)


def _missing_key(key: str, given: list[str]) -> str:
    text = "is missing."
    near = [name for name in given if _stem(name) == _stem(key)]
    return f"{text} {near[0]!r} is given: is it in another unit?" if near else text


def _type_name(error) -> str:
    names = error.validator_value
    names = [names] if isinstance(names, str) else names
    words = {"number": "a number", "integer": "a whole number", "string": "a text"}
    words |= {"array": "a list", "object": "a group of keys", "boolean": "true or false"}
    return " or ".join(words.get(name, name) for name in names)


def _unit(schema: dict) -> str:
    unit = schema.get("unit", "none")
    return "" if unit == "none" else f" {unit}"


def _quotes_hint(given, wanted: str | list[str]) -> str:
    """A heading such as 2020 is a number to YAML."""
    return " Put it in quotes." if wanted == "string" and isinstance(given, int | float) else ""


def _text_hint(given) -> str:
    """YAML 1.1 reads 1e-3 as text, because it wants a dot in the mantissa."""
    if isinstance(given, str) and "e" in given.lower():
        try:
            number = float(given)
        except ValueError:
            return ""
        mantissa, exponent = f"{number:e}".split("e")
        mantissa = mantissa.rstrip("0") + ("0" if mantissa.rstrip("0").endswith(".") else "")
        return f" YAML reads {given} as text: write {mantissa}e{exponent}."
    return ""
