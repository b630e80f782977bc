"""Response spectra by complex modes: an oracle apart from the kernels, for tests of spectra."""

import math

import numpy as np
from numba import njit

G = 9.80665


@njit
def _largest(a, dt, omega, steps):
    """Largest |u| of q' = s q - a, u = Im(q) / w_d, at a number of places of every interval."""
    h = dt / steps
    damped = omega * math.sqrt(1.0 - 0.05**2)
    s = complex(-0.05 * omega, damped)
    turn = np.exp(s * h)
    held = (turn - 1.0) / s
    ramped = (held - h) / (s * h)
    q, peak = 0j, 0.0
    for i in range(a.size - 1):
        now, change = a[i], (a[i + 1] - a[i]) / steps
        for _ in range(steps):
            q = turn * q - now * held - change * ramped
            now += change
            peak = max(peak, abs(q.imag))
    return peak / damped


def psa_g(a_mps2, dt_s, freq_hz, places=400):
    """5% damped pseudo-acceleration [g]; `places` to a period or more miss 1 - cos(pi / places).

    With 400 that is 0.003%.
    """
    return np.array(
        [
            (2.0 * np.pi * f) ** 2
            * _largest(np.asarray(a_mps2), dt_s, 2.0 * np.pi * f, math.ceil(places * dt_s * f))
            / G
            for f in freq_hz
        ]
    )
