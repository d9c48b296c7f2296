"""Reads rows as a spreadsheet saves or copies them; messages name the file and the line."""

import re
from pathlib import Path

from input_errors import InputError
from schema_check import load_schema
from table_cells import Records, read_text, split_cells

DECIMAL = re.compile(r"[+-]?\d+,\d+([eE][+-]?\d+)?")
OR_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")


def read_pasted(path: Path) -> tuple[list[str], Records]:
    """The header and (line, cells) of each row; numbers have decimal points.

    Tabs, semicolons or commas separate the cells, whichever the header has (in this order):
    no column's name has one. InputError for what is no table or has unclear commas.
    """
    text = read_text(path, _encoding(path))
    first = next((line for line in text.splitlines() if line.strip()), "")
    separator = next((sign for sign in "\t;" if sign in first), ",")
    header, records = split_cells(path, text, separator, "one row a shot")
    records = [(line, [" ".join(cell.split()) for cell in cells]) for line, cells in records]
    return header, _with_points(path, header, records)


def _encoding(path: Path) -> str:
    """Spreadsheets save "Unicode text" as UTF-16, which begins with a mark."""
    try:
        with path.open("rb") as file:
            return "utf-16" if file.read(2) in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from error


def _with_points(path: Path, header: list[str], records: Records) -> Records:
    """Commas in numbers become points if they cannot mean anything else in the whole file."""
    known = load_schema("measurements")["properties"]
    numeric = [known.get(name, {}).get("type") == "number" for name in header]
    numbers = [
        (line, name, cell)
        for line, cells in records
        for name, cell, is_number in zip(header, cells, numeric, strict=True)
        if is_number
    ]
    with_comma = [entry for entry in numbers if "," in entry[2]]
    if not with_comma:
        return records
    problem = _unclear(with_comma, next((entry for entry in numbers if "." in entry[2]), None))
    if problem:
        raise InputError(f"{path}, {problem}")
    return [
        (
            line,
            [
                cell.replace(",", ".") if is_number else cell
                for cell, is_number in zip(cells, numeric, strict=True)
            ],
        )
        for line, cells in records
    ]


def _unclear(with_comma: list[tuple], with_point: tuple | None) -> str:
    """Why the commas cannot be read as decimal signs, or an empty text."""
    remedy = "Write decimal points, and nothing between thousands."
    for line, name, cell in with_comma:
        if not DECIMAL.fullmatch(cell):
            return f"line {line}: {name} = {cell!r} (expected a number). {remedy}"
    line, name, cell = with_comma[0]
    if with_point:
        other, column, number = with_point
        return (
            f"line {line}: {name} = {cell!r} has a comma, while {column} = {number!r} in line "
            f"{other} has a point. {remedy}"
        )
    if all(OR_THOUSANDS.fullmatch(cell) for _, _, cell in with_comma):
        fraction, thousands = cell.replace(",", "."), cell.replace(",", "")
        return f"line {line}: {name} = {cell!r} may be {fraction} or {thousands}. {remedy}"
    return ""
