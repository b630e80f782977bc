"""Every jitted function: plain functions of floats and arrays.

Never raises, never allocates for its caller, knows no units but SI; numpy and numba only.
Read `solver.solve` for what the numbers mean and `solver.motion` for spectra.

Letters, as in the paper (Predicted Slip of Ballasted Solar Arrays, Eqs. 1-19):
    x, z     horizontal (right) and vertical (up) acceleration of the plane     [m/s2]
    g        acceleration of gravity                                            [m/s2]
    sn, cs   sine and cosine of the roof slope theta, positive down to the right
    mu       friction coefficient, static and kinetic
    s, w     distance slid down the slope [m]; speed in the direction of sliding, >= 0 [m/s]
    sigma    direction of sliding: +1 down the slope, -1 up, 0 at rest
    q, r     acceleration in the direction of sliding [m/s2] and its rate in an interval [m/s3]
    dt, tau  sampling interval and time since the interval began                [s]
"""

import math

import numpy as np
from numba import njit

# Kinds of event in the `events` array.
SLIP = 1.0
STOP = 0.0

TINY = 2.3e-308


@njit(cache=True, inline="always")
def _vertical(az, i):
    """Vertical acceleration at sample i; an empty record means none."""
    return az[i] if az.size > 0 else 0.0


@njit(cache=True)
def least_normal(ax, az, dt, sn, cs, g, scale):
    """Least N / (m g) over the record, and when N first falls below zero (NaN: never).

    N = (g + a_v) cos(theta) + a_h sin(theta), Eq. 6 with the vertical added. N is linear between
    samples, so its minimum is at one of them.
    """
    least = np.inf
    t_uplift = np.nan
    before = 0.0
    for i in range(ax.size):
        normal = cs * (g + scale * _vertical(az, i)) + sn * (scale * ax[i])
        if normal < least:
            if normal < 0.0 and not least < 0.0:
                t_uplift = 0.0 if i == 0 else (i - 1 + before / (before - normal)) * dt
            least = normal
        before = normal
    return least / g, t_uplift


@njit(cache=True, inline="always")
def _first_stop(w, q, r, h):
    """First tau in (0, h] where the speed w + q tau + r tau^2 / 2 is zero, or -1.

    The end value alone is not enough: the speed may touch or cross zero inside and be positive
    again at the end, so the vertex is looked at too.
    """
    ends_moving = w + h * (q + 0.5 * r * h) > 0.0
    dips = r > 0.0 and q < 0.0 and -q < r * h
    discriminant = q * q - 2.0 * r * w
    if ends_moving and not (dips and discriminant >= 0.0):
        return -1.0
    root = math.sqrt(max(discriminant, 0.0))  # a rounding below zero: it touches zero
    # The forms of the quadratic formula without cancellation; unless q < 0, here r < 0.
    tau = 2.0 * w / (root - q) if q < 0.0 else (q + root) / -r
    return min(tau, h)


@njit(cache=True, inline="always")
def _onset(q, r, tau, dt):
    """When a push q + r tau out of rest first becomes positive, in [tau, dt), or dt."""
    if q + r * tau > 0.0:
        return tau
    if r <= 0.0:
        return dt
    return min(max(-q / r, tau), dt)


@njit(cache=True)
def slide_exact(ax, az, dt, sn, cs, mu, g, scale, events, history):
    """Follow the linearly interpolated record exactly, event by event.

    In each interval N and the driving acceleration are linear, so s' is quadratic and s cubic
    between events, and each event is the root of a linear or quadratic polynomial.

    Parameters
    ----------
    events : array, shape (m, 3)
        Filled with time, kind and s of the first m events; shape (0, 3) for none.
    history : array, shape (2, n) or (2, 0)
        Filled with s and s' at the samples.

    Returns
    -------
    tuple
        s at its largest, s at its least, s at the end, s' at the end, time of the largest |s|,
        number of stops, number of events.
    """
    c_down, k_down = sn - mu * cs, cs + mu * sn
    c_up, k_up = -sn - mu * cs, mu * sn - cs
    x = scale * ax[0]
    gz = g + scale * _vertical(az, 0)
    down, up = c_down * gz - k_down * x, c_up * gz - k_up * x
    s = w = s_max = s_min = s_peak = t_peak = 0.0
    sigma = n_stops = n_events = 0
    for i in range(ax.size - 1):
        if history.shape[1] > 0:
            history[0, i], history[1, i] = s, sigma * w
        x = scale * ax[i + 1]
        gz = g + scale * _vertical(az, i + 1)
        down_0, up_0 = down, up
        down, up = c_down * gz - k_down * x, c_up * gz - k_up * x
        # At rest and pushed over at neither end: linear, so nowhere between.
        if sigma == 0 and down <= 0.0 and up <= 0.0 and down_0 <= 0.0 and up_0 <= 0.0:
            continue
        r_down, r_up = (down - down_0) / dt, (up - up_0) / dt
        tau = 0.0
        while tau < dt:
            if sigma == 0:
                t_down, t_up = _onset(down_0, r_down, tau, dt), _onset(up_0, r_up, tau, dt)
                tau = min(t_down, t_up)
                if tau >= dt:
                    break
                sigma = 1 if t_down <= t_up else -1
                if n_events < events.shape[0]:
                    events[n_events, 0], events[n_events, 1] = i * dt + tau, SLIP
                    events[n_events, 2] = s
                n_events += 1
            r = r_down if sigma > 0 else r_up
            q = (down_0 if sigma > 0 else up_0) + r * tau
            if w == 0.0:
                q = max(q, 0.0)  # an onset has no push against it: what is left is rounding
            h = dt - tau
            stop = _first_stop(w, q, r, h) if w > 0.0 or r < 0.0 else -1.0
            step = h if stop < 0.0 else stop
            s += sigma * step * (w + step * (0.5 * q + step * r / 6.0))
            if stop < 0.0:
                w += h * (q + 0.5 * r * h)
                break
            # Where the step is lost in rounding, time must pass all the same.
            tau = tau + step if tau + step > tau else tau * (1.0 + 2.3e-16) + TINY
            if abs(s) > abs(s_peak):
                s_peak, t_peak = s, i * dt + tau
            s_max, s_min = max(s_max, s), min(s_min, s)
            if n_events < events.shape[0]:
                events[n_events, 0], events[n_events, 1] = i * dt + tau, STOP
                events[n_events, 2] = s
            n_events += 1
            n_stops += 1
            sigma, w = 0, 0.0
    t_end = (ax.size - 1) * dt
    if abs(s) > abs(s_peak):
        t_peak = t_end
    s_max, s_min = max(s_max, s), min(s_min, s)
    if history.shape[1] > 0:
        history[0, -1], history[1, -1] = s, sigma * w
    return s_max, s_min, s, sigma * w, t_peak, n_stops, n_events


@njit(cache=True)
def _oscillator_step(p, zeta):
    """What one step p = omega dt of an oscillator is made of: h, h', and h summed once and twice.

    h is the unit impulse response of y'' + 2 zeta y' + y = 0 in the time omega t. The closed forms
    lose up to p^3 of their digits when p is small, so there the Taylor series is summed instead:
    its terms follow h_k+2 = -2 zeta h_k+1 - h_k.
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


@njit(cache=True)
def oscillator_peaks(a, dt, omega, zeta, peak, at):
    """Largest pseudo-acceleration of damped oscillators under the linearly interpolated record.

    u'' + 2 zeta omega u' + omega^2 u = -a(t) from rest, exact at the samples (Nigam and Jennings,
    Bull. Seism. Soc. Am. 59 (1969) 909-922), in y = omega^2 u and z = omega u' so that every
    quantity is an acceleration.

    Parameters
    ----------
    omega : array, shape (m,)
        Circular frequencies [rad/s], finite.
    zeta : float
        Fraction of critical damping, in [0, 1).
    peak, at : array, shape (m,)
        Filled with omega^2 u, with its sign, where |u| is largest, and with the sample where.
    """
    m = omega.size
    c = np.empty((7, m))
    for k in range(m):
        p = omega[k] * dt
        h, slope, once, twice = _oscillator_step(p, zeta)
        over_p = 1.0 / p if p > 0.0 else 0.0
        c[0, k], c[1, k], c[2, k] = 1.0 - once, h, slope
        c[3, k], c[4, k] = once - twice * over_p, twice * over_p
        c[5, k], c[6, k] = h - once * over_p, once * over_p
        peak[k], at[k] = 0.0, 0
    y, z = np.zeros(m), np.zeros(m)
    # Oscillators inside, samples outside: neighbours are independent, so they run abreast.
    for i in range(1, a.size):
        before, now = a[i - 1], a[i]
        for k in range(m):
            moved = c[0, k] * y[k] + c[1, k] * z[k] - c[3, k] * before - c[4, k] * now
            z[k] = c[2, k] * z[k] - c[1, k] * y[k] - c[5, k] * before - c[6, k] * now
            y[k] = moved
            higher = abs(moved) > abs(peak[k])
            peak[k] = moved if higher else peak[k]
            at[k] = i if higher else at[k]
