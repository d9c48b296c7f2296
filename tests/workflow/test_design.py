"""The design covers its ranges evenly, grows without moving, and is what the solver reads."""

import time

import h5py
import numpy as np
import pytest

from make_design import design, write_design
from study import design_settings


@pytest.fixture
def settings(tiny_study):
    tiny_study["database"]["shapes"] = ["uniform_cylinder", "truncated_cone", "reduced_head_3mm"]
    tiny_study["database"]["runs"] = 300
    tiny_study["database"]["initial_diameter_mm"] = [8, 8]
    return design_settings(tiny_study)


def test_each_shape_covers_each_range_evenly(settings):
    made = design(settings)
    shapes = np.array(made["shape"])
    for shape in settings["shapes"]:
        rows = made["inputs"][shapes == shape]
        assert len(rows) == 100
        for name, (lower, upper) in settings["ranges"].items():
            values = rows[:, made["names"].index(name)]
            if lower == upper:
                assert (values == lower).all()
                continue
            # A Sobol sequence fills ten slots much more evenly than chance (9.4 +- 3).
            inside = values[(values > lower) & (values < upper)]
            counts, _ = np.histogram(inside, bins=10, range=(lower, upper))
            assert counts.min() >= 7 and counts.max() <= 12


def test_densities_are_even_in_their_logarithm(settings):
    made = design(settings)
    values = np.log10(made["inputs"][:, made["names"].index("rho_immobile_initial")])
    inside = values[(values > 12) & (values < 14)]
    counts, _ = np.histogram(inside, bins=10, range=(12, 14))
    assert counts.sum() > 270
    assert counts.min() >= 24 and counts.max() <= 32


def test_runs_are_denser_near_zero_where_asked(settings):
    settings["parameters"]["hardening_coefficient"]["lower"] = 0
    made = design({**settings, "spacing": "square_root"})
    column = made["names"].index("hardening_coefficient")
    roots = np.sqrt(made["inputs"][:, column] / 5)
    counts, _ = np.histogram(roots[(roots > 0) & (roots < 1)], bins=10, range=(0, 1))
    assert counts.min() >= 22 and counts.max() <= 35
    # Densities stay even in their logarithm, and nothing else moves.
    even = design(settings)["inputs"]
    others = [index for index in range(even.shape[1]) if index != column]
    assert (even[:, others] == made["inputs"][:, others]).all()


@pytest.mark.parametrize("runs", [24, 300, 1000])
def test_each_shape_has_runs_on_both_ends_of_each_range(settings, runs):
    made = design({**settings, "runs": runs})
    shapes = np.array(made["shape"])
    parameters = {name: (v["lower"], v["upper"]) for name, v in settings["parameters"].items()}
    for name, (lower, upper) in {**settings["ranges"], **parameters}.items():
        for shape in settings["shapes"]:
            values = made["inputs"][shapes == shape, made["names"].index(name)]
            assert values.min() == lower and values.max() == upper
            if lower < upper:
                assert (values == lower).sum() <= 4 and (values == upper).sum() <= 4


def test_shapes_and_seeds_differ(settings):
    made = design(settings)
    assert len(set(made["seed"])) == 300
    assert len(np.unique(made["inputs"], axis=0)) == 300
    assert not np.array_equal(made["inputs"], design({**settings, "seed": 2})["inputs"])


def test_the_file_has_names_and_the_same_bytes_each_time(settings, tmp_path):
    first, second = tmp_path / "first.h5", tmp_path / "second.h5"
    write_design(first, design(settings))
    time.sleep(1.1)  # HDF5's time stamps count seconds
    write_design(second, design(settings))
    assert first.read_bytes() == second.read_bytes()
    with h5py.File(first) as file:
        assert file.attrs["schema"] == "taylorcal/design/1"
        assert list(file["inputs"].attrs["names"])[0] == "velocity_m_s"
        assert file["inputs"].shape == (300, 6)
        assert file["shape"].asstr()[1] == "truncated_cone"
