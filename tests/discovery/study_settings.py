"""Writes what the stages of the discovery study read: the design of its database and settings.

/usr/bin/python3 tests/discovery/study_settings.py --study tests/discovery/study/study.yaml \\
    --out results/discovery/study
"""

import argparse
import json
from pathlib import Path

from make_design import design, write_design
from study import calibrate_settings, design_settings, read_study, solver_settings, train_settings


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--study", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    study = read_study(options.study)
    options.out.mkdir(parents=True, exist_ok=True)
    write_design(options.out / "design.h5", design(design_settings(study)))
    solver = solver_settings(study)
    documents = {
        "solver": solver,
        "finer": {**solver, "fidelity": "standard"},
        "train": train_settings(study),
        "calibrate": calibrate_settings(study),
    }
    for name, document in documents.items():
        (options.out / f"{name}.json").write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
