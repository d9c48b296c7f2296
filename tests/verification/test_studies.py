"""The studies' list of runs: names say what is computed, and the workflow knows them all."""

import json
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np
import pandas as pd
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification" / "studies"))

import convergence  # noqa: E402
import dissipation  # noqa: E402
import sample  # noqa: E402
import two_geometries  # noqa: E402
import two_solvers  # noqa: E402
from impact_runs import SHAPES, SIZES, arguments_of, run_name  # noqa: E402
from paper_calibration import level_that_holds, rate_of  # noqa: E402
from paper_settings import plain_settings  # noqa: E402
from twin_tables import LOOKED_AT, TWINS, truths, twin_designs  # noqa: E402
from twins import correlation_words, judged  # noqa: E402
from sample_runs import command_of, sample_design  # noqa: E402


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
    assert "--numerics hourglass=0.05" in words


def test_another_name_is_refused():
    with pytest.raises(ValueError, match="not the name of a run"):
        arguments("axisymmetric_n12")


def test_coarse_cells_are_cut_as_the_coarse_setting_cuts_them():
    assert "--fidelity coarse" in arguments(run_name("axisymmetric", 5, 8, "truncated_cone", 90))
    assert "--fidelity fine" in arguments(run_name("axisymmetric", 8, 16, "truncated_cone", 90))
    assert "--fidelity fine" in arguments(run_name("3d", 4, 1, "truncated_cone", 90))


def test_convergence_takes_means_over_seeds_and_deviates_from_the_finest_cells():
    def answer(length):
        sizes = dict.fromkeys(SIZES, 10.0) | {"final_length_mm": length}
        return {"sizes": sizes, "points": 100, "steps": 9, "cpu_s": 2.0, "status": "stopped"}

    def row(geometry, elements, *lengths):
        case = {"geometry": geometry, "elements": elements, "shape": "cone", "velocity_m_s": 90}
        return case | convergence.mean_row([answer(length) for length in lengths])

    rows = [row("axisymmetric", 8, 30, 32), row("axisymmetric", 16, 20, 20), row("3d", 40, 22)]
    table = convergence.add_deviations(pd.DataFrame(rows))
    assert table["final_length_mm"].tolist() == [31, 20, 22]
    assert table["final_length_mm_deviation_percent"].tolist() == pytest.approx([55, 0, 10])
    assert table["final_length_mm_scatter_percent"][0] == pytest.approx(100 * 2**0.5 / 31)
    assert table["impact_diameter_mm_deviation_percent"].tolist() == [0, 0, 0]


def test_the_limit_is_that_of_a_line_in_the_width_of_refined_cells():
    def row(elements, scatter_percent):
        sizes = dict.fromkeys(SIZES, 30 + 8 / elements)
        scatter = {f"{size}_scatter_percent": scatter_percent for size in SIZES}
        case = {"geometry": "axisymmetric", "grains": 16, "shape": "cone", "velocity_m_s": 90}
        return case | {"elements": elements, "seeds": 4} | sizes | scatter

    coarse = row(5, 0) | {"final_length_mm": 50}  # cut in another way: it does not count
    table = convergence.add_limits(pd.DataFrame([coarse, row(8, 0.1), row(16, 0.1)]))
    limit = table[table["geometry"] == "extrapolated"].iloc[0]
    assert limit["final_length_mm"] == pytest.approx(30)
    # Twice the finest less the other; the mean of four seeds has half of their scatter.
    error = np.sqrt((2**2 + 1) * (30.5**2 + 31**2) / 2) * 0.1 / 2
    assert limit["final_length_mm_scatter_percent"] == pytest.approx(error / 30)
    deviations = convergence.add_deviations(table)["final_length_mm_deviation_percent"]
    assert deviations.iloc[-1] == pytest.approx(100 * (30 / 30.5 - 1))
    from_limit = convergence.from_extrapolated(table)["final_length_mm"]
    assert from_limit["cone", 90, 8] == pytest.approx(100 * (31 / 30 - 1))


def test_particles_are_compared_with_the_finest_cells_by_their_means():
    def row(case, geometry, grains, elements, length, scatter_percent, seeds):
        sizes = dict.fromkeys(SIZES, 10.0) | {"final_length_mm": length}
        scatter = {f"{size}_scatter_percent": scatter_percent for size in SIZES}
        kind = {"geometry": geometry, "grains": grains, "elements": elements, "seeds": seeds}
        return dict(zip(["shape", "velocity_m_s"], case)) | kind | sizes | scatter | {"cpu_s": 1}

    rows = []
    for case in two_geometries.CASES:
        rows.append(row(case, "axisymmetric", 16, 8, 50, 0, 6))
        rows.append(row(case, "axisymmetric", 16, 16, 30, 0.6, 4))
        rows.append(row(case, "3d", 1, 9, 40, 0, 1))
        rows.append(row(case, "3d", 4, 6, 30.6, 0.8, 4))
        rows.append(row(case, "3d", 4, 9, 30.3, 0.8, 4))
    deviations = two_geometries.deviations(convergence.add_deviations(pd.DataFrame(rows)))
    lengths = deviations[deviations["size"] == "final_length_mm"].set_index("particles")
    assert len(lengths) == 2 * len(two_geometries.CASES)
    assert lengths.loc["standard", "deviation_percent"].to_list() == pytest.approx([2] * 12)
    assert lengths.loc["fine", "deviation_percent"].to_list() == pytest.approx([1] * 12)
    error = np.hypot(0.3, 0.4)  # half of the scatter of each
    assert lengths.loc["fine", "standard_error_percent"].to_list() == pytest.approx([error] * 12)


def test_halving_compares_each_seed_with_itself():
    def answers(*lengths):
        return [{"sizes": dict.fromkeys(SIZES, 8.0) | {"final_length_mm": x}} for x in lengths]

    row = dissipation.halving(answers(20, 40), answers(20.2, 41.2))  # 1 and 3 %
    assert row["final_length_mm_change_percent"] == pytest.approx(2)
    assert row["final_length_mm_standard_error_percent"] == pytest.approx(1)
    assert row["head_length_mm_change_percent"] == 0


@pytest.mark.parametrize("target", ["accuracy", "paper"])
def test_the_workflow_finds_every_run(solver, target):
    command = ["/usr/bin/snakemake", "--snakefile", "tests/verification/Snakefile"]
    command += ["--cores", "1", "--dry-run", "--quiet", "--forceall", target]
    finished = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr


def test_the_sample_takes_the_shapes_in_turn_over_the_whole_ranges():
    columns = sample_design(64)
    assert columns["shape"] == SHAPES * 16
    inputs = pd.DataFrame(columns["inputs"], columns=columns["names"])
    assert (inputs["velocity_m_s"].min(), inputs["velocity_m_s"].max()) == (10, 150)
    density = inputs["rho_immobile_initial"]
    assert (density.min(), density.max()) == pytest.approx((1e10, 1e15))
    assert 2e12 < density.median() < 5e12


def sampled_run(shape, status, reason="", energy_error=1e-4):
    return {
        "run_id": 7,
        "seed": 42,
        "shape": shape,
        "velocity_m_s": 101.25,
        "rho_immobile_initial": 6.3e12,
        "hardening_coefficient": 2.8,
        "immobilization_velocity": 0.4,
        "status": status,
        "reason": reason,
        "energy_error": energy_error,
        "cpu_s": 2.0,
    }


def test_the_sample_counts_what_was_lost_by_its_kind():
    steps = ["32512 steps were not enough (119.2 us reached)"]
    steps += ["93952 steps were not enough (78.1 us reached)"]
    folded = "a cell folded over at r = 0.100 mm, z = 1.000 mm after 12.00 us"
    runs = [sampled_run("truncated_cone", "not_stopped", reason, 0.5) for reason in steps]
    runs += [sampled_run("truncated_cone", "failed", folded, 0.5)]
    runs += [sampled_run("uniform_cylinder", "stopped", energy_error=3e-3)]
    table = sample.summarise(pd.DataFrame(runs)).set_index("shape")
    assert table.loc["truncated_cone", sample.STATUSES].tolist() == [0, 2, 1, 0]
    assert table.loc["truncated_cone", "reasons"] == (
        "2 x n steps were not enough; 1 x a cell folded over"
    )
    # Of the runs that count only.
    assert table.loc["all", "largest_energy_error"] == 3e-3
    assert table.loc["all", "cpu_s"] == 8


def test_a_lost_run_comes_with_the_command_that_computes_it_again(solver):
    command = command_of(sampled_run("reduced_head_4mm", "failed"), "coarse").split()
    assert command[:2] == ["solver", "run"]
    words = [solver, *command[1:], "--until-us", "1", "--json"]
    finished = subprocess.run(words, capture_output=True, text=True)
    assert finished.returncode == 0, finished.stderr
    question = json.loads(finished.stdout)["question"]
    assert question["shape"] == "reduced_head_4mm"
    assert (question["seed"], question["velocity_m_s"]) == (42, 101.25)
    assert question["configuration"]["material"]["hardening_coefficient"] == 2.8


def test_plain_draws_are_as_many_as_asked_for():
    asked = plain_settings({"seed": 3, "draws": 60000}, float("1e7"))
    plain = {"draws_from": "prior", "network_errors": "independent"}
    assert asked == {"seed": 3, "draws": 10_000_000, **plain}
    with pytest.raises(ValueError, match="at least 1e5"):
        plain_settings({}, 1e3)


def test_the_line_of_a_map_holds_the_share_of_it():
    x = np.linspace(-5, 5, 201)
    density = np.exp(-(x[:, None] ** 2 + x[None, :] ** 2) / 2)
    level = level_that_holds(density, 0.95)
    assert level == pytest.approx(0.05, rel=0.03)  # of a normal map in two dimensions


def test_the_rate_is_read_from_what_the_program_says():
    told = "info: 1e+08 plain draws in 14.2 s, 3.53e+06 a second and thread, 1.20 of 42 rows each"
    assert rate_of(told) == (1e8, 3.53e6)


def test_rows_of_a_database_keep_their_names_and_cost(tmp_path):
    path = tmp_path / "all.h5"
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "taylorcal/database/1"
        file["run_id"] = [5, 6, 7]
        file["inputs"] = [[1.0], [2.0], [3.0]]
        file["inputs"].attrs["names"] = ["velocity_m_s"]
    (tmp_path / "all.h5.cost.csv").write_text("run_id,cpu_s\n5,1.5\n6,2.0\n7,4.0\n")
    two_solvers.write_rows(path, np.array([0, 2]), tmp_path / "part.h5")
    with h5py.File(tmp_path / "part.h5") as file:
        assert list(file["run_id"][:]) == [5, 7]
        assert list(file["inputs"].attrs["names"]) == ["velocity_m_s"]
        assert file.attrs["schema"] == "taylorcal/database/1"
    assert two_solvers.cpu_seconds(path, np.array([0, 2])) == 5.5


PRIORS = {
    "rho_immobile_initial": {"lower": 1e10, "upper": 1e15, "prior": "log_uniform"},
    "hardening_coefficient": {"lower": 0, "upper": 10, "prior": "uniform"},
}


def test_twins_are_metals_spread_over_the_prior():
    metals = truths(PRIORS)
    assert len(metals) == TWINS
    for part in (metals[:LOOKED_AT], metals[LOOKED_AT:]):
        places = sorted(np.log10(metal["rho_immobile_initial"]) - 10 for metal in part)
        assert [int(place / 5 * len(part)) for place in places] == list(range(len(part)))
        places = sorted(metal["hardening_coefficient"] for metal in part)
        assert [int(place / 10 * len(part)) for place in places] == list(range(len(part)))
    first, second = twin_designs(PRIORS)[:2]
    assert set(first["run_id"]).isdisjoint(second["run_id"])
    assert set(first["seed"]).isdisjoint(second["seed"])


def test_a_truth_is_judged_by_where_it_lies_among_the_draws():
    draws = np.linspace(0, 1, 1001)
    inside = judged(draws, 0.3)
    assert inside["below"] == pytest.approx(0.3, abs=1e-3)
    assert inside["inside_0.5"] and inside["inside_0.95"]
    tail = judged(draws, 0.05)
    assert not tail["inside_0.5"] and tail["inside_0.95"]
    assert not judged(draws, 0.98)["inside_0.95"]


def test_the_twins_tell_how_errors_belong_together():
    random = np.random.default_rng(4)
    twins, shapes, places, sizes = LOOKED_AT, 4, 10, 5
    common = random.normal(size=(twins, 1, places + 1, sizes))
    own = random.normal(size=(twins, shapes, places + 1, sizes))
    mixed = 0.5 * common + np.sqrt(0.75) * own  # a quarter in common between shapes
    errors = mixed[:, :, :-1] + mixed[:, :, 1:]  # half in common with the next place
    told = correlation_words(errors)
    lags, between = re.search(r": ([\d., -]+); between shapes ([\d.-]+)", told).groups()
    first, second, third = [float(value) for value in lags.split(", ")][:3]
    assert first == 1 and second == pytest.approx(0.5, abs=0.06)
    assert abs(third) < 0.1 and float(between) == pytest.approx(0.25, abs=0.06)
