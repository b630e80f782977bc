"""Fragilities against the check value of Baker (2015), other optimizers, and known answers."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import norm

from solver.studies.fragility import fit_lognormal, fragility

LEVELS = np.array(
    [0.178, 0.274, 0.444, 0.56, 0.652, 0.79, 0.982, 1.246, 1.564, 2.014, 2.417, 3.021, 3.625, 4.028,
     4.431, 5.035]
)  # fmt: skip
EXCEEDED = np.array([0, 0, 0, 0, 0, 4, 13, 23, 38, 41, 44, 45, 45, 45, 45, 45.0])


def test_the_example_of_baker():
    found = fit_lognormal(LEVELS, EXCEEDED, np.full(16, 45.0))
    assert round(found.theta, 4) == 1.2194
    assert round(found.beta, 4) == 0.3101


@pytest.mark.parametrize("seed", range(8))
def test_the_likelihood_is_largest_as_another_optimizer_finds(seed):
    rng = np.random.default_rng(seed)
    levels = np.geomspace(0.1, 8.0, 12)
    n = rng.integers(3, 40, 12).astype(float)
    k = rng.binomial(n.astype(int), norm.cdf(np.log(levels / 0.9) / 0.8)).astype(float)

    def less(p):
        z = np.log(levels / math.exp(p[0])) / math.exp(p[1])
        return -np.sum(k * norm.logcdf(z) + (n - k) * norm.logsf(z))

    best = minimize(
        less, (0.0, -0.5), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    )
    found = fit_lognormal(levels, k, n)
    assert (math.log(found.theta), math.log(found.beta)) == pytest.approx(best.x, abs=1e-6)


def test_far_tails_do_not_upset_the_fit():
    """Levels so far out that the normal distribution is below 1e-290 there change nothing."""
    near, far = np.geomspace(0.5, 2.0, 5), np.array([1e-9, 1e9])
    k = np.array([1.0, 3.0, 5.0, 7.0, 9.0])
    one = fit_lognormal(near, k, np.full(5, 10.0))
    levels = np.array([far[0], *near, far[1]])
    two = fit_lognormal(levels, np.array([0.0, *k, 10.0]), np.full(7, 10.0))
    assert (two.theta, two.beta) == pytest.approx((one.theta, one.beta), rel=1e-9)


@pytest.mark.parametrize(
    "exceeded", [[0, 0, 0], [5, 5, 5], [0, 0, 5], [0, 3, 5], [5, 3, 0]], ids=str
)
def test_counts_that_determine_no_lognormal_give_none(exceeded):
    found = fit_lognormal(np.array([1.0, 2.0, 3.0]), np.array(exceeded, float), np.full(3, 5.0))
    assert not found.is_known
    assert math.isnan(found.beta)


def flags(seed, motions=45, beta=0.4):
    """Motions that exceed from their own capacity on, lognormal about 1."""
    capacity = np.exp(beta * np.random.default_rng(seed).standard_normal(motions))
    levels = np.geomspace(0.25, 4.0, 20)
    return levels, levels >= capacity[:, None]


def test_the_confidence_intervals_hold_the_truth_as_often_as_they_say():
    held = np.zeros(2)
    for seed in range(200):
        levels, exceeds = flags(seed)
        found = fragility(levels, exceeds, np.ones_like(exceeds), seed=seed)
        held += (
            found.theta_range[0] <= 1.0 <= found.theta_range[1],
            found.beta_range[0] <= 0.4 <= found.beta_range[1],
        )
    assert ((held / 200 >= 0.85) & (held / 200 <= 0.95)).all(), held / 200


def test_the_same_seed_gives_the_same_interval():
    levels, exceeds = flags(1)
    one, two = (fragility(levels, exceeds, np.ones_like(exceeds), seed=5) for _ in range(2))
    assert one.theta_range == two.theta_range
    assert one.beta_range == two.beta_range


def test_scaling_the_intensity_scales_the_median_alone():
    levels, exceeds = flags(2)
    one = fragility(levels, exceeds, np.ones_like(exceeds), seed=1)
    two = fragility(3.0 * levels, exceeds, np.ones_like(exceeds), seed=1)
    assert two.fitted.theta == pytest.approx(3.0 * one.fitted.theta, rel=1e-9)
    assert two.fitted.beta == pytest.approx(one.fitted.beta, rel=1e-9)
    assert np.array(two.theta_range) == pytest.approx(3.0 * np.array(one.theta_range), rel=1e-6)


def test_a_censored_run_is_in_no_count_and_is_stated():
    levels, exceeds = flags(3)
    counts = np.ones_like(exceeds)
    counts[4, -1] = counts[9, -1] = False
    found = fragility(levels, exceeds, counts, seed=1)
    assert found.censored == 2
    assert found.counted[-1] == 43
    assert found.exceeded[-1] <= 43
    assert found.counted[0] == 45


def test_an_unknown_fragility_has_no_interval():
    levels = np.array([1.0, 2.0])
    exceeds = np.array([[False, True]] * 5)
    found = fragility(levels, exceeds, np.ones_like(exceeds), seed=1)
    assert not found.fitted.is_known
    assert all(map(math.isnan, (*found.theta_range, *found.beta_range)))
