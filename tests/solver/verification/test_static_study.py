"""Static above kinetic friction: it fades with the difference, and jumps where it must."""

import pytest

from solver.model import STANDARD_GRAVITY_MPS2, coulomb
from solver.sliding import one_axis, two_axes
from solver.verification import model_study
from solver.verification.study import MODEL_CASES, TIGHT, own_triples, scene_of

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def evidence():
    return model_study.static(own_triples(True), quick=True)


def test_each_scene_that_slides_is_in_every_row(evidence):
    assert evidence.n_scenes > 1
    assert evidence.ratio == 1.25
    for changes in (*evidence.differences.values(), *evidence.fading.values()):
        assert changes.shape == (evidence.n_scenes, 2)
        assert changes.notna().all(axis=None)


def test_the_change_falls_with_the_square_of_the_difference(evidence):
    (wider, former), (narrower, later) = list(evidence.differences.items())[-2:]
    step = wider / narrower
    # Each run is within its tolerance, and so is what it is compared with.
    rounding = step**2 * 2.0 * TIGHT
    for axes in ("one_axis", "two_axes"):
        expected = pytest.approx(former[axes].median(), rel=0.02, abs=rounding)
        assert step**2 * later[axes].median() == expected
        assert later[axes].max() < 0.1 * former[axes].max()


def test_two_axes_tend_to_one_with_one_coefficient_and_need_not_with_two(evidence):
    _, wide, faint = (changes.max() for changes in evidence.fading.values())
    assert faint["one_coefficient"] < 1e-3 * wide["one_coefficient"]
    # With the square of the share it would be 1e-4 of it.
    assert faint["static_above"] > 1e-2 * wide["static_above"]


def test_a_push_between_kinetic_and_static_holds_in_one_axis_alone(evidence):
    alone_m, faint_m, *pushed_m = evidence.pushed["end_m"]
    # v falls from its speed at 0.06 s with the push and friction: v^2 / 2a, before that a ramp.
    scene = model_study.pushed_scene(0.0, model_study.JUMPING)
    history = two_axes.run_history(scene)
    braking = (model_study.PUSHED_BACK_G + 0.4) * STANDARD_GRAVITY_MPS2
    stops = history.u_m[6] + history.v_mps[6] ** 2 / (2.0 * braking)
    assert alone_m == pytest.approx(stops, rel=1e-9)
    assert faint_m == pytest.approx(alone_m, rel=1e-9)
    assert min(pushed_m) > 50.0 * alone_m
    # What two tolerances do not agree on is told.
    assert evidence.pushed["error_m"].iloc[2] > pushed_m[0]
    falling = evidence.pushed["falling_end_m"].tolist()
    assert falling == pytest.approx([falling[0]] * len(falling), rel=1e-3)


def test_the_block_that_is_pushed_back_slides_off_without_more_friction_at_rest():
    scene = model_study.pushed_scene(0.0, coulomb(0.4))
    assert one_axis.run(scene).prd_m > 0.5
    held = model_study.held(0.4, 1.25)
    assert (held.mu_slow, held.mu_fast, held.mu_static) == (0.4, 0.4, 0.5)
    assert not held.is_constant


def test_where_nothing_slides_there_is_nothing_to_compare():
    (triple,) = own_triples(True)
    still = scene_of(triple, MODEL_CASES[0], coulomb(9.0))
    none = model_study.static_evidence([still], 1.25)
    assert none.n_scenes == 0
    assert all(changes.empty for changes in none.differences.values())
