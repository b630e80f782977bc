"""The fragility's kernels with the compiler off: the same numbers, and every line run."""

import os

import numpy as np
import pytest

from solver.kernels import fragility as kernel
from uncompiled import assert_every_line_runs

X = np.log([1e-9, 0.5, 1.0, 2.0, 4.0, 1e9])
COUNTS = [
    ([0, 1, 3, 4, 6, 6], [6.0] * 6),
    ([0, 0, 0, 6, 6, 6], [6.0] * 6),
    ([5, 4, 3, 2, 1, 0], [6.0] * 6),
    ([1, 0, 0, 0, 0, 0], [394.0] * 6),
    ([0, 30, 0, 0, 0, 40], [40.0] * 6),
    ([0, 0, 0, 0, 0, 0], [0.0] * 6),
]


def pure(function):
    return getattr(function, "py_func", function)


def test_lines_without_the_compiler_agree():
    for k, n in COUNTS:
        counts = np.array(k, float), np.array(n)
        assert pure(kernel.fit_probit)(X, *counts) == pytest.approx(
            kernel.fit_probit(X, *counts), rel=1e-9, nan_ok=True
        )


def test_one_level_determines_no_line():
    x = np.zeros(2)
    a, b, status = kernel.fit_probit(x, np.array([1.0, 2.0]), np.array([4.0, 4.0]))
    assert status == kernel.NOT_FINITE
    assert np.isnan([a, b]).all()


def test_levels_that_are_equal_but_for_rounding_determine_no_line():
    x = np.array([0.0, 5e-324])
    _, _, status = kernel.fit_probit(x, np.array([1.0, 2.0]), np.array([4.0, 4.0]))
    assert status == kernel.NOT_FINITE


def test_tails_are_finite_far_out():
    for z in (-40.0, -30.0, 0.0, 40.0):
        assert np.isfinite(kernel._inverse_mills(z))
    assert kernel._inverse_mills(-36.1) == pytest.approx(kernel._inverse_mills(-35.9), rel=0.01)


def test_rows_without_a_line_are_nan():
    k = np.array([[0.0, 1.0, 0.0, 30.0, 30.0, 30.0], [0.0] * 6])
    n, lines = np.full((2, 6), 30.0), np.empty((2, 2))
    kernel.fit_many(40.0 * X, k, n, lines)
    assert lines[0, 1] > 0.0
    assert np.isnan(lines[1]).all()


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="this is the run without it")
@pytest.mark.nightly("solver/kernels/fragility.py")
def test_every_line_of_the_kernels_runs(tmp_path):
    assert_every_line_runs("solver/kernels/fragility.py", __file__, tmp_path)
