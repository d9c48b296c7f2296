"""The equation of state from molecular dynamics: its committed data and network, and its parts."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from tiny_study import ROOT

from equation_of_state import checks, surface
from equation_of_state.database import learnt_rows
from equation_of_state.embedded_atoms import write_eam
from equation_of_state.isotherms import read_isotherm
from equation_of_state.models import Analytic, Dynamics, Network
from equation_of_state.properties import Rest
from equation_of_state.settings import isotherm_variables, read_settings
from equation_of_state.table import read_states
from equation_of_state.units import AtomicUnits

HOME = ROOT / "experiments" / "equation_of_state"
METAL = Rest(8930, 0)


@pytest.fixture(scope="module")
def provenance() -> dict:
    return json.loads((HOME / "provenance.json").read_text())


@pytest.fixture(scope="module")
def states(provenance):
    density = provenance["density_of_molecular_dynamics_kg_m3"]
    return read_states(HOME / "states.csv", density)


@pytest.fixture(scope="module")
def dynamics(provenance) -> Dynamics:
    return Dynamics.from_provenance(provenance)


@pytest.fixture(scope="module")
def network() -> Network:
    return Network.from_file(HOME / "network.json")


@pytest.fixture(scope="module")
def rows(dynamics, states, provenance):
    """Inputs and outputs that the committed network learnt."""
    return learnt_rows(dynamics, states, provenance["settings"]["learnt_temperatures_K"])


def test_the_surface_goes_through_the_means_of_molecular_dynamics(states):
    temperature = states["temperature_K"]
    pressure = states["pressure_Pa"] - states["smooth_pressure_Pa"]
    energy = states["energy_J_kg"] - states["smooth_energy_J_kg"]
    for isotherm in np.unique(temperature):
        here = temperature == isotherm
        # 500 atoms for half a picosecond scatter in proportion to the temperature.
        assert checks.rms(pressure[here]) < 0.3e6 * isotherm
        assert checks.rms(energy[here]) < 8 * isotherm
        assert abs(pressure[here].mean()) < 0.05e6 * isotherm
        assert abs(energy[here].mean()) < 2 * isotherm


def test_the_committed_network_is_that_of_the_committed_states(network, rows):
    inputs, outputs = rows
    error = np.stack(network.at(*inputs.T), axis=-1) - outputs
    assert checks.rms(error[:, 0]) < 30e6
    assert checks.rms(error[:, 1]) < 0.5
    assert checks.rms(error[:, 2]) < 200e6


def test_the_network_is_consistent_where_taylor_tests_are(network, rows):
    inputs, outputs = rows
    near = (np.abs(outputs[:, 0]) < 5e9) & (outputs[:, 1] > 150) & (outputs[:, 1] < 1250)
    found = checks.consistency(network, *inputs[near].T)
    assert found["modulus_rms_percent"] < 1
    assert found["gruneisen_rms"] < 0.06


def test_work_along_an_isentrope_is_that_of_molecular_dynamics(network, dynamics):
    for row in checks.isentropes(network, dynamics, METAL):
        assert abs(row["work_error_J_kg"]) < 0.01 * row["work_kJ_kg"] * 1e3
        assert abs(row["temperature_error_K"]) < 3


def test_the_network_is_near_measured_copper(network):
    here = checks.at_room(network, METAL)
    within = {"density_kg_m3": 0.001, "bulk_modulus_GPa": 0.03, "heat_capacity_J_kg_K": 0.06}
    within |= {"linear_expansion_1e-6_per_K": 0.04, "bulk_sound_speed_m_s": 0.02}
    for name, share in within.items():
        assert here[name] == pytest.approx(checks.MEASURED[name], rel=share)
    speeds = checks.hugoniot(network, METAL)
    assert speeds == pytest.approx(checks.measured_shock_speed(checks.PARTICLE_SPEEDS), rel=0.025)


@pytest.mark.parametrize("model", ["dynamics", "analytic"])
def test_exact_equations_of_state_are_consistent(model, dynamics, rows):
    found = checks.consistency({"dynamics": dynamics, "analytic": Analytic()}[model], *rows[0].T)
    assert found["modulus_largest_percent"] < 0.05
    assert found["gruneisen_largest"] < 0.01


def test_a_surface_is_found_again_from_its_own_points():
    domain = [np.log(8.5), np.log(15.0)]
    volumes = np.exp(np.linspace(*domain, 80))
    known = surface.Surface(
        Chebyshev([-3.0, 0.1, 0.4], domain),
        Chebyshev([4.5e-5, -1e-5], domain),
        Chebyshev([1e-8, 2e-9], domain),
        Chebyshev([1e-12, 2e-12], domain),
    )
    temperatures = np.repeat([100.0, 500.0, 1300.0], len(volumes))
    v = np.tile(volumes, 3)
    cold = known.pressure(volumes, 0.0)
    lattice = surface.fit_lattice(volumes, known.lattice(np.log(volumes)), cold)
    found = surface.fit_surface(
        lattice,
        v,
        temperatures,
        known.energy(v, temperatures) - known.lattice(np.log(v)),
        known.pressure(v, temperatures) - known.pressure(v, 0.0),
    )
    again = surface.from_document(surface.to_document(found))
    for name in ("pressure", "heat_capacity", "adiabatic_modulus"):
        want = getattr(known, name)(12.0, 700.0)
        assert getattr(again, name)(12.0, 700.0) == pytest.approx(want, rel=1e-6)


def adp_file(path: Path, angular: float) -> Path:
    """Two elements, two points a table."""
    numbers = ["2 1.0 2 0.5 1.0", "1 1.0 4.0 fcc", "0 1", "2 3", "2 2.0 3.6 fcc", "4 5", "6 7"]
    numbers += ["10 11", "20 21", "30 31"]  # r phi of 11, 21, 22
    numbers += ["8 8", "8 8", f"0 {angular}"] + ["9 9", "9 9", "0 0"]
    path.write_text("a potential\n\n\n2 Xx Yy\n" + "\n".join(numbers) + "\n")
    return path


def test_the_second_element_of_an_angular_potential_is_taken_out(tmp_path):
    write_eam(tmp_path / "out", adp_file(tmp_path / "in", 0), "Yy")
    lines = (tmp_path / "out").read_text().splitlines()
    assert lines[3:] == ["1 Yy", "2 1.0 2 0.5 1.0", "2 2.0 3.6 fcc", "4 5", "6 7", "30 31"]


def test_angular_terms_that_are_not_zero_are_told(tmp_path):
    with pytest.raises(ValueError, match="reach 0.25"):
        write_eam(tmp_path / "out", adp_file(tmp_path / "in", 0.25), "Yy")
    with pytest.raises(ValueError, match="no element Zz. It has: Xx, Yy"):
        write_eam(tmp_path / "out", adp_file(tmp_path / "in", 0), "Zz")


def test_a_short_isotherm_of_lammps_lies_on_the_committed_surface(dynamics, tmp_path):
    settings = read_settings(HOME / "copper.yaml")
    if shutil.which("lmp") is None or not Path(settings["potential"]).exists():
        pytest.skip("LAMMPS is not installed: .ci/setup --with eos")
    write_eam(tmp_path / "eam", Path(settings["potential"]), settings["element"])
    settings |= {"narrowest": 0.97, "widest": 1.01, "points": 4}
    files = {name: tmp_path / name for name in ("statics", "means")}
    command = ["lmp", "-suffix", "opt", "-log", "none", "-screen", "none"]
    command += isotherm_variables(settings, 700).split() + ["-var", "potential", "eam"]
    command += ["-var", "statics", "statics", "-var", "means", "means"]
    walk = ROOT / "workflow" / "scripts" / "equation_of_state" / "isotherm.lmp"
    subprocess.run([*command, "-in", walk], cwd=tmp_path, check=True, capture_output=True)
    isotherm = read_isotherm(700.0, files["statics"], files["means"])
    known, v = dynamics.surface, isotherm.volume
    off = isotherm.lattice_pressure + isotherm.thermal_pressure - known.pressure(v, 700.0)
    assert len(v) == 4
    assert np.abs(AtomicUnits.pressure(off)).max() < 0.5e9
    assert isotherm.lattice_energy == pytest.approx(known.lattice(np.log(v)), abs=1e-4)
