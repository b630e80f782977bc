"""Selects the simplest adequate model of a scene: one array under one motion.

A motion of three components on 2 degrees at mu = 0.4 is run in one axis if neither the vertical
nor the cross-slope component changes a displacement by more than 1 mm, or 0.5% of the PRD.

Integrates nothing itself (`solver.sliding.one_axis` and `solver.sliding.two_axes` do) and knows no
code rules. Read `Model`, then `solve`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import cached_property, partial
from itertools import product

from solver.errors import InputError
from solver.forces import components, friction_demand
from solver.kernels import cross_slope as kernel
from solver.model import Scene, SlideHistory, SlideResult, Status, coulomb
from solver.records.record import NO_RECORD
from solver.sliding import one_axis, two_axes
from solver.sliding.one_axis import RecordBounds, bounds_of
from solver.spaces import NO_BREAK, spaced


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
        # Below a PRD of 200 mm the first value governs. With a percentage alone, 0.05 mm would
        # matter for a PRD of 10 mm, and every component would be modeled.
        return max(self.matters_m, self.matters_share * prd_m)


DEFAULT = Settings()

# Why a model was used, and the effect of more complete ones [m].
_Explanation = tuple[str, float]

_LENGTHS = ("prd_m", "down_m", "up_m", "across_m", "residual_m", "residual_across_m")


@dataclass(frozen=True, kw_only=True)
class Solution:
    """Result of a scene, the model used, and the effect of a more complete model.

    Values not needed to select the model are computed once, on first access: `reason` and
    `next_effect_m` make the skipped runs, `friction_demand` reads the samples.

    Attributes
    ----------
    model : Model
    result : SlideResult
    next_model : Model
        The first more complete model that was not used; the model itself if there is none.
    """

    model: Model
    result: SlideResult
    next_model: Model
    scene: Scene = field(repr=False, compare=False)
    # The reason and the effect, or what returns them.
    explanation: _Explanation | Callable[[], _Explanation] = field(repr=False, compare=False)

    @property
    def reason(self) -> str:
        """Why this model was used, as a clause."""
        return self._explained[0]

    @property
    def next_effect_m(self) -> float:
        """Largest change of the PRD, an excursion or a residual by the more complete models [m].

        From runs of these models, including their errors; inf if such a run gives no displacement,
        NaN if the input has no data for a more complete model.
        """
        return self._explained[1]

    @cached_property
    def friction_demand(self) -> float:
        """Largest ratio of shear to normal force with no slip.

        The block slips if this exceeds the friction coefficient. inf if the normal force is zero or
        negative at a sample.
        """
        return friction_demand(self.scene)

    @cached_property
    def _explained(self) -> _Explanation:
        return self.explanation if isinstance(self.explanation, tuple) else self.explanation()

    def __repr__(self) -> str:
        return spaced(f"Solution: {self.model.title}; {self.reason}\n{self.result}\n{self._beyond}")

    @property
    def _beyond(self) -> str:
        required = f"Required friction coefficient {self.friction_demand:.3f}"
        if self.next_model is self.model:
            return f"{required}; no more complete model applies"
        effect = f"changes no displacement by more than {1e3 * self.next_effect_m:.2g} mm"
        return f"{required}; the model '{self.next_model.title}' {effect}"


def solve(
    scene: Scene, settings: Settings = DEFAULT, bounds: RecordBounds | None = None
) -> Solution:
    """Solve a scene with the simplest adequate model; see `solver.sliding.checked.solve`.

    If the friction demand never exceeds the coefficient at rest, the block does not slip and no
    models are compared. Otherwise the simplest model is used whose PRD, excursions and residuals
    agree within `Settings.bound_m` with those of all more complete ones, error bounds included. The
    run in two axes is skipped if the record alone shows that cross-slope shaking changes less
    (`solver.kernels.cross_slope`); the runs in one axis are skipped if the cross-slope displacement
    in two axes is not negligible. Velocity-dependent friction is always modeled if the scene
    specifies it. If the normal force falls below zero no model gives a displacement, not even a
    forced one. `bounds` are those of the scene, if known. Raises `InputError` for a
    forced model that the scene does not allow.
    """
    if settings.forced is None:
        return _climbed(scene, settings, bounds)
    demand = friction_demand(scene)
    # N of just zero has no demand either, and yet a motion: only N below zero is uplift.
    if math.isinf(demand) and one_axis.run(scene).status is Status.UPLIFT:
        return _lifted(scene)
    return _forced(scene, settings, settings.forced, demand)


def history(scene: Scene, solution: Solution, settings: Settings = DEFAULT) -> SlideHistory:
    """Return the motion at the samples of a solved scene, by the same model."""
    run = as_run(scene, solution.model)
    if solution.model >= Model.TWO_AXES:
        return two_axes.run_history(run, settings.tolerance)
    return one_axis.run_history(run)


def _climbed(scene: Scene, settings: Settings, bounds: RecordBounds | None) -> Solution:
    slope, samples = (math.sin(scene.slope_rad), math.cos(scene.slope_rad)), components(scene)
    # A block rests while |G| <= mu N (Eqs. 8-9 of the paper). Both are linear between samples, so
    # the samples alone tell whether it ever slips.
    hold = scene.friction.mu_static
    first = kernel.first_slip(*samples, *slope, hold, scene.g_mps2, scene.scale)
    if first == scene.ax_mps2.size:
        return _still(scene, bounds)
    if not scene.friction.is_constant:
        why = "the friction coefficient depends on velocity"
        solution = _in_plane(scene, settings, Model.SPEED_FRICTION, why)
    else:
        model, result, both = _chosen(scene, settings, bounds, first)
        explain = partial(_explain, scene, settings, model, both)
        solution = _solution(scene, model, result, explain)
    return _lifted(scene) if solution.result.status is Status.UPLIFT else solution


def _chosen(
    scene: Scene, settings: Settings, bounds: RecordBounds | None, first: int
) -> tuple[Model, SlideResult, SlideResult | None]:
    """Return the simplest adequate model, its result, and the two-axes result if it was needed."""
    both, at_most = None, 0.0
    if scene.ay_mps2.size:
        bounds = bounds or bounds_of(scene)
        at_most = _second_axis_at_most(scene, settings, first)
        # The costly run: once, and only where no bound shows that it is not needed.
        if math.isinf(at_most):
            both = two_axes.run_bounded(scene, settings.tolerance, bounds)
            # Where one axis would do, its PRD less that share of it is at most the PRD in two: what
            # goes farther across than may be neglected beside such a PRD settles it.
            share = 1.0 - settings.matters_share
            if share > 0.0 and both.across_m > settings.bound_m(both.prd_m / share):
                return Model.TWO_AXES, both, both
    # Runs in one axis cost about one pass over the record each: both are always made.
    vertical = _run_along(scene, bounds)
    level = _run_along(_level(scene), bounds) if scene.az_mps2.size else vertical
    bound, lesser = settings.bound_m(vertical.prd_m), _left_out(level, vertical)
    # The bound is one of exact motions: a run may differ from its own by its error.
    at_most += vertical.error_m if at_most else 0.0
    # Neglecting both components changes no more than the sum of both effects. Only between those
    # two, where the sum decides and the single effects do not, is the run in two axes needed.
    if not at_most <= bound or lesser <= bound < lesser + at_most:
        both = both or two_axes.run_bounded(scene, settings.tolerance, bounds or bounds_of(scene))
        at_most = _left_out(vertical, both)
        lesser = at_most if level is vertical else _left_out(level, vertical, both)
    if lesser <= bound:
        return Model.ONE_AXIS, level, both
    if both is None or at_most <= bound:
        return Model.ONE_AXIS_VERTICAL, vertical, both
    return Model.TWO_AXES, both, both


def _second_axis_at_most(scene: Scene, settings: Settings, first: int) -> float:
    """Return the largest possible effect of the second horizontal component [m]; inf if unknown."""
    effect: float = kernel.cross_slope_effect(
        *components(scene),
        scene.dt_s,
        math.sin(scene.slope_rad),
        math.cos(scene.slope_rad),
        scene.friction.mu_slow,
        scene.g_mps2,
        scene.scale,
        settings.matters_m,
        settings.matters_share,
        first,
    )
    return effect


def _run_along(scene: Scene, bounds: RecordBounds | None) -> SlideResult:
    return one_axis.run_bounded(scene, bounds) if bounds else one_axis.run(scene)


def _explain(
    scene: Scene, settings: Settings, model: Model, both: SlideResult | None
) -> _Explanation:
    """Return why a model is used and what it neglects [m], from runs of all of them."""
    if not (scene.ay_mps2.size or scene.az_mps2.size):
        return "the motion has one component only", math.nan
    vertical = level = one_axis.run(scene)
    if scene.az_mps2.size:
        level = one_axis.run(_level(scene))
    if both is None:
        # A record of zeros changes nothing: no run is made of it.
        has_second = scene.ay_mps2.any()
        both = two_axes.run(scene, settings.tolerance) if has_second else vertical
    crosswise, lesser = _left_out(vertical, both), _left_out(level, vertical, both)
    bound = _mm(settings.bound_m(vertical.prd_m))
    if model is Model.ONE_AXIS:
        return f"no other component changes a displacement by more than {bound}", lesser
    if model is Model.ONE_AXIS_VERTICAL:
        neglecting, changed = "neglecting the vertical component", lesser
    else:
        neglecting, changed = "neglecting the second horizontal component", crosswise
    why = f"{neglecting} would change a displacement by {_mm(changed)} (tolerance {bound})"
    return why, crosswise if scene.ay_mps2.size and model is Model.ONE_AXIS_VERTICAL else math.nan


def _left_out(chosen: SlideResult, *fuller: SlideResult) -> float:
    """Return the largest change of a displacement by more complete models [m]; inf: none."""
    # Excursions are compared as well: two models may give the same PRD by chance on different
    # paths. So are residuals, because cumulative displacement is their sum. The error of the more
    # complete model is added: its result is uncertain by that amount.
    effects = [
        abs(getattr(result, name) - getattr(chosen, name)) + result.error_m
        for result, name in product(fuller, _LENGTHS)
        if result is not chosen
    ]
    # A model that gives no displacement might change anything.
    return math.inf if any(map(math.isnan, effects)) else max(effects, default=0.0)


def _forced(scene: Scene, settings: Settings, model: Model, demand: float) -> Solution:
    hold, why = scene.friction.mu_static, "requested"
    if model is Model.NO_SLIP and demand > hold:
        raise InputError(
            f"the model 'no slip' is requested, but the required friction coefficient, "
            f"{demand:.3g}, exceeds the entered coefficient, {hold:.3g}; request a more"
            " complete model"
        )
    if model is Model.NO_SLIP:
        return _still(scene, None)
    if model >= Model.TWO_AXES:
        return _in_plane(scene, settings, model, why)
    result = one_axis.run(as_run(scene, model))
    explain = partial(_explain_request, scene, settings, model, result, why)
    return _solution(scene, model, result, explain)


def _explain_request(
    scene: Scene, settings: Settings, model: Model, result: SlideResult, why: str
) -> _Explanation:
    """Return the result of `_explain` for a requested model in one axis."""
    fuller = []
    if scene.ay_mps2.any():
        fuller.append(two_axes.run(as_run(scene, Model.TWO_AXES), settings.tolerance))
    if model is Model.ONE_AXIS and scene.az_mps2.size:
        fuller.append(one_axis.run(scene))
    return why, _left_out(result, *fuller)


def _solution(
    scene: Scene, model: Model, result: SlideResult, explain: Callable[[], _Explanation]
) -> Solution:
    """Return a solution with the next model supported by the records of the scene."""
    # Without a record for a component no model has anything to add.
    following = model
    if model is Model.ONE_AXIS and scene.az_mps2.size:
        following = Model.ONE_AXIS_VERTICAL
    elif model < Model.TWO_AXES and scene.ay_mps2.size:
        following = Model.TWO_AXES
    return Solution(
        model=model, result=result, next_model=following, scene=scene, explanation=explain
    )


def _without_next(
    scene: Scene, model: Model, result: SlideResult, why: str, effect_m: float = math.nan
) -> Solution:
    """Return a solution by the most complete model that applies."""
    explained = why, effect_m
    return Solution(
        model=model, result=result, next_model=model, scene=scene, explanation=explained
    )


def _lifted(scene: Scene) -> Solution:
    model = Model.ONE_AXIS_VERTICAL if scene.az_mps2.size else Model.ONE_AXIS
    why = "the normal force falls below zero, which no model covers"
    return _without_next(scene, model, one_axis.run(scene), why)


def _still(scene: Scene, bounds: RecordBounds | None) -> Solution:
    demand, hold = friction_demand(scene), scene.friction.mu_static
    why = (
        f"the required friction coefficient, {demand:.2f}, is below the entered coefficient,"
        f" {hold:.2f}"
    )
    result = _run_along(as_run(scene, Model.NO_SLIP), bounds)
    return _without_next(scene, Model.NO_SLIP, result, why, effect_m=0.0)


def _in_plane(scene: Scene, settings: Settings, model: Model, why: str) -> Solution:
    result = two_axes.run(as_run(scene, model), settings.tolerance)
    solution = _without_next(scene, model, result, why)
    if scene.friction.is_constant or model is Model.SPEED_FRICTION:
        return solution
    # Constant friction was asked for where the scene has a law: what that changes is told.
    effect = _left_out(result, two_axes.run(scene, settings.tolerance))
    return replace(solution, next_model=Model.SPEED_FRICTION, explanation=(why, effect))


def as_run(scene: Scene, model: Model) -> Scene:
    """Return the scene as a model runs it, without the vertical or the friction law it neglects.

    The cross-slope component is kept; a run in one axis ignores it.
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
    # Converted to a float and formatted again: `.2g` alone prints 120 as 1.2e+02.
    return f"{float(f'{value_m * 1e3:.2g}'):g}{NO_BREAK}mm"
