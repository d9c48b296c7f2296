"""Opens HDF5 files of the programs, and names a file that is damaged."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py

from input_errors import InputError


@contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """InputError when it is not HDF5, cut short, or lacks what is read inside."""
    try:
        with h5py.File(path) as file:
            yield file
    except (OSError, KeyError) as error:
        problem = " ".join(str(error).split())
        raise InputError(f"{path}: cannot be read ({problem}). Delete it and run again.") from error
