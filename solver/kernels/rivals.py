"""The methods compared with the exact one, jitted: each as it is commonly used.

The samples of `one_axis`, whose PRD is 4.94 mm, by the paper's method: 30.19 mm with one sub-step
in each interval, 5.31 mm with 64; by linear acceleration 4.94 mm with 64.

Never raises, knows no units but SI; numpy and numba only. Read `solver.rivals.methods` for a
description of each, and `solver.kernels.one_axis` for the exact method. `follow_the_equations` in
`tests/solver/kernels/test_rivals_kernel.py` is the paper's algorithm in plain Python.

Letters, beside those of `one_axis`, along the slope and per unit mass, positive downslope:
    G, N     drive downslope and normal force (Eq. 6 with the vertical added)        [m/s2]
    down, up G - mu N and -G - mu N: net acceleration of a block sliding that way    [m/s2]
    s, w     distance slid and its rate                                              [m], [m/s]
    a        acceleration s''                                                        [m/s2]
    dt, h    sampling interval and sub-step                                          [s]
    k        stiffness of the link per unit mass, omega^2                            [1/s2]
    x, F     stretch of the link [m] and its force on the block, upslope             [m/s2]
    cap      mu N, the largest force of the link                                     [m/s2]

Every kernel assumes N >= 0 throughout (`one_axis.minimum_normal`). It fills `history`, if of shape
(2, n), with s and w at the samples; shape (2, 0) is not filled. It returns its code, the largest
and the least s, s and w at the end, the time of the largest |s| and the number of stops. A block
that has stopped sliding has w = 0 at the end. `slide_fixed`, of two axes, says itself what
it takes and returns.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT

# Outcome codes; `solver.sliding.checked` maps them to `Status`.
FOLLOWED = 0
DIVERGED = 1

# Largest energy dissipated by a link while its cap exceeds the load / energy available.
ENERGY = 6.0

# Newton iterations in a sub-step before the run is abandoned.
ITERATIONS = 25


@njit(cache=KEPT, inline="always")
def _drive_and_cap(ax, az, i, sn, cs, mu, g, scale):
    """G and mu N at sample i; an empty vertical record means none."""
    x = scale * ax[i]
    z = g + scale * az[i] if az.size > 0 else g
    # G = (g + az) sin(theta) - ax cos(theta);  mu N, N = (g + az) cos(theta) + ax sin(theta).
    return sn * z - cs * x, mu * (cs * z + sn * x)


@njit(cache=KEPT, inline="always")
def _seen(s, t, s_max, s_min, t_peak):
    """The extremes of s and the time of the largest |s|, updated with s at time t."""
    if abs(s) > max(s_max, -s_min):
        t_peak = t
    return max(s_max, s), min(s_min, s), t_peak


@njit(cache=KEPT)
def slide_constant(ax, az, dt, sn, cs, mu, g, scale, substeps, skips, history):
    """The paper's algorithm: constant acceleration over each of `substeps` sub-steps.

    Eqs. 1-19 with sign(0) = 0 (Eq. 13), so the first sub-step of a slip has no friction. The
    unknown is s = (u_x - u_p) / cos(theta): u_x'' - u_p'' of Eq. 18 is cos(theta) (G - mu N sign),
    because A tan(theta) + B is 1 / cos(theta). First order in h.

    With `skips`, an interval that begins at rest, with no slip at either of its samples, is taken
    as one step: N and G are linear, so every sub-step would give the same result.
    """
    h = dt / substeps
    half, share = 0.5 * h * h, 1.0 / substeps
    drive, cap = _drive_and_cap(ax, az, 0, sn, cs, mu, g, scale)
    down, up = drive - cap, -drive - cap
    s = s_before = w = w_before = s_max = s_min = t_peak = 0.0
    n_stops = 0
    for i in range(ax.size - 1):
        if history.shape[1] > 0:
            history[0, i], history[1, i] = s, w
        drive, cap = _drive_and_cap(ax, az, i + 1, sn, cs, mu, g, scale)
        down_0, up_0, down, up = down, up, drive - cap, -drive - cap
        holds = down_0 < 0.0 and up_0 < 0.0 and down < 0.0 and up < 0.0
        if skips and holds and w == 0.0 and w_before == 0.0:
            continue
        r_down, r_up = (down - down_0) * share, (up - up_0) * share
        j = 0
        while j < substeps:
            # Eq. 18 along the slope: s'' = G - mu N while w > 0, G + mu N while w < 0.
            if w > 0.0 and w_before >= 0.0:
                a = down_0 + j * r_down
            elif w < 0.0 and w_before <= 0.0:
                a = -(up_0 + j * r_up)
            else:
                # At rest, or reversed within the last sub-step: s is extreme at one of its ends.
                if w_before != 0.0:
                    t = (i * substeps + j) * h
                    s_max, s_min, t_peak = _seen(s_before, t - h, s_max, s_min, t_peak)
                    s_max, s_min, t_peak = _seen(s, t, s_max, s_min, t_peak)
                    n_stops += 1
                first = j
                while j < substeps and down_0 + j * r_down < 0.0 and up_0 + j * r_up < 0.0:
                    j += 1  # Eqs. 6, 8, 9
                if j > first:
                    w = w_before = 0.0
                    continue
                # sign(0) = 0 in Eq. 13: G alone, half of `down` less `up`.
                a = 0.5 * (down_0 + j * r_down - (up_0 + j * r_up))
                if w != 0.0:
                    a = down_0 + j * r_down if w > 0.0 else -(up_0 + j * r_up)
            s_before, w_before = s, w
            s += w * h + half * a
            w += a * h
            j += 1
    t = (ax.size - 1) * dt
    s_max, s_min, t_peak = _seen(s_before, t - h, s_max, s_min, t_peak)
    s_max, s_min, t_peak = _seen(s, t, s_max, s_min, t_peak)
    if history.shape[1] > 0:
        history[0, -1], history[1, -1] = s, w
    return FOLLOWED, s_max, s_min, s, w, t_peak, n_stops


@njit(cache=KEPT)
def slide_linear(ax, az, dt, sn, cs, mu, g, scale, substeps, history):
    """Linear acceleration of the plane and a fixed sliding direction in each sub-step.

    Suggested in the limitations of the paper. Slip, stop and reversal are still detected at the
    ends of sub-steps only. A slip starts in the direction of the drive, because sign(0) = 0 as in
    the paper would make the method first order. Second order in h; first order if the block
    reverses without coming to rest, because the friction of the old direction acts until the end of
    that sub-step.
    """
    h = dt / substeps
    share = 1.0 / substeps
    drive, cap = _drive_and_cap(ax, az, 0, sn, cs, mu, g, scale)
    s = w = w_before = s_max = s_min = t_peak = 0.0
    n_stops = 0
    for i in range(ax.size - 1):
        if history.shape[1] > 0:
            history[0, i], history[1, i] = s, w
        drive_0, cap_0 = drive, cap
        drive, cap = _drive_and_cap(ax, az, i + 1, sn, cs, mu, g, scale)
        r_drive, r_cap = (drive - drive_0) * share, (cap - cap_0) * share
        for j in range(substeps):
            drive_j, cap_j = drive_0 + j * r_drive, cap_0 + j * r_cap
            # The paper's condition for sticking: at rest, or reversed within the last sub-step.
            reversed_ = w * w_before < 0.0
            n_stops += reversed_
            if (w == 0.0 or reversed_) and abs(drive_j) <= cap_j:
                w = w_before = 0.0
                continue
            # s'' = G - sign mu N, with G and N linear in the sub-step: s' quadratic, s cubic.
            sign = math.copysign(1.0, w if w != 0.0 else drive_j)
            a, rise = drive_j - sign * cap_j, r_drive - sign * r_cap
            w_before = w
            s += h * (w + h * (0.5 * a + rise / 6.0))
            w += h * (a + 0.5 * rise)
            t = (i * substeps + j + 1) * h
            s_max, s_min, t_peak = _seen(s, t, s_max, s_min, t_peak)
    if history.shape[1] > 0:
        history[0, -1], history[1, -1] = s, w
    return FOLLOWED, s_max, s_min, s, w, t_peak, n_stops


@njit(cache=KEPT, inline="always")
def _link(x, k, cap):
    """Force of the link at a stretch x, limited to its cap, and the direction in which it slips."""
    force = k * x
    if force >= cap:
        return cap, 1
    if force <= -cap:
        return -cap, -1
    return force, 0


@njit(cache=KEPT)
def _solve_sub_step(x, free, lever, k, cap):
    """Newton's method for x = free - lever F(x), F the capped force; x, whether it converged."""
    _, piece = _link(x, k, cap)
    # F has three linear pieces. If a tangent leads to a point on its own piece, that is the root.
    # If lever k = (omega h)^2 / 4 is above 1, the two outer pieces may lead to each other
    # endlessly.
    for _ in range(ITERATIONS):
        x = free / (1.0 + lever * k) if piece == 0 else free - piece * lever * cap
        _, landed = _link(x, k, cap)
        if landed == piece:
            return x, True
        piece = landed
    return x, False


@njit(cache=KEPT)
def slide_link(ax, az, dt, sn, cs, mu, g, scale, substeps, k, implicit, history):
    """A spring whose force is limited to mu N: friction as common in structural programs.

    Newmark's method with gamma = 1/2: explicit with beta = 0, stable for h < 2 / omega; `implicit`
    with beta = 1/4 and Newton's method. No damping; the link starts in equilibrium with gravity, as
    after the dead-load stage of the paper's SAP 2000 model.

    A run has diverged if a sub-step does not converge in ITERATIONS, a number is not finite, or the
    link chatters. The cap keeps an instability finite, so only the energy reveals it. While
    |G| < mu N, the energy of block and link is v^2 / 2 + (F - G)^2 / 2k, the changing load adds at
    most (mu N + |G|) |dG| / k, and a slip of ds dissipates (mu N - |G|) |ds|. A run is abandoned
    if its slip has dissipated more than ENERGY times the energy available: that when |G| came below
    mu N (plus mu^2 N^2 / 2k as an allowance) and that added since. In stable runs the ratio is up
    to 1.5 for h omega <= 1.7 and up to 5 near the limit of 2.
    """
    h = dt / substeps
    half, share = 0.5 * h * h, 1.0 / substeps
    lever = 0.25 * h * h
    failed = (DIVERGED, np.nan, np.nan, np.nan, np.nan, np.nan, 0)
    drive, cap = _drive_and_cap(ax, az, 0, sn, cs, mu, g, scale)
    # In equilibrium with gravity alone; what it cannot hold stays unbalanced in `a`.
    force = min(max(g * sn, -mu * g * cs), mu * g * cs)
    x, a = force / k, drive - min(max(force, -cap), cap)
    # Energy that may still be dissipated: ENERGY times the energy available, minus the energy
    # dissipated so far.
    left = 0.5 * ENERGY * (a * a + cap * cap) / k
    s = w = s_max = s_min = t_peak = 0.0
    slip = n_stops = 0
    for i in range(ax.size - 1):
        if history.shape[1] > 0:
            history[0, i], history[1, i] = s, w
        drive_0, cap_0 = drive, cap
        drive, cap = _drive_and_cap(ax, az, i + 1, sn, cs, mu, g, scale)
        change = abs(drive - drive_0) * share
        for j in range(1, substeps + 1):
            drive_j = drive_0 + (drive - drive_0) * (j * share)
            cap_j = cap_0 + (cap - cap_0) * (j * share)
            if implicit:
                # Only the contribution of F at the end of the sub-step is unknown.
                # Newmark, beta = 1/4: x + h v + h^2 (a + a_new) / 4, with a_new = G - F(x_new).
                free = x + h * w + lever * (a + drive_j)
                stretch, is_solved = _solve_sub_step(x, free, lever, k, cap_j)
                if not is_solved:
                    return failed
            else:
                # Newmark, beta = 0: x + h v + h^2 a / 2, F from the new stretch.
                stretch = x + h * w + half * a
            s += stretch - x
            force, slips = _link(stretch, k, cap_j)
            # A link at its cap slips: its stretch stays that of the cap.
            x = force / k if slips != 0 else stretch
            n_stops += slip != 0 and slips != slip
            slip = slips
            # Newmark, gamma = 1/2: v + h (a + a_new) / 2.
            w += 0.5 * h * (a + drive_j - force)
            a = drive_j - force
            push = abs(drive_j)
            if push < cap_j:
                added = (cap_j + push) * change / k
                left += ENERGY * added - (cap_j - push) * abs(stretch - x)
            else:
                left = 0.5 * ENERGY * (w * w + (a * a + cap_j * cap_j) / k)
            if not (left >= 0.0 and abs(w) < np.inf):
                return failed
            t = (i * substeps + j) * h
            s_max, s_min, t_peak = _seen(s, t, s_max, s_min, t_peak)
    if history.shape[1] > 0:
        history[0, -1], history[1, -1] = s, w
    return FOLLOWED, s_max, s_min, s, w if slip != 0 else 0.0, t_peak, n_stops


@njit(cache=KEPT)
def line_rate(t, y, push, rise):
    """Rates of s and w of a block that slides one way, net acceleration `push` + `rise` t."""
    return np.array((y[1], push + rise * t))


@njit(cache=KEPT)
def plane_rate(t, state, x, y, c, rx, ry, rc):
    """Rates of position and velocity in two axes: G = (x, y) + (rx, ry) t, mu N = c + rc t."""
    vx, vy = state[2], state[3]
    f = (c + rc * t) / math.sqrt(vx * vx + vy * vy)
    return np.array((vx, vy, x + rx * t - f * vx, y + ry * t - f * vy))


@njit(cache=KEPT)
def regularized_rate(t, y, rows, dt, v0):
    """Rates of position and velocity with friction mu N tanh(w / v0), in one axis or in two.

    y has the positions, then the velocities; rows has G, along each axis, and mu N at the samples.
    """
    d = y.size // 2
    i = min(int(t / dt), rows.shape[0] - 2)
    part, w = t / dt - i, 0.0
    for k in range(d, 2 * d):
        w += y[k] * y[k]
    w = math.sqrt(w)
    cap = rows[i, d] + (rows[i + 1, d] - rows[i, d]) * part
    # tanh(w / v0) / w tends to 1 / v0 at rest.
    f = cap * math.tanh(w / v0) / w if w > 0.0 else cap / v0
    rates = np.empty(2 * d)
    for k in range(d):
        rates[k] = y[d + k]
        rates[d + k] = rows[i, k] + (rows[i + 1, k] - rows[i, k]) * part - f * y[d + k]
    return rates


@njit(cache=KEPT)
def regularized_jacobian(t, y, rows, dt, v0):
    """Jacobian of `regularized_rate`."""
    d = y.size // 2
    i = min(int(t / dt), rows.shape[0] - 2)
    w = 0.0
    for k in range(d, 2 * d):
        w += y[k] * y[k]
    w = math.sqrt(w)
    cap, tanh = rows[i, d] + (rows[i + 1, d] - rows[i, d]) * (t / dt - i), math.tanh(w / v0)
    f = cap * tanh / w if w > 0.0 else cap / v0
    # d(f v_k) / d v_j = f delta_kj + (df/dw) v_k v_j / w, df/dw = (mu N tanh'(w / v0) / v0 - f) / w
    rise = (cap * (1.0 - tanh * tanh) / v0 - f) / (w * w) if w > 0.0 else 0.0
    slopes = np.zeros((2 * d, 2 * d))
    for k in range(d):
        slopes[k, d + k] = 1.0
        slopes[d + k, d + k] = -f
        for j in range(d):
            slopes[d + k, d + j] -= rise * y[d + k] * y[d + j]
    return slopes


@njit(cache=KEPT)
def slide_fixed(g, dt, cs, substeps):
    """Solve the motion under G and mu N with `substeps` steps in each interval.

    g has shape (n, 3): Gx, Gy and mu N at the samples [m/s2]. Friction is mu N v / |v| at the
    beginning of a step. A block comes to rest if its velocity turns by 90 deg or more in a step
    while mu N >= |G|, and stays at rest until |G| > mu N at the beginning of a step, as the paper
    does in one axis.

    Returns PRD at the ends of steps, position in plan at the end (x, y), speed at the end.
    """
    h = dt / substeps
    sx = sy = vx = vy = prd = 0.0
    for i in range(g.shape[0] - 1):
        for j in range(substeps):
            # The forces at the beginning of a sub-step act throughout it, as in the paper.
            part = j / substeps
            gx = g[i, 0] + (g[i + 1, 0] - g[i, 0]) * part
            gy = g[i, 1] + (g[i + 1, 1] - g[i, 1]) * part
            c = g[i, 2] + (g[i + 1, 2] - g[i, 2]) * part
            w, pull = math.sqrt(vx * vx + vy * vy), math.sqrt(gx * gx + gy * gy)
            if w > 0.0:
                ax, ay = gx - c * vx / w, gy - c * vy / w
            elif pull > c:
                ax, ay = gx * (1.0 - c / pull), gy * (1.0 - c / pull)
            else:
                continue
            nx, ny = vx + ax * h, vy + ay * h
            sx, sy = sx + 0.5 * (vx + nx) * h, sy + 0.5 * (vy + ny) * h
            stops = w > 0.0 and nx * vx + ny * vy <= 0.0 and pull <= c
            vx, vy = (0.0, 0.0) if stops else (nx, ny)
            prd = max(prd, math.sqrt(cs * cs * sx * sx + sy * sy))
    return prd, cs * sx, sy, math.sqrt(cs * cs * vx * vx + vy * vy)
