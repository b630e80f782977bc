"""SciPy in two axes: the careful reference against one axis; what general solvers do at a stop."""

import math
from dataclasses import replace

import numba
import numpy as np
import pytest

from solver.model import coulomb
from solver.sliding import one_axis
from solver.verification import plane_scipy
from solver.verification.rungs import stopped_scene
from solver.verification.scenes import Case
from solver.verification.triples import own_triples, readonly

pytest.importorskip("scipy")
pytestmark = [
    pytest.mark.skipif(numba.config.DISABLE_JIT, reason="made motions take minutes"),
    pytest.mark.nightly("solver/kernels/two_axes.py", "solver/verification/"),
]


@pytest.mark.parametrize("slope_deg", [0.0, 4.0])
@pytest.mark.nightly("solver/kernels/two_axes.py", "solver/verification/")
def test_the_reference_is_the_exact_motion_where_there_is_one_axis(slope_deg):
    part = own_triples(True)[0].cut(41)
    scene = part.scene(Case(slope_deg, 0.5, 1.0), coulomb(0.5), second=False)
    exact = one_axis.run_history(scene)
    x, y = plane_scipy.reference(replace(scene, ay_mps2=readonly(0.0 * scene.ax_mps2)))
    assert exact.result.n_stops > 0
    np.testing.assert_allclose(x, exact.u_m, rtol=0.0, atol=1e-11 * exact.result.prd_m)
    np.testing.assert_allclose(y, 0.0, atol=1e-20)


def test_the_reference_follows_a_slip_whose_drive_ends_within_its_first_interval():
    part = own_triples(True)[0].cut(5)
    scene = part.scene(Case(0.0, 0.4, 1.0), coulomb(0.4), second=False)
    drive = readonly(np.array([5.0, 0.0, 0.0, 0.0, 0.0]))
    scene = replace(scene, ax_mps2=drive, az_mps2=readonly(0.0 * drive), scale=1.0)
    exact = one_axis.run_history(scene)
    x, _ = plane_scipy.reference(replace(scene, ay_mps2=readonly(0.0 * drive)))
    assert exact.result.prd_m > 0.0
    np.testing.assert_allclose(x, exact.u_m, rtol=0.0, atol=1e-11 * exact.result.prd_m)


def test_regularized_friction_creeps_as_its_closed_form_says():
    scene, v0 = stopped_scene(), 1e-3
    outcome = plane_scipy.regularized(scene, "Radau", v0, 1e-6)
    share = 2.0 / (0.4 * scene.g_mps2)
    assert outcome.followed
    assert outcome.end_speed_mps == pytest.approx(v0 * math.atanh(share), rel=1e-4)


def test_a_general_solver_does_not_get_past_the_jump_of_friction(monkeypatch):
    monkeypatch.setattr(plane_scipy, "EVALUATIONS", 5000)
    outcome = plane_scipy.regularized(stopped_scene(), "DOP853", 0.0, 1e-6)
    assert not outcome.followed
    assert outcome.evaluations > 5000
    assert math.isnan(outcome.prd_m)
    assert math.isnan(outcome.end_m[0])
