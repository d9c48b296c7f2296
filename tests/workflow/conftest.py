"""Fixtures that every workflow test shares."""

import os
from pathlib import Path

import pytest
from tiny_study import ROOT, STUDY, copy_workspace, make_workspace, write_study

from study import read_study


@pytest.fixture(scope="session")
def build():
    """The build folder; TAYLORCAL_BUILD names another one."""
    return Path(os.environ.get("TAYLORCAL_BUILD", ROOT / "build"))


@pytest.fixture(scope="session")
def program(build):
    """Path of a built program by name."""

    def find(name):
        path = build / "bin" / name
        assert path.exists(), f"{path} is missing: run `make build` first"
        return str(path)

    return find


@pytest.fixture
def tiny_study(tmp_path):
    """The validated content of the tiny study."""
    return read_study(write_study(tmp_path / STUDY) / "study.yaml")


@pytest.fixture
def fresh(program, build, tmp_path):
    """The tiny study with nothing run yet."""
    for name in ("solver", "emulator", "calibrate"):
        program(name)
    return make_workspace(tmp_path / "fresh", build)


@pytest.fixture(scope="session")
def finished(program, build, tmp_path_factory):
    """The tiny study, run once from nothing. Tests leave it as it is."""
    for name in ("solver", "emulator", "calibrate"):
        program(name)
    workspace = make_workspace(tmp_path_factory.mktemp("finished"), build)
    done = workspace.run("--show-failed-logs")
    assert done.returncode == 0, done.stdout
    return workspace


@pytest.fixture
def copied(finished, tmp_path):
    """A copy of the finished study that a test may change."""
    return copy_workspace(finished, tmp_path / "copy")
