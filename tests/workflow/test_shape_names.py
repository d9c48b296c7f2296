"""Specimens with measures of one's own: their names in studies, tables, estimates and words."""

import re

import pytest
from tiny_study import STUDY_YAML, TABLE, write_study

from cost.model import run_costs, study_cost
from input_errors import InputError
from measurements import check_against_study, read_measurements
from report.words import shape_words
from schema_check import load_schema
from shape_names import MEASURED, PAPER_SHAPES, paper_shape_like
from study import read_study

CONE = "truncated_cone_2.5mm_by_9mm_of_7.6mm_by_25.4mm"


@pytest.mark.parametrize(
    "shape, words",
    [
        ("uniform_cylinder", "uniform cylinder"),
        ("truncated_cone", "truncated cone"),
        ("reduced_head_4mm", "4-mm head"),
        ("reduced_head_5mm_by_12mm", "5-mm head by 12 mm"),
        (CONE, "2.5-mm cone by 9 mm of 7.6 mm by 25.4 mm"),
        ("all", "all shapes"),
    ],
)
def test_a_reader_sees_the_measures(shape, words):
    assert shape_words(shape) == words


def test_both_schemas_and_the_scripts_take_the_same_names():
    patterns = [
        load_schema("measurements")["properties"]["shape"]["pattern"],
        load_schema("study")["$defs"]["shapes"]["items"]["pattern"],
    ]
    assert patterns[0] == patterns[1]
    for shape in [*PAPER_SHAPES, CONE, "reduced_head_5mm_of_9mm_by_30mm", "cone", "reduced_head_5"]:
        is_known = shape in PAPER_SHAPES or bool(MEASURED.fullmatch(shape))
        assert bool(re.search(patterns[0], shape)) == is_known


def of_own_shape(tmp_path, shape: str):
    folder = write_study(
        tmp_path / "own",
        STUDY_YAML.replace("[uniform_cylinder]", f"[{shape}]"),
        TABLE.replace("uniform_cylinder", shape),
    )
    return read_study(folder / "study.yaml"), folder / "measurements.csv"


def test_a_study_and_its_table_may_have_them(tmp_path):
    study, table = of_own_shape(tmp_path, CONE)
    check_against_study(read_measurements(table), study, table)


@pytest.mark.parametrize("shape", ["reduced_head_5", "reduced_head_5mm_12mm", "cone_3mm"])
def test_a_name_without_its_measures_is_refused_with_an_example(tmp_path, shape):
    with pytest.raises(InputError, match="as in reduced_head_5mm_by_12mm"):
        of_own_shape(tmp_path, shape)


def test_they_cost_as_the_nearest_of_the_paper(tmp_path):
    assert [paper_shape_like(shape) for shape in PAPER_SHAPES] == PAPER_SHAPES
    assert paper_shape_like("reduced_head_5mm") == "reduced_head_4mm"
    assert paper_shape_like("reduced_head_3mm_of_7mm_by_30mm") == "reduced_head_3mm"
    study, _ = of_own_shape(tmp_path, CONE)
    like = study_cost({**study, "database": {**study["database"], "shapes": ["truncated_cone"]}})
    assert CONE not in {shape for *_, shape in run_costs()}
    assert study_cost(study).runs_s == like.runs_s
