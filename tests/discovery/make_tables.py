"""Writes blind tables, and what each hides in a sealed folder of its own.

/usr/bin/python3 tests/discovery/make_tables.py --study tests/discovery/study \\
    --runs sealed/runs --signatures signatures --tables tables --sealed sealed/tables t001 t002
"""

import argparse
import csv
import json
from pathlib import Path

import h5py
import numpy as np
from corruption import corrupted
from hidden_signal import NOISE, VELOCITY_NOISE, SignalTable
from hide import read_candidates, read_signatures
from network import Network
from plan import ALL, SEED, TWINS, Table, Variant, metal_name, plan
from specimens import DIAMETER_MM, LENGTH_MM, TEMPERATURE_K, ShotSet, shot_set

HELD_BACK = 5  # one shot in so many
BIAS = (0.015, 0.03)  # of the velocities that the gun reports
UNDERSTATEMENT = 2.0  # errors over what the table says of them
DOUBLED = {"drag_slope": "phonon_drag"}  # constant -> effect of the same meaning
SOURCE = "blind: computed, noise added"


def hideable(candidates: list[dict]) -> list[str]:
    """Effects that runs can hide; a bias of the velocity is made in the table itself."""
    return [c["name"] for c in candidates if c["kind"] == "effect" and c["name"] != "velocity_bias"]


def twins_of(candidates: list[dict]) -> list[str]:
    """Effects that a constant of the same meaning doubles."""
    names = [item["name"] for item in candidates]
    return [effect for constant, effect in DOUBLED.items() if constant in names]


def plan_of(candidates: list[dict]) -> list[Table]:
    """All tables, for a study's candidates."""
    return plan(hideable(candidates), twins_of(candidates))


def read_runs(path: Path) -> tuple[np.ndarray, np.ndarray, dict]:
    """Sizes [mm] of NOISE by shot, which shots stopped, and the inputs of the first run."""
    with h5py.File(path) as file:
        names = list(file["outputs"].attrs["names"])
        sizes = file["outputs"][:][:, [names.index(size) for size in NOISE]]
        inputs = dict(zip(file["inputs"].attrs["names"], file["inputs"][0], strict=True))
        return sizes, file["status"][:] == 0, inputs


def table_rows(table: Table, shots: ShotSet, sizes: np.ndarray, bias: float) -> list[dict]:
    """Measured = true x (1 + noise), the velocity's too; its true value is not told."""
    random = np.random.default_rng([SEED, 5, table.noise])
    noise = random.standard_normal((len(sizes), len(NOISE) + 1))
    if table.kind == "understated errors":
        noise[:, :-1] *= UNDERSTATEMENT
    rows = []
    for index, shape in enumerate(shots.shapes):
        velocity = shots.velocities[index] * (1 + bias) * (1 + VELOCITY_NOISE * noise[index, -1])
        row = {
            "id": f"shot_{index + 1:02d}",
            "lot": "blind",
            "use": "validate" if index % HELD_BACK == HELD_BACK // 2 else "calibrate",
            "shape": shape,
            "initial_temperature_K": f"{TEMPERATURE_K:g}",
            "velocity_m_s": f"{velocity:.3f}",
            "velocity_sd_m_s": f"{VELOCITY_NOISE * velocity:.3f}",
            "initial_diameter_mm": f"{DIAMETER_MM:g}",
            "initial_length_mm": f"{LENGTH_MM:g}",
        }
        for column, (size, relative) in enumerate(NOISE.items()):
            measured = sizes[index, column] * (1 + relative * noise[index, column])
            row[size] = f"{measured:.4f}"
            row[f"{size}_sd"] = f"{relative * measured:.4f}"
        rows.append({**row, "source": SOURCE})
    return rows


def write_table(path: Path, rows: list[dict]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


class Generator:
    """Makes tables of variants whose runs are in `runs`/<variant>.h5.

    Those with an effect need `signatures`/<metal>/signatures.h5, to say how visible it is.
    """

    def __init__(self, study: Path, runs: Path, signatures: Path):
        self._network = Network.from_file(study / "emulator.json")
        self._runs, self._signatures = runs, signatures
        self.candidates = read_candidates(study)

    def tables(self) -> list[Table]:
        return plan_of(self.candidates)

    def make(self, table: Table) -> tuple[list[dict], dict]:
        """The rows of the table, and the truth."""
        shots = shot_set(table.variant.shot_set, SEED)
        sizes, stopped, inputs = read_runs(self._runs / f"{table.variant.name}.h5")
        random = np.random.default_rng([SEED, 6, table.noise])
        bias = 0.0
        if table.kind == "bias":
            bias = float(random.choice([-1, 1]) * random.uniform(*BIAS))
        rows = table_rows(table, shots, sizes, bias)
        truth = {
            "kind": table.kind,
            "parameters": shots.parameters,
            "numerics": shots.numerics,
            "effects": {name: inputs[name] for name in table.variant.effects},
            "strength": table.variant.strength,
            "material": table.variant.material,
            "velocity_bias": bias,
            "candidates": table.candidates,
            "corrupted": None,
            **self._visibility(table, shots, sizes, stopped),
        }
        if table.kind == "bad shot":
            rows, truth["corrupted"] = corrupted(rows, random)
        return [row for row, keep in zip(rows, stopped, strict=True) if keep], truth

    def _visibility(self, table: Table, shots: ShotSet, sizes, stopped) -> dict:
        """Signal of what is hidden, from the runs; identifiability and likeness by signatures."""
        plain = Variant(table.variant.shot_set)
        if not table.variant.effects and not table.variant.material:
            return {"signal_sd": 0.0, "identifiability": {}, "most_alike": {}}
        true = SignalTable.of_set(self._network, shots)
        pairs = self._signatures / metal_name(shots.index) / "signatures.h5"
        signatures = read_signatures(pairs, self.candidates, self._network)
        without, stopped_without, _ = read_runs(self._runs / f"{plain.name}.h5")
        change = np.where((stopped & stopped_without)[:, None], sizes - without, 0.0)
        known = [c["name"] for c in self.candidates if self._is_listed(c, table.candidates)]
        return {
            "signal_sd": float(np.linalg.norm(true.signal(change))),
            "identifiability": {
                name: true.identifiability(signatures, name) for name in table.variant.effects
            },
            "most_alike": {
                name: true.likeness(signatures, name, [n for n in known if n != name])
                for name in table.variant.effects
            },
        }

    @staticmethod
    def _is_listed(candidate: dict, which: str) -> bool:
        return is_listed(candidate["name"], which)


def is_listed(name: str, which: str) -> bool:
    """Whether a list of candidates (all, twins, "without <effect>") has this one."""
    if name in DOUBLED:
        return which == TWINS
    return which in (ALL, TWINS) or which != f"without {name}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "runs", "signatures", "tables", "sealed"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("ids", nargs="+")
    options = parser.parse_args()
    generator = Generator(options.study, options.runs, options.signatures)
    options.sealed.mkdir(parents=True, exist_ok=True)
    for table in generator.tables():
        if table.id not in options.ids:
            continue
        rows, truth = generator.make(table)
        write_table(options.tables / table.id / "measurements.csv", rows)
        (options.sealed / f"{table.id}.json").write_text(json.dumps(truth, indent=1) + "\n")


if __name__ == "__main__":
    main()
