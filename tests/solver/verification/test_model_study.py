"""Model against model: ratios of what the solver gives, small and lifted runs counted apart."""

import math
from dataclasses import replace

import numpy as np
import pytest

from solver.model import STANDARD_GRAVITY_MPS2, coulomb
from solver.records.record import read_only
from solver.sliding import one_axis, two_axes
from solver.sliding.checked import slide
from solver.verification import model_study
from solver.verification.evidence import (
    HELD,
    LEAST_M,
    OVER_SLOW,
    OVER_STATIC,
    SECOND,
    SOFT,
    STIFF,
    WORST,
    ModelChange,
)
from solver.verification.study import own_triples, triple_scale

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def study():
    return model_study.study(own_triples(True), quick=True)


def test_every_run_is_counted(study):
    assert study.n_runs == 2 * 2 * 2 * 4
    for change in study.changes[:8]:
        of_motions = study.n_runs // 4, 0
        count, n_uplift = of_motions if change.name == WORST else (study.n_runs, study.n_uplift)
        assert change.ratios.size + change.n_small + n_uplift == count
        assert np.all(np.diff(change.ratios) >= 0.0)


def test_a_ratio_is_that_of_two_slides(study):
    (triple,) = own_triples(True)
    scene = {"slope_rad": 0.0, "mu": 0.3, "scale": triple_scale(triple, 1.5)}
    alone = slide(triple.ax_mps2, triple.dt_s, az_mps2=triple.az_mps2, **scene)
    both = slide(triple, **scene)
    assert min(alone.prd_m, both.prd_m) > LEAST_M
    ratio = both.prd_m / alone.prd_m
    assert np.abs(study.named(SECOND).ratios - ratio).min() == pytest.approx(0.0, abs=1e-9)


def test_one_axis_underestimates_and_friction_that_rises_with_speed_slides_less(study):
    assert study.named(SECOND).median > 1.0
    assert study.named(WORST).median > 1.0
    assert study.named(OVER_SLOW).median < 1.0
    assert study.largest_error <= 1e-6


def test_friction_at_rest_changes_less_than_the_same_friction_throughout(study):
    held, over_static = study.named(HELD), study.named(OVER_STATIC)
    assert held.ratios.size + held.n_small == study.n_runs
    assert abs(held.median - 1.0) < 0.1
    assert over_static.median > 1.5


def test_a_row_is_compared_with_a_rigid_array_of_its_mean_friction(study):
    stiff, soft = study.named(STIFF), study.named(SOFT)
    assert stiff.ratios.size + stiff.n_small == study.n_runs // 8
    assert 1.0 < stiff.median < 1.1
    assert 1.0 < soft.median < 1.1
    assert model_study.row_of(0.4, 1e-3, 9.81).mean_mu == pytest.approx(0.4)


def test_lifted_runs_are_counted_and_not_compared():
    (triple,) = own_triples(True)
    lifting = replace(triple, az_mps2=read_only(20.0 * triple.az_mps2))
    study = model_study.study((lifting,), quick=True)
    assert study.n_uplift == study.n_runs
    assert all(change.ratios.size == 0 and math.isnan(change.median) for change in study.changes)
    assert math.isnan(study.largest_error)


def test_percentiles_and_the_share_above_one():
    change = ModelChange(name="x", ratios=np.array([0.5, 1.5, 2.0]), n_small=0, maximum_m=0.0)
    assert (change.median, change.at(0.0), change.at(100.0)) == (1.5, 0.5, 2.0)
    assert change.share_above_one == pytest.approx(2.0 / 3.0)


def test_a_push_between_kinetic_and_static_holds_in_one_axis_alone():
    pushed = model_study.pushed()
    alone_m, faint_m, *pushed_m = pushed["end_m"]
    # v falls from its speed at 0.06 s with the push and friction: v^2 / 2a, before that a ramp.
    scene = model_study.pushed_scene(0.0, model_study.JUMPING)
    history = two_axes.run_history(scene)
    braking = (model_study.PUSHED_BACK_G + 0.4) * STANDARD_GRAVITY_MPS2
    stops = history.u_m[6] + history.v_mps[6] ** 2 / (2.0 * braking)
    assert [alone_m, faint_m] == pytest.approx([stops] * 2, rel=1e-9)
    assert min(pushed_m) > 50.0 * alone_m
    # What two tolerances do not agree on is told.
    assert pushed["error_m"].iloc[2] > pushed_m[0]
    falling = pushed["falling_end_m"].tolist()
    assert falling == pytest.approx([falling[0]] * len(falling), rel=1e-3)
    assert one_axis.run(model_study.pushed_scene(0.0, coulomb(0.4))).prd_m > 0.5
