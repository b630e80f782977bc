"""The sliding block by SciPy's solvers, in one axis and in two: with events, and regularized.

Each as fast as SciPy allows: jitted right-hand sides (`solver.kernels.rivals`), no step across a
kink of the record, no step at rest. SciPy is imported where it runs. Shares nothing with the exact
kernels: `plane` is the reference of two axes. Symbols as in `solver.kernels.two_axes`.
"""

from __future__ import annotations

import importlib
import importlib.util
import math
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

from solver.kernels import rivals
from solver.model import Floats, InputError

# Velocity from which a slip in two axes is integrated, as a share of what the interval gives.
BEGINNING = 2e-5

# Part of a step after which the end of a slip is sought that begins with the step.
LATER = 1e-9

# Tolerances of the time of an event [s]; those that SciPy has unless told cost five digits.
_NEAR = {"xtol": 1e-18, "rtol": 1e-15}

# Steps in a sampling interval after which a regularized run counts as stalled.
STEPS = 20_000


def is_installed() -> bool:
    """Whether SciPy is installed."""
    return importlib.util.find_spec("scipy") is not None


def _scipy(module: str) -> Any:
    """Import a module of SciPy, or raise `InputError` with what to install."""
    try:
        return importlib.import_module(f"scipy.{module}")
    except ImportError:
        raise InputError(
            "SciPy is not installed, which this method needs; "
            "install roofslip[verify] or choose another method"
        ) from None


class _Interval:
    """G and mu N between two samples."""

    def __init__(self, first: Sequence[float], last: Sequence[float], dt: float):
        self.dt = dt
        self.x, self.y, self.c = first
        self.rx, self.ry, self.rc = ((b - a) / dt for a, b in zip(first, last, strict=True))

    def at(self, t: float) -> tuple[float, float, float]:
        return self.x + self.rx * t, self.y + self.ry * t, self.c + self.rc * t

    def excess(self, t: float) -> float:
        """Drive in excess of the friction capacity, which is convex in t."""
        x, y, c = self.at(t)
        return math.hypot(x, y) - c

    def onset(self, t: float) -> float:
        """Onset of slip of a block at rest at t; the end of the interval if there is none."""
        if self.excess(t) > 0.0:
            return t
        # Convex: at or below zero at both ends, it is so between them.
        if self.excess(self.dt) <= 0.0:
            return self.dt
        return float(_scipy("optimize").brentq(self.excess, t, self.dt, **_NEAR))

    def gained(self, t: float, h: float) -> float:
        """Return the velocity that a block gains in h from rest, by Simpson's rule."""
        ends = max(self.excess(t), 0.0) + self.excess(t + h)
        return h * (ends + 4.0 * self.excess(t + 0.5 * h)) / 6.0


def _slips(rows: Floats) -> list[bool]:
    """Whether a block at rest may slip in each interval, where |G| - mu N is convex."""
    free = np.hypot(rows[:, 0], rows[:, 1]) > rows[:, 2]
    slips: list[bool] = (free[:-1] | free[1:]).tolist()
    return slips


def line(drive: Floats, cap: Floats, dt: float, solver: str, history: Floats) -> tuple[Any, ...]:
    """Solve one axis with Coulomb friction, restarted at every sample, onset of slip and stop.

    `drive` and `cap` are G and mu N at the samples [m/s2], shape (n,); the solver is "DOP853" or
    "RK45". A history of shape (2, n), or (2, 0), is filled with s and w at the samples. Returns
    what the kernels of `solver.kernels.rivals` do, with True in place of the code. Raises
    `InputError` if SciPy is not installed.
    """
    rows = np.column_stack([drive, np.zeros_like(drive), cap])
    step, root = getattr(_scipy("integrate"), solver), _scipy("optimize").brentq
    s = w = 0.0
    # s is extreme at a stop or at the end.
    seen, n_stops = [(0.0, 0.0)], 0
    samples = rows.tolist()
    for i, slips in enumerate(_slips(rows)):
        if history.size:
            history[:, i] = s, w
        if not slips and w == 0.0:
            continue
        span, t = _Interval(samples[i], samples[i + 1], dt), 0.0
        while t < dt:
            begins = w == 0.0
            t = span.onset(t) if begins else t
            if not t < dt:
                break
            sign = math.copysign(1.0, span.x + span.rx * t if begins else w)
            push, rise = span.x - sign * span.c, span.rx - sign * span.rc
            # One step for the whole interval: the motion is cubic in time, which every solver but
            # those of low order follows at any tolerance.
            run = step(
                lambda t, y, push=push, rise=rise: rivals.line_rate(t, y, push, rise),
                t, np.array((s, w)), dt, first_step=dt - t, rtol=1e-6, atol=1e-9,
            )  # fmt: skip
            run.step()
            way, first, last = run.dense_output(), t, run.t
            # The speed may reach zero between samples and rise again: it is least where the net
            # acceleration turns along it. One that begins with the slip rises, and then falls.
            turn = -push / rise if sign * rise > 0.0 else last
            if not begins and first < turn < last and sign * way(turn)[1] <= 0.0:
                last = turn
            elif sign * run.y[1] > 0.0:
                (s, w), t = run.y.tolist(), last
                continue
            # w is zero where the slip begins: its end is the next zero.
            if begins:
                first += LATER * (last - first)
            ends = sign * way(first)[1] > 0.0
            stop = root(lambda u, way=way: way(u)[1], first, last, **_NEAR) if ends else first
            s, w, t = float(way(stop)[0]), 0.0, max(float(stop), math.nextafter(t, math.inf))
            seen.append((s, i * dt + t))
            n_stops += 1
    if history.size:
        history[:, -1] = s, w
    seen.append((s, (len(rows) - 1) * dt))
    distances = [distance for distance, _ in seen]
    t_peak = max(seen, key=lambda pair: abs(pair[0]))[1]
    return True, max(distances), min(distances), s, w, t_peak, n_stops


def plane(rows: Floats, dt: float, solver: str = "DOP853", rtol: float = 1e-12) -> Floats:
    """Solve two axes with Coulomb friction, restarted at every sample, onset of slip and stop.

    A slip begins in the direction of the drive, see `BEGINNING`, and ends where the speed, whose
    direction turns ever faster, is a negligible part of what it was. `rows`, shape (n, 3), are
    downslope G, cross-slope G and mu N at the samples [m/s2]; the solver is "DOP853" or "RK45".
    Returns distances downslope and cross-slope, and their rates, at the samples [m], [m/s], shape
    (4, n).
    """
    step = getattr(_scipy("integrate"), solver)
    states = np.zeros((4, len(rows)))
    state, moving = np.zeros(4), False
    samples = rows.tolist()
    for i, slips in enumerate(_slips(rows)):
        span, t = _Interval(samples[i], samples[i + 1], dt), 0.0
        while (slips or moving) and t < dt:
            if not moving:
                t = span.onset(t)
                if not t < dt:
                    break
                t, state = _begun(span, t, state)
            t, state, moving = _slid(span, t, state, step, rtol)
        states[:, i + 1] = state
    return states


def _begun(span: _Interval, t: float, state: Floats) -> tuple[float, Floats]:
    """Return the start of a slip: along G, lagging by the rotation of G during w / |G|."""
    root = _scipy("optimize").brentq
    left = span.dt - t
    if span.excess(span.dt) < 0.0 < span.excess(t):  # the block gains no more after that
        left = float(root(span.excess, t, span.dt, rtol=1e-14)) - t
    wanted = BEGINNING * span.gained(t, left)
    h = float(root(lambda h: span.gained(t, h) - wanted, 0.0, left, rtol=1e-14, xtol=1e-25))
    x, y, c = span.at(t + h)
    speed, drive = span.gained(t, h), math.hypot(x, y)
    # The direction follows that of G behind by its turn in w / |G| (the singularity at w = 0).
    lag = speed * (x * span.ry - y * span.rx) / drive**2 / (2.0 * drive - c)
    angle = math.atan2(y, x) - lag
    way = h * h * (max(span.excess(t), 0.0) / 3.0 + span.excess(t + h) / 6.0)
    e = np.array([math.cos(angle), math.sin(angle)])
    return t + h, np.concatenate([state[:2] + way * e, speed * e])


def _slid(
    span: _Interval, t: float, state: Floats, step: Any, rtol: float
) -> tuple[float, Floats, bool]:
    """Follow a slip to the end of the interval or to a stop; return time, state, and which."""
    top = span.dt * max(math.hypot(*span.at(u)[:2]) + span.at(u)[2] for u in (0.0, span.dt))
    speed = max(math.hypot(state[2], state[3]), 1e-5 * top)
    floor = rtol * (0.1 * speed + 0.01 * top)
    terms = span.x, span.y, span.c, span.rx, span.ry, span.rc
    run = step(
        lambda t, state: rivals.plane_rate(t, state, *terms),
        t, state, span.dt, rtol=rtol, atol=1e-2 * rtol * speed * span.dt,
    )  # fmt: skip
    # Near a stop the direction turns at |G| / w, and the steps shrink without reaching w = 0.
    while run.t < span.dt:
        before = math.hypot(run.y[2], run.y[3])
        message = run.step()
        slower = math.hypot(run.y[2], run.y[3])
        if message or (slower < floor and slower < before):
            return float(run.t), np.array([run.y[0], run.y[1], 0.0, 0.0]), False
    return span.dt, np.asarray(run.y), True


def regularized(rows: Floats, dt: float, v0: float, rtol: float) -> Floats:
    """Solve one axis or two with friction mu N tanh(w / v0), by LSODA with its Jacobian.

    `rows`, shape (n, 2) or (n, 3), are G along each axis, and mu N, at the samples [m/s2]; v0 is a
    velocity [m/s]. Returns distances, then velocities, at the samples [m], [m/s], shape (2, n) or
    (4, n); NaN if the run has stalled. Raises `InputError` if SciPy is not installed.
    """
    integrate = _scipy("integrate")
    # The absolute tolerance below is a thousandth of the relative one, as in SciPy's defaults.
    start, times = np.zeros(2 * (rows.shape[1] - 1)), np.arange(len(rows)) * dt
    with warnings.catch_warnings():
        # odeint returns numbers where it has given up; only the warning tells.
        warnings.simplefilter("error", integrate.ODEintWarning)
        try:
            states: Floats = integrate.odeint(
                rivals.regularized_rate, start, times, (rows, dt, v0), tfirst=True,
                Dfun=rivals.regularized_jacobian, rtol=rtol, atol=1e-3 * rtol, hmax=dt,
                mxstep=STEPS,
            )  # fmt: skip
        except integrate.ODEintWarning:
            return np.full((start.size, len(rows)), math.nan)
    return states.T
