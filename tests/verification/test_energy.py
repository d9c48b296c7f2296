"""Every joule of a fast impact is accounted for, in every shape.

Ordinary metal in 3D: tests/unit/sph/test_body.cpp; whole impacts of both: figures/energy.png.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "studies"))

from impact_runs import SHAPES  # noqa: E402


HARD = ["--set", "rho_immobile_initial=1e15", "--set", "hardening_coefficient=8"]


def descriptors(solver, *question, geometry="axisymmetric", fidelity="coarse"):
    command = [solver, "run", "--json", "--geometry", geometry, "--fidelity", fidelity]
    finished = subprocess.run([*command, *question], capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)["descriptors"]


@pytest.mark.parametrize("shape", SHAPES)
def test_energy_is_balanced_with_viscosity_and_hourglass_work(solver, shape):
    found = descriptors(solver, "--shape", shape, "--velocity", "120")
    assert found["energy_error"] < 0.0005
    # Without them there would be no balance.
    assert found["viscous_share"] > found["energy_error"]
    assert found["hourglass_share"] > 10 * found["energy_error"]


def test_energy_of_a_ringing_elastic_cylinder_is_balanced(solver):
    viscous = ["--numerics", "linear_viscosity=0.3"]  # the waves of fine rows lose little
    found = descriptors(solver, "--velocity", "60", *HARD, *viscous)
    assert found["plastic_work_J"] == 0
    # Nothing else takes what the waves have lost.
    assert found["viscous_share"] + found["hourglass_share"] > 0.03
    assert found["energy_error"] < 0.001


@pytest.mark.parametrize(
    "shape, velocity, hardening, immobilization",
    [
        ("reduced_head_3mm", 60, 5, 0.05),
        ("truncated_cone", 100, 5, 0.05),
        ("truncated_cone", 110, 9, 2),  # too narrow columns at its rim fail
    ],
)
def test_cells_that_step_less_often_do_not_resonate_with_their_neighbours(
    solver, shape, velocity, hardening, immobilization
):
    question = ["--shape", shape, "--velocity", str(velocity), "--set", "rho_immobile_initial=1e15"]
    question += ["--set", f"hardening_coefficient={hardening}"]
    question += ["--set", f"immobilization_velocity={immobilization}"]
    assert descriptors(solver, *question, fidelity="standard")["energy_error"] < 0.001


def test_a_head_of_metal_that_hardly_slips_does_not_gain_energy_in_3d(solver):
    """Its elastic strains are a tenth; stresses that the pressure scales pump its vibrations."""
    found = descriptors(
        solver, "--shape", "reduced_head_3mm", "--velocity", "90", *HARD, geometry="3d"
    )
    assert found["energy_error"] < 0.002
    assert found["largest_temperature_K"] < 500
