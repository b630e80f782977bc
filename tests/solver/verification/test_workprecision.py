"""Work against precision in one axis and in two: every method and setting, failures as holes."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from solver.model import Status
from solver.rivals import by_scipy
from solver.rivals.methods import METHODS
from solver.verification import study, workprecision
from solver.verification.study import (
    CASES,
    compared_runs,
    near_fault_pulse,
    own_triples,
    shortened,
)

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def record():
    return shortened(near_fault_pulse(), 5.0)


@pytest.fixture(scope="module")
def points(record):
    return workprecision.work_points([(record, case) for case in CASES[:3]], quick=True)


def test_every_method_runs_in_every_case_over_its_settings(points):
    assert (points["time per run [s]"] > 0.0).all()
    assert set(points["status"]) <= {Status.OK, Status.SLIDING_AT_END}
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


# Two axes


@pytest.fixture(scope="module")
def plane():
    return workprecision.work(own_triples(True)[0], quick=True)


def of(frame, method):
    return frame[frame["method"] == method]


def test_every_tolerance_of_the_series_is_kept(plane):
    ours = of(plane, workprecision.OURS)
    assert (ours["residual error [%]"] <= 100.0 * np.array(workprecision.TOLERANCES)).all()
    assert (ours["time per run [s]"] > 0.0).all()


@pytest.mark.parametrize("method", [workprecision.HOLDING, workprecision.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(plane, method):
    mine, ours = (
        of(plane, name)["residual error [%]"].tolist() for name in (method, workprecision.OURS)
    )
    assert mine[-1] < 0.1 * mine[0]
    assert mine[-1] > 1e3 * ours[4]


def test_scipy_takes_part_where_it_is_installed_and_gains_with_its_settings(plane):
    counts = plane[plane["method"].str.startswith("SciPy")].groupby("method").size()
    assert counts.tolist() == ([3, 4, 3] if by_scipy.is_installed() else [])
    for method in counts.index:
        off = of(plane, method)["residual error [%]"].tolist()
        assert off[-1] < 0.05 * off[0]


def test_without_scipy_the_rest_is_there(monkeypatch):
    monkeypatch.setattr(by_scipy, "is_installed", lambda: False)
    points = workprecision.work(own_triples(True)[0], quick=True)
    names = workprecision.OURS, workprecision.HOLDING, workprecision.CHATTERING
    assert tuple(points["method"].unique()) == names
