"""Rival kernels against the equations they follow; fixed steps tend to the solver's motion."""

import math
import os

import numpy as np
import pytest

from fixtures.blocks import SCENES, readonly
from solver.kernels import rivals
from solver.sliding import two_axes
from solver.verification.model_checks import stopped_scene
from solver.verification.study_cases import samples_of

pytestmark = pytest.mark.quick

G = 10.0


# Sub-steps and (omega h)^2 of a link, sound and not.
SUBSTEPS = 5
STEPS = (0.3, 1.0, 4.4, 90.0)


def run_all(compiled):
    """Return the outcome of every scene by every kernel, compiled or as plain Python."""
    constant, linear, link = (
        f if compiled else getattr(f, "py_func", f)
        for f in (rivals.slide_constant, rivals.slide_linear, rivals.slide_link)
    )
    dt, numbers = 0.25, []
    for horizontal, vertical, sn, mu in SCENES:
        records, cs = (readonly(horizontal), readonly(vertical)), math.sqrt(1.0 - sn * sn)
        scene = *records, dt, sn, cs, mu, G, 1.0, SUBSTEPS
        runs = [(constant, (False,)), (constant, (True,)), (linear, ())]
        for squared in STEPS:
            k = squared / (dt / SUBSTEPS) ** 2
            runs += [(link, (k, False)), (link, (k, True))]
        for follow, more in runs:
            history = np.full((2, len(horizontal)), np.nan)
            outcome = follow(*scene, *more, history)
            np.testing.assert_array_equal(outcome, follow(*scene, *more, np.empty((2, 0))))
            numbers += [*outcome, *history.ravel()]
    return np.array(numbers, dtype=float)


@pytest.mark.nightly
def test_compiled_and_plain_rivals_give_the_same_bits():
    np.testing.assert_array_equal(run_all(compiled=True), run_all(compiled=False))


def follow_the_equations(ax, dt, theta, mu, g, substeps):
    """The paper's algorithm in its own variables and order; u and its rate at the samples."""
    sn, cs, tn = np.sin(theta), np.cos(theta), np.tan(theta)
    step = dt / substeps
    v_p = u_p = v_x = u_x = dv = dv_before = 0.0  # Eq. 19
    places = [(0.0, 0.0)]
    for i in range(len(ax) - 1):
        for j in range(substeps):
            a_p = ax[i] + (ax[i + 1] - ax[i]) * (j / substeps)
            slow = dv == 0.0 or dv * dv_before < 0.0
            # Eqs. 6, 8, 9
            if slow and abs(a_p * cs - g * sn) < mu * abs(g * cs + a_p * sn):
                v_x, a_x, dv = v_p, a_p, 0.0
            else:
                a_k = sn - mu * np.sign(dv) * cs  # Eq. 13
                b_k = cs + mu * np.sign(dv) * sn  # Eq. 15
                c_k = g + a_p * tn  # Eq. 16
                a_x = c_k / (a_k * tn + b_k) * a_k  # Eqs. 17, 18
            u_p += v_p * step + 0.5 * a_p * step * step
            v_p += a_p * step
            u_x += v_x * step + 0.5 * a_x * step * step
            v_x += a_x * step
            dv_before, dv = dv, v_x - v_p
        places.append((u_x - u_p, dv))
    return np.array(places).T


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="longer than the lines need")
@pytest.mark.parametrize(("degrees", "mu"), [(0, 0.3), (4, 0.5), (-7, 0.2), (30, 0.5), (2, 0.0)])
def test_constant_acceleration_gives_the_numbers_of_the_papers_equations(noise, degrees, mu):
    theta, ax = np.radians(degrees), readonly(noise)
    expected = follow_the_equations(noise, 0.01, theta, mu, G, 4)
    history = np.full((2, ax.size), np.nan)
    outcome = rivals.slide_constant(
        ax, readonly([]), 0.01, np.sin(theta), np.cos(theta), mu, G, 1.0, 4, False, history
    )
    scale = np.abs(expected[0]).max()
    np.testing.assert_allclose(np.cos(theta) * history, expected, rtol=0, atol=1e-11 * scale)
    assert max(outcome[1], -outcome[2]) * np.cos(theta) >= scale * (1 - 1e-11)


def test_rates_are_the_net_acceleration_against_the_velocity():
    assert rivals.line_rate(2.0, np.array([7.0, 3.0]), 1.5, -0.5) == pytest.approx([3.0, 0.5])
    rates = rivals.plane_rate(2.0, np.array([0.0, 0.0, 3.0, 4.0]), 1.0, 2.0, 9.0, 0.5, -0.5, 0.5)
    # G = (2, 1) and mu N = 10, along (0.6, 0.8).
    assert rates == pytest.approx([3.0, 4.0, 2.0 - 6.0, 1.0 - 8.0])


@pytest.mark.parametrize(
    "velocity", [(0.0,), (3e-4,), (-0.2,), (0.0, 0.0), (2e-4, -3e-4), (0.3, 0.4)], ids=str
)
def test_regularized_friction_is_mu_n_tanh_and_its_jacobian_the_slope(velocity):
    d, dt, v0 = len(velocity), 0.01, 1e-3
    rows = np.array([[1.0, 2.0], [2.0, 3.0], [4.0, 4.0]]) if d == 1 else np.array(
        [[1.0, -1.0, 2.0], [2.0, 0.0, 3.0], [4.0, 2.0, 4.0]]
    )  # fmt: skip
    t, y = 0.015, np.array([0.1] * d + list(velocity))
    g, cap, v = (rows[1] + rows[2])[:d] / 2.0, (rows[1, d] + rows[2, d]) / 2.0, np.array(velocity)
    w = np.linalg.norm(v)
    friction = cap * np.tanh(w / v0) * v / w if w else np.zeros(d)
    rates = rivals.regularized_rate(t, y, rows, dt, v0)
    assert rates == pytest.approx([*velocity, *(g - friction)], rel=1e-9)
    h, slopes = 1e-8, rivals.regularized_jacobian(t, y, rows, dt, v0)
    for j, step in enumerate(np.eye(2 * d) * h):
        change = [rivals.regularized_rate(t, y + s * step, rows, dt, v0) for s in (1.0, -1.0)]
        assert slopes[:, j] == pytest.approx(
            (change[0] - change[1]) / (2.0 * h), rel=1e-5, abs=1e-3
        )


def run(scene, substeps):
    return rivals.slide_fixed(samples_of(scene), scene.dt_s, math.cos(scene.slope_rad), substeps)


def test_the_error_falls_with_the_step():
    scene = stopped_scene()
    exact = two_axes.run(scene)
    coarse, fine = (abs(run(scene, count)[0] - exact.prd_m) for count in (4, 1000))
    assert fine < 0.2 * coarse
    assert fine < 0.01 * exact.prd_m


def test_a_block_by_fixed_steps_rests_and_slips_along_the_drive():
    scene = stopped_scene()
    exact = two_axes.run(scene)
    _, *place, speed = run(scene, 10)
    assert speed == 0.0
    end = exact.residual_m, exact.residual_across_m
    assert math.dist(place, end) < 0.01 * exact.prd_m
    rows = np.array([[3.0, 4.0, 2.0]] * 3)
    prd, x, y, speed = rivals.slide_fixed(rows, 0.1, 1.0, 1)
    assert speed == pytest.approx(3.0 * 0.2)
    assert (x, y) == pytest.approx((0.6 * 0.06, 0.8 * 0.06))
    assert prd == pytest.approx(0.06)
