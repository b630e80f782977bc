"""Periods worked by hand, and modes of uniform buildings against many digits and textbooks."""

import math

import mpmath
import numpy as np
import pytest

from fixtures.errors import input_problems
from fixtures.marks import by_day
from solver.building.structure import beam_modes, floor_stiffness, story_modes
from solver.rules.hazard import FOOT_M, approximate_period_s

ALPHAS = [0.0, 0.3, 1.0, 2.0, 5.0, 12.5, 30.0, 200.0]


@pytest.mark.parametrize("alpha0", ALPHAS[:-1])
@pytest.mark.parametrize("n", by_day([1, 2, 4, 7], 2))
@pytest.mark.quick
def test_modes_solve_their_equation_to_rounding(alpha0, n):
    """Shape, frequency and participation with 40 digits, from the boundary conditions alone."""
    modes = beam_modes(alpha0, n, [0.37, 1.0])
    with mpmath.workdps(40):
        a = mpmath.mpf(alpha0)
        first, gamma = (_root(a, k) for k in (1, n))
        beta = mpmath.sqrt(gamma**2 + a**2)
        ratio = first * mpmath.sqrt(first**2 + a**2) / (gamma * beta)
        matrix = _conditions(gamma, beta, a)
        c, d = -matrix[0, 1], matrix[0, 0]

        def shape(x):
            odd = mpmath.sin(gamma * x) - gamma / beta * mpmath.sinh(beta * x)
            return c * odd + d * (mpmath.cosh(beta * x) - mpmath.cos(gamma * x))

        nodes, weights = np.polynomial.legendre.leggauss(40)
        at = (np.arange(4)[:, None] + 0.5 * (1.0 + nodes)).ravel() / 4.0
        values = [shape(mpmath.mpf(x)) for x in at]
        shares = np.tile(weights, 4) / 8.0
        whole = sum(w * v for w, v in zip(shares, values, strict=True))
        squared = sum(w * v * v for w, v in zip(shares, values, strict=True))
        factors = [float(whole / squared * shape(mpmath.mpf(x))) for x in (0.37, 1.0)]
    np.testing.assert_allclose(modes.period_ratios[-1], float(ratio), rtol=1e-12)
    np.testing.assert_allclose(modes.factors[-1], factors, rtol=1e-11)


def _conditions(gamma, beta, a):
    """No moment and no shear at the top, of the two shapes that are clamped at the base."""
    s, c = mpmath.sin(gamma), mpmath.cos(gamma)
    sh, ch = mpmath.sinh(beta), mpmath.cosh(beta)
    moment = [-(gamma**2) * s - gamma * beta * sh, beta**2 * ch + gamma**2 * c]
    shear = [
        -(gamma**3) * c - gamma * beta**2 * ch - a**2 * gamma * (c - ch),
        beta**3 * sh - gamma**3 * s - a**2 * (beta * sh + gamma * s),
    ]
    return mpmath.matrix([moment, shear])


def _root(a, n):
    def condition(gamma):
        beta = mpmath.sqrt(gamma**2 + a**2)
        matrix = _conditions(gamma, beta, a)
        return matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0]

    low, high = (n - 1) * mpmath.pi + mpmath.mpf("1e-6"), n * mpmath.pi
    assert condition(low) * condition(high) < 0
    for _ in range(130):
        middle = (low + high) / 2
        same = condition(middle) * condition(low) > 0
        low, high = (middle, high) if same else (low, middle)
    return low


def test_beams_that_only_bend_or_shear_have_textbook_values():
    modes = beam_modes(0.0, 4)
    gamma = np.array([1.8751040687, 4.6940911330, 7.8547574382, 10.9955407349])
    np.testing.assert_allclose(1.0 / modes.period_ratios, (gamma / gamma[0]) ** 2, rtol=1e-9)
    np.testing.assert_allclose(modes.factors[:, 0], [1.5660, -0.8679, 0.5089, -0.3638], atol=1e-4)
    modes = beam_modes(math.inf, 5, [0.5, 1.0])
    odd, signs = np.array([1.0, 3.0, 5.0, 7.0, 9.0]), np.array([1.0, -1.0, 1.0, -1.0, 1.0])
    np.testing.assert_allclose(1.0 / modes.period_ratios, odd, rtol=1e-14)
    np.testing.assert_allclose(modes.factors[:, 1], 4.0 / math.pi * signs / odd, rtol=1e-14)
    assert modes.factors[0, 0] == pytest.approx(4.0 / math.pi * math.sin(math.pi / 4))
    near, limit = beam_modes(1000.0, 6), beam_modes(math.inf, 6)
    np.testing.assert_allclose(near.period_ratios, limit.period_ratios, rtol=1e-3)
    np.testing.assert_allclose(near.factors, limit.factors, rtol=2e-3)


@pytest.mark.parametrize("alpha0", [*ALPHAS, math.inf])
def test_factors_of_all_modes_sum_to_one_at_any_height(alpha0):
    sums = np.cumsum(beam_modes(alpha0, 4000, [0.4, 1.0]).factors, axis=0)
    np.testing.assert_allclose(sums[-1], 1.0, atol=1e-3)


@pytest.mark.parametrize("stories", [1, 2, 3, 8, 40, 100])
@pytest.mark.quick
def test_a_shear_building_of_stories_has_its_closed_form(stories):
    modes = story_modes(math.inf, stories)
    angle = (2 * np.arange(1, stories + 1) - 1) * math.pi / (2 * stories + 1)
    frequency = np.sin(angle / 2)
    np.testing.assert_allclose(modes.period_ratios, frequency[0] / frequency, rtol=1e-9)
    floors = np.arange(1, stories + 1)
    shapes = np.sin(angle[:, None] * floors)
    expected = shapes.sum(axis=1) * shapes[:, -1] / (shapes**2).sum(axis=1)
    np.testing.assert_allclose(modes.factors[:, 0], expected, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("alpha0", [0.0, 3.0, math.inf])
def test_stories_become_the_beam_or_one_oscillator(alpha0):
    beam = beam_modes(alpha0, 3)
    off = [np.abs(story_modes(alpha0, n).factors[:3] - beam.factors).max() for n in (20, 40, 80)]
    assert off[2] < 0.04
    assert off[0] / off[1] > 1.75
    assert off[1] / off[2] > 1.85
    modes = story_modes(alpha0, 1)
    assert modes.period_ratios == pytest.approx([1.0])
    assert modes.factors == pytest.approx(np.array([[1.0]]))


def test_floors_bend_as_a_cantilever_under_a_load_at_its_top():
    loads = np.zeros(6)
    loads[-1] = 1.0
    x = np.arange(1, 7) / 6
    bent = np.linalg.solve(floor_stiffness(0.0, 6), loads)
    np.testing.assert_allclose(bent, x**2 * (3.0 - x) / 6.0, rtol=1e-9)
    sheared = np.linalg.solve(floor_stiffness(math.inf, 6), loads)
    np.testing.assert_allclose(sheared, x, rtol=1e-12)


@pytest.mark.parametrize(
    ("system", "height_ft", "period_s"),
    [
        ("steel moment frame", 65.0, 0.790),
        ("steel moment frame", 573.0, 4.505),
        ("concrete moment frame", 100.0, 1.010),
        ("concrete moment frame", 30.0, 0.342),
        ("steel eccentric or buckling-restrained braces", 16.0, 0.240),
        ("steel eccentric or buckling-restrained braces", 81.0, 0.810),
        ("other", 16.0, 0.160),
        ("other", 30.0, 0.256),
    ],
)
def test_the_approximate_period_is_that_of_the_table(system, height_ft, period_s):
    assert approximate_period_s(system, height_ft * FOOT_M) == pytest.approx(period_s, abs=5e-4)


def test_an_unknown_structure_and_a_height_of_nothing_are_both_named():
    unknown, _ = input_problems(approximate_period_s, "timber", 0.0)
    assert "'timber'" in unknown
