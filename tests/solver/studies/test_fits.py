"""Statistics, fits, samples and friction not yet tested, against closed forms and textbooks."""

import math

import numpy as np
import pytest
from scipy.stats import f_oneway, norm

from solver.errors import InputError
from solver.friction_tests import FrictionRun, Surface, series
from solver.studies.curves import DIGITS, first_allowed, fit_prd, statistics
from solver.studies.predictive import QUANTILES, predictive
from solver.studies.uncertainty import (
    Spread,
    exceedance,
    latin_hypercube,
    one_at_a_time,
    spread_of_tests,
    tornado,
)

pytestmark = pytest.mark.quick


NONE = math.nan


@pytest.mark.parametrize(
    ("values", "mean", "p84", "largest"),
    [
        (np.arange(101.0)[::-1], 50.0, 84.0, 100.0),
        # The place 0.84 x 6 = 5.04 lies between the sixth value and the one that is missing.
        ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, NONE], NONE, NONE, NONE),
        ([*map(float, range(1, 20)), NONE], NONE, 1 + 0.84 * 19, NONE),
    ],
)
def test_a_motion_without_a_value_is_larger_than_all_others(values, mean, p84, largest):
    found = statistics(np.array([values, values]))
    for each, wanted in ((found.mean_m, mean), (found.p84_m, p84), (found.largest_m, largest)):
        assert each == pytest.approx([wanted] * 2, rel=1e-14, nan_ok=True)
    assert found.without_value.tolist() == [int(math.isnan(mean))] * 2


@pytest.mark.parametrize(
    ("prds_m", "limit_m", "expected"),
    [
        ((0.9, 0.5, 0.1), 0.3, 0.45),  # between two runs
        ((0.9, 0.5, 0.1), 1.0, 0.3),
        ((0.9, 0.5, 0.1), 0.05, NONE),
        ((0.2, 0.4, 0.2), 0.3, 0.45),  # above every coefficient that exceeds the limit
        ((NONE, 0.2, 0.1), 0.3, 0.4),  # a run without a value exceeds every limit
        ((0.1, 0.2, NONE), 0.3, NONE),
    ],
)
def test_least_friction_is_above_what_exceeds_the_limit(prds_m, limit_m, expected):
    found = first_allowed(np.array([0.3, 0.4, 0.5]), np.array(prds_m), limit_m)
    assert found == pytest.approx(expected, rel=1e-14, nan_ok=True)


@pytest.mark.parametrize(
    ("prds_m", "expected"),
    [
        ((0.1, 0.2, 0.4, 0.3), 3.0),
        ((0.1, 0.2, 0.3, 0.3), 6.0),
        ((0.1, 0.2, NONE, 0.3), 2.0),
        ((0.4, 0.2, 0.2, 0.2), NONE),
    ],
)
def test_largest_slope_is_below_every_slope_that_exceeds_the_limit(prds_m, expected):
    found = first_allowed(np.array([6.0, 4.0, 2.0, 0.0]), np.array(prds_m[::-1]), 0.3)
    assert found == pytest.approx(expected, rel=1e-14, nan_ok=True)


TRUTH = (-2.0, 2.5, -1.2, 0.9, 3.0)
PPA = 1.3


GRID = np.meshgrid(np.radians([0.0, 2.0, 4.0]), [0.3, 0.45, 0.6], np.linspace(0.2, 2.0, 10))
CASES = tuple(values.ravel() for values in GRID)
"""Slopes, friction coefficients and intensities."""


def yielding(slope, mu, x, ppa=PPA):
    """The yield acceleration over the peak."""
    return np.tan(np.arctan(mu) - slope) / (ppa * x)


def formula(b, slope, mu, x, ppa=PPA):
    r = yielding(slope, mu, x, ppa)
    with np.errstate(invalid="ignore"):
        terms = np.log(1.0 - r), np.log(r), np.log(x), slope / mu
    return np.exp(b[0] + sum(factor * term for factor, term in zip(b[1:], terms, strict=True)))


PRD = np.nan_to_num(formula(TRUTH, *CASES))
NOISY = PRD * np.exp(0.2 * np.random.default_rng(2).standard_normal(90))


def test_data_that_follow_the_formula_give_its_coefficients():
    found = fit_prd(*CASES, PRD, ppa_g=PPA)
    assert found.coefficients == pytest.approx(TRUTH, rel=1e-9)
    assert found.sigma_ln < 1e-12
    assert found.prd_m(0.05, 0.4, 1.0) == pytest.approx(formula(TRUTH, 0.05, 0.4, 1.0), rel=1e-9)


def test_the_errors_are_those_of_the_coefficients_as_printed():
    found = fit_prd(*CASES, NOISY, ppa_g=1.2345678)
    assert found.sigma_ln == pytest.approx(0.2, rel=0.2)
    printed = [float(f"{b:.{DIGITS}g}") for b in found.coefficients]
    assert list(found.coefficients) == printed
    assert found.ppa_g == 1.235
    fitted = (NOISY >= 0.005) & (yielding(*CASES, found.ppa_g) <= 0.9)
    ratio = (NOISY / formula(printed, *CASES, found.ppa_g))[fitted]
    assert found.minimum_ratio == pytest.approx(ratio.min(), rel=1e-12)
    assert found.maximum_ratio == pytest.approx(ratio.max(), rel=1e-12)


@pytest.mark.parametrize(
    ("slope", "mu", "x"),
    [(0.2, 0.45, 1.0), (0.0, 0.2, 1.0), (0.0, 0.45, 3.0), (0.0, 0.6, 0.25), (0.0, math.nan, 1.0)],
)
def test_a_case_outside_of_its_domain_is_not_covered(slope, mu, x):
    assert not fit_prd(*CASES, PRD, ppa_g=PPA).covers(slope, mu, x)


def test_every_fitted_case_is_in_the_domain():
    found = fit_prd(*CASES, PRD, ppa_g=PPA)
    fitted = (PRD >= 0.005) & (yielding(*CASES) <= 0.9)
    assert fitted.sum() == found.cases
    assert all(found.covers(*case) for case in np.stack(CASES, axis=-1)[fitted])


def test_cases_that_determine_no_formula_are_refused():
    with pytest.raises(InputError, match="0 cases"):
        fit_prd(*CASES, np.full(90, math.nan), ppa_g=PPA)
    x = CASES[2]
    with pytest.raises(InputError, match="do not determine"):
        fit_prd(np.zeros(90), np.full(90, 0.4), x, formula(TRUTH, 0.0, 0.4, x), ppa_g=PPA)


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


def runs(dry, wet=(), report="R"):
    return series(
        FrictionRun(
            report=report, surface=surface, velocity_mps=math.nan, mu=mu, mu_static=math.nan
        )
        for surface, values in ((Surface.DRY, dry), (Surface.WET, wet))
        for mu in values
    )


def test_one_surface_has_the_prediction_interval_of_the_textbook():
    """Mean 0.5, s 0.03, n 4: t of 3 degrees at 0.9 is 1.6377."""
    found = predictive(runs([0.47, 0.47, 0.53, 0.53]))
    s = math.sqrt(4 * 0.03**2 / 3)
    assert (found.mean, found.runs, found.freedom) == (0.5, 4, 3)
    assert found.within == pytest.approx(s, rel=1e-12)
    assert found.between == 0.0
    assert math.isnan(found.p_value)
    assert found.quantile(0.9) == pytest.approx(0.5 + 1.63774 * s * math.sqrt(1.25), rel=1e-5)
    assert found.quantiles == pytest.approx([found.quantile(q) for q in QUANTILES])


def test_wet_and_dry_share_their_scatter_and_the_least_mean_governs():
    found = predictive(runs([0.58, 0.60, 0.62], [0.49, 0.50, 0.51]))
    assert found.mean == pytest.approx(0.50)
    assert (found.runs, found.freedom) == (3, 4)
    assert found.within == pytest.approx(math.sqrt((2 * 0.02**2 + 2 * 0.01**2) / 4), rel=1e-12)
    # Means 0.1 apart: mean square 3 * 2 * 0.05^2, less that of the runs, by 3 runs each.
    assert found.between == pytest.approx(math.sqrt((0.015 - found.within**2) / 3), rel=1e-9)
    by_scipy = f_oneway([0.58, 0.60, 0.62], [0.49, 0.50, 0.51]).pvalue
    assert found.p_value == pytest.approx(float(by_scipy), rel=1e-12)


def test_ninety_of_a_hundred_new_runs_exceed_the_lowest_quantile():
    rng = np.random.default_rng(5)
    tested = rng.normal(0.5, 0.04, (800, 3))
    below = [rng.normal(0.5, 0.04) < predictive(runs(one)).quantiles[0] for one in tested]
    assert np.mean(below) == pytest.approx(0.1, abs=0.03)


def test_more_runs_reach_what_scatter_permits():
    found = predictive(runs([0.47, 0.50, 0.53]))
    lowest = found.quantiles[0]
    assert found.more_runs(lowest) == 0
    needed = found.more_runs(0.455)
    assert 0 < needed < 100
    # With three runs on the surface and needed more, by hand.
    assert predictive(runs([0.47, 0.50, 0.53] * 2)).quantiles[0] > lowest
    assert found.more_runs(0.49) == math.inf


@pytest.mark.parametrize(
    ("dry", "wet", "said"),
    [([0.5, 0.52], [0.4], "3 friction runs on 2 surfaces"), ([0.1, 0.9, 0.2], (), "may be 0")],
)
def test_too_few_runs_and_a_coefficient_of_zero_are_refused(dry, wet, said):
    with pytest.raises(InputError, match=said):
        predictive(runs(dry, wet))
