"""Makes a table of synthetic shots with the solver: known parameters, then noise by seed.

/usr/bin/python3 workflow/scripts/make_synthetic_table.py --fidelity standard --seed 7 \\
    --out experiments/paper_design/measurements.csv

The fidelity and the seeds should differ from those of the study's database: a table made
with the very runs that the network learns from would flatter the calibration. `--set` changes
the truth, and may name an effect that the study's model lacks:

/usr/bin/python3 workflow/scripts/make_synthetic_table.py --fidelity standard --seed 11 \\
    --set anvil_friction=0.08 --shots 36 --out experiments/hidden_effect_tutorial/measurements.csv
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from atomic_file import written_whole
from input_errors import InputError
from make_design import write_design
from shape_names import PAPER_SHAPES, is_shape
from shot_inputs import SHOT_INPUTS

# Optimum (ii) of doi 10.3390/ma16165602, and its specimens, velocities and number of rows.
TRUTH = {
    "rho_immobile_initial": 6.3e12,
    "hardening_coefficient": 2.8,
    "immobilization_velocity": 0.4,
}
SHAPES = PAPER_SHAPES
DIAMETER_MM, LENGTH_MM, TEMPERATURE_K = 8.0, 40.0, 300.0
# Relative standard errors of a careful measurement.
NOISE = {
    "final_length_mm": 0.003,
    "impact_diameter_mm": 0.01,
    "head_length_mm": 0.01,
    "rear_length_mm": 0.01,
    "transition_diameter_mm": 0.01,
}
VELOCITY_NOISE = 0.005
HELD_BACK = 6  # one shot in so many


@dataclass
class TableDesign:
    """What is shot, and in what metal: parameters of the material and effects by name, SI units."""

    seed: int
    shapes: list[str] = field(default_factory=lambda: list(SHAPES))
    shots: int = 50
    velocities_m_s: tuple[float, float] = (19.0, 125.0)
    truth: dict[str, float] = field(default_factory=lambda: dict(TRUTH))

    def velocities_of(self, shape: int) -> np.ndarray:
        """Evenly from the lowest to the highest for each shape [m/s]."""
        count = len(range(shape, self.shots, len(self.shapes)))
        return np.round(np.linspace(*self.velocities_m_s, count), 1)

    def columns(self) -> dict:
        """The runs as `write_design` wants them."""
        rows = [
            (name, velocity)
            for index, name in enumerate(self.shapes)
            for velocity in self.velocities_of(index)
        ]
        shot = [DIAMETER_MM, LENGTH_MM / DIAMETER_MM, TEMPERATURE_K, *self.truth.values()]
        seeds = np.random.default_rng(self.seed).integers(1, 2**31, size=len(rows))
        return {
            "run_id": np.arange(len(rows), dtype=np.int64),
            "seed": seeds.astype(np.int64),
            "shape": [shape for shape, _ in rows],
            "inputs": np.array([[velocity, *shot] for _, velocity in rows]),
            "names": [*SHOT_INPUTS, *self.truth],
        }


def run_solver(solver: Path, design: dict, settings: dict, threads: int) -> np.ndarray:
    """The sizes of NOISE for each shot, from `solver batch`."""
    with tempfile.TemporaryDirectory() as folder:
        design_file, config = Path(folder, "design.h5"), Path(folder, "solver.json")
        write_design(design_file, design)
        config.write_text(json.dumps(settings))
        out = Path(folder, "shots.h5")
        command = [solver, "batch", design_file, "--config", config, "--out", out]
        subprocess.run([*command, "--threads", str(threads)], check=True)
        with h5py.File(out) as file:
            status, reasons = file["status"][:], file["reason"].asstr()[:]
            names = list(file["outputs"].attrs["names"])
            sizes = file["outputs"][:][:, [names.index(size) for size in NOISE]]
    for row in np.flatnonzero(status):
        raise InputError(f"shot {row} did not stop: {reasons[row]}. Use another fidelity.")
    return sizes


def table_rows(design: dict, sizes: np.ndarray, source: str, seed: int) -> list[dict]:
    """Measured = true x (1 + noise), the velocity's too; its true value is not told."""
    noise = np.random.default_rng([seed, 1]).standard_normal((len(sizes), len(NOISE) + 1))
    rows = []
    for index, shape in enumerate(design["shape"]):
        velocity = design["inputs"][index, 0]
        row = {
            "id": f"synthetic_{index + 1:02d}",
            "lot": "synthetic",
            "use": "validate" if index % HELD_BACK == HELD_BACK // 2 else "calibrate",
            "material": "copper as modelled",
            "shape": shape,
            "initial_temperature_K": f"{TEMPERATURE_K:g}",
            "velocity_m_s": f"{velocity * (1 + VELOCITY_NOISE * noise[index, -1]):.2f}",
            "velocity_sd_m_s": f"{VELOCITY_NOISE * velocity:.2f}",
            "initial_diameter_mm": f"{DIAMETER_MM:g}",
            "initial_length_mm": f"{LENGTH_MM:g}",
        }
        for column, (size, relative) in enumerate(NOISE.items()):
            true = sizes[index, column]
            row[size] = f"{true * (1 + relative * noise[index, column]):.4f}"
            row[f"{size}_sd"] = f"{relative * true:.4f}"
        rows.append({**row, "source": source, "note": ""})
    return rows


def write_table(path: Path, rows: list[dict]) -> None:
    with written_whole(path) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def truth_of(settings: list[str]) -> dict[str, float]:
    """TRUTH with the `name=value` of the command line; the solver checks names and ranges."""
    truth = dict(TRUTH)
    for text in settings:
        name, _, value = text.partition("=")
        try:
            truth[name] = float(value)
        except ValueError:
            raise InputError(f"--set {text} (expected name=value, as in anvil_friction=0.08).")
    return truth


def source_of(options: argparse.Namespace) -> str:
    """What each row says of its origin; a hidden effect stays hidden."""
    return (
        f"synthetic: made by taylorcal's solver ({options.geometry}, {options.fidelity}), "
        + ("" if options.set else "optimum (ii) of doi 10.3390/ma16165602, ")
        + f"noise added, seed {options.seed}"
    )


def shape(text: str) -> str:
    """One of the paper's specimens or one with measures of its own, as an option has it."""
    if not is_shape(text):
        raise argparse.ArgumentTypeError(
            f"{text} is no shape (expected {', '.join(PAPER_SHAPES)}, or measures as in"
            " reduced_head_5mm_by_12mm)"
        )
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--solver", type=Path, default=Path("build/bin/solver"))
    parser.add_argument("--geometry", choices=["axisymmetric", "3d"], default="axisymmetric")
    parser.add_argument("--fidelity", choices=["coarse", "standard", "fine"], required=True)
    parser.add_argument("--seed", type=int, required=True, help="of grains and noise")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--shapes", nargs="+", type=shape, default=SHAPES)
    parser.add_argument("--shots", type=int, default=50)
    parser.add_argument("--velocities", nargs=2, type=float, default=(19.0, 125.0), help="m/s")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=Path, required=True, help="table to write (CSV)")
    options = parser.parse_args()
    settings = {"geometry": options.geometry, "fidelity": options.fidelity}
    truth = truth_of(options.set)
    velocities = tuple(options.velocities)
    table = TableDesign(options.seed, options.shapes, options.shots, velocities, truth)
    design = table.columns()
    sizes = run_solver(options.solver.absolute(), design, settings, options.threads)
    write_table(options.out, table_rows(design, sizes, source_of(options), options.seed))


if __name__ == "__main__":
    try:
        main()
    except (InputError, subprocess.CalledProcessError, OSError) as error:
        sys.exit(f"make_synthetic_table: {error}")
