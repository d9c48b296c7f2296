"""`kill -9` of each stage's program at random moments: nothing half-written is read, nothing
finished is lost, and the result has the bytes of an undisturbed run.
"""

import csv
import json
import re

import pytest
from stage_commands import QUICK_RUNS, Stage, ended, random_moments, stages

KILLS = 20
STAGES = ["runs", "merge", "train", "sample", "compare"]
THREADS = 2


def undisturbed(stage: Stage) -> tuple[bytes, float]:
    """The bytes of the result, which is taken away again, and the wall seconds."""
    seconds = ended(stage.command).wall_s
    result = stage.out.read_bytes()
    stage.out.unlink()
    return result, seconds


@pytest.mark.parametrize("name", STAGES)
def test_a_stage_killed_at_random_moments_gives_the_same_bytes(program, finished, tmp_path, name):
    stage = stages(program, finished.results, tmp_path)[name]
    if name == "runs":
        stage = stage.with_config(tmp_path / "quick.json", QUICK_RUNS)
        stage.command += ["--rows", "0:8"]
    whole, longest = undisturbed(stage)
    before = set(tmp_path.iterdir())
    kills = 0
    for moment in random_moments(name, longest, KILLS):
        kills += ended(stage.command, lambda seconds: seconds >= moment).killed
        if stage.out.exists():  # a name never holds half a result
            assert stage.out.read_bytes() == whole
            stage.out.unlink()
    assert kills >= KILLS // 4, "the moments were too late to test anything"
    ended(stage.command)
    assert stage.out.read_bytes() == whole
    left = set(tmp_path.iterdir()) - before
    assert left == {stage.out}, "journals, checkpoints and temporary files go with the last run"


def test_a_kill_wastes_at_most_one_run_a_thread(program, finished, tmp_path):
    stage = stages(program, finished.results, tmp_path)["runs"]
    stage.command += ["--rows", "0:8"]
    journal = tmp_path / "0.h5.journal.jsonl"

    def after(runs):
        return lambda _: journal.exists() and len(journal.read_text().splitlines()) > runs

    attempts = [ended(stage.command, after(runs)) for runs in (1, 3, 5)] + [ended(stage.command)]
    kills = sum(attempt.killed for attempt in attempts)
    with (tmp_path / "0.h5.cost.csv").open() as file:
        runs = [float(row["cpu_s"]) for row in csv.DictReader(file)]
    wasted = sum(attempt.cpu_s for attempt in attempts) - sum(runs)
    print(f"{kills} kills wasted {wasted:.2f} CPU s beside the {sum(runs):.2f} that count")
    starting = 0.1 * len(attempts)  # reading the design, writing the database
    assert kills == 3
    assert wasted <= kills * THREADS * max(runs) + starting


@pytest.fixture
def long_training(program, finished, tmp_path):
    """A training of some seconds, which makes checkpoints every second."""
    stage = stages(program, finished.results, tmp_path)["train"]
    settings = json.loads((finished.results / "config" / "train.json").read_text())
    settings |= {"epochs": 9000, "members": 2, "neurons": 24}
    return stage.with_config(tmp_path / "train.json", settings)


def has_checkpoint(stage):
    return lambda _: any(stage.out.parent.glob("emulator.json.checkpoint.?"))


def test_a_killed_training_goes_on_from_its_checkpoints(long_training):
    whole, _ = undisturbed(long_training)
    assert ended(long_training.command, has_checkpoint(long_training)).killed
    assert not long_training.out.exists()
    last = ended(long_training.command)
    assert re.search(r"member \d goes on after \d+ of 9000 epochs", last.said)
    assert long_training.out.read_bytes() == whole
    assert not list(long_training.out.parent.glob("*checkpoint*"))


def test_a_checkpoint_of_another_training_is_not_used(long_training, tmp_path):
    assert ended(long_training.command, has_checkpoint(long_training)).killed
    settings = json.loads((tmp_path / "train.json").read_text()) | {"epochs": 300}
    short = long_training.with_config(tmp_path / "train.json", settings)
    assert "is of another training and is not used" in ended(short.command).said
    resumed = short.out.read_bytes()
    assert undisturbed(short)[0] == resumed
