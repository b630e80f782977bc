"""SciPy with events against the exact motion, in one axis and in two; regularized, what it does."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest

from blocks import block, readonly
from solver.model import InputError, coulomb
from solver.rivals import by_scipy
from solver.sliding import one_axis, two_axes
from solver.sliding.checked import slide, slide_history
from solver.verification.model_checks import stopped_scene
from solver.verification.study import Case, cut, own_triples, samples_of, scene_of

pytestmark = pytest.mark.quick

SOLVERS = "DOP853", "RK45"


def assert_followed(scene):
    """As the exact motion in one axis."""
    exact = one_axis.run_history(scene)
    rows = samples_of(replace(scene, ay_mps2=readonly(0.0 * scene.ax_mps2)))
    x, y, *_ = by_scipy.plane(rows, scene.dt_s)
    x *= math.cos(scene.slope_rad)
    np.testing.assert_allclose(x, exact.u_m, rtol=0.0, atol=1e-11 * exact.result.prd_m)
    np.testing.assert_allclose(y, 0.0, atol=1e-20)
    return exact.result


@pytest.mark.parametrize("slope_deg", [0.0, 4.0])
def test_two_axes_follow_the_exact_motion_where_there_is_one_axis(slope_deg):
    part = cut(own_triples(True)[0], 41)
    scene = scene_of(part, Case(slope_deg, 0.5, 1.0), coulomb(0.5), second=False)
    assert assert_followed(scene).n_stops > 0


def test_two_axes_follow_a_slip_whose_drive_ends_within_its_first_interval():
    dt = own_triples(True)[0].dt_s
    assert assert_followed(block([5.0, 0.0, 0.0, 0.0, 0.0], az=np.zeros(5), dt=dt)).prd_m > 0.0


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(("degrees", "mu"), [(0.0, 0.3), (-4.0, 0.2), (7.0, 0.05), (30.0, 1.0)])
def test_one_axis_with_events_is_the_exact_motion_with_its_stops(noise, solver, degrees, mu):
    scene = {"slope_rad": math.radians(degrees), "mu": mu}
    exact = slide_history(noise[:400], 0.01, **scene)
    other = slide_history(noise[:400], 0.01, **scene, method=f"events-{solver.lower()}")
    close = 1e-11 * max(exact.result.prd_m, 1e-3)
    np.testing.assert_allclose(other.u_m, exact.u_m, rtol=0.0, atol=close)
    assert other.result.n_stops == exact.result.n_stops
    assert other.result.t_prd_s == pytest.approx(exact.result.t_prd_s, abs=1e-6)


def test_a_tighter_tolerance_in_two_axes_comes_closer():
    scene = stopped_scene()
    exact = two_axes.run(scene, 1e-10)
    rows, off = samples_of(scene), []
    for solver in SOLVERS:
        for tolerance in (1e-3, 1e-7):
            x, y, *_ = by_scipy.plane(rows, scene.dt_s, solver, tolerance)[:, -1]
            off.append(math.hypot(x - exact.residual_m, y - exact.residual_across_m))
    assert off[1] < 0.5 * off[0]
    assert off[3] < 0.5 * off[2]
    assert max(off) < 1e-4 * exact.prd_m


def test_regularized_friction_creeps_as_its_closed_form_says():
    scene, v0 = stopped_scene(), 1e-3
    _, _, vx, vy = by_scipy.regularized(samples_of(scene), scene.dt_s, v0, 1e-6)[:, -1]
    share = 2.0 / (0.4 * scene.g_mps2)
    assert math.hypot(vx, vy) == pytest.approx(v0 * math.atanh(share), rel=1e-4)


@pytest.mark.parametrize("name", ["regularized", "events-rk45"])
def test_without_scipy_its_methods_say_what_to_install(monkeypatch, noise, name):
    monkeypatch.setitem(sys.modules, "scipy.integrate", None)
    with pytest.raises(InputError, match=r"install roofslip\[verify\]"):
        slide(noise, 0.01, slope_rad=0.0, mu=0.3, method=name)
