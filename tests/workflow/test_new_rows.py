"""New shots join a table only if they are whole, new, within the database, and believable."""

import json
import os
import signal
import subprocess
import sys

import pytest
from tiny_study import NEW_ROW, ROOT, STUDY_YAML, TABLE

from input_errors import InputError
from new_rows.append import append_rows, with_rows
from new_rows.examine import examine
from new_rows.pasted import read_pasted
from new_rows.words import addition_words

HEADER = TABLE.splitlines()[0]
GOOD = f"{HEADER}\n{NEW_ROW}"


@pytest.fixture
def studied(copied, monkeypatch):
    """A copy of the finished study, and its folder to work in."""
    monkeypatch.chdir(copied.folder)
    return copied


def examined(workspace, text: str):
    path = workspace.folder / "new.csv"
    path.write_text(text, encoding="utf-8")
    return examine("tiny", path.relative_to(workspace.folder))


def add_rows(workspace, *options: str, text: str = GOOD) -> subprocess.CompletedProcess:
    (workspace.folder / "new.csv").write_text(text, encoding="utf-8")
    command = [ROOT / "workflow" / "taylorcal", "add-rows", "tiny", "new.csv", *options]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    return subprocess.run(command, cwd=workspace.folder, text=True, **streams)


def turned(text: str, separator: str) -> str:
    """The table of `text` with its columns in reverse order."""
    rows = [line.split(",") for line in text.splitlines()]
    return "".join(separator.join(reversed(row)) + "\n" for row in rows)


@pytest.mark.parametrize("separator", ["\t", ";", ","])
def test_pasted_rows_are_appended_in_the_order_of_the_table(studied, separator):
    addition = examined(studied, turned(GOOD, separator))
    assert addition.refusals(accept_outliers=False) == []
    append_rows(addition.table, addition.cells)
    assert (studied.study / "measurements.csv").read_text() == TABLE + NEW_ROW


def test_the_command_appends_and_a_dry_run_does_not(studied):
    table = studied.study / "measurements.csv"
    told = add_rows(studied, "--dry-run")
    assert told.returncode == 0, told.stdout
    assert "b2 (line 2, calibrate): inside the database's range" in told.stdout
    assert "final_length_mm" in told.stdout and "model" in told.stdout
    assert table.read_text() == TABLE
    told = add_rows(studied)
    assert told.returncode == 0 and "1 row added" in told.stdout
    assert table.read_text() == TABLE + NEW_ROW


def test_a_typo_is_refused_with_its_deviation_and_the_table_stays(studied):
    typo = GOOD.replace("19.56", "4.956")
    told = add_rows(studied, text=typo)
    assert told.returncode == 1 and "Traceback" not in told.stdout
    assert "new.csv, line 2: b2: final_length_mm = 4.956 is " in told.stdout
    assert "standard errors from the model" in told.stdout
    assert (studied.study / "measurements.csv").read_text() == TABLE
    told = add_rows(studied, "--accept-outliers", text=typo)
    assert told.returncode == 0, told.stdout
    assert (studied.study / "measurements.csv").read_text().count("4.956,") == 1


def test_predictions_are_those_of_calibrate_compare(studied):
    """A shot of the table under another name has the deviations of comparison.json."""
    row = TABLE.splitlines()[1].replace("a1,", "twin,").replace("12.4,", "12.41,")
    addition = examined(studied, f"{HEADER}\n{row}\n")
    length = addition.shots[0].prediction.sizes[0]
    shots = json.loads((studied.results / "comparison.json").read_text())["shots"]
    known = shots[0]["sizes"][0]
    assert (length.size, length.measured) == ("final_length_mm", 12.41)
    assert length.predicted == pytest.approx(known["predictive_mean"], rel=1e-12)
    assert length.deviation == pytest.approx(
        (12.41 - known["predictive_mean"]) / known["predictive_sd"], rel=1e-3
    )


def test_a_shot_far_off_gets_a_warning_and_joins(studied):
    addition = examined(studied, GOOD.replace("19.56", "11.56"))
    deviation = addition.shots[0].prediction.sizes[0].deviation
    assert -10 < deviation < -5
    assert "far off: look at the number again" in addition_words(addition)
    assert addition.refusals(accept_outliers=False) == []


def test_a_new_lot_is_compared_with_the_nearest_known_one(studied):
    addition = examined(studied, GOOD.replace("second", "third").replace("19.56", "4.956"))
    assert addition.shots[0].prediction.stand_in in ("first", "second")
    text = addition_words(addition)
    assert "lot 'third' is new" in text and "a slip of the pen?" in text
    assert addition.refusals(accept_outliers=False) == [], "its metal may be softer than any"
    append_rows(addition.table, addition.cells)
    again = examined(studied, GOOD.replace("b2,second", "c1,third"))
    assert again.shots[0].prediction.stand_in == "second", "its lot has still no parameters"


@pytest.mark.parametrize(
    "row, expected",
    [
        (NEW_ROW.replace("b2,", "a1,"), "id 'a1' is already in line 2 of measurements.csv"),
        (TABLE.splitlines()[1].replace("a1,", "c1,"), "is the same shot as a1 (line 2 of"),
        (NEW_ROW + NEW_ROW.replace("b2,", "b3,"), "is the same shot as b2 (line 2 of new.csv)"),
        (NEW_ROW.replace(",130,", ",90,"), "velocity_m_s = 90 is outside the database (100 to 210"),
        (NEW_ROW.replace("uniform_cylinder", "truncated_cone"), "is not in database.shapes"),
    ],
    ids=["same id", "same shot", "same among the new", "too slow", "other shape"],
)
def test_what_the_study_cannot_hold_is_refused(studied, row, expected):
    addition = examined(studied, f"{HEADER}\n{row}")
    (refusal,) = addition.refusals(accept_outliers=True)
    assert expected in refusal and refusal.startswith("new.csv, line ")


def test_a_shot_fired_again_is_only_a_remark(studied):
    row = TABLE.splitlines()[1].replace("a1,", "c1,").replace("12.4,", "12.5,")
    addition = examined(studied, f"{HEADER}\n{row}\n")
    assert addition.refusals(accept_outliers=False) == []
    assert "has the same inputs as a1 (line 2 of measurements.csv)" in addition_words(addition)


def test_beyond_the_range_it_says_what_widening_costs(studied):
    beyond = GOOD.replace(",130,", ",90,")
    text = addition_words(examined(studied, beyond))
    assert "outside the database's range" in text and "24 runs of the solver" in text
    wider = STUDY_YAML.replace("velocity_m_s: [100,", "velocity_m_s: [80,")
    (studied.study / "study.yaml").write_text(wider)
    addition = examined(studied, beyond)
    text = addition_words(addition)
    assert "inside the database's range" in text
    assert "beyond the network, no prediction: velocity_m_s = 90 (100 to 210)" in text
    assert addition.refusals(accept_outliers=False) == []
    (studied.study / "study.yaml").write_text(STUDY_YAML)
    ignored = examined(studied, beyond.replace("calibrate", "ignore"))
    assert ignored.refusals(accept_outliers=False) == []


def test_a_study_not_calibrated_yet_takes_rows_without_a_prediction(fresh, monkeypatch):
    monkeypatch.chdir(fresh.folder)
    addition = examined(fresh, GOOD.replace("19.56", "9.56"))
    assert addition.refusals(accept_outliers=False) == []
    assert "not been calibrated yet" in addition_words(addition)


@pytest.mark.parametrize(
    "old, new, expected",
    [
        (",lot,", ",lott,", "line 1: column lott is not a known key. Did you mean 'lot'?"),
        ("velocity_m_s", "velocity_km_s", "its unit is not understood"),
        ("19.56,0.137", "19.56,", "line 2: final_length_mm is given without final_length_mm_sd"),
        ("19.56", "29.56", "line 2: final_length_mm = 29.56 is more than initial_length_mm"),
        ("JC,", '"JC",,', "line 2: 15 cells (expected 14"),
        (",source,note", ",source,material", "the table has no column material"),
    ],
)
def test_the_rules_of_a_table_hold_for_new_rows(studied, old, new, expected):
    text = GOOD.replace(old, new).replace("JC,\n", "JC,copper\n" if "material" in new else "JC,\n")
    with pytest.raises(InputError) as error:
        examined(studied, text)
    assert expected in str(error.value)


@pytest.mark.parametrize(
    "numbers, expected",
    [
        (["12,4", "0,087"], ["12.4", "0.087"]),
        (["12,4", "1,234"], ["12.4", "1.234"]),
        (["12.4", "0.087"], ["12.4", "0.087"]),
        (["12,4", "0.087"], "'12,4' has a comma, while final_length_mm_sd = '0.087'"),
        (["1,234", "5"], "'1,234' may be 1.234 or 1234"),
        (["1.234,5", "5"], "'1.234,5' (expected a number)"),
    ],
)
def test_commas_in_numbers_are_understood_or_refused(tmp_path, numbers, expected):
    path = tmp_path / "new.csv"
    path.write_text(f"final_length_mm;final_length_mm_sd;note\n{';'.join(numbers)};a, b\n")
    if isinstance(expected, list):
        assert read_pasted(path)[1] == [(2, [*expected, "a, b"])]
        return
    with pytest.raises(InputError) as error:
        read_pasted(path)
    assert f"{path}, line 2: final_length_mm = {expected}" in str(error.value)


def test_unicode_text_of_a_spreadsheet_is_read(tmp_path):
    path = tmp_path / "new.txt"
    path.write_text("id\tnote\r\nb2\t20 °C\r\n", encoding="utf-16", newline="")
    assert read_pasted(path) == (["id", "note"], [(2, ["b2", "20 °C"])])


@pytest.mark.parametrize("content", [b"\xef\xbb\xbfid,note\r\na, x \r\n", b"id,note\na,x"])
def test_the_bytes_of_a_table_stay_and_its_line_ends_go_on(content):
    longer = with_rows(content, [["b", "y, z"]])
    end = b"\r\n" if b"\r" in content else b"\n"
    assert longer == content.removesuffix(end) + end + b'b,"y, z"' + end


@pytest.mark.parametrize("call", ["fsync", "replace"])
def test_a_kill_leaves_the_table_whole(tmp_path, call):
    table = tmp_path / "measurements.csv"
    table.write_text(TABLE)
    table.chmod(0o640)
    cells = NEW_ROW.rstrip("\n").split(",")
    lines = ["import os, pathlib, signal, new_rows.append"]
    lines += [f"os.{call} = lambda *_: os.kill(os.getpid(), signal.SIGKILL)"]
    lines += [f"new_rows.append.append_rows(pathlib.Path({str(table)!r}), [{cells!r}])"]
    scripts = {**os.environ, "PYTHONPATH": str(ROOT / "workflow" / "scripts")}
    killed = subprocess.run([sys.executable, "-c", "\n".join(lines)], env=scripts)
    assert killed.returncode == -signal.SIGKILL
    assert table.read_text() == TABLE
    append_rows(table, [cells])
    assert table.read_text() == TABLE + NEW_ROW
    assert table.stat().st_mode & 0o777 == 0o640
    assert [path.name for path in tmp_path.iterdir()] == ["measurements.csv"]


def test_a_table_that_would_not_be_read_again_stays_as_it_was(tmp_path):
    table = tmp_path / "measurements.csv"
    table.write_text(TABLE)
    with pytest.raises(InputError, match="'a1' is already in line 2"):
        append_rows(table, [TABLE.splitlines()[1].split(",")])
    assert table.read_text() == TABLE
    assert [path.name for path in tmp_path.iterdir()] == ["measurements.csv"]
