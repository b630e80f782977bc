"""Work against precision in two axes: errors fall with the settings; a stop is a stop."""

import sys

import numpy as np
import pytest

from solver.verification import plane_scipy, workprecision
from solver.verification.study import own_triples

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def points():
    return workprecision.work(own_triples(True)[0], quick=True)


def of(points, method):
    return points[points["method"] == method]


def test_every_tolerance_of_the_series_is_kept(points):
    ours = of(points, workprecision.OURS)
    assert (ours["PRD error [%]"] <= 100.0 * np.array(workprecision.TOLERANCES)).all()
    assert (ours["time per run [s]"] > 0.0).all()


@pytest.mark.parametrize("method", [workprecision.HOLDING, workprecision.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(points, method):
    mine, ours = (
        of(points, name)["PRD error [%]"].tolist() for name in (method, workprecision.OURS)
    )
    assert mine[-1] < 0.1 * mine[0]
    assert mine[-1] > 1e3 * ours[4]


def test_scipy_takes_part_where_it_is_installed(points):
    count = points["method"].str.startswith("SciPy").sum()
    assert count == (6 if plane_scipy.is_installed() else 0)


def test_without_scipy_the_rest_is_there_and_the_series_rest_where_they_should(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    points = workprecision.work(own_triples(True)[0], quick=True)
    stops = workprecision.stops()
    assert not any("SciPy" in method for method in (*points["method"], *stops["method"]))
    ours, speed, error = of(stops, workprecision.OURS), "final velocity [m/s]", "position error [m]"
    assert (ours[speed] == 0.0).all()
    assert (ours[error] < 1e-9).all()
    assert (of(stops, workprecision.CHATTERING)[speed] > 1e-6).all()
    assert of(stops, workprecision.HOLDING)[error].between(1e-6, 1e-2, inclusive="neither").all()
