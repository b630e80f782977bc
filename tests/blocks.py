"""Blocks under records made by hand, and shaking of a seed, for the tests of the solver."""

import numpy as np

from solver.model import Friction, Scene, coulomb
from solver.records.record import Record


def readonly(values):
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array


def block(ax, ay=(), az=(), *, dt=0.01, slope=0.0, friction=0.4, scale=1.0, g=9.80665):
    """Return a scene of records [m/s2], with a friction coefficient or law."""
    return Scene(
        ax_mps2=readonly(ax),
        ay_mps2=readonly(ay),
        az_mps2=readonly(az),
        dt_s=dt,
        slope_rad=slope,
        friction=friction if isinstance(friction, Friction) else coulomb(friction),
        scale=scale,
        g_mps2=g,
    )


def record(values, dt_s=0.01, name="r"):
    return Record(name=name, dt_s=dt_s, a_mps2=np.asarray(values, dtype=float))


def places(outcome):
    """Return the PRD, the four excursions and the end of a motion in plan [m]."""
    return np.array(outcome.places)


def trapezoid(peak, plateau, rest):
    """Return a pulse with ramps of one interval, then rest."""
    return np.concatenate([[0.0], np.full(plateau + 1, peak), np.zeros(rest)])


def shaking(seed, peak_mps2, seconds=10.0, dt=0.01):
    """Return noise of periods from 0.2 to 3 s, from rest to rest."""
    rng = np.random.default_rng(seed)
    n = round(seconds / dt)
    freq = np.fft.rfftfreq(n, dt)
    wave = np.fft.irfft(((freq > 0.3) & (freq < 5.0)) * np.exp(2j * np.pi * rng.random(freq.size)))
    wave = wave[:n] * np.sin(np.pi * np.arange(n) / n)
    wave *= peak_mps2 / np.abs(wave).max()
    wave[0] = wave[-1] = 0.0
    return readonly(wave)


SCENES = [
    ([0.0, 4.0, 4.0, -8.0, 0.0, 0.0], [], 0.0, 0.2),
    ([-4.0, 0.5, -8.0], [], 0.0, 0.2),
    ([-4.0, 2.0, 2.0, -8.0], [], 0.0, 0.2),
    ([2.0, 2.0, 2.0, -2.0, -2.0], [], 0.0, 0.2),
    ([3.0, -3.0, 3.0, 3.0, -9.0, 5.0], [], 0.0, 0.0),
    ([0.0, 0.0, 0.0, 0.0], [], 0.3, 0.1),
    ([0.0, -6.0, 6.0, -6.0, 0.0, 0.0], [0.0, 2.0, -3.0, 1.0, 0.0, 0.0], 0.1, 0.4),
    ([0.0, 0.0, -30.0, 0.0], [], 0.5, 0.4),
    ([-30.0, 0.0, 0.0], [], 0.5, 0.4),
    ([0.0, -20.0, 0.0, 12.0, 0.0], [], -0.6, 0.3),
    # The speed comes down to touch zero at the vertex, within a rounding.
    ([-4.0, 0.0, -4.0, -4.0], [], 0.0, 0.2),
    ([0.0, -3.0, 1.0, -3.0, -3.0], [], 0.0, 0.1),
    # Self-locking: no push can send it up the slope.
    ([0.0, 8.0, 9.0, 0.0], [], 0.8, 1.5),
    ([0.0, 8.0, 9.0, 0.0], [], 0.6, 0.75),
    # The speed dips within an interval and stays above zero.
    ([-8.0, -1.0, -8.0, 0.0], [], 0.0, 0.2),
    ([0.0, 0.0, 0.0, -9.0, 0.0, 7.0, 0.0, 0.0, 0.0, 1.0, 0.0], [], 0.1, 0.3),
]
"""Horizontal and vertical samples, sine of the slope, friction: together they reach every line.

Pulses, reversals, dips to zero, equal samples, no friction, free sliding, long rests.
"""
