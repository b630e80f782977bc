"""A row of blocks, against closed forms, one block, one rigid array, and SciPy."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fixtures.blocks import block, readonly, shaking
from fixtures.marks import by_day
from solver.errors import InputError
from solver.model import Status, coulomb
from solver.sliding import one_axis
from solver.sliding.row import BlockRow, row_history, slide_row

G = 10.0
HELD = 50.0
"""A coefficient of friction that nothing overcomes."""


def scene(ax, az=(), *, dt=0.01, slope=0.05, mu=0.9):
    return block(ax, az=az, dt=dt, slope=slope, friction=mu, g=G)


def shaken(seed, slope=0.05):
    return scene(shaking(seed, G), shaking(seed + 50, 0.3 * G), slope=slope)


def alone(shaken, mu):
    """The motion of one block, by the exact solver."""
    return one_axis.run(replace(shaken, friction=coulomb(mu)))


def constant(a, seconds, dt=0.01):
    """A roof that is pushed up-slope with `a`, so that the blocks are driven down by it."""
    return scene(np.full(round(seconds / dt) + 1, -a), dt=dt, slope=0.0)


# One block


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("slope", [0.0, 0.05, -0.1])
@pytest.mark.parametrize("mu", [0.0, 0.2, 0.5])
@pytest.mark.quick
def test_a_row_of_one_block_is_the_block_with_vertical_shaking(seed, slope, mu):
    run = shaken(seed, slope)
    result, exact = slide_row(run, BlockRow(mus=(mu,), stiffness_per_s2=1e3)), alone(run, mu)
    assert result.prd_m[0] == pytest.approx(exact.prd_m, rel=1e-9)
    assert result.residual_m[0] == pytest.approx(exact.residual_m, rel=1e-9, abs=1e-9 * exact.prd_m)
    assert (result.down_m[0], result.up_m[0]) == pytest.approx((exact.down_m, exact.up_m), rel=1e-9)
    assert abs(result.prd_m[0] - exact.prd_m) <= result.error_m < 1e-9
    assert (result.n_stops, result.status) == (exact.n_stops, exact.status)
    assert result.rigid == exact
    assert result.stretch_m == result.link_force == 0.0


# Rigid limits


@pytest.mark.parametrize("stiffness", [0.0, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("shares", [(), (0.1, 0.2, 0.3, 0.4)])
def test_blocks_of_equal_friction_move_as_one_whatever_their_links(stiffness, shares):
    row = BlockRow(mus=(0.4,) * 4, stiffness_per_s2=stiffness, damping_per_s=2.0, shares=shares)
    result = slide_row(shaken(1), row)
    assert result.prd_m == pytest.approx((result.rigid.prd_m,) * 4, rel=1e-9)
    assert result.stretch_m == result.link_force == 0.0
    assert result.rigid.prd_m == alone(shaken(1), 0.4).prd_m


@pytest.mark.parametrize("shares", [(), (0.5, 0.2, 0.3)])
@pytest.mark.parametrize("seed", by_day([2, 3], 1))
def test_stiff_links_make_the_rigid_array_of_mean_friction(seed, shares):
    """The difference falls at least with the root of the stiffness, the stretch with it.

    Links ring with the speed F / sqrt(k) when a block stops or slips, F the friction that they
    share out; over a second of sliding that is the envelope.
    """
    mus, run = (0.25, 0.55, 0.4), shaken(seed)
    offs, stretches, shared = [], [], G * (0.55 - 0.4)
    for stiffness in (1e2, 1e4, 1e6, 1e8):
        links = BlockRow(
            mus=mus, stiffness_per_s2=stiffness, damping_per_s=0.2 * stiffness**0.5, shares=shares
        )
        result = slide_row(run, links)
        away = max(abs(prd - result.rigid.prd_m) for prd in result.prd_m)
        assert away <= 1.0 * shared / math.sqrt(stiffness)
        assert abs(max(result.prd_m) - result.rigid.prd_m) <= away
        offs.append(away)
        stretches.append(result.stretch_m)
    assert offs[3] < 1e-2 * offs[0]
    assert max(stretches[i + 1] / stretches[i] for i in (1, 2)) < 0.02
    mean = sum(m * w for m, w in zip(mus, shares or (1 / 3,) * 3, strict=True))
    assert result.rigid.prd_m == pytest.approx(alone(run, mean).prd_m, rel=1e-12)


def test_without_links_each_block_goes_by_itself_and_on_a_dashpot_to_a_steady_speed():
    mus = (0.2, 0.5, 0.35)
    result = slide_row(shaken(4), BlockRow(mus=mus, stiffness_per_s2=0.0))
    assert result.prd_m == pytest.approx([alone(shaken(4), mu).prd_m for mu in mus], rel=1e-9)
    assert result.stretch_m > 0.0
    assert result.link_force == 0.0
    a, c, t = 2.0, 3.0, 2.0
    row = BlockRow(mus=(HELD, 0.0), stiffness_per_s2=0.0, damping_per_s=c)
    result = slide_row(constant(a, t), row)
    way = a / c * (t - (1.0 - math.exp(-c * t)) / c)
    assert result.residual_m == pytest.approx((0.0, way), rel=1e-12)
    assert result.link_force == pytest.approx(a / G * (1.0 - math.exp(-c * t)), rel=1e-12)
    assert result.status is Status.SLIDING_AT_END


# Closed forms


@pytest.mark.parametrize("k", [30.0, 400.0, 1e5])
def test_a_block_without_friction_on_a_held_one_swings_about_its_weight_by_the_spring(k):
    a = 2.0
    result = slide_row(constant(a, 3.0), BlockRow(mus=(HELD, 0.0), stiffness_per_s2=k))
    assert result.prd_m == pytest.approx((0.0, 2.0 * a / k), rel=1e-12)
    swung = 1.0 - math.cos(3.0 * math.sqrt(k))
    assert result.residual_m[1] == pytest.approx(a / k * swung, rel=1e-9)
    assert result.stretch_m == pytest.approx(2.0 * a / k, rel=1e-12)
    assert result.link_force == pytest.approx(2.0 * a / G, rel=1e-12)


@pytest.mark.parametrize(("a", "mu"), [(5.0, 0.03), (5.0, 0.11), (5.0, 0.24), (5.0, 0.26)])
def test_friction_ends_a_swing_after_as_many_reversals_as_the_closed_form_has(a, mu):
    """Each half swing ends 2 mu g / k nearer to a / k, until the spring holds no longer."""
    k, place, n_stops, side = 100.0, 0.0, 0, 1.0
    while abs(a - k * place) > mu * G:
        place = 2.0 * (a - side * mu * G) / k - place
        side, n_stops = -side, n_stops + 1
    result = slide_row(constant(a, 8.0), BlockRow(mus=(HELD, mu), stiffness_per_s2=k))
    assert result.residual_m[1] == pytest.approx(place, rel=1e-11)
    assert result.prd_m[1] == pytest.approx(2.0 * (a - mu * G) / k, rel=1e-12)
    assert (result.n_stops, result.status) == (n_stops, Status.OK)


@pytest.mark.quick
def test_a_block_too_steep_to_rest_by_itself_comes_to_rest_on_its_link():
    slope, mu, k = 0.3, 0.1, 50.0
    still = scene(np.zeros(1001), slope=slope)
    result = slide_row(still, BlockRow(mus=(HELD, mu), stiffness_per_s2=k))
    a, hold = G * math.sin(slope), mu * G * math.cos(slope)
    assert result.status is Status.OK
    assert result.prd_m[1] == pytest.approx(math.cos(slope) * 2.0 * (a - hold) / k, rel=1e-12)
    assert alone(still, mu).status is Status.SLIDING_AT_END
    # Without friction one that nothing pushes rests.
    still = scene(np.zeros(100), slope=0.0)
    result = slide_row(still, BlockRow(mus=(0.0, 0.4), stiffness_per_s2=10.0))
    assert (result.status, result.prd_m, result.n_stops) == (Status.OK, (0.0, 0.0), 0)
    pushed = scene([0.0, 0.0, -1.0, 1.0, 0.0, 0.0], dt=0.1, slope=0.0)
    result = slide_row(pushed, BlockRow(mus=(0.0, HELD, 0.0), stiffness_per_s2=10.0))
    assert result.status is Status.SLIDING_AT_END
    assert result.prd_m[0] == pytest.approx(result.prd_m[2], rel=1e-12)


# Symmetry, invariance


MIXED = BlockRow(mus=(0.3, 0.5, 0.3, 0.2), stiffness_per_s2=2e3, damping_per_s=5.0,
            shares=(0.2, 0.2, 0.2, 0.4))  # fmt: skip


def test_the_mirrored_row_under_the_mirrored_motion_goes_the_mirrored_way():
    run = shaken(5)
    mirrored = replace(run, ax_mps2=readonly(-run.ax_mps2), slope_rad=-run.slope_rad)
    other = replace(MIXED, mus=MIXED.mus[::-1], shares=MIXED.shares[::-1])
    result, seen = slide_row(run, MIXED), slide_row(mirrored, other)
    assert seen.prd_m == result.prd_m[::-1]
    assert seen.residual_m == tuple(-u for u in result.residual_m[::-1])
    assert (seen.down_m, seen.up_m) == (result.up_m[::-1], result.down_m[::-1])
    assert (seen.stretch_m, seen.n_stops) == (result.stretch_m, result.n_stops)


@pytest.mark.parametrize("k", [0.0, 1e2, 1e4, 1e6])
@pytest.mark.parametrize("damping", [0.0, 5.0, 300.0])
@pytest.mark.parametrize("seed", by_day(range(4), 1))
def test_samples_put_between_samples_change_no_more_than_the_bound(seed, damping, k):
    run, row = shaken(seed), replace(MIXED, stiffness_per_s2=k, damping_per_s=damping)
    samples = np.arange(run.ax_mps2.size)
    at = np.arange(3 * samples.size - 2) / 3.0
    ax, az = (np.interp(at, samples, a) for a in (run.ax_mps2, run.az_mps2))
    result, again = slide_row(run, row), slide_row(scene(ax, az, dt=run.dt_s / 3.0), row)
    assert result.error_m < 1e-8 * max(result.prd_m)
    changes = np.subtract(again.prd_m + again.residual_m, result.prd_m + result.residual_m)
    assert np.abs(changes).max() <= result.error_m + again.error_m
    assert again.stretch_m == pytest.approx(result.stretch_m, rel=1e-7)
    assert again.link_force == pytest.approx(result.link_force, rel=1e-7)


# SciPy, written apart: horizontal record, springs by place, events by SciPy


def by_scipy(run, row):
    """Places of the blocks at the samples, by an adaptive solver stopped at every event."""
    n, dt = len(row.mus), run.dt_s
    mus, mass = np.array(row.mus), np.array(row.weights) * n
    grid = np.arange(run.ax_mps2.size) * dt
    sn, cs = math.sin(run.slope_rad), math.cos(run.slope_rad)

    def normal(t):
        return (G + np.interp(t, grid, run.az_mps2)) * cs + np.interp(t, grid, run.ax_mps2) * sn

    def pull(t, y):
        s, w = y[:n], y[n:]
        tension = row.stiffness_per_s2 * np.diff(s) + row.damping_per_s * np.diff(w)
        drive = (G + np.interp(t, grid, run.az_mps2)) * sn - np.interp(t, grid, run.ax_mps2) * cs
        return drive + (np.append(tension, 0.0) - np.append(0.0, tension)) / mass

    def rate(t, y, sigma):
        w = np.where(sigma == 0.0, 0.0, y[n:])
        return np.append(w, np.where(sigma == 0.0, 0.0, pull(t, y) - sigma * mus * normal(t)))

    def watch(i, side):
        def moving(t, y, sigma):
            return sigma[i] * y[n + i] if sigma[i] != 0.0 and side > 0.0 else 1.0

        def resting(t, y, sigma):
            return mus[i] * normal(t) - side * pull(t, y)[i] if sigma[i] == 0.0 else 1.0

        for event in (moving, resting):
            event.terminal, event.direction = True, -1.0
        return moving, resting

    events = [event for i in range(n) for side in (1.0, -1.0) for event in watch(i, side)]
    y, sigma, places = np.zeros(2 * n), np.zeros(n), [np.zeros(n)]
    for start, end in itertools.pairwise(grid):
        t = start
        while t < end:
            found = solve_ivp(
                rate, (t, end), y, "DOP853", events=events, args=(sigma,), rtol=1e-12,
                atol=1e-14, max_step=dt / 8,
            )  # fmt: skip
            t, y = found.t[-1], found.y[:, -1]
            if found.status != 1:
                break
            for number in (k for k, times in enumerate(found.t_events) if times.size):
                i, side = number // 4, 1.0 if number % 4 < 2 else -1.0
                if number % 2:
                    sigma[i] = side
                else:
                    y[n + i] = 0.0
                    push = pull(t, y)[i]
                    sigma[i] = np.sign(push) if abs(push) > mus[i] * normal(t) else 0.0
        places.append(y[:n])
    return np.array(places).T * cs


@pytest.mark.parametrize(
    ("mus", "shares", "k", "c"),
    [
        ((0.3, 0.5), (), 40.0, 0.0),
        ((0.3, 0.5), (0.7, 0.3), 400.0, 4.0),
        ((0.2, 0.6, 0.35), (0.5, 0.2, 0.3), 150.0, 1.0),
    ],
)
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.nightly
def test_an_adaptive_solver_stopped_at_every_event_gives_the_same_motion(mus, shares, k, c, seed):
    rng = np.random.default_rng(seed)
    ax, az = (np.pad(rng.normal(0.0, peak, 24), (1, 2)) for peak in (6.0, 1.5))
    run = scene(ax, az, dt=0.1, slope=0.08)
    row = BlockRow(mus=mus, stiffness_per_s2=k, damping_per_s=c, shares=shares)
    assert slide_row(run, row).n_stops >= 10
    np.testing.assert_allclose(row_history(run, row), by_scipy(run, row), rtol=0.0, atol=1e-11)


# Results and refusals


@pytest.mark.nightly
def test_a_history_ends_where_the_result_does_and_never_leaves_its_peaks():
    run, result = shaken(7), slide_row(shaken(7), MIXED)
    history = row_history(run, MIXED)
    assert history.shape == (4, run.ax_mps2.size)
    np.testing.assert_allclose(history[:, -1], result.residual_m, rtol=0.0, atol=1e-15)
    assert (history.max(axis=1) <= np.array(result.down_m) + 1e-15).all()
    assert (-history.min(axis=1) <= np.array(result.up_m) + 1e-15).all()
    np.testing.assert_allclose(np.abs(history).max(axis=1), result.prd_m, rtol=0.01)


def test_a_row_that_lifts_off_or_is_given_up_gives_no_number():
    lifting = scene(shaking(1, G), shaking(2, 3.0 * G))
    result = slide_row(lifting, MIXED)
    assert result.status is result.rigid.status is Status.UPLIFT
    assert np.isnan([*result.prd_m, result.stretch_m, result.link_force, result.error_m]).all()
    assert np.isnan(row_history(lifting, MIXED)).all()
    # Some 32,000 reversals within one interval of 100 s.
    row = BlockRow(mus=(HELD, 1e-7), stiffness_per_s2=1e6)
    result = slide_row(constant(2.0, 100.0, dt=100.0), row)
    assert result.status is Status.DIVERGED
    assert np.isnan(result.prd_m).all()
    assert result.rigid.status is Status.OK


@pytest.mark.quick
def test_every_fault_of_a_row_is_named():
    bad = BlockRow(mus=(-0.1, 0.3), stiffness_per_s2=math.inf, damping_per_s=-1.0, shares=(1.0,))
    with pytest.raises(InputError) as caught:
        slide_row(shaken(1), bad)
    assert [line.split()[0] for line in caught.value.problems] == [
        "mus", "stiffness_per_s2", "damping_per_s", "shares",
    ]  # fmt: skip
    for change, said in (
        ({"mus": (), "shares": ()}, "mus is empty"),
        ({"shares": (0.2, 0.2, 0.2, 0.2)}, "with a sum of 1"),
        ({"stiffness_per_s2": 1e16}, "softer links"),
    ):
        with pytest.raises(InputError, match=said):
            slide_row(shaken(1), replace(MIXED, **change))
