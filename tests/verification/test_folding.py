"""Heads and cones that fold run to the stop, and their surfaces do not pass through each other.

At 125 m/s the 3-mm head collapses into a skirt that reaches the rim of the rear.
"""

import json
import subprocess

import h5py
import numpy as np
import pytest


def answer_of(solver, geometry, fidelity, *question):
    command = [solver, "run", "--json", "--geometry", geometry, "--fidelity", fidelity]
    finished = subprocess.run([*command, *question], capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)


@pytest.fixture(scope="module")
def collapsed_head(solver, tmp_path_factory):
    """The answer of a coarse 3D run, and its fields."""
    file = tmp_path_factory.mktemp("folding") / "run.h5"
    question = ["--shape", "reduced_head_3mm", "--velocity", "125", "--out", file]
    answer = answer_of(solver, "3d", "coarse", *question)
    with h5py.File(file) as run:
        return answer, {name: values[:] for name, values in run["fields"].items()}


def test_no_particle_of_the_head_is_above_the_shoulder(collapsed_head):
    fields = collapsed_head[1]
    radius = np.hypot(fields["x_mm"], fields["y_mm"])
    initial_height, height = fields["initial_z_mm"], fields["z_mm"]
    rear = initial_height > 10
    shoulder = rear & (initial_height < initial_height[rear].min() + 1e-6)
    order = np.argsort(radius[shoulder])
    above = radius[shoulder][order], height[shoulder][order]
    skirt = ~rear & (radius > above[0][0]) & (radius < above[0][-1])
    assert (skirt & (radius > 3)).sum() > 200  # twice the radius that it had
    assert np.all(height[skirt] < np.interp(radius[skirt], *above))


@pytest.mark.parametrize("geometry, fidelity", [("axisymmetric", "standard"), ("3d", "coarse")])
def test_a_cone_of_150_m_s_runs_to_the_stop(solver, geometry, fidelity):
    question = ["--shape", "truncated_cone", "--velocity", "150"]
    answer = answer_of(solver, geometry, fidelity, *question)
    assert answer["status"] == "stopped"
    assert answer["descriptors"]["energy_error"] < 0.002


def test_energy_is_balanced_while_surfaces_meet(collapsed_head):
    assert collapsed_head[0]["descriptors"]["energy_error"] < 0.002
