"""Uplift and tipping, against lines drawn by hand, a fine grid and pulses of known demand."""

import math

import numpy as np
import pytest

from fixtures.blocks import block
from solver.errors import InputError
from solver.model import Friction, Status
from solver.sliding import one_axis
from solver.sliding.uplift import Supports, tipping, uplift

pytestmark = pytest.mark.quick

G = 10.0


def scene(ax_g=None, *, ay_g=(), az_g=(), slope=0.0, mu=0.5):
    ax_g = np.zeros(len(az_g)) if ax_g is None else ax_g
    records = (G * np.array(a) for a in (ax_g, ay_g, az_g))
    return block(*records, dt=0.1, slope=slope, friction=mu, g=G)


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
    lift = uplift(scene(az_g=az_g))
    assert (lift.lifts, lift.n_min_g, lift.times) == (True, n_min_g, times)
    assert lift.t_first_s == pytest.approx(t_first_s, rel=1e-15)
    assert lift.duration_s == pytest.approx(duration_s, rel=1e-14)


def test_a_normal_force_of_zero_or_more_is_no_uplift_and_a_steep_roof_can_lift_without_az():
    for az_g in ([0.0, 0.5, -0.99], [0.0, -1.0, 0.0], [-1.0, -1.0, -1.0]):
        lift = uplift(scene(az_g=az_g))
        assert (lift.lifts, lift.duration_s, lift.times) == (False, 0.0, 0)
        assert math.isnan(lift.t_first_s)
        assert lift.n_min_g == pytest.approx(1.0 + min(az_g), abs=1e-15)
    # N = g cos(theta) + ax sin(theta).
    lift = uplift(scene([0.0, -2.0, 0.0], slope=math.radians(45.0)))
    assert lift.n_min_g == pytest.approx(-math.sqrt(0.5), rel=1e-15)
    assert lift.duration_s == pytest.approx(0.1, rel=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_it_agrees_with_what_the_solver_refuses_and_with_a_fine_grid(seed):
    rng = np.random.default_rng(seed)
    shaken = scene(rng.normal(0.0, 0.6, 60), az_g=rng.normal(0.0, 0.6, 60), slope=0.2)
    lift, refused = uplift(shaken), one_axis.run(shaken)
    assert refused.status is Status.UPLIFT
    assert lift.n_min_g == pytest.approx(refused.n_min_g, rel=1e-13)
    assert lift.t_first_s == pytest.approx(refused.t_uplift_s, rel=1e-13)
    fine, at = np.linspace(0.0, 5.9, 590_001), np.arange(60) * 0.1
    ax, az = (np.interp(fine, at, a) for a in (shaken.ax_mps2, shaken.az_mps2))
    below = (G + az) * math.cos(0.2) + ax * math.sin(0.2) < 0.0
    assert lift.duration_s == pytest.approx(below.mean() * 5.9, abs=1e-3)
    assert lift.times == np.count_nonzero(below[1:] & ~below[:-1]) + below[0]


STOCKY = Supports(height_m=0.5, spacing_m=2.0)
SLENDER = Supports(height_m=1.0, spacing_m=0.5)


def friction(mu_fast, rate, mu_static):
    return Friction(mu_slow=0.2, mu_fast=mu_fast, rate_s_per_m=rate, mu_static=mu_static)


@pytest.mark.parametrize(
    ("ax_g", "mu", "at_rest", "sliding", "governs"),
    [
        ([0.0, 0.3, -0.1, 0.0], 0.5, 1.2, 0.0, "at rest"),  # held by friction: by its demand
        ([0.0, 1.0, 0.0], friction(0.2, 0.0, 0.3), 1.2, 0.8, "at rest"),
        ([0.0, 1.0, 0.0], friction(0.4, 20.0, 0.2), 0.8, 1.6, "sliding"),
        ([0.0, 1.0, 0.0], friction(0.4, 0.0, 0.2), 0.8, 0.8, "at rest"),  # grows at no speed
    ],
)
def test_the_larger_of_rest_and_sliding_governs(ax_g, mu, at_rest, sliding, governs):
    tips = tipping(scene(ax_g, mu=mu), SLENDER)
    assert tips.capacity == 0.25
    assert tips.demand == pytest.approx(max(ax_g), rel=1e-15)
    assert (tips.at_rest_ratio, tips.sliding_ratio) == (at_rest, sliding)
    assert (tips.governs, tips.is_ok) == (governs, at_rest < 1.0 and sliding < 1.0)


@pytest.mark.parametrize("peak_g", [0.6, 2.0, 50.0])
def test_a_block_that_slides_cannot_be_given_more_than_friction(peak_g):
    tips = tipping(scene([0.0, -peak_g, 0.0]), STOCKY)
    assert tips.demand == pytest.approx(peak_g, rel=1e-15)
    assert tips.at_rest_ratio == tips.sliding_ratio == 0.25
    assert tips.is_ok


def test_tipping_has_the_slenderness_the_slope_and_the_resultant():
    for mu, ok in ((0.2499, True), (0.25, True), (0.2501, False)):
        assert tipping(scene([0.0, 5.0, 0.0], mu=mu), SLENDER).is_ok == ok
    tips = tipping(scene([0.0, -0.4, 0.0], slope=0.1, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(math.tan(0.1 + math.atan(0.4)), rel=1e-14)
    tips = tipping(scene([0.0, 0.3], ay_g=[0.0, 0.4], az_g=[0.0, -0.5], mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(1.0, rel=1e-14)
    tips = tipping(scene([0.0, 0.0], az_g=[0.0, -1.5]), STOCKY)
    assert tips.demand == math.inf
    assert tips.ratio == 0.25
    with pytest.raises(InputError) as caught:
        tipping(scene([0.0, 0.0]), Supports(height_m=0.0, spacing_m=math.nan))
    assert [line.split()[0] for line in caught.value.problems] == ["height_m", "spacing_m"]


@pytest.mark.parametrize("slope", [0.0, 0.1, 0.3, -0.2])
def test_on_a_slope_at_rest_it_tips_when_its_weight_leaves_its_supports(slope):
    tips = tipping(scene([0.0, 0.0], slope=slope, mu=2.0), STOCKY)
    assert tips.demand == pytest.approx(abs(math.tan(slope)), rel=1e-14)
    edge = tipping(scene([0.0, 0.0], slope=math.atan(0.25) + 1e-9, mu=2.0), SLENDER)
    assert edge.ratio > 1.0 > edge.ratio - 1e-8
