"""Twice the cells across the radius, or more than three times the particles, and the same sizes.

The bar of the published benchmark, shorter for particles; J2, so that grains play no part.
"""

import json
import subprocess

import pytest
from test_taylor_bar import MATERIAL

CASES = {  # geometry: elements across the radius, length [mm], time [us]
    "axisymmetric": ((5, 10), 32.4, 80),
    "3d": ((6, 9), 12.8, 30),
}
TOLERANCES = {
    "final_length_mm": 0.005,
    "undeformed_length_mm": 0.03,
    "impact_diameter_mm": 0.025,
    "transition_diameter_mm": 0.02,
    "diameter_at_0p2L0_mm": 0.01,
}


def sizes_of(solver, geometry, elements, length, until):
    command = [solver, "run", "--json", "--velocity", "227", "--diameter-mm", "6.4"]
    command += ["--length-mm", str(length), "--until-us", str(until), "--geometry", geometry]
    command += ["--numerics", f"elements_across_radius={elements}"]
    command += ["--numerics", "grains_per_point=1"]
    for name, value in MATERIAL.items():
        command += ["--set", f"{name}={value}"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)["sizes"]


@pytest.mark.parametrize("geometry", CASES)
def test_a_finer_body_has_the_same_sizes(solver, geometry):
    elements, *shot = CASES[geometry]
    coarse, fine = (sizes_of(solver, geometry, count, *shot) for count in elements)
    for size, tolerance in TOLERANCES.items():
        assert coarse[size] == pytest.approx(fine[size], rel=tolerance), size
