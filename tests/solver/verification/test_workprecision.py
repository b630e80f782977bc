"""Work against precision: every method, every setting, failures as holes."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from solver.model import Status
from solver.rivals.methods import METHODS
from solver.verification import study, workprecision
from solver.verification.scenes import CASES, near_fault_pulse, shortened


@pytest.fixture(scope="module")
def record():
    return shortened(near_fault_pulse(), 5.0)


@pytest.fixture(scope="module")
def points(record):
    return tuple(workprecision.work_points([record], quick=True))


def test_every_method_runs_in_every_case_over_its_settings(points):
    assert {point.method for point in points} == set(METHODS)
    for name, method in METHODS.items():
        mine = [point for point in points if point.method == name]
        is_slow = name == "regularized"
        cases, chosen = (2, slice(2)) if is_slow else (3, slice(None, None, 2))
        assert len({point.scene for point in mine}) == cases
        wanted = list(method.sweep[chosen]) if method.knob else [math.nan]
        np.testing.assert_array_equal([p.setting for p in mine], wanted * cases)


def test_the_full_run_takes_every_setting_of_the_sweep(record):
    for name in ("paper", "penalty-implicit"):
        method = METHODS[name]
        settings = list(workprecision.settings(method, record, quick=False))
        assert [value for value, _ in settings] == list(method.sweep)
        assert all(set(parameters) == set(method.parameters) for _, parameters in settings)


def test_the_exact_method_has_no_error_and_finer_settings_have_less(points):
    exact = [point for point in points if point.method == "exact"]
    assert all(point.prd_error_m == point.residual_error_m == 0.0 for point in exact)
    for name in ("paper", "linear", "penalty-explicit", "penalty-implicit"):
        median = [
            np.median([p.prd_error_percent for p in points if (p.method, p.setting) == (name, v)])
            for v in METHODS[name].sweep[::2]
        ]
        assert median[-1] < 0.1 * median[0]


def test_every_point_that_came_through_has_a_time(points):
    assert all(point.seconds > 0.0 for point in points)
    assert {point.status for point in points} <= {Status.OK, Status.SLIDING_AT_END}


def test_a_failed_run_is_a_hole_with_its_status(record, monkeypatch):
    name = "penalty-explicit"
    stiff = replace(METHODS[name], sweep=(1e8,), link_steps_per_radian=0.0)
    monkeypatch.setattr(workprecision, "METHODS", {name: stiff})
    failed = list(workprecision.work_points([record], quick=True))
    assert len(failed) == 3
    for point in failed:
        assert point.status is Status.DIVERGED
        assert np.isnan([point.seconds, point.prd_error_m, point.residual_error_percent]).all()


def test_what_is_timed_is_what_is_run(record):
    for case, name in itertools.product(CASES, ("exact", "paper", "penalty-implicit")):
        method, scene = METHODS[name], study.prepared(record, case)
        outcome = method.follow(scene, method.parameters, np.empty((2, 0)))
        assert scene.cs * outcome.s_end == study.run(record, case, name).residual_m


def test_results_are_the_same_every_time_but_for_the_seconds(record, points):
    def lasting(point):
        return point.prd_error_m, point.residual_error_percent, point.parameters

    again = workprecision.work_points([record], quick=True)
    assert [lasting(point) for point in again] == [lasting(point) for point in points]
