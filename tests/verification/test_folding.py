"""Heads and cones that fold run to the stop, and their surfaces do not pass through each other.

At 125 m/s the 3-mm head collapses into a skirt that reaches the rim of the rear.
"""

import json
import subprocess

import h5py
import numpy as np
import pytest


@pytest.fixture(scope="module")
def collapsed_head(solver, tmp_path_factory):
    """The answer of a coarse 3D run, and its fields."""
    file = tmp_path_factory.mktemp("folding") / "run.h5"
    question = ["--geometry", "3d", "--fidelity", "coarse", "--shape", "reduced_head_3mm"]
    command = [solver, "run", *question, "--velocity", "125", "--json", "--out", file]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(file) as run:
        return json.loads(finished.stdout), {name: run["fields"][name][:] for name in run["fields"]}


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
    question = ["--geometry", geometry, "--fidelity", fidelity, "--shape", "truncated_cone"]
    command = [solver, "run", *question, "--velocity", "150", "--json"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    answer = json.loads(finished.stdout)
    assert answer["status"] == "stopped"
    assert answer["descriptors"]["energy_error"] < 0.002


def test_energy_is_balanced_while_surfaces_meet(collapsed_head):
    assert collapsed_head[0]["descriptors"]["energy_error"] < 0.002
