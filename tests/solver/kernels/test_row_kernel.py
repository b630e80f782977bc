"""The row's kernels with the compiler off, and roots of their polynomials."""

import math

import numpy as np
import pytest

from fixtures.blocks import readonly
from solver.kernels import row

pytestmark = pytest.mark.quick

# Pushes, normal forces, friction and masses of the blocks, stiffness, damping.
SCENES = [
    ([2.0, 6.0, -7.0, 3.0, 0.0, 0.0], [10.0] * 6, [0.2, 0.5], [1.0, 1.0], 40.0, 2.0),
    ([0.0, 6.0, -7.0, 3.0], [10.0, 8.0, 9.0, 9.0], [0.2, 0.0, 0.5], [0.5, 1.5, 1.0], 300.0, 0.0),
    ([0.0, 4.0, 4.0, -4.0, 0.0, 0.0], [10.0] * 6, [0.2], [1.0], 0.0, 0.0),
    ([3.0, 3.0, 3.0, 3.0], [10.0] * 4, [5.0, 0.0], [1.0, 1.0], 0.0, 3.0),
    ([3.0, 3.0, 3.0, 3.0], [10.0] * 4, [5.0, 0.0], [1.0, 1.0], 0.0, 0.0),
]  # fmt: skip


def run_all(follow):
    numbers = []
    for drive, normal, mus, m, k, c in SCENES:
        for most in (1000, 0):
            count = len(mus)
            peaks, links = np.empty((count, 4)), np.empty((count - 1, 2))
            samples = np.full((count, len(drive)), -1.0)
            for places in (samples, None):
                numbers += follow(
                    readonly(drive), readonly(normal), 0.2, np.array(mus), np.array(m), k, c, most,
                    peaks, links, places,
                )  # fmt: skip
                numbers += [*peaks.ravel(), *links.ravel()]
            numbers += [*samples.ravel()]
    return np.array(numbers, dtype=float)


@pytest.mark.nightly
def test_compiled_and_plain_kernels_give_the_same_motion():
    """To rounding: the compiler may contract a product and a sum."""
    follow = row.slide_row
    plain = getattr(follow, "py_func", follow)
    np.testing.assert_allclose(run_all(follow), run_all(plain), rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize(
    ("series", "root"),
    [
        ([1.0, -2.0], 0.5),
        ([1.0, -1.9, 0.0, 1.2], None),  # comes down and touches nothing
        ([0.25, -1.0, 1.0], 0.5),  # touches zero
        ([0.25 - 1e-9, -1.0, 1.0], 0.5 - 1e-9**0.5),  # two roots close to each other
        ([0.25 + 1e-9, -1.0, 1.0], None),
        ([0.0, 1.0, -2.0], 0.5),  # begins at zero and rises
        ([0.0, -1.0, 2.0], 0.0),  # begins at zero and falls
        ([-1.0, 5.0, 0.0], 0.0),  # is below already
        ([1e-20, 1.0, -4.0], 0.25),
        ([0.5, -0.5, 0.0], None),  # not before the end
        ([0.0, 1.0, 0.0], None),
        ([0.0, 0.0, 0.0], None),
    ],
)
def test_the_first_root_is_found_and_none_is_made_up(series, root):
    """A double root to the root of a rounding: no more can be seen of it."""
    x, falls = row._first_below(np.array(series), len(series) - 1)
    assert falls == (root is not None)
    within = math.sqrt(row.ZERO * row.EPS * np.abs(series).sum())
    assert x == pytest.approx(row.NEVER if root is None else root, abs=within)


@pytest.mark.parametrize("seed", range(20))
def test_no_root_of_a_polynomial_is_stepped_over(seed):
    rng = np.random.default_rng(seed)
    for _ in range(50):
        series = rng.normal(size=8) / [1, 1, 2, 6, 24, 120, 720, 5040]
        series[0] = abs(series[0]) * 0.2
        roots = np.roots(series[::-1])
        real = sorted(r.real for r in roots if abs(r.imag) < 1e-12 and 0.0 <= r.real < 1.0)
        x, _ = row._first_below(series, 7)
        assert x == pytest.approx(real[0] if real else row.NEVER, abs=1e-9)


def test_flat_lines_and_turning_polynomials_are_searched():
    """(x - 1/2)^4 comes to zero so slowly that the steps run out first."""
    x, falls = row._first_below(np.array([0.0625, -0.5, 1.5, -2.0, 1.0]), 4)
    assert not falls
    assert 0.3 < x < 0.5
    turning = np.array([0.0, 1.0, -1.0])
    assert row._largest(turning, 2, 1.0) == pytest.approx(0.25, rel=1e-15)
    assert row._largest(turning, 2, 0.25) == pytest.approx(0.1875, rel=1e-15)
    assert row._largest(-turning, 2, 2.0) == 2.0
