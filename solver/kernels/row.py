"""Blocks in a row on a shaken roof, linked by springs and dashpots, jitted: series between events.

    two equal blocks, mu = 0.1 and 0.3, flat roof, ax = 0, -6, 0, 0, 0, 0, 0 m/s2 at 0.1 s
    PRD without a link 128 and 16 mm, with k = 100 / s2 52 and 37 mm, with k = 1e6 / s2 42 and 42 mm

Never raises, knows no units but SI; numpy and numba only. Read `slide_row`, then `_first_below`;
`solver.sliding.row` explains the results. `tests/solver/sliding/test_row.py` follows rows in plain
Python, by SciPy's `solve_ivp`.

Model, per unit mass of block i, along the slope:
    w_i' = G - sigma_i mu_i N + (F_i - F_i-1) / m_i   while sliding;  w_i = 0 at rest
    e_j' = w_j+1 - w_j      F_j = k e_j + c e_j'
    at rest while |f_i| <= mu_i N, f_i = G + (F_i - F_i-1) / m_i
Link forces depend on positions and velocities, which are continuous, so the state of each block,
at rest or sliding, can be determined independently. While no block changes its state the equations
are linear, with a forcing that is linear between samples. The motion is then an entire function of
time, and its power series is summed until only rounding error remains.

Letters:
    drive, normal   G and N / m at the samples                                     [m/s2]
    s, w, sigma     position downslope [m], its rate [m/s], direction: +1, -1, 0 at rest
    e               stretch of each link [m]; stored besides s so that stiff links lose no digits
    m               mass of each block / mean mass; their sum is the number of blocks
    k, c            stiffness and damping of a link / mean mass                    [1/s2], [1/s]
    h, x            unit of time of the series [s]; time in that unit, from 0 to 1
    b               series, as coefficients of x^j: rows W and F of blocks, E and T of links
"""

import math
from functools import partial

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT, UNCOUNTED

# Functions that borrow arrays count no references: locked counters took a quarter of the time.
jit = partial(njit, cache=KEPT, **UNCOUNTED)

# Degree of the series. Steps are so short that term j is below 1 / j! of the motion.
ORDER = 22

EPS = 2.220446049250313e-16
# Rounding errors by which the push must exceed friction to make a block slip.
TIE = 64.0

# Rounding errors within which a value counts as zero; well below TIE.
ZERO = 4.0

# Rounding errors of a step, in units of EPS times the magnitude of the terms summed.
STEP = 8.0

# Past every step, whose time goes from 0 to 1.
NEVER = 2.0
# Iterations of a search for an event; then it is resumed from where it ended.
NEWTON = 200

# Rows of series in b[row, block or link, power]: velocity, push without friction; stretch, tension.
W, F, E, T = range(4)


@jit()
def _value(c, order, x):
    """Value and derivative of a polynomial at x."""
    value = slope = 0.0
    for j in range(order, -1, -1):
        slope = slope * x + value
        value = value * x + c[j]
    return value, slope


@jit()
def _first_below(c, order):
    """First x in [0, 1) where p, p(0) >= 0, falls through zero, or NEVER; whether it does."""
    low, total, bend = c[0], abs(c[0]), 0.0
    for j in range(1, order + 1):
        low += min(c[j], 0.0)
        total += abs(c[j])
        bend += j * (j - 1) * abs(c[j])
    if low > 0.0 or total == 0.0:
        return NEVER, False
    x = 0.0
    # With a bound M of the second derivative, p + p' d - M d^2 / 2 bounds the polynomial from
    # below, so there is no zero before the root of this bound, not even two close ones. The search
    # repeats from that root. It converges to a simple root as fast as Newton's method and never
    # passes it.
    for _ in range(NEWTON):
        p, slope = _value(c, order, x)
        if p < -ZERO * EPS * total or (p <= ZERO * EPS * total and slope <= 0.0):
            return x, True
        root = math.sqrt(slope * slope + 2.0 * bend * max(p, 0.0))
        if slope < 0.0:
            x += 2.0 * p / (root - slope)
        elif bend > 0.0:
            x += (slope + root) / bend
        else:
            return NEVER, False
        if x >= 1.0:
            return NEVER, False
    # So flat that the iterations are used up: the search has to be resumed from x.
    return x, False


@jit()
def _largest(c, order, end):
    """Largest |p| of a polynomial in [0, end]: at the ends, and at one extreme between them."""
    last, slope_last = _value(c, order, end)
    largest = max(abs(c[0]), abs(last))
    if c[1] * slope_last >= 0.0:
        return largest
    low, high = 0.0, end
    for _ in range(50):
        middle = 0.5 * (low + high)
        p, slope = _value(c, order, middle)
        if slope * c[1] > 0.0:
            low = middle
        else:
            high = middle
        largest = max(largest, abs(p))
    return largest


@jit()
def _series(b, w, e, sigma, mus, m, k, c, h, driving, hold):
    """Series of blocks and links, from two coefficients of G and N; degree, magnitude [m/s]."""
    n, scale = w.size, math.sqrt(k)
    for i in range(n):
        b[W, i, 0] = w[i]
        if i < n - 1:
            b[E, i, 0] = e[i]
    size = 0.0
    for p in range(ORDER):
        g, hold_p = (driving[p], hold[p]) if p < 2 else (0.0, 0.0)
        share = h / (p + 1)
        largest, before = 0.0, 0.0
        for i in range(n):
            tension = 0.0
            if i < n - 1:
                rate = b[W, i + 1, p] - b[W, i, p]
                tension = k * b[E, i, p] + c * rate
                b[T, i, p], b[E, i, p + 1] = tension, share * rate
                largest = max(largest, scale * abs(b[E, i, p + 1]))
            # f_i = G + (F_i - F_i-1) / m_i, F_j = k e_j + c e_j'; no link beyond either end.
            b[F, i, p] = g + (tension - before) / m[i]
            before = tension
        for i in range(n):
            b[W, i, p + 1] = 0.0
            # w_i' = f_i - sigma_i mu_i N
            if sigma[i] != 0.0:
                b[W, i, p + 1] = share * (b[F, i, p] - sigma[i] * mus[i] * hold_p)
            largest = max(largest, abs(b[W, i, p + 1]))
        size += largest
        # Not before p = 2: G and N have two coefficients, and either may be zero.
        if p >= 2 and largest <= 0.01 * EPS * size:
            break
    # The magnitude: all speeds, all stretches times sqrt(k), and the terms of the series.
    degree = p + 1
    for i in range(n):
        b[F, i, degree] = b[T, i, degree] = 0.0
        size += abs(w[i])
        if i < n - 1:
            size += scale * abs(e[i])
    return degree, size


@jit()
def _room(b, i, side, mu, hold, degree, line):
    """Fill `line` with the margin of block i against slip toward `side`; its allowance TIE."""
    total = abs(hold[0]) + abs(hold[1])  # not zero even if both friction and push are
    for p in range(degree + 1):
        line[p] = (mu * hold[p] if p < 2 else 0.0) - side * b[F, i, p]
        total += abs(b[F, i, p]) + (mu * abs(hold[p]) if p < 2 else 0.0)
    line[0] += TIE * EPS * total
    return TIE * EPS * total


@jit()
def _next_events(b, sigma, mus, hold, degree, line, when, side):
    """Fill times of next events and sides of slip; the first time, largest allowance TIE."""
    first, tie = NEVER, 0.0
    for i in range(sigma.size):
        when[i] = NEVER
        if sigma[i] != 0.0:
            for p in range(degree + 1):
                line[p] = sigma[i] * b[W, i, p]
            when[i], falls = _first_below(line, degree)
            # 0: no event yet, and the search has to be resumed at that time.
            side[i] = 1.0 if falls else 0.0
        else:
            for direction in (1.0, -1.0):
                tie = max(tie, _room(b, i, direction, mus[i], hold, degree, line))
                x, falls = _first_below(line, degree)
                if x < when[i]:
                    when[i], side[i] = x, direction if falls else 0.0
        first = min(first, when[i])
    return first, tie


@jit()
def _advance(b, s, w, e, links, h, x, degree):
    """Advance all blocks and links to x, and update the largest stretches and tensions."""
    for i in range(s.size):
        way, power = 0.0, h * x
        for p in range(degree + 1):
            way += power * b[W, i, p] / (p + 1)
            power *= x
        s[i] += way
        w[i] = _value(b[W, i], degree, x)[0]
    for j in range(e.size):
        links[j, 0] = max(links[j, 0], _largest(b[E, j], degree, x))
        links[j, 1] = max(links[j, 1], _largest(b[T, j], degree - 1, x))
        e[j] = _value(b[E, j], degree, x)[0]


@jit()
def _switch(b, s, w, sigma, mus, hold, degree, x, when, side, line, peaks):
    """Let every block with an event at x stop, reverse or slip; stops, largest w set to 0."""
    n_stops, lost = 0, 0.0
    for i in range(s.size):
        if when[i] != x or side[i] == 0.0:
            continue
        if sigma[i] == 0.0:
            sigma[i] = side[i]
            continue
        n_stops += 1
        lost, w[i], sigma[i] = max(lost, abs(w[i])), 0.0, 0.0
        peaks[i, 0], peaks[i, 1] = max(peaks[i, 0], s[i]), min(peaks[i, 1], s[i])
        for direction in (1.0, -1.0):
            _room(b, i, direction, mus[i], hold, degree, line)
            if _value(line, degree, x)[0] < 0.0:
                sigma[i] = direction
    return n_stops, lost


@njit(cache=KEPT, nogil=True)
def slide_row(drive, normal, dt, mus, m, k, c, maximum_events, peaks, links, samples):
    """Solve the motion of a row of blocks from rest, with unstretched links, event by event.

    The error is bounded by energy: the difference of two motions of the row, measured by
    sqrt(sum of m dw^2 + k de^2), never increases by itself, because friction, dashpots and springs
    add no energy to it (N >= 0). So the contributions of all steps are summed: the truncation of
    the series, rounding error, a velocity set to zero at a stop, pushes within the allowance TIE.
    The integral of this sum over time is the bound of the error in position.

    Returns whether the end was reached, with no more than `maximum_events` in any interval, that
    bound [m] and the number of stops. Fills `peaks`, shape (blocks, 4), with the largest s, the
    least s, s and w at the end; `links`, shape (blocks - 1, 2), with the largest |e| [m] and |F|
    [m/s2] of each link; and `samples`, shape (blocks, n), or None, with s at the samples.
    """
    n = mus.size
    b = np.zeros((4, n, ORDER + 1))
    s, w, sigma, e = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n - 1)
    when, side, line = np.empty(n), np.zeros(n), np.zeros(ORDER + 1)
    driving, hold = np.zeros(2), np.zeros(2)
    peaks[:], links[:] = 0.0, 0.0
    if samples is not None:
        samples[:, 0] = 0.0
    maximum_mu = mus.max()
    # Bound of the fastest rate of the links: omega <= 2 sqrt(k / m), damping <= 4 c / m.
    rate = 2.0 * math.sqrt(k / m.min()) + 4.0 * c / m.min() if n > 1 else 0.0
    longest = min(dt, 1.0 / rate) if rate > 0.0 else dt
    n_stops = 0
    drift = error = 0.0
    for i in range(drive.size - 1):
        tau, n_events = 0.0, 0
        demand = max(abs(drive[i]), abs(drive[i + 1])) + maximum_mu * max(normal[i], normal[i + 1])
        while tau < dt:
            h = min(longest, dt - tau)
            for line_of, values in ((driving, drive), (hold, normal)):
                gain = (values[i + 1] - values[i]) / dt
                line_of[0], line_of[1] = values[i] + gain * tau, gain * h
            degree, size = _series(b, w, e, sigma, mus, m, k, c, h, driving, hold)
            x, tie = _next_events(b, sigma, mus, hold, degree, line, when, side)
            reached = min(x, 1.0)
            _advance(b, s, w, e, links, h, reached, degree)
            drift += STEP * EPS * (size + h * demand) + tie * h
            if x < NEVER:
                stopped, lost = _switch(
                    b, s, w, sigma, mus, hold, degree, x, when, side, line, peaks
                )
                n_stops, n_events, drift = n_stops + stopped, n_events + 1, drift + lost
                if n_events > maximum_events:
                    return False, np.inf, n_stops
            error += drift * h * reached
            # Set, not summed: steps added up may fall short of dt by a rounding.
            tau = dt if x == NEVER and h == dt - tau else tau + h * reached
        if samples is not None:
            samples[:, i + 1] = s
    for i in range(n):
        peaks[i, 0], peaks[i, 1] = max(peaks[i, 0], s[i]), min(peaks[i, 1], s[i])
        peaks[i, 2], peaks[i, 3] = s[i], w[i]
    # The energy of all blocks may be in the lightest one.
    return True, error / math.sqrt(m.min() / n), n_stops
