"""Work against precision in two axes: errors fall with the settings; a stop is a stop."""

import sys

import pytest

from solver.verification import plane_scipy, plane_work
from solver.verification.triples import own_triples


@pytest.fixture(scope="module")
def points():
    return plane_work.work(own_triples(True)[0], quick=True)[1]


def of(points, method):
    return [point for point in points if point.method == method]


def test_every_tolerance_of_the_series_is_kept(points):
    for tolerance, point in zip(plane_work.TOLERANCES, of(points, plane_work.OURS), strict=True):
        assert point.error_percent <= 100.0 * tolerance
        assert point.seconds > 0.0


@pytest.mark.parametrize("method", [plane_work.HOLDING, plane_work.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(points, method):
    mine = of(points, method)
    assert mine[-1].error_percent < 0.1 * mine[0].error_percent
    assert mine[-1].error_percent > 1e3 * of(points, plane_work.OURS)[4].error_percent


def test_scipy_takes_part_where_it_is_installed(points):
    scipy_points = [point for point in points if point.method.startswith("SciPy")]
    assert len(scipy_points) == (6 if plane_scipy.is_installed() else 0)


def test_without_scipy_the_rest_is_there_and_the_series_rest_where_they_should(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    _, points = plane_work.work(own_triples(True)[0], quick=True)
    stops = plane_work.stops()
    assert not any("SciPy" in point.method for point in (*points, *stops))
    ours = of(stops, plane_work.OURS)
    assert all(point.end_speed_mps == 0.0 and point.end_error_m < 1e-9 for point in ours)
    assert all(point.end_speed_mps > 1e-6 for point in of(stops, plane_work.CHATTERING))
    assert all(1e-6 < point.end_error_m < 1e-2 for point in of(stops, plane_work.HOLDING))
