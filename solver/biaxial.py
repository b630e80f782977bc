"""A block that slides down and across a shaken roof, jitted: power series from event to event.

Never raises, knows no units but SI; numpy and numba only. Read `slide_plane`, then `_sliding` and
`_creeping`; `solver.plane` says what the numbers mean.

The model, for each unit of mass, in roof axes (down the slope, across it):
    N = (g + az) cos(theta) + ax sin(theta)                       normal force, Eq. 6 with az
    G = ((g + az) sin(theta) - ax cos(theta), -ay)                drive
    v' = G - mu N v / |v|  while sliding;  rests while |G| <= mu N
G and N are linear between samples. So is everything on the right but the direction e = v / |v|, and
v, e and w = |v| follow from each other, coefficient by coefficient:
    v' = G - q e     w' = G . e - q     w e = v                   q = mu N
The series of v converges up to about w / |v'|, the time that a stop would take.

Letters:
    ax, ay, az  acceleration of the plane: horizontal (right), across, vertical (up)      [m/s2]
    x, y, z     `kernels.bounds` of ax, ay and az
    g, sn, cs   acceleration of gravity; sine and cosine of theta, positive down to the right
    sx, sy      distance slid down the slope and across it; in plan (sx cos(theta), sy)   [m]
    vx, vy, w   their rates and the speed                                                 [m/s]
    gx, gy, c   G, and mu N (or N, where a law gives mu)                                  [m/s2]
    hx, hy, d   the same at the end of an interval                                        [m/s2]
    rx, ry, rc  what they gain in a step                                                  [m/s2]
    p, q        weights of 1, az and ax in gx and in c; p[3] is that of ay in gy
    span, part  length of the series' unit of time [s]; how much of it a step takes
    b           series: rows VX, VY, EX, EY, W, Q and E of coefficients of (time / span)^k, and
                SHARE of 1 / (k + 1)
    law         None, or mu_fast, mu_fast - mu_slow, rate [s/m] and mu_rest (`slide_plane`)
    top         largest distance in plan, its time; largest and least sx; largest and least sy
"""

import math

import numpy as np
from numba import njit

# Kinds of event.
SLIP = 1.0
STOP = 0.0

ORDER = 20
CREEP_ORDER = 12
VX, VY, EX, EY, W, Q, E, SHARE = range(8)

# Samples in a block of `kernels.bounds`.
SHIFT = 4

LEAST_TOLERANCE = 1e-14
"""Tolerance of a step below which rounding is larger."""

ROUNDING = 4e-16
"""Error of the net push by the sizes of drive and friction."""

CLOSE = 3.0
"""Error in place that closing a stop may make, by tolerance and largest distance."""

SWEEPS = 12

SCAN = 8
"""Places of a series at which its sign is looked at."""

STIFF = 100.0
"""Times that the direction would settle in a step, from which on `_creeping` is worth a try."""


@njit
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


@njit
def _advance(k, b, gx, gy, rx, ry, span, law):
    """Coefficient k + 1 of v and w from those of e and q up to k; returns the size of that of v."""
    fx = fy = push = 0.0
    for j in range(min(k, 1) + 1 if law is None else k + 1):
        fx -= b[Q, j] * b[EX, k - j]
        fy -= b[Q, j] * b[EY, k - j]
    if k == 0:
        fx += gx
        fy += gy
    else:
        push = rx * b[EX, k - 1] + ry * b[EY, k - 1]
        if k == 1:
            fx += rx
            fy += ry
    share = span * b[SHARE, k]
    b[VX, k + 1] = share * fx
    b[VY, k + 1] = share * fy
    b[W, k + 1] = share * (gx * b[EX, k] + gy * b[EY, k] + push - b[Q, k])
    return abs(b[VX, k + 1]) + abs(b[VY, k + 1])


@njit
def _part(order, before, last, tol):
    """How much of the span a series may take for its last two terms to be below tol."""
    part = 1.0
    if last > tol:
        part = (tol / last) ** (1.0 / order)
    if before > tol:
        part = min(part, (tol / before) ** (1.0 / (order - 1)))
    return part


@njit
def _left_out(order, part, last, ratio):
    """Six times the size of the terms that a series leaves out, each `ratio` of the one before."""
    ratio = min(ratio, 0.9)
    size = 6.0 * last * ratio / (1.0 - ratio)
    for _ in range(order if part < 1.0 else 0):
        size *= part
    return size


@njit
def _sliding(w, vx, vy, gx, gy, rx, ry, c, rc, span, tol, most, law, b):
    """Series of a sliding block, v != 0; without friction, e = 0 serves.

    The sums are written for the processor not to wait: what is older comes first.
    Returns the degree, how much of the span it is good for, and its error in v there.
    """
    inverse = 1.0 / w if c > 0.0 or rc > 0.0 else 0.0
    ex, ey, x, y = vx * inverse, vy * inverse, 0.0, 0.0
    b[VX, 0], b[VY, 0], b[W, 0], b[EX, 0], b[EY, 0] = vx, vy, w, ex, ey
    kx, ky, q, first, ux, uy = gx, gy, c, 0.0, 0.0, 0.0
    before = last = np.inf
    order = most
    for k in range(most):
        share = span * b[SHARE, k]
        if law is None:
            vx = share * (kx - rc * x) - share * c * ex
            vy = share * (ky - rc * y) - share * c * ey
        else:
            _friction(k, b, c, rc, law)
            q, vx, vy = b[Q, k], kx, ky
            for j in range(k + 1):
                vx -= b[Q, j] * b[EX, k - j]
                vy -= b[Q, j] * b[EY, k - j]
            vx, vy = share * vx, share * vy
        w = share * (rx * x + ry * y - q) + (share * gx * ex + share * gy * ey)
        b[VX, k + 1], b[VY, k + 1], b[W, k + 1] = vx, vy, w
        before, last = last, abs(vx) + abs(vy)
        if last <= tol and before <= tol and k > 1:
            order = k + 1
            break
        older = side = 0.0
        for j in range(2, k + 1):
            older += b[W, j] * b[EX, k + 1 - j]
            side += b[W, j] * b[EY, k + 1 - j]
        x, y = ex, ey
        if k == 0:
            first, ux, uy = w, ex * inverse, ey * inverse
            ex, ey = (vx - w * x) * inverse, (vy - w * y) * inverse
            kx, ky, q = rx, ry, rc
        else:
            ex = (vx - older - first * x) * inverse - w * ux
            ey = (vy - side - first * y) * inverse - w * uy
            kx = ky = q = 0.0
        b[EX, k + 1], b[EY, k + 1] = ex, ey
    part = _part(order, before, last, tol)
    ratio = part * (abs(b[VX, 1]) + abs(b[VY, 1])) * inverse
    return order, part, _left_out(order, part, max(last, part * before), ratio)


@njit
def _creeping(w, gx, gy, rx, ry, c, rc, span, tol, most, law, b):
    """Series of a slow slip, w >= 0, whose direction has settled near that of G.

    A slow block turns into the direction of G within about w / G, far less than a step. What is
    left is the series that solves (w e)' + q e = G across G0 for the coefficient of q e instead of
    that of (w e)'. From rest, w = 0, that is explicit: it is the beginning of a slip, where it
    converges after a jump of G and is asymptotic (its terms fall at first) at an onset. For w > 0
    the next coefficient of e comes in, small; it is taken from the sweep before.

    Returns as `_sliding`; 0 of the span where the sweeps do not settle.
    """
    g = math.sqrt(gx * gx + gy * gy)
    ux, uy = gx / g, gy / g
    rp, rn = rx * ux + ry * uy, ry * ux - rx * uy
    for k in range(most + 2):
        b[EY, k] = b[W, k] = 0.0
    b[EX, 0], b[W, 0] = 1.0, w
    before = last = change = np.inf
    order, part, left_out, top = most, 0.0, 0.0, 1 if law is None else most
    for _ in range(SWEEPS):
        change_before, change, first = change, 0.0, 0.0
        for k in range(order):
            _friction(k, b, c, rc, law)
            if k == 0:
                first = span * (g * b[EX, 0] - b[Q, 0])
                if w == 0.0:
                    first = max(first, 0.0)  # at an onset: what is left is rounding
            side = span * rn if k == 1 else 0.0
            for j in range(1, min(k, top) + 1):
                side -= span * b[Q, j] * b[EY, k - j]
            turned = w * b[EY, k + 1]
            for j in range(2, k + 2):
                turned += b[W, j] * b[EY, k + 1 - j]
            settles = (k + 1) * first + span * b[Q, 0]
            if not settles > 0.0:
                return order, 0.0, 0.0
            ey = (side - (k + 1) * turned) / settles
            change = max(change, abs(ey - b[EY, k]))
            b[EY, k] = ey
            if k == 0:
                b[EX, 0] = math.sqrt(max(1.0 - ey * ey, 0.25))
            else:
                total = ey * b[EY, 0]
                for j in range(1, k):
                    total += 0.5 * (b[EX, j] * b[EX, k - j] + b[EY, j] * b[EY, k - j])
                b[EX, k] = -total / b[EX, 0]
            before = last
            last = _advance(k, b, g, 0.0, rp, rn, span, law)
            if k == 0 and w == 0.0:
                b[W, 1] = b[VX, 1] = first
            if order == most and last <= tol and before <= tol and k > 1:
                order = k + 1
                break
        if w == 0.0 or change * (w + abs(b[W, 1])) <= 0.1 * tol:
            part = _part(order, before, last, tol)
            ratio = part * last / before if before > 0.0 else 0.0
            left_out = _left_out(order, part, max(last, part * before), ratio)
            break
        if change > 0.5 * change_before:
            break
    b[VX, 0], b[VY, 0] = w * b[EX, 0], w * b[EY, 0]
    for k in range(order + 1):
        along = b[VX, k]
        b[VX, k] = along * ux - b[VY, k] * uy
        b[VY, k] = along * uy + b[VY, k] * ux
    return order, part, left_out


@njit
def _series(w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, most, slow, law, b):
    """The series of a step and its unit of time: a creeping one where that serves; rates in 1/s.

    Returns its degree, how much of its unit it is good for, that unit, and its error in v.
    """
    hard = slow * c
    if (w == 0.0 and (c > 0.0 or rc > 0.0)) or (
        w > 0.0
        and hard * left > STIFF * w
        and gx * vx + gy * vy > 0.9 * w * math.sqrt(gx * gx + gy * gy)
    ):
        few = min(most, CREEP_ORDER)
        order, part, miss = _creeping(
            w, gx, gy, rx * left, ry * left, c, rc * left, left, tol, few, law, b
        )
        if w > 0.0 and part > 0.0:
            # Until it turns, within w / (mu N), the block goes astray by the difference.
            off = math.sqrt((vx - b[VX, 0]) ** 2 + (vy - b[VY, 0]) ** 2)
            off *= w / (hard * part * left) + off / w
            part, miss = part if off <= tol else 0.0, miss + off
        if part > 0.0:
            return order, part, left, miss
    span = left
    if w > 0.0 and hard > 0.0:
        ax, ay = gx - hard * vx / w, gy - hard * vy / w
        square = max(ax * ax + ay * ay, 0.04 * hard * hard)
        if square * left * left > 4.0 * w * w:
            span = 2.0 * w / math.sqrt(square)
    order, part, miss = _sliding(
        w, vx, vy, gx, gy, rx * span, ry * span, c, rc * span, span, tol, most, law, b
    )
    return order, part, span, miss


@njit
def _value(b, first, order, part):
    """The sum of b[E, k] part^(k - first) from `first` on, and its slope."""
    total, slope = b[E, order], 0.0
    for k in range(order - 1, first - 1, -1):
        slope = slope * part + total
        total = total * part + b[E, k]
    return total, slope


@njit
def _place(b, order, part, span):
    """The way in a part of a step, and v there."""
    way = aside = vx = vy = 0.0
    for k in range(order, -1, -1):
        vx, vy = vx * part + b[VX, k], vy * part + b[VY, k]
        way = way * part + b[VX, k] * b[SHARE, k]
        aside = aside * part + b[VY, k] * b[SHARE, k]
    return way * part * span, aside * part * span, vx, vy


@njit
def _keeps_sign(b, first, order, part):
    """Whether no terms of a series together could outweigh its first."""
    sign, least, power = (1.0 if b[E, first] > 0.0 else -1.0), abs(b[E, first]), 1.0
    for k in range(first + 1, order + 1):
        power *= part
        least += min(sign * b[E, k] * power, 0.0)
    return least > 0.0


@njit
def _zero(b, order, begin, part):
    """Where the series in row E changes sign after `begin` for the first time, or -1: up to `part`.

    It is looked at in some places, close together at both ends; between two from which it falls to
    both sides towards zero, at its least. The root is found by the Illinois method.
    """
    first, side = 0, 0
    while first < 2 and b[E, first] == 0.0:
        first += 1
    if begin == 0.0 and _keeps_sign(b, first, order, part):
        return -1.0
    low = high = begin
    at_high, slope = _value(b, first, order, begin)
    at_low, up = at_high, at_high > 0.0
    for m in range(1, SCAN + 1):
        x = m / SCAN
        low, at_low, falls = high, at_high, (slope < 0.0) == up
        high = begin + (part - begin) * (x * x * (3.0 - 2.0 * x))
        at_high, slope = _value(b, first, order, high)
        if (at_high > 0.0) == up and falls and (slope > 0.0) == up:
            left, right, there = low, high, at_high
            while (there > 0.0) == up and right - left > 1e-12 * part:
                at = 0.5 * (left + right)
                there, tilt = _value(b, first, order, at)
                if (tilt > 0.0) == up:
                    right = at
                else:
                    left = at
            if (there > 0.0) != up:
                high, at_high = at, there
        if (at_high > 0.0) != up:
            break
    if (at_high > 0.0) == up:
        return -1.0
    for _ in range(60):
        if not (high - low > 1e-13 * high and at_low != at_high):
            break
        at = (low * at_high - high * at_low) / (at_high - at_low)
        found, _ = _value(b, first, order, at)
        # The end that stays counts half from its second time on.
        if (found > 0.0) == (at_high > 0.0):
            at_low *= 0.5 if side == 1 else 1.0
            high, at_high, side = at, found, 1
        else:
            at_high *= 0.5 if side == -1 else 1.0
            low, at_low, side = at, found, -1
    return high


@njit
def _close(vx, vy, gx, gy, rx, ry, c, rc):
    """The rest of the way to a stop if G and q stayed as they are; rates for each second.

    With psi the angle from G to v: (w (q + G cos psi))' = G^2 - q^2 gives the time; the ways along
    and across G follow from the derivatives of w^2 (G + 2 q cos psi + G cos^2 psi) and of
    w^2 sin psi (2 q + G cos psi), written without dividing by G.

    Returns the time, the way and a bound of its error; inf, 0, 0, inf where it may not stop.
    """
    never = (np.inf, 0.0, 0.0, np.inf)
    g = math.sqrt(gx * gx + gy * gy)
    if not c > g:
        return never
    w, along = math.sqrt(vx * vx + vy * vy), gx * vx + gy * vy
    less, more = c * c - g * g, 4.0 * c * c - g * g
    time, lag = (c * w + along) / less, (2.0 * c * w + along) / more
    change = (math.sqrt(rx * rx + ry * ry) + abs(rc)) * time / (c - g)
    if change > 0.3:
        return never
    pull = (w * w + 3.0 * along * lag) / (4.0 * less)
    return time, lag * vx + pull * gx, lag * vy + pull * gy, change * w * time


@njit
def _see(sx, sy, t, cs, top):
    """Look at one place of the block."""
    square = cs * cs * sx * sx + sy * sy
    if square > top[0] * top[0]:
        top[0], top[1] = math.sqrt(square), t
    top[2], top[3] = max(top[2], sx), min(top[3], sx)
    top[4], top[5] = max(top[4], sy), min(top[5], sy)


@njit
def _stays(b, order, part, along, across, extra):
    """Whether (along, across) . v keeps its sign in a step, even if `extra` goes against it."""
    least, power = along * b[VX, 0] + across * b[VY, 0], 1.0
    sign = 1.0 if least > 0.0 else -1.0
    least = abs(least) - extra
    for k in range(1, order + 1):
        power *= part
        least += min(sign * (along * b[VX, k] + across * b[VY, k]) * power, 0.0)
    return least > 0.0


@njit
def _look(b, order, part, cs, sx, sy, far, w, moved, span, t, top):
    """Look at the places inside a step where an extreme may be: none matters out of reach."""
    scale, fast = cs * cs, w + moved
    reach = span * part * fast
    for kind in range(3):
        extra = 0.0
        if kind == 0:
            # u . v in plan, whose sign is that of the rate of the distance. What u gains in a step
            # that turns by less than 90 deg cannot bring it back.
            along, across = scale * sx, sy
            matters = far + reach > top[0]
            if moved >= w or along * b[VX, 0] + across * b[VY, 0] < 0.0:
                extra = reach * fast
        elif kind == 1:
            along, across = 1.0, 0.0
            matters = sx + reach > top[2] or sx - reach < top[3]
        else:
            along, across = 0.0, 1.0
            matters = sy + reach > top[4] or sy - reach < top[5]
        if not matters or _stays(b, order, part, along, across, extra):
            continue
        # The place is a degree above v, so the product of both is of twice that and one.
        degree = 2 * order + 1 if kind == 0 else order
        for k in range(degree + 1):
            b[E, k] = along * b[VX, k] + across * b[VY, k] if k <= order else 0.0
            for j in range(max(k - 1 - order, 0), min(order + 1, k) if kind == 0 else 0):
                each = scale * b[VX, j] * b[VX, k - 1 - j] + b[VY, j] * b[VY, k - 1 - j]
                b[E, k] += span * b[SHARE, j] * each
        at = _zero(b, degree, 0.0, part)
        while at > 0.0:
            way, aside, _, _ = _place(b, order, at, span)
            _see(sx + way, sy + aside, t + span * at, cs, top)
            at = _zero(b, degree, at, part)


@njit
def _hides(sx, sy, vx, vy, gx, gy, cs, reach, top):
    """Whether an extreme may be on the way to a stop, while v turns into the direction of G."""
    scale = cs * cs
    before, after = scale * sx * vx + sy * vy, scale * sx * gx + sy * gy
    return (
        (before * after < 0.0 and math.sqrt(scale * sx * sx + sy * sy) + reach > top[0])
        or (vx * gx < 0.0 and (sx + reach > top[2] or sx - reach < top[3]))
        or (vy * gy < 0.0 and (sy + reach > top[4] or sy - reach < top[5]))
    )


@njit
def _sample(ax, ay, az, i, p, q):
    """G and c at sample i."""
    if az is None:
        return p[0] - p[2] * ax[i], p[3] * ay[i], q[0] + q[2] * ax[i]
    return p[0] + p[1] * az[i] - p[2] * ax[i], p[3] * ay[i], q[0] + q[1] * az[i] + q[2] * ax[i]


@njit
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


@njit
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


@njit
def _onset(gx, gy, c, hx, hy, d):
    """When, of an interval from 0 to 1, |G| first exceeds c; 0 at once, 2 for never.

    |G| - c is convex: it leaves zero upwards once at most. G goes from g to h, c from c to d.
    """
    rx, ry, rc = hx - gx, hy - gy, d - c
    half = gx * rx + gy * ry - c * rc
    push = gx * gx + gy * gy - c * c
    # Beyond by a rounding, as after a stop, but not for long: still at rest.
    if push > 0.0 and not (half < 0.0 and push < 1e-15 * c * c):
        return 0.0
    if hx * hx + hy * hy <= d * d:
        return 2.0
    square = rx * rx + ry * ry - rc * rc
    root = math.sqrt(max(half * half - square * push, 0.0))
    return min(-push / (half + root) if half > 0.0 else (root - half) / square, 1.0)


@njit
def _note(events, n, t, kind, sx, sy):
    """Write event n, where there is room, and return how many there are."""
    if n < events.shape[0]:
        events[n, 0], events[n, 1], events[n, 2], events[n, 3] = t, kind, sx, sy
    return n + 1


@njit
def _fill(history, i, end, sx, sy, vx, vy):
    """Write samples i to end - 1."""
    for k in range(i, min(end, history.shape[1])):
        history[0, k], history[1, k], history[2, k], history[3, k] = sx, sy, vx, vy


@njit(cache=True, nogil=True)
def slide_plane(
    ax, ay, az, x, y, z, dt, sn, cs, mu, g, scale, tolerance, most, law, events, history, top, end
):
    """Follow the linearly interpolated record event by event, each step to a tolerance.

    Two blocks under one motion never part faster than they do: friction is monotone, so the error
    in the speed at any time is at most the sum of those of the steps before (Brezis, Operateurs
    maximaux monotones, 1973, lemma 3.1), and at rest it is gone. The error in place is at most
    the integral of that. Where friction falls with speed it may grow, no faster than mu'; where
    it falls at the breakaway, a stop more or less makes a jump that no bound sees.

    Parameters
    ----------
    az : array, shape (n,), or None
        None for no vertical shaking; another version is compiled for it.
    x, y, z : array
        `bounds` of ax, ay and az (None where az is).
    mu : float
        Friction coefficient; 1 where there is a law.
    tolerance : float
        Of a step, relative to the largest speed so far.
    most : int
        Largest degree of a series, from 4 to `ORDER`.
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
        A bound of the error of every place, numbers of stops, of events and of steps.
    """
    p = (sn * g, sn * scale, cs * scale, -scale)
    q = (mu * cs * g, mu * cs * scale, mu * sn * scale)
    free = law is None and mu == 0.0
    hold = 1.0 if law is None else law[3]
    slow = 1.0 if law is None else law[0] - law[1]
    grows = 0.0 if law is None else max(-law[1] * law[2], 0.0)
    tolerance = max(tolerance, LEAST_TOLERANCE)
    b = np.empty((8, 2 * ORDER + 2))
    for k in range(ORDER + 2):
        b[SHARE, k] = 1.0 / (k + 1)
    for k in range(6):
        top[k] = 0.0
    sx = sy = vx = vy = tau = fastest = since = off = error = 0.0
    moving = False
    # Not literals: for those, numba would compile what takes them once more.
    i, n_events = np.int64(0), np.int64(0)
    n_stops = n_steps = 0
    last = ax.size - 1
    _fill(history, i, i + 1, 0.0, 0.0, 0.0, 0.0)
    while i < last:
        if not moving:
            first = _next_push(ax, ay, az, x, y, z, i, p, q, hold)
            _fill(history, i + 1, min(first, last + 1), sx, sy, 0.0, 0.0)
            i = max(i, first - 1)
            if i >= last:
                break
        g0x, g0y, c0 = _sample(ax, ay, az, i, p, q)
        hx, hy, d = _sample(ax, ay, az, i + 1, p, q)
        rx, ry, rc = (hx - g0x) / dt, (hy - g0y) / dt, (d - c0) / dt
        tau = 0.0
        while tau < dt:
            gx, gy, c, left = g0x + rx * tau, g0y + ry * tau, c0 + rc * tau, dt - tau
            w = math.sqrt(vx * vx + vy * vy)
            if not moving:
                pull = math.sqrt(gx * gx + gy * gy)
                onset = _onset(gx, gy, hold * c, hx, hy, hold * d)
                # The true block has stopped too once friction has taken the error of its speed.
                h = left * min(onset, 1.0)
                error += off * h
                off = max(0.0, off - 0.5 * max(slow * c - pull, 0.0) * h)
                if onset > 1.0:
                    break
                moving = True
                tau += left * onset
                if g0x + rx * tau == 0.0 and g0y + ry * tau == 0.0:
                    tau += 1e-6 * (dt - tau)  # weight and drive vanish together: no direction yet
                n_events = _note(events, n_events, i * dt + tau, SLIP, sx, sy)
                continue
            t = i * dt + tau
            n_steps += 1
            if w == 0.0:
                since = t
                h = max(
                    math.sqrt(hx * hx + hy * hy) - slow * d, math.sqrt(gx * gx + gy * gy) - slow * c
                )
                fastest = max(fastest, 0.5 * left * h)
            fastest = max(fastest, w)
            away = math.sqrt(cs * cs * sx * sx + sy * sy)
            far = max(top[0], away)
            # What is wrong with v counts as long as the slip lasts: about as long as it has so far.
            late = (t - since) * fastest
            tol = tolerance * fastest * (far / (far + late) if far + late > 0.0 else 1.0)
            order, part, span, miss = _series(
                w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, most, slow, law, b
            )
            moved = 0.0
            for k in range(1, order + 1):
                moved += abs(b[VX, k]) + abs(b[VY, k])
            moved *= part
            stop = -1.0
            if moved >= w and not free:
                for k in range(order + 1):
                    b[E, k] = b[W, k]
                stop = _zero(b, order, 0.0, part)
            if part < 1.0 and stop < 0.0 and w > 0.0:
                rest, way, aside, astray = _close(vx, vy, gx, gy, rx, ry, slow * c, slow * rc)
                slack = CLOSE * tolerance * far
                if (
                    rest < left
                    and astray <= slack
                    and (w * rest <= slack or not _hides(sx, sy, vx, vy, gx, gy, cs, w * rest, top))
                ):
                    tau, sx, sy = tau + rest, sx + way, sy + aside
                    error += astray + off * rest
                    vx, vy, moving = 0.0, 0.0, False
                    n_stops += 1
                    n_events = _note(events, n_events, i * dt + tau, STOP, sx, sy)
                    _see(sx, sy, i * dt + tau, cs, top)
                    continue
            part = stop if stop >= 0.0 else part
            h = span * part
            off += miss + ROUNDING * (abs(gx) + abs(gy) + hold * c) * h
            if grows > 0.0:
                off *= math.exp(grows * c * h)
            error += off * h
            way, aside, vx, vy = _place(b, order, part, span)
            _look(b, order, part, cs, sx, sy, away, w, moved, span, t, top)
            sx, sy = sx + way, sy + aside
            _see(sx, sy, t + h, cs, top)
            # Where the step is lost in rounding, time must pass all the same.
            whole = part == 1.0 and span == left
            tau = dt if whole else max(tau + h, tau * (1.0 + 2.3e-16) + 2.3e-308)
            slower = math.sqrt(vx * vx + vy * vy)
            if stop >= 0.0 or (slower <= tol and slower < w and not free):
                off += slower
                vx, vy, moving = 0.0, 0.0, False
                n_stops += 1
                n_events = _note(events, n_events, i * dt + tau, STOP, sx, sy)
        i += 1
        _fill(history, i, i + 1, sx, sy, vx, vy)
    end[0], end[1], end[2], end[3] = sx, sy, vx, vy
    return error, n_stops, n_events, n_steps
