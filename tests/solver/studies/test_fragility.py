"""Fragilities against another optimizer, closed forms, and the coverage of their intervals."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import goodness_of_fit, norm

from nightly import by_day
from solver.studies.capacity import Capacities
from solver.studies.fragility import (
    fit_lognormal,
    fragility,
    lilliefors,
    lilliefors_critical,
    lilliefors_p,
)

LEVELS = np.geomspace(0.25, 4.0, 20)


def known(capacity, end=math.inf):
    """Capacities that are censored at an intensity."""
    return Capacities(
        intensity=np.minimum(capacity, end),
        is_censored=capacity > end,
        end=np.full(capacity.size, min(end, 1e9)),
        falls=np.zeros(capacity.size, dtype=bool),
        searched=np.zeros(capacity.size, dtype=int),
    )


def drawn(rng, motions, beta, end=math.inf, theta=1.0):
    """Capacities of a lognormal, of a generator or a seed."""
    rng = np.random.default_rng(rng)
    return known(theta * np.exp(beta * rng.standard_normal(motions)), end)


def fitted(found, seed=1):
    exceeds = found.intensity[:, None] < LEVELS
    return fragility(LEVELS, exceeds, np.ones_like(exceeds), found, seed=seed)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.quick
def test_the_likelihood_of_censored_capacities_is_largest_as_another_optimizer_finds(seed):
    rng = np.random.default_rng(seed)
    found = drawn(rng, 12, 0.3, rng.uniform(0.9, 1.3))

    def less(p):
        z = (np.log(found.intensity) - p[0]) / math.exp(p[1])
        return -np.sum(np.where(found.is_censored, norm.logsf(z), norm.logpdf(z) - p[1]))

    finely = {"xatol": 1e-9, "fatol": 1e-12}
    best = minimize(less, (0.0, -1.0), method="Nelder-Mead", options=finely)
    one = fit_lognormal(found)
    assert (math.log(one.theta), math.log(one.beta)) == pytest.approx(best.x, abs=1e-6)


def test_uncensored_capacities_have_their_geometric_mean_and_the_deviation_of_fema_p58():
    """Method A of Porter et al. 2007: the divisor of the squares is n - 1."""
    found = drawn(4, 9, 0.2)
    one, logs = fit_lognormal(found), np.log(found.intensity)
    assert one.theta == pytest.approx(math.exp(logs.mean()), rel=1e-12)
    assert one.beta == pytest.approx(logs.std(ddof=1), rel=1e-12)


def test_the_exact_intervals_of_seven_capacities():
    """Tables: t(0.95, 6) = 1.9432, chi-square(0.05, 6) = 1.6354 and (0.95, 6) = 12.5916."""
    found = fitted(drawn(4, 7, 0.2))
    logs = np.log(found.capacities.intensity)
    far = 1.9432 * logs.std(ddof=1) / math.sqrt(7)
    wanted = logs.mean() - far, logs.mean() + far
    assert np.log(found.theta_range) == pytest.approx(wanted, abs=1e-5)
    sums = ((logs - logs.mean()) ** 2).sum()
    wanted = math.sqrt(sums / 12.5916), math.sqrt(sums / 1.6354)
    assert found.beta_range == pytest.approx(wanted, rel=1e-4)


@pytest.mark.parametrize("values", [[1.0, 1.0, 1.0], [0.0, 1.0, 2.0], [1.0]], ids=str)
def test_capacities_that_determine_no_lognormal_give_none(values):
    found = fitted(known(np.array(values)))
    assert not found.fitted.is_known
    assert all(map(math.isnan, (found.fitted.beta, *found.theta_range, *found.beta_range)))


def held(motions, beta, end, sets):
    """Fractions of sets whose intervals hold the median and beta, of those that have any."""
    rng, inside = np.random.default_rng(20), []
    for seed in range(sets):
        one = fitted(drawn(rng, motions, beta, end), seed=seed)
        if one.fitted.is_known:
            (low, high), (least, most) = one.theta_range, one.beta_range
            inside.append([low <= 1.0 <= high, least <= beta <= most])
    return np.mean(inside, axis=0)


@pytest.mark.parametrize("beta", by_day([0.05, 0.2, 0.4], 1))
@pytest.mark.parametrize("motions", [7, 20, 40])
def test_the_intervals_hold_the_truth_in_88_to_92_percent_of_sets(motions, beta):
    share = held(motions, beta, math.inf, 2000)
    assert ((share >= 0.88) & (share <= 0.92)).all(), share


@pytest.mark.nightly
@pytest.mark.parametrize(("motions", "beyond"), [(7, 0.1), (20, 0.25), (40, 0.25), (40, 0.5)])
def test_the_intervals_of_censored_capacities_hold_it_about_as_often(motions, beyond):
    """400 sets: 0.90 within three standard errors of 0.015."""
    share = held(motions, 0.2, math.exp(0.2 * norm.isf(beyond)), 400)
    assert (np.abs(share - 0.9) <= 0.045).all(), share


def test_the_same_seed_gives_the_same_interval():
    found = drawn(1, 20, 0.4, 1.3)
    one, two = (fitted(found, seed=5) for _ in range(2))
    assert (one.theta_range, one.beta_range) == (two.theta_range, two.beta_range)


def test_scaling_the_intensity_scales_the_median_alone():
    one, two = (fitted(drawn(2, 20, 0.4, 1.3 * theta, theta)) for theta in (1.0, 3.0))
    assert two.fitted.theta == pytest.approx(3.0 * one.fitted.theta, rel=1e-9)
    assert two.fitted.beta == pytest.approx(one.fitted.beta, rel=1e-9)
    assert np.array(two.theta_range) == pytest.approx(3.0 * np.array(one.theta_range), rel=1e-6)


@pytest.mark.quick
def test_a_censored_run_is_in_no_count_and_is_stated():
    found = drawn(3, 45, 0.4)
    exceeds = found.intensity[:, None] <= LEVELS
    counts = np.ones_like(exceeds)
    counts[4, -1] = counts[9, -1] = False
    one = fragility(LEVELS, exceeds, counts, found, seed=1)
    assert (one.censored, one.counted[0], one.counted[-1]) == (2, 45, 43)
    assert one.exceeded[-1] <= 43


def test_the_p_value_is_that_of_another_simulation():
    for seed in (1, 2, 3):
        found = fitted(drawn(seed, 12, 0.3))
        logs = np.log(found.capacities.intensity)
        other = goodness_of_fit(norm, logs, statistic="ks", n_mc_samples=4000, rng=seed)
        assert float(lilliefors(logs)) == pytest.approx(other.statistic, rel=1e-9)
        assert found.p_value == pytest.approx(other.pvalue, abs=0.03)


@pytest.mark.parametrize(("motions", "critical"), [(7, 0.3041), (10, 0.2616), (20, 0.1920)])
def test_the_p_value_is_5_percent_at_the_critical_values_of_molin_and_abdi(motions, critical):
    assert lilliefors_p(critical, motions) == pytest.approx(0.05, abs=0.006)
    assert lilliefors_critical(motions) == pytest.approx(critical, rel=0.015)


@pytest.mark.parametrize("motions", [7, 20, 40])
@pytest.mark.parametrize("p", [0.02, 0.05, 0.1])
def test_the_p_value_is_that_of_the_formula_of_dallal_and_wilkinson(motions, p):
    """The American Statistician 40 (1986) 294-296; stated for p up to 0.1.

    ln p = -7.01256 d^2 (n + 2.78019) + 2.99587 d sqrt(n + 2.78019) - 0.122119 + 0.974598 / sqrt(n)
    + 1.67997 / n.
    """
    m = motions + 2.78019
    rest = -0.122119 + 0.974598 / math.sqrt(motions) + 1.67997 / motions - math.log(p)
    d = (2.99587 + math.sqrt(2.99587**2 + 4.0 * 7.01256 * rest)) / (2.0 * 7.01256 * math.sqrt(m))
    assert lilliefors_p(d, motions) == pytest.approx(p, abs=0.006)


def test_the_critical_value_is_where_the_p_value_reaches_5_percent():
    at = lilliefors_critical(9)
    assert lilliefors_p(at, 9) <= 0.05 < lilliefors_p(at * (1.0 - 1e-9), 9) + 1e-4


@pytest.mark.quick
def test_a_set_of_two_groups_is_no_lognormal_and_a_censored_one_has_no_p_value():
    groups = np.concatenate([np.linspace(0.5, 0.51, 10), np.linspace(2.0, 2.02, 10)])
    assert fitted(known(groups)).p_value < 0.001
    assert math.isnan(fitted(drawn(1, 20, 0.3, 1.0)).p_value)
