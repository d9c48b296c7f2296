"""`solver plate` against a measured free-surface velocity (Thomas et al. 2016)."""

import csv
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).parent
PLATE = json.loads((HERE / "plates" / "copper_308_m_s.json").read_text())
PULL_BACK_US = 1.8  # from here on the measured plate has spalled


def read_columns(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {
        name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "origin"
    }


@pytest.fixture(scope="module")
def measured():
    return read_columns(HERE / "data" / "flyer_plate_copper_308_m_s.csv")


@pytest.fixture(scope="module")
def shoot(solver, tmp_path_factory):
    """Free-surface velocity (columns as arrays) of PLATE with other values."""

    def run(**changes):
        folder = tmp_path_factory.mktemp("plate")
        document = {**PLATE, "cell_um": 10, "duration_us": PULL_BACK_US, **changes}
        (folder / "plate.json").write_text(json.dumps(document))
        command = [solver, "plate", folder / "plate.json", "--out", folder / "velocity.csv"]
        finished = subprocess.run(command, capture_output=True, text=True)
        assert finished.returncode == 0, finished.stderr
        return read_columns(folder / "velocity.csv")

    return run


@pytest.fixture(scope="module")
def annealed(shoot):
    return shoot()


def time_of(velocity, times, velocities):
    return times[np.argmax(velocities >= velocity)]


def plateau(times, velocities):
    return velocities[(times > 1.15) & (times < 1.45)].mean()


@pytest.mark.parametrize("velocity", [50, 150, 250])
def test_the_shock_arrives_when_it_did(annealed, measured, velocity):
    ours = time_of(velocity, annealed["time_us"], annealed["free_surface_velocity_m_s"])
    theirs = time_of(velocity, measured["time_us"], measured["ufs_m_s"])
    assert ours == pytest.approx(theirs, rel=0.02)


def test_the_plateau_is_as_high(annealed, measured):
    ours = plateau(annealed["time_us"], annealed["free_surface_velocity_m_s"])
    theirs = plateau(measured["time_us"], measured["ufs_m_s"])
    assert ours == pytest.approx(theirs, rel=0.02)


@pytest.mark.parametrize("velocity", [290, 260])
def test_the_release_follows_until_the_plate_spalls(annealed, measured, velocity):
    def falls(times, velocities):
        late = (times > 1.5) & (times < PULL_BACK_US)
        return times[late][np.argmax(velocities[late] <= velocity)]

    ours = falls(annealed["time_us"], annealed["free_surface_velocity_m_s"])
    assert ours == pytest.approx(falls(measured["time_us"], measured["ufs_m_s"]), rel=0.03)


def test_more_dislocations_overestimate_precursor_and_release(shoot, annealed, measured):
    """As the source paper found with its optimum's density."""
    hard = shoot(material={"rho_immobile_initial": 6.3e12})

    def precursor(velocities):
        return np.interp(0.87, velocities["time_us"], velocities["free_surface_velocity_m_s"])

    seen = np.interp(0.87, measured["time_us"], measured["ufs_m_s"])
    assert precursor(annealed) == pytest.approx(seen, abs=3)
    assert precursor(hard) > 3 * seen
    late = 1.58  # [us]
    released = np.interp(late, hard["time_us"], hard["free_surface_velocity_m_s"])
    assert released < np.interp(late, measured["time_us"], measured["ufs_m_s"]) - 20


@pytest.mark.parametrize(
    "change, expected",
    [
        ({"velocity_m_s": -308}, "velocity_m_s = -308"),
        ({"cel_um": 5}, 'Is "cell_um"'),
        ({"cell_um": 0.001}, "Choose larger cells"),
        ({"material": {"strengh": "j2"}}, "material.strengh"),
    ],
)
def test_a_broken_plate_is_refused_at_its_key(solver, tmp_path, change, expected):
    (tmp_path / "plate.json").write_text(json.dumps({**PLATE, **change}))
    command = [solver, "plate", tmp_path / "plate.json", "--out", tmp_path / "velocity.csv"]
    finished = subprocess.run(command, capture_output=True, text=True)
    assert finished.returncode == 1
    assert "plate.json" in finished.stderr and expected in finished.stderr
    assert not (tmp_path / "velocity.csv").exists()
