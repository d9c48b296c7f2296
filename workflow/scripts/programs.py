"""The programs that make build compiles, which every stage calls."""

import os
from pathlib import Path

from input_errors import InputError

PROGRAMS = Path("build") / "bin"
NAMES = ("solver", "emulator", "calibrate")


def check_programs() -> None:
    """Snakemake takes results without their programs for finished ones."""
    missing = [name for name in NAMES if not os.access(PROGRAMS / name, os.X_OK)]
    if missing:
        paths = ", ".join(str(PROGRAMS / name) for name in missing)
        raise InputError(f"{paths}: cannot be run, or not built yet. Build all first: make build")
