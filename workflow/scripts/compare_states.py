"""Tells how far states computed anew are from the committed ones, and their networks."""

import hashlib
import sys
from pathlib import Path

import numpy as np
from equation_of_state.models import Network
from equation_of_state.table import COLUMNS, read_states
from json_file import read_json


def read(folder: Path):
    density = read_json(folder / "provenance.json")["density_of_molecular_dynamics_kg_m3"]
    return read_states(folder / "states.csv", density)


def compare(anew: Path, committed: Path) -> str:
    same = [
        name
        for name in ("states.csv", "network.json")
        if _digest(anew / name) == _digest(committed / name)
    ]
    if len(same) == 2:
        return f"states and network in {anew} are those of {committed}, bit by bit"
    first, second = read(anew), read(committed)
    if len(first["temperature_K"]) != len(second["temperature_K"]):
        rows = len(first["temperature_K"]), len(second["temperature_K"])
        return f"{anew} has {rows[0]} states, {committed} has {rows[1]}"
    words = [f"largest differences of {anew} from {committed}:"]
    for name in COLUMNS:
        words.append(f"  {name}: {np.abs(first[name] - second[name]).max():.3g}")
    density, energy = second["density_kg_m3"], second["smooth_energy_J_kg"]
    answers = [
        Network.from_file(folder / "network.json").at(density, energy)
        for folder in (anew, committed)
    ]
    for name, one, other in zip(answers[0]._fields, *answers):
        words.append(f"  {name} of the networks: {np.abs(one - other).max():.3g}")
    return "\n".join(words)


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


if __name__ == "__main__":
    print(compare(Path(sys.argv[1]), Path(sys.argv[2])))
