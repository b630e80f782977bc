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
    Motion,
    Scene,
    SlideHistory,
    SlideResult,
    coulomb,
)
from solver.records.record import Record, read_only
from solver.rivals.methods import ANY_NUMBER, METHODS, NO_RECORD, WANTED, Method, Parameters
from solver.sliding import least_model, one_axis, two_axes
from solver.sliding.least_model import DEFAULT, Settings, Solution

Given = ArrayLike | Record | Motion
"""Shaking as it is: a row of accelerations with a step beside it, a record, or a whole motion."""

_LARGEST = 1e120
"""Largest accelerations [m/s2] and distances [m] accepted: their squares are finite."""


def slide(
    ax_mps2: Given,
    dt_s: float | None = None,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | Record | None = None,
    az_mps2: ArrayLike | Record | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str | Method = "exact",
    **parameters: float,
) -> SlideResult:
    """Slide a block on a sloped, shaken roof, resisted by friction alone.

    Parameters
    ----------
    ax_mps2 : array_like, shape (n,), Record or Motion
        Horizontal roof acceleration at even intervals [m/s2], linear between samples. A motion is
        taken with all its components and its scale, as recorded.
    dt_s : float, optional
        Sampling interval [s], > 0; a record or a motion has its own.
    slope_rad : float
        Roof slope [rad], positive if positive ax points downslope; |slope| < pi/2.
    mu : float or Friction
        Friction coefficient, static and kinetic, >= 0; or a velocity-dependent friction law
        (`solver.Friction`), which only the method `exact` accepts and solves to a `tolerance`.
    ay_mps2 : array_like, shape (n,), or Record, optional
        Cross-slope horizontal roof acceleration, positive to the left when facing downslope [m/s2].
        If given, the block slides in two axes and the motion is solved to a `tolerance`.
    az_mps2 : array_like, shape (n,), or Record, optional
        Vertical roof acceleration, positive up [m/s2].
    scale : float
        Factor on all components.
    g_mps2 : float
        Acceleration of gravity [m/s2], > 0.
    method : str or Method
        A key of `solver.METHODS`, which describes each one, or a method of your own. `exact` solves
        the interpolated record event by event, within rounding error. `paper` is the explicit
        algorithm of Eqs. 1-19 of "Predicted Slip of Ballasted Solar Arrays on Angled Roofs due to
        Seismic Motion", horizontal shaking only.
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
    >>> pulse = [0.0, 4.0, -4.0, 0.0, 0.0, 0.0]
    >>> slide(pulse, 0.1, slope_rad=0.0, mu=0.2)
    SlideResult: PRD 4.9 mm at 0.17 s, +1.6 mm at the end, 2 stops, ok
    """
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return two_axes.run(run, **parameters)
    return one_axis.run_method(_method(method), parameters, run)


def slide_history(
    ax_mps2: Given,
    dt_s: float | None = None,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | Record | None = None,
    az_mps2: ArrayLike | Record | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
    method: str | Method = "exact",
    **parameters: float,
) -> SlideHistory:
    """Return the motion of a block at the samples of the record, with its events.

    Only the method `exact` gives events: with the other methods slip begins and ends at unknown
    times within a step.

    Parameters
    ----------
    ax_mps2, dt_s, slope_rad, mu, ay_mps2, az_mps2, scale, g_mps2, method, **parameters
        As in `slide`.

    Returns
    -------
    SlideHistory

    Raises
    ------
    InputError
        As `slide`.

    Examples
    --------
    >>> pulse = [0.0, 4.0, -4.0, 0.0, 0.0, 0.0]
    >>> slide_history(pulse, 0.1, slope_rad=0.0, mu=0.2).to_frame().round(4)
            u_m   v_mps
    t_s
    0.0  0.0000  0.0000
    0.1 -0.0009 -0.0520
    0.2 -0.0047  0.0260
    0.3  0.0014  0.0298
    0.4  0.0016  0.0000
    0.5  0.0016  0.0000
    """
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    run = _checked(records, dt_s, slope_rad, mu, scale, g_mps2, method, parameters)
    if _is_followed_in_plane(run):
        return two_axes.run_history(run, **parameters)
    return one_axis.method_history(_method(method), parameters, run)


def scene(
    ax_mps2: Given,
    dt_s: float | None = None,
    *,
    slope_rad: float,
    mu: float | Friction,
    ay_mps2: ArrayLike | Record | None = None,
    az_mps2: ArrayLike | Record | None = None,
    scale: float = 1.0,
    g_mps2: float = STANDARD_GRAVITY_MPS2,
) -> Scene:
    """Return one block under one motion, checked, for `solver.solve`.

    Parameters
    ----------
    ax_mps2, dt_s, slope_rad, mu, ay_mps2, az_mps2, scale, g_mps2
        As in `slide`.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        As `slide`.

    Examples
    --------
    >>> scene([0.0, 4.0, -4.0, 0.0], 0.1, slope_rad=0.0, mu=0.2)
    Scene(1 component of 4 samples at 0.1 s, slope 0 deg, mu 0.2, scale 1)
    """
    records = {"ax_mps2": ax_mps2, "ay_mps2": ay_mps2, "az_mps2": az_mps2}
    return _checked(records, dt_s, slope_rad, mu, scale, g_mps2, "exact", {})


def motion(
    x: Given,
    y: ArrayLike | Record | None = None,
    z: ArrayLike | Record | None = None,
    *,
    dt_s: float | None = None,
    id: str = "",
    source: str = "",
    scale: float = 1.0,
    signs: tuple[int, ...] = (1, -1),
) -> Motion:
    """Return a motion of one to three components, for a study or for any run.

    Parameters
    ----------
    x : array_like, shape (n,), Record or Motion
        Horizontal acceleration [m/s2]; a motion is taken with its components, and scaled.
    y, z : array_like, shape (n,), or Record, optional
        The other horizontal acceleration and the vertical one, positive up [m/s2].
    dt_s : float, optional
        Sampling interval [s], > 0; a record or a motion has its own.
    id, source : str
        Name, by default that of the record, and where the motion comes from.
    scale : float
        Factor on all components.
    signs : tuple of int
        Polarities in which a study runs each horizontal component, from {+1, -1}.

    Returns
    -------
    Motion

    Raises
    ------
    InputError
        With every argument that is not as above.

    Examples
    --------
    >>> motion([0.0, 4.0, -4.0, 0.0], z=[0.0, 1.0, -1.0, 0.0], dt_s=0.1, id="pulse", scale=1.5)
    Motion: pulse, x and z, 4 samples of 0.1 s, scale 1.5
    """
    checked = _checked(
        {"ax_mps2": x, "ay_mps2": y, "az_mps2": z},
        dt_s,
        0.0,
        0.0,
        scale,
        STANDARD_GRAVITY_MPS2,
        "exact",
        {},
    )
    if not signs or not {*signs} <= {1, -1}:
        raise InputError(f"signs is {_shown(signs)}; give +1, -1 or both")
    own = x.name if isinstance(x, Record) else "motion"
    return Motion(
        id=id or (x.id if isinstance(x, Motion) else own),
        source=source or (x.source if isinstance(x, Motion) else ""),
        dt_s=checked.dt_s,
        ax_mps2=checked.ax_mps2,
        ay_mps2=checked.ay_mps2,
        az_mps2=checked.az_mps2,
        scale=checked.scale,
        signs=tuple(signs),
    )


def solve(scene: Scene, settings: Settings = DEFAULT) -> Solution:
    """Solve a scene with the simplest adequate model.

    The model is the simplest whose displacements agree, within `Settings.bound_m`, with those of
    all more complete models, which are run for the comparison; see
    `solver.sliding.least_model.solve`.

    Parameters
    ----------
    scene : Scene
        As `solver.scene` or `Motion.scene` makes it.
    settings : Settings
        What matters, or which model to use.

    Returns
    -------
    Solution
        The result with its model, the reason, and the effect of a more complete model.

    Raises
    ------
    InputError
        For a scene made by hand with values that `solver.scene` does not take, or a model that the
        scene does not allow.

    Examples
    --------
    >>> from solver import scene
    >>> solve(scene([0.0, 4.0, -4.0, 0.0, 0.0, 0.0], 0.1, slope_rad=0.0, mu=0.2))
    Solution: one axis; the motion has no other component
    SlideResult: PRD 4.9 mm at 0.17 s, +1.6 mm at the end, 2 stops, ok
    Friction demand 0.408; no more complete model applies
    """
    return least_model.solve(_rechecked(scene), settings)


def history(scene: Scene, solution: Solution, settings: Settings = DEFAULT) -> SlideHistory:
    """Return the motion of a solved scene at the samples, by the same model.

    Parameters
    ----------
    scene : Scene
    solution : Solution
        Of this scene.
    settings : Settings
        As given to `solve`.

    Returns
    -------
    SlideHistory

    Raises
    ------
    InputError
        As `solve`; for a row of blocks, whose blocks have a history each.

    Examples
    --------
    >>> from solver import scene
    >>> pulse = scene([0.0, 4.0, -4.0, 0.0, 0.0, 0.0], 0.1, slope_rad=0.0, mu=0.2)
    >>> history(pulse, solve(pulse))
    SlideHistory: 6 samples, 4 events; PRD 4.9 mm at 0.17 s, +1.6 mm at the end, 2 stops, ok
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


def _method(method: str | Method) -> Method:
    return method if isinstance(method, Method) else METHODS[method]


def _is_followed_in_plane(scene: Scene) -> bool:
    """Whether the two-axes solver runs a scene: only it models velocity-dependent friction."""
    return bool(scene.ay_mps2.size) or not scene.friction.is_constant


def unpacked(
    given: Mapping[str, Given | None], dt_s: float | None, problems: list[str]
) -> tuple[dict[str, ArrayLike | None], float | None, float]:
    """Return components as arrays, their step and their factor, from records or a motion.

    Parameters
    ----------
    given : mapping
        By the names of the arguments, that along the slope first, which alone may be a motion.
    """
    along, *others = given.values()
    steps = {each.dt_s for each in given.values() if isinstance(each, Record | Motion)}
    if steps and dt_s is not None:
        problems.append("dt_s is given beside a record or a motion, which has its own; omit it")
    if len(steps) > 1:
        shown = " and ".join(f"{step:g} s" for step in sorted(steps))
        problems.append(f"the components have steps of {shown}; give components of one step")
    dt_s = max(steps, default=dt_s)
    if any(isinstance(each, Motion) for each in others):
        problems.append("a motion is given as one component; give it first and alone")
    if not isinstance(along, Motion):
        return {name: _samples(each) for name, each in given.items()}, dt_s, 1.0
    if any(each is not None for each in others):
        problems.append("a motion is given with further components; give it alone")
    components = {name: getattr(along, name) for name in ("ax_mps2", "ay_mps2", "az_mps2")}
    return {n: a if a.size else None for n, a in components.items()}, dt_s, along.scale


def _samples(given: Given | None) -> ArrayLike | None:
    if isinstance(given, Record):
        return given.a_mps2
    return None if isinstance(given, Motion) else given


def _checked(
    given: Mapping[str, Given | None],
    dt_s: float | None,
    slope_rad: float,
    mu: float | Friction,
    scale: float,
    g_mps2: float,
    method: str | Method,
    parameters: Parameters,
) -> Scene:
    """Return the scene with read-only contiguous records, or raise with every error found."""
    problems: list[str] = []
    records, dt_s, factor = unpacked(given, dt_s, problems)
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
    if not isinstance(method, Method) and not (isinstance(method, str) and method in METHODS):
        problems.append(f"method is {_shown(method)}; give one of {', '.join(METHODS)}")
    elif records["ay_mps2"] is not None or not friction.is_constant:
        problems += _plane_faults(method, parameters)
    else:
        problems += _faults(_method(method), parameters, records["az_mps2"] is not None)
    if problems:
        raise InputError(problems)
    numbers["scale"] *= factor
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


def _plane_faults(method: str | Method, parameters: Parameters) -> list[str]:
    """Return the arguments that the two-axes solver does not accept."""
    problems: list[str] = []
    if method != "exact":
        problems.append(
            f"method is {_shown(method)}; two axes and velocity-dependent friction need 'exact': "
            "omit ay_mps2 and give one coefficient, or omit the method"
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
            checked_number(name, value, *WANTED.get(name, ANY_NUMBER), problems)
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
