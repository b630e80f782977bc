"""The predictive distribution of a friction coefficient: textbook values and coverage."""

import math

import numpy as np
import pytest
from scipy.stats import f_oneway

from solver.friction_tests import FrictionRun, Surface, series
from solver.model import InputError
from solver.studies.predictive import QUANTILES, predictive


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
