"""Signature runs are pairs that differ in one candidate alone."""

import numpy as np
import pytest
from stub_lists import EFFECTS, PARAMETERS
from tiny_study import NEW_ROW, TABLE

from candidates import candidates, typical_amplitudes
from input_errors import InputError
from make_signature_design import base_rows, points, shapes_in_use, signature_design
from measurements import read_measurements
from study import at_revision

NAMES = ["rho_immobile_initial", "hardening_coefficient"]


@pytest.fixture
def rows(tmp_path):
    table = tmp_path / "measurements.csv"
    cone = NEW_ROW.replace("b2", "c1").replace("uniform_cylinder", "truncated_cone")
    table.write_text(TABLE + NEW_ROW + cone)
    return read_measurements(table)


@pytest.fixture
def draws():
    count = np.arange(400.0)
    first, second = "rho_immobile_initial[first]", "rho_immobile_initial[second]"
    return {"hardening_coefficient": 2 + count / 1000, first: 1e12 + count, second: 1e13 + count}


@pytest.fixture
def made(tiny_study, rows, draws):
    settings = {
        "points_per_shape": 8,
        "seed": 1,
        "candidates": candidates(tiny_study, EFFECTS, PARAMETERS),
        "typical": typical_amplitudes(tiny_study, EFFECTS),
    }
    return signature_design(rows, draws, NAMES, settings)


def test_candidates_are_effects_and_constants_that_are_not_in(tiny_study):
    found = {entry["name"]: entry for entry in candidates(tiny_study, EFFECTS, PARAMETERS)}
    assert set(found) == {"anvil_friction", "phonon_drag", *PARAMETERS}  # axisymmetric
    assert found["anvil_friction"]["base"] == 0
    assert found["initial_yield_stress"]["base"] == 30e6
    assert not found["rho_mobile_initial"]["signed"]
    keys = {"name", "kind", "symbol", "unit", "base", "lowest", "highest", "prior", "signed"}
    keys |= {"description", "equation", "source"}
    assert all(set(entry) == keys for entry in found.values())
    revised = at_revision(tiny_study, [EFFECTS["anvil_friction"]])
    assert "anvil_friction" not in {e["name"] for e in candidates(revised, EFFECTS, PARAMETERS)}
    tiny_study["diagnosis"]["candidates"] = ["phonon_drag"]
    tiny_study["diagnosis"]["constants"] = ["drag_slope"]
    chosen = [entry["name"] for entry in candidates(tiny_study, EFFECTS, PARAMETERS)]
    assert chosen == ["phonon_drag", "drag_slope"]


def test_a_constant_starts_from_the_studys_own_value(tiny_study):
    tiny_study["solver"]["material"]["initial_yield_stress"] = 20e6
    found = {entry["name"]: entry for entry in candidates(tiny_study, EFFECTS, PARAMETERS)}
    assert found["initial_yield_stress"]["base"] == 20e6
    tiny_study["solver"]["material"]["initial_yield_stress"] = 9e8
    with pytest.raises(InputError, match="material.initial_yield_stress = 9e.08 is outside"):
        candidates(tiny_study, EFFECTS, PARAMETERS)
    tiny_study["diagnosis"]["constants"] = ["initial_yeld_stress"]
    with pytest.raises(InputError, match="Did you mean 'initial_yield_stress'"):
        candidates(tiny_study, EFFECTS, PARAMETERS)


def test_points_cover_the_tables_velocities_lot_by_lot(rows):
    assert shapes_in_use(rows) == ["uniform_cylinder", "truncated_cone"]
    found = [point for point in points(rows, 8) if point["shape"] == "uniform_cylinder"]
    assert [point["lot"] for point in found] == ["first", "second"] * 4
    velocities = [point["velocity_m_s"] for point in found]
    assert velocities == sorted(velocities)
    assert velocities[0] == 130 and velocities[-1] == 200
    assert found[1]["initial_diameter_mm"] == 7.62
    assert found[0]["length_to_diameter"] == pytest.approx(2)  # of the nearest shot
    cone = [point for point in points(rows, 8) if point["shape"] == "truncated_cone"]
    assert {point["velocity_m_s"] for point in cone} == {130}


def test_a_group_changes_one_candidate_at_a_time(made):
    group = 1 + 8
    assert len(made["run_id"]) == 2 * 8 * group
    kept = 4 + len(NAMES)
    for point in range(16):
        rows = slice(point * group, (point + 1) * group)
        assert len(set(made["seed"][rows])) == 1
        inputs = made["inputs"][rows]
        assert (inputs[:, :kept] == inputs[0, :kept]).all()
        changed = inputs[1:, kept:] != inputs[0, kept:]
        assert (changed == np.eye(8, dtype=bool)).all()
        assert (inputs[0, kept : kept + 2] == 0).all()
    assert len(set(made["seed"])) == 16


def test_amplitudes_take_turns_within_their_range(made):
    names = made["names"]
    friction = made["inputs"][:, names.index("anvil_friction")]
    assert sorted(set(friction)) == pytest.approx([0, 0.1, 0.3])
    drag = made["inputs"][:, names.index("phonon_drag")]
    assert sorted(set(drag)) == pytest.approx([-0.4, -0.3, 0, 0.3, 0.4])
    stress = made["inputs"][:, names.index("initial_yield_stress")]
    assert sorted(set(stress)) == pytest.approx([0, 15e6, 30e6, 45e6, 60e6])


def test_parameters_are_draws_of_the_points_lot(made, draws):
    column = made["names"].index("rho_immobile_initial")
    second = made["inputs"][9:18, column]
    assert len(set(second)) == 1 and second[0] in draws["rho_immobile_initial[second]"]
    hardening = made["inputs"][::9, column + 1]
    assert len(set(hardening)) == 16


def test_the_finer_design_repeats_the_first_run_of_each_point(made):
    finer = base_rows(made, 8)
    assert list(finer["run_id"]) == list(range(0, 144, 9))
    assert (finer["inputs"] == made["inputs"][::9]).all()
    assert list(finer["seed"]) == list(made["seed"][::9])
    assert finer["shape"][-1] == "truncated_cone"
