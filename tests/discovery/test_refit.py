"""Adding an effect: the network in numpy, the signatures, and the refit, in closed form."""

import numpy as np
import pytest
from hide import read_signatures
from judge import Case, left_out_falls, left_out_in_turn_falls, moves_toward_truth
from judge import predicts_like_truth
from make_tables import write_table
from parameter_distance import distances_to_truth
from refit import Table, added, named_effect
from signature_model import SignatureModel
from specimens import SHAPES
from toy_study import CANDIDATES, RANGES


def middle():
    return {name: np.array((low * high) ** 0.5) for name, (low, high) in RANGES.items()}


@pytest.fixture(scope="module")
def signatures(toy):
    return read_signatures(toy.study / "signatures.h5", CANDIDATES, toy.network)


def test_signatures_give_the_change_of_a_unit(toy, signatures):
    """The toy's change is a quadratic in v: between the pairs' velocities as well."""
    from toy_study import toy_sizes

    point = {name: float(value) for name, value in middle().items()}
    for shape in SHAPES:
        base = {"shape": [shape], "names": [*point], "inputs": np.array([[*point.values()]])}
        plain = toy_sizes(toy.network, base)
        names, row = [*point, "anvil_friction"], [[*point.values(), 1.0]]
        changed = toy_sizes(toy.network, {**base, "names": names, "inputs": np.array(row)})
        found = signatures.change(shape, "anvil_friction", point)
        assert found == pytest.approx(changed - plain, abs=0.02 * np.abs(changed - plain).max())


@pytest.fixture(scope="module")
def fits(toy, signatures, tmp_path_factory):
    """Of visible effects: the case with its refit, and chi^2 with another effect."""
    folder = tmp_path_factory.mktemp("tables")
    by_name = {item["name"]: item for item in CANDIDATES}
    found = []
    tables = [table for table in toy.generator.tables() if table.kind == "effect"]
    for table in [table for table in tables if table.variant.strength == "six_sigma"][:6]:
        rows, truth = toy.generator.make(table)
        path = folder / table.id / "measurements.csv"
        write_table(path, rows)
        name = table.variant.effects[0]
        other = next(item for item in CANDIDATES if item["name"] != name)
        right = added(toy.network, signatures, by_name[name], path)
        table_id, table = table.id, Table(toy.network, signatures, path)
        distances = distances_to_truth(toy.network, path, right, truth)
        case = Case(table_id, truth, {}, right, distances=distances)
        found.append((case, table.fit(table.fitted, other).solve().chi2))
    return found


def test_the_hidden_effect_explains_more_than_another(fits):
    for case, wrong_chi2 in fits:
        assert case.refit["with"]["chi2"] < case.refit["without"]["chi2"] - 15
        assert case.refit["with"]["chi2"] < wrong_chi2


def test_the_fit_is_as_good_as_the_noise(fits):
    data = 24 * 5 * 4 / 5
    for case, _ in fits:
        assert case.refit["with"]["chi2"] == pytest.approx(data, abs=4.5 * (2 * data) ** 0.5)


def test_amplitude_error_and_parameters_come_nearer_to_the_truth(fits):
    fallen, in_turn, moved, alike = 0, 0, 0, 0
    for case, _ in fits:
        true = next(iter(case.truth["effects"].values()))
        assert case.refit["with"]["amplitude"] == pytest.approx(true, rel=0.6)
        fallen += left_out_falls(case)
        in_turn += left_out_in_turn_falls(case)
        moved += moves_toward_truth(case)
        alike += predicts_like_truth(case)
    # Little of these effects is absorbed, so that noise moves parameters about as much.
    assert in_turn == 6 and fallen >= 5 and moved >= 4 and alike >= 4


def test_nothing_is_added_unless_the_verdict_names_it():
    verdict = {"flagged": True, "effects": ["back_stress", "anvil_friction"]}
    assert named_effect({"verdict": verdict}) == "back_stress"
    assert named_effect({"verdict": {**verdict, "flagged": False}}) is None
    assert named_effect({"verdict": {**verdict, "effects": []}}) is None


def test_the_folds_leave_each_shot_out_once(toy, signatures, tmp_path):
    chosen = next(table for table in toy.generator.tables() if table.kind == "effect")
    rows, _ = toy.generator.make(chosen)
    path = tmp_path / "measurements.csv"
    write_table(path, rows)
    folds = Table(toy.network, signatures, path).folds()
    assert (np.sum(folds, axis=0) == 1).all()
    assert all(4 <= fold.sum() <= 5 for fold in folds)


def test_a_curvature_of_the_amplitude_is_followed():
    """Changes of kappa + kappa^2: of a unit, 1 + kappa."""
    speeds = np.linspace(50, 120, 8)
    amplitudes = np.tile([0.5, 1.0], 4)
    pairs = {("cone", "drag"): (speeds[:, None], amplitudes, 1 + amplitudes[:, None])}
    model = SignatureModel(pairs, [])
    for amplitude in (0.5, 0.75, 1.0, 1.1):
        found = model.change("cone", "drag", {"velocity_m_s": 80.0}, amplitude)
        assert found == pytest.approx(1 + amplitude, rel=2e-3)
    assert model.change("cone", "drag", {"velocity_m_s": 80.0}) == pytest.approx(1.75, rel=2e-3)
