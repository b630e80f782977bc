"""Damped oscillators under a linearly interpolated record, jitted: spectra and building modes.

Never raises, knows no units but SI; numpy and numba only.
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT


@njit(cache=KEPT)
def _step(p, zeta):
    """h, h', and h integrated once and twice, over one step p = omega dt of an oscillator.

    h is the unit impulse response of y'' + 2 zeta y' + y = 0 in the time omega t. For small p the
    closed forms lose digits by cancellation, up to a factor of p^3, so the Taylor series is summed
    instead, with h_k+2 = -2 zeta h_k+1 - h_k.
    """
    if p >= 1.0:
        kappa = math.sqrt(1.0 - zeta * zeta)
        decay = math.exp(-zeta * p)
        h = decay * math.sin(kappa * p) / kappa
        slope = decay * math.cos(kappa * p) - zeta * h
        once = 1.0 - slope - 2.0 * zeta * h
        return h, slope, once, p - h - 2.0 * zeta * once
    h = once = twice = 0.0
    term, ahead, power = 0.0, 1.0, 1.0
    for k in range(24):
        h += term * power
        once += term * power * p / (k + 1)
        twice += term * power * p * p / ((k + 1) * (k + 2))
        term, ahead = ahead, -2.0 * zeta * ahead - term
        power *= p / (k + 1)
    return h, 1.0 - once - 2.0 * zeta * h, once, twice


@njit(cache=KEPT, error_model="numpy", nogil=True)
def peaks(a, dt, omega, zeta, peak, at):
    """Largest pseudo-acceleration of damped oscillators under the linearly interpolated record.

    u'' + 2 zeta omega u' + omega^2 u = -a(t) from rest, exact at the samples (Nigam and Jennings,
    Bull. Seism. Soc. Am. 59 (1969) 909-922), in y = omega^2 u and z = omega u' so that every
    quantity is an acceleration. Peaks between two samples are those of the cubic with the values y
    and the slopes z of both. Of steps longer than one radian only the ends are looked at.

    Parameters
    ----------
    omega : array, shape (m,)
        Circular frequencies [rad/s], finite.
    zeta : float
        Fraction of critical damping, in [0, 1).
    peak, at : array, shape (m,)
        Filled with the signed omega^2 u at the largest |u| [m/s2], and with the sample where it is,
        at the end of its step.
    """
    m = omega.size
    c = np.empty((7, m))
    radians = omega * dt
    # Over a longer step the cubic would invent peaks; without slopes it is monotonic.
    radians[radians > 1.0] = 0.0
    for k in range(m):
        p = omega[k] * dt
        h, slope, once, twice = _step(p, zeta)
        over_p = 1.0 / p if p > 0.0 else 0.0
        c[0, k], c[1, k], c[2, k] = 1.0 - once, h, slope
        c[3, k], c[4, k] = once - twice * over_p, twice * over_p
        c[5, k], c[6, k] = h - once * over_p, once * over_p
        peak[k], at[k] = 0.0, 0
    y, z = np.zeros(m), np.zeros(m)
    # The inner loop is over oscillators, which are independent, so the processor vectorizes it.
    for i in range(1, a.size):
        before, now = a[i - 1], a[i]
        for k in range(m):
            moved = c[0, k] * y[k] + c[1, k] * z[k] - c[3, k] * before - c[4, k] * now
            turned = c[2, k] * z[k] - c[1, k] * y[k] - c[5, k] * before - c[6, k] * now
            # The cubic start + s (first + s (bend + s twist)); its slope is zero at two places s.
            start, rise, first, last = y[k], moved - y[k], radians[k] * z[k], radians[k] * turned
            bend, twist = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
            root = math.sqrt(max(bend * bend - 3.0 * twist * first, 0.0))
            q = -bend - math.copysign(root, bend)
            one = q / (3.0 * twist) if twist != 0.0 else 1.0
            other = first / q if q != 0.0 else 1.0
            one = one if 0.0 < one < 1.0 else 1.0
            other = other if 0.0 < other < 1.0 else 1.0
            top = start + one * (first + one * (bend + one * twist))
            second = start + other * (first + other * (bend + other * twist))
            top = second if abs(second) > abs(top) else top
            top = moved if abs(moved) > abs(top) else top
            y[k], z[k] = moved, turned
            higher = abs(top) > abs(peak[k])
            peak[k] = top if higher else peak[k]
            at[k] = i if higher else at[k]


@njit(cache=KEPT)
def histories(a, dt, omega, zeta, out):
    """Absolute acceleration of damped oscillators under the linearly interpolated record.

    The recursion of `peaks`, from rest; u'' + a = -(y + 2 zeta z) at every sample.

    Parameters
    ----------
    omega, zeta : array, shape (m,)
        Circular frequencies [rad/s], finite, and fractions of critical damping, in [0, 1).
    out : array, shape (n, m)
        Filled with absolute accelerations [m/s2], one row per sample.
    """
    m = omega.size
    c = np.empty((7, m))
    for k in range(m):
        p = omega[k] * dt
        h, slope, once, twice = _step(p, zeta[k])
        over_p = 1.0 / p if p > 0.0 else 0.0
        c[0, k], c[1, k], c[2, k] = 1.0 - once, h, slope
        c[3, k], c[4, k] = once - twice * over_p, twice * over_p
        c[5, k], c[6, k] = h - once * over_p, once * over_p
    y, z = np.zeros(m), np.zeros(m)
    out[0, :] = 0.0
    for i in range(1, a.size):
        before, now = a[i - 1], a[i]
        for k in range(m):
            moved = c[0, k] * y[k] + c[1, k] * z[k] - c[3, k] * before - c[4, k] * now
            z[k] = c[2, k] * z[k] - c[1, k] * y[k] - c[5, k] * before - c[6, k] * now
            y[k] = moved
            out[i, k] = -moved - 2.0 * zeta[k] * z[k]
