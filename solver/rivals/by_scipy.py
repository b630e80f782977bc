"""The sliding block by SciPy's solvers, in one axis and in two: with events, and regularized.

`slide(..., method="events-rk45")` runs `line`, `method="regularized"` runs `regularized`.

Each as fast as SciPy allows: jitted right-hand sides (`solver.kernels.rivals`) and onsets, no
step across a kink of the record, no step at rest. SciPy is imported where it runs. Shares nothing
with the exact kernels: `plane` is the reference of two axes. Symbols as in
`solver.kernels.two_axes`.
"""

from __future__ import annotations

import importlib
import importlib.util
import math
import warnings
from typing import Any

import numpy as np

from solver.errors import InputError
from solver.kernels import rivals, runge_kutta
from solver.model import Floats

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
            "install the extra verify or choose another method"
        ) from None


def _interval(rows: Floats, i: int, dt: float) -> Floats:
    """Return G, downslope and across, and mu N at sample i, then their rates, as kernels do."""
    return np.concatenate([rows[i], (rows[i + 1] - rows[i]) / dt])


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
    # Arranged as for two axes, so that the same function finds the onset.
    rows = np.column_stack([drive, np.zeros_like(drive), cap])
    step, root = getattr(_scipy("integrate"), solver), _scipy("optimize").brentq
    s = w = 0.0
    # s is extreme at a stop or at the end.
    seen, n_stops = [(0.0, 0.0)], 0
    for i, slips in enumerate(_slips(rows)):
        if history.size:
            history[:, i] = s, w
        if not slips and w == 0.0:
            continue
        p, t = _interval(rows, i, dt), 0.0
        while t < dt:
            begins = w == 0.0
            t = runge_kutta.onset(p, t, dt) if begins else t
            if not t < dt:
                break
            sign = math.copysign(1.0, p[0] + p[3] * t if begins else w)
            push, rise = (p[0::3] - sign * p[2::3]).tolist()
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
                first += runge_kutta.LATER * (last - first)
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

    A slip begins in the direction of the drive, see `runge_kutta.begun`, and ends where the speed,
    whose direction turns ever faster, is a negligible part of what it was. `rows`, shape (n, 3),
    are downslope G, cross-slope G and mu N at the samples [m/s2]; the solver is "DOP853" or "RK45".
    Returns distances downslope and cross-slope, and their rates, at the samples [m], [m/s], shape
    (4, n).
    """
    step = getattr(_scipy("integrate"), solver)
    states = np.zeros((4, len(rows)))
    state, moving = np.zeros(4), False
    for i, slips in enumerate(_slips(rows)):
        p, t = _interval(rows, i, dt), 0.0
        top = runge_kutta.largest(p, dt)
        while (slips or moving) and t < dt:
            if not moving:
                t = runge_kutta.onset(p, t, dt)
                if not t < dt:
                    break
                state = state.copy()
                t += runge_kutta.begun(p, t, dt, rtol, top, state)
            t, state, moving = _slid(p, t, dt, state, step, rtol, top)
        states[:, i + 1] = state
    return states


def _slid(
    p: Floats, t: float, dt: float, state: Floats, step: Any, rtol: float, top: float
) -> tuple[float, Floats, bool]:
    """Follow a slip to the end of the interval or to a stop; return time, state, and which."""
    speed = max(math.hypot(state[2], state[3]), 1e-5 * top)
    floor = rtol * (0.1 * speed + 0.01 * top)
    terms = p.tolist()
    run = step(
        lambda t, state: rivals.plane_rate(t, state, *terms),
        t, state, dt, rtol=rtol, atol=1e-2 * rtol * speed * dt,
    )  # fmt: skip
    # Near a stop the direction turns at |G| / w, and the steps shrink without reaching w = 0.
    while run.t < dt:
        before = math.hypot(run.y[2], run.y[3])
        message = run.step()
        slower = math.hypot(run.y[2], run.y[3])
        if message or (slower < floor and slower < before):
            return float(run.t), np.array([run.y[0], run.y[1], 0.0, 0.0]), False
    return dt, np.asarray(run.y), True


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
