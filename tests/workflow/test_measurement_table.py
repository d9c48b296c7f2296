"""A broken table is refused with its line, its column and the remedy."""

import pytest
from tiny_study import TABLE, write_study

from input_errors import InputError
from measurements import check_against_study, read_measurements


def refusal(tmp_path, table: str) -> str:
    path = write_study(tmp_path / "tiny", table=table) / "measurements.csv"
    with pytest.raises(InputError) as error:
        read_measurements(path)
    return str(error.value)


@pytest.mark.parametrize(
    "old, new, expected",
    [
        ("velocity_m_s", "velocity_km_s", ["line 1", "velocity_km_s", "'velocity_m_s'", "unit"]),
        ("velocity_m_s", "velocity_km_s", ["velocity_m_s is missing"]),
        (",lot,", ",lott,", ["column lott is not a known key", "Did you mean 'lot'?"]),
        ("final_length_mm_sd", "note", ["column 'note' is there twice"]),
        ("15.19,12.4", "-15.19,12.4", ["line 2: initial_length_mm = -15.19", "above 0 mm"]),
        ("a2,", "a1,", ["line 3: id = 'a1' is already in line 2"]),
        ("a1,first,calibrate,uniform_cylinder", "a1,first,calibrate,cone", ["shape = 'cone'"]),
        ("a1,first,calibrate", "a1,first,calibrat", ["use = 'calibrat'", "'calibrate'"]),
        ("161,", "fast,", ["line 2: velocity_m_s = 'fast'", "a number in m/s"]),
        ("161,", "nan,", ["line 2: velocity_m_s = 'nan'"]),
        ("0.087,", ",", ["line 2: final_length_mm is given without final_length_mm_sd"]),
        ("12.4,0.087", ",0.087", ["final_length_mm_sd is given without final_length_mm"]),
        ("12.4,", "21.4,", ["final_length_mm = 21.4 is more than initial_length_mm = 15.19"]),
        ("11.7,", "5.1,", ["impact_diameter_mm = 5.1 is less than initial_diameter_mm"]),
        ("House 1995,\na2", "\na2", ["line 2: 13 cells (expected 14"]),
        ("0.292,House 1995", "0.292,", ["line 2: source is missing"]),
        ('"J, C"', "J, C", ["line 5: 15 cells (expected 14", "quotes"]),
    ],
)
def test_a_broken_table_is_refused(tmp_path, old, new, expected):
    assert old in TABLE
    message = refusal(tmp_path, TABLE.replace(old, new, 1))
    for part in ["measurements.csv", *expected]:
        assert part in message


def test_a_size_needs_its_error_column(tmp_path):
    table = TABLE.replace("impact_diameter_mm,impact_diameter_mm_sd", "impact_diameter_mm,material")
    assert "impact_diameter_mm is given without impact_diameter_mm_sd" in refusal(tmp_path, table)


@pytest.mark.parametrize("table, expected", [("", "is empty"), (TABLE.split("\n")[0], "no rows")])
def test_an_empty_table_is_refused(tmp_path, table, expected):
    assert expected in refusal(tmp_path, table)


def test_a_missing_table_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_measurements(tmp_path / "measurements.csv")


def test_numbers_are_numbers_and_empty_cells_are_absent(tmp_path):
    rows = read_measurements(write_study(tmp_path / "tiny") / "measurements.csv")
    assert [row["id"] for row in rows] == ["a1", "a2", "a3", "b1"]
    assert rows[0]["velocity_m_s"] == 161.0
    assert rows[3]["source"] == "J, C"
    assert "velocity_sd_m_s" not in rows[0]


def test_a_size_may_miss_the_possible_by_its_error(tmp_path):
    table = TABLE.replace("12.4,0.087,11.7", "15.3,0.087,7.1")
    assert read_measurements(write_study(tmp_path / "tiny", table=table) / "measurements.csv")


def check(tmp_path, study, old, new):
    assert old in TABLE
    path = write_study(tmp_path / "changed", table=TABLE.replace(old, new)) / "measurements.csv"
    check_against_study(read_measurements(path), study, path)


@pytest.mark.parametrize(
    "old, new, expected",
    [
        ("294,161,", "294,90,", "a1: velocity_m_s = 90 is outside the database .100 to 210."),
        ("294,161,", "394,161,", "a1: initial_temperature_K = 394 is outside"),
        ("161,7.595,15.19", "161,7.595,75.95", "a1: length_to_diameter = 10 is outside"),
        ("calibrate,uniform_cylinder", "calibrate,truncated_cone", "is not in database.shapes"),
        ("calibrate,", "validate,", "no row has `use` = calibrate"),
    ],
)
def test_a_used_row_must_lie_where_the_database_is(tmp_path, tiny_study, old, new, expected):
    with pytest.raises(InputError, match=expected):
        check(tmp_path, tiny_study, old, new)


def test_a_row_left_out_may_lie_anywhere(tmp_path, tiny_study):
    check(tmp_path, tiny_study, "a3,first,validate", "a3,first,ignore")
    check(
        tmp_path, tiny_study, "validate,uniform_cylinder,294,200", "ignore,truncated_cone,294,400"
    )


def test_a_fitted_size_must_be_measured(tmp_path, tiny_study):
    tiny_study["calibration"]["fit_sizes"] = ["undeformed_length_mm"]
    with pytest.raises(InputError, match="no fitted row has 'undeformed_length_mm'"):
        check(tmp_path, tiny_study, "a1,", "a0,")
