"""The design covers its ranges evenly, grows without moving, and is what the solver reads."""

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
            # A Sobol sequence fills ten slots much more evenly than chance (10 +- 3).
            counts, _ = np.histogram(values, bins=10, range=(lower, upper))
            assert counts.min() >= 7 and counts.max() <= 13


def test_densities_are_even_in_their_logarithm(settings):
    made = design(settings)
    values = np.log10(made["inputs"][:, made["names"].index("rho_immobile_initial")])
    counts, _ = np.histogram(values, bins=10, range=(12, 14))
    assert counts.sum() == 300
    assert counts.min() >= 25 and counts.max() <= 35


def test_more_runs_keep_the_first_ones(settings):
    few, many = design(settings), design({**settings, "runs": 700})
    assert np.array_equal(few["inputs"], many["inputs"][:300])
    assert np.array_equal(few["seed"], many["seed"][:300])


def test_shapes_and_seeds_differ(settings):
    made = design(settings)
    assert len(set(made["seed"])) == 300
    assert len(np.unique(made["inputs"], axis=0)) == 300
    assert not np.array_equal(made["inputs"], design({**settings, "seed": 2})["inputs"])


def test_the_file_has_names_and_the_same_bytes_each_time(settings, tmp_path):
    first, second = tmp_path / "first.h5", tmp_path / "second.h5"
    write_design(first, design(settings))
    write_design(second, design(settings))
    assert first.read_bytes() == second.read_bytes()
    with h5py.File(first) as file:
        assert file.attrs["schema"] == "taylorcal/design/1"
        assert list(file["inputs"].attrs["names"])[0] == "velocity_m_s"
        assert file["inputs"].shape == (300, 6)
        assert file["shape"].asstr()[1] == "truncated_cone"
