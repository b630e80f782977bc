"""The kernels of two axes with the compiler off: the same bits, and every line run."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest

from fixtures.blocks import readonly
from solver.kernels import one_axis, two_axes

pytestmark = pytest.mark.quick

G = 10.0


def wave(seed, n):
    return np.random.default_rng(seed).normal(0.0, 4.0, n).round(3)


QUIET = np.concatenate([np.zeros(40), wave(1, 8), np.zeros(40)])
FALLS = (0.3, -0.1, 5.0, 0.42)
GROWS = (0.3, 0.1, 5.0, 0.2)

# Along, across, vertical, sine of the slope, friction, law: chosen so that together they reach
# every line.
SCENES = [
    (wave(2, 30), wave(3, 30), [], 0.0, 0.2, None),
    (wave(4, 30), wave(5, 30), 0.2 * wave(6, 30), 0.1, 0.3, None),
    (wave(2, 20), wave(3, 20), [], 0.0, 1.0, GROWS),
    (wave(4, 20), wave(5, 20), 0.1 * wave(6, 20), 0.05, 1.0, FALLS),
    (QUIET, -QUIET[::-1], [], 0.05, 0.3, None),
    (QUIET, -QUIET[::-1], 0.2 * QUIET, 0.05, 0.3, None),
    (wave(7, 10), wave(8, 10), [], 0.0, 0.0, None),
    ([0.0, -5.0, -5.0, 9.0, 9.0, -3.0, 0.0, 0.0], np.zeros(8), [], 0.0, 0.2, None),
    ([0.0, -5.0, -5.0, 9.0, 9.0, -3.0, 0.0, 0.0], 1e-12 * wave(9, 8), [], 0.0, 0.2, None),
    ([0.0, -1.5, -2.2, -1.5, 0.0, 0.0], [0.0, -1.7, 0.0, 1.7, 0.0, 0.0], [], 0.0, 0.2, None),
    # No drive where it stops, and none where it begins: weight and shaking vanish together.
    ([-6.0, -6.0, 0.0, 0.0, 0.0], [1.0, 2.0, 0.0, 0.0, 0.0], [], 0.0, 0.2, None),
    ([0.0, 0.0, -4.0], [0.0, 0.0, 3.0], [-10.0, -10.0, -9.0], 0.0, 0.2, None),
    # A stop and a slip within one step.
    ([-2.0, 5.0, 0.0, -1.0, 1.0, 5.0], [3.0, -4.0, 6.0, 2.0, 2.0, 0.0], [], 0.0, 0.2, None),
    # A normal force that vanishes, and one so small that the series of w is soon not the speed.
    ([0.0, 1.0, -1.0], [0.0, -0.3, 0.4], [0.0, -10.0, -10.0], 0.0, 0.2, None),
    # A slip that hardly begins, and one that does not begin at all.
    ([0.0, -2.0001, -2.0002, -1.9, 0.0], [0.0, 0.001, 0.0, 0.0, 0.0], [], 0.0, 0.2, None),
    ([0.0, -1.2, -1.6, 0.0], [0.0, -1.6, -1.2, 0.0], [], 0.0, 0.2, None),
]


def run_all(scenes=SCENES):
    """Return the outcome of every scene."""
    slide = two_axes.slide_plane
    numbers = []
    for along, across, vertical, sn, mu, law in scenes:
        ax, ay = readonly(along), readonly(across)
        az = readonly(vertical if len(vertical) else np.zeros(ax.size))
        bounds = [one_axis.bounds(a) for a in (ax, ay, az)]
        slope = sn, math.sqrt(1.0 - sn * sn)
        numbers.append(two_axes.friction_demand(ax, ay, az, *slope, G, 1.0))
        for step, most in ((1e-6, 12), (1e-13, 20)):
            top, end = np.empty(7), np.empty(4)
            settings = (0.05, *slope, mu, G, 1.0, step, most, 2000, law)
            nothing = np.empty((0, 4)), np.empty((4, 0))
            run = slide(ax, ay, az, *bounds, *settings, *nothing, top, end)
            events, history = np.full((run[3], 4), np.nan), np.full((4, ax.size), np.nan)
            again = slide(ax, ay, az, *bounds, *settings, events, history, top, end)
            assert again == run
            numbers += [*run, *top, *end, *events.ravel(), *history.ravel()]
    return np.array(numbers, dtype=float)


@pytest.mark.nightly
def test_compiled_and_plain_kernels_give_the_same_bits(tmp_path):
    """Plain in a process of its own: here, the functions inside would be compiled all the same."""
    if "NUMBA_DISABLE_JIT" in os.environ:
        run_all()  # for the lines that it runs: in this run both would be plain
        return
    subprocess.run(
        [sys.executable, "-c", f"import {__name__} as t; t.np.save('plain.npy', t.run_all())"],
        cwd=tmp_path,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)},
        check=True,
        timeout=60,
    )
    np.testing.assert_array_equal(run_all(), np.load(tmp_path / "plain.npy"))


def given_up(ax, most_steps, dt=0.05):
    """Return how a run ends that has no answer."""
    ax = readonly(ax)
    level = readonly(np.zeros(ax.size))
    x, z = one_axis.bounds(ax), one_axis.bounds(level)
    settings = (dt, 0.0, 1.0, 0.2, G, 1.0, 1e-6, 12, most_steps, None)
    nothing = np.empty((0, 4)), np.empty((4, 0))
    with np.errstate(all="ignore"):
        return two_axes.slide_plane(
            ax, ax, level, x, x, z, *settings, *nothing, np.empty(7), np.empty(4)
        )


def test_a_run_without_an_answer_says_why_and_shifts_are_alike():
    assert given_up(wave(2, 30), 2000)[0] == two_axes.FOLLOWED
    assert given_up(wave(2, 30), 5)[0] == two_axes.TOO_MANY_STEPS
    assert given_up([0.0, 1e300, -1e300, 0.0], 2000)[0] == two_axes.NOT_FINITE
    assert given_up(wave(2, 30), 2000, dt=1e200)[0] == two_axes.NOT_FINITE
    assert two_axes.SHIFT == one_axis.SHIFT


def test_a_run_keeps_no_references_to_its_arrays():
    """The functions inside count no references to what they borrow."""
    ax, ay, az = readonly(wave(2, 30)), readonly(wave(3, 30)), readonly(np.zeros(30))
    given = [ax, ay, az, *(one_axis.bounds(a) for a in (ax, ay, az))]
    filled = [np.empty(shape) for shape in ((9, 4), (4, 30), 7, 4)]
    settings = (0.05, 0.0, 1.0, 1.0, G, 1.0, 1e-6, 12, 2000, GROWS)
    two_axes.slide_plane(*given, *settings, *filled)  # a compilation keeps what it was called with
    before = [sys.getrefcount(array) for array in given + filled]
    for _ in range(100):
        assert two_axes.slide_plane(*given, *settings, *filled)[0] == two_axes.FOLLOWED
    assert [sys.getrefcount(array) for array in given + filled] == before


@pytest.mark.skipif("NUMBA_DISABLE_JIT" not in os.environ, reason="compiled code asks the system")
def test_what_memory_held_before_changes_nothing(monkeypatch):
    cheap = [SCENES[6], SCENES[12]]
    before = run_all(cheap)
    monkeypatch.setattr(np, "empty", lambda shape: np.full(shape, 1e9))
    np.testing.assert_array_equal(run_all(cheap), before)


def hardly_pushed(seed, sn, mu):
    """Blocks of equal samples but one, of which the greatest push is just above friction.

    Of every other seed the equal ones are zero, and the signs of the one go round: its bounds are
    then those of one push.
    """
    rng = np.random.default_rng(seed)
    a = np.repeat(rng.normal(size=(3, 5)) * (seed % 2), 16, axis=1)
    a[:, 7::16] = rng.normal(size=(3, 5))
    if seed % 2 == 0:
        a = np.abs(a) * [[1.0 if seed & 2 else -1.0], [0.3], [1.0 if seed & 4 else -0.1]]
    low, high = 0.0, 8.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        ax, ay, az = middle * a
        weight, cs = G + az, math.sqrt(1.0 - sn * sn)
        push = np.hypot(weight * sn - ax * cs, ay) - mu * (weight * cs + ax * sn)
        low, high = (low, middle) if push.max() > 1e-3 else (middle, high)
    return high * a


@pytest.mark.parametrize(
    ("shaking", "sn"),
    [
        ((QUIET, -QUIET[::-1], 0.0 * QUIET), 0.1),
        *((hardly_pushed(k, sn, 0.45), sn) for k in range(12) for sn in (0.0, -0.15, 0.3)),
    ],
)
def test_blocks_passed_over_change_nothing(shaking, sn):
    ax, ay, az = map(readonly, shaking)
    bounds = [one_axis.bounds(a) for a in (ax, ay, az)]
    # All of a record but its peak, which rounding is told from.
    wide = [np.array([[-99.0], [99.0]]) * np.ones_like(each) for each in bounds]
    for widened, each in zip(wide, bounds, strict=True):
        widened[:, -1] = each[:, -1]
    cs, held = math.sqrt(1.0 - sn * sn), (0.3, 0.0, 0.0, 0.45)
    for mu, law in ((0.45, None), (1.0, held)):
        runs = []
        for given in (bounds, wide):
            top, end = np.empty(7), np.empty(4)
            run = two_axes.slide_plane(
                ax, ay, az, *given, 0.05, sn, cs, mu, G, 1.0, 1e-6, 12, 2000, law,
                np.empty((0, 4)), np.empty((4, 0)), top, end,
            )  # fmt: skip
            runs.append([*run, *top, *end])
        assert runs[0] == runs[1]
        assert runs[0][0] == two_axes.FOLLOWED
        assert runs[0][3] > 0
