"""A study in closed form for the tests: sizes linear in the parameters, effects quadratic in v."""

import json
from pathlib import Path

import h5py
import numpy as np
from hidden_signal import NOISE
from make_design import write_design
from make_tables import DOUBLED
from network import Network
from make_signature_design import base_rows
from signature_design import signature_design
from specimens import SHAPES
from study import read_study

RANGES = {
    "velocity_m_s": (38.0, 132.0),
    "initial_diameter_mm": (8.0, 8.0),
    "length_to_diameter": (5.0, 5.0),
    "initial_temperature_K": (300.0, 300.0),
    "rho_immobile_initial": (1e12, 3e13),
    "hardening_coefficient": (1.5, 4.5),
    "immobilization_velocity": (0.15, 2.0),
}
EFFECTS = ["anvil_friction", "back_stress", "hard_skin", "phonon_drag", "rod_texture"]
CANDIDATES = [
    {
        "name": name,
        "kind": "constant" if name == "drag_slope" else "effect",
        "symbol": name[0],
        "unit": "1",
        "base": 0.0,
        "lowest": -1.0 if name == "rod_texture" else 0.0,
        "highest": 1.0,
        "prior": {"kind": "half_normal", "scale": 0.3},
        "signed": name == "rod_texture",
        "typical": 0.5,
    }
    for name in [*EFFECTS, "velocity_bias", "drag_slope"]
]
STUDY = read_study(Path(__file__).parent / "study" / "study.yaml")  # of the same ranges


def network_document() -> dict:
    """One linear layer; sizes in units of the specimen's, errors of the network small."""
    random = np.random.default_rng(11)
    used = ["velocity_m_s", *list(RANGES)[4:]]
    inputs = []
    for name, (lowest, highest) in RANGES.items():
        logarithmic = name.startswith("rho_")
        low, high = np.log10((lowest, highest)) if logarithmic else (lowest, highest)
        scaling = {"shift": (low + high) / 2, "scale": max((high - low) / 2, 1e-9)}
        word = {"transform": "log10" if logarithmic else "linear", "used": name in used}
        inputs.append({"name": name, "lower": lowest, "upper": highest, **scaling, **word})
    weights = random.normal(0, 0.03, size=(len(NOISE), len(used) + len(SHAPES)))
    offsets = [1.3 if "diameter" in size else 0.6 for size in NOISE]
    length = ["initial_diameter_mm", "length_to_diameter"]
    outputs = [
        {
            "name": size,
            "shift": 0.0,
            "scale": 1.0,
            "divide_by": length[:1] if "dia" in size else length,
        }
        for size in NOISE
    ]
    covariance = {"outputs": list(NOISE), "matrix": (1e-7 * np.eye(len(NOISE))).tolist()}
    layer = {"weights": weights.tolist(), "bias": offsets}
    member = {"layers": [layer], "seed": 1, "batch_size": 1, "learning_rate": 0.0}
    return {
        "schema": "taylorcal/emulator/1",
        "activation": "silu",
        "provenance": {},
        "inputs": inputs,
        "outputs": outputs,
        "category": {"name": "shape", "values": SHAPES},
        "best": 0,
        "members": [{**member, "validation_rms": 0.0}],
        "validation": {"covariance": {shape: covariance for shape in SHAPES}},
    }


def toy_sizes(network: Network, design: dict) -> np.ndarray:
    """Sizes [mm] of a design's rows, effects included."""
    names, rows = design["names"], design["inputs"]
    sizes = np.empty((len(rows), len(NOISE)))
    for index, (shape, row) in enumerate(zip(design["shape"], rows, strict=True)):
        values = dict(zip(names, row, strict=True))
        sizes[index] = network.sizes(shape, {key: np.array(values[key]) for key in RANGES})
        speed = (values["velocity_m_s"] - 85) / 47
        for candidate in CANDIDATES:
            name = DOUBLED.get(candidate["name"], candidate["name"])
            random = np.random.default_rng([*name.encode(), SHAPES.index(shape)])
            pattern = random.normal(0, 1.0, size=(len(NOISE), 3)) @ [1, speed, speed**2]
            sizes[index] += values.get(candidate["name"], 0.0) * pattern
    return sizes


def write_runs(path: Path, design: dict, sizes: np.ndarray) -> None:
    """A database of runs that all stopped."""
    write_design(path, design)
    text = h5py.string_dtype(encoding="utf-8")
    with h5py.File(path, "a") as file:
        file.attrs["schema"] = "taylorcal/database/1"
        file.create_dataset("outputs", data=sizes, track_times=False)
        file["outputs"].attrs.create("names", list(NOISE), dtype=text)
        file.create_dataset("descriptors", data=sizes[:, :1], track_times=False)
        file["descriptors"].attrs.create("names", ["stop_time_us"], dtype=text)
        file.create_dataset("status", data=np.zeros(len(sizes), dtype=np.int64), track_times=False)


def write_study(folder: Path) -> Path:
    """The files that the generator and the refit read."""
    folder.mkdir(parents=True, exist_ok=True)
    document = network_document()
    (folder / "emulator.json").write_text(json.dumps(document))
    (folder / "candidates.json").write_text(json.dumps({"candidates": CANDIDATES}))
    network = Network(document)
    pairs = signature_design(STUDY, CANDIDATES)
    write_runs(folder / "signatures.h5", pairs, toy_sizes(network, pairs))
    finer = base_rows(pairs, len(CANDIDATES))
    write_runs(folder / "signatures_finer.h5", finer, toy_sizes(network, finer))
    return folder
