"""The reference integrator against closed forms, itself, and what the model's paper states."""

import numpy as np
import pytest
from deformations import PARAMETER_SETS, path_of, random_orientation, segment
from dislocation_reference import Parameters, reference_curve, schmid_tensors, slip_velocity
from scipy.spatial.transform import Rotation

STRESSES = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


def stress_tensors(curve):
    tensors = np.empty((len(curve["time_s"]), 3, 3))
    for name, (i, j) in STRESSES.items():
        tensors[:, i, j] = tensors[:, j, i] = curve[f"stress_deviator_{name}_Pa"]
    return tensors


def test_twelve_distinct_systems_of_unit_schmid_norm():
    tensors = schmid_tensors()
    assert tensors.shape == (12, 3, 3)
    products = np.einsum("dij,eij->de", tensors, tensors)
    assert np.allclose(np.diag(products), 0.5)
    assert np.allclose(np.trace(tensors, axis1=1, axis2=2), 0)
    distinct = np.abs(products - np.diag(np.diag(products))) < 0.5 - 1e-9
    assert distinct.all()


def test_slip_velocity_balances_the_drag():
    sound_speed, drag = 2200.0, 1.2e-5
    zeta = np.logspace(-12, 3, 61)
    force = sound_speed * drag * zeta
    velocity = slip_velocity(force, drag, sound_speed)
    # B V/X is (1 - V^2/ct^2)^(3/2); in this form no digits are lost as V nears ct.
    contraction = (drag * velocity / force) ** (2 / 3)
    assert contraction + (velocity / sound_speed) ** 2 == pytest.approx(1, rel=1e-9)
    assert slip_velocity(-force, drag, sound_speed) == pytest.approx(-velocity)


def test_the_result_depends_on_neither_tolerance_nor_method():
    path = path_of("shear_and_rotation", 1e5, {}, random_orientation(1))
    first = reference_curve(path)
    with np.errstate(divide="ignore"):  # SciPy divides by an error of zero
        second = reference_curve(path, tolerance=1e-8, method="Radau")
    for column, values in first.items():
        assert np.allclose(
            values, second[column], rtol=0, atol=1e-5 * np.max(np.abs(values))
        ), column


def test_below_the_threshold_the_metal_is_elastic():
    strain = 1e-4
    path = path_of("compression", 1e4, {}, random_orientation(2))
    path["segments"] = [segment(np.diag([0.5, 0.5, -1.0]), strain, 1e4, 4)]
    curve = reference_curve(path)
    G = Parameters().shear_modulus
    assert curve["stress_deviator_zz_Pa"][-1] == pytest.approx(-2 * G * strain, rel=1e-6)
    assert curve["von_mises_Pa"][-1] == pytest.approx(3 * G * strain, rel=1e-6)
    assert curve["temperature_K"][-1] == pytest.approx(300)


def test_compression_without_slip_heats_by_the_work_of_the_pressure():
    """dE = P/rho^2 drho has a closed solution where P is linear in rho and E."""
    path = path_of("compression", 1e4, {}, random_orientation(2))
    path["segments"] = [segment(-np.eye(3), 0.01, 1e4, 5)]
    curve = reference_curve(path)
    p = Parameters()
    # With s = rho0/rho: dE/ds = -K0 (1/s - 1)/rho0 - 2 E.
    s = np.exp(-3 * 0.01)
    grid = np.linspace(s, 1, 20001)
    source = p.bulk_modulus / p.initial_density * (1 / grid - 1) * np.exp(2 * grid)
    energy = np.exp(-2 * s) * np.trapz(source, grid)
    expected = p.reference_temperature + energy / p.specific_heat
    assert curve["temperature_K"][-1] == pytest.approx(expected, rel=1e-6)


def test_heat_is_the_taylor_quinney_share_of_the_plastic_work():
    path = path_of("compression", 1e4, {}, random_orientation(4))
    path["segments"] = [segment(np.diag([0.5, 0.5, -1.0]), 0.3, 1e4, 6000)]
    curve = reference_curve(path)
    stress = stress_tensors(curve)
    rate = np.diag([5e3, 5e3, -1e4])
    power = np.einsum("nij,ij->n", stress, rate)
    work = np.trapz(power, curve["time_s"])
    p = Parameters()
    stored = curve["von_mises_Pa"] ** 2 / (6 * p.shear_modulus)
    plastic_work = work - (stored[-1] - stored[0])
    rise = curve["temperature_K"][-1] - curve["temperature_K"][0]
    heat = p.initial_density * p.specific_heat * rise
    assert heat == pytest.approx(0.9 * plastic_work, rel=2e-3)


def test_turning_everything_turns_the_answer():
    turn = Rotation.from_rotvec([0.3, -1.1, 0.7])
    path = path_of("shear_and_rotation", 1e4, {}, random_orientation(8))
    w, x, y, z = path["orientation_quaternion_wxyz"]
    x, y, z, w = (turn * Rotation.from_quat([x, y, z, w])).as_quat()
    turned_path = {**path, "orientation_quaternion_wxyz": [w, x, y, z], "segments": []}
    Q = turn.as_matrix()
    for part in path["segments"]:
        gradient = Q @ np.array(part["velocity_gradient_per_s"]) @ Q.T
        turned_path["segments"].append({**part, "velocity_gradient_per_s": gradient.tolist()})
    curve, turned = reference_curve(path), reference_curve(turned_path)
    stress = stress_tensors(curve)
    largest = np.max(np.abs(stress))
    assert np.allclose(stress_tensors(turned), Q @ stress @ Q.T, rtol=0, atol=1e-5 * largest)
    for column in ("temperature_K", "mobile_density_m2", "immobile_density_m2"):
        assert turned[column] == pytest.approx(curve[column], rel=1e-5)


def test_grain_size_and_densities_are_those_of_the_paper():
    """5-6 um at a strain of 0.3 and 1e4 1/s; mobile far below immobilized densities."""
    parameters = PARAMETER_SETS["published_optimum"]
    grains, ratios = [], []
    for seed in range(5):
        curve = reference_curve(path_of("compression", 1e4, parameters, random_orientation(seed)))
        grains.append(curve["grain_diameter_m"][-1])
        ratios.append(curve["immobile_density_m2"][-1] / curve["mobile_density_m2"][-1])
    assert 5e-6 < np.mean(grains) < 6.5e-6
    assert 20 < np.mean(ratios) < 300
