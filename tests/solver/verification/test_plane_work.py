"""Work against precision in two axes: errors fall with the settings; a stop is a stop."""

import numba
import pytest

from solver.verification import plane_scipy, plane_work
from solver.verification.triples import own_triples

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="timings of compiled kernels")


@pytest.fixture(scope="module")
def points():
    return plane_work.work(own_triples(True)[0], quick=True)[1]


def of(points, method):
    return [one for one in points if one.method == method]


def test_every_tolerance_of_the_series_is_kept(points):
    for tolerance, one in zip(plane_work.TOLERANCES, of(points, plane_work.OURS), strict=True):
        assert one.error_percent <= 100.0 * tolerance
        assert one.seconds > 0.0


@pytest.mark.parametrize("method", [plane_work.HOLDING, plane_work.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(points, method):
    mine = of(points, method)
    assert mine[-1].error_percent < 0.1 * mine[0].error_percent
    assert mine[-1].error_percent > 1e3 * of(points, plane_work.OURS)[4].error_percent


def test_scipy_takes_part_where_it_is_installed(points):
    found = [one for one in points if one.method.startswith("SciPy")]
    assert len(found) == (6 if plane_scipy.is_installed() else 0)


def test_without_scipy_the_rest_is_there(monkeypatch):
    monkeypatch.setattr(plane_scipy, "is_installed", lambda: False)
    _, points = plane_work.work(own_triples(True)[0], quick=True)
    found = (*points, *plane_work.stops())
    assert not any("SciPy" in one.method for one in found)


def test_the_series_alone_rest_where_they_should(monkeypatch):
    monkeypatch.setattr(plane_scipy, "is_installed", lambda: False)
    found = list(plane_work.stops())
    ours = of(found, plane_work.OURS)
    assert all(one.end_speed_mps == 0.0 and one.error_m < 1e-9 for one in ours)
    assert all(one.end_speed_mps > 1e-6 for one in of(found, plane_work.CHATTERING))
    assert all(1e-6 < one.error_m < 1e-2 for one in of(found, plane_work.HOLDING))
