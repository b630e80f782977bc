"""Capacities against dense scans by single runs, and slip against the forces at each sample."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from solver import solve
from solver.model import coulomb
from solver.studies.capacity import ACCURACY, COARSE_SCAN, SCAN, Curve, capacities, maximum_searches
from solver.studies.runs import Campaign, Runner, grid
from studied import frozen, motion

G = 9.80665
LEVELS = np.linspace(0.2, 2.4, 12)


def curve_of(one, slope_deg, mu):
    """The curve of a motion, prepared as a study prepares it."""
    slope = math.radians(slope_deg)
    runner = Runner(Campaign(motions=((one,),), cases=grid(1, [slope], [mu], [1.0])))
    return Curve(tracks=runner.tracks[0], slope_rad=slope, mu=mu)


def scenes(one, slope_deg, mu):
    place = {"slope_rad": math.radians(slope_deg), "friction": coulomb(mu)}
    return [one.scene(orientation, **place) for orientation in one.orientations]


def single(one, slope_deg, mu, x):
    """PRD of single runs, the largest of the orientations; NaN for none."""
    scaled = dataclasses.replace(one, scale=one.scale * x)
    found = [solve(scene).result for scene in scenes(scaled, slope_deg, mu)]
    return max(r.prd_m for r in found) if all(r.status == "ok" for r in found) else math.nan


def searched(curve, limit, levels=LEVELS, *, is_censoring=False):
    """The capacity of one curve for one limit."""
    (found,) = capacities([curve], [limit], levels, is_censoring=is_censoring)
    return found


def is_just_below(found, exact):
    return found.intensity[0] <= exact <= found.intensity[0] * (1.0 + 1.1 * ACCURACY)


@pytest.mark.parametrize(
    ("letters", "slope", "mu", "limit"),
    [("x", 2.0, 0.3, 0.02), ("x", 0.0, 0.5, 0.01), ("xz", 2.0, 0.4, 0.05), ("xz", 6.0, 0.3, 0.1)],
)
@pytest.mark.parametrize("number", range(2))
def test_one_axis_capacity_is_the_first_of_a_dense_scan(letters, slope, mu, limit, number):
    curve = curve_of(motion(number, letters), slope, mu)
    found = searched(curve, limit)
    x = np.linspace(1e-4, LEVELS[-1], 24_000)
    beyond = x[~(curve.prd_m(x) <= limit)]
    if not beyond.size:
        assert (found.is_censored[0], found.intensity[0]) == (True, LEVELS[-1])
        return
    assert not found.is_censored[0]
    at = found.intensity[0]
    assert beyond[0] - (x[1] - x[0]) - ACCURACY * at <= at < beyond[0]
    assert single(motion(number, letters), slope, mu, at) <= limit
    assert not single(motion(number, letters), slope, mu, at * (1.0 + 1.1 * ACCURACY)) <= limit


@pytest.mark.quick
def test_two_axes_capacity_is_bracketed_by_single_runs_and_none_before_it_exceeds():
    one = motion(1, "xyz")
    at = searched(curve_of(one, 2.0, 0.4), 0.05).intensity[0]
    assert LEVELS[0] < at < LEVELS[-1]
    assert single(one, 2.0, 0.4, at) <= 0.05 < single(one, 2.0, 0.4, at * (1.0 + 1.1 * ACCURACY))
    assert all(single(one, 2.0, 0.4, x) <= 0.05 for x in np.linspace(0.05, at, 15))


class Formula:
    """A curve in closed form whose slip begins at a tenth of an intensity."""

    def __init__(self, prd_m):
        self.prd_m = prd_m

    def first_slip(self):
        return 0.1


def test_a_capacity_in_closed_form():
    curve = Formula(lambda x: 0.1 * (x - 0.1) ** 2)
    found = capacities([curve], [0.01, 0.1], LEVELS, is_censoring=False)
    for one, exact in zip(found, (0.1 + math.sqrt(0.1), 1.1), strict=True):
        assert is_just_below(one, exact)
        assert not one.falls[0]


@pytest.mark.parametrize("center", np.linspace(0.9, 0.95, 7))
def test_a_curve_that_falls_again_counts_the_first_crossing_and_says_so(center):
    """A peak between two levels that are both below the limit, and a rise beyond both."""

    def prd(x):
        return 0.05 * x + 0.02 * np.exp(-(((x - center) / 0.03) ** 2))

    limit = 0.05 * center + 0.0195
    exact = brentq(lambda x: prd(x) - limit, center - 0.06, center)
    coarse = np.array([0.8, 1.05, 2.4])
    assert (prd(coarse) <= limit).tolist() == [True, True, False]
    found = searched(Formula(prd), limit, coarse)
    assert found.falls[0]
    assert is_just_below(found, exact)


@pytest.mark.parametrize("letters", ["x", "xz", "xyz"])
@pytest.mark.parametrize(("slope", "mu"), [(0.0, 0.3), (3.0, 0.5)])
def test_slip_begins_where_the_forces_at_a_sample_reach_the_cone(letters, slope, mu):
    """Per sample a quadratic in the intensity, |shear|^2 = (mu N)^2, solved in closed form."""
    one = motion(2, letters)
    sn, cs = math.sin(math.radians(slope)), math.cos(math.radians(slope))
    least = math.inf
    for scene in scenes(one, slope, mu):
        ax, zero = scene.ax_mps2, np.zeros_like(scene.ax_mps2)
        ay, az = (a if a.size else zero for a in (scene.ay_mps2, scene.az_mps2))
        # Shear t0 + x t1 and normal force n0 + x n1 per mass; both orientations have both signs.
        t0, n0 = G * sn, G * cs
        for sign in (1.0, -1.0):
            t1, n1 = az * sn - sign * ax * cs, az * cs + sign * ax * sn
            a = t1**2 + ay**2 - (mu * n1) ** 2
            b = 2.0 * (t0 * t1 - mu**2 * n0 * n1)
            c = t0**2 - (mu * n0) ** 2
            roots = np.concatenate(
                [np.roots(row) for row in np.stack([a, b, c + zero], axis=-1) if np.any(row[:2])]
            )
            real = roots.real[(np.abs(roots.imag) < 1e-12) & (roots.real > 0.0)]
            least = min(least, float(real.min()))
    found = searched(curve_of(one, slope, mu), 0.0)
    assert found.intensity[0] == pytest.approx(least, rel=1e-9)
    assert not found.is_censored[0]


@pytest.mark.quick
def test_a_run_without_a_value_is_an_exceedance_or_censors_its_motion():
    one = motion(1, "xz")
    curve, levels = curve_of(one, 2.0, 0.6), np.linspace(0.5, 12.0, 24)
    exceeding, censored = (
        searched(curve, 1e6, levels, is_censoring=is_censoring) for is_censoring in (False, True)
    )
    assert (exceeding.is_censored[0], censored.is_censored[0]) == (False, True)
    assert exceeding.intensity == censored.intensity
    at = float(censored.intensity[0])
    assert math.isfinite(single(one, 2.0, 0.6, at))
    assert math.isnan(single(one, 2.0, 0.6, at * (1.0 + 1.1 * ACCURACY)))


def test_a_record_of_zeros_and_a_slope_beyond_friction_have_the_ends_of_the_range():
    still = dataclasses.replace(motion(1), ax_mps2=frozen(np.zeros(400)))
    for limit in (0.0, 0.1):
        found = searched(curve_of(still, 2.0, 0.4), limit)
        assert (found.intensity[0], found.is_censored[0]) == (LEVELS[-1], True)
        sliding = searched(curve_of(motion(1), 30.0, 0.4), limit)
        assert sliding.intensity[0] == pytest.approx(0.0, abs=ACCURACY)


@pytest.mark.parametrize("steps", [COARSE_SCAN, SCAN])
@pytest.mark.parametrize("letters", ["x", "xz"])
def test_the_intensities_of_a_search_are_counted_and_are_no_more_than_is_said(steps, letters):
    for number in range(4):
        ran = []

        class Counted(Curve):
            def prd_m(self, intensity, ran=ran):
                ran.append(intensity.size)
                return super().prd_m(intensity)

        one = curve_of(motion(number, letters), 2.0, 0.4)
        curve = Counted(tracks=one.tracks, slope_rad=one.slope_rad, mu=one.mu)
        limits = [0.0, 0.02, 0.2]
        for capacity in capacities([curve], limits, LEVELS, is_censoring=False, steps=steps):
            assert capacity.searched.tolist() == [sum(ran)]
        assert 0 < sum(ran) <= maximum_searches(limits, LEVELS, steps)


@pytest.mark.parametrize("most", [0, 1, 3, 5])
@pytest.mark.quick
def test_a_search_that_may_run_no_more_takes_the_capacity_from_below(monkeypatch, most):
    monkeypatch.setattr("solver.studies.capacity.MOST_CLOSER", most)
    curve, levels = Formula(lambda x: 0.08 * x * x), np.array([3.0])
    (found,) = capacities([curve], [0.5], levels, is_censoring=False, steps=12)
    assert found.searched[0] == 12 + most
    assert 2.0 < found.intensity[0] < 2.5 * (1.0 - ACCURACY)
    assert not found.falls[0]
