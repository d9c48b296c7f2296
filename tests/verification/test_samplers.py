"""`calibrate sample` against two samplers that share no code with it, on one likelihood."""

import numpy as np
import pytest

from nested_sampling import NestedSampling
from sampler_study import CONFIG, emcee_chain, likelihood_of, sample, unit, write_table


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("samplers")
    write_table(folder)
    return folder


def test_plain_draws_agree_with_nested_sampling(study):
    found = sample(study, "plain", draws_from="prior", draw_sequence="sobol", draws=1000000)
    likelihood = likelihood_of(study, found)
    # A nested run's points hang together more than their weights say: four runs, and the
    # bounds of one.
    log_z, errors, means, squares, effective = [], [], [], [], []
    for seed in range(1, 5):
        sampler = NestedSampling(likelihood, len(CONFIG["parameters"]), seed=seed)
        evidence, error, points, weights = sampler.run()
        log_z.append(evidence)
        errors.append(error)
        means.append(weights @ points)
        squares.append(weights @ points**2)
        effective.append(1 / (weights**2).sum())
    difference = found.attrs["ln_evidence"] - np.mean(log_z)
    error = np.mean(errors) / np.sqrt(len(errors))
    assert found.attrs["ln_evidence_sd"] < 0.05
    assert found.attrs["dropped_mass_bound"] < 3e-6
    assert abs(difference) < 4 * np.hypot(error, found.attrs["ln_evidence_sd"])
    draws = unit(found["draws"][:, :3])
    mean = np.mean(means, axis=0)
    sd = np.sqrt(np.mean(squares, axis=0) - mean**2)
    smallest = min(effective)
    assert np.all(np.abs(draws.mean(axis=0) - mean) < 5 * sd / np.sqrt(smallest))
    assert np.all(np.abs(draws.std(axis=0) / sd - 1) < 5 / np.sqrt(2 * smallest))


def test_adapted_and_plain_draws_agree(study):
    """Both are unbiased estimates of one evidence, up to the point where df/dv is taken."""
    adapted, plain = sample(study, "adapted"), sample(
        study, "plain_random", draws_from="prior", draws=1000000
    )
    errors = adapted.attrs["ln_evidence_sd"], plain.attrs["ln_evidence_sd"]
    difference = adapted.attrs["ln_evidence"] - plain.attrs["ln_evidence"]
    assert abs(difference) < 4 * np.hypot(*errors) + 0.02


def test_posterior_agrees_with_emcee(study):
    pytest.importorskip("emcee")
    found = sample(study, "for_emcee")
    likelihood = likelihood_of(study, found)
    draws = unit(found["draws"][:, :3])
    random = np.random.default_rng(2)
    start = draws[random.choice(len(draws), 40, replace=False)]
    chain, length = emcee_chain(likelihood, start, 1500)
    effective = len(chain) / length
    assert effective > 400
    mean, sd = chain.mean(axis=0), chain.std(axis=0)
    # Errors of both sides: the file keeps 4000 draws.
    error = np.sqrt(1 / effective + 1 / len(draws))
    assert np.all(np.abs(draws.mean(axis=0) - mean) < 4.5 * sd * error)
    assert np.all(np.abs(draws.std(axis=0) / sd - 1) < 4.5 * error)
