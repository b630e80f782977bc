"""The friction of arrays in words, beyond the velocities tested, and at low velocity alone."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fixtures import assessments, projects
from fixtures.spaces import spaced
from report.assessment.checks.sentence import found_and_limit
from report.assessment.design.friction import at_low_velocity, mu_words, mus_words
from report.assessment.design.tested_friction import VelocityCheck, basis_words
from report.assessment.design.verdict import Verdict
from report.assessment.support.evidence import histories
from solver.friction_tests import FrictionRun, Series, Surface
from solver.model import Friction, coulomb
from solver.rules.provisions import Neighbor

LAW = {"mu": 0.40, "mu_fast": 0.50, "mu_rate_s_per_m": 20.0}


def law(slow, fast, rate, static=None):
    static = slow if static is None else static
    return Friction(mu_slow=slow, mu_fast=fast, rate_s_per_m=rate, mu_static=static)


@pytest.mark.parametrize(
    ("friction", "words"),
    [
        (coulomb(0.475), "0.475"),
        (law(0.5, 0.425, 20.0), "0.50–0.425 (velocity-dependent)"),
        (law(0.4, 0.5, 20.0, 0.45), "0.40–0.50 (velocity-dependent), 0.45 at rest"),
        (law(0.4, 0.4, 0.0, 0.45), "0.40, 0.45 at rest"),
    ],
)
@pytest.mark.quick
def test_friction_is_said_as_it_was_run(friction, words):
    assert mu_words(friction) == words


@pytest.mark.quick
def test_arrays_of_one_friction_and_the_low_velocity_coefficient_are_said():
    alike = [projects.array("A1", 0.5), projects.array("A2", 2.0)]
    data = projects.project(arrays=[*alike, projects.array("A3", 3.0, **LAW)])
    assert mus_words(data.arrays) == "A1, A2: 0.45; A3: 0.40–0.50 (velocity-dependent)"
    assert mus_words(data.arrays[2:]) == "A3: 0.40–0.50 (velocity-dependent)"
    given = projects.project(arrays=[projects.array("A1", 3.0, mu_static=0.48, **LAW)]).arrays[0]
    assert at_low_velocity(given).friction == coulomb(0.40)
    assert at_low_velocity(given).slope_rad == given.slope_rad


FITTED = law(0.40, 0.50, 20.0)
VELOCITIES = (0.0025, 0.0254, 0.0508, 0.1016)
RANGE = "from 0.10 in/s (2.5 mm/s) to 4.00 in/s (101.6 mm/s)"


def wet_runs(mus, velocities=VELOCITIES):
    return [
        {"surface": "wet", "number": k, "mu": mu, "velocity_mps": v}
        for k, (mu, v) in enumerate(zip(mus, velocities, strict=True), start=1)
    ]


def constant(mu):
    return {"mu": mu, "mu_fast": None, "rate": None}


def basis(given, mu=FITTED.mu_slow, mu_fast=FITTED.mu_fast, rate=FITTED.rate_s_per_m):
    law = {"mu": mu, "mu_fast": mu_fast, "mu_rate_s_per_m": rate}
    data = projects.project(arrays=[projects.array("A1", 1.0, **law)], friction_runs=given)
    return basis_words(data, data.arrays[0])


ON_FITTED = wet_runs([FITTED.at(v) for v in VELOCITIES])
NEAR = wet_runs((0.457, 0.495, 0.525, 0.527))  # mean 0.501


@pytest.mark.parametrize(
    ("given", "law", "says"),
    [
        (ON_FITTED, {"mu": 0.396, "mu_fast": 0.504}, "as tested: the fit of the wet runs"),
        (ON_FITTED, {"mu": 0.39}, "entered, at or below the tested values"),
        (
            wet_runs([FITTED.at(v) + 0.05 for v in VELOCITIES]),
            {},
            "entered, at or below the tested values",
        ),
        (NEAR, constant(0.45), "entered, at or below the tested values"),
        (NEAR, constant(0.501), "entered, on average at or below the tested values"),
        (NEAR, constant(0.504), "entered, on average within 0.005 of the tested values"),
    ],
)
def test_the_fit_alone_is_as_tested_and_one_coefficient_is_entered(given, law, says):
    assert spaced(basis(given, **law)) == f"{says} {RANGE}"


@pytest.mark.parametrize(
    ("given", "law", "says"),
    [
        (wet_runs([FITTED.at(v) for v in VELOCITIES[:3]], VELOCITIES[:3]), {},
         "entered, at or below the tested values from 0.10 in/s (2.5 mm/s) to 2.00 in/s"
         " (50.8 mm/s)"),
        (wet_runs((0.5,), (0.0254,)), constant(0.45),
         "entered, at or below the tested values at 1.00 in/s (25.4 mm/s)"),
        (wet_runs((0.5,), (None,)), constant(0.45),
         "entered, at or below the tested values (velocities not entered)"),
        ([], {}, "entered; no friction test runs are entered"),
    ],
    ids=["too few velocities for a fit", "one velocity", "no velocity", "no runs"],
)  # fmt: skip
def test_the_velocities_of_the_tests_are_said_as_far_as_they_are_given(given, law, says):
    assert spaced(basis(given, **law)) == says


RISING = {"mu": 0.30, "mu_fast": 0.45, "mu_rate_s_per_m": 20.0}
MOTIONS = assessments.motions()


def runs(mu=0.45, velocity_mps=0.0254, count=3):
    return [
        {"surface": surface, "number": k, "mu": mu, "velocity_mps": velocity_mps}
        for surface in Surface
        for k in range(1, count + 1)
    ]


def assessed(arrays, tests, shaking=MOTIONS, **changes):
    return assessments.package(shaking, arrays=arrays, friction_runs=tests, **changes).assessment


def one(mu=0.45, slope=2.0, tests=(), shaking=MOTIONS, **law):
    return assessed([projects.array("A1", slope, mu=mu, **law)], tests, shaking, clearances=[])


def rows(done):
    return {row.subject: row for row in done.checks if row.id == "friction_velocity"}


def said(check):
    return found_and_limit(check, us_first=True)


@pytest.fixture(scope="module")
def by_velocity():
    """A1 and A2 alike but for their friction: constant, and a law that begins with the same."""
    arrays = [projects.array("A1", 2.0, mu=0.30), projects.array("A2", 2.0, x=120, **RISING)]
    gaps = [
        projects.clearance("A1", "RTU-1", 0.4),
        projects.clearance("A1", "A2", 1.2),
        projects.clearance("A2", "S edge", 1.7, "downslope"),
    ]
    return assessed(arrays, runs(0.45, 0.254), clearances=gaps, options=assessments.REVIEW)


@pytest.mark.quick
def test_the_largest_velocity_and_friction_beyond_the_tests_are_told(by_velocity):
    item = by_velocity.arrays[0]
    each = [run.result.peak_speed_mps for motion in item.motions for run in motion.runs]
    assert item.fastest_mps == max(each)
    (governing, _) = histories(by_velocity)
    for motion, history in zip(item.motions, governing, strict=True):
        across = history.across_mps if history.across_mps.size else np.zeros(1)
        cosine = math.cos(item.array.slope_rad)
        seen = float(np.hypot(history.v_mps / cosine, across).max())
        peak = motion.governing.result.peak_speed_mps
        assert seen <= peak * (1.0 + 1e-9)
        assert seen == pytest.approx(peak, rel=0.02)
    first, second = rows(by_velocity)["A1"], rows(by_velocity)["A2"]
    assert first.is_satisfied  # 0.30 at every velocity
    assert second.is_satisfied  # 0.45 at most
    slow = {"surface": "wet", "number": 9, "mu": 0.40, "velocity_mps": 0.002}
    done = one(tests=[slow, *runs(0.47, 0.0254)], **RISING)
    row = rows(done)["A1"]
    assert row.verdict is Verdict.CONDITION
    found, limit = said(row)
    if "complete tests" in limit:
        assert "; μ above the tested range 0.450, smallest tested 0.400" in found
    else:
        assert spaced(limit) == "≤ 10.00 in/s (254.0 mm/s)"
        assert "tested to 1.00 in/s (25.4 mm/s); μ above the tested range 0.450" in spaced(found)
    # A coefficient that was not run is not offered: entered, it may be NG.
    assert row.remedy == "Obtain friction tests at the sliding velocities."
    # With the low-velocity coefficient alone the floor governs as well: that costs nothing.
    (slower,) = done.low_velocity.arrays
    assert (slower.design_m, row.otherwise) == (done.arrays[0].design_m, "")
    assert done.array_verdict(done.arrays[0]) is not Verdict.OK


@pytest.mark.quick
def test_nothing_is_beyond_fast_tests_or_where_nothing_slides():
    fastest = one().arrays[0].fastest_mps
    assert fastest > 0.1
    for share, satisfied in ((1.01, True), (0.99, False)):
        tests = [*runs(0.46, share * fastest), *runs(0.40, 0.0254)]
        wet = [test | {"number": k} for k, test in enumerate(tests, 1)]
        row = rows(one(tests=wet))["A1"]
        assert row.is_satisfied is satisfied
        assert ("μ above the tested range" in said(row)[0]) is not satisfied
    weak = [replace(motion, scale=1e-3 * motion.scale) for motion in MOTIONS]
    row = rows(one(slope=0.5, tests=runs(0.2), shaking=weak))["A1"]
    assert row.is_satisfied
    assert spaced([text.split(" (")[0] for text in said(row)]) == ["0.00 in/s", "≤ 1.00 in/s"]


def test_tests_without_velocities_or_none_are_conditions():
    row = rows(one(0.44, tests=runs(0.45, None)))["A1"]
    assert row.verdict is Verdict.CONDITION
    assert row.found.endswith("smallest tested 0.450; tests incomplete")
    assert "; velocities tested not entered; μ above the tested range 0.440" in row.found
    row = rows(one())["A1"]
    assert row.verdict is Verdict.CONDITION
    assert row.found.endswith("; no friction test runs entered")
    weak = [replace(motion, scale=1e-3 * motion.scale) for motion in MOTIONS]
    row = rows(one(slope=0.5, shaking=weak))["A1"]
    assert (row.is_satisfied, row.found) == (True, "does not slide")


def test_friction_beyond_the_tests_needs_complete_ones_that_are_not_far_slower():
    fastest = one(0.40).arrays[0].fastest_mps
    words = {}
    for share in (1.01, 0.99):
        row = rows(one(0.40, tests=runs(0.45, share * fastest / 10.0)))["A1"]
        words[row.is_satisfied] = said(row)
    assert words[True][1] == "≤ 0.450"
    assert words[False][0].endswith("; at most 10 times as fast)")
    for count, surfaces, is_met in ((3, Surface, True), (2, Surface, False), (3, "wet", False)):
        tests = [test for test in runs(0.45, 0.9 * fastest, count) if test["surface"] in surfaces]
        row = rows(one(0.40, tests=tests))["A1"]
        assert row.is_satisfied is is_met
        assert ("; tests incomplete" in said(row)[0]) is not is_met


def test_a_coefficient_below_the_tested_mean_is_no_worse_than_at_it():
    tests = runs(0.45, 0.254)
    for motions in (MOTIONS, assessments.level()):
        at, below = (
            assessed([projects.array("A1", 0.5, mu=mu)], tests, motions, clearances=[])
            for mu in (0.45, 0.41)
        )
        assert [row.id for row in below.open] == [row.id for row in at.open]
        assert below.verdict is at.verdict


def check(friction, fastest, *tested):
    given = (
        FrictionRun(report="", surface=Surface.WET, velocity_mps=v, mu=mu, mu_static=math.nan)
        for v, mu in tested
    )
    tests = Series(report="", surface=Surface.WET, runs=tuple(given))
    return VelocityCheck(friction=friction, fastest_mps=fastest, tests=tests, is_complete=True)


def test_friction_beyond_is_the_largest_of_any_velocity_that_may_be():
    rising = Friction(mu_slow=0.4, mu_fast=0.5, rate_s_per_m=2.0, mu_static=0.4)
    falling = Friction(mu_slow=0.5, mu_fast=0.4, rate_s_per_m=2.0, mu_static=0.5)
    tested = ((0.1, 0.45), (0.2, 0.47))
    assert check(rising, 0.3, *tested).mu_beyond == pytest.approx(0.5 - 0.1 * math.exp(-0.6))
    assert check(falling, 0.3, *tested).mu_beyond == pytest.approx(0.4 + 0.1 * math.exp(-0.4))
    assert check(rising, math.nan, *tested).mu_beyond == 0.5
    assert math.isnan(check(rising, 0.2, *tested).mu_beyond)
    # A run that gives no velocity may have any.
    assert not check(coulomb(0.40), math.nan, (0.1, 0.45)).is_satisfied
    for mu, satisfied in ((0.4649, True), (0.4651, False)):
        assert check(coulomb(mu), 1.0, (0.1, 0.46)).is_satisfied is satisfied
    up = tuple(replace(motion, az_mps2=2.0 * motion.ax_mps2) for motion in MOTIONS)
    row = rows(one(slope=0.5, tests=runs(0.40), shaking=up))["A1"]
    assert "no velocity from one run; tested to" in said(row)[0]
    assert not row.is_satisfied


def test_the_low_velocity_coefficient_alone_is_as_entered_and_has_no_reruns(by_velocity):
    slow = by_velocity.low_velocity
    assert [item.id for item in slow.arrays] == ["A2"]
    entered = [projects.array("A1", 2.0, mu=0.30), projects.array("A2", 2.0, x=120, mu=0.30)]
    arrays = projects.project(arrays=entered).arrays
    again = projects.assess_input(
        by_velocity.project.model_copy(update={"arrays": arrays}), MOTIONS
    )
    assert slow.arrays[0].design_m == again.arrays[1].design_m
    assert slow.arrays[0].design_m > by_velocity.arrays[1].design_m
    assert slow.arrays[0].fastest_mps > by_velocity.arrays[1].fastest_mps
    assert list(slow.clearances) == [2, 3]
    assert slow.clearances[3].required_m == again.clearances[2].required_m
    # The two arrays are as unlike as entered: their coefficients are equal in these runs alone.
    assert again.clearances[1].neighbor is Neighbor.LIKE
    assert slow.clearances[2].neighbor is Neighbor.UNLIKE
    failed = [gap.clearance for gap in slow.clearances.values() if not gap.ok]
    outcome = rows(by_velocity)["A2"].otherwise
    assert all(f"{gap.array} to {gap.object}" in outcome for gap in failed)
    assert ("NG: " in outcome) is bool(failed)
    assert by_velocity.at_reduced_friction.low_velocity.arrays == ()
    constant = one(tests=runs())
    assert (constant.low_velocity.arrays, constant.low_velocity.clearances) == ((), {})
    assert rows(constant)["A1"].otherwise == ""
