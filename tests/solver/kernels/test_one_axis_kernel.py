"""Kernels with the compiler off, to the bit; the oscillator and lives against closed forms."""

import math
from itertools import product

import numpy as np
import pytest

from fixtures.blocks import SCENES, readonly
from solver.kernels import one_axis, oscillator
from solver.kernels.lives import live

pytestmark = pytest.mark.quick

G = 10.0


def quiet_then_shaken(n):
    """Long rest, a shock in its middle, long rest: whole blocks of samples to pass over."""
    record = np.zeros(n)
    record[n // 2 : n // 2 + 6] = [2.0, -6.0, -6.0, 5.0, 5.0, 0.0]
    return record


LONG = [
    (quiet_then_shaken(1200), [], 0.05, 0.3),
    (quiet_then_shaken(1200), 0.2 * quiet_then_shaken(1200), 0.05, 0.3),
    (np.zeros(300), [], 0.4, 0.1),
]


def run_all(compiled):
    """Return the outcome of every scene by every kernel, compiled or as plain Python."""
    names = "slide_exact", "fill_history", "minimum_normal", "bounds", "sweep_exact"
    kernels = [getattr(one_axis, name) for name in names]
    exact, fill, normal, bounds, sweep, peaks, oscillations = (
        f if compiled else getattr(f, "py_func", f)
        for f in (*kernels, oscillator.peaks, oscillator.histories)
    )
    numbers = []
    for (horizontal, vertical, sn, mu), scale in product(SCENES + LONG, (1.0, 0.0)):
        ax, cs = readonly(horizontal), math.sqrt(1.0 - sn * sn)
        az = readonly(vertical) if len(vertical) else None
        x, z = bounds(ax), bounds(az) if az is not None else None
        run = exact(ax, az, x, z, 0.25, sn, cs, mu, G, scale, None)
        events = np.full((2 * run[5] + 1, 3), np.nan)
        again = exact(ax, az, x, z, 0.25, sn, cs, mu, G, scale, events)
        assert run == again
        history = np.full((2, ax.size), np.nan)
        fill(ax, az, 0.25, sn, cs, mu, G, scale, events[: run[-1]], history)
        numbers += [*run, *events.ravel(), *history.ravel()]
        numbers += normal(ax, az, x, z, 0.25, sn, cs, G, scale)
        out, scene = np.empty((1, 4)), np.array([[math.asin(sn), mu, scale]])
        sweep(ax, az, x, z, 0.25, G, scene, out)
        numbers += out.ravel().tolist()
        for omega in (1e-6, 1e-2, 1.0, 50.0):
            peak, at = np.empty(1), np.empty(1, dtype=np.int64)
            peaks(ax, 0.25, np.array([omega]), 0.05, peak, at)
            numbers += [peak[0], at[0]]
        roofs = np.full((ax.size, 3), np.nan)
        oscillations(ax, 0.25, readonly([0.0, 1e-2, 50.0]), readonly([0.05, 0.0, 0.3]), roofs)
        numbers += roofs.ravel().tolist()
    return np.array(numbers, dtype=float)


@pytest.mark.nightly
def test_compiled_and_plain_kernels_give_the_same_bits():
    np.testing.assert_array_equal(run_all(compiled=True), run_all(compiled=False))


@pytest.mark.parametrize("size", [1, 2, 15, 16, 17, 256, 257, 300, 512, 529])
def test_bounds_are_of_blocks_of_blocks_of_blocks_and_of_all(size):
    a, block = readonly(np.random.default_rng(size).normal(size=size)), one_axis.BLOCK
    parts = [a[k : k + n] for n in (block, block**2) for k in range(0, size, n)]
    wanted = [[part.min(), part.max()] for part in (*parts, a)]
    np.testing.assert_array_equal(one_axis.bounds(a), np.transpose(wanted))


@pytest.mark.parametrize("vertical", [False, True])
@pytest.mark.parametrize("size", [2, 16, 17, 18, 256, 257, 272, 273])
def test_the_last_sample_of_a_record_of_any_length_is_seen(size, vertical):
    level = readonly(np.zeros(size))
    ax, az = readonly([*level[1:], -4.0]), level if vertical else None
    x, z = one_axis.bounds(ax), one_axis.bounds(az) if vertical else None
    run = one_axis.slide_exact(ax, az, x, z, 0.25, 0.0, 1.0, 0.2, G, 1.0, None)
    # The push is 2 m/s2 above friction at the end, from zero half an interval before.
    assert run[0] == pytest.approx(2.0 * 0.125**2 / 6.0, rel=1e-12)
    down, right = readonly(3.0 * ax), readonly(-3.0 * ax)
    for ax, az, sn, cs in ((level, down, 0.0, 1.0), (right, level, -1.0, 0.0)):
        bounds = one_axis.bounds(ax), one_axis.bounds(az)
        least, first = one_axis.minimum_normal(ax, az, *bounds, 0.25, sn, cs, G, 1.0)
        assert least == pytest.approx(cs - 1.2, rel=1e-12)
        assert first == pytest.approx(0.25 * (size - 2 + cs / 1.2), rel=1e-12)


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3])
def test_a_sudden_load_overshoots_by_the_textbook_factor(zeta):
    n, dt, omega, load = 100, 0.01, 2.0 * math.pi, 3.0
    peak, at = np.zeros(1), np.zeros(1, dtype=np.int64)
    record = np.full(n, load)
    oscillator.peaks(readonly(record), dt, np.array([omega]), zeta, peak, at)
    kappa = math.sqrt(1.0 - zeta * zeta)
    # A. K. Chopra, Dynamics of Structures: step force, u_max = u_st (1 + exp(-pi zeta / kappa)).
    assert -peak[0] == pytest.approx(load * (1.0 + math.exp(-math.pi * zeta / kappa)), rel=1e-6)
    assert at[0] * dt == pytest.approx(0.5 / kappa, abs=dt)


def of_a_step(p, zeta):
    """The matrix exponential of a step, of p in the time omega t."""
    # y' = z, z' = -y - 2 zeta z - a - r tau, and r are constants.
    rates = np.array([[0, 1, 0, 0], [-1, -2 * zeta, -1, 0], [0, 0, 0, 1], [0, 0, 0, 0.0]])
    return np.linalg.matrix_power(np.eye(4) + rates * p / 2**24, 2**24)


def test_crests_are_the_samples_that_exceed_their_neighbors_and_the_limit():
    n, dt, zeta = 200, 0.01, 0.05
    a = np.random.default_rng(5).standard_normal(n)
    omega, above = np.array([20.0, 60.0]), np.array([0.3, 0.5])
    which, where, values = oscillator.crests(readonly(a), dt, omega, zeta, above)
    expected = []
    for k, p in enumerate(omega * dt):
        vectors, y, z = of_a_step(p, zeta), [0.0], 0.0
        for i in range(1, n):
            moved, z = (vectors @ [y[-1], z, a[i - 1], (a[i] - a[i - 1]) / p])[:2]
            y.append(moved)
        far = np.abs(y)
        expected += [(k, i) for i in range(1, n - 1)
                     if far[i] > above[k] and far[i - 1] <= far[i] > far[i + 1]]  # fmt: skip
        own = which == k
        assert values[own] == pytest.approx(np.array(y)[where[own]], rel=1e-6)
    assert list(zip(which, where, strict=True)) == expected
    assert len(expected) > 10


def test_reversed_pulses_are_second_differences_of_the_response_to_a_ramp():
    n, zeta, radians, at = 400, 0.05, np.array([0.05, 0.4, 2.0]), np.array([399, 150, 0])
    out = np.zeros((3, n))
    begin = oscillator.reversed_pulses(radians, zeta, at, 1e-3, out)
    kappa = math.sqrt(1.0 - zeta**2)
    for k in range(3):
        w = radians[k] * np.arange(n + 1)
        h = np.exp(-zeta * w) * np.sin(kappa * w) / kappa
        once = 1.0 - np.exp(-zeta * w) * np.cos(kappa * w) - zeta * h
        ramp = np.append(0.0, w - h - 2.0 * zeta * once)
        pulse = np.diff(ramp, n=2) / -radians[k]
        filled = slice(begin[k], at[k] + 1)
        assert out[k, filled][::-1] == pytest.approx(pulse[: at[k] + 1 - begin[k]], abs=1e-12)
        assert not out[k, : begin[k]].any()
        assert not out[k, at[k] + 1 :].any()
    # exp(-0.05 * 0.4 * 346) = 1e-3
    assert list(begin) == [0, 0, 0]
    begin = oscillator.reversed_pulses(np.array([0.4]), zeta, np.array([399]), 1e-3, out[:1])
    assert begin[0] == 399 - 346


NEVER = math.inf
# Half-way from level 0 to 1: PRD 5, 4 down, 1 up and 2 across, residuals 3 down and 2 across.
RESPONSES = np.array([[[[4.0, 3.0, 1.0, 2.0, 2.0, 2.0], [6.0, 5.0, 1.0, 2.0, 4.0, 2.0],
                        [np.nan] * 6]]])  # fmt: skip


def lived(levels, sides, recenter=NEVER):
    """Return the largest and the last distance of one life of events half-way between levels."""
    out, only = np.empty((2, 1)), np.zeros(1, dtype=np.int64)
    run, level = np.zeros(len(levels), dtype=np.int64), np.array(levels, dtype=np.int64)
    first, weight = np.array([0, len(levels)]), np.full(len(levels), 0.5)
    live(first, only, run, level, weight, np.array(sides), RESPONSES, recenter, out)
    return tuple(out[:, 0])


def test_places_add_until_an_array_is_put_back():
    # Its PRD of 5, or the corner of 4 down and 2 across, which is nearer.
    assert lived([0], [1.0]) == pytest.approx((math.hypot(4.0, 2.0), math.hypot(3.0, 2.0)))
    largest, last = lived([0, 0], [1.0, -1.0])
    assert last == pytest.approx(6.0)
    # From (3, 2): the PRD from there, or the corner (3 + 4, 2 + 2).
    assert largest == pytest.approx(min(math.hypot(3.0, 2.0) + 5.0, math.hypot(7.0, 4.0)))
    assert lived([0, 0], [1.0, 1.0], recenter=3.0) == pytest.approx((math.hypot(4.0, 2.0), 0.0))
    assert lived([], []) == (0.0, 0.0)
    for levels in ([-1], [1], [0, -1]):  # without a response
        assert lived(levels, [1.0] * len(levels)) == (math.inf, math.inf)
