"""Fixed steps in two axes: they tend to the solver's motion, and are told apart at a stop."""

import math

import numpy as np
import pytest

from solver.kernels import rivals
from solver.sliding import two_axes
from solver.verification.model_checks import stopped_scene
from solver.verification.study import samples_of

pytestmark = pytest.mark.quick


def run(scene, substeps, holds):
    rows = samples_of(scene)
    return rivals.slide_fixed(rows, scene.dt_s, math.cos(scene.slope_rad), substeps, holds)


@pytest.mark.parametrize("holds", [True, False])
def test_the_error_falls_with_the_step(holds):
    scene = stopped_scene()
    exact = two_axes.run(scene)
    coarse, fine = (abs(run(scene, count, holds)[0] - exact.prd_m) for count in (4, 1000))
    assert fine < 0.2 * coarse
    assert fine < 0.01 * exact.prd_m


def test_a_held_block_rests_and_one_without_a_rule_for_rest_chatters_and_drifts():
    scene = stopped_scene()
    exact = two_axes.run(scene)
    place = exact.residual_m, exact.residual_across_m
    _, *held, speed = run(scene, 10, True)
    assert speed == 0.0
    assert math.dist(held, place) < 0.01 * exact.prd_m
    _, *drifted, speed = run(scene, 10, False)
    assert speed > 1e-4
    assert math.dist(drifted, place) > 0.1 * exact.prd_m


def test_a_block_at_rest_starts_with_what_friction_leaves_or_free_without():
    rows = np.array([[3.0, 4.0, 2.0]] * 3)
    prd, x, y, speed = rivals.slide_fixed(rows, 0.1, 1.0, 1, True)
    assert speed == pytest.approx(3.0 * 0.2)
    assert (x, y) == pytest.approx((0.6 * 0.06, 0.8 * 0.06))
    assert prd == pytest.approx(0.06)
    rows = np.array([[3.0, 4.0, 2.0]] * 2)
    _, _, _, speed = rivals.slide_fixed(rows, 0.1, 1.0, 1, False)
    assert speed == pytest.approx(0.5)
