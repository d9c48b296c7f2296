"""A bar with a reduced head and J2 against finite elements that share nothing with the solver.

The head of 4 mm folds onto its shoulder at 90 m/s, not at 50. `studies/finite_elements.py` made the
table.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

VERIFICATION = Path(__file__).parent
sys.path.insert(0, str(VERIFICATION / "studies"))

import finite_elements  # noqa: E402
from head_runs import SOFT_SHOT, TABLE, head_words, soft_head_words  # noqa: E402

TOLERANCES = {
    "final_length_mm": 0.002,
    "head_length_mm": 0.01,
    "impact_diameter_mm": 0.01,
    "transition_diameter_mm": 0.02,
}


def computed(metal, velocity, columns):
    return finite_elements.computed(TABLE, metal, velocity, columns)


def sizes_of(solver, words):
    finished = subprocess.run(
        [solver, "run", "--json", *words.split()], capture_output=True, text=True
    )
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)["sizes"]


def test_finite_elements_have_converged():
    for case in finite_elements.CASES:
        fine, coarse = computed(*case, 12), computed(*case, 8)
        for name, tolerance in TOLERANCES.items():
            assert coarse[name] == pytest.approx(fine[name], rel=tolerance / 2), name


def test_the_table_is_what_the_finite_elements_compute():
    for metal in ("hard", "soft"):
        sizes, _ = finite_elements.impact(4, 90, metal)
        assert sizes == pytest.approx(computed(metal, 90, 4), rel=2e-4)


@pytest.mark.parametrize("geometry", ["axisymmetric", "3d"])
@pytest.mark.parametrize("velocity", [50, 90])
def test_heads_have_the_sizes_that_finite_elements_compute(solver, geometry, velocity):
    sizes = sizes_of(solver, head_words("hard", velocity, geometry, "standard"))
    for name, theirs in computed("hard", velocity, 12).items():
        assert sizes[name] == pytest.approx(theirs, rel=TOLERANCES[name]), name


@pytest.mark.parametrize("geometry, elements", [("axisymmetric", 16), ("3d", 8)])
def test_a_soft_head_has_them_too(solver, geometry, elements):
    sizes = sizes_of(solver, soft_head_words(geometry, elements))
    for name, theirs in computed("soft", SOFT_SHOT, 12).items():
        assert sizes[name] == pytest.approx(theirs, rel=TOLERANCES[name]), name
