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
LONG_DRAWS = 2_400_000


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


@pytest.fixture
def long_sampling(program, finished, tmp_path):
    """A sampling of some seconds."""
    stage = stages(program, finished.results, tmp_path)["sample"]
    settings = json.loads((finished.results / "config" / "calibrate.json").read_text())
    return stage.with_config(tmp_path / "calibrate.json", settings | {"draws": LONG_DRAWS})


def checkpoint_of_draws(stage):
    """1.5 s after the first: the search for a proposal is over by then."""
    path, begun = stage.out.with_name("posterior.h5.checkpoint"), []

    def seen(seconds):
        begun.extend([seconds] if path.exists() and not begun else [])
        return begun and seconds > begun[0] + 1.5

    return seen


@pytest.mark.parametrize("threads", [1, 2])
def test_a_killed_sampling_goes_on_where_it_was(long_sampling, threads):
    whole, _ = undisturbed(long_sampling)
    undisturbed_cpu_s = ended(long_sampling.command).cpu_s
    long_sampling.out.unlink()
    command = list(long_sampling.command)
    command[command.index("--threads") + 1] = str(threads)
    attempts, done = [], [0]
    for _ in range(2):
        attempts.append(ended(command, checkpoint_of_draws(long_sampling)))
        assert attempts[-1].killed and not long_sampling.out.exists()
    attempts.append(ended(command))
    for attempt in attempts[1:]:
        told = re.search(rf"sampling goes on after (\d+) of {LONG_DRAWS} draws", attempt.said)
        done.append(int(told[1]))
    assert 0 < done[1] < done[2] < LONG_DRAWS
    assert long_sampling.out.read_bytes() == whole
    assert not list(long_sampling.out.parent.glob("*checkpoint*"))
    wasted = sum(attempt.cpu_s for attempt in attempts) - undisturbed_cpu_s
    print(f"2 kills wasted {wasted:.2f} CPU s beside the {undisturbed_cpu_s:.2f} that count")
    a_second = 1 + 0.5  # between two checkpoints, and what starting anew costs
    assert wasted <= 2 * THREADS * a_second


def test_a_checkpoint_of_another_sampling_is_not_used(long_sampling, tmp_path):
    assert ended(long_sampling.command, checkpoint_of_draws(long_sampling)).killed
    settings = json.loads((tmp_path / "calibrate.json").read_text()) | {"draws": 2000}
    short = long_sampling.with_config(tmp_path / "calibrate.json", settings)
    assert "is of another sampling and is not used" in ended(short.command).said
    resumed = short.out.read_bytes()
    assert undisturbed(short)[0] == resumed
