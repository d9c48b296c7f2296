"""Confirmation by the solver, and the revisions side by side."""

import numpy as np
import pytest
from tiny_study import TABLE

from ladder_words import ladder_words
from make_confirmation import confirmation
from make_confirmation_design import confirmation_design
from make_ladder import Revision, ladder
from measurements import read_measurements


def test_the_confirmation_runs_every_shot_at_its_lots_maximum(tmp_path):
    table = tmp_path / "measurements.csv"
    table.write_text(TABLE.replace("a2,first,calibrate", "a2,first,ignore"))
    maximum = {"drag": [0.3], "density[first]": [1e12], "density[second]": [1e13]}
    maximum = {name: np.array(value) for name, value in maximum.items()}
    made = confirmation_design(read_measurements(table), maximum, ["density", "drag"], 1)
    assert made["names"][4:] == ["density", "drag"]
    assert list(made["inputs"][:, 0]) == [161, 200, 190]  # a1, a3 held back, b1
    assert list(made["inputs"][:, 4]) == [1e12, 1e12, 1e13]
    assert (made["inputs"][:, 5] == 0.3).all()
    assert made["inputs"][1, 2] == pytest.approx(3)
    assert len(set(made["seed"])) == 3


def comparison() -> dict:
    def shot(name, use, *sizes):
        cells = [{"size": size, "measured": 10, "predicted": 9.5} for size in sizes]
        covariance = [[4.0, 2.0], [2.0, 5.0]] if len(sizes) == 2 else [[4.0]]
        return {"id": name, "use": use, "sizes": cells, "covariance_mm2": covariance}

    sizes = ("final_length_mm", "impact_diameter_mm")
    return {
        "shots": [
            shot("a", "calibrate", *sizes),
            shot("b", "calibrate", "head_length_mm"),
            shot("c", "validate", *sizes),
            shot("d", "validate", "outline_pc_1"),
        ]
    }


def test_the_solvers_misfit_is_whitened_by_the_shots_covariance():
    stopped = {"final_length_mm": 8.0, "impact_diameter_mm": 7.0}
    runs = {
        "a": {"sizes": stopped, "reason": ""},
        "b": {"sizes": {"head_length_mm": 9.0}, "reason": "work"},
        "c": {"sizes": {**stopped, "final_length_mm": float("nan")}, "reason": ""},
        "d": {"sizes": stopped, "reason": ""},
    }
    found = confirmation(comparison(), runs)
    # C = L L^T with L = [[2, 0], [1, 2]]; r = (2, 3) gives z = (1, 1).
    cells = found["shots"][0]["sizes"]
    assert [cell["whitened"] for cell in cells] == pytest.approx([1, 1])
    assert cells[1]["solver"] == 7 and cells[1]["network"] == 9.5
    assert found["shots"][1]["sizes"] == [] and found["shots"][1]["reason"] == "work"
    # Without the length the diameter's own variance remains: 3 / sqrt(5).
    assert found["shots"][2]["sizes"][0]["whitened"] == pytest.approx(3 / 5**0.5)
    assert found["misfit"]["calibrate"] == {
        "n": 2,
        "chi2": pytest.approx(2),
        "whitened_rms": pytest.approx(1),
        "not_stopped": ["b"],
    }
    assert found["misfit"]["validate"]["n"] == 1


def revision(chi2: float, evidence: float | None, runs: int, **draws) -> Revision:
    misfit = {"n": 4, "chi2": chi2, "whitened_rms": (chi2 / 4) ** 0.5, "rms_relative": 0.1}
    empty = {"n": 0, "chi2": 0, "whitened_rms": 0, "rms_relative": 0}
    summary = {"mean": 1, "sd": 1, "lower95": 0, "median": 1, "upper95": 2, "maximum": 1}
    return Revision(
        comparison={
            "misfit": {"calibrate": misfit, "validate": empty},
            "groups": [{"by": "size", "key": "final_length_mm", "whitened_rms": 1}],
            "parameters": [{"name": name, **summary} for name in draws],
        },
        confirmation={"misfit": {"calibrate": misfit, "validate": empty}},
        log_evidence=evidence,
        log_evidence_sd=0.1,
        runs=runs,
        draws={name: np.array(values) for name, values in draws.items()},
    )


def test_the_ladder_shows_misfit_runs_and_shifts():
    base = revision(16, -20, 24, rho=[0.0, 2.0])
    friction = revision(4, None, 30, rho=[3.0, 4.0], friction=[0.1, 0.2])
    found = ladder(["friction"], [base, friction])
    assert found["schema"] == "taylorcal/ladder/1"
    first, second = found["revisions"]
    assert first["id"] == "base" and first["effects"] == [] and first["shift_sd"] == {}
    assert second["id"] == "friction" and second["effects"] == ["friction"]
    assert first["new_runs"] == 24 and second["new_runs"] == 6
    assert first["misfit"]["calibrate"] == {"n": 4, "chi2": 16, "whitened_rms": 2}
    assert second["shift_sd"] == {"rho": pytest.approx(2.5)}
    assert second["log_evidence"] is None
    text = ladder_words(found)
    assert "base        2.00          -    2.00  -20.00        24" in text
    assert "friction    1.00          -    1.00       -         6" in text
