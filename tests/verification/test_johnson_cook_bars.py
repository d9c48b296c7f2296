"""Taylor bars with Johnson-Cook strength against published final sizes.

Copper bars of Johnson and Cook 1983 at 130, 146 and 190 m/s, with the constants they fitted: their
own computed lengths, and the measured ones. A 42CrMo4 steel bar at 287 m/s by two finite-element
codes with five cells across the radius; our coarse setting has five as well, the standard eight.
"""

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

VERIFICATION = Path(__file__).parent
sys.path.insert(0, str(VERIFICATION / "studies"))

from bar_runs import bar_words  # noqa: E402

COPPER_RUNS = [(130, "coarse"), (146, "coarse"), (190, "coarse"), (190, "standard")]


def rows_of(name):
    with open(VERIFICATION / "data" / name, newline="") as file:
        return list(csv.DictReader(file))


def published(bar, velocity, kind, size):
    """Values of a size by all who published one."""
    return [
        float(row[size])
        for row in rows_of("taylor_bars_johnson_cook.csv")
        if (row["bar"], row["velocity_m_s"], row["kind"]) == (bar, str(velocity), kind)
    ]


@pytest.fixture(scope="module")
def shoot(solver):
    """The answer of a bar's run; each is computed once."""
    known = {}

    def answer(bar, velocity, fidelity):
        words = bar_words(bar, velocity, "axisymmetric", fidelity)
        if words not in known:
            command = [solver, "run", "--json", *words.split()]
            finished = subprocess.run(command, capture_output=True, text=True)
            assert finished.returncode == 0, finished.stderr
            known[words] = json.loads(finished.stdout)
        return known[words]

    return answer


@pytest.mark.parametrize("velocity, fidelity", COPPER_RUNS)
def test_copper_bars_have_the_lengths_that_johnson_and_cook_computed(shoot, velocity, fidelity):
    length = shoot("ofhc_copper", velocity, fidelity)["sizes"]["final_length_mm"]
    [theirs] = published("ofhc_copper", velocity, "computed", "final_length_mm")
    assert length == pytest.approx(theirs, rel=0.01)


@pytest.mark.parametrize("velocity, fidelity", COPPER_RUNS)
def test_copper_bars_stay_longer_than_the_measured_as_they_did(shoot, velocity, fidelity):
    # Their constants make the metal too strong in this test: by 5 to 6 % of the length.
    length = shoot("ofhc_copper", velocity, fidelity)["sizes"]["final_length_mm"]
    [measured] = published("ofhc_copper", velocity, "measured", "final_length_mm")
    assert 0.05 < length / measured - 1 < 0.075


@pytest.mark.parametrize(
    "fidelity, length, diameter", [("coarse", 3e-3, 0.015), ("standard", 5e-3, 0.02)]
)
def test_the_steel_bar_has_the_sizes_of_two_finite_element_codes(shoot, fidelity, length, diameter):
    sizes = shoot("steel_42CrMo4", 287, fidelity)["sizes"]
    theirs = np.array(published("steel_42CrMo4", 287, "computed", "final_length_mm"))
    assert sizes["final_length_mm"] == pytest.approx(theirs, rel=length)
    theirs = np.array(published("steel_42CrMo4", 287, "computed", "impact_diameter_mm"))
    assert sizes["impact_diameter_mm"] == pytest.approx(theirs, rel=diameter)


def test_the_steel_bar_heats_as_theirs(shoot):
    descriptors = shoot("steel_42CrMo4", 287, "coarse")["descriptors"]
    for name in ["largest_temperature_K", "largest_plastic_strain"]:
        theirs = np.array(published("steel_42CrMo4", 287, "computed", name))
        assert descriptors[name] == pytest.approx(theirs, rel=0.08)
