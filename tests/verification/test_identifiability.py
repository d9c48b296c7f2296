"""Identifiability on paired runs whose answers are known: a linear model stands for the solver."""

import json
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification" / "studies"))

import identifiability  # noqa: E402
from identifiability_runs import HOT_K, ROOM_K, SHAPES, VELOCITIES_M_S, paired_design  # noqa: E402
from paired_runs import read_pairs  # noqa: E402

from make_synthetic_table import TRUTH  # noqa: E402

FRACTIONS = ((np.arange(40) + 0.5) / 40) ** 1.5
EFFECTS = {"like_hardening": 2.0, "shape_only": 1.0, "when_hot": 1.0}
SIZES = ["final_length_mm", "impact_diameter_mm", "head_length_mm"]
SIZES += ["rear_length_mm", "transition_diameter_mm"]


def linear_answers(design):
    """Sizes [runs x 5] and outlines [runs x 40], linear in the inputs."""
    at = dict(zip(design["names"], design["inputs"].T))
    v = at["velocity_m_s"] / 100
    density = np.log(at["rho_immobile_initial"] / TRUTH["rho_immobile_initial"])
    hardening = at["hardening_coefficient"] - TRUTH["hardening_coefficient"]
    immobile = at["immobilization_velocity"] - TRUTH["immobilization_velocity"]
    hardening = hardening + 0.1 * at["like_hardening"]
    warm = (at["initial_temperature_K"] - ROOM_K) / ROOM_K
    strength = 0.05 * density + 0.04 * v * hardening + 0.03 * immobile * v**2
    # Cold, it is the density over again; its share that grows with heat is not.
    strength = strength + 0.02 * at["when_hot"] * (1 - warm)
    length = 40 - 5 * v * (1 - strength)
    sizes = np.column_stack(
        [length, 8 + 3 * v * (1 - strength), 0.2 * length, 0.8 * length, 8 + v * (1 - strength)]
    )
    z = FRACTIONS[None, :]
    foot = 0.4 * (v * (1 - strength))[:, None] * np.exp(-5 * z)
    belly = 0.05 * at["shape_only"][:, None] * np.sin(np.pi * z) ** 2
    return sizes, 1 + foot + belly


def answered(path, design):
    text = h5py.string_dtype(encoding="utf-8")
    sizes, outlines = linear_answers(design)
    with h5py.File(path, "w") as file:
        for name in ("run_id", "seed", "inputs"):
            file[name] = design[name]
        file["inputs"].attrs.create("names", design["names"], dtype=text)
        file.create_dataset("shape", data=design["shape"], dtype=text)
        file["outputs"] = sizes
        file["outputs"].attrs.create("names", SIZES, dtype=text)
        file["outline_radius"] = outlines
        file["outline_radius"].attrs["fractions"] = FRACTIONS
        file["status"] = np.zeros(len(sizes), dtype=np.int64)
        file.attrs["configuration"] = json.dumps({"fidelity": "coarse"})
        file.attrs["provenance"] = json.dumps({"revision": "abc"})
    return path


@pytest.fixture(scope="module")
def database(tmp_path_factory):
    path = tmp_path_factory.mktemp("identifiability") / "database.h5"
    return answered(path, paired_design(EFFECTS))


def test_each_specimen_has_a_base_and_one_change_a_run():
    design = paired_design(EFFECTS)
    runs = 1 + len(TRUTH) + len(EFFECTS)
    specimens = len(SHAPES) * len(VELOCITIES_M_S) * 2
    assert len(design["run_id"]) == runs * specimens
    assert len(set(design["seed"])) == specimens
    first = design["inputs"][:runs]
    assert [(row != first[0]).sum() for row in first] == [0] + [1] * (runs - 1)
    assert set(design["inputs"][:, 3]) == {ROOM_K, HOT_K}


def test_pairs_are_recognised(database):
    runs = read_pairs(database)
    assert runs.amplitudes == pytest.approx(
        {
            "rho_immobile_initial": 0.5 * TRUTH["rho_immobile_initial"],
            "hardening_coefficient": 0.4,
            "immobilization_velocity": 0.15,
            **EFFECTS,
        }
    )
    slow = next(pair for pair in runs.pairs if pair.shot["velocity_m_s"] == 40)
    assert slow.changes["hardening_coefficient"]["final_length_mm"] == pytest.approx(
        5 * 0.4 * 0.04 * 0.4 * 0.4, rel=1e-6
    )


def test_a_run_that_did_not_stop_leaves_its_specimen_out(database, tmp_path):
    path = tmp_path / "database.h5"
    path.write_bytes(database.read_bytes())
    with h5py.File(path, "r+") as file:
        file["status"][1] = 1
    assert len(read_pairs(path).pairs) == len(read_pairs(database).pairs) - 1


def test_a_specimen_whose_neighbours_are_left_out_keeps_its_slope(database, tmp_path):
    path = tmp_path / "database.h5"
    path.write_bytes(database.read_bytes())
    changes = len(TRUTH) + len(EFFECTS)
    with h5py.File(path, "r+") as file:
        for specimen in range(1, len(VELOCITIES_M_S)):  # all but the slowest of one shape
            file["status"][(1 + changes) * specimen + 1] = 1
    lost, whole = read_pairs(path), read_pairs(database)
    assert len(lost.pairs) == len(whole.pairs) - len(VELOCITIES_M_S) + 1
    few, all_of_them = (identifiability.whitened_changes(r, False, [ROOM_K]) for r in (lost, whole))
    slowest = slice(0, len(SIZES))
    for name, change in few.items():  # with as many shots shared by fewer specimens
        ratio = (len(SHAPES) * len(VELOCITIES_M_S) / (len(change) / len(SIZES))) ** 0.5
        assert change[slowest] == pytest.approx(ratio * all_of_them[name][slowest])


def test_the_table_tells_what_can_be_seen(database):
    table = identifiability.tabulate(read_pairs(database)).set_index(["effect", "measured"])
    share = table["identifiability"]
    # What a parameter does is invisible whatever is measured.
    assert share["like_hardening"].max() < 1e-6
    # What only the outline shows needs the outline.
    assert table["whole_signal"]["shape_only", "sizes"] == pytest.approx(0, abs=1e-6)
    assert share["shape_only", "sizes, outlines"] > 0.5
    assert table["signal"]["shape_only", "sizes, outlines"] > identifiability.TELLING
    # What follows temperature needs hot shots.
    assert share["when_hot", "sizes"] < 1e-6
    assert share["when_hot", "sizes, hot shots"] > 0.1


def test_table_and_figure_are_written(database, tmp_path, capsys):
    identifiability.main(database, tmp_path / "table.csv", tmp_path / "figure.png")
    assert "when_hot" in (tmp_path / "table.csv").read_text()
    assert (tmp_path / "figure.png").stat().st_size > 10000
    assert "identifiability" in capsys.readouterr().out
