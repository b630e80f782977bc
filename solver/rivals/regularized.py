"""Regularized friction, mu N tanh(v / v_0), by SciPy's adaptive Runge-Kutta without events.

A straightforward use of a general-purpose ODE solver. SciPy is imported only when this method runs;
no other method needs it. Notation as in `solver.kernels.rivals`.
"""

from __future__ import annotations

import math

import numpy as np

from solver.model import Floats, InputError

EVALUATIONS = 1_000_000
"""Evaluations of the right-hand side before a run is abandoned as stalled."""

ABSOLUTE_PER_RELATIVE = 1e-3
"""Absolute tolerance [m], [m/s] / relative tolerance, as in SciPy's defaults, 1e-6 and 1e-3."""


class _StalledError(Exception):
    """The limit on evaluations is reached."""


class _Rate:
    """Computes s' and s'' at any time, and counts its calls."""

    def __init__(self, drive: Floats, cap: Floats, dt: float, velocity: float):
        self.drive: list[float] = drive.tolist()
        self.cap: list[float] = cap.tolist()
        self.dt, self.velocity = dt, velocity
        self.last = len(self.drive) - 2
        self.asked = 0

    def __call__(self, t: float, y: Floats) -> tuple[float, float]:
        self.asked += 1
        if self.asked > EVALUATIONS:
            raise _StalledError
        w = float(y[1])
        i = min(int(t / self.dt), self.last)
        part = t / self.dt - i
        drive = self.drive[i] + (self.drive[i + 1] - self.drive[i]) * part
        cap = self.cap[i] + (self.cap[i + 1] - self.cap[i]) * part
        return w, drive - cap * math.tanh(w / self.velocity)


def slide(
    drive: Floats, cap: Floats, dt: float, velocity: float, tolerance: float, history: Floats
) -> tuple[bool, float, float, float, float, float, int]:
    """Return whether the run reached the end, then the results as from `solver.kernels.rivals`.

    Parameters
    ----------
    drive, cap : array, shape (n,)
        G and mu N at the samples [m/s2].
    velocity : float
        v_0 [m/s]; a block slower than v_0 at the end counts as at rest.
    tolerance : float
        Relative tolerance; the absolute tolerance is proportional to it.
    history : array, shape (2, n) or (2, 0)
        Filled with s and w at the samples.

    Raises
    ------
    InputError
        If SciPy is not installed.
    """
    try:
        from scipy.integrate import solve_ivp
    except ImportError:
        raise InputError(
            "method 'regularized' needs SciPy, which is not installed; "
            "install roofslip[verify] or choose another method"
        ) from None
    rate = _Rate(drive, cap, dt, velocity)
    try:
        solution = solve_ivp(
            rate,
            (0.0, (drive.size - 1) * dt),
            (0.0, 0.0),
            method="RK45",
            rtol=tolerance,
            atol=ABSOLUTE_PER_RELATIVE * tolerance,
            dense_output=history.shape[1] > 0,
        )
    except _StalledError:
        return False, math.nan, math.nan, math.nan, math.nan, math.nan, 0
    s, w = solution.y
    if not (solution.success and np.isfinite(s).all()):
        return False, math.nan, math.nan, math.nan, math.nan, math.nan, 0
    if solution.sol is not None:
        history[:] = solution.sol(np.arange(drive.size) * dt)
    peak = int(np.abs(s).argmax())
    moving = np.sign(w) * (np.abs(w) > velocity)
    n_stops = int(((moving[:-1] != 0.0) & (moving[1:] != moving[:-1])).sum())
    end = float(w[-1]) if moving[-1] else 0.0
    return True, float(s.max()), float(s.min()), float(s[-1]), end, float(solution.t[peak]), n_stops
