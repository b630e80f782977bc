"""Runs with less friction to a coarse tolerance: they tell what exact ones would, or are not told.

The exact runs are those of `reassess`.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import scenes
import stand_in
from report.assessment.clearances import facing
from report.assessment.friction import SHIFT, with_friction
from report.assessment.project import reassess
from report.assessment.rough import ROUGH, design_off_m
from solver.sliding.least_model import Model

SHORT = scenes.motions()
BY_DIRECTION = scenes.REVIEW | scenes.DEPARTURE
G = 9.80665


def exactly(given):
    return reassess(given, with_friction(given.project, 1.0 - SHIFT))


def gaps(assessment):
    return [gap.required_m for gap in assessment.clearances]


def assess_with(motions, **changes):
    return stand_in.assess_input(stand_in.project(**changes), motions)


def weaker(motion, share):
    ay = share * motion.ay_mps2
    ay.setflags(write=False)
    return replace(motion, ay_mps2=ay)


def test_a_verdict_with_less_friction_is_that_of_exact_runs_at_the_limit_and_beside_it():
    wide = [stand_in.clearance(name, "RTU-1", 30.0) for name in ("A1", "A2")]
    given = assess_with(SHORT, options=scenes.REVIEW, clearances=wide)
    rough, exact = gaps(given.at_reduced_friction), gaps(exactly(given))
    assert all(0.0 < abs(r / e - 1.0) < ROUGH for r, e in zip(rough, exact, strict=True))
    for share in (-1e-2, -1e-3, -1e-9, 0.0, 1e-9, 1e-3, 1e-2):
        close = wide[0] | {"provided_m": exact[0] * (1.0 + share)}
        less = assess_with(
            SHORT, options=scenes.REVIEW, clearances=[close, wide[1]]
        ).at_reduced_friction
        assert less.clearances[0].ok is (share >= 0.0)
        assert gaps(less)[1] == rough[1]
        if abs(share) <= 1e-9:
            assert gaps(less)[0] == exact[0]


def test_where_one_axis_is_exact_its_prd_stands_across_for_rough_runs_as_well():
    """The choice of model is near its criterion in some runs: two axes alone would say OK."""
    motions = [weaker(motion, 0.01) for motion in SHORT]
    arrays = [stand_in.array("A1", 4.0, mu=0.3)]
    make = partial(assess_with, motions, arrays=arrays, options=BY_DIRECTION)
    wide = make(clearances=[stand_in.clearance("A1", "RTU-1", 30.0, "across")])
    exact = exactly(wide)
    models = {run.solution.model for motion in exact.arrays[0].motions for run in motion.runs}
    assert {Model.ONE_AXIS_VERTICAL, Model.TWO_AXES} <= models
    between = (gaps(wide)[0] + gaps(exact)[0]) / 2.0
    done = make(clearances=[stand_in.clearance("A1", "RTU-1", between, "across")])
    assert done.clearances[0].ok
    assert not done.at_reduced_friction.clearances[0].ok
    assert not exactly(done).clearances[0].ok


def scene_of(seed):
    """A project with arrays, motions, friction and clearances of every kind, by chance."""
    rng = np.random.default_rng(seed)
    motions = stand_in.motions(
        int(rng.choice([3, 7])), seconds=6.0, peak_g=rng.uniform(0.4, 2.0), seed=seed
    )
    faint = rng.choice([1.0, 0.3, 0.03, 0.01, 0.003])
    motions = [weaker(motion, faint * rng.uniform(0.5, 1.5)) for motion in motions]
    arrays = []
    for name, x in (("A1", 20), ("A2", 120)):
        mu = rng.uniform(0.2, 0.8)
        law = {"mu_fast": mu * rng.uniform(0.7, 1.5), "mu_rate_s_per_m": 20.0}
        slope = float(rng.choice([0.0, 0.5, 2.0, 4.0, 7.0]))
        law = law if rng.random() >= 0.7 else {}
        arrays.append(stand_in.array(name, slope, mu=mu, x=x, **law))
    to = (("A1", "RTU-1"), ("A1", "A2"), ("A2", "S edge"))
    ways = ("any", "down", "up", "across")
    return assess_with(
        motions,
        arrays=arrays,
        clearances=[stand_in.clearance(*pair, 30.0, way) for pair in to for way in ways],
        options=BY_DIRECTION if rng.random() < 0.6 else scenes.REVIEW,
    )


@pytest.mark.parametrize("seed", range(8))
def test_rough_runs_are_off_by_less_than_the_bound(seed):
    given = scene_of(seed)
    less = given.at_reduced_friction
    for rough, exact in zip(less.clearances, exactly(given).clearances, strict=True):
        sides = facing(less.project, less.arrays, rough.clearance)
        off_m = max(rough.factor * design_off_m(less.rules, *side) for side in sides)
        assert abs(rough.required_m - exact.required_m) <= off_m


def pulse(name, amplitude_g, width_s, vertical):
    t = np.arange(0.0, 6.0, 0.01)
    ax = -amplitude_g * G * np.clip(1.0 - np.abs(t - 1.3) / width_s, 0.0, 1.0)
    az, ay = -vertical * np.abs(ax), 1e-6 * ax
    for part in (ax, az, ay):
        part.setflags(write=False)
    return stand_in.motion(name, ax, az, ay=ay, signs=(1,))


def test_what_a_model_may_neglect_in_each_of_seven_motions_does_not_add_up_past_the_bound():
    """One PRD is large and six are small, all of a vertical component that one axis neglects."""
    motions = [pulse("B", 1.2, 0.25, 2e-3), *(pulse(f"S{k}", 0.6, 0.1, 2e-2) for k in range(6))]
    given = assess_with(
        motions,
        arrays=[stand_in.array("A1", 4.0, mu=0.4)],
        clearances=[stand_in.clearance("A1", "RTU-1", 30.0)],
        options=scenes.REVIEW,
    )
    less, exact = given.at_reduced_friction, exactly(given)
    neglecting = [run.governing.solution.model for run in exact.arrays[0].motions]
    assert set(neglecting) == {Model.ONE_AXIS}
    (side,) = facing(less.project, less.arrays, less.clearances[0].clearance)
    off_m = design_off_m(less.rules, *side)
    rough_m, exact_m = (done.arrays[0].design_m for done in (less, exact))  # the factor is 1.0
    assert abs(rough_m - exact_m) <= off_m < 1e-4
