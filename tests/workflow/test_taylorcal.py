"""`taylorcal` says in a line what a user did wrong, and ends with a status that tells it."""

import os
import signal
import subprocess
import sys
import time
from functools import partial

import pytest
from tiny_study import NEW_ROW, ROOT, TABLE, make_workspace

from hdf5_file import opened
from input_errors import InputError
from json_file import read_json
from new_rows.append import append_rows
from print_summary import summary
from study import load_study

PROGRAM = [sys.executable, str(ROOT / "workflow" / "taylorcal")]


@pytest.fixture
def unbuilt(tmp_path):
    """The tiny study in a folder without programs."""
    return make_workspace(tmp_path / "unbuilt", tmp_path / "nothing")


def call(folder, *arguments: str, **streams) -> subprocess.CompletedProcess:
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **streams}
    return subprocess.run([*PROGRAM, *arguments], cwd=folder, text=True, **streams)


def refused(folder, *arguments: str) -> str:
    done = call(folder, *arguments)
    assert done.returncode in (1, 2)
    assert "Traceback" not in done.stderr
    return done.stderr


@pytest.mark.parametrize("command", ["calibrate", "compare", "diagnose", "why"])
def test_without_programs_nothing_is_shown(unbuilt, command):
    assert "build/bin/solver, build/bin/emulator, build/bin/calibrate: " in refused(
        unbuilt.folder, command, "tiny"
    )
    assert "make build" in refused(unbuilt.folder, command, "tiny")


@pytest.mark.parametrize("cores", ["0", "-1", "abc", "1.5", ""])
def test_cores_are_all_or_a_number(unbuilt, cores):
    told = refused(unbuilt.folder, "calibrate", "tiny", f"--cores={cores}")
    assert f"--cores: {cores} (expected all, or a whole number from 1)" in told


@pytest.mark.parametrize(
    "name, expected",
    [
        ("2024", "study = 2024 (expected a folder of experiments/ with a name of letters"),
        ("1e3", "begins with a letter). Known here: tiny."),
        ("tinny", "there is no such study. Did you mean 'tiny'?"),
        ("../tiny", "Did you mean 'tiny'?"),
    ],
)
def test_a_name_that_is_no_study_is_refused(unbuilt, name, expected):
    assert expected in refused(unbuilt.folder, "cost", name)


@pytest.mark.parametrize("name", ["experiments/tiny", "tiny/", "./experiments/tiny/"])
def test_a_folder_stands_for_its_study(unbuilt, name):
    done = call(unbuilt.folder, "cost", name)
    assert done.returncode == 0, done.stderr


def test_a_study_that_comes_as_a_number_is_refused():
    with pytest.raises(InputError, match="study = 2024 "):
        load_study(2024)


def test_an_unknown_key_of_config_is_refused(unbuilt):
    command = ["/usr/bin/snakemake", "--cores", "1", "--dry-run", "--config", "stdy=tiny"]
    done = subprocess.run(command, cwd=unbuilt.folder, capture_output=True, text=True)
    assert done.returncode != 0
    assert (
        "--config stdy=tiny: is not a known key. Did you mean 'study'?" in done.stdout + done.stderr
    )


def test_it_names_the_folder_to_run_it_from(tmp_path):
    assert f"Run it from the root: cd {ROOT}" in refused(tmp_path, "cost", "tiny")


def test_a_reader_who_has_enough_ends_it(unbuilt):
    reading, writing = os.pipe()
    os.close(reading)
    done = call(unbuilt.folder, "cost", "tiny", stdout=writing)
    os.close(writing)
    assert (done.returncode, done.stderr) == (1, "")


def test_a_full_disk_below_the_output_is_told(unbuilt):
    with open("/dev/full", "w") as full:
        done = call(unbuilt.folder, "cost", "tiny", stdout=full)
    assert done.returncode == 1
    assert done.stderr.startswith("taylorcal: standard output: cannot be read or written (No space")
    assert "Traceback" not in done.stderr


def test_a_file_that_cannot_be_written_is_named(fresh):
    (fresh.study / "study.yaml.tmp").mkdir()
    told = refused(fresh.folder, "add-effect", "tiny", "anvil_friction")
    assert "study.yaml.tmp: cannot be read or written (Is a directory)" in told


def test_damaged_results_are_named(tmp_path):
    with pytest.raises(InputError, match="holds no comparison.json"):
        summary(tmp_path)
    (tmp_path / "comparison.json").write_text('{"parameters": [')
    with pytest.raises(InputError, match="comparison.json, line 1: .*Delete the file"):
        summary(tmp_path)
    (tmp_path / "posterior.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    with pytest.raises(InputError, match="posterior.h5: cannot be read .*Delete it"):
        with opened(tmp_path / "posterior.h5"):
            pass
    with pytest.raises(InputError, match="nowhere.json: cannot be read .No such file"):
        read_json(tmp_path / "nowhere.json")


def test_rows_appended_at_once_are_all_kept(tmp_path):
    table = tmp_path / "measurements.csv"
    table.write_text(TABLE)
    append = "import sys, pathlib, new_rows.append as a; "
    append += "a.append_rows(pathlib.Path(sys.argv[1]), [sys.argv[2].split(',')])"
    scripts = {**os.environ, "PYTHONPATH": str(ROOT / "workflow" / "scripts")}
    rows = [
        NEW_ROW.strip().replace("b2", f"c{n}").replace(",130,", f",13{n + 1},") for n in range(4)
    ]
    running = [
        subprocess.Popen([sys.executable, "-c", append, str(table), row], env=scripts)
        for row in rows
    ]
    assert [process.wait() for process in running] == [0] * 4
    assert sorted(table.read_text().splitlines()[-4:]) == rows
    append_rows(table, [NEW_ROW.strip().split(",")])


def test_an_interrupt_ends_the_workflow_and_leaves_no_lock(fresh):
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    command = [*PROGRAM, "calibrate", "tiny", "--cores", "1"]
    # Where tests run in the background interrupts may be ignored, which children inherit.
    heeded = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    own = {"start_new_session": True, "preexec_fn": heeded}
    process = subprocess.Popen(command, cwd=fresh.folder, **own, **pipes)
    locks = fresh.folder / ".snakemake" / "locks"
    deadline = time.monotonic() + 120
    while not (locks.exists() and len(list(locks.iterdir())) == 2):
        assert process.poll() is None and time.monotonic() < deadline
        time.sleep(0.05)
    time.sleep(1)
    os.killpg(process.pid, signal.SIGINT)
    told = process.communicate(timeout=120)[1]
    assert process.returncode == 130
    assert told == "taylorcal: stopping; what is finished is kept.\n"
    assert not list(locks.iterdir())
