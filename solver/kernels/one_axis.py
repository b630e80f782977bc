"""The exact one-axis solver, jitted: the linearly interpolated record, event by event.

    ax = 0, 4, -4, 0, 0, 0 m/s2 at 0.1 s, flat roof, mu = 0.2
    slip upslope at 0.0490 s, stop at 0.1696 s, s = -4.94 mm
    slip downslope at 0.1745 s, stop at 0.3152 s, s = +1.63 mm

Never raises, knows no units but SI; numpy and numba only. Read `slide_exact`;
`solver.sliding.checked` explains the results. `docs/method.md` solves the block in a few lines of
plain Python, and `tests/oracle.py` by other algebra to 40 digits.

Letters, as in the paper (Predicted Slip of Ballasted Solar Arrays, Eqs. 1-19):
    ax, az   horizontal (right) and vertical (up) acceleration of the plane     [m/s2]
    x, z     bounds of ax and of az over blocks of samples                      [m/s2]
    g        acceleration of gravity                                            [m/s2]
    scale    factor on ax and az (`solver.model.Accelerations`)
    sn, cs   sine and cosine of the roof slope theta, positive down to the right
    mu       friction coefficient, static and kinetic
    s, w     distance slid downslope [m]; speed in the direction of sliding, >= 0 [m/s]
    sigma    direction of sliding: +1 downslope, -1 upslope, 0 at rest
    q, r     acceleration in the direction of sliding [m/s2] and its rate in an interval [m/s3]
    dt, tau  sampling interval and time since the interval began                [s]
"""

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT

# Kinds of event in the `events` array.
DOWN = 1.0
UP = -1.0
STOP = 0.0

# Just above the smallest normal float: a divisor that is never zero, a time that advances.
TINY = 2.3e-308
SIXTH = 1.0 / 6.0
EPS = 2.0**-52
# Some units of rounding: within it of the band the push itself decides, not its bound.
MARGIN = 1e-15

# Samples in a block, and blocks in a block of blocks.
SHIFT = 4
BLOCK = 1 << SHIFT

# Samples over which a gain in speed is summed separately.
CHUNK = 64

# Indices are np.uintp in inner loops: numba tests any other type for negative values first.


@njit(cache=KEPT)
def bounds(a):
    """Least and greatest sample over blocks of BLOCK, over blocks of BLOCK blocks, and over all.

    Rounding is monotone, so what is computed from a bound bounds what is computed from a sample, to
    the last bit: skipping a block of samples changes no result.
    """
    fine = (a.size + BLOCK - 1) >> SHIFT
    coarse = (fine + BLOCK - 1) >> SHIFT
    extremes = np.empty((2, fine + coarse + 1))
    extremes[0], extremes[1] = np.inf, -np.inf
    for block in range(fine):
        least, greatest = np.inf, -np.inf
        for i in range(block << SHIFT, min((block + 1) << SHIFT, a.size)):
            least, greatest = min(least, a[i]), max(greatest, a[i])
        extremes[0, block], extremes[1, block] = least, greatest
    for block in range(fine):
        for above in (fine + (block >> SHIFT), fine + coarse):
            extremes[0, above] = min(extremes[0, above], extremes[0, block])
            extremes[1, above] = max(extremes[1, above], extremes[1, block])
    return extremes


@njit(cache=KEPT, forceinline=True)
def _net_driving(c, ax, az, i):
    """Acceleration in one direction at sample i; c holds the coefficients of 1, az and -ax."""
    if az is None:
        return c[0] - c[2] * ax[np.uintp(i)]
    return c[0] + c[1] * az[np.uintp(i)] - c[2] * ax[np.uintp(i)]


@njit(cache=KEPT, forceinline=True)
def _maximum_net_driving(c, x, z, block):
    """Upper bound of `_net_driving` over a block of samples."""
    across = min(c[2] * x[0, np.uintp(block)], c[2] * x[1, np.uintp(block)])
    if z is None:
        return c[0] - across
    return c[0] + max(c[1] * z[0, np.uintp(block)], c[1] * z[1, np.uintp(block)]) - across


@njit(cache=KEPT)
def minimum_normal(ax, az, x, z, dt, sn, cs, g, scale):
    """Least N / (m g) over the record, and when N first falls below zero (NaN: never).

    N = (g + az) cos(theta) + ax sin(theta), Eq. 6 with the vertical added. N is linear between
    samples, so its minimum is at a sample.
    """
    # -N / m in the form of `_net_driving`: -(g + az) cos(theta) - ax sin(theta).
    c = (-cs * g, -cs * scale, sn * scale)
    # Without a vertical this bound is the largest itself, of one sample. With one, the extremes of
    # ax and az may be of two.
    most = _maximum_net_driving(c, x, z, x.shape[1] - 1)
    if az is not None:
        most = -np.inf
        for block in range((ax.size + BLOCK - 1) // BLOCK):
            if _maximum_net_driving(c, x, z, block) > most:
                for i in range(block * BLOCK, min((block + 1) * BLOCK, ax.size)):
                    most = max(most, _net_driving(c, ax, az, i))
    if most <= 0.0:
        return -most / g, np.nan
    first = np.int64(0)  # as in `slide_exact`
    while _net_driving(c, ax, az, first) <= 0.0:
        first += 1
    if first == 0:
        return -most / g, 0.0
    # -N is linear between these samples: it is zero at before / (before - after) of the interval.
    before, after = _net_driving(c, ax, az, first - 1), _net_driving(c, ax, az, first)
    return -most / g, (first - 1 + before / (before - after)) * dt


@njit(cache=KEPT, forceinline=True)
def _resting_band(down, up):
    """Range of ax without slip, for a record without vertical; reduced by a few rounding errors."""
    low, high = -np.inf, np.inf
    for c in (down, up):
        if c[2] > 0.0:
            low = max(low, c[0] / c[2] + MARGIN * abs(c[0] / c[2]))
        elif c[2] < 0.0:
            high = min(high, c[0] / c[2] - MARGIN * abs(c[0] / c[2]))
        elif c[0] > 0.0:
            # No ax holds the block: the band is empty.
            low = np.inf
    return low, high


@njit(cache=KEPT, forceinline=True)
def _is_quiet(down, up, band, x, z, block):
    """Whether no sample of a block of samples can make the resting block slip."""
    if z is None:
        return x[0, np.uintp(block)] >= band[0] and x[1, np.uintp(block)] <= band[1]
    return (
        _maximum_net_driving(down, x, z, block) <= 0.0
        and _maximum_net_driving(up, x, z, block) <= 0.0
    )


@njit(cache=KEPT, forceinline=True)
def _next_slip(down, up, band, ax, az, x, z, i):
    """First sample from i on at which the resting block slips, or n."""
    n = ax.size
    fine = (n + BLOCK - 1) >> SHIFT
    # The last column of the bounds is that of the whole record, no block.
    far_end = x.shape[1] - 1
    while i < n:
        if i & (BLOCK - 1) == 0:
            block = i >> SHIFT
            if block & (BLOCK - 1) == 0:
                far = fine + (block >> SHIFT)
                while far < far_end and _is_quiet(down, up, band, x, z, far):
                    far += 1
                block = (far - fine) << SHIFT
            # Not beyond this block of blocks: the next may be passed over whole.
            end = min(((block >> SHIFT) + 1) << SHIFT, fine)
            while block < end and _is_quiet(down, up, band, x, z, block):
                block += 1
            i = block << SHIFT
            if block == end:
                continue
        end = min(((i >> SHIFT) + 1) << SHIFT, n)
        while i < end:
            # Without a vertical the band tells; a push is computed only beyond it.
            beyond = az is not None or ax[np.uintp(i)] < band[0] or ax[np.uintp(i)] > band[1]
            if beyond and (
                _net_driving(down, ax, az, i) > 0.0 or _net_driving(up, ax, az, i) > 0.0
            ):
                return i
            i += 1
    return n


@njit(cache=KEPT, forceinline=True)
def _first_stop(w, q, r, h):
    """First tau in (0, h] where the speed w + q tau + r tau^2 / 2 is zero, or -1."""
    ends_moving = w + h * (q + 0.5 * r * h) > 0.0
    # The value at the end is not sufficient: the speed may touch or cross zero inside and be
    # positive again at the end, so the vertex is checked as well.
    dips = r > 0.0 and q < 0.0 and -q < r * h
    discriminant = q * q - 2.0 * r * w
    if ends_moving and not (dips and discriminant >= 0.0):
        return -1.0
    # w + q tau + r tau^2 / 2 = 0: tau = (-q +- sqrt(q^2 - 2 r w)) / r.
    root = math.sqrt(max(discriminant, 0.0))  # negative by rounding error only: it touches zero
    # The forms of the quadratic formula without cancellation; if q >= 0, then r < 0 here.
    tau = 2.0 * w / (root - q) if q < 0.0 else (q + root) / -r
    return min(tau, h)


@njit(cache=KEPT, forceinline=True)
def _onset(q_0, q_1, tau, dt):
    """Time in [tau, dt) when a push linear from q_0 to q_1 becomes positive; dt for never."""
    if q_0 <= 0.0 and q_1 <= 0.0:
        return dt
    # q_0 + (q_1 - q_0) tau / dt = 0
    if q_0 <= 0.0 and q_1 > 0.0:
        # A block that stopped after that zero is pushed at once.
        return max(dt * (q_0 / (q_0 - q_1)), tau)
    r = (q_1 - q_0) / dt
    # Positive at the begin: it pushes now, or has passed its zero before tau.
    return tau if q_0 + r * tau > 0.0 else dt


@njit(cache=KEPT, forceinline=True)
def _move(w, q_0, q_1, tau, dt, rate):
    """Slide from tau to the interval's end or a stop; time, distance, speed, peak between."""
    r = (q_1 - q_0) * rate
    q, h = q_0 + r * tau, dt - tau
    if w == 0.0:
        q = max(q, 0.0)  # at an onset the push is not negative, except for rounding error
    # 0 if the speed is largest at an end.
    peak = w - 0.5 * q * q / r if q > 0.0 > q + r * h else 0.0
    # From rest, a push that does not fall lets nothing stop.
    step = _first_stop(w, q, r, h) if w > 0.0 or r < 0.0 else -1.0
    if step < 0.0:
        return dt, h * (w + h * (0.5 * q + h * (r * SIXTH))), w + h * (q + 0.5 * r * h), peak
    # Time must advance even if the step is smaller than the rounding error of tau.
    # 2.3e-16 is just above EPS, so that the product is a larger float.
    reached = tau + step if tau + step > tau else tau * (1.0 + 2.3e-16) + TINY
    return reached, step * (w + step * (0.5 * q + step * (r * SIXTH))), 0.0, peak


@njit(cache=KEPT, forceinline=True)
def _slide_on(c, ax, az, w, w_max, i, last, dt):
    """Slide up to the first interval with a possible stop; sample, distance, speed, w_max."""
    # If the speed is positive at the end of an interval, and would be at its middle under the first
    # push alone, it does not reach zero in the interval.
    half = 0.5 * dt
    c = (c[0] * half, c[1] * half, c[2] * half)  # q dt / 2 from here on
    q = _net_driving(c, ax, az, i)
    way = 0.0
    while i < last:
        # The gain in speed is summed from zero every CHUNK samples, to keep its low-order digits.
        q_first, gained, total, end = q, 0.0, 0.0, min(i + CHUNK, last)
        # `top` is the gain in speed beyond which the largest speed so far is exceeded.
        start, top = i, w_max - w
        while i < end:
            q_next = _net_driving(c, ax, az, i + 1)
            middle = gained + q
            more = gained + (q + q_next)  # not middle + q_next, which would wait for one more sum
            if min(middle, more) <= -w:
                break
            # `middle` bounds the gain while the push falls to zero; it is rarely above the largest.
            if middle > top:
                rises, falls = max(q, 0.0), max(q - q_next, TINY)  # q > 0, except for rounding
                top = max(top, more if q_next > 0.0 else gained + rises * rises / falls)
            total += gained
            gained, q = more, q_next
            i += 1
        # The sum of the cubic distances telescopes: dt (sum of w + half its change) + dt^2 / 12 (q
        # first - q last).
        way += dt * ((i - start) * w + (total + 0.5 * gained) + (q_first - q) * SIXTH)
        w_max = max(w_max, w + top)
        w += gained
        if i < end:
            break
    return i, way, w, w_max


@njit(cache=KEPT, forceinline=True)
def _note(events, n, t, kind, s):
    """Write event n and return the number of events; no rounding puts it before the last one."""
    if events is not None:
        t = max(t, events[n - 1, 0]) if n else t
        events[n, 0], events[n, 1], events[n, 2] = t, kind, s
    return n + 1


@njit(cache=KEPT)
def slide_exact(ax, az, x, z, dt, sn, cs, mu, g, scale, events):
    """Solve the motion under the linearly interpolated record exactly, event by event.

    In each interval N and the driving acceleration are linear, so s' is quadratic and s cubic
    between events, and each event is the root of a linear or quadratic polynomial. At rest, blocks
    of samples that cannot cause slip are skipped.

    Returns s at its largest, s at its least, s at the end, s' at the end, time of the largest |s|,
    number of stops, largest |s'|, number of events. `events`, shape (m, 3), or None, is filled with
    their time, kind and s: m must be at least their number, two for each stop, and one for a slip
    without a stop.
    """
    # az and z are None for no vertical shaking: another version is compiled for it.
    # Eqs. 12-18 along the slope: s'' = G - mu N sign(s') while sliding, with
    #     N = (g + az) cos(theta) + ax sin(theta),   G = (g + az) sin(theta) - ax cos(theta).
    # In the direction of motion, sigma = +1 down and -1 up, that is sigma s'' = sigma G - mu N:
    #     (g + az) (sigma sin(theta) - mu cos(theta)) - ax (sigma cos(theta) + mu sin(theta)),
    # whose coefficients of 1, az and -ax are the three numbers of `down` and of `up`.
    c_down, c_up = sn - mu * cs, -sn - mu * cs
    down = (c_down * g, c_down * scale, (cs + mu * sn) * scale)
    up = (c_up * g, c_up * scale, (mu * sn - cs) * scale)
    c, sigma, band = down, DOWN, _resting_band(down, up)
    s = w = s_max = s_min = t_max = t_min = w_max = 0.0
    # np.int64, because for a literal numba would compile a second version of what takes it.
    i, n_events = np.int64(0), np.int64(0)
    n_stops = 0
    last, rate = ax.size - 1, 1.0 / dt
    while i < last:
        # At rest at sample i: go to the interval in which slip begins.
        first = _next_slip(down, up, band, ax, az, x, z, i)
        if first > last:
            break
        tau = 0.0
        if first > i:
            # The push increases from q_0 <= 0 to q_1 > 0: no stop in the remaining time h.
            c, sigma = (down, DOWN) if _net_driving(down, ax, az, first) > 0.0 else (up, UP)
            q_0, q_1 = _net_driving(c, ax, az, first - 1), _net_driving(c, ax, az, first)
            # From the onset, where q = 0, to the sample: w = q_1 h / 2, s = q_1 h^2 / 6.
            h = dt * (q_1 / (q_1 - q_0))
            n_events = _note(events, n_events, first * dt - h, sigma, s)
            s += sigma * (q_1 * h * h * SIXTH)
            w, i = 0.5 * q_1 * h, first
        while i < last:
            if w > 0.0:
                i, way, w, w_max = _slide_on(c, ax, az, w, max(w_max, w), i, last, dt)
                s += sigma * way
                if i == last:
                    break
                q_0, q_1 = _net_driving(c, ax, az, i), _net_driving(c, ax, az, i + 1)
            else:
                q_0, q_1 = _net_driving(down, ax, az, i), _net_driving(down, ax, az, i + 1)
                u_0, u_1 = _net_driving(up, ax, az, i), _net_driving(up, ax, az, i + 1)
                t_down, t_up = _onset(q_0, q_1, tau, dt), _onset(u_0, u_1, tau, dt)
                tau, c, sigma = t_down, down, DOWN
                if t_up < t_down:
                    tau, c, sigma, q_0, q_1 = t_up, up, UP, u_0, u_1
                if tau >= dt:
                    i += 1
                    break  # at rest to the end of the interval
                n_events = _note(events, n_events, i * dt + tau, sigma, s)
            tau, way, w, peak = _move(w, q_0, q_1, tau, dt, rate)
            s, w_max = s + sigma * way, max(w_max, peak, w)
            if w > 0.0:
                i, tau = i + 1, 0.0
            else:
                t = i * dt + tau
                t_max, t_min = t if s > s_max else t_max, t if s < s_min else t_min
                s_max, s_min = max(s_max, s), min(s_min, s)
                n_stops += 1
                n_events = _note(events, n_events, t, STOP, s)
    t_max, t_min = last * dt if s > s_max else t_max, last * dt if s < s_min else t_min
    s_max, s_min = max(s_max, s), min(s_min, s)
    # A peak of |s| is a stop or the end: s is monotone between, so no other sample is looked at.
    t_peak = t_max if s_max >= -s_min else t_min
    return s_max, s_min, s, sigma * w, t_peak, n_stops, max(w_max, w), n_events


@njit(cache=KEPT)
def fill_history(ax, az, dt, sn, cs, mu, g, scale, events, history):
    """Fill `history`, shape (2, n), with s and s' at the samples, from all events of the run."""
    history[:] = 0.0
    # Slips and stops alternate; the last slip may have no stop.
    for k in range(0, events.shape[0], 2):
        t, sigma, s = events[k, 0], events[k, 1], events[k, 2]
        ends = k + 1 < events.shape[0]
        t_stop = events[k + 1, 0] if ends else np.inf
        # s'' itself here, not sigma s'': G - sigma mu N by powers of 1, az and -ax.
        c = (
            (sn - sigma * mu * cs) * g,
            (sn - sigma * mu * cs) * scale,
            (cs + sigma * mu * sn) * scale,
        )
        w, before, i = 0.0, t, int(t / dt) + 1
        while i < ax.size and i * dt < t_stop:
            q_0, q_1 = _net_driving(c, ax, az, i - 1), _net_driving(c, ax, az, i)
            r = (q_1 - q_0) / dt
            h = i * dt - before
            q = q_1 - r * h
            s += h * (w + h * (0.5 * q + h * (r * SIXTH)))
            w += h * (q + 0.5 * r * h)
            history[0, i], history[1, i] = s, w
            before = i * dt
            i += 1
        if ends:
            # To the end: a later slip overwrites what follows its onset.
            history[0, i:] = events[k + 1, 2]


@njit(cache=KEPT)
def rounding(x, z, dt, sn, cs, mu, g, scale, n):
    """Allowance for rounding error in a displacement of `slide_exact` over n samples [m].

    The drive and friction are computed to 4 units in the last place of their terms. Friction is
    monotone, so an error d in the acceleration makes an error of at most d t in velocity after a
    time t, and d t^2 / 2 in displacement. Here t is the whole record, and the result is doubled to
    cover rounding of the sums.
    """
    # The last column of the bounds is that of the whole record: no pass over its samples.
    up = abs(scale) * max(-z[0, -1], z[1, -1], 0.0) if z is not None else 0.0
    along, lasts = abs(scale) * max(-x[0, -1], x[1, -1]), (n - 1) * dt
    terms = (abs(sn) + mu * cs) * (g + up) + (cs + mu * abs(sn)) * along
    return 4.0 * EPS * terms * lasts * lasts


@njit(cache=KEPT)
def slide_checked(ax, az, x, z, dt, slope, mu, g, scale):
    """Run one scene of a slope [rad]; N is looked at first.

    Returns the least N / (m g), the cosine of the slope, `rounding`, and the first seven of
    `slide_exact`, which mean nothing if N falls below zero.
    """
    sn, cs = math.sin(slope), math.cos(slope)
    least, _ = minimum_normal(ax, az, x, z, dt, sn, cs, g, scale)
    if least < 0.0:
        return least, cs, np.nan, np.nan, np.nan, np.nan, np.nan, np.nan, 0, np.nan
    error = rounding(x, z, dt, sn, cs, mu, g, scale, ax.size)
    slide = slide_exact(ax, az, x, z, dt, sn, cs, mu, g, scale, None)
    return least, cs, error, slide[0], slide[1], slide[2], slide[3], slide[4], slide[5], slide[6]


@njit(cache=KEPT, nogil=True)
def sweep_exact(ax, az, x, z, dt, g, scenes, out):
    """Run many scenes under one record on one core; other threads go on.

    Scenes have slope [rad], friction coefficient and scale, shape (m, 3). `out`, shape (m, 4), is
    filled with the largest s, the least s, s and s' at the end; NaN if N falls below zero.
    """
    for k in range(scenes.shape[0]):
        slope, mu, scale = scenes[k]
        run = slide_checked(ax, az, x, z, dt, slope, mu, g, scale)
        out[k, 0], out[k, 1], out[k, 2], out[k, 3] = run[3], run[4], run[5], run[6]
