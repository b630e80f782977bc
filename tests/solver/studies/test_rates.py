"""Annual rates of displacement: closed forms, curves that end, shares and bands."""

import math

import numpy as np
import pytest
from scipy.special import ndtri

from solver.studies.rates import (
    LEAST_RATE,
    HazardCurve,
    band,
    contributions,
    deaggregated,
    displacements_at,
    exceedance_rates,
    probability,
    realizations,
)

K0, K = 0.002, 2.5


def power(low=1e-3, high=1e3, **more):
    """A hazard of K0 x^-K."""
    x = np.array([low, high])
    return HazardCurve(intensity=x, rate=K0 * x**-K, **more)


def stepped(capacities, levels):
    """PRD of blocks that move by 1 m from their capacity on."""
    return np.where(levels >= capacities[:, None], 1.0, 0.0)


def cornell(median, beta):
    """Rate at which a lognormal capacity is exceeded (Cornell et al. 2002, Eq. 7)."""
    return K0 * median**-K * math.exp(0.5 * (K * beta) ** 2)


@pytest.mark.parametrize(("median", "beta"), [(0.8, 0.2), (1.3, 0.4)])
def test_lognormal_capacities_of_many_motions_have_the_rate_of_cornell(median, beta):
    n = 4000
    capacities = median * np.exp(beta * ndtri((np.arange(n) + 0.5) / n))
    levels = np.geomspace(0.05, 40.0, 1500)
    # A PRD that is twice the intensity over the capacity exceeds 2 m where the capacity is reached.
    prd_m = 2.0 * levels / capacities[:, None]
    (rate,) = exceedance_rates(power(), levels, prd_m, np.array([2.0])).mean(axis=1)
    assert rate == pytest.approx(cornell(median, beta), rel=1e-3)


@pytest.mark.parametrize("beta", [0.1, 0.4, 0.6])
def test_a_dispersion_of_the_events_has_the_rate_of_cornell(beta):
    levels = np.array([0.01, 1.0, 100.0])
    prd_m = np.array([[0.01, 1.0, 100.0]])
    (rate,) = exceedance_rates(power(beta=beta), levels, prd_m, np.array([1.0]))
    assert rate[0] == pytest.approx(cornell(1.0, beta), rel=1e-3)


def test_a_prd_that_falls_again_counts_where_it_is_larger():
    levels, prd_m = np.array([1.0, 2.0, 3.0, 4.0]), np.array([[0.0, 1.0, 0.0, 2.0]])
    curve = power()
    found = contributions(curve, levels, curve.at(levels), prd_m, 0.5)[0]
    edges = curve.at(np.array([1.5, 2.0, 2.5, 3.25, 4.0]))
    assert found == pytest.approx(
        [edges[0] - edges[1], edges[1] - edges[2], edges[3] - edges[4], edges[4]], rel=1e-12
    )


def test_runs_without_a_value_exceed_every_limit_from_the_level_below_on():
    levels = np.array([1.0, 2.0, 3.0, 4.0])
    prd_m = np.array([[0.1, 0.2, np.nan, np.nan], [np.nan, 0.2, 0.3, 0.4]])
    rate = power().at(levels)
    first, second = exceedance_rates(power(), levels, prd_m, np.array([10.0]))[0]
    assert first == pytest.approx(rate[1], rel=1e-12)
    assert second == pytest.approx(rate[0] - rate[1] + rate[3], rel=1e-12)


def test_a_curve_that_ends_leaves_its_last_rate_to_every_limit():
    ended = HazardCurve(intensity=np.array([0.1, 1.0]), rate=np.array([0.1, 0.001]))
    assert ended.is_ended
    assert ended.top == 1.0
    levels = np.array([0.1, 1.0])
    limits = np.linspace(0.0, 1.0, 201)
    rates = exceedance_rates(ended, levels, np.array([[0.0, 0.5]]), limits).mean(axis=1)
    assert rates[-1] == pytest.approx(0.001)
    found = displacements_at(limits, rates, np.array([5.0, 475.0, 975.0, 2475.0]))
    assert found[0] == 0.0
    assert 0.0 < found[1] < found[2] <= 0.5
    assert found[3] == math.inf


def test_a_long_curve_is_run_to_the_least_rate():
    assert power().at(np.array([power().top]))[0] == pytest.approx(LEAST_RATE, rel=1e-3)
    assert not power().is_ended


def test_displacements_of_a_recurrence_are_exceeded_once_in_it():
    levels = np.geomspace(0.2, 20.0, 60)
    prd_m = 0.3 * (levels - 0.2) ** 1.5
    limits = np.concatenate([[0.0], np.geomspace(1e-4, 20.0, 300)])
    rates = exceedance_rates(power(), levels, prd_m[None], limits)[:, 0]
    years = np.array([72.0, 475.0, 700.0, 2475.0])
    found = displacements_at(limits, rates, years)
    exact = exceedance_rates(power(), levels, prd_m[None], found)[:, 0]
    assert exact == pytest.approx(1.0 / years, rel=2e-3)


def test_shares_are_of_the_site_and_sum_to_one():
    levels = np.geomspace(0.05, 20.0, 400)
    prd_m = levels[None].copy()
    edges = np.geomspace(0.02, 60.0, 50)
    plain = deaggregated(power(), levels, prd_m, 1.0, edges)
    assert plain.sum() == pytest.approx(1.0)
    assert plain[edges[1:] < 0.95].sum() == 0.0
    # Of a power law the mean of ln x of events with x e > 1 is that of the rate, less k beta^2.
    spread = deaggregated(power(beta=0.4), levels, prd_m, 1.0, edges)
    middles = np.log(np.sqrt(edges[1:] * edges[:-1]))
    assert spread @ middles == pytest.approx(1.0 / K - K * 0.4**2, abs=0.03)


def test_bands_hold_what_friction_and_motions_might_have_been():
    rates = np.zeros((2, 5, 8))
    rates[0] = np.array([1.0, 2.0, 3.0, 4.0, 5.0])[:, None]
    rates[1, :, :4] = 2.0
    found = band(realizations(rates, seed=1))
    assert found[:, 0].tolist() == [1.0, 5.0]
    # Of eight motions with 0 or 2, the mean has the standard deviation sqrt(1/8).
    assert found[:, 1] == pytest.approx([1.0 - 8**-0.5, 1.0 + 8**-0.5], abs=0.16)


def test_a_rate_of_one_in_the_years_is_exceeded_in_63_percent():
    assert probability(1.0 / 50.0, 50.0) == pytest.approx(1.0 - math.exp(-1.0), rel=1e-14)
