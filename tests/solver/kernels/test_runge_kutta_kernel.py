"""Runge-Kutta methods with events: their coefficients, and the motions of the exact kernels."""

import math

import numpy as np
import pytest

from fixtures.blocks import SCENES, readonly
from solver.kernels import one_axis, runge_kutta
from solver.model import coulomb
from solver.sliding import two_axes
from solver.verification.model_checks import stopped_scene
from solver.verification.study_cases import flat_scene, samples_of

pytestmark = pytest.mark.quick

G = 10.0
TABLEAUS = {
    5: (runge_kutta.A5, runge_kutta.B5, runge_kutta.C5),
    8: (runge_kutta.A8, runge_kutta.B8, runge_kutta.C8),
}


@pytest.mark.parametrize("order", TABLEAUS)
def test_the_coefficients_meet_the_conditions_of_their_order(order):
    a, b, c = TABLEAUS[order]
    for power in range(order):
        assert b @ c**power == pytest.approx(1.0 / (power + 1), abs=1e-14)
    # Of two stages: sum of b_i a_ij c_j^k is 1 / ((k + 1) (k + 2)).
    for power in range(order - 1):
        expected = 1.0 / ((power + 1) * (power + 2))
        assert b @ a @ c**power == pytest.approx(expected, abs=1e-13)
    assert np.triu(a).max() == 0.0


def test_the_error_of_a_step_vanishes_where_the_lower_order_is_exact():
    ends = np.append(runge_kutta.C5, 1.0)
    for power in range(4):
        assert runge_kutta.E5 @ ends**power == pytest.approx(0.0, abs=1e-15)
    for power in range(5):
        assert runge_kutta.E8 @ runge_kutta.C8**power == pytest.approx(0.0, abs=1e-13)
    for power in range(3):
        assert runge_kutta.E3 @ runge_kutta.C8**power == pytest.approx(0.0, abs=1e-13)
    assert abs(runge_kutta.E8 @ runge_kutta.C8**5) > 1e-6


# A dip to zero between samples, and an onset that rounding puts at the next sample.
MORE = [
    ([1.2, -4.4, 1.3, -5.2, 0.6, -1.6], [], 0.0, 0.2),
    ([2.0, -2.0000000000000004, 0.0, 0.0], [], 0.0, 0.2),
]


@pytest.mark.parametrize("order", TABLEAUS)
def test_one_axis_is_followed_as_by_the_exact_kernel(order):
    dt, slid = 0.25, 0
    for horizontal, vertical, sn, mu in (*SCENES, *MORE):
        ax, az, cs = readonly(horizontal), readonly(vertical), math.sqrt(1.0 - sn * sn)
        up = (az, one_axis.bounds(az)) if az.size else (None, None)
        x = one_axis.bounds(ax)
        exact = one_axis.slide_exact(ax, up[0], x, up[1], dt, sn, cs, mu, G, 1.0, None)
        given = ax, az, dt, sn, cs, mu, G, 1.0, order
        history = np.full((2, ax.size), np.nan)
        _, *found, n_stops = runge_kutta.slide_line(*given, history)
        largest = max(exact[0], -exact[1])
        # Where friction is just reached, rounding decides whether there is a slip of no length.
        near = 1e-11 * largest + 1e-20
        np.testing.assert_allclose(found[:4], exact[:4], rtol=1e-11, atol=near)
        if largest > 1e-9:
            assert (found[4], n_stops) == (pytest.approx(exact[4], rel=1e-11), exact[5])
        assert history[:, -1].tolist() == found[2:4]
        assert runge_kutta.slide_line(*given, np.empty((2, 0)))[1:] == (*found, n_stops)
        slid += n_stops
    assert slid > 10


def errors(scene, order, rtol):
    """Errors over the PRD, of it at the samples and of the place at the end; of the speed there."""
    rows, cs = samples_of(scene), math.cos(scene.slope_rad)
    prd, x, y, speed = runge_kutta.slide_plane(rows, scene.dt_s, cs, order, rtol)
    exact = two_axes.run_history(scene, 1e-10)
    at_samples = np.hypot(exact.u_m, exact.across_m).max()
    end = exact.u_m[-1], exact.across_m[-1]
    off = abs(prd - at_samples) / at_samples, math.dist((x, y), end) / at_samples
    return *off, abs(speed - exact.result.end_speed_mps)


def wave(seed, n):
    return np.random.default_rng(seed).normal(0.0, 4.0, n).round(3)


PLANE = [
    flat_scene(wave(2, 12), wave(3, 12), 0.05, coulomb(0.2)),
    # Along a line, with a dip to zero between samples.
    flat_scene(*(np.outer([0.6, 0.8], MORE[0][0])), 0.25, coulomb(0.2)),
    # The drive of the slip ends within its first interval.
    flat_scene(np.array([5.0, 0.0, 0.0]), np.zeros(3), 0.05, coulomb(0.2)),
    # An onset that rounding puts at the next sample, and one a billionth before it.
    flat_scene(np.array([0.0, 1.9613300000000002, 0.0]), np.zeros(3), 0.05, coulomb(0.2)),
    flat_scene(np.array([0.0, 1.96133 + 2e-9, 3.0, 0.0]), np.array([0.0, 0.0, 0.1, 0.0]), 0.05,
               coulomb(0.2)),
]  # fmt: skip


@pytest.mark.parametrize("order", TABLEAUS)
@pytest.mark.parametrize("scene", [*PLANE[:3], PLANE[4], stopped_scene()])
def test_two_axes_are_followed_to_the_tolerance(scene, order):
    assert max(errors(scene, order, 1e-9)) < 1e-8
    assert max(errors(scene, order, 1e-3)) < 0.02


@pytest.mark.parametrize("order", TABLEAUS)
def test_an_onset_at_a_sample_is_none_in_the_interval_before(order):
    assert runge_kutta.slide_plane(samples_of(PLANE[3]), 0.05, 1.0, order, 1e-6)[0] < 1e-15
