"""The design equation: exact where the runs follow it, and published values of the others."""

from dataclasses import replace

import numpy as np
import pytest

from projects.curves.equation import (
    LEAST_PRD_M,
    Equation,
    RoofRuns,
    ambraseys_menu_m,
    fit_equation,
    jibson_m,
    saygili_rathje_m,
    scatter,
)
from solver.model import STANDARD_GRAVITY_MPS2, InputError

pytestmark = pytest.mark.quick

TRUTH = Equation(c=3.0, p=2.5, s=1.8)


def runs(count=400, seed=1):
    """Runs with the PRD of the formula."""
    rng = np.random.default_rng(seed)
    peaks = {
        "ppa_mps2": rng.uniform(3.0, 30.0, count),
        "ppv_mps": rng.uniform(0.3, 3.0, count),
        "slope_rad": np.radians(rng.uniform(0.0, 7.0, count)),
        "mu": rng.uniform(0.3, 1.0, count),
    }
    made = RoofRuns(**peaks, prd_m=np.zeros(count))
    with np.errstate(invalid="ignore"):
        return RoofRuns(**peaks, prd_m=TRUTH.prd_m(made))


def test_runs_that_follow_the_formula_give_its_constants_whatever_their_parts():
    made = runs()
    assert 100 < made.holds.sum() < made.holds.size  # some slide too little, and are not fitted
    parts = [made.only(np.arange(400) % 3 == k) for k in range(3)]
    assert fit_equation([made]) == fit_equation(parts) == TRUTH


def test_the_scatter_is_that_of_the_runs():
    made = runs().only(runs().holds)
    off = np.random.default_rng(2).normal(0.1, 0.5, made.prd_m.size)
    found = scatter(made.prd_m * np.exp(off), TRUTH.prd_m(made))
    assert (found.mean, found.deviation) == pytest.approx((off.mean(), off.std()))
    assert found.runs == off.size


def test_what_hardly_slides_or_has_no_value_is_not_fitted():
    made = RoofRuns(
        ppa_mps2=np.full(4, 10.0),
        ppv_mps=np.ones(4),
        slope_rad=np.zeros(4),
        mu=np.array([0.5, 0.5, 0.5, 1.0]),
        prd_m=np.array([LEAST_PRD_M, np.nan, 0.5 * LEAST_PRD_M, 1.0]),
    )
    assert made.holds.tolist() == [True, False, False, False]  # the last has r = 0.98


def test_runs_on_one_slope_do_not_determine_it():
    flat = replace(runs(), slope_rad=np.zeros(400), prd_m=np.ones(400))
    with pytest.raises(InputError, match="more slopes"):
        fit_equation([flat])


def test_published_formulas_give_what_their_terms_do_by_hand():
    half = RoofRuns(
        ppa_mps2=np.array([STANDARD_GRAVITY_MPS2]),
        ppv_mps=np.array([1.0]),
        slope_rad=np.zeros(1),
        mu=np.array([0.5]),
        prd_m=np.zeros(1),
    )
    assert half.r == pytest.approx(0.5)
    # 10^0.90 0.5^(2.53 - 1.09) and 10^0.215 0.5^(2.341 - 1.438) cm
    assert ambraseys_menu_m(half) == pytest.approx(0.02928, rel=1e-3)
    assert jibson_m(half) == pytest.approx(0.00877, rel=1e-3)
    # exp(-1.56 - 2.29 - 5.21 + 5.59375 - 1.90625 + 1.55 ln 100) cm
    assert saygili_rathje_m(half) == pytest.approx(0.01 * np.exp(1.76551), rel=1e-4)
