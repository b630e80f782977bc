"""Samples, chances and tornado charts against closed forms."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from solver.model import InputError
from solver.studies.uncertainty import (
    Spread,
    exceedance,
    latin_hypercube,
    one_at_a_time,
    spread_of_tests,
    tornado,
)

pytestmark = pytest.mark.quick

FRICTION, SLOPE = Spread(center=0.5, beta=0.1), Spread(center=2.0, half=0.25)


def test_each_interval_of_equal_chance_has_one_sample():
    samples = latin_hypercube([FRICTION, SLOPE], 100, seed=1)
    chances = norm.cdf(np.log(samples[:, 0] / 0.5) / 0.1), (samples[:, 1] - 1.75) / 0.5
    for chance in chances:
        assert sorted(np.floor(100 * chance).astype(int)) == list(range(100))


def test_the_same_seed_gives_the_same_samples():
    one, two, other = (latin_hypercube([FRICTION], 50, seed=seed) for seed in (4, 4, 5))
    assert (one == two).all()
    assert not (one == other).all()


def test_a_sum_of_variables_has_the_variance_of_theory():
    spreads = [Spread(center=0.0, half=1.0)] * 3
    sums = [latin_hypercube(spreads, 500, seed=s).sum(axis=1) for s in range(20)]
    assert np.mean(sums) == pytest.approx(0.0, abs=1e-3)
    assert np.var(sums) == pytest.approx(3.0 / 3.0, rel=0.02)


def test_a_fixed_variable_is_always_its_center():
    assert (latin_hypercube([Spread(center=0.4)], 10, seed=1) == 0.4).all()


def test_tested_values_give_their_geometric_mean_and_deviation():
    found = spread_of_tests([0.4, 0.5, 0.625])
    assert found.center == pytest.approx(0.5, rel=1e-12)
    assert found.beta == pytest.approx(math.log(1.25), rel=1e-12)
    with pytest.raises(InputError, match="2 tested values"):
        spread_of_tests([0.4, 0.5])


def test_the_chance_is_the_fraction_that_exceeds():
    prd = np.array([[0.1, 0.3], [0.2, 0.5], [0.6, math.nan]])
    found = exceedance(prd, 0.25, seed=1)
    assert found.value == pytest.approx(4 / 6)
    assert (found.without_value, found.runs) == (1, 6)
    assert found.low <= found.value <= found.high


def test_the_chance_of_a_lognormal_demand_is_that_of_theory():
    """PRD = c / mu with lognormal mu and motions: exceedance in closed form."""
    motions = np.exp(0.5 * norm.ppf((np.arange(400) + 0.5) / 400))
    mus = latin_hypercube([FRICTION], 400, seed=2)
    found = exceedance(0.1 * motions / mus, 0.3, seed=1)
    expected = 1.0 - norm.cdf(math.log(0.3 / 0.2) / math.hypot(0.5, 0.1))
    assert found.value == pytest.approx(expected, abs=0.005)
    assert found.low < expected < found.high


def test_bars_are_ordered_by_their_length():
    spreads = {"friction": FRICTION, "slope": SLOPE, "weight": Spread(center=1.0)}
    cases = one_at_a_time(spreads)
    assert cases[0] == (0.5, 2.0, 1.0)
    means = np.array([slope / mu for mu, slope, _ in cases])
    bars = tornado(spreads, means)
    assert [bar.name for bar in bars] == ["friction", "slope"]
    low = 0.5 * math.exp(-0.1 * norm.ppf(0.95))
    assert bars[0].at_low == pytest.approx(low, rel=1e-12)
    assert bars[0].prd_low_m == pytest.approx(2.0 / low, rel=1e-12)
    assert bars[1].at_high == pytest.approx(2.225, rel=1e-12)


def test_a_bar_without_an_end_is_the_longest():
    spreads = {"friction": FRICTION, "slope": SLOPE}
    bars = tornado(spreads, np.array([1.0, 0.5, 9.0, math.nan, 1.1]))
    assert [bar.name for bar in bars] == ["slope", "friction"]
