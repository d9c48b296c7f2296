"""The command lines of the emulator and of the calibration: what they refuse, and how."""

import json
import subprocess

import pytest
from tiny_study import ROOT

NETWORK = ROOT / "tests/discovery/study/emulator.json"
FILES = ["--config", "no.json", "--measurements", "no.csv", "--emulator", "no.json"]
COMMANDS = {
    ("emulator", "train"): ["no.h5", "--config", "no.json"],
    ("calibrate", "sample"): FILES,
    ("calibrate", "compare"): [*FILES, "--posterior", "no.h5"],
    ("calibrate", "diagnose"): [
        *FILES, "--posterior", "no.h5", "--signatures", "no.h5", "--candidates", "no.json",
    ],
}  # fmt: skip


@pytest.fixture
def run(program, tmp_path):
    """Runs a program in an empty folder; returns the finished process."""

    def run_program(name, *arguments, **options):
        command = [program(name), *map(str, arguments)]
        options = {"stdout": subprocess.PIPE, **options}
        return subprocess.run(
            command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, timeout=60, **options
        )

    return run_program


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_an_output_without_a_place_is_told_before_the_computation(run, tmp_path, command):
    (tmp_path / "folder").mkdir()
    for out, words in [("absent/out", "no folder absent"), ("folder", "it is a folder")]:
        done = run(*command, *COMMANDS[command], "--out", out)
        assert done.returncode == 1
        assert f"{out}: cannot be written" in done.stderr and words in done.stderr


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_an_output_that_is_an_input_is_refused(run, tmp_path, command):
    (tmp_path / "no.json").write_text("kept")
    done = run(*command, *COMMANDS[command], "--out", "no.json")
    assert done.returncode == 1
    assert "no.json: is an input of this command" in done.stderr
    assert (tmp_path / "no.json").read_text() == "kept"


@pytest.mark.parametrize("threads", ["-1", "1025", "100000", "99999999999999999999"])
@pytest.mark.parametrize("command", [c for c in COMMANDS if c[1] != "compare"], ids=" ".join)
def test_threads_have_bounds(run, command, threads):
    done = run(*command, *COMMANDS[command], "--out", "out", "--threads", threads)
    assert done.returncode == 1
    assert f"--threads: {threads} (expected a whole number from 0 to 1024" in done.stderr


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_missing_input_is_told(run, command):
    threads = [] if command[1] == "compare" else ["--threads", 0]
    done = run(*command, *COMMANDS[command], *threads, "--out", "out")
    assert done.returncode == 1 and "no.json: cannot be read" in done.stderr


def test_predictions_that_cannot_be_printed_are_an_error(run):
    inputs = json.loads(NETWORK.read_text())["inputs"]
    point = [word for i in inputs for word in ("--set", f"{i['name']}={i['upper']!r}")]
    command = ["emulator", "predict", NETWORK, *point, "--category", "uniform_cylinder"]
    assert run(*command).stdout.startswith("shape,")
    with open("/dev/full", "w") as full:
        done = run(*command, stdout=full)
    assert done.returncode == 2
    assert "standard output: not all of the results could be written" in done.stderr


@pytest.mark.parametrize("name", ["emulator", "calibrate"])
def test_a_wrong_subcommand_is_named(run, name):
    done = run(name, "tran")
    assert done.returncode == 1
    assert done.stderr.startswith(f'{name}: "tran" is no subcommand')
