"""The block in two axes by SciPy's DOP853, restarted at every sample and event: slow and plain.

Apart from the kernels: in horizontal coordinates (the paper's, with a second axis), by a general
solver of eighth order, with friction as a callable of speed.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import DOP853, solve_ivp
from scipy.optimize import brentq

RTOL = 1e-13
"""Of a step; its absolute tolerance is a hundredth of that by the speed at its beginning."""


@dataclass
class PlaneOracle:
    prd: float
    t_prd: float
    x_max: float
    x_min: float
    y_max: float
    y_min: float
    end: tuple[float, float]
    fastest: float  # along the roof
    n_stops: int
    events: list[tuple[float, float, float]]  # time, x, y: a slip, a stop, and so on
    history: np.ndarray

    @property
    def places(self):
        """In the order of the solver's `TwoAxesOutcome.places`."""
        return self.prd, self.x_max, -self.x_min, self.y_max, -self.y_min, *self.end


def follow(scene):
    """Return the motion of a scene, with its friction law."""
    friction = scene.friction
    drop = friction.mu_fast - friction.mu_slow
    return slide(
        scene.ax_mps2,
        scene.ay_mps2,
        scene.dt_s,
        slope_rad=scene.slope_rad,
        mu=lambda w: friction.mu_fast - drop * math.exp(-friction.rate_s_per_m * w),
        mu_static=friction.mu_static,
        az=scene.az_mps2 if scene.az_mps2.size else None,
        scale=scene.scale,
        g=scene.g_mps2,
    )


class _Interval:
    """Drive and normal force in one interval, linear in time, along the roof."""

    def __init__(self, sample_0, sample_1, dt):
        self.first, self.gain, self.dt = sample_0, (sample_1 - sample_0) / dt, dt

    def at(self, t):
        return self.first + self.gain * t


def slide(ax, ay, dt, *, slope_rad, mu, az=None, scale=1.0, g=9.80665, mu_static=None):
    """Return the motion of the linearly interpolated record; mu is a number or mu(speed)."""
    law = mu if callable(mu) else lambda _: mu
    hold = law(0.0) if mu_static is None else mu_static
    sn, cs = math.sin(slope_rad), math.cos(slope_rad)
    weight = g + scale * (np.zeros_like(ax) if az is None else np.asarray(az))
    rows = np.array(
        [
            sn * weight - cs * scale * np.asarray(ax),
            -scale * np.asarray(ay),
            cs * weight + sn * scale * np.asarray(ax),
        ]
    ).T
    state, moving, n_stops = np.zeros(4), False, 0
    seen, speeds, history, events = [np.zeros(3)], [0.0], np.zeros((4, len(ax))), []

    def push(x):
        return math.hypot(x[0], x[1]) - hold * x[2]

    for i in range(len(ax) - 1):
        span, t = _Interval(rows[i], rows[i + 1], dt), 0.0
        while t < dt:
            if not moving:
                if push(span.at(t)) <= 0.0:
                    if push(span.at(dt)) <= 0.0:
                        break
                    t = brentq(lambda t, s=span: push(s.at(t)), t, dt, xtol=1e-18, rtol=1e-15)
                    if t >= dt:
                        break
                events.append((i * dt + t, state[0] * cs, state[1]))
                t, state, moving = _begin(span, t, state, law)
                continue
            t, state, moving = _follow(span, t, state, law, (i * dt, seen), speeds, cs)
            if not moving:
                n_stops += 1
                events.append((i * dt + t, state[0] * cs, state[1]))
        history[:, i + 1] = state * (cs, 1.0, cs, 1.0)
    x, y, times = (np.array(seen) * (cs, 1.0, 1.0)).T
    far = np.hypot(x, y)
    return PlaneOracle(
        prd=float(far.max()),
        t_prd=float(times[far.argmax()]),
        x_max=float(x.max()),
        x_min=float(x.min()),
        y_max=float(y.max()),
        y_min=float(y.min()),
        end=(float(state[0] * cs), float(state[1])),
        fastest=max(speeds),
        n_stops=n_stops,
        events=events,
        history=history,
    )


def _begin(span, t, state, law):
    """The first instant of a slip: until the speed is 2e-5 of what it may soon be.

    So slow a block goes the way it is driven, behind it by the turn of the drive in w / |G|.
    """

    def net(h, y):
        x = span.at(t + h)
        return [y[1], math.hypot(x[0], x[1]) - law(max(y[1], 0.0)) * x[2]]

    def run(h):
        return solve_ivp(net, (0.0, h), [0.0, 0.0], method="DOP853", rtol=RTOL, atol=1e-20).y[:, -1]

    def turned(h):
        (x, y, _), (other_x, other_y, _) = span.at(t), span.at(t + h)
        return abs(math.atan2(x * other_y - y * other_x, x * other_x + y * other_y))

    longest = span.dt - t
    while net(longest, [0.0, 0.0])[1] < 0.0 or turned(longest) > 0.1:
        longest *= 0.5
    target = 2e-5 * run(longest)[1]
    high = brentq(lambda h: run(h)[1] - target, 1e-9 * longest, longest, rtol=1e-13)
    way, speed = run(high)
    x, y = span.at(t + high)[:2]
    drive = math.hypot(x, y)
    turn = (x * span.gain[1] - y * span.gain[0]) / drive**2
    angle = math.atan2(y, x) - speed * turn / (drive + net(high, [0.0, speed])[1])
    e = np.array([math.cos(angle), math.sin(angle)])
    return t + high, np.array([*(state[:2] + way * e), *(speed * e)]), True


def _follow(span, t, state, law, seen, speeds, cs):
    """Follow to the end of the interval or to a stop; looks at every extreme on the way.

    `seen` is the time when the interval begins, and the list of places.
    """
    top = span.dt * float(np.abs(span.at(0.0)).max() + np.abs(span.at(span.dt)).max())
    speed = max(math.hypot(state[2], state[3]), 1e-5 * top)
    floor, atol = 1e-13 * speed + 1e-14 * top, RTOL * speed * np.array([span.dt, span.dt, 1.0, 1.0])

    def rate(t, y):
        x, w = span.at(t), math.hypot(y[2], y[3])
        f = law(w) * x[2] / w
        return np.array([y[2], y[3], x[0] - f * y[2], x[1] - f * y[3]])

    solver = DOP853(rate, t, state, span.dt, rtol=RTOL, atol=1e-2 * atol)
    while solver.status == "running":
        w = math.hypot(*solver.y[2:])
        solver.step()
        if solver.status == "failed":
            raise ArithmeticError("DOP853 failed")
        _extremes(solver.dense_output(), solver, *seen, cs)
        _fastest(solver.dense_output(), solver, rate, speeds)
        slower = math.hypot(*solver.y[2:])
        if slower < floor and slower < w:
            return solver.t, np.array([solver.y[0], solver.y[1], 0.0, 0.0]), False
    return span.dt, solver.y, True


def _extremes(dense, solver, begun, seen, cs):
    seen.append([*solver.y[:2], begun + solver.t])
    times = np.linspace(solver.t_old, solver.t, 9)
    states = dense(times)
    for quantity in (lambda y: cs * cs * y[0] * y[2] + y[1] * y[3], lambda y: y[2], lambda y: y[3]):
        values = quantity(states)
        for a, b, first, other in zip(times[:-1], times[1:], values[:-1], values[1:], strict=True):
            if first * other < 0.0:
                root = brentq(lambda t, q=quantity: q(dense(t)), a, b, xtol=1e-16)
                seen.append([*dense(root)[:2], begun + root])


def _fastest(dense, solver, rate, speeds):
    """Note the speed at the end of a step, and where it is largest inside: v . v' is zero there."""

    def gains(t):
        return float(dense(t)[2:] @ rate(t, dense(t))[2:])

    times = np.linspace(solver.t_old, solver.t, 9)
    for a, b in pairwise(times):
        if gains(a) > 0.0 > gains(b):
            speeds.append(math.hypot(*dense(brentq(gains, a, b, xtol=1e-16))[2:]))
    speeds.append(math.hypot(*solver.y[2:]))
