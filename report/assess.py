"""Runs every array under every motion and holds the result against the rule set.

Orders the work and keeps what came out; computes no physics (`solver.sliding`) and reads no code
rule itself (`solver.provisions`). Read `report.package` next, which turns this into pages.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

from report.runs import RUNGS, MotionRun, nan_is_worst, run_motion
from report.sheet.schema import (
    Array,
    Clearance,
    Direction,
    Model,
    ObjectKind,
    ProjectInput,
    RoofObject,
    Statistic,
)
from report.sheet.targets import Targets, ac156, targets
from solver import ladder, provisions
from solver.model import Motion, SlideResult, Status
from solver.overturning import Supports, Tipping, tipping
from solver.provisions import (
    AnalysisValue,
    Basis,
    Check,
    Neighbour,
    Prescriptive,
    RequiredSpectrum,
    RuleSet,
)
from solver.uplift import Uplift, uplift

_BASES = {
    Statistic.RULE_SET: None,
    Statistic.MEAN_1_1: Basis.MEAN_FACTORED,
    Statistic.LARGEST_1_1: Basis.LARGEST_FACTORED,
    Statistic.MEAN: Basis.MEAN,
}
_OPPOSITE = {Direction.DOWN: Direction.UP, Direction.UP: Direction.DOWN}
THREADS = 2
ALIKE_DEG = 1.0
"""Slopes that fall within so many degrees of each other fall in the same direction."""

_KINDS = {
    ObjectKind.FIXED: Neighbour.FIXED,
    ObjectKind.UNLIKE_ARRAY: Neighbour.UNLIKE,
    ObjectKind.EDGE_WITHOUT_PARAPET: Neighbour.EDGE,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayAssessment:
    """One array: its runs, the value from analysis, the prescriptive value, the design value.

    Attributes
    ----------
    floor_m : float
        Least design displacement without peer review [m]; 0 with it.
    design_m : float
        Design displacement [m]: the larger of the value from analysis and the floor. NaN where
        there is no value from analysis.
    directions : mapping
        The value from analysis of the excursions in each direction; `analysis` is that of any.
    chosen : mapping
        The same by the models that the scenes need; differs where a model is asked for.
    needed : tuple of MotionRun
        The runs behind it, in the order of `motions`.
    tipping, uplift : Tipping, Uplift
        Of the run that comes nearest to tipping, and of the one with the least normal force.
    checks : tuple of Check
        Limits that the array must keep for the analysis route.
    prescriptive_checks : tuple of Check
        Limits that it would have to keep to use the prescriptive value instead.
    """

    array: Array
    motions: tuple[MotionRun, ...]
    analysis: AnalysisValue
    directions: Mapping[Direction, AnalysisValue]
    chosen: Mapping[Direction, AnalysisValue]
    needed: tuple[MotionRun, ...]
    prescriptive: Prescriptive
    floor_m: float
    design_m: float
    tipping: Tipping
    uplift: Uplift
    checks: tuple[Check, ...]
    prescriptive_checks: tuple[Check, ...]
    interconnection_n: float

    @property
    def governs(self) -> str:
        """What the design displacement comes from."""
        if math.isnan(self.design_m):
            return "no value"
        return "floor" if self.floor_m > self.analysis.value_m else "analysis"

    def design_towards_m(self, direction: Direction) -> float:
        """Return the design displacement in a direction [m]: not below the floor either."""
        return self._floored(self.directions[direction])

    def chosen_towards_m(self, direction: Direction) -> float:
        """Return the same by the models that the scenes need [m]."""
        return self._floored(self.chosen[direction])

    def _floored(self, found: AnalysisValue) -> float:
        return math.nan if math.isnan(found.value_m) else max(found.value_m, self.floor_m)

    @property
    def is_model_asked_for(self) -> bool:
        """Whether the workbook asks for a model."""
        return self.array.model in RUNGS

    @property
    def is_model_enough(self) -> bool:
        """Whether the models that the scenes need would not ask for more room, any way."""
        pairs = ((self.chosen_towards_m(d), self.design_towards_m(d)) for d in Direction)
        return all(math.isnan(b) or a <= b + ladder.DEFAULT.bound_m(b) for a, b in pairs)

    @property
    def ratio(self) -> float:
        """Design displacement / prescriptive displacement."""
        return self.design_m / self.prescriptive.value_m

    @property
    def variation(self) -> float:
        """Standard deviation of the motions' PRDs over their mean; NaN for one motion."""
        peaks = [run.governing.result.prd_m for run in self.motions]
        mean = self.analysis.mean_m
        if len(peaks) < 2 or not mean > 0.0:
            return math.nan
        return math.sqrt(sum((p - mean) ** 2 for p in peaks) / (len(peaks) - 1)) / mean

    @property
    def worst(self) -> MotionRun:
        """The motion with the largest PRD."""
        return max(self.motions, key=lambda run: nan_is_worst(run.governing.result.prd_m))


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceCheck:
    """A clearance: what lies across it, the displacement that counts, required and provided.

    Attributes
    ----------
    governing_array, governing_direction : str, Direction
        Whose design displacement counts, in its own direction: the larger of the two between
        arrays.
    least_m : float
        Least separation of the rule set for this neighbour [m]; 0 for none.
    """

    clearance: Clearance
    neighbour: Neighbour
    governing_array: str
    governing_direction: Direction
    design_m: float
    factor: float
    least_m: float
    required_m: float

    @property
    def demand_capacity(self) -> float:
        """Required / provided separation."""
        provided = self.clearance.provided_m
        return self.required_m / provided if provided > 0.0 else math.inf

    def across_from(self, array_id: str) -> str:
        """Return what lies across the gap, seen from one of its two sides."""
        seen_from_object = same_id(self.clearance.object, array_id)
        return self.clearance.array if seen_from_object else self.clearance.object

    @property
    def is_least_value(self) -> bool:
        """Whether the least separation governs over factor x displacement."""
        return self.least_m > self.factor * self.design_m

    @property
    def ok(self) -> bool:
        """Whether the room suffices; without a design displacement it does not."""
        return self.required_m <= self.clearance.provided_m


@dataclass(frozen=True, slots=True, kw_only=True)
class Assessment:
    """Everything that was computed for a project.

    Attributes
    ----------
    horizontal_target, vertical_target : RequiredSpectrum
        AC156 at the roof.
    targets : Targets
        What the motions are held against: AC156 or the project's own.
    """

    rules: RuleSet
    horizontal_target: RequiredSpectrum
    vertical_target: RequiredSpectrum
    targets: Targets
    building_checks: tuple[Check, ...]
    arrays: tuple[ArrayAssessment, ...]
    clearances: tuple[ClearanceCheck, ...]
    solver_seconds: float

    @property
    def ok(self) -> bool:
        """Whether all limits and clearances are kept and each array has a final design value."""
        checks = [*self.building_checks, *(check for a in self.arrays for check in a.checks)]
        limits_kept = all(check.ok for check in checks)
        has_values = not any(math.isnan(a.design_m) for a in self.arrays) and not self.warnings
        stands = all(item.is_model_enough and item.tipping.is_ok for item in self.arrays)
        return limits_kept and has_values and stands and all(gap.ok for gap in self.clearances)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Runs whose displacement is missing or not final, in words."""
        return tuple(
            f"Array {assessed.array.id}, motion {motion.motion.id}, "
            f"{', '.join(run.heading.name for run in runs)}: "
            f"{_trouble([run.result for run in runs])}."
            for assessed in self.arrays
            for motion in assessed.motions
            for status in Status
            if status is not Status.OK
            and (runs := [run for run in motion.runs if run.result.status is status])
        )

    def governing_clearance(self, array_id: str) -> ClearanceCheck | None:
        """Return the clearance of an array, from either side, with the largest D/C, if any."""
        of_array = [
            item
            for item in self.clearances
            if same_id(item.clearance.array, array_id) or same_id(item.clearance.object, array_id)
        ]
        return max(of_array, key=lambda c: nan_is_worst(c.demand_capacity), default=None)


def _trouble(results: Sequence[SlideResult]) -> str:
    """Return in words what is wrong with runs of one outcome."""
    status = results[0].status
    if status is Status.UPLIFT:
        return f"{status.sentence} (at {min(result.t_uplift_s for result in results):.3f} s)"
    fastest = max(abs(result.end_speed_mps) for result in results)
    return f"{status.sentence} (at {fastest:.3f} m/s)"


def same_id(one: str, other: str) -> bool:
    """Whether two ids name the same thing; capitals do not tell things apart."""
    return one.casefold() == other.casefold()


def assess(
    data: ProjectInput, motions: Sequence[Motion], *, hold_models: bool = True
) -> Assessment:
    """Run every array under every motion and check every limit and clearance.

    Parameters
    ----------
    hold_models : bool
        Whether models that are asked for are held against those that the scenes need.

    Raises
    ------
    InputError
        For an override of a provision that the rule set does not have.
    """
    site = data.site
    rules = provisions.RULE_SETS[site.rule_set].overridden(
        {row.provision: (row.value, row.reason) for row in data.overrides}
    )
    started = time.perf_counter()
    # Runs in two axes leave Python alone: two of them go on at once.
    with ThreadPoolExecutor(THREADS) as pool:
        runs = [_runs(pool, array, motions, hold_models) for array in data.arrays]
    seconds = time.perf_counter() - started
    arrays = tuple(
        _assess_array(data, rules, array, *found)
        for array, found in zip(data.arrays, runs, strict=True)
    )
    return Assessment(
        rules=rules,
        horizontal_target=ac156(data)[0],
        vertical_target=ac156(data)[1],
        targets=targets(data),
        building_checks=provisions.building_checks(
            rules,
            risk_category=list(type(site.risk_category)).index(site.risk_category) + 1,
            storeys=site.storeys,
        ),
        arrays=arrays,
        clearances=tuple(_check_clearance(data, rules, arrays, row) for row in data.clearances),
        solver_seconds=seconds,
    )


def _runs(
    pool: Executor, array: Array, motions: Sequence[Motion], hold_models: bool
) -> tuple[tuple[MotionRun, ...], ...]:
    """Return the runs of an array, and those by the models that its scenes need."""
    runs = tuple(pool.map(partial(run_motion, array), motions))
    if array.model is Model.CHOOSE or not hold_models:
        return runs, runs
    return runs, tuple(pool.map(partial(run_motion, array, model=Model.CHOOSE), motions))


def _towards(
    rules: RuleSet, runs: Sequence[MotionRun], basis: Basis | None
) -> Mapping[Direction, AnalysisValue]:
    return {
        direction: provisions.analysis_value(rules, [run.peak_m(direction) for run in runs], basis)
        for direction in Direction
    }


def _assess_array(
    data: ProjectInput,
    rules: RuleSet,
    array: Array,
    runs: tuple[MotionRun, ...],
    needed: tuple[MotionRun, ...],
) -> ArrayAssessment:
    site = data.site
    prescriptive = provisions.prescriptive_displacement(
        rules, s_ds_g=site.s_ds, sdc=site.sdc, importance=site.i_e
    )
    basis = _BASES[data.options.statistic]
    directions = _towards(rules, runs, basis)
    analysis = directions[Direction.ANY]
    floor = 0.0 if data.options.peer_reviewed else rules["analysis_floor"] * prescriptive.value_m
    no_value = math.isnan(analysis.value_m)
    scenes = [run.scene for motion in runs for run in motion.runs]
    supports = Supports(height_m=array.cg_height_m, spacing_m=array.support_spacing_m)
    return ArrayAssessment(
        array=array,
        motions=runs,
        analysis=analysis,
        directions=directions,
        chosen=directions if needed is runs else _towards(rules, needed, basis),
        needed=needed,
        prescriptive=prescriptive,
        floor_m=floor,
        design_m=math.nan if no_value else max(analysis.value_m, floor),
        tipping=max(
            (tipping(scene, supports) for scene in scenes), key=lambda t: (t.ratio, t.demand)
        ),
        uplift=min(map(uplift, scenes), key=lambda u: u.n_min_g),
        checks=(
            *provisions.array_checks(
                rules,
                cg_height_m=array.cg_height_m,
                support_spacing_m=array.support_spacing_m,
            ),
            *provisions.analysis_checks(rules, slope_rad=array.slope_rad, n_motions=len(runs)),
        ),
        prescriptive_checks=provisions.prescriptive_checks(
            rules, slope_rad=array.slope_rad, mu=array.least_mu
        ),
        # The lighter side of a section is at most half of the array.
        interconnection_n=provisions.interconnection_strength_n(
            rules, s_ds_g=site.s_ds, w1_n=array.weight_n / 2.0
        ),
    )


def _check_clearance(
    data: ProjectInput,
    rules: RuleSet,
    arrays: Sequence[ArrayAssessment],
    row: Clearance,
) -> ClearanceCheck:
    near = _by_id(arrays, row.array)
    others = [a for a in arrays if same_id(a.array.id, row.object)]
    facing = [(near, row.direction)]
    facing += [
        (other, facing_direction(near.array, other.array, row.direction)) for other in others
    ]
    governing, direction = max(facing, key=lambda a: nan_is_worst(a[0].design_towards_m(a[1])))
    design_m = governing.design_towards_m(direction)
    if others:
        alike = same_id(near.array.construction, others[0].array.construction)
        neighbour = Neighbour.LIKE if alike else Neighbour.UNLIKE
    else:
        found = next(item for item in data.objects if same_id(item.id, row.object))
        neighbour = _neighbour(rules, found, near.array)
    required = provisions.required_separation(
        rules, neighbour, design_m=design_m, importance=data.site.i_e
    )
    factor = rules[provisions.SEPARATION_KEYS[neighbour]]
    if rules.importance_in_separation:
        factor *= data.site.i_e
    return ClearanceCheck(
        clearance=row,
        neighbour=neighbour,
        governing_array=governing.array.id,
        governing_direction=direction,
        design_m=design_m,
        factor=factor,
        least_m=provisions.least_separation_m(rules, neighbour),
        required_m=required,
    )


def facing_direction(near: Array, other: Array, direction: Direction) -> Direction:
    """Return a direction of an array as seen from the array across the gap.

    Any where their slopes fall in different directions.
    """
    turn = (near.downslope_deg - other.downslope_deg) % 360.0
    if min(turn, 360.0 - turn) > ALIKE_DEG:
        return Direction.ANY
    return _OPPOSITE.get(direction, direction)


def _by_id(arrays: Sequence[ArrayAssessment], wanted: str) -> ArrayAssessment:
    return next(item for item in arrays if same_id(item.array.id, wanted))


def _neighbour(rules: RuleSet, found: RoofObject, array: Array) -> Neighbour:
    """Return what lies across the gap; a parapet that is too low leaves an edge without."""
    if found.kind is not ObjectKind.EDGE_WITH_PARAPET:
        return _KINDS[found.kind]
    qualifies = found.height_m is not None and provisions.parapet_qualifies(
        rules, parapet_height_m=found.height_m, cg_height_m=array.cg_height_m
    )
    return Neighbour.PARAPET if qualifies else Neighbour.EDGE
