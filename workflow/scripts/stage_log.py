"""Sends what goes wrong in a stage to its log file."""

import sys
import traceback
from contextlib import contextmanager
from pathlib import Path

from input_errors import InputError


@contextmanager
def logged_to(path: str):
    """Ends the process on an error; one of the user's own is told without a traceback."""
    try:
        yield
    except Exception as error:
        told = f"{error}\n" if isinstance(error, InputError) else traceback.format_exc()
        Path(path).write_text(told, encoding="utf-8")
        sys.exit(1)
    Path(path).write_text("done\n", encoding="utf-8")
