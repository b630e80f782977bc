"""The kernels with the compiler off, to the bit, and at the ends of records."""

import math
from itertools import product

import numpy as np
import pytest

from blocks import SCENES, readonly
from solver.kernels import one_axis, oscillator

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
