"""Work against precision: every method, every setting, failures as holes."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from solver.model import Status
from solver.rivals.methods import METHODS
from solver.verification import study, workprecision
from solver.verification.study import CASES, compared_runs, near_fault_pulse, shortened

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def record():
    return shortened(near_fault_pulse(), 5.0)


@pytest.fixture(scope="module")
def points(record):
    return workprecision.work_points([(record, case) for case in CASES[:3]], quick=True)


def test_every_method_runs_in_every_case_over_its_settings(points):
    assert set(points["method"]) == set(METHODS)
    for name, method in METHODS.items():
        mine = points[points["method"] == name]
        assert mine["case"].nunique() == 3
        wanted = list(method.sweep[::2]) if method.knob else [math.nan]
        np.testing.assert_array_equal(mine["setting"], wanted * 3)


def test_the_exact_method_has_no_error_and_finer_settings_have_less(points):
    exact = points[points["method"] == "exact"]
    assert (exact[["PRD error [m]", "residual error [m]"]] == 0.0).all(axis=None)
    for name in ("paper", "linear", "penalty-explicit", "penalty-implicit"):
        by_setting = points[points["method"] == name].groupby("setting")
        median, sweep = by_setting["PRD error [%]"].median(), METHODS[name].sweep[::2]
        assert median[sweep[-1]] < 0.1 * median[sweep[0]]


def test_scipy_with_events_is_as_accurate_as_the_exact_method(points):
    events = points[points["method"].str.startswith("events-")]
    assert (events["PRD error [%]"] < 1e-9).all()


def test_the_runs_are_real_records_a_case_each_where_they_are_installed(record, monkeypatch):
    real = [record] * 18
    monkeypatch.setattr(study, "real_records", lambda: real)
    given, cases = zip(*compared_runs(False), strict=True)
    assert list(given) == real
    assert cases == 3 * CASES
    assert len(compared_runs(True)) == 2 * 3


def test_every_point_that_came_through_has_a_time(points):
    assert (points["time per run [s]"] > 0.0).all()
    assert set(points["status"]) <= {Status.OK, Status.SLIDING_AT_END}


def test_a_failed_run_is_a_hole_with_its_status(record, monkeypatch):
    stiff = replace(METHODS["penalty-explicit"], sweep=(1e8,), link_steps_per_radian=0.0)
    monkeypatch.setattr(workprecision, "runnable_methods", lambda: [stiff])
    failed = workprecision.work_points([(record, CASES[0])], quick=True)
    assert failed["status"].tolist() == [Status.DIVERGED]
    measured = failed[["time per run [s]", "PRD error [m]", "residual error [%]"]]
    assert measured.isna().all(axis=None)


def test_what_is_timed_is_what_is_run(record):
    for case, name in itertools.product(CASES, ("exact", "paper", "penalty-implicit")):
        method, scene = METHODS[name], study.prepared(record, case)
        outcome = method.follow(scene, method.parameters, np.empty((2, 0)))
        assert scene.cs * outcome.s_end == study.run(record, case, name).residual_m
