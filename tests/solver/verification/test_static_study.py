"""Static above kinetic friction: it fades with the difference, and jumps where it must."""

import numpy as np
import pytest

from solver.model import STANDARD_GRAVITY_MPS2, coulomb
from solver.sliding import one_axis, two_axes
from solver.verification import model_study, static_study
from solver.verification.study import MODEL_CASES, TIGHT
from solver.verification.triples import own_triples


@pytest.fixture(scope="module")
def evidence():
    return model_study.static(own_triples(True), quick=True)


def test_each_scene_that_slides_is_in_every_row(evidence):
    assert evidence.n_scenes > 1
    assert evidence.ratio == 1.25
    for difference in evidence.differences:
        assert difference.one_axis.size == difference.two_axes.size == evidence.n_scenes
    for fading in evidence.fading:
        assert fading.one_coefficient.size == fading.static_above.size == evidence.n_scenes


def test_the_change_falls_with_the_square_of_the_difference(evidence):
    wider, narrower = evidence.differences[-2:]
    step = wider.excess / narrower.excess
    # Each run is within its tolerance, and so is what it is compared with.
    rounding = step**2 * 2.0 * TIGHT
    for axes in ("one_axis", "two_axes"):
        former, later = getattr(wider, axes), getattr(narrower, axes)
        expected = pytest.approx(np.median(former), rel=0.02, abs=rounding)
        assert step**2 * np.median(later) == expected
        assert later[-1] < 0.1 * former[-1]


def test_two_axes_tend_to_one_with_one_coefficient_and_need_not_with_two(evidence):
    wide, faint = evidence.fading[1], evidence.fading[-1]
    assert faint.one_coefficient[-1] < 1e-3 * wide.one_coefficient[-1]
    # With the square of the share it would be 1e-4 of it.
    assert faint.static_above[-1] > 1e-2 * wide.static_above[-1]


def test_a_push_between_kinetic_and_static_holds_in_one_axis_alone(evidence):
    alone, faint, *pushed = evidence.pushed
    # v falls from its speed at 0.06 s with the push and friction: v^2 / 2a, before that a ramp.
    scene = static_study.pushed_scene(0.0, static_study.JUMPING)
    history = two_axes.run_history(scene)
    braking = (static_study.PUSHED_BACK_G + 0.4) * STANDARD_GRAVITY_MPS2
    stops = history.u_m[6] + history.v_mps[6] ** 2 / (2.0 * braking)
    assert alone.end_m == pytest.approx(stops, rel=1e-9)
    assert faint.end_m == pytest.approx(alone.end_m, rel=1e-9)
    assert all(point.end_m > 50.0 * alone.end_m for point in pushed)
    # What two tolerances do not agree on is told.
    assert pushed[0].error_m > pushed[0].end_m
    falling = [point.falling_end_m for point in evidence.pushed]
    assert falling == pytest.approx([falling[0]] * len(falling), rel=1e-3)


def test_the_block_that_is_pushed_back_slides_off_without_more_friction_at_rest():
    scene = static_study.pushed_scene(0.0, coulomb(0.4))
    assert one_axis.run(scene).prd_m > 0.5
    held = static_study.held(0.4, 1.25)
    assert (held.mu_slow, held.mu_fast, held.mu_static) == (0.4, 0.4, 0.5)
    assert not held.is_constant


def test_where_nothing_slides_there_is_nothing_to_compare():
    (triple,) = own_triples(True)
    still = triple.scene(MODEL_CASES[0], coulomb(9.0))
    none = static_study.static_evidence([still], 1.25)
    assert none.n_scenes == 0
    assert all(np.size(difference.one_axis) == 0 for difference in none.differences)
