"""A block that slides in two axes on a shaken roof, jitted: power series from event to event.

    ax = 0, 4, -4, 0, 0, 0 m/s2 at 0.1 s, ay half of it, flat roof, mu = 0.2
    slip at 0.0439 s, stop at 0.1767 s, (sx, sy) = (-6.60, -3.30) mm, where it slips again at once
    stop at 0.3315 s, (sx, sy) = (2.16, 1.08) mm

Never raises, knows no units but SI; numpy and numba only. Read `slide_plane`, then `_sliding` and
`_creeping`; `solver.sliding.two_axes` explains the results. `tests/plane_oracle.py` follows the
same block in plain Python, by SciPy's DOP853.

Model, per unit mass, in roof axes (downslope, cross-slope):
    N = (g + az) cos(theta) + ax sin(theta)                       normal force, Eq. 6 with az
    G = ((g + az) sin(theta) - ax cos(theta), -ay)                drive
    v' = G - mu N v / |v|  while sliding;  at rest while |G| <= mu N
G and N are linear between samples. With constant mu the only nonlinear term is the direction
e = v / |v|. The power series in time of v, e and w = |v| are computed from each other, coefficient
by coefficient, with
    v' = G - q e     w' = G . e - q     w e = v                   q = mu N
The series of v converges up to a time of about w / |v'|, in which the block could stop. Each series
has its own axes: along the motion (or along the drive), and across, 90 deg to the left.

Letters:
    ax, ay, az  acceleration of the plane: horizontal (right), cross-slope, vertical (up) [m/s2]
    x, y, z     `one_axis.bounds` of ax, ay and az
    scale       factor on ax, ay and az (`solver.model.Accelerations`)
    g, sn, cs   acceleration of gravity; sine and cosine of theta, positive down to the right
    sx, sy      distance slid downslope and cross-slope; in plan (sx cos(theta), sy)      [m]
    vx, vy, w   their rates, and the speed                                                [m/s]
    gx, gy, c   G, and mu N (or N, if a law gives mu)                                     [m/s2]
    hx, hy, d   the same at the end of an interval                                        [m/s2]
    rx, ry, rc  rates of gx, gy, c per second or per unit of time of a series  [m/s3] or [m/s2]
    ux, uy      unit vector of a series' axis along; ga, gs and ra, rs: G and its rate, along and
                across
    p, q        in `slide_plane`: coefficients of 1, az and ax in gx and in c; p[3]: of ay in gy
    slow, hold  mu at zero speed while sliding and at rest, / the mu in c (both 1 without a law)
    span, part  unit of time of a series [s]; fraction of it that a step uses
    b           series, as coefficients of (time / span)^k: rows VA and VS of v and EA and ES of e,
                along and across; W of w; Q of q; E of the exponential of a law, or work space;
                ROOTS: sign changes found; SHARE: 1 / (k + 1); RISE: k times row W
    swell       bound of the change of a law's exponent rate w in a step: the terms of its series
                decrease only from that degree on
    law         None, or mu_fast, mu_fast - mu_slow, rate [s/m] and mu at rest (`slide_plane`)
    moved       bound of the change of v in a step                                        [m/s]
    off, error  bounds of the error in velocity [m/s] and in position [m] so far
    top         largest distance in plan, its time; largest and least sx; largest and least sy;
                largest speed
"""

import math
from functools import partial

import numpy as np
from numba import njit

from solver.kernels.compiler import INNER, KEPT

# Division by zero gives infinity, as in IEEE arithmetic: numba adds no test and raises nothing.
# Without `_nrt` no reference is counted: every function but `slide_plane` borrows its arrays, and
# locked counters took a tenth of the time.
# All in one file, long as it is: numba keeps `slide_plane` compiled until this file changes, and
# would run a former version of a function that changed in another.
ieee = partial(njit, error_model="numpy")
jit = partial(ieee, **INNER)

# How a run ends.
FOLLOWED = 0
TOO_MANY_STEPS = 1
NOT_FINITE = 2

# Kinds of event.
SLIP = 1.0
STOP = 0.0

ORDER = 20
CREEP_ORDER = 12
# np.int64, because for literals numba compiles what takes a row once for each of them.
VA, VS, EA, ES, W, Q, E, SHARE, ROOTS, RISE = map(np.int64, range(10))
ONE, MOST = np.int64(1), np.int64(ORDER)

# Samples in a block of `kernels.bounds`.
SHIFT = 4

# Tolerance of a step below which rounding error dominates.
LEAST_TOLERANCE = 1e-14

EPS = 2.0**-52

# Rounding error of drive and friction / sum of the absolute values of their terms.
ROUNDING = 4.0 * EPS

# Net push on a block at rest that rounding error alone may produce / the same sum.
DEAD = 8.0 * EPS

# One micrometer [m]: the tolerance is relative to the largest distance, or to this if larger.
SMALL = 1e-6

# Error in position accepted from a closed-form stop (`_close`) / (tolerance x distance).
CLOSE = 3.0

# Error in velocity / tolerance of a step above which the step is shortened.
SLACK = 16.0

# Largest number of iterations in `_creeping`.
SWEEPS = 12

# Number of points of a series at which its sign is checked.
SCAN = 8

# Largest change of a friction law's exponent in a step: from that degree on its terms decrease.
SWELL = 5.0

# Largest creeping step with a friction law, in time constants of the speed, 1 / (dq/dw).
SETTLES = 2.0

# Exponent beyond which a friction law equals its fast coefficient within rounding error.
FADED = 40.0

# Less than 1 by more than the relative rounding error of the square of a ratio of forces.
NEARLY = 1.0 - 1e-12

# Step / time in which the direction settles, above which `_creeping` is tried.
STIFF = 300.0


@jit()
def _friction(k, b, c, rc, law):
    """Write coefficient k of q. With a law q = c (mu_fast - E), where E = drop exp(-rate w)."""
    if law is None:
        b[Q, k] = c if k == 0 else (rc if k == 1 else 0.0)
    elif k == 0:
        b[E, 0] = law[1] * math.exp(-law[2] * b[W, 0])
        b[Q, 0] = c * (law[0] - b[E, 0])
    else:
        # From E' = -rate w' E, coefficient by coefficient.
        total = 0.0
        for j in range(1, k + 1):
            total += j * b[W, j] * b[E, k - j]
        b[E, k] = -law[2] * total / k
        b[Q, k] = -c * b[E, k] + rc * ((law[0] if k == 1 else 0.0) - b[E, k - 1])


@jit()
def _advance(k, b, ga, gs, ra, rs, span, law):
    """Write coefficient k + 1 of v and w from those of e and q up to k; return |v|, of that one."""
    along = across = push = 0.0
    # Without a law q is linear in time, as G is: two coefficients.
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
    """Fraction of the span at which the last two terms of a series fall below tol."""
    # The two terms are of degree order - 1 and order: at a fraction f they fall to f^(order - 1) or
    # less.
    size = max(before, last)
    return 1.0 if size <= tol else math.exp(math.log(tol / size) / (order - 1))


@jit(forceinline=True)
def _begin(w, ga, gs, ra, rs, c, rc, span, law, b):
    """Write coefficients 0 and 1 of a sliding series; return 1 / w and (1 / w) W[1]."""
    # 0 without friction, where the block may have no speed.
    inverse = 1.0 / w if c > 0.0 or rc > 0.0 else 0.0
    b[VA, 0], b[VS, 0], b[W, 0], b[EA, 0], b[ES, 0] = w, 0.0, w, 1.0, 0.0
    _friction(0, b, c, rc, law)
    _advance(0, b, ga, gs, ra, rs, span, law)
    # |e| = 1: at first it turns, without a component along itself.
    b[EA, 1], b[ES, 1] = 0.0, inverse * b[VS, 1]
    return inverse, inverse * b[W, 1]


@jit(forceinline=True)
def _sliding(w, ga, gs, ra, rs, c, rc, span, tol, maximum_degree, b):
    """Series of a sliding block, constant mu, w > 0 or no friction; its degree, usable fraction."""
    # A coefficient of e depends on the one before through a single product; the processor computes
    # the other sums meanwhile and does not wait for them.
    inverse, slows = _begin(w, ga, gs, ra, rs, c, rc, span, None, b)
    ea, es, ea_before, es_before = 0.0, b[ES, 1], 0.0, 0.0
    # Contribution of the constant term of e, (1, 0), which is therefore not in ea_before.
    kick, turn = ra - rc, rs
    before, last = np.inf, abs(b[VA, 1]) + abs(b[VS, 1])
    order = maximum_degree
    for k in range(1, maximum_degree):
        n, share = np.uintp(k + 1), span * b[SHARE, np.uintp(k)]
        older = side = 0.0
        for j in range(2, k + 1):
            each, m = b[W, np.uintp(j)], np.uintp(k + 1 - j)
            older += each * b[EA, m]
            side += each * b[ES, m]
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
        b[EA, n], b[ES, n] = ea, es
        kick = turn = 0.0
        before, last = last, abs(along) + abs(across)
        if last <= tol and before <= tol and k > 1:
            order = k + 1
            break
    return order, _part(order, before, last, tol)


@jit(forceinline=True)
def _sliding_by_law(w, ga, gs, ra, rs, c, rc, span, tol, maximum_degree, swell, law, b):
    """Compute what `_sliding` does with a friction law, all sums of a degree in one loop."""
    inverse, slows = _begin(w, ga, gs, ra, rs, c, rc, span, law, b)
    ea, es, ea_before, es_before = 0.0, b[ES, 1], 1.0, 0.0
    faded, kick, turn = b[E, 0], ra, rs
    b[RISE, 1] = b[W, 1]
    before, last = np.inf, abs(b[VA, 1]) + abs(b[VS, 1])
    order = maximum_degree
    for k in range(1, maximum_degree):
        n, share = np.uintp(k + 1), span * b[SHARE, np.uintp(k)]
        older = side = ahead = aside = fades = 0.0
        for j in range(2, k + 1):
            m, i = np.uintp(k + 1 - j), np.uintp(j)
            each, rub, x, y = b[W, i], b[Q, np.uintp(j - 1)], b[EA, m], b[ES, m]
            older += each * x
            side += each * y
            ahead += rub * x
            aside += rub * y
            fades += b[RISE, i] * b[E, np.uintp(k - j)]
        # The terms of `_friction` and `_advance` that hold the newest coefficients are added last.
        fades = -law[2] * b[SHARE, np.uintp(k - 1)] * (fades + b[RISE, 1] * faded)
        rub = rc * ((law[0] if k == 1 else 0.0) - faded) - c * fades
        b[E, np.uintp(k)], b[Q, np.uintp(k)], faded = fades, rub, fades
        along = share * (kick - (ahead + rub + b[Q, 0] * ea))
        across = share * (turn - (aside + b[Q, 0] * es))
        w = share * (ga * ea + gs * es + ra * ea_before + rs * es_before - rub)
        b[VA, n], b[VS, n], b[W, n], b[RISE, n] = along, across, w, (k + 1) * w
        ea_before, es_before = ea, es
        ea = inverse * (along - w - older) - slows * ea
        es = inverse * (across - side) - slows * es
        b[EA, n], b[ES, n] = ea, es
        kick = turn = 0.0
        before, last = last, abs(along) + abs(across)
        if last <= tol and before <= tol and k > 1 and k > swell:
            order = k + 1
            break
    return order, _part(order, before, last, tol)


@jit()
def _creeping(w, vs, g, ra, rs, c, rc, span, tol, maximum_degree, swell, law, b):
    """Series of a slow slip, w >= 0, near the direction of G; degree, usable part, error in v."""
    # The equation is stiff for a slow block: its direction approaches that of G within a time of
    # about w / G, much shorter than a step, so `_sliding` would need very short steps. After this
    # transient the motion is smooth. Its series, along and across the initial G, follows from (w
    # e)' + q e = G: the component across is solved for the coefficient of q e instead of that of (w
    # e)'.
    for k in range(maximum_degree + 2):
        b[ES, k] = b[W, k] = 0.0
    b[EA, 0], b[W, 0] = 1.0, w
    before = last = change = np.inf
    order, top = maximum_degree, 1 if law is None else maximum_degree
    # From rest, w = 0, the recurrence is explicit. This is the beginning of a slip; the series
    # converges after a jump of G, and at an onset it is asymptotic (its terms decrease at first).
    # For w > 0 each coefficient of e also depends on the next one, through a small term. The next
    # one is taken from the previous sweep, and sweeps are repeated until the coefficients agree.
    for _ in range(SWEEPS):
        change_before, change, first = change, 0.0, 0.0
        for k in range(order):
            _friction(k, b, c, rc, law)
            if k == 0:
                first = span * (g * b[EA, 0] - b[Q, 0])
                if w == 0.0:
                    first = max(first, 0.0)  # at an onset it is zero, except for rounding error
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
                # A sweep that has not converged may give |es| above 1.
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
            if order == maximum_degree and last <= tol and before <= tol and k > 1 and k > swell:
                order = k + 1
                break
        b[VA, 0], b[VS, 0], off = w * b[EA, 0], w * b[ES, 0], 0.0
        if w > 0.0:
            # The difference decays at the rate q / w. Its effect on v: what remains of it at the
            # end, its mean over the span (for the position), and a second-order term.
            off, most_w, least_q = abs(vs - b[VS, 0]), w, b[Q, 0]
            for k in range(1, order + 1):
                most_w += abs(b[W, np.uintp(k)])
                least_q -= abs(b[Q, np.uintp(k)]) if k < order else 0.0
            turns = max(span * least_q / most_w, 0.0)
            off *= math.exp(-turns) + 1.0 / max(turns, 1.0) + off / w
        if w == 0.0 or change * (w + abs(b[W, 1])) <= 0.1 * tol:
            part = _part(order, before, last, tol)
            off /= part
            # The fraction is 0 if the sweeps do not converge, or if the actual vs differs too much.
            return order, part if off <= tol else 0.0, off
        if change > 0.5 * change_before or off > 10.0 * tol + 4.0 * w * change:
            break
    return order, 0.0, 0.0


@jit(forceinline=True)
def _series(w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, maximum_degree, slow, law, b):
    """Series of a step, by `_creeping` where it applies; degree, part, span, error in v, axis."""
    # The rates rx, ry and rc are per second; `left` is the time to the end of the interval [s]. The
    # error in v is that of `_creeping`; the axis is the direction along.
    hard, g = slow * c, math.sqrt(gx * gx + gy * gy)
    rate = 0.0 if law is None else law[2]
    span = left
    if w > 0.0 and hard * left > STIFF * w:
        # The series expands the direction of G, so its span is limited to the time in which G or
        # friction may change by the magnitude of G.
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
            # In a time t the speed increases by at most push t + rise t^2 / 2. The span is limited
            # to the time in which this may change the law's exponent by SWELL.
            least, gain = min(slow, law[0]), SWELL / rate
            push, rise = max(g - least * c, 0.0), math.sqrt(rx * rx + ry * ry) + least * abs(rc)
            fast = push + math.sqrt(push * push + 2.0 * rise * gain)
            span = 2.0 * gain / fast if fast * span > 2.0 * gain else span
            # The speed of a slow block approaches the value at which friction balances the drive,
            # at the rate dq/dw of the law at rest. This rate limits the span as well.
            settles = rate * abs(law[1]) * max(c, c + rc * span)
            span = SETTLES / settles if settles * span > SETTLES else span
            swell = rate * (w + span * (push + 0.5 * rise * span))
        ux, uy = gx / g, gy / g
        ra, rs = span * (rx * ux + ry * uy), span * (ry * ux - rx * uy)
        few = min(maximum_degree, CREEP_ORDER)
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
        # The exponential of a law may be negligible now and dominate later; no coefficient reveals
        # it. The span is limited to the time for which the exponential certainly stays negligible
        # (`unseen`), or in which its exponent changes by at most SWELL.
        mu = max(slow, law[0])
        maximum_acceleration = g + mu * c + left * (abs(rx) + abs(ry) + mu * abs(rc))
        unseen = (w - FADED / rate) / maximum_acceleration
        span = min(span, max(unseen, SWELL / (rate * maximum_acceleration)))
        swell = rate * maximum_acceleration * span if span > unseen else 0.0
    ra, rs = span * (rx * ux + ry * uy), span * (ry * ux - rx * uy)
    if law is None:
        order, part = _sliding(w, ga, gs, ra, rs, c, rc * span, span, tol, maximum_degree, b)
    else:
        order, part = _sliding_by_law(
            w, ga, gs, ra, rs, c, rc * span, span, tol, maximum_degree, swell, law, b
        )
    return order, part, span, 0.0, ux, uy


@jit()
def _scale(b, order, part):
    """Rescale a series so that the fraction `part` of its unit of time becomes the unit."""
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
    # Gain of v over the new unit, mean of that gain, and derivative of v at its end.
    return along, across, way, aside, along_rate, across_rate, moved


@jit()
def _place(b, order, at):
    """Gain of v up to the time `at`, along and across, and the mean of that gain up to then."""
    along = across = way = aside = 0.0
    for k in range(order, 0, -1):
        n = np.uintp(k)
        along, across = (along + b[VA, n]) * at, (across + b[VS, n]) * at
        way = (way + b[VA, n] * b[SHARE, n]) * at
        aside = (aside + b[VS, n] * b[SHARE, n]) * at
    return along, across, way, aside


@jit()
def _value(b, row, first, order, at):
    """Sum of b[row, k] at^(k - first) over k >= `first`, and its derivative."""
    total, slope = b[row, order], 0.0
    for k in range(order - 1, first - 1, -1):
        slope = slope * at + total
        total = total * at + b[row, np.uintp(k)]
    return total, slope


@jit()
def _zeros(b, row, first, degree):
    """Bound of the number of sign changes of a series in (0, 1]: 0, 1, or 2 if not known."""
    lead, rise = b[row, first], b[row, first + 1]
    sign, way = (1.0 if lead > 0.0 else -1.0), (1.0 if rise > 0.0 else -1.0)
    least, steady, end = abs(lead), abs(rise), lead
    # The leading coefficient less all coefficients of opposite sign bounds |p| from below
    # (`least`), and likewise |p'| (`steady`). If the first is positive, p has no zero. If the
    # second is positive, p is monotone: one zero at most, and none with equal signs at both ends.
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
def _changes(b, row, degree, maximum_count):
    """Write the first `maximum_count` points in (0, 1] where a series changes sign; the count."""
    first = 0
    while first < degree and b[row, first] == 0.0:
        first += 1
    known = _zeros(b, row, first, degree) if first < degree else 0
    if known == 0:
        return 0
    # If `_zeros` shows one change at most, only the sign at 1 is checked. Otherwise it is checked
    # at SCAN points, denser near both ends, and at further points in the first cell from the point
    # up to which the coefficients guarantee the sign (`_keeps`).
    cells, m, n = (SCAN if known > 1 else 1), 1, 0
    near = _keeps(b, row, first, degree) if known > 1 else np.inf
    right, at_right, rise = 0.0, b[row, first], b[row, first + 1]
    while m <= cells and n < maximum_count:
        left, at_left, x = right, at_right, m / cells
        # If the left point is a zero, the derivative there gives the sign to its right.
        up = at_left > 0.0 or (at_left == 0.0 and rise > 0.0)
        falls = (rise < 0.0) == up
        right = x * x * (3.0 - 2.0 * x)
        if near < right:
            right, near = near, 4.0 * near
        else:
            m, near = m + 1, np.inf
        at_right, rise = _value(b, row, first, degree, right)
        beyond = at_right <= 0.0 if up else at_right >= 0.0
        # It decreases toward zero from both points: its extreme between them is checked as well.
        if not beyond and falls and (rise > 0.0) == up:
            middle, there = _least(b, row, first, degree, left, right, up)
            if (there <= 0.0) if up else (there >= 0.0):
                b[ROOTS, n] = _root(b, row, first, degree, left, at_left, middle, there, up)
                n += 1
                if n < maximum_count:
                    b[ROOTS, n] = _root(b, row, first, degree, right, at_right, middle, there, up)
                    n += 1
        elif beyond:
            b[ROOTS, n] = _root(b, row, first, degree, left, at_left, right, at_right, up)
            n += 1
    return n


@jit()
def _keeps(b, row, first, degree):
    """Point up to which the coefficients of a series guarantee its sign; inf: all of cell 1."""
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
    """Point where a series is nearest to zero or beyond it, and its value, by bisection of p'."""
    # From both `left` and `right` the series decreases toward zero; `up` is its sign there.
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
    """Point where a series changes sign, by the Illinois variant of the false-position method."""
    # At `low` the series has the sign `up` (or is zero); at `high` the other one, or it is zero.
    side = 0
    for _ in range(60):
        if at_high == 0.0 or not abs(high - low) > 1e-15 * high:
            break
        share = at_low / (at_low - at_high) if at_low != 0.0 else 0.5
        at = low + share * (high - low)
        value, _ = _value(b, row, first, degree, at)
        # Illinois: the value at an end that is kept a second time is halved.
        if value != 0.0 and (value > 0.0) == up:
            at_high *= 0.5 if side == -1 else 1.0
            low, at_low, side = at, value, -1
        else:
            at_low *= 0.5 if side == 1 else 1.0
            high, at_high, side = at, value, 1
    return high


@jit()
def _rates(b, order, at):
    """v and its derivative, along and across, at the fraction `at` of a step."""
    va = vs = along_rate = across_rate = 0.0
    for k in range(order, 0, -1):
        n = np.uintp(k)
        along_rate, across_rate = along_rate * at + k * b[VA, n], across_rate * at + k * b[VS, n]
        va, vs = (va + b[VA, n]) * at, (vs + b[VS, n]) * at
    return b[VA, 0] + va, b[VS, 0] + vs, along_rate, across_rate


@jit(forceinline=True)
def _excess(va, vs, w, va_rate, vs_rate, tau, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law):
    """Error in velocity that a step of length h makes with a constant defect, that at `tau`."""
    # The truncated series is the exact solution of the equation with an additional acceleration,
    # the defect d = v' - G + q e. Friction is monotone, so the error in velocity is at most the
    # integral of |d|.
    q = c + rc * tau
    if law is not None:
        mu = law[0] - law[1] * math.exp(-law[2] * w)
        q, c = mu * q, min(mu, law[0] - law[1]) * c
    gx, gy, each = gx + rx * tau, gy + ry * tau, 1.0 / h
    da, ds = va_rate * each - (gx * ux + gy * uy), vs_rate * each - (gy * ux - gx * uy)
    each = 1.0 / max(w, 1e-300)
    along, across = abs((da * va + ds * vs) * each + q), abs(ds * va - da * vs) * each
    # Across the motion friction also restores the direction, at the rate q / w, so d acts there for
    # a time of w / q at most; its effect along the motion is of second order.
    least = min(q, c)
    lasts = most_w / least if most_w < h * least else h
    return h * (along + across * (1e-3 if across < 1e-3 * q else 1.0)) + across * lasts


@jit(forceinline=True)
def _miss(
    b, order, va, vs, w, va_rate, vs_rate, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law
):  # fmt: skip
    """Bound of the error in velocity that a step makes, from the defect at its end."""
    # The defect may be zero at the end by chance, so the bound is at least a tenth of the last two
    # terms.
    last, n = np.uintp(order), np.uintp(order - 1)
    least = abs(b[VA, last]) + abs(b[VS, last]) + abs(b[VA, n]) + abs(b[VS, n])
    excess = _excess(va, vs, w, va_rate, vs_rate, h, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law)
    # The defect grows like time to the power `order`, so its integral over the step is its final
    # value times h / (order + 1); five times that is used.
    return max(excess * (5.0 / (order + 1)), 0.1 * least)


@jit()
def _miss_at(b, order, at, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law):
    """The error of `_excess` from the defect at the fraction `at` of a step, near its end."""
    va, vs, va_rate, vs_rate = _rates(b, order, at)
    w, tau = math.sqrt(va * va + vs * vs), at * h
    return _excess(va, vs, w, va_rate, vs_rate, tau, h, gx, gy, rx, ry, ux, uy, c, rc, most_w, law)


@jit()
def _bend(c, w, law):
    """Bound of the difference of q from its value at zero speed, by a law, at speeds up to w."""
    return 0.0 if law is None else abs(law[1]) * (1.0 - math.exp(-law[2] * w)) * c


@jit()
def _close(vx, vy, w, gx, gy, rx, ry, c, rc, bend, slack):
    """Time, displacement and bound of error of a stop in closed form, G and q constant; or inf."""
    never = (np.inf, 0.0, 0.0, np.inf)
    square = gx * gx + gy * gy
    if not c * c > square:
        return never
    # With psi the angle from G to v, (w (q + G cos psi))' = G^2 - q^2 gives the time to the stop.
    # The distances along and across G follow from the derivatives of w^2 (G + 2 q cos psi + G cos^2
    # psi) and of w^2 sin psi (2 q + G cos psi), here written without division by G.
    along, less, more = gx * vx + gy * vy, c * c - square, 4.0 * c * c - square
    time, lag = (c * w + along) / less, (2.0 * c * w + along) / more
    # From the change of G and q during that time (rates per second), and from `bend`, the
    # difference of q from its value at zero speed by a law.
    change = (math.sqrt(rx * rx + ry * ry) + abs(rc)) * time + bend
    change /= c - math.sqrt(square)
    if change > 0.3 or change * w * time > slack:
        return never
    pull = (w * w + 3.0 * along * lag) / (4.0 * less)
    return time, lag * vx + pull * gx, lag * vy + pull * gy, change * w * time


@jit()
def _see(sx, sy, t, cs, top):
    """Update `top` with one position of the block at time t."""
    square = cs * cs * sx * sx + sy * sy
    if square > top[0] * top[0]:
        top[0], top[1] = math.sqrt(square), t
    top[2], top[3] = max(top[2], sx), min(top[3], sx)
    top[4], top[5] = max(top[4], sy), min(top[5], sy)


@jit(forceinline=True)
def _look(b, order, ux, uy, cs, sx, sy, way, aside, vx, vy, w, moved, h, t, top):
    """Update `top` with the positions inside a step where an extreme may occur."""
    # Extremes of sx, sy and the distance are at zeros of their rates. These are searched for only
    # if the step may reach beyond the values in `top`. (vx, vy) is v at the end of the step.
    reach = h * (w + moved)
    for side in range(2):
        place = sx if side == 0 else sy
        along, across = (ux, -uy) if side == 0 else (uy, ux)
        far, near = place + reach > top[2 + 2 * side], place - reach < top[3 + 2 * side]
        if (far or near) and abs(along * b[VA, 0] + across * b[VS, 0]) <= moved:
            for k in range(order + 1):
                b[E, k] = along * b[VA, k] + across * b[VS, k]
            _see_zeros(b, order, order, ux, uy, cs, sx, sy, h, t, top)
    # The rate of the distance in plan has the sign of u . v, with u = (cs^2 sx, sy), which changes
    # by at most `reach` in the step.
    away = math.sqrt(cs * cs * sx * sx + sy * sy)
    if away + reach > top[0]:
        along, across = cs * cs * sx * ux + sy * uy, sy * ux - cs * cs * sx * uy
        end = cs * cs * (sx + way) * vx + (sy + aside) * vy
        if _returns(b, order, along, across, end, away, w, moved, reach, h):
            _rate(b, order, along, across, ux, uy, cs, h)
            _see_zeros(b, order, order + 1, ux, uy, cs, sx, sy, h, t, top)


@jit(forceinline=True)
def _returns(b, order, along, across, end, away, w, moved, reach, h):
    """Whether the distance from the start may be larger inside a step than at both ends."""
    # The change of u is the displacement in the step. If the motion turns by less than 90 deg, this
    # displacement has a positive product with v, so it cannot make u . v negative.
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
    # If u . v only increases, the distance has no maximum inside the step; if it only decreases,
    # there is one if u . v changes sign.
    if rise > 0.0:
        return steady <= reach * swing
    falls = steady > reach * swing + h * (w + moved) * (w + moved)
    return not falls or lead > 0.0 > end


@jit()
def _rate(b, order, along, across, ux, uy, cs, h):
    """Write the series of u . v into row E, a degree more than v; overwrites rows EA and ES."""
    first, second = cs * cs * ux * ux + uy * uy, cs * cs * uy * uy + ux * ux
    both = (1.0 - cs * cs) * ux * uy
    for k in range(order + 1):
        b[EA, k] = h * (first * b[VA, k] + both * b[VS, k])
        b[ES, k] = h * (both * b[VA, k] + second * b[VS, k])
        b[E, k] = along * b[VA, k] + across * b[VS, k]
    # To the degree of u, so that the terms omitted are as small as those omitted in v.
    b[E, order + 1] = 0.0
    for k in range(1, order + 2):
        total = 0.0
        for j in range(k):
            total += b[SHARE, j] * (b[VA, j] * b[EA, k - 1 - j] + b[VS, j] * b[ES, k - 1 - j])
        b[E, k] += total


@jit()
def _see_zeros(b, order, degree, ux, uy, cs, sx, sy, h, t, top):
    """Update `top` with the positions where the series in row E changes sign."""
    for k in range(_changes(b, E, degree, MOST)):
        at = b[ROOTS, k]
        _, _, way, aside = _place(b, order, at)
        way, aside = h * at * (b[VA, 0] + way), h * at * (b[VS, 0] + aside)
        _see(sx + way * ux - aside * uy, sy + way * uy + aside * ux, t + h * at, cs, top)


@jit(forceinline=True)
def _see_speed(b, order, w, after, moved, top):
    """Update `top` with the largest speed of a step: at its end, or where v . v' changes sign."""
    top[6] = max(top[6], after)
    if w + moved > top[6]:
        for k in range(order):
            b[E, k] = 0.0
            for j in range(k + 1):
                m, n = np.uintp(j), np.uintp(k + 1 - j)
                b[E, k] += (k + 1 - j) * (b[VA, m] * b[VA, n] + b[VS, m] * b[VS, n])
        for k in range(_changes(b, E, order - 1, MOST)):
            va, vs, _, _ = _rates(b, order, b[ROOTS, k])
            top[6] = max(top[6], math.sqrt(va * va + vs * vs))


@jit()
def _hides(sx, sy, vx, vy, gx, gy, cs, reach, top):
    """Whether an extreme may occur on the way to a stop, while v turns toward G."""
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
    return p[0] + p[1] * az[i] - p[2] * ax[i], p[3] * ay[i], q[0] + q[1] * az[i] + q[2] * ax[i]


@ieee(cache=KEPT, nogil=True)
def friction_demand(ax, ay, az, sn, cs, g, scale):
    """Largest |G| / N of the samples; inf if N is zero or negative at one."""
    demand = most = 0.0
    for i in range(ax.size):
        along, weight = scale * ax[i], g + scale * az[i]
        normal = weight * cs + along * sn
        if not normal > 0.0:
            return np.inf
        down, across = weight * sn - along * cs, scale * ay[i]
        # The ratio is needed only where it may be the largest: products, which are faster, tell.
        if down * down + across * across >= most * (normal * normal):
            demand = max(demand, math.hypot(down, across) / normal)
            most = NEARLY * (demand * demand)
    return demand


@jit()
def _terms(x, y, z, p, q, most):
    """Bound of the sum of |terms| of G and friction, to which rounding error is relative."""
    along, across = max(-x[0, -1], x[1, -1]), max(-y[0, -1], y[1, -1])
    up = max(-z[0, -1], z[1, -1])
    drive = abs(p[0]) + abs(p[1]) * up + abs(p[2]) * along + abs(p[3]) * across
    return drive + most * (abs(q[0]) + abs(q[1]) * up + abs(q[2]) * along)


@jit()
def _is_quiet(x, y, z, block, p, q, hold):
    """Whether no sample of a block of samples can make the resting block slip."""
    # Rounding is monotone: what is computed from bounds bounds what is computed from samples.
    first, other = p[2] * x[0, block], p[2] * x[1, block]
    up, down = p[1] * z[0, block], p[1] * z[1, block]
    low, high = p[0] + min(up, down), p[0] + max(up, down)
    least = q[0] + min(q[1] * z[0, block], q[1] * z[1, block])
    ahead = max(abs(low - max(first, other)), abs(high - min(first, other)))
    aside = p[3] * max(abs(y[0, block]), abs(y[1, block]))
    least = hold * (least + min(q[2] * x[0, block], q[2] * x[1, block]))
    return least >= 0.0 and ahead * ahead + aside * aside <= least * least


@jit()
def _next_slip(ax, ay, az, x, y, z, i, p, q, hold):
    """First sample from i on at which the resting block slips, or n."""
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
    """First time, 0 to 1, at which |G| exceeds c, both linear to (hx, hy) and d; 2 for never."""
    rx, ry, rc = hx - gx, hy - gy, d - c
    # |G| - c is convex in time, so it crosses zero upward at most once.
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
    """Rest until |G| exceeds friction beyond rounding; onset / `left` (2: never), error, off."""
    # A push within `dead` may be rounding error: it makes no slip, but its effect counts in `off`.
    onset = _onset(gx, gy, hold * c + dead, hx, hy, hold * d + dead)
    pull, h = math.sqrt(gx * gx + gy * gy), left * min(onset, 1.0)
    error += off * h
    # The exact block may still move, with a speed of at most `off`, until friction stops it.
    # Friction reduces that speed at the rate q - |G|, which is concave in time and not negative at
    # the end of the rest. Its integral is therefore at least half its initial value times the
    # duration.
    off = max(0.0, off - 0.5 * max(slow * c - pull, 0.0) * h)
    if pull > hold * c or math.sqrt(hx * hx + hy * hy) > hold * d:
        off += dead * h
    return onset, error, off


@jit()
def _net_driving(gx, gy, c, hx, hy, d):
    """The larger net push, |G| less friction, of two samples."""
    return max(math.sqrt(hx * hx + hy * hy) - d, math.sqrt(gx * gx + gy * gy) - c)


@jit()
def _note(events, n, t, kind, sx, sy):
    """Write event n, if there is room, and return the number of events."""
    if n < events.shape[0]:
        # No rounding puts it before the last one.
        t = max(t, events[n - 1, 0]) if n else t
        events[n, 0], events[n, 1], events[n, 2], events[n, 3] = t, kind, sx, sy
    return n + 1


@jit()
def _fill(history, i, end, sx, sy, vx, vy):
    """Write the same state into samples i to end - 1."""
    for k in range(i, min(end, history.shape[1])):
        history[0, k], history[1, k], history[2, k], history[3, k] = sx, sy, vx, vy


@ieee(cache=KEPT, nogil=True)
def slide_plane(
    ax, ay, az, x, y, z, dt, sn, cs, mu, g, scale, tolerance, maximum_degree, maximum_steps, law,
    events, history, top, end,
):  # fmt: skip
    """Solve the motion under the linearly interpolated record event by event, to a tolerance.

    The error bound: friction is monotone, so the difference of the velocities of two blocks under
    one motion never increases. The error in velocity is therefore at most the sum of the errors
    made in the steps before (Brezis, Operateurs maximaux monotones, 1973, lemma 3.1), and it
    vanishes at rest. The distance between two blocks grows no faster than the difference of their
    velocities, so the error in position is at most the integral of the error in velocity. Rounding
    error of the drive counts as an additional acceleration; rounding error of positions is added
    directly. If friction decreases with velocity or at breakaway, none of this is a bound.

    Returns FOLLOWED, TOO_MANY_STEPS or NOT_FINITE; the bound of the error in position [m]; numbers
    of stops, of events and of steps. Fills `events`, shape (m, 4), with time, kind, sx and sy of
    the first m; `history`, shape (4, n) or (4, 0), with sx, sy, vx and vy at the samples; `top` and
    `end`, the same four at the end.
    """
    # ax, ay, az are zeros for no shaking: for None another version would take 20 s to compile.
    # mu is 1 with a law: mu(w) = law[0] - law[1] exp(-law[2] w) while sliding, and law[3] >= mu(0)
    # at rest. The tolerance of a step is relative to the largest speed so far, that of a slip to
    # the largest distance; the degree of a series is from 4 to ORDER.
    # G = ((g + az) sin(theta) - ax cos(theta), -ay): coefficients of 1, az, -ax and ay.
    p = (sn * g, sn * scale, cs * scale, -scale)
    # c = mu N = mu ((g + az) cos(theta) + ax sin(theta)): coefficients of 1, az and ax.
    q = (mu * cs * g, mu * cs * scale, mu * sn * scale)
    hold = 1.0 if law is None else law[3]
    slow = 1.0 if law is None else law[0] - law[1]
    terms = _terms(x, y, z, p, q, 1.0 if law is None else max(hold, slow, law[0]))
    dead, least = DEAD * terms, EPS * dt
    tolerance = max(tolerance, LEAST_TOLERANCE)
    b = np.empty((10, ORDER + 2))
    for k in range(ORDER + 2):
        b[SHARE, k] = 1.0 / (k + 1)
    for k in range(7):
        top[k] = 0.0
    sx = sy = vx = vy = w = tau = fastest = since = off = error = 0.0
    moving = False
    # np.int64, because for literals numba would compile a second version of what takes them.
    i, n_events = np.int64(0), np.int64(0)
    n_stops = n_steps = 0
    # Forces are compared by their squares: where these overflow nothing is run, and the end says
    # so.
    last = ax.size - 1 if terms * terms < np.inf else -1
    _fill(history, i, i + 1, 0.0, 0.0, 0.0, 0.0)
    while i < last:
        # Samples are skipped only when the exact block is certainly at rest as well.
        if not moving and off == 0.0:
            first = _next_slip(ax, ay, az, x, y, z, i, p, q, hold)
            _fill(history, i + 1, min(first, last + 1), sx, sy, 0.0, 0.0)
            i = max(i, first - 1)
            if i >= last:
                break
        g0x, g0y, c0 = _sample(ax, ay, az, i, p, q)
        hx, hy, d = _sample(ax, ay, az, i + 1, p, q)
        rx, ry, rc = (hx - g0x) / dt, (hy - g0y) / dt, (d - c0) / dt
        # Without any friction in the interval no block stops.
        rubs = c0 > 0.0 or d > 0.0
        tau = 0.0
        # The loop terminates: each step advances time by `least` or more, and a pass without a
        # step (an onset) occurs only once between a stop and the next step.
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
            if n_steps > maximum_steps:
                return TOO_MANY_STEPS, error, n_stops, n_events, n_steps
            if w == 0.0:
                since = t
                fastest = max(
                    fastest, 0.5 * left * _net_driving(gx, gy, slow * c, hx, hy, slow * d)
                )
            fastest = max(fastest, w)
            far = max(top[0], math.sqrt(cs * cs * sx * sx + sy * sy), SMALL)
            # An error in v acts until the slip ends, assumed to take about as long again.
            late = t - since
            tol = tolerance * max(fastest * far / (far + late * fastest), SMALL / (late + left))
            # Below the rounding error of the drive a shorter step gains nothing.
            tol = max(tol, EPS * terms * left)
            order, part, span, astray, ux, uy = _series(
                w, vx, vy, gx, gy, rx, ry, c, rc, left, tol, maximum_degree, slow, law, b
            )
            along, across, way, aside, va_rate, vs_rate, moved = _scale(b, order, part)
            stops = rubs and moved >= w and _changes(b, W, order, ONE) > 0
            # Near a stop a series reaches only as far as w / |v'|, and steps would shrink with w
            # without end: a stop that is near enough is taken in closed form.
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
                # The series of w may become zero where it no longer represents the speed.
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
                    # As friction tends to zero, so does the defect; so it is also checked earlier.
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
            _see_speed(b, order, w, after, moved, top)
            sx, sy = sx + way, sy + aside
            error += EPS * (abs(sx) + abs(sy) + w * dt)
            _see(sx, sy, t + h, cs, top)
            # If h is below `least`, `off` covers the gain in velocity in the time skipped.
            tau = dt if part == 1.0 and span == left else tau + max(h, least)
            # A falling speed below the tolerance is a stop as well; `off` carries what is left of
            # it.
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
