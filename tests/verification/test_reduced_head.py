"""A bar with a reduced head and J2 against finite elements that share nothing with the solver.

The head of 4 mm folds onto its shoulder at 90 m/s, not at 50. `studies/finite_elements.py` made the
table.
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

import pytest

VERIFICATION = Path(__file__).parent
sys.path.insert(0, str(VERIFICATION / "studies"))

import finite_elements  # noqa: E402
from head_runs import head_words  # noqa: E402

TABLE = VERIFICATION / "data" / "reduced_head_finite_elements.csv"
TOLERANCES = {
    "final_length_mm": 0.002,
    "head_length_mm": 0.01,
    "impact_diameter_mm": 0.01,
    "transition_diameter_mm": 0.02,
}


def computed(velocity, columns):
    """A row of the table as numbers."""
    with open(TABLE, newline="") as file:
        for row in csv.DictReader(file):
            if (row["velocity_m_s"], row["columns_in_head"]) == (str(velocity), str(columns)):
                return {name: float(row[name]) for name in finite_elements.SIZES}
    raise LookupError(f"{TABLE} has no row for {velocity} m/s and {columns} columns")


def test_finite_elements_have_converged():
    for velocity in (50, 90):
        fine, coarse = computed(velocity, 12), computed(velocity, 8)
        for name, tolerance in TOLERANCES.items():
            assert coarse[name] == pytest.approx(fine[name], rel=tolerance / 2), name


def test_the_table_is_what_the_finite_elements_compute():
    sizes, _ = finite_elements.impact(4, 90)
    assert sizes == pytest.approx(computed(90, 4), rel=2e-4)


@pytest.mark.parametrize("geometry", ["axisymmetric", "3d"])
@pytest.mark.parametrize("velocity", [50, 90])
def test_heads_have_the_sizes_that_finite_elements_compute(solver, geometry, velocity):
    command = [solver, "run", "--json", *head_words(velocity, geometry, "standard").split()]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    sizes = json.loads(finished.stdout)["sizes"]
    for name, theirs in computed(velocity, 12).items():
        assert sizes[name] == pytest.approx(theirs, rel=TOLERANCES[name]), name
