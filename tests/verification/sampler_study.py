"""One small calibration that several samplers can be given."""

import csv
import json
import os
import subprocess
from pathlib import Path

import h5py
import numpy as np

from network_likelihood import SHOT_INPUTS, Network, TableLikelihood

ROOT = Path(__file__).resolve().parents[2]
EMULATOR = ROOT / "tests" / "discovery" / "study" / "emulator.json"
SIZES = ["final_length_mm", "impact_diameter_mm", "head_length_mm"]
CONFIG = {
    "parameters": [
        {
            "name": "rho_immobile_initial",
            "lower": 1.0e12,
            "upper": 3.0e13,
            "prior": "log_uniform",
        },
        {"name": "hardening_coefficient", "lower": 1.5, "upper": 4.5},
        {"name": "immobilization_velocity", "lower": 0.15, "upper": 2},
    ],
    "fit_sizes": SIZES,
    "velocity_sd_relative": 0.01,
    "network_errors": "independent",
    "unexplained_spread": {"prior_scale": 0.01, "grid": [0, 0.01, 0.02]},
    "draws": 40000,
    "seed": 3,
}
TRUTH = {
    "rho_immobile_initial": 6.3e12,
    "hardening_coefficient": 2.8,
    "immobilization_velocity": 0.8,
}


def write_table(folder: Path) -> None:
    """A table that the network made, with noise."""
    network = Network(EMULATOR)
    names = [output["name"] for output in network.outputs]
    random = np.random.default_rng(5)
    rows = []
    for number in range(9):
        shape = network.shapes[number % len(network.shapes)]
        row = {
            "id": f"shot_{number}",
            "lot": "synthetic",
            "use": "calibrate",
            "material": "copper as modelled",
            "shape": shape,
            "initial_temperature_K": 300,
            "velocity_m_s": 50 + 9 * number,
            "velocity_sd_m_s": "",
            "initial_diameter_mm": 8,
            "initial_length_mm": 40,
        }
        values = {name: read(row) for name, read in SHOT_INPUTS.items()}
        sizes = network.sizes(shape, values | TRUTH)[0]
        for size in SIZES:
            row[size] = f"{sizes[names.index(size)] * (1 + 0.01 * random.normal()):.4f}"
            row[size + "_sd"] = f"{0.01 * sizes[names.index(size)]:.4f}"
        rows.append(row | {"source": "made by the network", "note": ""})
    with open(folder / "measurements.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def sample(folder, name, **changes):
    """Runs `calibrate sample`; the file it writes."""
    program = Path(os.environ.get("TAYLORCAL_CALIBRATE", ROOT / "build" / "bin" / "calibrate"))
    if not program.is_file():
        raise FileNotFoundError(f"{program} does not exist. Run `make build`.")
    (folder / f"{name}.json").write_text(json.dumps(CONFIG | changes))
    command = [program, "sample", "--config", folder / f"{name}.json"]
    command += ["--measurements", folder / "measurements.csv", "--emulator", EMULATOR]
    command += ["--out", folder / f"{name}.h5", "--threads", "2"]
    finished = subprocess.run(command, capture_output=True, text=True)
    if finished.returncode != 0:
        raise RuntimeError(finished.stderr)
    return h5py.File(folder / f"{name}.h5")


def unit(values):
    """Plain parameters as places in the unit interval."""
    columns = []
    for parameter, column in zip(CONFIG["parameters"], np.asarray(values).T):
        low, high = parameter["lower"], parameter["upper"]
        if parameter.get("prior") == "log_uniform":
            columns.append(np.log(column / low) / np.log(high / low))
        else:
            columns.append((column - low) / (high - low))
    return np.array(columns).T


def likelihood_of(folder, posterior):
    """The same likelihood in numpy, with df/dv taken at the same point."""
    return TableLikelihood(EMULATOR, folder / "measurements.csv", CONFIG, posterior["reference"][:])


def emcee_chain(likelihood, start, steps, seed=2):
    """A chain of emcee's walkers that start at `start`, and its autocorrelation length."""
    import emcee

    def log_density(points):
        inside = ((points > 0) & (points < 1)).all(axis=1)
        heights = np.full(len(points), -np.inf)
        if inside.any():
            heights[inside] = likelihood(points[inside])
        return heights

    np.random.seed(seed)
    sampler = emcee.EnsembleSampler(*start.shape, log_density, vectorize=True)
    sampler.run_mcmc(start, steps)
    length = sampler.get_autocorr_time(quiet=True).max()
    return sampler.get_chain(discard=steps // 15, flat=True), length
