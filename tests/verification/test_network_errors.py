"""The arithmetic of the studies of the network's errors and of the losses, on made-up networks."""

import sys
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification" / "studies"))

from error_scales import (  # noqa: E402
    SCALES,
    by_region,
    error_table,
    percent_errors,
    without_worst,
)
from error_spreads import (  # noqa: E402
    MEMBERS,
    NEAREST,
    coverage_table,
    local_spread,
    log_density,
)
from held_out_runs import among, held_out_runs, part_of  # noqa: E402
from loss_samples import MARGIN, learning_rate, samples_of, split, unit_scale  # noqa: E402
from losses import words as loss_words  # noqa: E402
from network_error_words import words  # noqa: E402
from network_errors import study  # noqa: E402

INPUTS = {  # name: transform, range; the length is the same in all runs
    "velocity_m_s": ("linear", 20, 120),
    "initial_length_mm": ("linear", 40, 40),
    "rho_immobile_initial": ("log10", 1e10, 1e15),
    "hardening_coefficient": ("square_root", 0, 10),
    "immobilization_velocity": ("square_root", 0, 5),
}
SHAPES = ["truncated_cone", "uniform_cylinder"]
RUNS = 120


def made_up_emulator(cheaper=True):
    """The document of an emulator of one hidden neuron, which errs by 0.001 (one in 100: 0.05)."""
    random = np.random.default_rng(5)
    used = [name for name, (_, low, high) in INPUTS.items() if low < high]
    infos = [
        {"name": n, "transform": t, "lower": a, "upper": b, "shift": 0, "scale": 1, "used": a < b}
        for n, (t, a, b) in INPUTS.items()
    ]
    points = {name: random.uniform(*INPUTS[name][1:], RUNS) for name in used}
    points["rho_immobile_initial"] = 10 ** random.uniform(10, 15, RUNS)
    seen = {"linear": lambda x: x, "log10": np.log10, "square_root": np.sqrt}
    places = np.array([seen[INPUTS[name][0]](points[name]) for name in used]).T
    shapes = [SHAPES[k % 2] for k in range(RUNS)]
    members = []
    for shift in (0, 0.001, -0.001):
        # Of the velocity and the second shape; the cheaper runs' column would spoil all.
        weights = [0.01, 0, 0, 0, 0, 0.5] + ([99] if cheaper else [])
        layers = [{"weights": [weights], "bias": [0.1]}]
        layers.append({"weights": [[-0.2]], "bias": [0.9 + shift]})
        members.append({"layers": layers})
    before = 0.01 * points["velocity_m_s"] + 0.5 * (np.array(shapes) == SHAPES[1]) + 0.1
    network = 0.9 - 0.2 * before / (1 + np.exp(-before))
    error = 0.001 * random.choice([-1, 1], RUNS)
    error[::100] = 0.05
    pairs = [
        {"output": "final_length_mm", "shape": s, "solver": 40 * (y + e), "network": 40 * y}
        for s, y, e in zip(shapes, network, error)
    ]
    divide_by = ["initial_length_mm"]
    output = {"name": "final_length_mm", "shift": 0, "scale": 1, "divide_by": divide_by}
    held_out = {"categories": shapes, "places": places.tolist(), "errors": error[:, None].tolist()}
    return {
        "inputs": infos,
        "category": {"name": "shape", "values": SHAPES},
        "outputs": [output],
        "members": members,
        "best": 0,
        "corrects_cheaper_runs": cheaper,
        "validation": {"training_rows": 500, "pairs": pairs, "held_out": held_out},
    }


@pytest.mark.parametrize("cheaper", [False, True])
def test_the_members_answer_as_the_recipe_says(cheaper):
    model = made_up_emulator(cheaper)
    runs = held_out_runs(model)
    told = [pair["network"] for pair in model["validation"]["pairs"]]
    assert (runs.network * runs.divisors)[:, 0] == pytest.approx(told, rel=1e-12)
    assert runs.members[1] - runs.members[0] == pytest.approx(0.001)
    assert set(runs.inputs["initial_length_mm"]) == {40}
    assert 1e10 < runs.inputs["rho_immobile_initial"].min()
    assert runs.inputs["hardening_coefficient"].between(0, 10).all()


def test_an_emulator_whose_members_do_not_answer_so_is_refused():
    model = made_up_emulator()
    model["members"][0]["layers"][1]["bias"] = [0.95]
    with pytest.raises(ValueError, match="final_length_mm by its members is .* Train it again"):
        held_out_runs(model, "emulator.json")
    del model["validation"]["held_out"]
    with pytest.raises(ValueError, match="emulator.json has no validation.held_out"):
        held_out_runs(model, "emulator.json")


def test_runs_of_a_second_round_are_known_by_their_inputs(tmp_path):
    runs = held_out_runs(made_up_emulator())
    second = np.arange(RUNS) % 3 == 0
    with h5py.File(tmp_path / "near_runs.h5", "w") as file:
        names = list(runs.inputs.columns[::-1])
        rows = runs.inputs[names][second].to_numpy() * (1 + 1e-6)
        file["inputs"] = np.vstack([rows[::-1], 1.01 * rows[:1]])
        file["inputs"].attrs.create("names", names, dtype=h5py.string_dtype())
    found = among(runs, tmp_path / "near_runs.h5")
    assert (found == second).all()
    first = part_of(runs, ~found)
    assert len(first.shapes) == len(first.inputs) == first.members.shape[1] == RUNS - second.sum()
    assert (first.network == runs.network[~second]).all()


def test_both_scales_of_an_error():
    solver = np.array([[1.0, 10], [3, 30], [10, 10], [10, np.nan]])
    network = solver + [[0.1, 1], [-0.1, 0], [0.2, 0], [0, 1]]
    shapes = np.array(["a", "a", "b", "b"])
    errors = percent_errors(solver, network, shapes)
    assert errors["mean"][:, 0] == pytest.approx([5, -5, 2, 0])
    assert errors["range"][:, 0] == pytest.approx([100 / 90, -100 / 90, 200 / 90, 0])
    table = error_table(errors, ["y", "z"], shapes).set_index(["output", "shape"])
    assert table.loc[("y", "all"), "largest_percent_of_mean"] == pytest.approx(5)
    assert table.loc[("y", "b"), "rms_percent_of_mean"] == pytest.approx(2**0.5)
    assert table.loc[("z", "b"), "n"] == 1
    assert table.loc[("all", "all"), "n"] == 7
    assert table.loc[("z", "a"), "largest_percent_of_range"] == pytest.approx(5)


def test_the_worst_runs_are_left_out():
    values = np.full((100, 2), 1.0)
    values[7] = 10, -10
    found = without_worst({"mean": values, "range": values / 2}, [0, 0.01])
    assert found["left_out"].tolist() == [0, 1]
    assert found["rms_percent_of_mean"].tolist() == pytest.approx([(1.99) ** 0.5, 1])
    assert found["rms_percent_of_range"].tolist()[1] == pytest.approx(0.5)


def test_every_run_is_in_one_region_and_the_ends_count():
    inputs = pd.DataFrame({"a": [0, 0.5, 1, 2, 2], "b": [0, 1, 1, 1, 0.1]})
    values = np.arange(1.0, 6)[:, None]
    cells = by_region({"mean": values, "range": values}, inputs, {"a": [0, 1, 2], "b": [0, 0.5, 1]})
    assert cells["runs"].tolist() == [1, 1, 1, 2]
    assert cells["rms_percent_of_mean"].tolist() == pytest.approx([1, 2, 5, (12.5) ** 0.5])


def test_the_factor_of_one_half_makes_the_other_halfs_coverage():
    random = np.random.default_rng(3)
    size = random.uniform(1, 5, (4000, 2))
    errors = size * random.normal(size=size.shape)
    table = coverage_table(errors, ["y", "z"], {MEMBERS: size / 2, NEAREST: size})
    table = table.set_index(["spread", "scaled", "output"])
    assert table.loc[(MEMBERS, "as it is", "all"), "within_1"] == pytest.approx(0.383, abs=0.02)
    scaled = table.loc[(MEMBERS, "to 68 %", "z")]
    assert scaled["factor"] == pytest.approx(2, rel=0.05)
    assert scaled["within_1"] == pytest.approx(0.683, abs=0.03)
    assert scaled["within_2"] == pytest.approx(0.954, abs=0.02)
    assert table.loc[(NEAREST, "likelihood", "all"), "within_1"] == pytest.approx(0.917, abs=0.02)
    assert log_density(errors, size) > log_density(errors, 1.3 * size)
    assert log_density(errors, size) > log_density(errors, np.full_like(size, 3.2))


def test_the_nearest_runs_tell_the_error_without_the_run_itself():
    places = np.arange(100.0)[:, None]
    errors = np.where(places < 50, 1.0, 3.0)
    errors[20] = 100
    spread = local_spread(errors, np.array(["a"] * 100), places)
    # The run itself is in no sum: its neighbours err by 1, the whole (one of 31) by up to 3.
    assert spread[20, 0] == pytest.approx(((30 + (49 + 450 + 5 * 499 / 99) / 104) / 31) ** 0.5)
    assert spread[95, 0] == pytest.approx(((270 + 10490 * (1 + 5 / 99) / 104) / 31) ** 0.5)
    assert spread[21, 0] > 15
    few = local_spread(errors[:20], np.array(["a"] * 20), places[:20])
    assert few == pytest.approx(1)


def test_the_text_tells_what_was_put_in():
    model = made_up_emulator()
    runs = held_out_runs(model)
    errors, _, tables = study(runs)
    text = words(model, runs, errors, tables)
    assert "Network of 1 x 1 neurons, best of 3 members; learnt from 500 runs" in text
    assert tables["errors"].iloc[-1]["n"] == RUNS
    assert tables["left_out"]["rms_percent_of_mean"].iloc[-1] < 0.2
    assert sum(tables["regions"][0]["runs"]) == RUNS


def write_runs(path, first, velocities, status):
    text = h5py.string_dtype(encoding="utf-8")
    count = len(velocities)
    with h5py.File(path, "w") as file:
        file["run_id"] = first + np.arange(count)
        file["status"] = status
        file.create_dataset("shape", data=[SHAPES[k % 2] for k in range(count)], dtype=text)
        file["inputs"] = np.array([velocities, np.full(count, 40.0)]).T
        file["inputs"].attrs.create("names", ["velocity_m_s", "initial_length_mm"], dtype=text)
        file["outputs"] = (40 - 0.1 * np.array(velocities))[:, None]
        file["outputs"].attrs.create("names", ["final_length_mm"], dtype=text)


def test_samples_are_standardised_and_the_last_input_is_the_solver(tmp_path):
    write_runs(tmp_path / "coarse.h5", 0, np.linspace(20, 100, 9), [0] * 8 + [1])
    write_runs(tmp_path / "fine.h5", 9, np.linspace(30, 90, 10), [0] * 10)
    train = {
        "inputs": [{"name": "velocity_m_s"}, {"name": "initial_length_mm"}],
        "category": "shape",
        "outputs": [{"name": "final_length_mm", "divide_by": ["initial_length_mm"]}],
        "validation_fraction": 0.4,
    }
    found = samples_of(tmp_path / "coarse.h5", tmp_path / "fine.h5", train)
    assert found.inputs.shape == (18, 1 + 2 + 1)  # the length never varies
    assert found.inputs[:, -1].tolist() == [1] * 8 + [0] * 10
    assert found.held_out.sum() == 4 and not found.held_out[:8].any()
    learnt = found.inputs[~found.held_out, 0]
    assert (learnt.mean(), learnt.std()) == pytest.approx((0, 1))
    assert found.sizes[0, 0] == pytest.approx(38 / 40)


def test_the_split_goes_by_the_run_and_not_by_its_place():
    ids = np.arange(100, 200)
    shuffled = np.random.default_rng(1).permutation(ids)
    assert set(ids[split(ids, 0.47)]) == set(shuffled[split(shuffled, 0.47)])
    assert split(ids, 0.47).sum() == 47


def test_normalised_outputs_leave_room_at_both_ends():
    shift, scale = unit_scale(np.array([[2.0], [4.0]]))
    room = MARGIN / (1 + 2 * MARGIN)
    assert ((2 - shift) / scale)[0] == pytest.approx(room)
    assert ((4 - shift) / scale)[0] == pytest.approx(1 - room)
    assert learning_rate(0.01) == pytest.approx(0.5, rel=1e-3)
    assert learning_rate(1) == pytest.approx(0)


def test_losses_are_told_by_their_seeds():
    row = {"loss": "cross-entropy", "learning_rate": 0.01, "epochs": 5, "n": 10}
    figures = [f"{f}_percent_of_{s}" for f in ("rms", "usual_rms", "largest") for s in SCALES]
    rows = [{**row, "seed": k, **dict.fromkeys(figures, 1.0 + k)} for k in (1, 2, 9)]
    samples = type("Samples", (), {"held_out": np.array([True, False, False])})
    told = loss_words(pd.DataFrame(rows), samples)
    assert "2 runs to learn from, 1 held out; errors in %, median of 3 seeds" in told
    assert "3.00 (2.00 to 10.00)" in told
