"""`taylorcal cost`: what a study costs before it starts."""

import subprocess
import sys

import pytest
from tiny_study import STUDY, STUDY_YAML, write_study

from cost.model import RunCost, StudyCost, run_costs, study_cost
from cost.schedule import makespan, schedule
from cost.words import CORES, duration
from study import read_study


def test_costs_rise_with_the_velocity_and_spread_about_the_median():
    cost = RunCost(runs=9, median_s=2, exponent=0.5, spread=0.7)
    assert cost.seconds(100, 0.5) == pytest.approx(2)
    assert cost.seconds(400, 0.5) == pytest.approx(4)
    assert cost.seconds(100, 0.9) > 2 > cost.seconds(100, 0.1)


def test_every_shape_has_a_cost_at_the_usual_settings():
    shapes = {"uniform_cylinder", "reduced_head_4mm", "reduced_head_3mm", "truncated_cone"}
    for geometry, fidelity in [
        ("axisymmetric", "coarse"),
        ("axisymmetric", "standard"),
        ("axisymmetric", "fine"),
        ("3d", "coarse"),
        ("3d", "standard"),
    ]:
        assert shapes == {s for g, f, s in run_costs() if (g, f) == (geometry, fidelity)}


def test_a_schedule_is_bounded_by_work_and_by_the_longest_run():
    assert makespan([3, 1, 1, 1], 2) == 3
    assert makespan([1, 1, 1, 3], 2) == 4  # the long one comes last
    cost = StudyCost([1.0 + run % 7 for run in range(4000)], [], [60.0] * 4, 30, 100)
    plans = [schedule(cost, cores, 8) for cores in CORES]
    assert all(later.wall_s <= before.wall_s for before, later in zip(plans, plans[1:]))
    for plan in plans:
        assert plan.runs_s >= max(cost.runs_s)
        assert plan.runs_s * plan.cores >= sum(cost.runs_s)
        assert 0 < plan.used <= 1
        assert plan.chunks >= min(plan.cores // 16, len(cost.runs_s))


def test_the_estimate_of_a_study_is_near_what_it_cost(finished, tiny_study):
    """24 runs: their spread allows a factor of two either way."""
    lines = (finished.results / "database.h5.cost.csv").read_text().splitlines()[1:]
    measured = sum(float(line.split(",")[1]) for line in lines)
    assert 0.4 < sum(study_cost(tiny_study).runs_s) / measured < 2.5


def test_taylorcal_prints_the_table(fresh):
    command = [sys.executable, "workflow/taylorcal", "cost", STUDY]
    done = subprocess.run(command, cwd=fresh.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "24 runs, axisymmetric, coarse" in done.stdout
    rows = [line.split() for line in done.stdout.splitlines() if line.strip()[:1].isdigit()]
    assert [int(row[0]) for row in rows[-len(CORES) :]] == CORES


@pytest.mark.parametrize("options", [["--dry-run"], ["-n"], ["--dry-run", "--quiet", "rules"]])
def test_a_dry_run_of_snakemake_ends_with_the_estimate(fresh, options):
    told = fresh.run(*options).stdout
    assert "rule sample" in told or "--quiet" in options
    assert told.strip().splitlines()[-1].startswith("`chunks`")
    assert f"{STUDY}: about" in told and "24 runs, axisymmetric, coarse" in told


def test_a_run_of_snakemake_prints_no_estimate(fresh):
    told = fresh.run(f"results/{STUDY}/design.h5")
    assert told.returncode == 0 and "core-hours" not in told.stdout


def test_taylorcal_prints_it_in_its_dry_run(fresh):
    command = [sys.executable, "workflow/taylorcal", "calibrate", STUDY, "--dry-run"]
    done = subprocess.run(command, cwd=fresh.folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(f"{STUDY}: about") == 1


def test_further_parts_are_counted(tmp_path):
    further = "  chunks: 2\n  further: [{ shapes: [truncated_cone], runs: 12 }]\n"
    text = STUDY_YAML.replace("  chunks: 2\n", further)
    cost = study_cost(read_study(write_study(tmp_path / STUDY, text) / "study.yaml"))
    assert cost.shapes == ["uniform_cylinder"] * 24 + ["truncated_cone"] * 12


def test_durations_read_well():
    assert [duration(s) for s in (20, 1200, 36000)] == ["20 s", "20 min", "10.0 h"]
