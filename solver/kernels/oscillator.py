"""Damped oscillators under a linearly interpolated record, jitted: spectra and building modes.

A step of 1 m/s2 gives an oscillator of 5% damping a peak of 1 + exp(-zeta pi / sqrt(1 - zeta^2)) =
1.854 m/s2, whatever its period.

Never raises, knows no units but SI; numpy and numba only. `tests/modal_oracle.py` gives the same
spectra by complex modes.
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT


@njit(cache=KEPT)
def _step(p, zeta):
    """h, h', and h integrated once and twice, over one step p = omega dt of an oscillator."""
    # h is the unit impulse response of y'' + 2 zeta y' + y = 0 in the time omega t. For small p the
    # closed forms lose digits by cancellation, up to a factor of p^3, so the Taylor series is
    # summed instead, with h_k+2 = -2 zeta h_k+1 - h_k.
    if p >= 1.0:
        kappa = math.sqrt(1.0 - zeta * zeta)
        decay = math.exp(-zeta * p)
        h = decay * math.sin(kappa * p) / kappa
        slope = decay * math.cos(kappa * p) - zeta * h
        once = 1.0 - slope - 2.0 * zeta * h
        return h, slope, once, p - h - 2.0 * zeta * once
    h = once = twice = 0.0
    term, ahead, power = 0.0, 1.0, 1.0
    # p is below 1: term 24 is below 1 / 24! = 2e-24 of the first.
    for k in range(24):
        h += term * power
        once += term * power * p / (k + 1)
        twice += term * power * p * p / ((k + 1) * (k + 2))
        term, ahead = ahead, -2.0 * zeta * ahead - term
        power *= p / (k + 1)
    return h, 1.0 - once - 2.0 * zeta * h, once, twice


# Oscillators that are advanced together, on the vector units of the processor.
_LANES = 16


@njit(cache=KEPT, error_model="numpy")
def _top(start, end, first, last):
    """Largest value, with its sign, of the cubic between two values with these slopes."""
    # start + s (first + s (bend + s twist)), s from 0 to 1; its slope is zero at two places.
    rise = end - start
    bend, twist = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
    root = math.sqrt(max(bend * bend - 3.0 * twist * first, 0.0))
    q = -bend - math.copysign(root, bend)
    one = q / (3.0 * twist) if twist != 0.0 else 1.0
    other = first / q if q != 0.0 else 1.0
    top = end
    for s in (one, other):
        if 0.0 < s < 1.0:
            value = start + s * (first + s * (bend + s * twist))
            top = value if abs(value) > abs(top) else top
    return top


@njit(cache=KEPT, error_model="numpy", nogil=True)
def _advance(w, before, now):
    """Advance the oscillators of the buffer w by one step; return how many may have a new peak."""
    # Parts of w: seven coefficients, a third of the step in radians, the largest |y| so far, then y
    # and z now and one step before. One array, because the check whether several overlap takes
    # longer than the step.
    higher = 0
    for k in range(_LANES):
        c0, c1, c2 = w[k], w[_LANES + k], w[2 * _LANES + k]
        c3, c4 = w[3 * _LANES + k], w[4 * _LANES + k]
        c5, c6 = w[5 * _LANES + k], w[6 * _LANES + k]
        third, largest = w[7 * _LANES + k], w[8 * _LANES + k]
        y, z = w[9 * _LANES + k], w[10 * _LANES + k]
        # With h, h', once and twice of `_step`, under a line from `before` to `now`:
        # y <- (1 - once) y + h z - (once - twice / p) before - (twice / p) now
        # z <- h' z - h y - (h - once / p) before - (once / p) now
        moved = (c0 * y + c1 * z) - (c3 * before + c4 * now)
        turned = (c2 * z - c1 * y) - (c5 * before + c6 * now)
        w[9 * _LANES + k], w[10 * _LANES + k] = moved, turned
        w[11 * _LANES + k], w[12 * _LANES + k] = y, z
        # A cubic lies within its Bezier points: its ends, and a third of the slope beside them.
        higher += abs(moved) + third * abs(turned) > largest
    return higher


@njit(cache=KEPT, error_model="numpy", nogil=True)
def peaks(a, dt, omega, zeta, peak, at):
    """Largest pseudo-acceleration of damped oscillators under the linearly interpolated record.

    u'' + 2 zeta omega u' + omega^2 u = -a(t) from rest, exact at the samples (Nigam and Jennings,
    Bull. Seism. Soc. Am. 59 (1969) 909-922), in y = omega^2 u and z = omega u' so that every
    quantity is an acceleration. Peaks between two samples are those of the cubic with the values y
    and the slopes z of both. For steps longer than one radian, only the ends are evaluated.

    omega [rad/s] is finite, shape (m,), zeta in [0, 1). `peak` and `at` are filled with the signed
    omega^2 u at the largest |u| [m/s2], and with the sample where it is, at the end of its step.
    """
    w = np.empty(13 * _LANES)
    parts = w.reshape(13, _LANES)
    for first in range(0, omega.size, _LANES):
        count = min(_LANES, omega.size - first)
        w[:] = 0.0
        for k in range(count):
            p = omega[first + k] * dt
            h, slope, once, twice = _step(p, zeta)
            # The seven coefficients of `_advance`; of p = 0 all that multiply the record are zero.
            over_p = 1.0 / p if p > 0.0 else 0.0
            parts[0, k], parts[1, k], parts[2, k] = 1.0 - once, h, slope
            parts[3, k], parts[4, k] = once - twice * over_p, twice * over_p
            parts[5, k], parts[6, k] = h - once * over_p, once * over_p
            # Over a longer step the cubic would invent peaks; without slopes it is monotonic.
            parts[7, k] = p / 3.0 if p <= 1.0 else 0.0
            peak[first + k], at[first + k] = 0.0, 0
        higher_before = 0
        for i in range(1, a.size):
            higher = _advance(w, a[i - 1], a[i])
            if higher_before + higher > 0:
                for k in range(count):
                    third, largest = parts[7, k], parts[8, k]
                    y, z, y_before, z_before = parts[9, k], parts[10, k], parts[11, k], parts[12, k]
                    bound = max(abs(y) + third * abs(z), abs(y_before) + third * abs(z_before))
                    if bound > largest:
                        top = _top(y_before, y, 3.0 * third * z_before, 3.0 * third * z)
                        if abs(top) > largest:
                            parts[8, k], peak[first + k], at[first + k] = abs(top), top, i
            higher_before = higher


@njit(cache=KEPT, error_model="numpy", nogil=True)
def crests(a, dt, omega, zeta, above):
    """Crests of the responses of `peaks` at samples that exceed the limit of each [m/s2].

    Returns oscillators, samples, and signed pseudo-accelerations [m/s2], shape (q,) each.
    """
    which, where, values = [0][:0], [0][:0], [0.0][:0]
    for k in range(omega.size):
        p = omega[k] * dt
        h, slope, once, twice = _step(p, zeta)
        y_before = y = z = 0.0
        for i in range(1, a.size):
            by_before, by_now = once - twice / p, twice / p
            moved = (1.0 - once) * y + h * z - by_before * a[i - 1] - by_now * a[i]
            z = slope * z - h * y - (h - once / p) * a[i - 1] - once / p * a[i]
            # A crest is told at the sample after it, so the index is that of the sample before.
            if abs(y) > above[k] and abs(y_before) <= abs(y) > abs(moved):
                which.append(k)
                where.append(i - 1)
                values.append(y)
            y_before, y = y, moved
    return np.array(which), np.array(where), np.array(values)


@njit(cache=KEPT, error_model="numpy", nogil=True)
def reversed_pulses(radians, zeta, at, least, out):
    """Responses to a unit triangular pulse at each sample, of oscillators at one sample each.

    The triangle is the second difference of a ramp, whose response has a closed form; from the
    second sample on it is a decaying exponential, which the response to a pulse is too.

    Of omega dt and the sample of each oscillator, shape (m,), and the decay at which a response
    ends. Fills the zeros of `out`, shape (m, n), with pseudo-accelerations in units of the pulse,
    and returns the first samples that are filled, shape (m,).
    """
    kappa = math.sqrt(1.0 - zeta * zeta)
    begin = np.empty_like(at)
    for j in range(radians.size):
        p, k = radians[j], at[j]
        rate = p * complex(-zeta, kappa)
        turn = np.exp(rate)
        # A unit ramp in w = omega t has the response w - 2 zeta + Re(c exp((-zeta + i kappa) w)),
        # c = 2 zeta + i (1 - 2 zeta^2) / kappa. In its second difference the line vanishes, and the
        # exponential takes the factor turn - 2 + 1 / turn.
        value = complex(2.0 * zeta, (1.0 - 2.0 * zeta * zeta) / kappa) / p
        value *= (2.0 - turn - 1.0 / turn) * turn
        # exp(-zeta p n) = least
        begin[j] = max(0, k - int(-math.log(least) / (zeta * p)) - 1)
        out[j, k] = -_step(p, zeta)[3] / p
        for i in range(k - 1, begin[j] - 1, -1):
            out[j, i] = value.real
            value *= turn
    return begin


@njit(cache=KEPT)
def histories(a, dt, omega, zeta, out):
    """Absolute acceleration of damped oscillators under the linearly interpolated record.

    The recursion of `peaks`, from rest; u'' + a = -(y + 2 zeta z) at every sample, which fills
    `out`, shape (n, m) [m/s2]. omega [rad/s], finite, and zeta, in [0, 1), have the shape (m,).
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
            # u'' + a = -(omega^2 u + 2 zeta omega u')
            out[i, k] = -moved - 2.0 * zeta[k] * z[k]
