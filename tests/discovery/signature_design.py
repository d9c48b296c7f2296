"""Writes the designs of the signatures' runs: pairs that differ in one candidate alone.

/usr/bin/python3 tests/discovery/signature_design.py --study tests/discovery/study/study.yaml \\
    --candidates candidates.json --out signature_design.h5 --finer finer_design.h5
"""

import argparse
import json
from pathlib import Path

import numpy as np
from make_design import design, write_design
from study import design_settings, read_study

POINTS_A_SHAPE = 12
FINER_A_SHAPE = 6  # of these, again at the next fidelity
SEED_SHIFT = 1000  # other points and grains than the database's


def signature_design(study: dict, candidates: list[dict]) -> dict:
    """For each point a plain run and one run a candidate, of the same seed."""
    settings = design_settings(study)
    shapes = settings["shapes"]
    settings |= {"runs": POINTS_A_SHAPE * len(shapes), "seed": settings["seed"] + SEED_SHIFT}
    points = design(settings)
    plain = np.array([item["base"] for item in candidates])
    changes = np.vstack([np.zeros(len(candidates)), np.diag([c["typical"] for c in candidates])])
    rows = [np.hstack([point, plain + change]) for point in points["inputs"] for change in changes]
    repeats = len(changes)
    return {
        "run_id": np.arange(len(rows), dtype=np.int64),
        "seed": np.repeat(points["seed"], repeats),
        "shape": [shape for shape in points["shape"] for _ in range(repeats)],
        "inputs": np.array(rows),
        "names": [*points["names"], *(item["name"] for item in candidates)],
    }


def finer_design(signatures: dict, candidates: int, shapes: int) -> dict:
    """The plain runs of the first points again, with the ids that they have among the pairs."""
    rows = np.arange(FINER_A_SHAPE * shapes) * (candidates + 1)
    chosen = {key: signatures[key][rows] for key in ("run_id", "seed", "inputs")}
    shape = [signatures["shape"][row] for row in rows]
    return {**chosen, "shape": shape, "names": signatures["names"]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "candidates", "out", "finer"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    study = read_study(options.study)
    candidates = json.loads(options.candidates.read_text())["candidates"]
    signatures = signature_design(study, candidates)
    write_design(options.out, signatures)
    shapes = len(study["database"]["shapes"])
    write_design(options.finer, finer_design(signatures, len(candidates), shapes))


if __name__ == "__main__":
    main()
