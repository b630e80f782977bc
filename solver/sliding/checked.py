"""Runs one block under one motion: checks the input once, runs a method, returns the result.

Computes no physics itself (see `solver.kernels.one_axis`, and `solver.sliding.two_axes` for two
axes), knows no code rules (`solver.rules.provisions`) and chooses no model
(`solver.sliding.least_model`). Read `slide` first, then `scene`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from solver.model import (
    STANDARD_GRAVITY_MPS2,
    Floats,
    Friction,
    InputError,
    Scene,
    SlideHistory,
    SlideResult,
    coulomb,
)
from solver.records.record import read_only
from solver.rivals.methods import METHODS, NO_RECORD, WANTED, Method, Parameters
from solver.sliding import least_model, one_axis, two_axes
from solver.sliding.least_model import DEFAULT, Settings, Solution

_LARGEST = 1e120
"""Largest accelerations [m/s2] and distances [m] accepted: their squares are finite."""


def slide(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str = "exact",
    **parameters: float,
) -> SlideResult:
    """Slide a block on a sloped, shaken roof, resisted by friction alone.

    Parameters
    ----------
    ax_mps2 : array_like, shape (n,)
        Horizontal roof acceleration at even intervals [m/s2], linear between samples.
    dt_s : float
        Sampling interval [s], > 0.
    slope_rad : float
        Roof slope [rad], positive if positive ax points downslope; |slope| < pi/2.
    mu : float or Friction
        Friction coefficient, static and kinetic, >= 0; or a velocity-dependent friction law
        (`solver.Friction`), which only the method `exact` accepts and solves to a `tolerance`.
    ay_mps2 : array_like, shape (n,), optional
        Cross-slope horizontal roof acceleration, positive to the left when facing downslope [m/s2].
        If given, the block slides in two axes and the motion is solved to a `tolerance`.
    az_mps2 : array_like, shape (n,), optional
        Vertical roof acceleration, positive up [m/s2].
    scale : float
        Factor on all components.
    g_mps2 : float
        Acceleration of gravity [m/s2], > 0.
    method : str
        A key of `solver.METHODS`, which describes each one. `exact` solves the interpolated record
        event by event, within rounding error. `paper` is the explicit algorithm of Eqs. 1-19 of
        "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to Seismic Motion",
        horizontal shaking only.
    **parameters : float
        Parameters of the method: `substeps` per sampling interval; `stiffness_per_m` of a link per
        unit weight of the block [1/m]; `velocity_mps` and relative `tolerance` of the regularized
        friction; in two axes or with a friction law, `tolerance` relative to the PRD.

    Returns
    -------
    SlideResult
        Horizontal displacement relative to the roof with its error. NaN with the status and the
        time if the normal force falls below zero; NaN with the status if the method diverged or
        exceeded the limit on steps.

    Raises
    ------
    InputError
        With every argument that is not as above.

    Examples
    --------
    >>> pulse = [0.0, 4.0, -4.0, 0.0]
    >>> slide(pulse, 0.1, slope_rad=0.0, mu=0.2).status
    <Status.OK: 'ok'>
    """
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return two_axes.run(run, **parameters)
    return one_axis.run_method(METHODS[method], parameters, run)


def slide_history(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str = "exact",
    **parameters: float,
) -> SlideHistory:
    """Return the motion at the samples, with its events; arguments and errors as in `slide`.

    Only the method `exact` gives events: with the other methods slip begins and ends at unknown
    times within a step.
    """
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return two_axes.run_history(run, **parameters)
    return one_axis.method_history(METHODS[method], parameters, run)


def scene(
    ax_mps2: ArrayLike,
    dt_s: float,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | None = None,
    az_mps2: ArrayLike | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
) -> Scene:
    """Return a scene for `solver.solve`; arguments and errors as in `slide`."""
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    return _checked(records, dt_s, slope_rad, mu, scale, g_mps2, "exact", {})


def solve(scene: Scene, settings: Settings = DEFAULT) -> Solution:
    """Solve a scene with the simplest adequate model; see `solver.sliding.least_model.solve`.

    Raises
    ------
    InputError
        For a scene made by hand with values that `solver.scene` does not take, or a model that the
        scene does not allow.
    """
    return least_model.solve(_rechecked(scene), settings)


def history(scene: Scene, solution: Solution, settings: Settings = DEFAULT) -> SlideHistory:
    """Return the motion at the samples of a scene solved by `solve`, by the same model.

    Raises
    ------
    InputError
        As `solve`; for a row of blocks, whose blocks have a history each.
    """
    return least_model.history(_rechecked(scene), solution, settings)


def _rechecked(scene: Scene) -> Scene:
    records = {
        "ax_mps2": scene.ax_mps2,
        "ay_mps2": scene.ay_mps2 if np.size(scene.ay_mps2) else None,
        "az_mps2": scene.az_mps2 if np.size(scene.az_mps2) else None,
    }
    return _checked(
        records,
        scene.dt_s,
        scene.slope_rad,
        scene.friction,
        scene.scale,
        scene.g_mps2,
        "exact",
        {},
    )


def _is_followed_in_plane(scene: Scene) -> bool:
    """Whether the two-axes solver runs a scene: only it models velocity-dependent friction."""
    return bool(scene.ay_mps2.size) or not scene.friction.is_constant


def _checked(
    records: Mapping[str, ArrayLike | None],
    dt_s: float,
    slope_rad: float,
    mu: float | Friction,
    scale: float,
    g_mps2: float,
    method: str,
    parameters: Parameters,
) -> Scene:
    """Return the scene with read-only contiguous records, or raise with every error found."""
    problems: list[str] = []
    ax, ay, az = _checked_records(records, problems)
    friction = checked_friction("mu", mu, problems)
    numbers = {
        name: checked_number(name, value, wanted, fits, problems)
        for name, value, wanted, fits in (
            ("dt_s", dt_s, "a number of seconds above 0", lambda v: 0.0 < v < math.inf),
            ("slope_rad", slope_rad, "an angle between -pi/2 and pi/2", is_slope),
            ("scale", scale, "a finite factor", math.isfinite),
            ("g_mps2", g_mps2, "a number of m/s2 above 0", lambda v: 0.0 < v < math.inf),
        )
    }
    if not isinstance(method, str) or method not in METHODS:
        problems.append(f"method is {_shown(method)}; give one of {', '.join(METHODS)}")
    elif records["ay_mps2"] is not None or not friction.is_constant:
        problems += _plane_faults(method, parameters)
    else:
        problems += _faults(METHODS[method], parameters, records["az_mps2"] is not None)
    if problems:
        raise InputError(problems)
    run = Scene(ax_mps2=ax, ay_mps2=ay, az_mps2=az, friction=friction, **numbers)
    if faults := overflow(run):
        raise InputError(faults)
    return run


def overflow(scene: Scene) -> list[str]:
    """Return an error if squared accelerations, their rates or the distances would overflow."""
    records = (scene.ax_mps2, scene.ay_mps2, scene.az_mps2)
    peak = scene.scale * max(float(np.abs(record).max()) for record in records if record.size)
    lasts = scene.dt_s * (scene.ax_mps2.size - 1)
    mus = scene.friction.mu_slow, scene.friction.mu_fast, scene.friction.mu_static
    push = (abs(peak) + scene.g_mps2) * (1.0 + max(mus))
    rate = scene.dt_s * _LARGEST
    if push < min(_LARGEST, rate) and push * lasts * lasts < _LARGEST:
        return []
    return [
        f"accelerations of {push:.2g} m/s2, scaled and with gravity and friction, over {lasts:.2g} "
        f"s in steps of {scene.dt_s:.2g} s exceed the floating-point range; change scale, dt_s, mu "
        "or g_mps2"
    ]


def is_slope(value: float) -> bool:
    """Whether the value is a possible roof slope [rad]."""
    return abs(value) < math.pi / 2


def checked_number(
    name: str, value: object, wanted: str, fits: Callable[[float], bool], problems: list[str]
) -> float:
    """Return the value as a float, or NaN with a problem added; text and booleans are refused."""
    # A difference of dates is a number to numpy.
    wrong = isinstance(value, bool | np.bool_ | np.timedelta64)
    if isinstance(value, Real | np.number) and not wrong:
        try:
            number = float(value)
        except (OverflowError, TypeError):
            number = math.nan
        if fits(number):
            return number
    problems.append(f"{name} is {_shown(value)}; give {wanted}")
    return math.nan


def checked_friction(name: str, mu: float | Friction, problems: list[str]) -> Friction:
    """Return the friction law for a coefficient or a law, adding a problem for every error."""
    wanted = "a friction coefficient of 0 or more"
    if not isinstance(mu, Friction):
        return coulomb(checked_number(name, mu, wanted, _is_coefficient, problems))
    checked = Friction(
        mu_slow=checked_number("mu_slow", mu.mu_slow, wanted, _is_coefficient, problems),
        mu_fast=checked_number("mu_fast", mu.mu_fast, wanted, _is_coefficient, problems),
        rate_s_per_m=checked_number(
            "rate_s_per_m", mu.rate_s_per_m, "a number of s/m, 0 or more", _is_coefficient, problems
        ),
        mu_static=checked_number("mu_static", mu.mu_static, wanted, _is_coefficient, problems),
    )
    if checked.mu_static < checked.mu_slow:
        problems.append(
            f"mu_static is {checked.mu_static:g}; give mu_slow, {checked.mu_slow:g}, or more"
        )
    return checked


def _is_coefficient(value: float) -> bool:
    return 0.0 <= value < math.inf


def _shown(value: object) -> str:
    """Return the value given, shortened to one line."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _checked_records(records: Mapping[str, ArrayLike | None], problems: list[str]) -> list[Floats]:
    checked = {
        name: NO_RECORD
        if values is None and name != "ax_mps2"
        else checked_record(name, values, problems)
        for name, values in records.items()
    }
    shape = checked["ax_mps2"].shape
    problems += [
        f"{name} has shape {checked[name].shape}; give the shape of ax_mps2, {shape}"
        for name, values in records.items()
        if values is not None and checked[name].shape != shape
    ]
    return list(checked.values())


def _plane_faults(method: str, parameters: Parameters) -> list[str]:
    """Return the arguments that the two-axes solver does not accept."""
    problems: list[str] = []
    if method != "exact":
        problems.append(
            f"method is {method!r}; two axes and velocity-dependent friction need 'exact': omit "
            "ay_mps2 and give one coefficient, or omit the method"
        )
    low, high = two_axes.TOLERANCES
    wanted = f"a number from {low:g} to {high:g}"
    for name, value in parameters.items():
        if name != "tolerance":
            problems.append(f"two axes have no parameter {name!r}; the only one is tolerance")
        else:
            checked_number(name, value, wanted, lambda v: low <= v <= high, problems)
    return problems


def _faults(method: Method, parameters: Parameters, with_vertical: bool) -> list[str]:
    """Return the arguments that a method does not accept, and parameter values out of range."""
    problems: list[str] = []
    if with_vertical and not method.takes_vertical:
        problems.append(f"method {method.name!r} takes horizontal shaking only; omit az_mps2")
    for name, value in parameters.items():
        if name not in method.parameters:
            known = ", ".join(method.parameters) or "none"
            problems.append(f"method {method.name!r} has no parameter {name!r}; it has {known}")
        else:
            checked_number(name, value, *WANTED[name], problems)
    return problems


def checked_record(name: str, values: ArrayLike | None, problems: list[str]) -> Floats:
    """Return a read-only float64 view: numba would compile a second version for writable arrays."""
    wanted = f"{name} is not a row of real numbers; give a sequence of accelerations"
    try:
        given = np.asanyarray(values)
    except (TypeError, ValueError, OverflowError):
        problems.append(wanted)
        return NO_RECORD
    if given.dtype.kind not in "fiu" or (np.ma.isMaskedArray(given) and np.ma.is_masked(given)):
        what = "has masked samples" if given.dtype.kind in "fiu" else f"is of type {given.dtype}"
        problems.append(f"{name} {what}; give a sequence of accelerations, all real numbers")
        return NO_RECORD
    record = np.ascontiguousarray(given, dtype=np.float64)
    if record.ndim != 1 or record.size < 2:
        problems.append(f"{name} has shape {record.shape}; give one row of 2 samples or more")
        return NO_RECORD
    if not np.isfinite(record).all():
        first = int(np.flatnonzero(~np.isfinite(record))[0])
        problems.append(f"{name}[{first}] is {record[first]}; give finite accelerations")
    return read_only(record)
