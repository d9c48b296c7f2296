"""A handful of blind tables of one metal, in small/, through the real programs."""

import csv
import io
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from candidate_lists import write_candidates, write_part
from make_tables import is_listed
from network import Network
from plan import ALL

HERE = Path(__file__).parent
STUDY, SMALL = HERE / "study", HERE / "small"
BUILD = Path(os.environ.get("TAYLORCAL_BUILD", HERE.parents[1] / "build"))


def run(program: str, *arguments) -> str:
    path = BUILD / "bin" / program
    assert path.exists(), f"{path} is missing: run `make build` first"
    command = [path, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def listed(tmp_path_factory):
    """The list of candidates without the constants that double an effect."""
    folder = tmp_path_factory.mktemp("list")
    candidates = json.loads((STUDY / "candidates.json").read_text())["candidates"]
    kept = [item for item in candidates if is_listed(item["name"], ALL)]
    write_candidates(folder / "candidates.json", kept)
    dropped = [item for item in candidates if item not in kept]
    for part in ("signatures.h5", "signatures_finer.h5"):
        write_part(SMALL / part, folder / part, dropped)
    return folder


def diagnose(table: Path, listed: Path, folder: Path) -> dict:
    """As the workflow does it."""
    inputs = ["--config", STUDY / "calibrate.json", "--emulator", STUDY / "emulator.json"]
    inputs += ["--measurements", table / "measurements.csv"]
    posterior, diagnosis = folder / "posterior.h5", folder / "diagnosis.json"
    run("calibrate", "sample", *inputs, "--out", posterior)
    lists = ["--signatures", listed / "signatures.h5", "--finer", listed / "signatures_finer.h5"]
    lists += ["--candidates", listed / "candidates.json", "--posterior", posterior]
    run("calibrate", "diagnose", *inputs, *lists, "--out", diagnosis)
    return json.loads(diagnosis.read_text())


@pytest.mark.parametrize("table", sorted(SMALL.glob("*/")), ids=lambda folder: folder.name)
def test_the_diagnosis_says_what_is_hidden(table, listed, tmp_path):
    verdict = diagnose(table, listed, tmp_path)["verdict"]
    assert len(verdict["networks"]) == 2
    truth = json.loads((table / "truth.json").read_text())
    if truth["kind"] == "null":
        assert not verdict["flagged"] and verdict["kind"] == "no effect supported"
    elif truth["kind"] == "bad shot":
        assert verdict["kind"] == "bad data"
        assert truth["corrupted"]["id"] in verdict["shots"]
    else:
        assert verdict["flagged"]
        assert set(truth["effects"]) <= set(verdict["effects"])


def test_the_network_in_numpy_is_the_programs():
    """The scorer's network reads emulator.json by its own recipe."""
    network = Network.from_file(STUDY / "emulator.json")
    names = [item["name"] for item in network.inputs]
    point = {name: (low * high) ** 0.5 for name, (low, high) in network.ranges.items()}
    for shape in ("uniform_cylinder", "truncated_cone"):
        settings = [word for name in names for word in ("--set", f"{name}={point[name]!r}")]
        text = run("emulator", "predict", STUDY / "emulator.json", *settings, "--category", shape)
        row = next(csv.DictReader(io.StringIO(text)))
        expected = [float(row[size]) for size in network.outputs]
        sizes = network.sizes(shape, {name: np.array(value) for name, value in point.items()})
        assert sizes == pytest.approx(expected, rel=1e-5)
