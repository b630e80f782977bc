"""Blocks in two axes: against closed forms, the exact one-axis solver and SciPy, to a tolerance."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from blocks import block, places
from solver.sliding import checked, one_axis, two_axes
from solver.sliding.two_axes import follow, follow_history

G = 9.80665
NONE = np.empty(0)

"""Error that SciPy itself makes: it begins a slip a little late."""


def scene(ax, ay, dt, *, degrees=0.0, friction=0.3, az=NONE, scale=1.0):
    return block(ax, ay, az, dt=dt, slope=math.radians(degrees), friction=friction, scale=scale)


def shaking(seed, n=400, dt=0.01, peak=8.0):
    """Smooth noise in three components: rest, a strong part, rest."""
    rng = np.random.default_rng(seed)
    t = np.arange(n) * dt
    freq, phase = rng.uniform(0.4, 8.0, (3, 25, 1)), rng.uniform(0.0, 6.28, (3, 25, 1))
    waves = np.sin(2 * np.pi * freq * t + phase).sum(axis=1) * np.sin(np.pi * t / t[-1]) ** 2
    waves *= peak / np.abs(waves).max(axis=1, keepdims=True)
    return waves[0], waves[1], 0.3 * waves[2]


@pytest.mark.parametrize("degrees", [-6.0, 0.0, 4.0])
@pytest.mark.parametrize("mu", [0.0, 0.2, 0.45])
@pytest.mark.parametrize("with_vertical", [False, True])
@pytest.mark.quick
def test_without_transverse_shaking_it_is_the_exact_one_axis_motion(degrees, mu, with_vertical):
    ax, _, az = shaking(1)
    az = az if with_vertical else NONE
    exact = checked.slide(
        ax,
        0.01,
        slope_rad=math.radians(degrees),
        mu=mu,
        az_mps2=az if with_vertical else None,
    )
    outcome = follow(scene(ax, 0.0 * ax, 0.01, degrees=degrees, friction=mu, az=az))
    assert outcome.prd_m == pytest.approx(exact.prd_m, rel=1e-12)
    assert outcome.down_m == pytest.approx(exact.down_m, rel=1e-12)
    assert outcome.up_m == pytest.approx(exact.up_m, rel=1e-12, abs=1e-15)
    assert outcome.end_m == pytest.approx((exact.residual_m, 0.0), abs=1e-12 * exact.prd_m)
    assert outcome.t_prd_s == pytest.approx(exact.t_prd_s, abs=1e-9)
    assert outcome.peak_mps == pytest.approx(exact.peak_speed_mps, rel=1e-9)
    if mu > 0.0:
        assert outcome.n_stops == exact.n_stops


@pytest.mark.parametrize("part", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-200])
def test_a_little_transverse_shaking_changes_little(part):
    ax, ay, _ = shaking(2)
    alone = follow(scene(ax, 0.0 * ax, 0.01, degrees=3.0))
    outcome = follow(scene(ax, part * ay, 0.01, degrees=3.0))
    assert abs(outcome.prd_m - alone.prd_m) <= (2.0 * part + 1e-9) * alone.prd_m
    assert outcome.left_m + outcome.right_m <= (3.0 * part + 1e-9) * alone.prd_m


def test_a_mirrored_scene_gives_the_mirrored_answer_to_the_last_bit():
    ax, ay, az = shaking(5)
    outcome = follow(scene(ax, ay, 0.01, degrees=4.0, az=az))
    across = follow(scene(ax, -ay, 0.01, degrees=4.0, az=az))
    assert (across.left_m, across.right_m) == (outcome.right_m, outcome.left_m)
    along = follow(scene(-ax, ay, 0.01, degrees=-4.0, az=az))
    assert (along.down_m, along.up_m) == (outcome.up_m, outcome.down_m)
    for name in ("prd_m", "t_prd_s", "peak_mps", "error_m", "n_stops", "n_events", "n_steps"):
        assert getattr(across, name) == getattr(along, name) == getattr(outcome, name)


def test_without_friction_it_is_the_record_summed_twice():
    ax, ay, az = shaking(6)
    outcome = follow(scene(ax, ay, 0.01, friction=0.0, az=az))
    for a, end, end_mps in zip((ax, ay), outcome.end_m, outcome.end_mps, strict=True):
        v = np.concatenate([[0.0], np.cumsum(0.5 * (a[1:] + a[:-1]))]) * 0.01
        u = np.sum(v[:-1] * 0.01 + 1e-4 * (a[:-1] / 3.0 + a[1:] / 6.0))
        assert end == pytest.approx(-u, rel=1e-11)
        assert end_mps == pytest.approx(-v[-1], rel=1e-11)
    # A block whose acceleration is wrong by one rounding of g for the whole record.
    assert outcome.error_m >= 0.5 * (399 * 0.01) ** 2 * G * 2.0**-52


@pytest.mark.quick
def test_a_steep_roof_slides_without_shaking():
    outcome = follow(scene(np.zeros(201), np.zeros(201), 0.01, degrees=25.0, friction=0.3))
    sn, cs = math.sin(math.radians(25.0)), math.cos(math.radians(25.0))
    assert outcome.prd_m == pytest.approx(0.5 * G * (sn - 0.3 * cs) * 4.0 * cs, rel=1e-12)
    assert outcome.n_stops == 0


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_bound_is_never_below_the_rounding_that_one_axis_allows_for(sign):
    # Without friction there is no other error; one axis doubles that of accelerations.
    still, ramp = np.zeros(3), np.array([0.0, 0.5, 1.0])
    for ax, az in (
        (sign * 1.5 * ramp, NONE),
        (sign * 1500.0 * ramp, NONE),
        (still, sign * 6.0 * ramp),
    ):
        run = scene(ax, still, 1.0, degrees=30.0, friction=0.0, az=az)
        assert follow(run, 1e-10).error_m >= 0.5 * one_axis.rounding(one_axis.prepared(run))


def test_nothing_moves_below_the_yield_acceleration_and_at_once_beyond_it():
    t = np.arange(3000) * 0.01
    a = 0.3 * G * (1.0 - 1e-9)
    outcome = follow(scene(a * np.cos(t), a * np.sin(t), 0.01, friction=0.3))
    assert (outcome.prd_m, outcome.n_stops, outcome.n_steps, outcome.error_m) == (0.0, 0, 0, 0.0)
    run = scene([-3.0, -3.0, 6.0, 6.0], [-4.0, -4.0, 8.0, 8.0], 0.1, friction=0.2)
    exact = checked.slide([-5.0, -5.0, 10.0, 10.0], 0.1, slope_rad=0.0, mu=0.2)
    _, events = follow_history(run, follow(run))
    assert events[0].t_s == 0.0
    assert follow(run).prd_m == pytest.approx(exact.prd_m, rel=1e-9)


@given(
    seed=st.integers(0, 1000),
    mu=st.sampled_from([0.0]) | st.floats(0.05, 0.9),
    degrees=st.floats(-8.0, 8.0),
    factor=st.sampled_from([2, 5]),
)
def test_samples_put_between_change_nothing(seed, mu, degrees, factor):
    ax, ay, az = shaking(seed, n=60, dt=0.03)
    fine = np.arange(59 * factor + 1) / factor
    more = [np.interp(fine, np.arange(60), a) for a in (ax, ay, az)]
    outcome = follow(scene(ax, ay, 0.03, degrees=degrees, friction=mu, az=az), 1e-8)
    two = follow(scene(*more[:2], 0.03 / factor, degrees=degrees, friction=mu, az=more[2]), 1e-8)
    assert np.abs(places(outcome) - places(two)).max() <= outcome.error_m + two.error_m + 1e-12


@given(seed=st.integers(0, 1000), mu=st.floats(0.0, 0.9), scale=st.floats(0.25, 4.0))
def test_a_motion_and_gravity_scaled_scale_the_answer(seed, mu, scale):
    ax, ay, az = shaking(seed, n=80, dt=0.02)
    run = scene(ax, ay, 0.02, degrees=3.0, friction=mu, az=az)
    outcome = follow(run, 1e-8)
    two = follow(replace(run, scale=scale, g_mps2=scale * G), 1e-8)
    assert places(two) == pytest.approx(scale * places(outcome), abs=2e-8 * scale * outcome.prd_m)


# Events went back by a rounding in these scenes, in one axis or in two.
@pytest.mark.parametrize("number", [362, 732, 1560, 1828, 3826, 5766, 8325, 9753])
@pytest.mark.quick
def test_events_never_go_back_where_the_push_rests_exactly_at_the_limit(number):
    rng = np.random.default_rng([9, number])
    n, dt = rng.integers(4, 14), rng.choice([0.005, 0.01, 0.02, 0.1])
    mu, slope = rng.choice([0.1, 0.2, 0.3]), rng.choice([0, 0, 0.02, 0.05])
    limits = [(sign * mu * math.cos(slope) - math.sin(slope)) * G for sign in (1, -1)]
    pushes = [*limits, *limits, 0, *(1.5 * x for x in limits), *(3 * x for x in limits)]
    ax = rng.choice(pushes, n)
    ay = np.zeros(n) if rng.random() < 0.5 else rng.choice([0, 0, 1e-3, 1.0], n)
    run = scene(ax, ay, dt, degrees=math.degrees(slope), friction=mu)
    for solver in (one_axis, two_axes):
        times = [event.t_s for event in solver.run_history(run).events]
        assert times == sorted(times)
