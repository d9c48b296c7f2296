"""Costs of runs fitted to what was computed."""

import json

import h5py
import numpy as np
import pytest
from tiny_study import ROOT

from cost.model import run_costs
from database_costs import read_costs
from fit_run_costs import fits, main

RUNS = 400


def database(path, fidelity, velocity, cpu_s):
    with h5py.File(path, "w") as file:
        configuration = {"geometry": "axisymmetric", "fidelity": fidelity}
        file.attrs["provenance"] = json.dumps({"configuration": configuration})
        file["run_id"] = np.arange(len(velocity))
        file["shape"] = ["truncated_cone"] * len(velocity)
        file["inputs"] = np.column_stack([velocity, np.arange(len(velocity))])
        file["inputs"].attrs["names"] = ["velocity_m_s", "hardening_coefficient"]
    lines = [f"{run},{seconds}" for run, seconds in enumerate(cpu_s)]
    path.with_name(path.name + ".cost.csv").write_text("\n".join(["run_id,cpu_s", *lines]) + "\n")
    return path


@pytest.fixture
def databases(tmp_path):
    """Many coarse runs of a known law, and three of them finer, which cost nine times as much."""
    source = np.random.default_rng(3)
    velocity = source.uniform(20, 200, RUNS)
    cpu_s = 2 * (velocity / 100) ** 0.6 * np.exp(0.5 * source.standard_normal(RUNS))
    return [
        database(tmp_path / "coarse.h5", "coarse", velocity, cpu_s),
        database(tmp_path / "fine.h5", "fine", velocity[:3], 9 * cpu_s[:3]),
    ]


def test_many_runs_tell_their_law_and_a_few_the_ratio(databases):
    found = fits(databases)
    coarse, fine = (found["axisymmetric", name, "truncated_cone"] for name in ("coarse", "fine"))
    assert coarse.runs == RUNS and fine.runs == 3
    assert coarse.median_s == pytest.approx(2, rel=0.1)
    assert (coarse.exponent, coarse.spread) == pytest.approx((0.6, 0.5), abs=0.1)
    assert fine.median_s == pytest.approx(9 * coarse.median_s, rel=1e-6)
    assert (fine.exponent, fine.spread) == (coarse.exponent, coarse.spread)


def test_few_runs_are_compared_with_the_kind_that_has_their_impacts(databases, tmp_path):
    velocity = np.linspace(20, 200, 2 * RUNS)
    more = database(tmp_path / "standard.h5", "standard", velocity, 5 + 0 * velocity)
    fine = "axisymmetric", "fine", "truncated_cone"
    assert fits([*databases, more])[fine] == fits(databases)[fine]


def test_runs_of_unknown_cost_do_not_count(databases):
    known = fits(databases)
    costs = databases[0].with_name("coarse.h5.cost.csv")
    lines = costs.read_text().splitlines()
    lines[-1] = f"{RUNS - 1},"
    costs.write_text("\n".join(lines) + "\n")
    for name, fewer in (("coarse", 1), ("fine", 0)):
        kind = "axisymmetric", name, "truncated_cone"
        assert fits(databases)[kind].runs == known[kind].runs - fewer
    assert read_costs(databases[0]).keys() == set(range(RUNS - 1))


def test_few_runs_without_their_like_are_an_error(databases, tmp_path):
    lone = database(tmp_path / "lone.h5", "standard", np.array([77.0]), [1.0])
    with pytest.raises(SystemExit, match="axisymmetric standard truncated_cone: 1 runs, and no"):
        fits([*databases, lone])


def test_what_is_printed_is_what_the_estimate_reads(databases, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["fit_run_costs.py", *map(str, databases)])
    main()
    table = tmp_path / "run_costs.csv"
    table.write_text(capsys.readouterr().out)
    assert run_costs(table)["axisymmetric", "fine", "truncated_cone"].runs == 3
    with (ROOT / "workflow" / "run_costs.csv").open() as committed, table.open() as made:
        assert committed.readline() == made.readline()
