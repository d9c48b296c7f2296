"""What `solver point` says to a path that cannot work: the place, the value, the remedy."""

import shlex
import subprocess
from pathlib import Path

import pytest
from deformations import path_of

ROOT = Path(__file__).parents[2]


def path():
    return path_of("compression", 1e4, {}, [1, 0, 0, 0], time_step=1e-7)


def with_segment(**changes):
    changed = path()
    changed["segments"][0].update(changes)
    return changed


def without(key):
    return {name: value for name, value in path().items() if name != key}


BROKEN = {
    "unknown key": ({**path(), "time_step": 1e-9}, ["time_step", "time_step_s"]),
    "unknown parameter": (
        {**path(), "parameters": {"hardening_coeficient": 1}},
        ["hardening_coeficient", "hardening_coefficient"],
    ),
    "parameter as a text": (
        {**path(), "parameters": {"hardening_coefficient": "2.8"}},
        ["parameters.hardening_coefficient", "a number"],
    ),
    "parameter out of range": (
        {**path(), "parameters": {"poisson_ratio": 0.7}},
        ["poisson_ratio", "0.7"],
    ),
    "melting below the reference": (
        {
            **path(),
            "strength": "johnson_cook",
            "parameters": {"jc_melting_temperature": 500, "reference_temperature": 500},
        },
        ["jc_melting_temperature = 500 K", "reference_temperature = 500 K", "Raise"],
    ),
    "unknown equation of state": (
        {**path(), "equation_of_state": "linaer"},
        ["equation_of_state", "linaer", '"linear"'],
    ),
    "negative step": ({**path(), "time_step_s": -1e-9}, ["time_step_s", "positive"]),
    "missing step": (without("time_step_s"), ["time_step_s", "missing"]),
    "step in other units": ({**path(), "time_step_s": 1e-20}, ["time_step_s", "larger step"]),
    "missing orientation": (
        without("orientation_quaternion_wxyz"),
        ["orientation_quaternion_wxyz", "missing"],
    ),
    "orientation of three numbers": (
        {**path(), "orientation_quaternion_wxyz": [1, 0, 0]},
        ["orientation_quaternion_wxyz", "four"],
    ),
    "orientation that is no rotation": (
        {**path(), "orientation_quaternion_wxyz": [1, 1, 0, 0]},
        ["orientation_quaternion_wxyz", "norm"],
    ),
    "no segment": ({**path(), "segments": []}, ["segments", "empty"]),
    "flat gradient": (
        with_segment(velocity_gradient_per_s=[1, 0, 0, 0, 1, 0, 0, 0, 1]),
        ["segments[0].velocity_gradient_per_s", "3 x 3"],
    ),
    "ragged gradient": (
        with_segment(velocity_gradient_per_s=[[1, 0, 0], [0, 1], [0, 0, 1]]),
        ["segments[0].velocity_gradient_per_s", "3 x 3"],
    ),
    "gradient in other units": (
        with_segment(velocity_gradient_per_us=[[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
        ["velocity_gradient_per_us"],
    ),
    "no time": (with_segment(duration_s=0), ["segments[0].duration_s", "positive"]),
    "no outputs": (with_segment(outputs=0), ["segments[0].outputs", "expected 1"]),
    "half an output": (with_segment(outputs=2.5), ["segments[0].outputs", "whole number"]),
    "not JSON": ('{"time_step_s": }', ["line 1", "not valid JSON"]),
}


@pytest.mark.parametrize("broken, words", BROKEN.values(), ids=BROKEN)
def test_a_broken_path_is_refused(run_point, tmp_path, broken, words):
    finished = run_point(broken)
    assert finished.returncode == 1
    assert "path.json" in finished.stderr
    for word in words:
        assert word in finished.stderr
    assert not (tmp_path / "curve.csv").exists()


def test_a_missing_file_is_named(solver, tmp_path):
    finished = subprocess.run(
        [solver, "point", tmp_path / "none.json", "--out", tmp_path / "curve.csv"],
        capture_output=True,
        text=True,
    )
    assert finished.returncode == 1
    assert "none.json" in finished.stderr


def test_a_grain_torn_apart_is_a_numerical_failure(run_point, tmp_path):
    finished = run_point(with_segment(velocity_gradient_per_s=[[1e12, 0, 0]] * 3))
    assert finished.returncode == 2
    assert "not finite" in finished.stderr
    assert not (tmp_path / "curve.csv").exists()


def test_the_sample_run_of_the_help_works(solver, tmp_path):
    shown = subprocess.run([solver, "point", "--help"], capture_output=True, text=True).stdout
    example = [line for line in shown.splitlines() if "Example:" in line][0]
    command = shlex.split(example.split("Example:")[1])
    command[0] = solver
    command[command.index("--out") + 1] = tmp_path / "curve.csv"
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    assert len((tmp_path / "curve.csv").read_text().splitlines()) == 61
