"""SciPy in two axes: the careful reference against one axis; what general solvers do at a stop."""

import math
from dataclasses import replace

import numpy as np
import pytest

from blocks import block, readonly
from solver.model import coulomb
from solver.sliding import one_axis
from solver.verification import plane_scipy
from solver.verification.model_checks import stopped_scene
from solver.verification.scenes import Case
from solver.verification.study import cut, own_triples, scene_of

pytestmark = pytest.mark.quick


def assert_followed(scene):
    """As the exact motion in one axis."""
    exact = one_axis.run_history(scene)
    x, y = plane_scipy.reference(replace(scene, ay_mps2=readonly(0.0 * scene.ax_mps2)))
    np.testing.assert_allclose(x, exact.u_m, rtol=0.0, atol=1e-11 * exact.result.prd_m)
    np.testing.assert_allclose(y, 0.0, atol=1e-20)
    return exact.result


@pytest.mark.parametrize("slope_deg", [0.0, 4.0])
def test_the_reference_is_the_exact_motion_where_there_is_one_axis(slope_deg):
    part = cut(own_triples(True)[0], 41)
    scene = scene_of(part, Case(slope_deg, 0.5, 1.0), coulomb(0.5), second=False)
    assert assert_followed(scene).n_stops > 0


def test_the_reference_follows_a_slip_whose_drive_ends_within_its_first_interval():
    dt = own_triples(True)[0].dt_s
    assert assert_followed(block([5.0, 0.0, 0.0, 0.0, 0.0], az=np.zeros(5), dt=dt)).prd_m > 0.0


def test_regularized_friction_creeps_as_its_closed_form_says():
    scene, v0 = stopped_scene(), 1e-3
    outcome = plane_scipy.regularized(scene, "Radau", v0, 1e-6)
    share = 2.0 / (0.4 * scene.g_mps2)
    assert outcome.end_speed_mps == pytest.approx(v0 * math.atanh(share), rel=1e-4)


def test_a_general_solver_does_not_get_past_the_jump_of_friction(monkeypatch):
    monkeypatch.setattr(plane_scipy, "EVALUATIONS", 5000)
    outcome = plane_scipy.regularized(stopped_scene(), "DOP853", 0.0, 1e-6)
    assert outcome.steps > 5000
    assert np.isnan([outcome.prd_m, outcome.end_m[0]]).all()
