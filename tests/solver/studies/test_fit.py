"""The fitted formula: exact where the data follow it, refused outside, errors as stated."""

import math

import numpy as np
import pytest

from solver.model import InputError
from solver.studies.curves import DIGITS, fit_prd

pytestmark = pytest.mark.quick

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


def test_the_error_is_that_of_the_data():
    found = fit_prd(*CASES, NOISY, ppa_g=PPA)
    assert found.sigma_ln == pytest.approx(0.2, rel=0.2)
    assert found.minimum_ratio < 1.0 < found.maximum_ratio


def test_the_errors_are_those_of_the_coefficients_as_printed():
    found = fit_prd(*CASES, NOISY, ppa_g=1.2345678)
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
