"""Splits a CSV table into cells and reads their numbers, as the programs do: see
common/csv_table.cpp, which would refuse later what is let pass here.
"""

import csv
import io
import math
import re
from pathlib import Path

from input_errors import InputError

SEPARATORS = {",": "comma", ";": "semicolon", "\t": "tab"}
NUMBER = re.compile(r"-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
BLANKS = " \t"
WORKBOOKS = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0")  # .xlsx or .ods, and .xls
SAVE_AS = "Save it as CSV UTF-8 (comma delimited)."

Records = list[tuple[int, list[str]]]


def number_in(cell: str) -> float | None:
    """None for what is no number, with ASCII digits and a decimal point alone."""
    value = float(cell) if NUMBER.fullmatch(cell) else math.inf
    return value if math.isfinite(value) else None


def read_cells(path: Path, rows: str) -> tuple[list[str], Records]:
    """The header and (line, cells) of each row; `rows` says in messages what a row is."""
    text = read_text(path, "utf-8-sig")
    bare = re.search("\r(?!\n)", text)
    if bare:
        line = 1 + len(re.findall("\r\n?|\n", text[: bare.start()]))
        raise InputError(f"{path}, line {line}: ends in CR alone (expected LF). {SAVE_AS}")
    _check_separator(path, text)
    return split_cells(path, text, ",", rows)


def read_text(path: Path, encoding: str) -> str:
    """The text with its line ends as they are."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from error
    if content.startswith(WORKBOOKS):
        raise InputError(f"{path}: is a workbook of a spreadsheet (expected text). {SAVE_AS}")
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        line = 1 + content[: error.start].count(b"\n")
        found = f"the byte 0x{content[error.start]:02x}, {error.reason}"
        raise InputError(
            f"{path}, line {line}: is not text in UTF-8 ({found}). {SAVE_AS}"
        ) from error


def split_cells(path: Path, text: str, separator: str, rows: str) -> tuple[list[str], Records]:
    """As `read_cells`, of the text of `path` with cells between separators. Rows of empty cells
    are left out, and blanks around a cell.
    """
    name = SEPARATORS[separator]
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    table, line = [], 1
    try:
        for cells in reader:
            cells = [cell.strip(BLANKS) for cell in cells]
            table += [(line, cells)] if any(cells) else []
            line = reader.line_num + 1
    except csv.Error as error:
        problem = f"is not a {name}-separated table: {error}. Double the quotes within a cell."
        raise InputError(f"{path}, line {line}: {problem}") from error
    if not table:
        raise InputError(f"{path}: the table is empty (expected a header and {rows}).")
    first, header = table[0]
    for column in header:
        if header.count(column) > 1:
            raise InputError(f"{path}, line {first}: column {column!r} is there twice.")
    for line, cells in table[1:]:
        if len(cells) != len(header):
            raise InputError(
                f"{path}, line {line}: {len(cells)} cells (expected {len(header)}, as in the "
                f"header). Put a text with {name}s in quotes, and write decimal points."
            )
    return header, table[1:]


def _check_separator(path: Path, text: str) -> None:
    """A spreadsheet of some languages separates by semicolons, and writes decimal commas."""
    first = next((line for line in text.splitlines() if line.strip()), "")
    for sign in ";\t":
        if first.count(sign) > first.count(","):
            raise InputError(
                f"{path}, line 1: cells are separated by {SEPARATORS[sign]}s (expected commas, and "
                "decimal points). Save it so, or append its rows to a table that has commas: "
                "workflow/taylorcal add-rows"
            )
