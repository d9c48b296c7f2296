"""Published finite-element results of the 227 m/s copper bar with J2 linear hardening.

Bar of 32.4 mm and radius 3.2 mm, E 117 GPa, nu 0.35, 8930 kg/m3, yield 400 MPa, hardening 100 MPa,
frictionless anvil, 80 us; final values of several codes and the history of a fine mesh.
"""

import csv
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

DATA = Path(__file__).parent / "data"
MATERIAL = {
    "strength": "j2",
    "j2_yield_stress": 400e6,
    "j2_hardening_modulus": 100e6,
    "equation_of_state": "linear",
    "bulk_modulus": 130e9,
    "poisson_ratio": 0.35,
}


@pytest.fixture(scope="module")
def bar(solver, tmp_path_factory):
    """Time [us], length [mm] and foot radius [mm] of our run at the standard fidelity."""
    out = tmp_path_factory.mktemp("bar") / "run.h5"
    command = [solver, "run", "--velocity", "227", "--diameter-mm", "6.4", "--length-mm", "32.4"]
    command += ["--until-us", "80", "--out", out]
    for name, value in MATERIAL.items():
        command += ["--set", f"{name}={value}"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    with h5py.File(out) as file:
        names = [str(name) for name in file["history"].attrs["names"]]
        history = dict(zip(names, file["history"][:].T))
    return history["time_us"], history["length_mm"], history["foot_radius_mm"]


@pytest.fixture(scope="module")
def published():
    with open(DATA / "taylor_bar_benchmark_227_m_s_history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def test_the_final_length_and_radius_are_the_published_ones(bar, published):
    _, length, radius = bar
    assert length[-1] == pytest.approx(published["length_mm"][-1], rel=0.005)
    assert radius[-1] == pytest.approx(published["radius_mm"][-1], rel=0.015)


def test_the_history_of_length_and_radius_follows_the_published_one(bar, published):
    time, length, radius = bar
    ours = np.interp(published["time_us"], time, length)
    assert ours == pytest.approx(published["length_mm"], rel=0.005)
    ours = np.interp(published["time_us"][1:], time, radius)
    assert ours == pytest.approx(published["radius_mm"][1:], rel=0.025)
