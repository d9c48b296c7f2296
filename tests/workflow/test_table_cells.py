"""The scripts read a table as the programs do, and say what a spreadsheet made of it."""

import pytest
from tiny_study import NEW_ROW, TABLE, write_study

from input_errors import InputError
from measurements import read_measurements
from table_cells import number_in

HEADER = TABLE.splitlines()[0]
PLAIN = TABLE.replace('"J, C"', "JC")


def read(tmp_path, content: str | bytes) -> list[dict]:
    path = write_study(tmp_path / "tiny") / "measurements.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_measurements(path)


def refusal(tmp_path, content: str | bytes) -> str:
    with pytest.raises(InputError) as error:
        read(tmp_path, content)
    return str(error.value)


@pytest.mark.parametrize("cell", ["12.4", "-1", ".5", "12.", "1.24e1", "1E+2", "0"])
def test_numbers_of_the_programs_are_numbers(cell):
    assert number_in(cell) == float(cell)


@pytest.mark.parametrize(
    "cell",
    ["+12.4", "1_2.4", "\u0661\u0662.4", "12.4\u00a0", "12,4", "0x0c", "inf", "1e999", "", "."],
)
def test_what_the_programs_refuse_is_no_number(cell):
    assert number_in(cell) is None


@pytest.mark.parametrize(
    "cell", ["+12.4", "1_2.4", "\u0661\u0662.4", "12.4\u00a0", '"12,4"', "12.4 mm"]
)
def test_such_a_cell_is_refused_with_its_place(tmp_path, cell):
    message = refusal(tmp_path, TABLE.replace("12.4,", f"{cell},", 1))
    assert "measurements.csv, line 2: final_length_mm = " in message
    assert "(expected a number in mm, as 12.5)" in message


@pytest.mark.parametrize("row", ["," * 13, " ," * 13, "\t", ""])
def test_rows_of_empty_cells_are_left_out(tmp_path, row):
    rows = read(tmp_path, TABLE.replace("\na2", f"\n{row}\na2"))
    assert [(entry["id"], entry["line"]) for entry in rows][:2] == [("a1", 2), ("a2", 4)]


def test_blanks_around_cells_do_not_count(tmp_path):
    rows = read(
        tmp_path, TABLE.replace("a1,first,", '"a1 "," first", ').replace(",161,", ", 161\t,")
    )
    assert (rows[0]["id"], rows[0]["lot"], rows[0]["velocity_m_s"]) == ("a1", "first", 161)


def test_a_row_has_the_line_where_it_begins(tmp_path):
    rows = read(
        tmp_path,
        TABLE.replace("12.4,0.087,11.7,0.292,House 1995", '12.4,0.087,11.7,0.292,"Ho\nuse"'),
    )
    assert [row["line"] for row in rows if "use" in row["source"] or row["id"] == "a2"] == [2, 4, 5]


@pytest.mark.parametrize(
    "content, expected",
    [
        (PLAIN.replace(",", ";"), ["line 1", "separated by semicolons", "add-rows"]),
        (PLAIN.replace(",", ";").replace(".", ","), ["separated by semicolons", "decimal points"]),
        (PLAIN.replace(",", "\t"), ["separated by tabs"]),
        (TABLE.replace("\n", "\r"), ["line 1: ends in CR alone", "CSV UTF-8"]),
        (TABLE.partition("\n")[2], ["line 1: a1, first, ", "expected a header: id, lot, use"]),
        (b"PK\x03\x04rest", ["is a workbook of a spreadsheet", "Save it as CSV UTF-8"]),
        (b"\xd0\xcf\x11\xe0rest", ["is a workbook"]),
        (
            TABLE.replace("a2,", "\u00e42,").encode("latin-1"),
            ["line 3: is not text in UTF-8 (the byte 0xe4"],
        ),
        (TABLE.encode("utf-16"), ["line 1: is not text in UTF-8"]),
        (TABLE.replace('"J, C"', '"J, C'), ["line 5: is not a comma-separated table"]),
        (HEADER.replace(",note", ",") + "\n", ["line 1: a column has no name"]),
    ],
)
def test_what_a_spreadsheet_made_is_told(tmp_path, content, expected):
    message = refusal(tmp_path, content)
    assert "measurements.csv" in message and len(message.splitlines()) == 1
    for part in expected:
        assert part in message


@pytest.mark.parametrize(
    "old, new, expected",
    [
        (
            "12.4,0.087",
            "1.24,0.087",
            "final_length_mm = 1.24 is less than 0.1 of initial_length_mm",
        ),
        ("12.4,0.087", "12.4,8.7", "final_length_mm_sd = 8.7 (expected 1.2e-05 to 6.2"),
        ("12.4,0.087", "12.4,8.7e-9", "final_length_mm_sd = 8.7e-09"),
        ("uniform_cylinder", "reduced_head_9mm", "shape = 'reduced_head_9mm': the end's diameter"),
    ],
)
def test_what_no_impact_gives_is_refused(tmp_path, old, new, expected):
    assert f"line 2: {expected}" in refusal(tmp_path, TABLE.replace(old, new, 1))


def test_the_same_shot_under_two_names_is_refused(tmp_path):
    twice = TABLE + NEW_ROW + NEW_ROW.replace("b2,", "b9,")
    assert "line 7: b9 is the same shot as b2 (line 6)" in refusal(tmp_path, twice)
    assert len(read(tmp_path, twice.replace("b9,second,calibrate", "b9,second,ignore"))) == 6
    assert (
        len(read(tmp_path, TABLE + NEW_ROW + NEW_ROW.replace("b2", "b9").replace("9.91", "9.9")))
        == 6
    )
