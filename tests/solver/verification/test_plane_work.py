"""Work against precision in two axes: errors fall with the settings."""

import numpy as np
import pytest

from solver.rivals import by_scipy
from solver.verification import workprecision
from solver.verification.study import own_triples

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def points():
    return workprecision.work(own_triples(True)[0], quick=True)


def of(points, method):
    return points[points["method"] == method]


def test_every_tolerance_of_the_series_is_kept(points):
    ours = of(points, workprecision.OURS)
    assert (ours["residual error [%]"] <= 100.0 * np.array(workprecision.TOLERANCES)).all()
    assert (ours["time per run [s]"] > 0.0).all()


@pytest.mark.parametrize("method", [workprecision.HOLDING, workprecision.CHATTERING])
def test_fixed_steps_gain_with_their_number_and_stay_far_behind(points, method):
    mine, ours = (
        of(points, name)["residual error [%]"].tolist() for name in (method, workprecision.OURS)
    )
    assert mine[-1] < 0.1 * mine[0]
    assert mine[-1] > 1e3 * ours[4]


def test_scipy_takes_part_where_it_is_installed_and_gains_with_its_settings(points):
    counts = points[points["method"].str.startswith("SciPy")].groupby("method").size()
    assert counts.tolist() == ([3, 4, 3] if by_scipy.is_installed() else [])
    for method in counts.index:
        off = of(points, method)["residual error [%]"].tolist()
        assert off[-1] < 0.05 * off[0]


def test_without_scipy_the_rest_is_there(monkeypatch):
    monkeypatch.setattr(by_scipy, "is_installed", lambda: False)
    points = workprecision.work(own_triples(True)[0], quick=True)
    names = workprecision.OURS, workprecision.HOLDING, workprecision.CHATTERING
    assert tuple(points["method"].unique()) == names
