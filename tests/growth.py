"""How the time of a call grows with its input, measured so that the machine's other work is not."""

import sys
import time

MOST = 3.0
"""Largest growth of a time from a size to twice of it: 2 if linear, 4 if quadratic."""

NOISE_S = 0.05 if sys.platform == "win32" else 0.002
"""A shorter time is no measure: Windows counts it in ticks of 16 ms."""


def seconds(call, given, repeats=3):
    """Return the least processor time of some calls: all else only adds to it."""
    times = []
    for _ in range(repeats):
        begin = time.process_time()
        call(given)
        times.append(time.process_time() - begin)
        if times[-1] < NOISE_S:
            break
    return min(times)


def grows_faster(call, made, size):
    """Whether the time grows faster than the input, from a size to twice and four times of it.

    Parameters
    ----------
    made : callable
        Makes the input of a size.
    """
    times = [seconds(call, made(size * k)) for k in (1, 2)]
    if times[1] < max(NOISE_S, MOST * times[0]):
        return False
    return times[1] > 6.0 * times[0] or seconds(call, made(4 * size)) > MOST * times[1]
