"""The fragility's kernels with the compiler off, and against theory and another optimizer."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import norm

from solver.kernels import fragility as kernel

SETS = [
    ([0.1, -0.3, 0.2, 0.4, 0.4], [0, 0, 0, 1, 1]),
    ([0.1, -0.3, 0.2, 0.5, 0.4], [0, 0, 0, 0, 0]),
    ([-2.0, 3.0, -1.9, -1.8, 9.0, 9.0, 9.0], [0, 0, 1, 1, 1, 1, 1]),
    ([0.0, 0.01, 5.0, 5.0, 5.0, 5.0], [0, 0, 1, 1, 1, 1]),
    ([0.1, 0.1, 0.4], [0, 0, 1]),
    ([0.1, 0.2], [0, 1]),
]


ARRAYS = [(np.array(values), np.array(flags, dtype=bool)) for values, flags in SETS]


@pytest.mark.parametrize("one", ARRAYS)
def test_fits_without_the_compiler_agree(one):
    fit = kernel.fit_censored
    plain = getattr(fit, "py_func", fit)
    assert plain(*one) == pytest.approx(fit(*one), rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("one", ARRAYS[4:])
def test_fewer_than_two_different_values_determine_none(one):
    *numbers, status = kernel.fit_censored(*one)
    assert status == kernel.NOT_FINITE
    assert np.isnan(numbers).all()


def test_standard_errors_of_uncensored_values_are_those_of_theory():
    _, deviation, of_mean, of_log, _ = kernel.fit_censored(*ARRAYS[1])
    assert of_mean == pytest.approx(deviation / math.sqrt(5), rel=1e-12)
    assert of_log == pytest.approx(1.0 / math.sqrt(10), rel=1e-12)


@pytest.mark.parametrize("one", ARRAYS[:4])
@pytest.mark.parametrize("off", [-1.5, 0.0, 0.7, 4.0])
def test_the_likelihood_of_a_mean_is_largest_as_another_optimizer_finds(one, off):
    y, flags = one

    def less(log_deviation, mean):
        z = (y - mean) / math.exp(log_deviation)
        return -np.sum(np.where(flags, norm.logsf(z), norm.logpdf(z) - log_deviation))

    mean, deviation, *_ = kernel.fit_censored(y, flags)
    best = minimize_scalar(less, args=(mean + off,), bounds=(-8, 8), options={"xatol": 1e-10})
    found = kernel.log_likelihood_at(y, flags, mean + off, deviation)
    assert found == pytest.approx(-best.fun, abs=1e-8)
    fit = np.empty((1, 5))
    kernel.fit_many(y[None], flags[None], mean + off, fit)
    own = less(math.log(deviation), mean)
    assert fit[0, 4] == pytest.approx(2.0 * (best.fun - own), abs=1e-8)


def test_tails_are_finite_far_out():
    for z in (-40.0, -30.0, 0.0, 40.0):
        assert np.isfinite(kernel.inverse_mills(z))
    assert kernel.inverse_mills(-36.1) == pytest.approx(kernel.inverse_mills(-35.9), rel=0.01)


def test_rows_without_a_fit_are_nan():
    y, flags = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]), np.zeros((2, 3), dtype=bool)
    found = np.empty((2, 5))
    kernel.fit_many(y, flags, 1.0, found)
    assert np.isfinite(found[0]).all()
    assert found[0, 4] == pytest.approx(0.0, abs=1e-12)
    assert np.isnan(found[1]).all()
