"""Work against precision in two axes: errors fall with the settings; a stop is a stop."""

import sys

import numpy as np
import pytest

from solver.verification import plane_scipy, plane_work
from solver.verification.triples import own_triples

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def points():
    return plane_work.work(own_triples(True)[0], quick=True)


def of(points, method):
    return points[points["method"] == method]


def test_every_tolerance_of_the_series_is_kept(points):
    ours = of(points, plane_work.OURS)
    assert (ours["PRD error [%]"] <= 100.0 * np.array(plane_work.TOLERANCES)).all()
    assert (ours["time per run [s]"] > 0.0).all()


@pytest.mark.parametrize("method", [plane_work.HOLDING, plane_work.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(points, method):
    mine, ours = (of(points, name)["PRD error [%]"].tolist() for name in (method, plane_work.OURS))
    assert mine[-1] < 0.1 * mine[0]
    assert mine[-1] > 1e3 * ours[4]


def test_scipy_takes_part_where_it_is_installed(points):
    count = points["method"].str.startswith("SciPy").sum()
    assert count == (6 if plane_scipy.is_installed() else 0)


def test_without_scipy_the_rest_is_there_and_the_series_rest_where_they_should(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    points = plane_work.work(own_triples(True)[0], quick=True)
    stops = plane_work.stops()
    assert not any("SciPy" in method for method in (*points["method"], *stops["method"]))
    ours, speed, error = of(stops, plane_work.OURS), "final velocity [m/s]", "position error [m]"
    assert (ours[speed] == 0.0).all()
    assert (ours[error] < 1e-9).all()
    assert (of(stops, plane_work.CHATTERING)[speed] > 1e-6).all()
    assert of(stops, plane_work.HOLDING)[error].between(1e-6, 1e-2, inclusive="neither").all()
