"""The synthetic table is the truth plus the stated noise, and a study can use it."""

import numpy as np
import pytest
from tiny_study import ROOT

from input_errors import InputError
from make_synthetic_table import HELD_BACK, NOISE, SHAPES, TRUTH, VELOCITY_NOISE
from make_synthetic_table import TableDesign, main, shape, table_rows, truth_of, write_table
from measurements import check_against_study, read_measurements
from study import read_study

SHOTS = 50
SIZES = np.tile([36.0, 10.0, 8.0, 28.0, 8.5], (SHOTS, 1))


def test_the_design_is_the_papers():
    made = TableDesign(seed=3).columns()
    assert len(made["shape"]) == SHOTS and set(made["shape"]) == set(SHAPES)
    assert made["inputs"][:, 0].min() == 19 and made["inputs"][:, 0].max() == 125
    for name, value in TRUTH.items():
        assert (made["inputs"][:, made["names"].index(name)] == value).all()


def test_the_noise_has_the_stated_size():
    made = TableDesign(seed=3).columns()
    deviations = {size: [] for size in NOISE}
    velocity = []
    for seed in range(20):
        for index, row in enumerate(table_rows(made, SIZES, "synthetic", seed)):
            for column, (size, relative) in enumerate(NOISE.items()):
                true = SIZES[index, column]
                deviations[size].append((float(row[size]) / true - 1) / relative)
            true = made["inputs"][index, 0]
            velocity.append((float(row["velocity_m_s"]) / true - 1) / VELOCITY_NOISE)
    # 1000 values each: the mean is within 4 of its standard errors of 0, the spread of 1.
    for values in [*deviations.values(), velocity]:
        assert abs(np.mean(values)) < 4 / np.sqrt(1000)
        assert abs(np.std(values) - 1) < 4 / np.sqrt(2000)


def test_shapes_are_the_papers_or_ones_own(capsys, monkeypatch):
    assert shape("truncated_cone_3mm_by_15mm") == "truncated_cone_3mm_by_15mm"
    words = ["make_synthetic_table", "--fidelity", "coarse", "--seed", "1", "--out", "table.csv"]
    monkeypatch.setattr("sys.argv", [*words, "--shapes", "reduced_head_5cm"])
    with pytest.raises(SystemExit):
        main()
    error = capsys.readouterr().err
    assert "reduced_head_5cm is no shape" in error and "reduced_head_5mm_by_12mm" in error


def test_the_table_is_valid_and_labelled(tmp_path):
    rows = table_rows(
        TableDesign(seed=3).columns(), SIZES, "synthetic: made by taylorcal's solver", 3
    )
    write_table(tmp_path / "measurements.csv", rows)
    read = read_measurements(tmp_path / "measurements.csv")
    assert all(row["source"].startswith("synthetic") for row in read)
    assert sum(row["use"] == "validate" for row in read) == SHOTS // HELD_BACK
    study = read_study(ROOT / "experiments" / "paper_design" / "study.yaml")
    check_against_study(read, study, tmp_path / "measurements.csv")


def test_a_hidden_effect_is_an_input_of_the_solver_and_nothing_else():
    truth = truth_of(["anvil_friction=0.08", "hardening_coefficient=3"])
    assert truth == {**TRUTH, "hardening_coefficient": 3, "anvil_friction": 0.08}
    made = TableDesign(seed=3, shots=8, shapes=SHAPES[:2], truth=truth).columns()
    assert made["names"][-1] == "anvil_friction" and (made["inputs"][:, -1] == 0.08).all()
    assert made["shape"] == [name for name in SHAPES[:2] for _ in range(4)]
    for row in table_rows(made, SIZES[:8], "synthetic", 3):
        assert not any("friction" in text for text in row.values())
    with pytest.raises(InputError, match="expected name=value"):
        truth_of(["anvil_friction"])
