"""Outlines as scores: of a database, of measured dots with their errors, and bad files."""

from pathlib import Path

import h5py
import numpy as np
import pytest
from outlined_study import OUTLINE, WITH_SCORES, outlined_study
from tiny_study import write_study

from input_errors import InputError
from measurements import check_against_study, read_measurements
from outlines.basis import make_basis, read_basis, weights_of, write_basis
from outlines.database import read_outlines, score_table, write_scored_database
from outlines.measured import MeasuredOutline, read_outline
from outlines.projection import project
from outlines.table import check_outlines, projections, write_scored_table
from size_kinds import OUTLINE_SCORES
from study import read_study, train_settings

FRACTIONS = ((np.arange(40) + 0.5) / 40) ** 1.5
SHAPE = "uniform_cylinder"
DIAMETER_MM = 8.0


def rods(runs: int, seed: int = 1) -> np.ndarray:
    """Outlines of mushrooms: a foot, a bulge and a taper of varied size."""
    rng = np.random.default_rng(seed)
    foot, width, bulge = rng.uniform([0.1, 0.05, 0], [0.6, 0.2, 0.2], (runs, 3)).T
    z = FRACTIONS[None, :]
    return (
        1
        + foot[:, None] * np.exp(-z / width[:, None])
        + bulge[:, None] * (1 - z) * np.cos(2 * z / width[:, None] * 0.1)
        + 0.05 * rng.uniform(size=(runs, 1)) * (1 - z) ** 2
    )


@pytest.fixture
def basis():
    return make_basis(FRACTIONS, {SHAPE: rods(200)})


def database(path: Path, radii: np.ndarray, with_outlines: bool = True) -> Path:
    text = h5py.string_dtype(encoding="utf-8")
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "taylorcal/database/1"
        file["inputs"] = np.column_stack([np.full(len(radii), DIAMETER_MM), np.arange(len(radii))])
        file["inputs"].attrs.create("names", ["initial_diameter_mm", "velocity_m_s"], dtype=text)
        file["outputs"] = np.ones((len(radii), 1))
        file["outputs"].attrs.create("names", ["final_length_mm"], dtype=text)
        file.create_dataset("shape", data=[SHAPE] * len(radii), dtype=text)
        file["status"] = np.zeros(len(radii), dtype=np.int64)
        if with_outlines:
            file["outline_radius"] = radii
            file["outline_radius"].attrs["fractions"] = FRACTIONS
    return path


def test_weights_are_lengths():
    weights = weights_of(FRACTIONS)
    assert weights.sum() == pytest.approx(1)
    assert weights @ FRACTIONS == pytest.approx(0.5, abs=2e-3)


def test_components_are_orthonormal_and_explain_most(basis):
    of_shape = basis.shapes[SHAPE]
    gram = of_shape.components * weights_of(FRACTIONS) @ of_shape.components.T
    assert np.allclose(gram, np.eye(4), atol=1e-10)
    assert of_shape.share[0] > of_shape.share[1] > of_shape.share[3]
    assert of_shape.share.sum() > 0.99
    assert of_shape.words[0].startswith("wider")


def test_scores_give_the_outline_back(basis):
    radii = rods(200)
    scores = basis.scores(SHAPE, radii)
    back = basis.outline(SHAPE, scores[3], FRACTIONS)
    left = np.sqrt(np.diag(basis.shapes[SHAPE].truncation))
    assert np.abs(back - radii[3]).max() < 5 * left.max()
    assert scores.std(axis=0, ddof=1) == pytest.approx(basis.shapes[SHAPE].spread)


def test_a_basis_survives_its_file(basis, tmp_path):
    write_basis(tmp_path / "basis.json", basis, {"database": "here"})
    again = read_basis(tmp_path / "basis.json")
    assert np.array_equal(again.fractions, basis.fractions)
    for key, value in vars(basis.shapes[SHAPE]).items():
        assert np.array_equal(getattr(again.shapes[SHAPE], key), value)


def test_a_scored_database_has_the_scores_in_mm(basis, tmp_path):
    radii = rods(20, seed=2)
    radii[4] = np.nan
    source = database(tmp_path / "database.h5", radii)
    target = tmp_path / "scored.h5"
    write_scored_database(source, basis, target)
    with h5py.File(target) as file:
        assert list(file["outputs"].attrs["names"]) == ["final_length_mm", *OUTLINE_SCORES]
        scores = file["outputs"][:, 1:]
        assert np.array_equal(file["inputs"][:], h5py.File(source)["inputs"][:])
        assert file.attrs["schema"] == "taylorcal/database/1"
    assert np.isnan(scores[4]).all() and np.isfinite(np.delete(scores, 4, 0)).all()
    assert scores[0] == pytest.approx(basis.scores(SHAPE, radii[:1])[0] * DIAMETER_MM / 2)


def test_runs_without_an_outline_are_left_out_of_the_basis(tmp_path):
    radii = rods(20)
    radii[4] = np.nan
    fractions, outlines = read_outlines(database(tmp_path / "database.h5", radii))
    assert np.array_equal(fractions, FRACTIONS)
    assert len(outlines[SHAPE]) == 19


def test_an_older_database_is_refused_with_the_remedy(basis, tmp_path):
    old = database(tmp_path / "database.h5", rods(3), with_outlines=False)
    with pytest.raises(InputError, match="has no outlines.*run again"):
        score_table(old, basis)


def test_too_few_runs_are_refused():
    with pytest.raises(InputError, match="3 outlines of uniform_cylinder are too few"):
        make_basis(FRACTIONS, {SHAPE: rods(3)})


def dots(radii, height_share, sd_mm=0.05, length_sd_mm=1e-6):
    """A measured outline of 30 mm, without noise."""
    radius_mm = np.interp(height_share, FRACTIONS, radii) * DIAMETER_MM / 2
    sd = np.full(len(radius_mm), sd_mm)
    return MeasuredOutline(30 * height_share, radius_mm, sd, 30.0, length_sd_mm)


def test_an_outline_of_the_database_has_its_own_scores(basis):
    radii = rods(200)[7]
    wanted = basis.scores(SHAPE, radii[None])[0] * DIAMETER_MM / 2
    found = project(dots(radii, FRACTIONS, sd_mm=1e-4), basis, SHAPE, DIAMETER_MM, 0.0)
    assert found.scores == pytest.approx(wanted, abs=2e-3)
    # Few dots at odd heights: within the errors that the projection states.
    few = project(dots(radii, np.linspace(0.02, 0.97, 14) ** 1.1), basis, SHAPE, DIAMETER_MM, 0.0)
    assert np.all(np.abs(few.scores - wanted) < 2 * few.sd)


@pytest.mark.parametrize("scale_sd, length_sd_mm", [(0.0, 1e-6), (0.02, 1e-6), (0.0, 0.3)])
def test_stated_errors_are_those_of_repeated_measurements(basis, scale_sd, length_sd_mm):
    rng = np.random.default_rng(5)
    shares = np.linspace(0.01, 0.98, 15)
    deviations, stated = [], None
    for radii in rods(300, seed=3):
        true = dots(radii, shares)
        length = 30.0 + length_sd_mm * rng.standard_normal()
        radius = true.radius_mm * (1 + scale_sd * rng.standard_normal())
        radius += true.radius_sd_mm * rng.standard_normal(15)
        # The length is read wrongly: the dots' true shares of it stay what they were.
        noisy = MeasuredOutline(true.height_mm, radius, true.radius_sd_mm, length, length_sd_mm)
        stated = project(noisy, basis, SHAPE, DIAMETER_MM, scale_sd)
        wanted = basis.scores(SHAPE, radii[None])[0] * DIAMETER_MM / 2
        deviations.append((stated.scores - wanted) / stated.sd)
    rms = np.sqrt(np.mean(np.square(deviations), axis=0))
    assert np.all(rms > 0.8) and np.all(rms < 1.25), rms


def test_errors_of_even_dots_hardly_depend_on_each_other(basis):
    found = project(dots(rods(1)[0], np.linspace(0.02, 0.98, 20)), basis, SHAPE, DIAMETER_MM, 0.0)
    assert np.abs(found.correlation - np.eye(4)).max() < 0.5


@pytest.mark.parametrize(
    "outline, expected",
    [
        (None, ["line 2", "'a1.csv'", "no such file"]),
        (OUTLINE.replace("2,4.8", "0.5,4.8"), ["line 4", "0.5 after 1", "rise"]),
        (OUTLINE.replace("height_mm", "height_cm"), ["line 1", "height_cm", "'height_mm'"]),
        (OUTLINE.replace(",radius_mm", ",radius_sd_mm"), ["'radius_mm' is missing"]),
        (OUTLINE.replace("4.8", "wide"), ["line 4", "'wide'", "a number in mm"]),
        (OUTLINE.replace("12.3,", "123,"), ["line 9", "123", "final length of a1"]),
        (OUTLINE.replace("12.3,3.8", "12.3,38"), ["line 9", "radius_mm = 38", "in mm"]),
        ("height_mm,radius_mm\n0,5\n1,5\n12,4\n", ["3 dots", "6 or more"]),
        (
            "height_mm,radius_mm\n0,11\n2,9\n4,8.5\n6,8\n8,7.8\n12.3,7.6\n",
            ["Are these diameters", "a1"],
        ),
        (OUTLINE.replace("1,5.0", "1,-5.0"), ["line 3", "radius_mm = -5", "above 0"]),
    ],
)
def test_a_bad_outline_is_refused(tmp_path, outline, expected):
    folder = outlined_study(tmp_path / "tiny", outline)
    study, table = read_study(folder / "study.yaml"), folder / "measurements.csv"
    with pytest.raises(InputError) as error:
        check_outlines(read_measurements(table), study, table)
    for part in expected:
        assert part in str(error.value)


def test_scores_need_an_outline(tmp_path):
    folder = write_study(tmp_path / "tiny", WITH_SCORES)
    study, table = read_study(folder / "study.yaml"), folder / "measurements.csv"
    with pytest.raises(InputError, match="no fitted row has 'outline'. Drop outline_pc_1"):
        check_against_study(read_measurements(table), study, table)


def test_scores_scale_with_the_diameter(tmp_path):
    study = read_study(outlined_study(tmp_path / "tiny") / "study.yaml")
    outputs = {out["name"]: out["divide_by"] for out in train_settings(study)["outputs"]}
    assert outputs["outline_pc_3"] == ["initial_diameter_mm"]
    assert "length_to_diameter" in outputs["final_length_mm"]


def test_errors_of_dots_come_from_the_file_or_the_study(tmp_path):
    folder = outlined_study(tmp_path / "tiny")
    table = folder / "measurements.csv"
    row = read_measurements(table)[0]
    assert np.all(read_outline(row, table, 0.07).radius_sd_mm == 0.07)
    (folder / "a1.csv").write_text(
        OUTLINE.replace("radius_mm", "radius_mm,radius_sd_mm")
        .replace("\n", ",0.02\n")[:-1]
        .replace("radius_sd_mm,0.02", "radius_sd_mm")
        + "\n"
    )
    assert np.all(read_outline(row, table, 0.07).radius_sd_mm == 0.02)


def test_the_fitted_table_has_scores_where_there_is_an_outline(tmp_path, basis):
    folder = outlined_study(tmp_path / "tiny")
    table, target = folder / "measurements.csv", tmp_path / "scored.csv"
    found = projections(table, basis, radius_sd_mm=0.05, scale_sd=0.01)
    write_scored_table(table, basis, found, target)
    header, *lines = target.read_text().splitlines()
    assert list(found) == ["a1"]
    assert header.split(",")[-8:-6] == ["outline_pc_1", "outline_pc_1_sd"]
    score, sd = map(float, lines[0].split(",")[-8:-6])
    assert score == pytest.approx(found["a1"].scores[0], rel=1e-5)
    assert 0 < sd < basis.shapes[SHAPE].spread[0] * 7.595 / 2
    assert lines[1].endswith("," * 8)
    assert len(lines) == 4
