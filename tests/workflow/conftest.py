"""Fixtures that every workflow test shares."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    """Path of a built program by name; TAYLORCAL_BUILD names another build folder."""

    def find(name):
        path = Path(os.environ.get("TAYLORCAL_BUILD", ROOT / "build")) / "bin" / name
        assert path.exists(), f"{path} is missing: run `make build` first"
        return str(path)

    return find
