"""What the verification tests share: the solver, and a run of `solver point`."""

import csv
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def solver():
    """The program under test: TAYLORCAL_SOLVER, or the one that `make build` makes."""
    program = Path(os.environ.get("TAYLORCAL_SOLVER", ROOT / "build" / "bin" / "solver"))
    if not program.is_file():
        pytest.fail(f"{program} does not exist. Run `make build`.")
    return program


@pytest.fixture
def run_point(solver, tmp_path):
    """Runs `solver point` on a path (a dictionary, or a JSON text) as it is."""

    def run(path):
        path_file = tmp_path / "path.json"
        path_file.write_text(path if isinstance(path, str) else json.dumps(path))
        return subprocess.run(
            [solver, "point", path_file, "--out", tmp_path / "curve.csv"],
            capture_output=True,
            text=True,
        )

    return run


@pytest.fixture
def follow(run_point, tmp_path):
    """The curve {column: array} that `solver point` makes of a path."""

    def curve(path):
        finished = run_point(path)
        assert finished.returncode == 0, finished.stderr
        with open(tmp_path / "curve.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {column: np.array([float(row[column]) for row in rows]) for column in rows[0]}

    return curve
