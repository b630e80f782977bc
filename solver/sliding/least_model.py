"""Selects the simplest adequate model of a scene: one array under one motion.

Integrates nothing itself (`solver.sliding.one_axis` and `solver.sliding.two_axes` do) and knows no
code rules. Read `Model`, then `solve`.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any

from solver.forces import friction_demand
from solver.model import InputError, Scene, SlideHistory, SlideResult, Status, coulomb
from solver.records.record import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.sliding.one_axis import RecordBounds, bounds_of


class Model(IntEnum):
    """The models of a scene, from the simplest to the most complete."""

    NO_SLIP = 0
    ONE_AXIS = 1
    ONE_AXIS_VERTICAL = 2
    TWO_AXES = 3
    SPEED_FRICTION = 4

    @property
    def title(self) -> str:
        """Name of the model for the reader."""
        return _TITLES[self]


_TITLES = {
    Model.NO_SLIP: "no slip",
    Model.ONE_AXIS: "one axis",
    Model.ONE_AXIS_VERTICAL: "one axis with vertical",
    Model.TWO_AXES: "two axes with vertical",
    Model.SPEED_FRICTION: "two axes, velocity-dependent friction",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """Criteria for selecting the model.

    Attributes
    ----------
    matters_m, matters_share : float
        A component is not modeled if its effect on the PRD, every excursion and the residual is at
        most the larger of the first [m] and the second as a fraction of the PRD.
    tolerance : float
        Tolerance in two axes and with velocity-dependent friction, 1e-10 to 1e-2 of the PRD.
    forced : Model or None
        Use this model only.
    """

    matters_m: float = 1e-3
    matters_share: float = 0.005
    tolerance: float = two_axes.DEFAULT_TOLERANCE
    forced: Model | None = None

    def bound_m(self, prd_m: float) -> float:
        """Return the effect on a displacement up to which a component is not modeled [m]."""
        return max(self.matters_m, self.matters_share * prd_m)


DEFAULT = Settings()

_LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """Result of a scene, the model used, and the effect of a more complete model.

    Attributes
    ----------
    model : Model
    reason : str
        Why this model was used, as a clause.
    result : SlideResult
    next_model : Model
        The first more complete model that was not used; the model itself if there is none.
    next_effect_m : float
        Largest change of the PRD, an excursion or a residual by the more complete models [m], from
        runs of them and including their errors; inf if such a run gives no displacement, NaN if the
        input has no data for a more complete model.
    friction_demand : float
        Largest ratio of shear to normal force with no slip. The block slips if this exceeds the
        friction coefficient. inf if the normal force is zero or negative at a sample.
    """

    model: Model
    reason: str
    result: SlideResult
    next_model: Model
    next_effect_m: float
    friction_demand: float

    def __repr__(self) -> str:
        return f"Solution: {self.model.title}; {self.reason}\n{self.result}\n{self._beyond}"

    @property
    def _beyond(self) -> str:
        required = f"Required friction coefficient {self.friction_demand:.3f}"
        if self.next_model is self.model:
            return f"{required}; no more complete model applies"
        effect = f"changes no displacement by more than {1e3 * self.next_effect_m:.2g} mm"
        return f"{required}; the model '{self.next_model.title}' {effect}"

    def __getattr__(self, name: str) -> Any:
        """Return a value by its name of 0.2, which this version still knows."""
        if name not in ("rung", "next_rung"):
            raise AttributeError(name)
        now = name.replace("rung", "model")
        warnings.warn(f"Solution.{name} is Solution.{now} now", DeprecationWarning, stacklevel=2)
        return getattr(self, now)


def solve(
    scene: Scene, settings: Settings = DEFAULT, bounds: RecordBounds | None = None
) -> Solution:
    """Solve a scene with the simplest adequate model; see `solver.sliding.checked.solve`.

    If the friction demand never exceeds the coefficient at rest, the block does not slip and no
    models are compared. Otherwise the simplest model is used whose PRD, excursions and residuals
    agree within `Settings.bound_m` with those of all more complete ones, error bounds included. The
    more complete models are run for this comparison: the effect of cross-slope shaking accumulates
    along the whole path, so no estimate from one axis alone bounds it. Velocity-dependent friction
    is modeled whenever the scene has it. If the normal force falls below zero no model gives a
    displacement, not even a forced one. `bounds` are those of the scene, where they are known.
    Raises `InputError` for a forced model that the scene does not allow.
    """
    demand = friction_demand(scene)
    # N of just zero has no demand either, and yet a motion: only N below zero is uplift.
    if math.isinf(demand) and one_axis.run(scene).status is Status.UPLIFT:
        return _lifted(scene)
    if settings.forced is None:
        return _climbed(scene, settings, demand, bounds or bounds_of(scene))
    return _forced(scene, settings, settings.forced, demand)


def history(scene: Scene, solution: Solution, settings: Settings = DEFAULT) -> SlideHistory:
    """Return the motion at the samples of a solved scene, by the same model."""
    run = as_run(scene, solution.model)
    if solution.model >= Model.TWO_AXES:
        return two_axes.run_history(run, settings.tolerance)
    return one_axis.run_history(run)


def _climbed(scene: Scene, settings: Settings, demand: float, bounds: RecordBounds) -> Solution:
    if demand <= scene.friction.mu_static:
        return _still(scene, demand, bounds)
    if not scene.friction.is_constant:
        why = "the friction coefficient depends on velocity"
        return _in_plane(scene, settings, Model.SPEED_FRICTION, why, demand)
    vertical = one_axis.run_bounded(scene, bounds)
    bound = settings.bound_m(vertical.prd_m)
    # The costly run, once: what each simpler model leaves out is read from it.
    both = (
        two_axes.run_bounded(scene, settings.tolerance, bounds) if scene.ay_mps2.any() else vertical
    )
    less = lesser = _left_out(vertical, both)
    # Otherwise the level run is farther than the bound from one of both: they are twice it apart.
    if less <= 2.0 * bound:
        level = one_axis.run_bounded(_level(scene), bounds) if scene.az_mps2.size else vertical
        lesser = _left_out(level, vertical, both)
    if lesser <= bound:
        why = "the motion has no other component"
        if scene.az_mps2.size or scene.ay_mps2.size:
            why = f"no other component changes a displacement by more than {_mm(bound)}"
        return _along(scene, Model.ONE_AXIS, level, lesser, why, demand)
    if less <= bound:
        why = (
            f"neglecting the vertical component changes a displacement by {_mm(lesser)}, more than "
            f"{_mm(bound)}"
        )
        return _along(scene, Model.ONE_AXIS_VERTICAL, vertical, less, why, demand)
    why = (
        f"neglecting the second horizontal component changes a displacement by {_mm(less)}, "
        f"more than {_mm(bound)}"
    )
    return _without_next(Model.TWO_AXES, why, both, demand)


def _left_out(chosen: SlideResult, *fuller: SlideResult) -> float:
    """Return the largest change of a displacement by more complete models [m]; inf: none."""
    # Excursions are compared as well: two models may give the same PRD by chance on different
    # paths. So are residuals, which cumulative displacement adds up.
    effects = [
        abs(getattr(result, name) - getattr(chosen, name)) + result.error_m
        for result in fuller
        if result is not chosen
        for name in _LENGTHS
    ]
    return math.inf if any(map(math.isnan, effects)) else max(effects, default=0.0)


def _forced(scene: Scene, settings: Settings, model: Model, demand: float) -> Solution:
    hold, why = scene.friction.mu_static, "requested"
    if model is Model.NO_SLIP and demand > hold:
        raise InputError(
            f"the model 'no slip' is requested, but the required friction coefficient, "
            f"{demand:.3g}, exceeds that given, {hold:.3g}; request a more complete model"
        )
    if model is Model.NO_SLIP:
        return _still(scene, demand, bounds_of(scene))
    if model >= Model.TWO_AXES:
        return _in_plane(scene, settings, model, why, demand)
    # Unlike `_climbed`: the effect is told even where it is far beyond the bound.
    result, fuller = one_axis.run(as_run(scene, model)), []
    if scene.ay_mps2.any():
        fuller.append(two_axes.run(as_run(scene, Model.TWO_AXES), settings.tolerance))
    if model is Model.ONE_AXIS and scene.az_mps2.size:
        fuller.append(one_axis.run(scene))
    return _along(scene, model, result, _left_out(result, *fuller), why, demand)


def _without_next(
    model: Model, why: str, result: SlideResult, demand: float, effect_m: float = math.nan
) -> Solution:
    """Return a solution by the most complete model that applies."""
    return Solution(
        model=model,
        reason=why,
        result=result,
        next_model=model,
        next_effect_m=effect_m,
        friction_demand=demand,
    )


def _lifted(scene: Scene) -> Solution:
    model = Model.ONE_AXIS_VERTICAL if scene.az_mps2.size else Model.ONE_AXIS
    why = "the normal force falls below zero, which no model covers"
    return _without_next(model, why, one_axis.run(scene), math.inf)


def _still(scene: Scene, demand: float, bounds: RecordBounds) -> Solution:
    hold = scene.friction.mu_static
    why = f"the required friction coefficient, {demand:.2f}, is below that given, {hold:.2f}"
    result = one_axis.run_bounded(as_run(scene, Model.NO_SLIP), bounds)
    return _without_next(Model.NO_SLIP, why, result, demand, effect_m=0.0)


def _along(
    scene: Scene, model: Model, result: SlideResult, effect: float, why: str, demand: float
) -> Solution:
    """Return a solution in one axis, with the effect of the components neglected."""
    alone = _without_next(model, why, result, demand)
    if model is Model.ONE_AXIS and scene.az_mps2.size:
        return replace(alone, next_model=Model.ONE_AXIS_VERTICAL, next_effect_m=effect)
    if scene.ay_mps2.size:
        return replace(alone, next_model=Model.TWO_AXES, next_effect_m=effect)
    return alone


def _in_plane(scene: Scene, settings: Settings, model: Model, why: str, demand: float) -> Solution:
    result = two_axes.run(as_run(scene, model), settings.tolerance)
    solution = _without_next(model, why, result, demand)
    if scene.friction.is_constant or model is Model.SPEED_FRICTION:
        return solution
    # Constant friction was asked for where the scene has a law: what that changes is told.
    effect = _left_out(result, two_axes.run(scene, settings.tolerance))
    return replace(solution, next_model=Model.SPEED_FRICTION, next_effect_m=effect)


def as_run(scene: Scene, model: Model) -> Scene:
    """Return the scene as a model runs it, without the vertical or the friction law it neglects.

    The cross-slope component is still there where a run in one axis ignores it.
    """
    if model is Model.NO_SLIP:
        # It never leaves rest, where this coefficient holds.
        return replace(scene, friction=coulomb(scene.friction.mu_static))
    if model is Model.ONE_AXIS:
        return _level(scene)
    if model is Model.TWO_AXES:
        return replace(scene, friction=coulomb(scene.friction.mu_slow))
    return scene


def _level(scene: Scene) -> Scene:
    return replace(scene, az_mps2=NO_RECORD)


def _mm(value_m: float) -> str:
    return f"{float(f'{value_m * 1e3:.2g}'):g} mm"
