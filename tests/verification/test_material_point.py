"""`solver point` against the stiff ODE integrator, column by column."""

from functools import lru_cache

import numpy as np
import pytest
from deformations import MOTIONS, PARAMETER_SETS, path_of, random_orientation
from dislocation_reference import reference_curve

RATES = [1e3, 1e4, 1e5]  # [1/s]
# So small that the equations are compared and not their discretisation [s].
SMALL_TIME_STEP = {1e3: 1e-8, 1e4: 1e-9, 1e5: 5e-11}
OWN_TIME_STEP = 2e-8  # of an impact at the standard fidelity [s]

CASES = [
    (motion, rate, parameters)
    for motion in MOTIONS
    for rate in RATES
    for parameters in PARAMETER_SETS
]


def path_of_case(case, time_step):
    motion, rate, parameters = case
    orientation = random_orientation(CASES.index(case))
    return path_of(motion, rate, PARAMETER_SETS[parameters], orientation, time_step)


@lru_cache(maxsize=None)
def reference_of(case):
    return reference_curve(path_of_case(case, OWN_TIME_STEP))


def largest_errors(curve, reference):
    """{column: largest difference, relative to the column's largest magnitude}.

    The six components of the stress are measured by the largest of them: which of them is
    small depends on the axes only.
    """
    scale = {column: np.max(np.abs(values)) for column, values in reference.items()}
    stress = [column for column in scale if column.startswith("stress_deviator")]
    scale.update(dict.fromkeys(stress, max(scale[column] for column in stress)))
    return {
        column: np.max(np.abs(curve[column] - reference[column])) / scale[column]
        for column in scale
    }


def check(curve, reference, tolerance):
    assert list(curve) == list(reference)
    errors = largest_errors(curve, reference)
    too_large = {column: error for column, error in errors.items() if not error < tolerance}
    assert not too_large


@pytest.mark.parametrize("case", CASES, ids=lambda case: "-".join(map(str, case)))
def test_small_steps_reproduce_the_equations(follow, case):
    path = path_of_case(case, SMALL_TIME_STEP[case[1]])
    check(follow(path), reference_of(case), 0.005)


@pytest.mark.parametrize("case", CASES, ids=lambda case: "-".join(map(str, case)))
def test_the_solvers_own_step_is_accurate(follow, case):
    check(follow(path_of_case(case, OWN_TIME_STEP)), reference_of(case), 0.02)


def test_rigid_rotation_turns_the_stress_and_nothing_else(follow):
    """An elastically strained grain keeps its stress in its own axes."""
    path = path_of("rotation", 1e4, {"initial_yield_stress": 1e9}, random_orientation(3))
    for part, strain in zip(path["segments"], (2e-4, np.pi / 2)):
        part["duration_s"] = strain / 1e4
    path["segments"][1]["velocity_gradient_per_s"] = [[0, -1e4, 0], [1e4, 0, 0], [0, 0, 0]]
    path["segments"][0]["velocity_gradient_per_s"] = [[1e4, 0, 0], [0, -5e3, 0], [0, 0, -5e3]]
    curve = follow(path)
    stretched, turned = path["segments"][0]["outputs"] - 1, -1
    along_x = curve["stress_deviator_xx_Pa"]
    along_y = curve["stress_deviator_yy_Pa"]
    assert along_y[turned] == pytest.approx(along_x[stretched], rel=1e-6)
    assert along_x[turned] == pytest.approx(along_y[stretched], rel=1e-6)
    assert curve["von_mises_Pa"][turned] == pytest.approx(
        curve["von_mises_Pa"][stretched], rel=1e-9
    )
    assert curve["equivalent_plastic_strain"][turned] < 1e-9


def test_equal_inputs_give_equal_bytes(run_point, tmp_path):
    path = path_of("shear", 1e4, {}, random_orientation(5))
    texts = []
    for _ in range(2):
        assert run_point(path).returncode == 0
        texts.append((tmp_path / "curve.csv").read_bytes())
    assert texts[0] == texts[1]


def test_copper_heats_and_hardens_as_the_linear_metal_nearly_does(follow):
    path = path_of("compression", 1e4, {}, random_orientation(6), time_step=2e-8)
    linear = follow(path)
    copper = follow({**path, "equation_of_state": "copper"})
    errors = largest_errors(copper, linear)
    assert 0 < errors["von_mises_Pa"] < 0.02
    assert errors["temperature_K"] < 0.005
