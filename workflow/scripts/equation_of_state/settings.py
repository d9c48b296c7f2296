"""The settings of a metal's equation of state."""

from pathlib import Path

import yaml

# Variables of isotherm.lmp and the settings that they are.
VARIABLES = {
    "element": "element",
    "lattice": "lattice_A",
    "narrowest": "narrowest",
    "widest": "widest",
    "points": "points",
    "settle": "settle_steps",
    "sample": "sample_steps",
    "molten": "molten_A2",
}


def read_settings(path: str | Path) -> dict:
    return yaml.safe_load(Path(path).read_text(encoding="utf-8"))


def isotherm_variables(settings: dict, temperature: int) -> str:
    """The arguments of LAMMPS for one isotherm."""
    values = {variable: settings[name] for variable, name in VARIABLES.items()}
    values |= {
        "temperature": temperature,
        "seed": settings["seed"] + temperature,
        "last": settings["points"] - 1,
    }
    return " ".join(f"-var {name} {value}" for name, value in values.items())


def isotherm_files(settings: dict, kind: str) -> list[str]:
    home = "results/equation_of_state/isotherms"
    return [f"{home}/{temperature}.{kind}.txt" for temperature in settings["temperatures_K"]]
