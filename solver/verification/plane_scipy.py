"""A block in two axes by SciPy: a slow, accurate reference, and general-purpose solvers.

SciPy is imported only when needed. Independent of `solver.kernels.two_axes`: no series and no
bound. Read `reference`, then `regularized`. Symbols as in `solver.kernels.two_axes`.
"""

from __future__ import annotations

import importlib.util
import math
from typing import Literal, NamedTuple

import numpy as np

from solver.forces import forces
from solver.model import Floats, Scene

Solver = Literal["RK45", "DOP853", "Radau"]

REFERENCE_RTOL = 1e-12
"""Relative tolerance of a step."""

BEGINNING = 2e-5
"""Velocity from which a slip is integrated, as a share of what the interval can produce."""

EVALUATIONS = 40_000
"""Evaluations of the right-hand side after which a run counts as stalled."""


class Integrated(NamedTuple):
    """Result of a solver; of a run that was not completed, all lengths are NaN."""

    prd_m: float  # largest distance in plan at its steps [m]
    end_m: tuple[float, float]  # final position, x and y [m]
    end_speed_mps: float
    steps: int  # of a general-purpose solver, evaluations of the right-hand side


def is_installed() -> bool:
    """Whether SciPy is installed."""
    return importlib.util.find_spec("scipy") is not None


def samples_of(scene: Scene) -> Floats:
    """Return downslope G, cross-slope G and mu N at the samples, shape (n, 3) [m/s2]."""
    on = forces(scene)
    cap = scene.friction.mu_slow * on.normal_mps2
    return np.column_stack([on.down_mps2, on.across_mps2, cap])


class _Interval:
    """G and mu N between two samples, and the block's acceleration there."""

    def __init__(self, first: Floats, last: Floats, dt: float):
        self.dt = dt
        self.x, self.y, self.c = first.tolist()
        self.rx, self.ry, self.rc = ((last - first) / dt).tolist()

    def at(self, t: float) -> tuple[float, float, float]:
        return self.x + self.rx * t, self.y + self.ry * t, self.c + self.rc * t

    def excess(self, t: float) -> float:
        """Drive in excess of the friction capacity."""
        x, y, c = self.at(t)
        return math.hypot(x, y) - c

    def rate(self, t: float, y: Floats) -> Floats:
        _, _, vx, vy = y.tolist()
        f = (self.c + self.rc * t) / math.hypot(vx, vy)
        return np.array([vx, vy, self.x + self.rx * t - f * vx, self.y + self.ry * t - f * vy])

    def gained(self, t: float, h: float) -> float:
        """Return the velocity that a block gains in h from rest, by Simpson's rule."""
        ends = max(self.excess(t), 0.0) + self.excess(t + h)
        return h * (ends + 4.0 * self.excess(t + 0.5 * h)) / 6.0


def reference(scene: Scene) -> Floats:
    """Return the position at the samples, shape (2, n) [m]: x downslope, y cross-slope.

    DOP853 with Coulomb friction, restarted at every sample and at each onset of slip, ended at
    each stop. A slip begins in the direction of the drive, see `BEGINNING`.
    """
    rows = samples_of(scene)
    places = np.zeros((2, len(rows)))
    state, moving = np.zeros(4), False
    for i in range(len(rows) - 1):
        span, t = _Interval(rows[i], rows[i + 1], scene.dt_s), 0.0
        while t < scene.dt_s:
            if moving:
                t, state, moving = _slid(span, t, state)
                continue
            onset = _onset(span, t)
            if not onset < scene.dt_s:
                break
            t, state, moving = _begun(span, onset, state)
        places[:, i + 1] = state[:2]
    places[0] *= math.cos(scene.slope_rad)
    return places


def _onset(span: _Interval, t: float) -> float:
    """Onset of slip of a block at rest at t, inf if none; |G| - mu N is convex."""
    from scipy.optimize import brentq

    if span.excess(t) > 0.0:
        return t
    if span.excess(span.dt) <= 0.0:
        return math.inf
    return float(brentq(span.excess, t, span.dt, xtol=1e-18, rtol=1e-15))


def _begun(span: _Interval, t: float, state: Floats) -> tuple[float, Floats, bool]:
    """Return the start of a slip: along G, lagging by the rotation of G during w / |G|."""
    from scipy.optimize import brentq

    left = span.dt - t
    if span.excess(span.dt) < 0.0 < span.excess(t):  # the block gains no more after that
        left = float(brentq(span.excess, t, span.dt, rtol=1e-14)) - t
    wanted = BEGINNING * span.gained(t, left)
    h = float(brentq(lambda h: span.gained(t, h) - wanted, 0.0, left, rtol=1e-14, xtol=1e-25))
    x, y, c = span.at(t + h)
    speed, drive = span.gained(t, h), math.hypot(x, y)
    lag = speed * (x * span.ry - y * span.rx) / drive**2 / (2.0 * drive - c)
    angle = math.atan2(y, x) - lag
    way = h * h * (max(span.excess(t), 0.0) / 3.0 + span.excess(t + h) / 6.0)
    e = np.array([math.cos(angle), math.sin(angle)])
    return t + h, np.concatenate([state[:2] + way * e, speed * e]), True


def _slid(span: _Interval, t: float, state: Floats) -> tuple[float, Floats, bool]:
    """Follow a slip to the end of the interval or to a stop."""
    from scipy.integrate import DOP853

    top = span.dt * max(math.hypot(*span.at(u)[:2]) + span.at(u)[2] for u in (0.0, span.dt))
    speed = max(math.hypot(state[2], state[3]), 1e-5 * top)
    floor = 1e-13 * speed + 1e-14 * top
    atol = 1e-2 * REFERENCE_RTOL * speed * span.dt
    solver = DOP853(span.rate, t, state, span.dt, rtol=REFERENCE_RTOL, atol=atol)
    while solver.t < span.dt:
        before = math.hypot(solver.y[2], solver.y[3])
        message = solver.step()
        slower = math.hypot(solver.y[2], solver.y[3])
        if message or (slower < floor and slower < before):
            return float(solver.t), np.array([solver.y[0], solver.y[1], 0.0, 0.0]), False
    return span.dt, np.asarray(solver.y), True


class _StalledError(Exception):
    """The limit on evaluations is reached."""


class _Rate:
    """Rate of the state with friction mu N tanh(w / v0); v0 = 0: Coulomb friction, none at rest."""

    def __init__(self, scene: Scene, velocity: float):
        self.rows: list[list[float]] = samples_of(scene).tolist()
        self.dt, self.velocity = scene.dt_s, velocity
        self.asked = 0

    def __call__(self, t: float, y: Floats) -> tuple[float, float, float, float]:
        self.asked += 1
        if self.asked > EVALUATIONS:
            raise _StalledError
        _, _, vx, vy = y.tolist()
        i = min(int(t / self.dt), len(self.rows) - 2)
        part = t / self.dt - i
        gx, gy, c = (
            a + (b - a) * part for a, b in zip(self.rows[i], self.rows[i + 1], strict=True)
        )
        w = math.hypot(vx, vy)
        f = 0.0
        if w > 0.0:
            f = c * (math.tanh(w / self.velocity) if self.velocity > 0.0 else 1.0) / w
        return vx, vy, gx - f * vx, gy - f * vy


def regularized(scene: Scene, solver: Solver, velocity_mps: float, tolerance: float) -> Integrated:
    """Run one of SciPy's adaptive solvers without events.

    Parameters
    ----------
    solver : Solver
    velocity_mps : float
        v0 of the friction mu N tanh(w / v0); 0 for Coulomb friction with its discontinuity.
    tolerance : float
        Relative; the absolute tolerance is a thousandth of it, as in SciPy's defaults.
    """
    from scipy.integrate import solve_ivp

    rate = _Rate(scene, velocity_mps)
    end = (scene.ax_mps2.size - 1) * scene.dt_s
    lost = math.nan, (math.nan, math.nan), math.nan
    try:
        with np.errstate(over="ignore"):  # from Radau's finite differences for the Jacobian
            solution = solve_ivp(
                rate, (0.0, end), np.zeros(4), method=solver, rtol=tolerance, atol=1e-3 * tolerance
            )
    except _StalledError:
        return Integrated(*lost, rate.asked)
    if not (solution.success and np.isfinite(solution.y).all()):
        return Integrated(*lost, rate.asked)
    x, y = solution.y[0] * math.cos(scene.slope_rad), solution.y[1]
    return Integrated(
        prd_m=float(np.hypot(x, y).max()),
        end_m=(float(x[-1]), float(y[-1])),
        end_speed_mps=math.hypot(*solution.y[2:, -1].tolist()),
        steps=rate.asked,
    )
