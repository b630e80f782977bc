"""Runs one block under one motion: checks the input once, runs a method, returns the result.

Checks nothing itself (`solver.sliding.arguments`), computes no physics (`solver.kernels.one_axis`,
and `solver.sliding.two_axes` for two axes), knows no code rules (`solver.rules.provisions`) and
chooses no model (`solver.sliding.model_selection`). Read `slide` first, then `scene`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solver.errors import InputError
from solver.model import STANDARD_GRAVITY_MPS2, Friction, Motion, Scene, SlideHistory, SlideResult
from solver.records.record import Record
from solver.sliding import model_selection, one_axis, two_axes
from solver.sliding.arguments import Given, MotionArguments, method_of, scene_of, shortened
from solver.sliding.method import Method
from solver.sliding.model_selection import DEFAULT, Settings, Solution
from solver.sliding.quick import quick_slide


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
    units: str | None = None,
    **parameters: float,
) -> SlideResult:
    """Slide a block on a sloped, shaken roof, resisted by friction alone.

    Parameters
    ----------
    ax_mps2 : array_like, shape (n,), Record or Motion
        Horizontal roof acceleration at even intervals [m/s2], linear between samples. A motion is
        used with all its components and its scale, as recorded. The index of a Series of pandas is
        its time, in seconds or as time deltas, unless it counts samples; its unit is that of its
        name, such as ``a_g``, or `units`.
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
    units : {"g", "m/s2", "cm/s2", "mm/s2"}, optional
        Unit of arrays; by default m/s2, with a warning if they are too weak to cause slip.
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
    # A sweep of one's own calls this many thousand times: a quarter of the time.
    is_alone = ay_mps2 is None and az_mps2 is None and dt_s is None and units is None
    is_exact = isinstance(method, str) and method == "exact" and not parameters
    if type(ax_mps2) is Record and is_alone and is_exact and not isinstance(mu, Friction):
        result = quick_slide(ax_mps2, slope_rad, mu, scale, g_mps2)
        if result is not None:
            return result
    shaking = MotionArguments(ax_mps2, ay_mps2, az_mps2, dt_s, scale, units)
    run = scene_of(shaking, slope_rad, mu, g_mps2, method, parameters)
    # `tolerance` is the only possible parameter: `scene_of` rejects all others.
    if _is_in_two_axes(run):
        return two_axes.run(run, **parameters)
    return one_axis.run(run, method_of(method), **parameters)


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
    units: str | None = None,
    **parameters: float,
) -> SlideHistory:
    """Return the motion of a block at the samples of the record, with its events.

    Only the method `exact` gives events: with the other methods slip begins and ends at unknown
    times within a step.

    Parameters
    ----------
    ax_mps2, dt_s, slope_rad, mu, ay_mps2, az_mps2, scale, g_mps2, method, units, **parameters
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
    shaking = MotionArguments(ax_mps2, ay_mps2, az_mps2, dt_s, scale, units)
    run = scene_of(shaking, slope_rad, mu, g_mps2, method, parameters)
    if _is_in_two_axes(run):
        return two_axes.run_history(run, **parameters)
    return one_axis.run_history(run, method_of(method), **parameters)


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
    units: str | None = None,
) -> Scene:
    """Return one block under one motion, checked, for `solver.solve`.

    Parameters
    ----------
    ax_mps2, dt_s, slope_rad, mu, ay_mps2, az_mps2, scale, g_mps2, units
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
    shaking = MotionArguments(ax_mps2, ay_mps2, az_mps2, dt_s, scale, units)
    return scene_of(shaking, slope_rad, mu, g_mps2)


def motion(
    ax_mps2: Given,
    ay_mps2: ArrayLike | Record | None = None,
    az_mps2: ArrayLike | Record | None = None,
    *,
    dt_s: float | None = None,
    id: str = "",
    source: str = "",
    scale: float = 1.0,
    signs: tuple[int, ...] | None = None,
    units: str | None = None,
) -> Motion:
    """Return a motion of one to three components, for a study or for any run.

    Parameters
    ----------
    ax_mps2 : array_like, shape (n,), Record or Motion
        Horizontal acceleration [m/s2]; a motion is used with its components and scale.
    ay_mps2, az_mps2 : array_like, shape (n,), or Record, optional
        The other horizontal acceleration and the vertical one, positive up [m/s2].
    dt_s : float, optional
        Sampling interval [s], > 0; a record or a motion has its own.
    id, source : str
        Name, by default that of the record, and origin of the motion.
    scale : float
        Factor on all components.
    signs : tuple of int
        Polarities in which a study runs each horizontal component, from {+1, -1}: by default those
        of the motion passed, or both.
    units : {"g", "m/s2", "cm/s2", "mm/s2"}, optional
        Of arrays; m/s2 unless given.

    Returns
    -------
    Motion

    Raises
    ------
    InputError
        With every argument that is not as above.

    Examples
    --------
    >>> up = [0.0, 1.0, -1.0, 0.0]
    >>> motion([0.0, 4.0, -4.0, 0.0], az_mps2=up, dt_s=0.1, id="pulse", scale=1.5)
    Motion: pulse, x and z, 4 samples of 0.1 s, scale 1.5
    """
    shaking = MotionArguments(ax_mps2, ay_mps2, az_mps2, dt_s, scale, units)
    # A motion has no slope and no friction: zeros pass every check.
    checked = scene_of(shaking, 0.0, 0.0, STANDARD_GRAVITY_MPS2)
    x = ax_mps2
    if signs is None:
        signs = x.signs if isinstance(x, Motion) else (1, -1)
    if not signs or not {*signs} <= {1, -1}:
        raise InputError(f"signs is {shortened(signs)}; use +1, -1 or both")
    own_name = x.name if isinstance(x, Record) else "motion"
    return Motion(
        id=id or (x.id if isinstance(x, Motion) else own_name),
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
    all more complete models, which are run for the comparison.

    Parameters
    ----------
    scene : Scene
        Created by `solver.scene` or `Motion.scene`.
    settings : Settings
        Criteria, or the model to use.

    Returns
    -------
    Solution
        The result with its model, the reason, and the effect of a more complete model.

    Raises
    ------
    InputError
        For a scene built without `solver.scene` that has invalid values, or for a model that the
        scene does not allow.

    Examples
    --------
    >>> from solver import scene
    >>> solve(scene([0.0, 4.0, -4.0, 0.0, 0.0, 0.0], 0.1, slope_rad=0.0, mu=0.2))
    Solution: one axis; the motion has one component only
    SlideResult: PRD 4.9 mm at 0.17 s, +1.6 mm at the end, 2 stops, ok
    Required friction coefficient 0.408; no more complete model applies
    """
    return model_selection.solve(_rechecked(scene), settings)


def history(scene: Scene, solution: Solution, settings: Settings = DEFAULT) -> SlideHistory:
    """Return the motion of a solved scene at the samples, by the same model.

    Parameters
    ----------
    scene : Scene
    solution : Solution
        Of this scene.
    settings : Settings
        Same as passed to `solve`.

    Returns
    -------
    SlideHistory

    Raises
    ------
    InputError
        Same as `solve`; also for a row of blocks, because each block has its own history.

    Examples
    --------
    >>> from solver import scene
    >>> pulse = scene([0.0, 4.0, -4.0, 0.0, 0.0, 0.0], 0.1, slope_rad=0.0, mu=0.2)
    >>> history(pulse, solve(pulse))
    SlideHistory: 6 samples, 4 events; PRD 4.9 mm at 0.17 s, +1.6 mm at the end, 2 stops, ok
    """
    return model_selection.history(_rechecked(scene), solution, settings)


def _rechecked(scene: Scene) -> Scene:
    # It may be made by hand, without `scene`. The unit is said, so that nothing warns again of weak
    # shaking.
    ay, az = (a if np.size(a) else None for a in (scene.ay_mps2, scene.az_mps2))
    shaking = MotionArguments(scene.ax_mps2, ay, az, scene.dt_s, scene.scale, "m/s2")
    return scene_of(shaking, scene.slope_rad, scene.friction, scene.g_mps2)


def _is_in_two_axes(scene: Scene) -> bool:
    """Whether a scene is run in two axes; only these model velocity-dependent friction."""
    return bool(scene.ay_mps2.size) or not scene.friction.is_constant
