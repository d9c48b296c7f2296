"""Writes files so that nobody ever reads half of one, whatever is killed or fails."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_whole(path: str | Path) -> Iterator[Path]:
    """A temporary name beside `path` to write to. The file takes its place and its rights if all
    goes well; otherwise it goes. A link stays a link.
    """
    path = Path(path).resolve()
    partial = path.with_name(path.name + ".tmp")
    try:
        yield partial
        if path.exists():
            shutil.copymode(path, partial)
        _to_disk(partial)
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)
    _to_disk(path.parent)  # the new name, too


def write_text(path: str | Path, text: str) -> None:
    with written_whole(path) as partial:
        partial.write_text(text, encoding="utf-8")


def _to_disk(path: Path) -> None:
    place = os.open(path, os.O_RDONLY)
    try:
        os.fsync(place)
    finally:
        os.close(place)
