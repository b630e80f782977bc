"""The fragility's kernels with the compiler off: the same numbers, and every line run."""

import math
import os

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import norm

from solver.kernels import fragility as kernel
from uncompiled import assert_every_line_runs

SETS = [
    ([0.1, -0.3, 0.2, 0.4, 0.4], [0, 0, 0, 1, 1]),
    ([0.1, -0.3, 0.2, 0.5, 0.4], [0, 0, 0, 0, 0]),
    ([-2.0, 3.0, -1.9, -1.8, 9.0, 9.0, 9.0], [0, 0, 1, 1, 1, 1, 1]),
    ([0.0, 0.01, 5.0, 5.0, 5.0, 5.0], [0, 0, 1, 1, 1, 1]),
    ([0.1, 0.1, 0.4], [0, 0, 1]),
    ([0.1, 0.2], [0, 1]),
]


def arrays(values, flags):
    return np.array(values), np.array(flags, dtype=bool)


def pure(function):
    return getattr(function, "py_func", function)


def test_fits_without_the_compiler_agree():
    for one in SETS:
        y, flags = arrays(*one)
        assert pure(kernel.fit_censored)(y, flags) == pytest.approx(
            kernel.fit_censored(y, flags), rel=1e-9, nan_ok=True
        )


@pytest.mark.parametrize("one", SETS[4:])
def test_fewer_than_two_different_values_determine_none(one):
    *numbers, status = kernel.fit_censored(*arrays(*one))
    assert status == kernel.NOT_FINITE
    assert np.isnan(numbers).all()


def test_standard_errors_of_uncensored_values_are_those_of_theory():
    y, flags = arrays(*SETS[1])
    _, deviation, of_mean, of_log, _ = kernel.fit_censored(y, flags)
    assert of_mean == pytest.approx(deviation / math.sqrt(5), rel=1e-12)
    assert of_log == pytest.approx(1.0 / math.sqrt(10), rel=1e-12)


@pytest.mark.parametrize("one", SETS[:4])
@pytest.mark.parametrize("off", [-1.5, 0.0, 0.7, 4.0])
def test_the_likelihood_of_a_mean_is_largest_as_another_optimizer_finds(one, off):
    y, flags = arrays(*one)

    def less(log_deviation, mean):
        z = (y - mean) / math.exp(log_deviation)
        return -np.sum(np.where(flags, norm.logsf(z), norm.logpdf(z) - log_deviation))

    mean, deviation, *_ = kernel.fit_censored(y, flags)
    best = minimize_scalar(less, args=(mean + off,), bounds=(-8, 8), options={"xatol": 1e-10})
    found = kernel.log_likelihood_at(y, flags, mean + off, deviation)
    assert found == pytest.approx(-best.fun, abs=1e-8)
    ratio = np.empty(1)
    kernel.deviances(y[None], flags[None], mean + off, ratio)
    own = less(math.log(deviation), mean)
    assert ratio[0] == pytest.approx(2.0 * (best.fun - own), abs=1e-8)


def test_tails_are_finite_far_out():
    for z in (-40.0, -30.0, 0.0, 40.0):
        assert np.isfinite(kernel.inverse_mills(z))
    assert kernel.inverse_mills(-36.1) == pytest.approx(kernel.inverse_mills(-35.9), rel=0.01)


def test_rows_without_a_fit_are_nan():
    y, flags = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]), np.zeros((2, 3), dtype=bool)
    found, ratios = np.empty((2, 4)), np.empty(2)
    kernel.fit_many(y, flags, found)
    kernel.deviances(y, flags, 1.0, ratios)
    assert np.isfinite(found[0]).all()
    assert ratios[0] == pytest.approx(0.0, abs=1e-12)
    assert np.isnan(found[1]).all()
    assert np.isnan(ratios[1])


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="this is the run without it")
@pytest.mark.nightly("solver/kernels/fragility.py")
def test_every_line_of_the_kernels_runs(tmp_path):
    assert_every_line_runs("solver/kernels/fragility.py", __file__, tmp_path)
