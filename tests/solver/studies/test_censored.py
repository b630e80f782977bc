"""The normal of censored values against theory and another optimizer."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import norm

from solver.studies.fragility import deviance, fit_normals, inverse_mills, log_likelihood

pytestmark = pytest.mark.quick

SETS = [
    ([0.1, -0.3, 0.2, 0.4, 0.4], [0, 0, 0, 1, 1]),
    ([0.1, -0.3, 0.2, 0.5, 0.4], [0, 0, 0, 0, 0]),
    ([-2.0, 3.0, -1.9, -1.8, 9.0, 9.0, 9.0], [0, 0, 1, 1, 1, 1, 1]),
    ([0.0, 0.01, 5.0, 5.0, 5.0, 5.0], [0, 0, 1, 1, 1, 1]),
    ([0.1, 0.1, 0.4], [0, 0, 1]),
    ([0.1, 0.2], [0, 1]),
]


ARRAYS = [(np.array([values]), np.array([flags], dtype=bool)) for values, flags in SETS]


@pytest.mark.parametrize("one", ARRAYS[4:])
def test_fewer_than_two_different_values_determine_none(one):
    found = fit_normals(*one)
    assert np.isnan([found.mean, found.deviation, found.of_mean, found.of_log]).all()


def test_standard_errors_of_uncensored_values_are_those_of_theory():
    found = fit_normals(*ARRAYS[1])
    assert found.of_mean == pytest.approx(found.deviation / math.sqrt(5), rel=1e-12)
    assert found.of_log == pytest.approx(1.0 / math.sqrt(10), rel=1e-12)


@pytest.mark.parametrize("one", ARRAYS[:4])
@pytest.mark.parametrize("off", [-1.5, 0.0, 0.7, 4.0])
def test_the_likelihood_of_a_mean_is_largest_as_another_optimizer_finds(one, off):
    y, flags = one

    def less(log_deviation, mean):
        z = (y - mean) / math.exp(log_deviation)
        return -np.sum(np.where(flags, norm.logsf(z), norm.logpdf(z) - log_deviation))

    found = fit_normals(y, flags)
    mean = float(found.mean[0])
    best = minimize_scalar(less, args=(mean + off,), bounds=(-8, 8), options={"xatol": 1e-10})
    own = less(math.log(found.deviation[0]), mean)
    assert log_likelihood(y, flags, found.mean, 1.0 / found.deviation) == pytest.approx(-own)
    assert deviance(y, flags, mean + off, found)[0] == pytest.approx(
        2.0 * (best.fun - own), abs=1e-8
    )


def test_tails_are_finite_far_out():
    for z in (-40.0, -30.0, 0.0, 40.0):
        assert np.isfinite(inverse_mills(z))
    assert inverse_mills(-1e4) == pytest.approx(1e4, rel=1e-7)


def test_rows_without_a_fit_are_nan():
    y, flags = np.array([[0.0, 1.0, 2.0], [1.0, 1.0, 1.0]]), np.zeros((2, 3), dtype=bool)
    found = fit_normals(y, flags)
    assert found.mean[0] == 1.0
    deviances = deviance(y, flags, 1.0, found)
    assert deviances[0] == pytest.approx(0.0, abs=1e-12)
    assert np.isnan([found.mean[1], found.of_mean[1], deviances[1]]).all()
