"""Appends rows to a table so that it is whole at any moment, and keeps what is there."""

import csv
import fcntl
import io
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from atomic_file import written_whole
from input_errors import InputError
from measurements import read_measurements
from table_cells import read_cells


def arranged(path: Path, header: list[str], cells: list[str]) -> list[str]:
    """The cells of a row in the order of the table's own columns; InputError if it lacks one."""
    table_header, _ = read_cells(path, "one row a shot")
    given = dict(zip(header, cells, strict=True))
    for name, cell in given.items():
        if cell and name not in table_header:
            raise InputError(
                f"{path}, line 1: the table has no column {name}, which the new rows fill in "
                f"({cell}). Add it to the table's header, with empty cells below, or leave it out."
            )
    return [given.get(name, "") for name in table_header]


def with_rows(content: bytes, rows: list[list[str]]) -> bytes:
    """The table with the rows below, its bytes as they were, with its own kind of line end."""
    end = "\r\n" if content.partition(b"\n")[0].endswith(b"\r") else "\n"
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator=end).writerows(rows)
    gap = b"" if content.endswith(b"\n") else end.encode()
    return content + gap + text.getvalue().encode("utf-8")


def append_rows(path: Path, rows: list[list[str]]) -> None:
    """Writes the longer table beside the old one, reads it back, and puts it in its place: one
    process at a time, or each would write a table without the rows of the other.
    """
    with _alone_in(path.parent), written_whole(path) as partial:
        partial.write_bytes(with_rows(path.read_bytes(), rows))
        read_measurements(partial)


@contextmanager
def _alone_in(folder: Path) -> Iterator[None]:
    """Waits for others; the system lets go of the folder however this process ends."""
    place = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(place, fcntl.LOCK_EX)
        yield
    finally:
        os.close(place)
