"""Sends what goes wrong in a stage to its log file."""

import sys
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

from input_errors import InputError
from job_log import logged_words

STARTED = time.perf_counter()


@contextmanager
def logged_to(path: str):
    """Ends the process on an error; one of the user's own is told without a traceback."""
    log = Path(path)
    try:
        yield
    except Exception as error:
        told = f"{error}\n" if isinstance(error, InputError) else traceback.format_exc()
        log.write_text(logged_words(told, STARTED), encoding="utf-8")
        sys.exit(1)
    log.write_text(logged_words("done", STARTED), encoding="utf-8")
