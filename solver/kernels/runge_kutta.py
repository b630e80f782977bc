"""Runge-Kutta methods with events, fully jitted: closest competitors of the exact methods.

Dormand and Prince's of order 5 (RK45) and of order 8 (DOP853) with SciPy's coefficients, error
norms and control of the step, restarted at every sample, onset of slip and stop. Never raises,
knows no units but SI; numpy and numba only. A step of either follows a cubic exactly, so that one
axis, with a step from event to event, has rounding error alone. Letters as in
`solver.kernels.rivals`; the state y has the distances, then their rates, and k the rates of y at
the stages of a step. In plain Python `solver.rivals.by_scipy` is the same, by SciPy itself.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from solver.kernels.compiler import KEPT


def _below(*rows):
    """Coefficients of the stages, each of those before it."""
    stages = np.zeros((len(rows) + 1, len(rows) + 1))
    for i, row in enumerate(rows, start=1):
        stages[i, : len(row)] = row
    return stages


# Of the stages, of the step, and of its error: the difference from the step of order 4.
A5 = _below(
    (1 / 5,),
    (3 / 40, 9 / 40),
    (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
)
B5 = np.array((35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84))
E5 = np.array((-71 / 57600, 0.0, 71 / 16695, -71 / 1920, 17253 / 339200, -22 / 525, 1 / 40))
C5 = A5.sum(axis=1)

# Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I (1993): the code DOP853, whose
# error is made of the differences from two steps, of order 5 and of order 3.
A8 = _below(
    (0.05260015195876773,),
    (0.0197250569845379, 0.0591751709536137),
    (0.02958758547680685, 0.0, 0.08876275643042054),
    (0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792),
    (0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242),
    (0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125),
    (0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328,
     -0.015319437748624402, 0.008273789163814023),
    (0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726,
     27.59209969944671, 20.154067550477894, -43.48988418106996),
    (0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843,
     21.230051448181193, 15.279233632882423, -33.28821096898486, -0.020331201708508627),
    (-0.9371424300859873, 0.0, 0.0, 5.186372428844064, 1.0914373489967295,
     -8.149787010746927, -18.52006565999696, 22.739487099350505, 2.4936055526796523,
     -3.0467644718982196),
    (2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625,
     -17.9589318631188, 27.94888452941996, -2.8589982771350235, -8.87285693353063,
     12.360567175794303, 0.6433927460157636),
)  # fmt: skip
B8 = np.array(
    (0.054293734116568765, 0.0, 0.0, 0.0, 0.0, 4.450312892752409, 1.8915178993145003,
     -5.801203960010585, 0.3111643669578199, -0.1521609496625161, 0.20136540080403034,
     0.04471061572777259)
)  # fmt: skip
E8 = np.array(
    (0.01312004499419488, 0.0, 0.0, 0.0, 0.0, -1.2251564463762044, -0.4957589496572502,
     1.6643771824549864, -0.35032884874997366, 0.3341791187130175, 0.08192320648511571,
     -0.022355307863886294)
)  # fmt: skip
E3 = B8.copy()
# Minus the weights of the third-order step, bhh1 to bhh3 in the code DOP853.
E3[[0, 8, 11]] -= 0.2440944881889764, 0.7338466882816118, 0.022058823529411766
C8 = A8.sum(axis=1)

# Velocity from which a slip in two axes is integrated, as a share of what the interval gives.
BEGINNING = 2e-5

# Part of a step after which the end of a slip is sought that begins with the step.
LATER = 1e-9

# Halvings after which a bracketed root is known to rounding error, and a part that is rounding.
HALVINGS, NEAR = 60, 1e-16


@njit(cache=KEPT)
def _rate(axes, t, y, p, k):
    """Rates k of y; p has the net acceleration, or in two axes G and mu N, then its slope."""
    if axes == 1:
        k[0], k[1] = y[1], p[0] + p[1] * t
    else:
        w = math.sqrt(y[2] * y[2] + y[3] * y[3])
        f = (p[2] + p[5] * t) / w if w > 0.0 else 0.0
        k[0], k[1] = y[2], y[3]
        k[2], k[3] = p[0] + p[3] * t - f * y[2], p[1] + p[4] * t - f * y[3]


@njit(cache=KEPT)
def _stepped(axes, order, t, h, y, p, k, new):
    """Fill `new` with y after a step h from t, and all rows of k but the first, which is given."""
    if order == 8:
        a, b, c, stages = A8, B8, C8, 12
    else:
        a, b, c, stages = A5, B5, C5, 6
    for i in range(1, stages):
        for m in range(2 * axes):
            mean = 0.0
            for j in range(i):
                mean += a[i, j] * k[j, m]
            new[m] = y[m] + h * mean
        _rate(axes, t + c[i] * h, new, p, k[i])
    for m in range(2 * axes):
        mean = 0.0
        for j in range(stages):
            mean += b[j] * k[j, m]
        new[m] = y[m] + h * mean
    _rate(axes, t + h, new, p, k[stages])


@njit(cache=KEPT)
def _drive_and_cap(ax, az, i, sn, cs, mu, g, scale):
    """G and mu N at sample i; an empty vertical record means none."""
    x = scale * ax[i]
    z = g + scale * az[i] if az.size > 0 else g
    return sn * z - cs * x, mu * (cs * z + sn * x)


@njit(cache=KEPT)
def _between(part, h, y, rate, end, end_rate):
    """What goes from y to `end` in h with these rates at its ends, after a part of h, and its rate.

    A cubic, as the motion is: the methods' own interpolants would be the same here.
    """
    b, d = h * rate, end - y
    c, d = 3.0 * d - 2.0 * b - h * end_rate, b + h * end_rate - 2.0 * d
    return y + part * (b + part * (c + part * d)), b + part * (2.0 * c + 3.0 * part * d)


@njit(cache=KEPT)
def _stop(sign, low, high, h, w, a, w_end, a_end):
    """The part of h, from low to high, after which w is zero: Newton's method within a bracket."""
    part = high
    for _ in range(HALVINGS):
        speed, rise = _between(part, h, w, a, w_end, a_end)
        if sign * speed > 0.0:
            low = part
        else:
            high = part
        before, part = part, part - speed / rise if rise != 0.0 else low
        if not low < part < high:
            part = 0.5 * (low + high)
        if abs(part - before) < NEAR:
            break
    return part


@njit(cache=KEPT)
def slide_line(ax, az, dt, sn, cs, mu, g, scale, order, history):
    """One axis: a step to each sample, onset of slip and stop, of order 5 or 8.

    The motion between them is cubic, which a step follows without an error: none is estimated, and
    no step is tried again. Arguments and what is returned are those of the kernels of
    `solver.kernels.rivals`, with True for the code.
    """
    y, new, k, p = np.zeros(2), np.zeros(2), np.empty((13, 2)), np.zeros(2)
    s_max = s_min = t_peak = 0.0
    n_stops = 0
    drive, cap = _drive_and_cap(ax, az, 0, sn, cs, mu, g, scale)
    for i in range(ax.size - 1):
        if history.shape[1] > 0:
            history[:, i] = y
        drive_0, cap_0 = drive, cap
        drive, cap = _drive_and_cap(ax, az, i + 1, sn, cs, mu, g, scale)
        # Drive and capacity are linear: what rests at both samples rests between them.
        if y[1] == 0.0 and abs(drive_0) <= cap_0 and abs(drive) <= cap:
            continue
        r_drive, r_cap = (drive - drive_0) / dt, (cap - cap_0) / dt
        t = 0.0
        while t < dt:
            begins = y[1] == 0.0
            sign = math.copysign(1.0, drive_0 + r_drive * t if begins else y[1])
            if begins and abs(drive_0 + r_drive * t) <= cap_0 + r_cap * t:
                if abs(drive) <= cap:
                    break
                sign = math.copysign(1.0, drive)
                before, after = sign * drive_0 - cap_0, sign * drive - cap
                t = max(t, dt * (before / (before - after)))
                if not t < dt:
                    break
            h, p[0], p[1] = dt - t, drive_0 - sign * cap_0, r_drive - sign * r_cap
            k[0, 0], k[0, 1] = y[1], p[0] + p[1] * t
            _stepped(1, order, t, h, y, p, k, new)
            a, a_end, high = k[0, 1], p[0] + p[1] * dt, 1.0
            # The speed may reach zero between samples and rise again: it is least where the net
            # acceleration turns along it. One that begins with the slip rises, and then falls.
            if not begins and sign * a < 0.0 < sign * a_end:
                turn = a / (a - a_end)
                if sign * _between(turn, h, y[1], a, new[1], a_end)[0] <= 0.0:
                    high = turn
            if high == 1.0 and sign * new[1] > 0.0:
                y[0], y[1], t = new[0], new[1], dt
                continue
            # w is zero where the slip begins: its end is the next zero.
            part = _stop(sign, LATER if begins else 0.0, high, h, y[1], a, new[1], a_end)
            y[0], _ = _between(part, h, y[0], y[1], new[0], new[1])
            # Time must advance even by a part that is rounding.
            y[1], t = 0.0, max(t + part * h, np.nextafter(t, dt))
            n_stops += 1
            if abs(y[0]) > max(s_max, -s_min):
                t_peak = i * dt + t
            s_max, s_min = max(s_max, y[0]), min(s_min, y[0])
    if history.shape[1] > 0:
        history[:, -1] = y
    # s is extreme at a stop or at the end.
    if abs(y[0]) > max(s_max, -s_min):
        t_peak = (ax.size - 1) * dt
    return True, max(s_max, y[0]), min(s_min, y[0]), y[0], y[1], t_peak, n_stops


@njit(cache=KEPT)
def excess(p, t):
    """Drive in excess of the friction capacity, which is convex in t."""
    x, y = p[0] + p[3] * t, p[1] + p[4] * t
    return math.sqrt(x * x + y * y) - (p[2] + p[5] * t)


@njit(cache=KEPT)
def _crossing(p, low, high):
    """The time at which the excess changes sign, bracketed."""
    is_over = excess(p, low) > 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (excess(p, middle) > 0.0) == is_over:
            low = middle
        else:
            high = middle
    return high


@njit(cache=KEPT)
def onset(p, t, dt):
    """Onset of slip of a block at rest at t; dt, the end of the interval, if there is none."""
    if excess(p, t) > 0.0:
        return t
    # Convex: at or below zero at both ends, it is so between them.
    return _crossing(p, t, dt) if excess(p, dt) > 0.0 else dt


@njit(cache=KEPT)
def largest(p, dt):
    """The largest velocity that an interval may give, twice where it is reached."""
    first = math.hypot(p[0], p[1]) + p[2]
    return dt * max(first, math.hypot(p[0] + p[3] * dt, p[1] + p[4] * dt) + p[2] + p[5] * dt)


@njit(cache=KEPT)
def _gained(p, t, h):
    """The velocity that a block gains in h from rest, by Simpson's rule."""
    ends = max(excess(p, t), 0.0) + excess(p, t + h)
    return h * (ends + 4.0 * excess(p, t + 0.5 * h)) / 6.0


@njit(cache=KEPT)
def begun(p, t, dt, rtol, top, y):
    """Start a slip along G: fill y, and return the time that it took.

    At a share of the velocity that the interval gives, or later where the turn of G until then
    makes no error that counts: an onset just before a sample gives so little that steps, of w / |G|
    at most, would be without number. `top` is the largest velocity that an interval may give.
    """
    high = dt - t
    if excess(p, dt) < 0.0 < excess(p, t):  # the block gains no more after that
        high = _crossing(p, t, dt) - t
    low, wanted = 0.0, BEGINNING * _gained(p, t, high)
    gx, gy = p[0] + p[3] * t, p[1] + p[4] * t
    turn = abs(gx * p[4] - gy * p[3]) / (gx * gx + gy * gy)
    for _ in range(HALVINGS):
        h = 0.5 * (low + high)
        speed = _gained(p, t, h)
        if speed < wanted or speed * turn * h < 1e-7 * rtol * top:
            low = h
        else:
            high = h
    gx, gy, c = p[0] + p[3] * (t + h), p[1] + p[4] * (t + h), p[2] + p[5] * (t + h)
    speed, drive = _gained(p, t, h), math.sqrt(gx * gx + gy * gy)
    # The direction follows that of G behind by its turn in w / |G| (the singularity at w = 0).
    lag = speed * (gx * p[4] - gy * p[3]) / (drive * drive) / (2.0 * drive - c)
    angle = math.atan2(gy, gx) - lag
    way = h * h * (max(excess(p, t), 0.0) / 3.0 + excess(p, t + h) / 6.0)
    y[0], y[1] = y[0] + way * math.cos(angle), y[1] + way * math.sin(angle)
    y[2], y[3] = speed * math.cos(angle), speed * math.sin(angle)
    return h


@njit(cache=KEPT)
def _error(order, h, y, k, new, rtol, atol):
    """SciPy's estimate of the error of a step over what is allowed."""
    far = near = 0.0
    for m in range(4):
        allowed, high, low = atol[m] + rtol * max(abs(y[m]), abs(new[m])), 0.0, 0.0
        if order == 8:
            for j in range(12):
                high, low = high + E8[j] * k[j, m], low + E3[j] * k[j, m]
        else:
            for j in range(7):
                high += E5[j] * k[j, m]
        far, near = far + (high / allowed) ** 2, near + (low / allowed) ** 2
    if order == 8:
        # 0.5 is 1 / sqrt(4): SciPy's norm is the root mean square of the four components.
        return 0.5 * h * far / math.sqrt(far + 0.01 * near) if far > 0.0 else 0.0
    return 0.5 * h * math.sqrt(far)


@njit(cache=KEPT)
def slide_plane(rows, dt, cs, order, rtol):
    """Two axes: steps of order 5 or 8 to a relative tolerance, as `solver.rivals.by_scipy.plane`.

    rows, shape (n, 3), has G downslope and across, and mu N at the samples [m/s2]. Returns the PRD
    at the samples, the position in plan at the end (x, y), and the speed there.
    """
    y, new, k, p = np.zeros(4), np.zeros(4), np.empty((13, 4)), np.empty(6)
    atol = np.empty(4)
    # -1 / (order of the error estimate + 1); these orders are 7 and 4.
    last, exponent = (12, -0.125) if order == 8 else (6, -0.2)
    moving, prd, h = False, 0.0, dt
    for i in range(rows.shape[0] - 1):
        p[:3], p[3:] = rows[i], (rows[i + 1] - rows[i]) / dt
        top, t = largest(p, dt), 0.0
        while t < dt:
            if not moving:
                t = onset(p, t, dt)
                if not t < dt:
                    break
                h = begun(p, t, dt, rtol, top, y)
                t, moving = t + h, True
            speed = max(math.hypot(y[2], y[3]), 1e-5 * top)
            floor = rtol * (0.1 * speed + 0.01 * top)
            atol[:2], atol[2:] = 1e-2 * rtol * speed * dt, 1e-2 * rtol * speed
            _rate(2, t, y, p, k[0])
            while moving and t < dt:
                tried = min(h, dt - t)
                _stepped(2, order, t, tried, y, p, k, new)
                error = _error(order, tried, y, k, new, rtol, atol)
                # SciPy's limits on the change of a step, and its safety factor of 0.9.
                factor = min(10.0, max(0.2, 0.9 * error**exponent)) if error > 0.0 else 10.0
                h = factor * tried
                if error > 1.0 and tried > NEAR * dt:
                    continue
                before, slower = math.hypot(y[2], y[3]), math.hypot(new[2], new[3])
                t = dt if tried == dt - t else t + tried
                y[:], k[0] = new, k[last]
                # Near a stop the direction turns at |G| / w, and the steps shrink before w = 0.
                if (slower < before and slower < floor) or tried <= NEAR * dt:
                    y[2:], moving = 0.0, False
        prd = max(prd, math.hypot(cs * y[0], y[1]))
    return prd, cs * y[0], y[1], math.hypot(cs * y[2], y[3])
