"""Uplift, against lines drawn by hand and a fine grid."""

import math

import numpy as np
import pytest

from blocks import block
from solver.model import Status
from solver.sliding import one_axis
from solver.sliding.uplift import uplift

pytestmark = pytest.mark.quick

G = 10.0


def scene(az_g, *, ax_g=None, slope=0.0):
    ax = np.zeros(len(az_g)) if ax_g is None else G * np.array(ax_g)
    return block(ax, az=G * np.array(az_g), dt=0.1, slope=slope, friction=0.5, g=G)


@pytest.mark.parametrize(
    ("az_g", "n_min_g", "t_first_s", "duration_s", "times"),
    [
        ([0.0, 0.0, -3.0, 0.0, 0.0], -2.0, 0.4 / 3.0, 0.4 / 3.0, 1),
        ([0.0, -2.0, 0.0, -2.0, -2.0, 0.0], -1.0, 0.05, 0.3, 2),  # two dips, one that lasts
        ([0.0, -1.0, -2.0, 0.0], -1.0, 0.1, 0.15, 1),  # from zero itself
        ([-2.0, 0.0, -1.5], -1.0, 0.0, 0.05 + 0.1 / 3.0, 2),  # begins below zero
    ],
)
def test_dips_below_zero_are_seen_with_their_times_and_depth(
    az_g, n_min_g, t_first_s, duration_s, times
):
    lift = uplift(scene(az_g))
    assert (lift.lifts, lift.n_min_g, lift.times) == (True, n_min_g, times)
    assert lift.t_first_s == pytest.approx(t_first_s, rel=1e-15)
    assert lift.duration_s == pytest.approx(duration_s, rel=1e-14)


@pytest.mark.parametrize("az_g", [[0.0, 0.5, -0.99], [0.0, -1.0, 0.0], [-1.0, -1.0, -1.0]])
def test_a_normal_force_of_zero_or_more_is_no_uplift(az_g):
    lift = uplift(scene(az_g))
    assert (lift.lifts, lift.duration_s, lift.times) == (False, 0.0, 0)
    assert math.isnan(lift.t_first_s)
    assert lift.n_min_g == pytest.approx(1.0 + min(az_g), abs=1e-15)


def test_without_a_vertical_record_a_steep_roof_can_lift():
    """N = g cos(theta) + ax sin(theta)."""
    lift = uplift(scene([0.0] * 3, ax_g=[0.0, -2.0, 0.0], slope=math.radians(45.0)))
    assert lift.n_min_g == pytest.approx(-math.sqrt(0.5), rel=1e-15)
    assert lift.duration_s == pytest.approx(0.1, rel=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_it_agrees_with_what_the_solver_refuses_and_with_a_fine_grid(seed):
    rng = np.random.default_rng(seed)
    shaken = scene(rng.normal(0.0, 0.6, 60), ax_g=rng.normal(0.0, 0.6, 60), slope=0.2)
    lift, refused = uplift(shaken), one_axis.run(shaken)
    assert refused.status is Status.UPLIFT
    assert lift.n_min_g == pytest.approx(refused.n_min_g, rel=1e-13)
    assert lift.t_first_s == pytest.approx(refused.t_uplift_s, rel=1e-13)
    fine, at = np.linspace(0.0, 5.9, 590_001), np.arange(60) * 0.1
    ax, az = (np.interp(fine, at, a) for a in (shaken.ax_mps2, shaken.az_mps2))
    below = (G + az) * math.cos(0.2) + ax * math.sin(0.2) < 0.0
    assert lift.duration_s == pytest.approx(below.mean() * 5.9, abs=1e-3)
    assert lift.times == np.count_nonzero(below[1:] & ~below[:-1]) + below[0]
