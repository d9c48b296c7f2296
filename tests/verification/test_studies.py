"""The studies' list of runs: names say what is computed, and the workflow knows them all."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification" / "studies"))

from impact_runs import arguments_of, run_name  # noqa: E402


def arguments(name):
    return arguments_of(SimpleNamespace(run=name))


def test_a_name_says_what_is_computed():
    words = arguments(run_name("3d", 6, 4, "reduced_head_3mm", 112.4, seed=7)).split()
    assert words[words.index("--geometry") + 1] == "3d"
    assert words[words.index("--shape") + 1] == "reduced_head_3mm"
    assert words[words.index("--velocity") + 1] == "112.4"
    assert words[words.index("--seed") + 1] == "7"
    assert "elements_across_radius=6" in words and "grains_per_point=4" in words


def test_a_change_scales_the_solvers_own_coefficient():
    words = arguments(run_name("axisymmetric", 12, 16, "truncated_cone", 90, 1, "hourglass0.5"))
    assert "--numerics hourglass=0.15" in words


def test_another_name_is_refused():
    with pytest.raises(ValueError, match="not the name of a run"):
        arguments("axisymmetric_n12")


@pytest.mark.parametrize("target", ["accuracy", "paper"])
def test_the_workflow_finds_every_run(solver, target):
    command = ["/usr/bin/snakemake", "--snakefile", "tests/verification/Snakefile"]
    command += ["--cores", "1", "--dry-run", "--quiet", "--forceall", target]
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
