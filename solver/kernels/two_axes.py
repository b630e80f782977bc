"""A block that slides down and across a shaken roof, jitted: power series from event to event.

Never raises, knows no units but SI; numpy and numba only. Read `slide_plane`, then `_sliding` and
`_creeping`; `solver.sliding.two_axes` says what the numbers mean.

The model, for each unit of mass, in roof axes (down the slope, across it):
    N = (g + az) cos(theta) + ax sin(theta)                       normal force, Eq. 6 with az
    G = ((g + az) sin(theta) - ax cos(theta), -ay)                drive
    v' = G - mu N v / |v|  while sliding;  rests while |G| <= mu N
G and N are linear between samples. So is everything on the right but the direction e = v / |v|, and
v, e and w = |v| follow from each other, coefficient by coefficient:
    v' = G - q e     w' = G . e - q     w e = v                   q = mu N
The series of v converges up to about w / |v'|, the time that a stop would take. It has axes of its
own: along the motion or the drive, and across, a quarter turn to the left.

Letters:
    ax, ay, az  acceleration of the plane: horizontal (right), across, vertical (up)      [m/s2]
    x, y, z     `kernels.bounds` of ax, ay and az
    g, sn, cs   acceleration of gravity; sine and cosine of theta, positive down to the right
    sx, sy      distance slid down the slope and across it; in plan (sx cos(theta), sy)   [m]
    vx, vy, w   their rates and the speed                                                 [m/s]
    gx, gy, c   G, and mu N (or N, where a law gives mu)                                  [m/s2]
    hx, hy, d   the same at the end of an interval                                        [m/s2]
    rx, ry, rc  what they gain in a second, or in the unit of a series         [m/s3] or [m/s2]
    ux, uy      direction of the axis along, a unit vector; ga, gs, ra, rs: G and its gain along and
                across
    p, q        weights of 1, az and ax in gx and in c; p[3] is that of ay in gy
    span, part  length of the series' unit of time [s]; how much of it a step takes
    b           series: rows VA and VS of v, EA and ES of e, along and across, W, Q and E (of a law,
                or of what turns) of coefficients of (time / span)^k; SHARE of 1 / (k + 1)
    swell       exponent that a law may gain in a step, or in the speed that is left
    law         None, or mu_fast, mu_fast - mu_slow, rate [s/m] and mu_rest (`slide_plane`)
    top         largest distance in plan, its time; largest and least sx; largest and least sy
"""

import math
from functools import partial

import numpy as np
from numba import njit

# A number divided by zero is infinite, as in all arithmetic of the processor: no test, no raising.
jit = partial(njit, error_model="numpy")

# How a run ends.
FOLLOWED = 0
TOO_MANY_STEPS = 1
NOT_FINITE = 2

# Kinds of event.
SLIP = 1.0
STOP = 0.0

ORDER = 20
CREEP_ORDER = 12
VA, VS, EA, ES, W, Q, E, SHARE, ROOTS = range(9)

# Samples in a block of `kernels.bounds`.
SHIFT = 4

LEAST_TOLERANCE = 1e-14
"""Tolerance of a step below which rounding is larger."""

EPS = 2.0**-52

ROUNDING = 4.0 * EPS
"""Rounding of drive and friction, by the sum of the terms that each is made of."""

DEAD = 8.0 * EPS
"""Push on a resting block that rounding alone may make, by the same terms."""

SMALL = 1e-6
"""A micrometer [m]: the tolerance is relative to the largest distance, or to this."""

CLOSE = 3.0
"""Error in place that closing a stop may make, by tolerance and largest distance."""

SLACK = 16.0
"""Error in speed that a step may make, by tolerance, before it is taken shorter."""

SWEEPS = 12

SCAN = 8
"""Places of a series at which its sign is looked at."""

SWELL = 5.0
"""Exponent that a law of friction may gain in a step: its terms fall from there on."""

SETTLES = 2.0
"""Times that a slow block may come to the speed of its push in a step, by a law of friction."""

FADED = 40.0
"""Exponent from which on a law of friction has come to its fast coefficient, but for rounding."""

STIFF = 300.0
"""Times that the direction would settle in a step, from which on `_creeping` is worth a try."""


@jit()
def _friction(k, b, c, rc, law):
    """Coefficient k of q. With a law mu = mu_fast - drop exp(-rate w), by E' = -rate w' E."""
    if law is None:
        b[Q, k] = c if k == 0 else (rc if k == 1 else 0.0)
    elif k == 0:
        b[E, 0] = law[1] * math.exp(-law[2] * b[W, 0])
        b[Q, 0] = c * (law[0] - b[E, 0])
    else:
        total = 0.0
        for j in range(1, k + 1):
            total += j * b[W, j] * b[E, k - j]
        b[E, k] = -law[2] * total / k
        b[Q, k] = -c * b[E, k] + rc * ((law[0] if k == 1 else 0.0) - b[E, k - 1])


@jit()
def _advance(k, b, ga, gs, ra, rs, span, law):
    """Coefficient k + 1 of v and w from those of e and q up to k; returns the size of that of v."""
    along = across = push = 0.0
    for j in range(min(k, 1) + 1 if law is None else k + 1):
        each, m = b[Q, np.uintp(j)], np.uintp(k - j)
        along -= each * b[EA, m]
        across -= each * b[ES, m]
    if k == 0:
        along += ga
        across += gs
    else:
        push = ra * b[EA, k - 1] + rs * b[ES, k - 1]
        if k == 1:
            along += ra
            across += rs
    share = span * b[SHARE, k]
    b[VA, k + 1] = share * along
    b[VS, k + 1] = share * across
    b[W, k + 1] = share * (ga * b[EA, k] + gs * b[ES, k] + push - b[Q, k])
    return abs(b[VA, k + 1]) + abs(b[VS, k + 1])


@jit()
def _part(order, before, last, tol):
    """How much of the span a series may take for its last two terms to be below tol."""
    size = max(before, last)
    return 1.0 if size <= tol else math.exp(math.log(tol / size) / (order - 1))


@jit(forceinline=True)
def _sliding(w, ga, gs, ra, rs, c, rc, span, tol, most, swell, law, b):
    """Series of a sliding block, along and across its motion; without friction, w = 0 serves.

    Without a law a coefficient of e needs but one product of the one before: the processor does
    not wait for the rest of the sums.
    Returns the degree and how much of the span it is good for, as its last terms have it.
    """
    inverse = 1.0 / w if c > 0.0 or rc > 0.0 else 0.0
    b[VA, 0], b[VS, 0], b[W, 0], b[EA, 0], b[ES, 0] = w, 0.0, w, 1.0, 0.0
    _friction(0, b, c, rc, law)
    _advance(0, b, ga, gs, ra, rs, span, law)
    slows = inverse * b[W, 1]
    ea, es, ea_before, es_before = 0.0, inverse * b[VS, 1], 0.0, 0.0
    b[EA, 1], b[ES, 1] = ea, es
    # What e = (1, 0) adds along is in here, so that it is no part of ea_before.
    kick, turn = ra - rc, rs
    before, last = np.inf, abs(b[VA, 1]) + abs(b[VS, 1])
    order = most
    for k in range(1, most):
        n, share = np.uintp(k + 1), span * b[SHARE, np.uintp(k)]
        older = side = 0.0
        for j in range(2, k + 1):
            each, m = b[W, np.uintp(j)], np.uintp(k + 1 - j)
            older += each * b[EA, m]
            side += each * b[ES, m]
        if law is None:
            along = share * (kick - (c * ea + rc * ea_before))
            across = share * (turn - (c * es + rc * es_before))
            w = share * (ga * ea + gs * es) + share * (kick + (ra * ea_before + rs * es_before))
            b[VA, n], b[VS, n], b[W, n] = along, across, w
            part = share * inverse
            older = inverse * older + part * ((rc + ra) * ea_before + rs * es_before)
            side = inverse * side + part * (rc * es_before - turn)
            ea_before, es_before = ea, es
            ea = -(ea * (part * (c + ga) + slows) + (part * gs * es + older))
            es = -(es * (part * c + slows) + side)
            kick = turn = 0.0
            before, last = last, abs(along) + abs(across)
        else:
            _friction(k, b, c, rc, law)
            before, last = last, _advance(k, b, ga, gs, ra, rs, span, law)
            ea = inverse * (b[VA, n] - b[W, n] - older) - slows * ea
            es = inverse * (b[VS, n] - side) - slows * es
        b[EA, n], b[ES, n] = ea, es
        if last <= tol and before <= tol and k > 1 and k > swell:
            order = k + 1
            break
    return order, _part(order, before, last, tol)


@jit()
def _creeping(w, vs, g, ra, rs, c, rc, span, tol, most, swell, law, b):
    """Series, along and across G, of a slow slip, w >= 0, whose direction has settled near G's.

    A slow block turns into the direction of G within about w / G, far less than a step. What is
    left is the series that solves (w e)' + q e = G across G0 for the coefficient of q e instead of
    that of (w e)'. From rest, w = 0, that is explicit: it is the beginning of a slip, where it
    converges after a jump of G and is asymptotic (its terms fall at first) at an onset. For w > 0
    the next coefficient of e comes in, small; it is taken from the sweep before.

    Returns as `_sliding`, and how far v is astray since vs is not yet the series'; 0 of the span
    where the sweeps do not settle, or where that is more than tol.
    """
    for k in range(most + 2):
        b[ES, k] = b[W, k] = 0.0
    b[EA, 0], b[W, 0] = 1.0, w
    before = last = change = np.inf
    order, top = most, 1 if law is None else most
    for _ in range(SWEEPS):
        change_before, change, first = change, 0.0, 0.0
        for k in range(order):
            _friction(k, b, c, rc, law)
            if k == 0:
                first = span * (g * b[EA, 0] - b[Q, 0])
                if w == 0.0:
                    first = max(first, 0.0)  # at an onset: what is left is rounding
            side = span * rs if k == 1 else 0.0
            for j in range(1, min(k, top) + 1):
                side -= span * b[Q, j] * b[ES, k - j]
            turned = w * b[ES, k + 1]
            for j in range(2, k + 2):
                turned += b[W, np.uintp(j)] * b[ES, np.uintp(k + 1 - j)]
            settles = (k + 1) * first + span * b[Q, 0]
            if not settles > 0.0:
                return order, 0.0, 0.0
            es = (side - (k + 1) * turned) / settles
            change = max(change, abs(es - b[ES, k]))
            b[ES, k] = es
            if k == 0:
                b[EA, 0] = math.sqrt(max(1.0 - es * es, 0.25))
            else:
                total = es * b[ES, 0]
                for j in range(1, k):
                    m, n = np.uintp(j), np.uintp(k - j)
                    total += 0.5 * (b[EA, m] * b[EA, n] + b[ES, m] * b[ES, n])
                b[EA, k] = -total / b[EA, 0]
            before = last
            last = _advance(k, b, g, 0.0, ra, rs, span, law)
            if k == 0 and w == 0.0:
                b[W, 1] = b[VA, 1] = first
            if order == most and last <= tol and before <= tol and k > 1 and k > swell:
                order = k + 1
                break
        b[VA, 0], b[VS, 0], off = w * b[EA, 0], w * b[ES, 0], 0.0
        if w > 0.0:
            # It turns at the rate q / w: what is left of the difference, and its way until then.
            off, most_w, least_q = abs(vs - b[VS, 0]), w, b[Q, 0]
            for k in range(1, order + 1):
                most_w += abs(b[W, np.uintp(k)])
                least_q -= abs(b[Q, np.uintp(k)]) if k < order else 0.0
            turns = max(span * least_q / most_w, 0.0)
            off *= math.exp(-turns) + 1.0 / max(turns, 1.0) + off / w
        if w == 0.0 or change * (w + abs(b[W, 1])) <= 0.1 * tol:
            part = _part(order, before, last, tol)
            off /= part
            return order, part if off <= tol else 0.0, off
        if change > 0.5 * change_before or off > 10.0 * tol + 4.0 * w * change:
            break
    return order, 0.0, 0.0


@jit(forceinline=True)
def _series(w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, most, slow, law, b):
    """The series of a step and its unit of time: a creeping one where that serves; rates in 1/s.

    Returns its degree, how much of its unit it is good for, that unit, how far v is astray at its
    beginning, and the direction of its axis along.
    """
    hard, g = slow * c, math.sqrt(gx * gx + gy * gy)
    rate = 0.0 if law is None else law[2]
    span = left
    if w > 0.0 and hard * left > STIFF * w:
        # The drive's direction is a series for as long as the drive lasts as it is.
        pace = math.sqrt(rx * rx + ry * ry) + slow * abs(rc)
        span = g / pace if pace * left > g else left
    if (w == 0.0 and (c > 0.0 or rc > 0.0)) or (
        w > 0.0
        and hard * span > STIFF * w
        and rate * w <= SWELL
        and gx * vx + gy * vy > 0.9 * w * g
    ):
        swell = 0.0
        if rate > 0.0:
            # The speed gains push t + rise t^2 / 2 at most.
            least, gain = min(slow, law[0]), SWELL / rate
            push, rise = max(g - least * c, 0.0), math.sqrt(rx * rx + ry * ry) + least * abs(rc)
            fast = push + math.sqrt(push * push + 2.0 * rise * gain)
            span = 2.0 * gain / fast if fast * span > 2.0 * gain else span
            # A slow block comes to the speed of its push at the rate of the law's slope at rest.
            settles = rate * abs(law[1]) * max(c, c + rc * span)
            span = SETTLES / settles if settles * span > SETTLES else span
            swell = rate * (w + span * (push + 0.5 * rise * span))
        ux, uy = gx / g, gy / g
        ra, rs = span * (rx * ux + ry * uy), span * (ry * ux - rx * uy)
        few = min(most, CREEP_ORDER)
        order, part, astray = _creeping(
            w, vy * ux - vx * uy, g, ra, rs, c, rc * span, span, tol, few, swell, law, b
        )
        if part > 0.0:
            return order, part, span, astray, ux, uy
    ux, uy = (vx / w, vy / w) if w > 0.0 else (1.0, 0.0)
    ga, gs = gx * ux + gy * uy, gy * ux - gx * uy
    span, square = left, max((ga - hard) * (ga - hard) + gs * gs, 0.04 * hard * hard)
    if hard > 0.0 and square * left * left > 4.0 * w * w:
        span = 2.0 * w / math.sqrt(square)
    swell = 0.0
    if rate > 0.0:
        # A law's exponential may be nothing now and all of it soon: no term would tell.
        mu = max(slow, law[0])
        most_push = g + mu * c + left * (abs(rx) + abs(ry) + mu * abs(rc))
        unseen = (w - FADED / rate) / most_push
        span = min(span, max(unseen, SWELL / (rate * most_push)))
        swell = rate * most_push * span if span > unseen else 0.0
    ra, rs = span * (rx * ux + ry * uy), span * (ry * ux - rx * uy)
    order, part = _sliding(w, ga, gs, ra, rs, c, rc * span, span, tol, most, swell, law, b)
    return order, part, span, 0.0, ux, uy


@jit()
def _scale(b, order, part):
    """Make the part of its unit that a series takes its unit.

    Returns what v gains until then, along and across, its mean gain, its rate then, and how far it
    may stray.
    """
    power = 1.0
    along = across = way = aside = along_rate = across_rate = moved = 0.0
    for k in range(1, order + 1):
        n = np.uintp(k)
        power *= part
        va, vs, share = power * b[VA, n], power * b[VS, n], b[SHARE, n]
        b[VA, n], b[VS, n], b[W, n] = va, vs, power * b[W, n]
        along, across = along + va, across + vs
        way, aside = way + share * va, aside + share * vs
        along_rate, across_rate = along_rate + k * va, across_rate + k * vs
        moved += abs(va) + abs(vs)
    return along, across, way, aside, along_rate, across_rate, moved


@jit()
def _place(b, order, at):
    """What v gains until a time, along and across, and its mean gain."""
    along = across = way = aside = 0.0
    for k in range(order, 0, -1):
        n = np.uintp(k)
        along, across = (along + b[VA, n]) * at, (across + b[VS, n]) * at
        way = (way + b[VA, n] * b[SHARE, n]) * at
        aside = (aside + b[VS, n] * b[SHARE, n]) * at
    return along, across, way, aside


@jit()
def _value(b, row, first, order, at):
    """The sum of b[row, k] at^(k - first) from `first` on, and its slope."""
    total, slope = b[row, order], 0.0
    for k in range(order - 1, first - 1, -1):
        slope = slope * at + total
        total = total * at + b[row, np.uintp(k)]
    return total, slope


@jit()
def _zeros(b, row, first, degree):
    """How often a series may change sign up to 1: 0, 1 or, for all that is known, 2 times."""
    lead, rise = b[row, first], b[row, first + 1]
    sign, way = (1.0 if lead > 0.0 else -1.0), (1.0 if rise > 0.0 else -1.0)
    least, steady, end = abs(lead), abs(rise), lead
    for k in range(first + 1, degree + 1):
        each = b[row, np.uintp(k)]
        end += each
        least += min(sign * each, 0.0)
        if k > first + 1:
            steady += (k - first) * min(way * each, 0.0)
    if least > 0.0 or (steady > 0.0 and (end > 0.0) == (lead > 0.0) and end != 0.0):
        return 0
    return 1 if steady > 0.0 else 2


@jit()
def _changes(b, row, degree, most):
    """Fill row ROOTS with where the series in a row changes sign in (0, 1], the first `most`.

    Unless its terms show that it does once at most, it is looked at in some places, close together
    at both ends, and from where its terms no longer show that it keeps its sign; between two from
    which it falls to both sides towards zero, at its least.
    Returns how many there are.
    """
    first = 0
    while first < degree and b[row, first] == 0.0:
        first += 1
    known = _zeros(b, row, first, degree) if first < degree else 0
    if known == 0:
        return 0
    cells, m, n = (SCAN if known > 1 else 1), 1, 0
    near = _keeps(b, row, first, degree) if known > 1 else np.inf
    right, at_right, rise = 0.0, b[row, first], b[row, first + 1]
    while m <= cells and n < most:
        left, at_left, x = right, at_right, m / cells
        # Where a place is a zero, the side is that of the slope there.
        up = at_left > 0.0 or (at_left == 0.0 and rise > 0.0)
        falls = (rise < 0.0) == up
        right = x * x * (3.0 - 2.0 * x)
        if near < right:
            right, near = near, 4.0 * near
        else:
            m, near = m + 1, np.inf
        at_right, rise = _value(b, row, first, degree, right)
        beyond = at_right <= 0.0 if up else at_right >= 0.0
        if not beyond and falls and (rise > 0.0) == up:
            middle, there = _least(b, row, first, degree, left, right, up)
            if (there <= 0.0) if up else (there >= 0.0):
                b[ROOTS, n] = _root(b, row, first, degree, left, at_left, middle, there, up)
                n += 1
                if n < most:
                    b[ROOTS, n] = _root(b, row, first, degree, right, at_right, middle, there, up)
                    n += 1
        elif beyond:
            b[ROOTS, n] = _root(b, row, first, degree, left, at_left, right, at_right, up)
            n += 1
    return n


@jit()
def _keeps(b, row, first, degree):
    """Where the terms of a series show that it keeps its sign from 0 on; inf for the first cell."""
    sign, at, least = (1.0 if b[row, first] > 0.0 else -1.0), 2.0 / SCAN, 0.0
    at, far = at * at, np.inf
    while at > 1e-12 and not least > 0.0:
        least, power = abs(b[row, first]), 1.0
        for k in range(first + 1, degree + 1):
            power *= at
            least += min(sign * power * b[row, np.uintp(k)], 0.0)
        if not least > 0.0:
            at *= 0.125
            far = at
    return far


@jit()
def _least(b, row, first, degree, left, right, up):
    """Where a series is nearest to zero, or beyond it, between two places from which it falls."""
    at, there = left, 1.0 if up else -1.0
    while right - left > 1e-12 and (there > 0.0) == up:
        at = 0.5 * (left + right)
        there, slope = _value(b, row, first, degree, at)
        if (slope > 0.0) == up:
            right = at
        else:
            left = at
    return at, there


@jit()
def _root(b, row, first, degree, low, at_low, high, at_high, up):
    """Where a series changes sign between a place on one side and one beyond, by Illinois."""
    side = 0
    for _ in range(60):
        if at_high == 0.0 or not abs(high - low) > 1e-15 * high:
            break
        share = at_low / (at_low - at_high) if at_low != 0.0 else 0.5
        at = low + share * (high - low)
        found, _ = _value(b, row, first, degree, at)
        # The end that stays counts half from its second time on.
        if found != 0.0 and (found > 0.0) == up:
            at_high *= 0.5 if side == -1 else 1.0
            low, at_low, side = at, found, -1
        else:
            at_low *= 0.5 if side == 1 else 1.0
            high, at_high, side = at, found, 1
    return high


@jit()
def _rates(b, order, at):
    """v, along and across, and its rate, at a time of a step."""
    va = vs = along_rate = across_rate = 0.0
    for k in range(order, 0, -1):
        n = np.uintp(k)
        along_rate, across_rate = along_rate * at + k * b[VA, n], across_rate * at + k * b[VS, n]
        va, vs = (va + b[VA, n]) * at, (vs + b[VS, n]) * at
    return b[VA, 0] + va, b[VS, 0] + vs, along_rate, across_rate


@jit(forceinline=True)
def _excess(va, vs, w, va_rate, vs_rate, tau, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law):
    """What a step gains in speed at most, in h, by its defect at a time tau of it.

    The series solves the equation with a push d more, d = v' - G + q e. Friction is monotone, so
    the speed is off by the integral of |d| at most; across the motion it pulls back at the rate
    q / w besides, so that d counts there for no longer than w / q, and along the motion by its
    square.
    """
    q = c + rc * tau
    if law is not None:
        mu = law[0] - law[1] * math.exp(-law[2] * w)
        q, c = mu * q, min(mu, law[0] - law[1]) * c
    gx, gy, each = gx + rx * tau, gy + ry * tau, 1.0 / h
    da, ds = va_rate * each - (gx * ux + gy * uy), vs_rate * each - (gy * ux - gx * uy)
    each = 1.0 / max(w, 1e-300)
    along, across = abs((da * va + ds * vs) * each + q), abs(ds * va - da * vs) * each
    least = min(q, c)
    lasts = most_w / least if most_w < h * least else h
    return h * (along + across * (1e-3 if across < 1e-3 * q else 1.0)) + across * lasts


@jit(forceinline=True)
def _miss(
    b, order, va, vs, w, va_rate, vs_rate, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law
):  # fmt: skip
    """Bound of the error in speed that a step makes, from its defect at its end.

    The defect grows like the power `order` of time, so its integral is its end by order + 1: here
    five times that. It may be zero at the end by chance: hence a tenth of the last terms.
    """
    last, n = np.uintp(order), np.uintp(order - 1)
    least = abs(b[VA, last]) + abs(b[VS, last]) + abs(b[VA, n]) + abs(b[VS, n])
    excess = _excess(va, vs, w, va_rate, vs_rate, h, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law)
    return max(excess * (5.0 / (order + 1)), 0.1 * least)


@jit()
def _miss_at(b, order, at, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law):
    """The same from the defect at a part of the step near its end."""
    va, vs, va_rate, vs_rate = _rates(b, order, at)
    w, tau = math.sqrt(va * va + vs * vs), at * h
    return _excess(va, vs, w, va_rate, vs_rate, tau, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law)


@jit()
def _bend(c, w, law):
    """How far a law may have q off from its value at rest, at speeds up to w."""
    return 0.0 if law is None else abs(law[1]) * (1.0 - math.exp(-law[2] * w)) * c


@jit()
def _close(vx, vy, w, gx, gy, rx, ry, c, rc, bend, slack):
    """The rest of the way to a stop if G and q stayed as they are; rates for each second.

    `bend` is how far a law has q off from its value at rest.

    With psi the angle from G to v: (w (q + G cos psi))' = G^2 - q^2 gives the time; the ways along
    and across G follow from the derivatives of w^2 (G + 2 q cos psi + G cos^2 psi) and of
    w^2 sin psi (2 q + G cos psi), written without dividing by G.

    Returns the time, the way and a bound of its error; inf, 0, 0, inf where it may not stop or the
    bound is above `slack`.
    """
    never = (np.inf, 0.0, 0.0, np.inf)
    square = gx * gx + gy * gy
    if not c * c > square:
        return never
    along, less, more = gx * vx + gy * vy, c * c - square, 4.0 * c * c - square
    time, lag = (c * w + along) / less, (2.0 * c * w + along) / more
    change = (math.sqrt(rx * rx + ry * ry) + abs(rc)) * time + bend
    change /= c - math.sqrt(square)
    if change > 0.3 or change * w * time > slack:
        return never
    pull = (w * w + 3.0 * along * lag) / (4.0 * less)
    return time, lag * vx + pull * gx, lag * vy + pull * gy, change * w * time


@jit()
def _see(sx, sy, t, cs, top):
    """Look at one place of the block."""
    square = cs * cs * sx * sx + sy * sy
    if square > top[0] * top[0]:
        top[0], top[1] = math.sqrt(square), t
    top[2], top[3] = max(top[2], sx), min(top[3], sx)
    top[4], top[5] = max(top[4], sy), min(top[5], sy)


@jit(forceinline=True)
def _look(b, order, ux, uy, cs, sx, sy, way, aside, vx, vy, w, moved, h, t, top):
    """Look at the places inside a step where an extreme may be; (vx, vy) is v at its end."""
    reach = h * (w + moved)
    for side in range(2):
        place = sx if side == 0 else sy
        along, across = (ux, -uy) if side == 0 else (uy, ux)
        far, near = place + reach > top[2 + 2 * side], place - reach < top[3 + 2 * side]
        if (far or near) and abs(along * b[VA, 0] + across * b[VS, 0]) <= moved:
            for k in range(order + 1):
                b[E, k] = along * b[VA, k] + across * b[VS, k]
            _see_zeros(b, order, order, ux, uy, cs, sx, sy, h, t, top)
    # The rate of the distance is u . v with u = (cs^2 sx, sy), which gains up to `reach`.
    away = math.sqrt(cs * cs * sx * sx + sy * sy)
    if away + reach > top[0]:
        along, across = cs * cs * sx * ux + sy * uy, sy * ux - cs * cs * sx * uy
        end = cs * cs * (sx + way) * vx + (sy + aside) * vy
        if _returns(b, order, along, across, end, away, w, moved, reach, h):
            _rate(b, order, along, across, ux, uy, cs, h)
            _see_zeros(b, order, order + 1, ux, uy, cs, sx, sy, h, t, top)


@jit(forceinline=True)
def _returns(b, order, along, across, end, away, w, moved, reach, h):
    """Whether the block may be farther from its start inside a step than at both ends."""
    # What u gains in a step that turns by less than 90 deg cannot bring the block back.
    first = 0 if w > 0.0 else 1
    lead = along * b[VA, first] + across * b[VS, first]
    turns = moved > 0.7 * w if w > 0.0 else moved > 1.5 * (abs(b[VA, 1]) + abs(b[VS, 1]))
    extra = reach * (w + moved) if turns or lead < 0.0 else 0.0
    if w > 0.0 and abs(lead) > away * moved + extra:
        return False
    rise = along * b[VA, 1] + across * b[VS, 1]
    sign, way = (1.0 if lead > 0.0 else -1.0), (1.0 if rise > 0.0 else -1.0)
    least, steady, swing = abs(lead), abs(rise), abs(b[VA, 1]) + abs(b[VS, 1])
    for k in range(first + 1, order + 1):
        va, vs = b[VA, np.uintp(k)], b[VS, np.uintp(k)]
        each = along * va + across * vs
        least += min(sign * each, 0.0)
        if k > 1:
            steady += k * min(way * each, 0.0)
            swing += k * (abs(va) + abs(vs))
    if least >= extra:
        return False
    # A rate that only grows has no largest distance; one that only falls has, if it changes sign.
    if rise > 0.0:
        return steady <= reach * swing
    falls = steady > reach * swing + h * (w + moved) * (w + moved)
    return not falls or lead > 0.0 > end


@jit()
def _rate(b, order, along, across, ux, uy, cs, h):
    """Write u . v into row E, up to a degree above v as u is: what is left out is as small there.

    Rows EA and ES are used up.
    """
    one, two = cs * cs * ux * ux + uy * uy, cs * cs * uy * uy + ux * ux
    both = (1.0 - cs * cs) * ux * uy
    for k in range(order + 1):
        b[EA, k] = h * (one * b[VA, k] + both * b[VS, k])
        b[ES, k] = h * (both * b[VA, k] + two * b[VS, k])
        b[E, k] = along * b[VA, k] + across * b[VS, k]
    b[E, order + 1] = 0.0
    for k in range(1, order + 2):
        total = 0.0
        for j in range(k):
            total += b[SHARE, j] * (b[VA, j] * b[EA, k - 1 - j] + b[VS, j] * b[ES, k - 1 - j])
        b[E, k] += total


@jit()
def _see_zeros(b, order, degree, ux, uy, cs, sx, sy, h, t, top):
    """Look at the places where the series in row E changes sign."""
    for k in range(_changes(b, E, degree, ORDER)):
        at = b[ROOTS, k]
        _, _, way, aside = _place(b, order, at)
        way, aside = h * at * (b[VA, 0] + way), h * at * (b[VS, 0] + aside)
        _see(sx + way * ux - aside * uy, sy + way * uy + aside * ux, t + h * at, cs, top)


@jit()
def _hides(sx, sy, vx, vy, gx, gy, cs, reach, top):
    """Whether an extreme may be on the way to a stop, while v turns into the direction of G."""
    scale = cs * cs
    before, after = scale * sx * vx + sy * vy, scale * sx * gx + sy * gy
    return (
        (before * after < 0.0 and math.sqrt(scale * sx * sx + sy * sy) + reach > top[0])
        or (vx * gx < 0.0 and (sx + reach > top[2] or sx - reach < top[3]))
        or (vy * gy < 0.0 and (sy + reach > top[4] or sy - reach < top[5]))
    )


@jit()
def _sample(ax, ay, az, i, p, q):
    """G and c at sample i."""
    if az is None:
        return p[0] - p[2] * ax[i], p[3] * ay[i], q[0] + q[2] * ax[i]
    return p[0] + p[1] * az[i] - p[2] * ax[i], p[3] * ay[i], q[0] + q[1] * az[i] + q[2] * ax[i]


@jit()
def _terms(x, y, z, p, q, most):
    """Sum of the sizes of what G and friction are made of, at most: rounding is relative to it."""
    along, across = max(-x[0, -1], x[1, -1]), max(-y[0, -1], y[1, -1])
    up = 0.0 if z is None else max(-z[0, -1], z[1, -1])
    drive = abs(p[0]) + abs(p[1]) * up + abs(p[2]) * along + abs(p[3]) * across
    return drive + most * (abs(q[0]) + abs(q[1]) * up + abs(q[2]) * along)


@jit()
def _is_quiet(x, y, z, block, p, q, hold):
    """Whether no sample of a block of them can push a resting block over.

    Rounding keeps order: what is computed from bounds bounds what is computed from samples.
    """
    one, other = p[2] * x[0, block], p[2] * x[1, block]
    low, high = p[0], p[0]
    least = q[0]
    if z is not None:
        up, down = p[1] * z[0, block], p[1] * z[1, block]
        low, high = low + min(up, down), high + max(up, down)
        least += min(q[1] * z[0, block], q[1] * z[1, block])
    ahead = max(abs(low - max(one, other)), abs(high - min(one, other)))
    aside = p[3] * max(abs(y[0, block]), abs(y[1, block]))
    least = hold * (least + min(q[2] * x[0, block], q[2] * x[1, block]))
    return least >= 0.0 and ahead * ahead + aside * aside <= least * least


@jit()
def _next_push(ax, ay, az, x, y, z, i, p, q, hold):
    """First sample from i on that pushes a resting block over, or n."""
    n = ax.size
    while i < n:
        if i & ((1 << SHIFT) - 1) == 0:
            while i < n and _is_quiet(x, y, z, i >> SHIFT, p, q, hold):
                i += 1 << SHIFT
            if i >= n:
                break
        gx, gy, c = _sample(ax, ay, az, i, p, q)
        if gx * gx + gy * gy > (hold * c) * (hold * c):
            return i
        i += 1
    return n


@jit()
def _onset(gx, gy, c, hx, hy, d):
    """When, of an interval from 0 to 1, |G| first exceeds c; 0 at once, 2 for never.

    |G| - c is convex: it leaves zero upwards once at most. G goes from g to h, c from c to d.
    """
    rx, ry, rc = hx - gx, hy - gy, d - c
    half = gx * rx + gy * ry - c * rc
    push = gx * gx + gy * gy - c * c
    if push > 0.0:
        return 0.0
    if hx * hx + hy * hy <= d * d:
        return 2.0
    square = rx * rx + ry * ry - rc * rc
    root = math.sqrt(max(half * half - square * push, 0.0))
    return min(-push / (half + root) if half > 0.0 else (root - half) / square, 1.0)


@jit()
def _rest(gx, gy, c, hx, hy, d, left, hold, slow, dead, error, off):
    """Rest until a push of more than rounding; G goes from g to h, c from c to d in `left`.

    The true block may still move, by the error of its speed, until friction has taken that: q - |G|
    is concave, and not below zero where the rest ends.

    Returns when the slip begins, of `left` (2 for never), and the errors until then.
    """
    onset = _onset(gx, gy, hold * c + dead, hx, hy, hold * d + dead)
    pull, h = math.sqrt(gx * gx + gy * gy), left * min(onset, 1.0)
    error += off * h
    off = max(0.0, off - 0.5 * max(slow * c - pull, 0.0) * h)
    if pull > hold * c or math.sqrt(hx * hx + hy * hy) > hold * d:
        off += dead * h
    return onset, error, off


@jit()
def _net_push(gx, gy, c, hx, hy, d):
    """The larger push beyond friction of two samples."""
    return max(math.sqrt(hx * hx + hy * hy) - d, math.sqrt(gx * gx + gy * gy) - c)


@jit()
def _note(events, n, t, kind, sx, sy):
    """Write event n, where there is room, and return how many there are."""
    if n < events.shape[0]:
        events[n, 0], events[n, 1], events[n, 2], events[n, 3] = t, kind, sx, sy
    return n + 1


@jit()
def _fill(history, i, end, sx, sy, vx, vy):
    """Write samples i to end - 1."""
    for k in range(i, min(end, history.shape[1])):
        history[0, k], history[1, k], history[2, k], history[3, k] = sx, sy, vx, vy


@jit(cache=True, nogil=True)
def slide_plane(
    ax, ay, az, x, y, z, dt, sn, cs, mu, g, scale, tolerance, most, most_steps, law,
    events, history, top, end,
):  # fmt: skip
    """Follow the linearly interpolated record event by event, each step to a tolerance.

    Two blocks under one motion never part faster than they do: friction is monotone, so the error
    in the speed at any time is at most the sum of those of the steps before (Brezis, Operateurs
    maximaux monotones, 1973, lemma 3.1), and at rest it is gone. The error in place is at most
    the integral of that. Rounding of the drive counts as a push, that of places by itself. Where
    friction falls with speed or at the breakaway, none of this is a bound.

    Parameters
    ----------
    az : array, shape (n,), or None
        None for no vertical shaking; another version is compiled for it.
    x, y, z : array
        `bounds` of ax, ay and az (None where az is).
    mu : float
        Friction coefficient; 1 where there is a law.
    tolerance : float
        Of a step, relative to the largest speed so far, and of a slip to the largest distance.
    most, most_steps : int
        Largest degree of a series, from 4 to `ORDER`, and largest number of steps.
    law : tuple of float, or None
        mu(w) = law[0] - law[1] exp(-law[2] w) while sliding; law[3] >= mu(0) until it slips.
    events : array, shape (m, 4)
        Filled with time, kind, sx and sy of the events, as far as there is room.
    history : array, shape (4, n) or (4, 0)
        Filled with sx, sy, vx and vy at the samples, or with nothing.
    top : array, shape (6,)
        Filled: the largest distance in plan, its time, largest and least sx, largest and least sy.
    end : array, shape (4,)
        Filled with sx, sy, vx and vy at the end.

    Returns
    -------
    tuple
        FOLLOWED, TOO_MANY_STEPS or NOT_FINITE; a bound of the error of every place; numbers of
        stops, of events and of steps.
    """
    p = (sn * g, sn * scale, cs * scale, -scale)
    q = (mu * cs * g, mu * cs * scale, mu * sn * scale)
    hold = 1.0 if law is None else law[3]
    slow = 1.0 if law is None else law[0] - law[1]
    terms = _terms(x, y, z, p, q, 1.0 if law is None else max(hold, slow, law[0]))
    dead, least = DEAD * terms, EPS * dt
    tolerance = max(tolerance, LEAST_TOLERANCE)
    b = np.empty((9, ORDER + 2))
    for k in range(ORDER + 2):
        b[SHARE, k] = 1.0 / (k + 1)
    for k in range(6):
        top[k] = 0.0
    sx = sy = vx = vy = w = tau = fastest = since = off = error = 0.0
    moving = False
    # Not literals: for those, numba would compile what takes them once more.
    i, n_events = np.int64(0), np.int64(0)
    n_stops = n_steps = 0
    last = ax.size - 1 if terms * terms < np.inf else -1
    _fill(history, i, i + 1, 0.0, 0.0, 0.0, 0.0)
    while i < last:
        # Where the true block may still move, by the error of its speed, nothing is passed over.
        if not moving and off == 0.0:
            first = _next_push(ax, ay, az, x, y, z, i, p, q, hold)
            _fill(history, i + 1, min(first, last + 1), sx, sy, 0.0, 0.0)
            i = max(i, first - 1)
            if i >= last:
                break
        g0x, g0y, c0 = _sample(ax, ay, az, i, p, q)
        hx, hy, d = _sample(ax, ay, az, i + 1, p, q)
        rx, ry, rc = (hx - g0x) / dt, (hy - g0y) / dt, (d - c0) / dt
        rubs = c0 > 0.0 or d > 0.0
        tau = 0.0
        # Each turn takes time: a step `least` or more; an onset stands between a stop and a step.
        while tau < dt:
            gx, gy, c, left = g0x + rx * tau, g0y + ry * tau, c0 + rc * tau, dt - tau
            if not moving:
                onset, error, off = _rest(gx, gy, c, hx, hy, d, left, hold, slow, dead, error, off)
                if onset >= 1.0 or not tau + onset * left < dt:
                    break
                moving = True
                tau += onset * left
                n_events = _note(events, n_events, i * dt + tau, SLIP, sx, sy)
                continue
            t = i * dt + tau
            n_steps += 1
            if n_steps > most_steps:
                return TOO_MANY_STEPS, error, n_stops, n_events, n_steps
            if w == 0.0:
                since = t
                fastest = max(fastest, 0.5 * left * _net_push(gx, gy, slow * c, hx, hy, slow * d))
            fastest = max(fastest, w)
            far = max(top[0], math.sqrt(cs * cs * sx * sx + sy * sy), SMALL)
            # What is wrong with v counts as long as the slip lasts: about as long as it has so far.
            late = t - since
            tol = tolerance * max(fastest * far / (far + late * fastest), SMALL / (late + left))
            tol = max(tol, EPS * terms * left)
            order, part, span, astray, ux, uy = _series(
                w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, most, slow, law, b
            )
            along, across, way, aside, va_rate, vs_rate, moved = _scale(b, order, part)
            stops = rubs and moved >= w and _changes(b, W, order, 1) > 0
            if part < 1.0 and not stops and w > 0.0:
                slack = CLOSE * tolerance * far
                rest, back, sides, miss = _close(
                    vx, vy, w, gx, gy, rx, ry, slow * c, slow * rc, _bend(c, w, law), slack
                )
                if rest < left and not (
                    w * rest > slack and _hides(sx, sy, vx, vy, gx, gy, cs, w * rest, top)
                ):
                    tau, sx, sy = tau + rest, sx + back, sy + sides
                    error += miss + off * rest
                    vx, vy, w, moving = 0.0, 0.0, 0.0, False
                    n_stops += 1
                    n_events = _note(events, n_events, i * dt + tau, STOP, sx, sy)
                    _see(sx, sy, i * dt + tau, cs, top)
                    continue
            if stops:
                stop = b[ROOTS, 0]
                part *= stop
                along, across, way, aside, va_rate, vs_rate, moved = _scale(b, order, stop)
                # The series of w may come to zero where it is no longer the speed.
                if math.hypot(b[VA, 0] + along, across) > max(tol, 1e-12 * (w + moved)):
                    part, stops = 0.5 * part, False
                    along, across, way, aside, va_rate, vs_rate, moved = _scale(b, order, 0.5)
            h, miss = span * part, 0.0
            va, vs = b[VA, 0] + along, b[VS, 0] + across
            after = math.sqrt(va * va + vs * vs)
            if stops:
                miss = _miss_at(b, order, 0.9, h, gx, gy, rx, ry, ux, uy, c, rc, w + moved, law)
            elif rubs:
                miss = _miss(
                    b, order, va, vs, after, va_rate, vs_rate, h, gx, gy, rx, ry, ux, uy, c, rc,
                    w + moved, law,
                )  # fmt: skip
                if c + rc * h < 0.5 * c:
                    # Where friction vanishes, so does what a series makes wrong of it.
                    before = _miss_at(
                        b, order, 0.85, h, gx, gy, rx, ry, ux, uy, c, rc, w + moved, law
                    )
                    miss = max(miss, before)
            while miss > SLACK * tol and h > least:
                less = max(0.1, 0.9 * (tol / miss) ** (1.0 / order))
                part, h, stops = part * less, h * less, False
                along, across, way, aside, va_rate, vs_rate, moved = _scale(b, order, less)
                va, vs = b[VA, 0] + along, b[VS, 0] + across
                after = math.sqrt(va * va + vs * vs)
                miss = _miss(
                    b, order, va, vs, after, va_rate, vs_rate, h, gx, gy, rx, ry, ux, uy, c, rc,
                    w + moved, law,
                )  # fmt: skip
            off += miss + astray + ROUNDING * terms * h + EPS * (terms * dt + w)
            error += off * h
            if not after + error < np.inf:
                return NOT_FINITE, error, n_stops, n_events, n_steps
            vx, vy = va * ux - vs * uy, va * uy + vs * ux
            way, aside = h * (b[VA, 0] + way), h * (b[VS, 0] + aside)
            way, aside = way * ux - aside * uy, way * uy + aside * ux
            _look(b, order, ux, uy, cs, sx, sy, way, aside, vx, vy, w, moved, h, t, top)
            sx, sy = sx + way, sy + aside
            error += EPS * (abs(sx) + abs(sy) + w * dt)
            _see(sx, sy, t + h, cs, top)
            # What the block may gain while less than `least` goes by is in `off`.
            tau = dt if part == 1.0 and span == left else tau + max(h, least)
            if stops or (after <= tol and after < w and rubs):
                off += after
                vx, vy, after, moving = 0.0, 0.0, 0.0, False
                n_stops += 1
                n_events = _note(events, n_events, i * dt + tau, STOP, sx, sy)
            w = after
        i += 1
        _fill(history, i, i + 1, sx, sy, vx, vy)
    end[0], end[1], end[2], end[3] = sx, sy, vx, vy
    followed = last >= 0 and error < np.inf
    return FOLLOWED if followed else NOT_FINITE, error, n_stops, n_events, n_steps
