"""The fitted formula: exact where the data follow it, refused outside, errors as stated."""

import math

import numpy as np
import pytest

from solver.model import InputError
from solver.studies.fit import DIGITS, fit_prd

TRUTH = (-2.0, 2.5, -1.2, 0.9, 3.0)
PPA = 1.3


def cases():
    grid = np.meshgrid(np.radians([0.0, 2.0, 4.0]), [0.3, 0.45, 0.6], np.linspace(0.2, 2.0, 10))
    return tuple(values.ravel() for values in grid)


def prd(slope, mu, x):
    r = np.tan(np.arctan(mu) - slope) / (PPA * x)
    with np.errstate(invalid="ignore"):
        terms = [np.ones_like(r), np.log(1.0 - r), np.log(r), np.log(x), slope / mu]
    return np.exp(sum(b * term for b, term in zip(TRUTH, terms, strict=True)))


def test_data_that_follow_the_formula_give_its_coefficients():
    found = fit_prd(*cases(), np.nan_to_num(prd(*cases())), ppa_g=PPA)
    assert found.coefficients == pytest.approx(TRUTH, rel=1e-9)
    assert found.sigma_ln < 1e-12
    assert found.prd_m(0.05, 0.4, 1.0) == pytest.approx(prd(0.05, 0.4, 1.0), rel=1e-9)


def test_the_error_is_that_of_the_data():
    noise = np.exp(0.2 * np.random.default_rng(2).standard_normal(90))
    found = fit_prd(*cases(), np.nan_to_num(prd(*cases())) * noise, ppa_g=PPA)
    assert found.sigma_ln == pytest.approx(0.2, rel=0.2)
    assert found.least_ratio < 1.0 < found.greatest_ratio


def test_the_errors_are_those_of_the_coefficients_as_printed():
    noise = np.exp(0.2 * np.random.default_rng(2).standard_normal(90))
    data, peak = np.nan_to_num(prd(*cases())) * noise, 1.2345678
    found = fit_prd(*cases(), data, ppa_g=peak)
    printed = [float(f"{b:.{DIGITS}g}") for b in found.coefficients]
    assert list(found.coefficients) == printed
    assert found.ppa_g == 1.235
    slope, mu, x = cases()
    r = np.tan(np.arctan(mu) - slope) / (found.ppa_g * x)
    fitted = (data >= 0.005) & (r <= 0.9)
    terms = [np.ones_like(r[fitted]), np.log(1 - r[fitted]), np.log(r[fitted]), np.log(x[fitted]),
             (slope / mu)[fitted]]  # fmt: skip
    ratio = data[fitted] / np.exp(sum(b * term for b, term in zip(printed, terms, strict=True)))
    assert found.least_ratio == pytest.approx(ratio.min(), rel=1e-12)
    assert found.greatest_ratio == pytest.approx(ratio.max(), rel=1e-12)


@pytest.mark.parametrize(
    ("slope", "mu", "x", "named"),
    [(0.2, 0.45, 1.0, "slope_rad"), (0.0, 0.2, 1.0, "mu"), (0.0, 0.45, 3.0, "intensity"),
     (0.0, 0.6, 0.25, "r is"), (0.0, math.nan, 1.0, "mu")],
)  # fmt: skip
def test_outside_of_its_domain_it_is_refused_with_the_range(slope, mu, x, named):
    found = fit_prd(*cases(), np.nan_to_num(prd(*cases())), ppa_g=PPA)
    assert not found.covers(slope, mu, x)
    with pytest.raises(InputError, match=named) as caught:
        found.prd_m(slope, mu, x)
    assert "the formula holds from" in str(caught.value)


def test_every_fitted_case_is_in_the_domain():
    slope, mu, x = cases()
    values = np.nan_to_num(prd(slope, mu, x))
    found = fit_prd(slope, mu, x, values, ppa_g=PPA)
    r = np.tan(np.arctan(mu) - slope) / (PPA * x)
    fitted = (values >= 0.005) & (r <= 0.9)
    assert fitted.sum() == found.cases
    assert all(found.covers(*case) for case in np.stack([slope, mu, x], axis=-1)[fitted])


def test_cases_that_determine_no_formula_are_refused():
    slope, mu, x = cases()
    with pytest.raises(InputError, match="0 cases"):
        fit_prd(slope, mu, x, np.full(90, math.nan), ppa_g=PPA)
    with pytest.raises(InputError, match="do not determine"):
        fit_prd(0.0 * slope, 0.4 + 0.0 * mu, x, prd(0.0, 0.4, x), ppa_g=PPA)
