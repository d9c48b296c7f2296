"""Writes the design of pairs of runs over the study's ranges that differ in one candidate.

/usr/bin/python3 tests/discovery/signature_design.py --study tests/discovery/study/study.yaml \\
    --candidates candidates.json --out design.h5

They tell how large an amplitude of a pair may be; the signatures that diagnoses read are made
for each metal, by set_signatures.py.
"""

import argparse
import json
from pathlib import Path

import numpy as np
from make_design import design, write_design
from study import design_settings, read_study

POINTS_A_SHAPE = 12
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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name in ("study", "candidates", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    study = read_study(options.study)
    candidates = json.loads(options.candidates.read_text())["candidates"]
    write_design(options.out, signature_design(study, candidates))


if __name__ == "__main__":
    main()
