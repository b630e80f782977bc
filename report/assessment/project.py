"""Runs every array under every motion and checks the result against the rule set.

Orders the work and collects the results; computes no physics (`solver.sliding.checked`) and reads
no code rule itself (`solver.rules.provisions`). Read `report.assessment.arrays`,
`report.assessment.clearances`, `report.assessment.links` first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial

from report.assessment.acceptance import shaking_acceptance
from report.assessment.arrays import ArrayAssessment, assess_array, by_id
from report.assessment.causes import outcome
from report.assessment.clearances import (
    ClearanceCheck,
    check_clearance,
    largest_separation_m,
    minimum_gap,
)
from report.assessment.conditions import (
    MOTIONS_ID,
    array_rows,
    less_friction_rows,
    motion_rows,
    noted,
    pathway_rows,
    plan_rows,
    project_rows,
)
from report.assessment.friction import SHIFT, with_friction
from report.assessment.friction_velocity import (
    NOT_BY_VELOCITY,
    LowVelocityAssessment,
    low_velocity,
    velocity_rows,
    with_low_velocity,
)
from report.assessment.links import LinkedArray, assess_linked
from report.assessment.neighbors import ComparedGap, PlanNeighbor, plan_pairs, reaches_of
from report.assessment.overrides import rule_set_of, under_code
from report.assessment.pending_runs import PendingRuns, RunMotion, begin_runs
from report.assessment.precheck import building_limits
from report.assessment.run_warnings import RunWarning, run_warnings
from report.assessment.runs import MotionRun, nan_is_worst, run_along, run_motion, scene_key
from report.assessment.verdict import BY_CONSEQUENCE, Requirement, Verdict, worst
from report.motions.prepare import Shaking
from report.motions.targets import Targets, targets
from report.sheet.checking.covered import outdated
from report.sheet.reading.read import Sheet
from report.sheet.schema import ProjectInput
from report.sheet.schema.scene import Array
from report.words.counts import grouped_by
from solver.model import Motion, Status
from solver.records.acceptance import Acceptance
from solver.rules.limit import Limit
from solver.rules.provisions import RuleSet

THREADS = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Assessment:
    """Everything that was computed for a project.

    Attributes
    ----------
    sheet : Sheet
        The workbook as data.
    shaking : Shaking
        The motions at the roof.
    project : ProjectInput
        As assessed: that of the sheet, except for runs with changed friction.
    rules : RuleSet
    targets : Targets
        Target spectra of the motions: AC156 or project-specific.
    building_checks : tuple of Limit
    arrays : tuple of ArrayAssessment
    clearances : tuple of ClearanceCheck
    linked : tuple of LinkedArray
        The arrays for which the workbook requests a check of the rigid-block model.
    pairs : tuple of PlanNeighbor
        What the plan shows beside each array, with its clearances; none in `at_reduced_friction`.
    acceptance : Acceptance
        Limits on the motions as run, at the roof.
    rows : tuple of Requirement
        Requirements beside the numeric limits, of the project, its motions and its arrays.
    at_reduced_friction : Assessment or None
        The same with less friction; None in that one itself.
    low_velocity : LowVelocityAssessment
        Arrays with their low-velocity coefficient alone; without any in `at_reduced_friction`,
        and in what `reassess` and `anticipate` give.
    """

    sheet: Sheet
    shaking: Shaking
    project: ProjectInput
    rules: RuleSet
    targets: Targets
    building_checks: tuple[Limit, ...]
    arrays: tuple[ArrayAssessment, ...]
    clearances: tuple[ClearanceCheck, ...]
    linked: tuple[LinkedArray, ...]
    pairs: tuple[PlanNeighbor, ...]
    acceptance: Acceptance
    rows: tuple[Requirement, ...]
    at_reduced_friction: Assessment | None
    low_velocity: LowVelocityAssessment
    # What many ask for, once; not when it is asked for first: nothing may change while it is sent.
    _rows_by_subject: Mapping[str, Sequence[Requirement]] = field(init=False, compare=False)
    _gaps_by_array: Mapping[str, Sequence[ClearanceCheck]] = field(init=False, compare=False)
    _verdicts: Mapping[str, Verdict] = field(init=False, compare=False)  # by array

    def __post_init__(self) -> None:
        rows = [gap.clearance for gap in self.clearances]
        ids = {row.array: None for row in rows} | {row.object: None for row in rows}
        gaps = {each: [gap for gap in self.clearances if gap.involves(each)] for each in ids}
        object.__setattr__(self, "_gaps_by_array", gaps)
        rows_by_subject = grouped_by(self.rows, lambda row: row.subject)
        object.__setattr__(self, "_rows_by_subject", rows_by_subject)
        verdicts = {item.id: self._array_verdict(item) for item in self.arrays}
        object.__setattr__(self, "_verdicts", verdicts)

    def __repr__(self) -> str:
        counts = f"{len(self.arrays)} arrays, {len(self.clearances)} clearances"
        return f"Assessment: {self.verdict.value}; {counts}, {len(self.conditions)} conditions"

    @property
    def governing(self) -> ArrayAssessment:
        """The array with the largest design displacement, or one without a value."""
        return max(self.arrays, key=lambda array: nan_is_worst(array.design_m))

    @property
    def alike(self) -> Sequence[Sequence[ArrayAssessment]]:
        """The arrays in groups that share their runs, in order."""
        return tuple(grouped_by(self.arrays, lambda item: scene_key(item.array)).values())

    @property
    def verdict(self) -> Verdict:
        """Verdict on the project: the worst of its limits, arrays, clearances and rows."""
        found = worst(
            [
                *(self.limit_verdict(check) for check in self.building_checks),
                *self._verdicts.values(),
                *(gap.verdict for gap in self.clearances),
                *(row.verdict for row in self.rows),
            ]
        )
        return Verdict.CONDITIONS if found is Verdict.CONDITION else found

    def array_verdict(self, item: ArrayAssessment) -> Verdict:
        """Return the verdict on an array: its values, limits, rows and clearances.

        NG beside a clearance without a verdict.
        """
        return self._verdicts[item.id]

    def _array_verdict(self, item: ArrayAssessment) -> Verdict:
        gaps = self.gaps_of(item.id)
        has_verdicts = not math.isnan(item.design_m) and all(gap.is_permitted for gap in gaps)
        is_ok = has_verdicts and self.is_rigid_enough(item) and self.is_sound(item)
        return worst(
            [
                Verdict.OK if is_ok else Verdict.NG,
                *(gap.verdict for gap in gaps),
                *(row.verdict for row in self.rows_of(item.array.id)),
            ]
        )

    def limit_verdict(self, limit: Limit) -> Verdict:
        """Return the verdict on a limit: of one that is a requirement too, the verdict on that."""
        rows = (row for row in self.rows if row.id == MOTIONS_ID and row.title == limit.title)
        missed = next((row.verdict for row in rows), BY_CONSEQUENCE[limit.consequence])
        return Verdict.OK if limit.ok else missed

    def is_sound(self, item: ArrayAssessment) -> bool:
        """Whether an array satisfies its limits, and its motions, model and runs are adequate."""
        return (
            item.is_model_enough
            and item.tipping.is_ok
            and item.satisfies_limits
            and all(run.result.status is Status.OK for run in item.runs)
        )

    @property
    def conditions(self) -> tuple[Requirement, ...]:
        """The rows that are not satisfied and not only a note."""
        return tuple(
            row for row in self.rows if not row.is_satisfied and row.verdict is not Verdict.NOTE
        )

    @property
    def notes(self) -> tuple[Requirement, ...]:
        """The rows on the analysis that are not satisfied, where nothing follows from it."""
        return tuple(row for row in self.rows if row.verdict is Verdict.NOTE)

    @property
    def alike_conditions(self) -> Sequence[tuple[Requirement, Sequence[str]]]:
        """The same, each with the ids of all arrays or motions that it says the same of."""
        groups = grouped_by(self.conditions, lambda row: row.said)
        return [(rows[0], [row.subject for row in rows]) for rows in groups.values()]

    @property
    def is_overridden(self) -> bool:
        """Whether an override or a departure changes a design displacement or a separation."""
        return any(
            (
                *(item.design_mark for item in self.arrays),
                *(gap.mark for gap in self.clearances),
                *(gap.mark for gap in self.missing_gaps),
            )
        )

    @property
    def neighbors(self) -> tuple[PlanNeighbor, ...]:
        """What the plan shows near each array, or what a clearance is given to."""
        return tuple(pair for pair in self.pairs if pair.is_listed)

    @property
    def missing_gaps(self) -> tuple[PlanNeighbor, ...]:
        """The gaps of the plan without a clearance that are not known to be sufficient."""
        return tuple(near for near in self.neighbors if near.is_short)

    def rows_of(self, subject: str) -> Sequence[Requirement]:
        """Return the rows about an array or a motion."""
        return self._rows_by_subject.get(subject, ())

    def is_rigid_enough(self, item: ArrayAssessment) -> bool:
        """Whether one rigid block is adequate for an array, where the workbook asks."""
        return all(row.is_rigid_enough for row in self.linked if row.design.id == item.id)

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return self._gaps_by_array.get(array_id, ())

    @property
    def warnings(self) -> tuple[RunWarning, ...]:
        """Runs whose displacement is missing or not final, in words."""
        return run_warnings(self.arrays, self.project.us_first)

    def governing_gap(self, array_id: str = "") -> ComparedGap | None:
        """Return the gap with the largest D/C, if any; of an array that from either side.

        Of the clearances, and of the pairs that the plan shows to be short and no clearance covers.
        """
        gaps: Sequence[ComparedGap] = (*self.clearances, *self.missing_gaps)
        found = [gap for gap in gaps if not array_id or gap.involves(array_id)]
        return max(found, key=lambda gap: nan_is_worst(gap.demand_capacity), default=None)


def assess(
    sheet: Sheet,
    shaking: Shaking,
    former: Assessment | None = None,
    project: ProjectInput | None = None,
) -> Assessment:
    """Run every array under every motion and check every limit and clearance.

    Parameters
    ----------
    former : Assessment, optional
        Of the same motions and targets: the limits on them are taken from it, and the runs of
        arrays with the same slope, friction and model.
    project : ProjectInput, optional
        Assessed in place of that of the sheet; what the building code's rule set gives is left out.

    Raises
    ------
    InputError
        For an override of a provision that the rule set does not have.
    """
    data = outdated(project or sheet.project, shaking.hashes)
    with ThreadPoolExecutor(THREADS) as pool:
        begin = partial(begin_runs, pool, motions=shaking.motions)
        begun = begin(run_motion, data, check_models=True, former=former.arrays if former else ())
        # The runs with less friction follow without a pause, while motions and arrays are checked.
        reduced = with_friction(data, 1.0 - SHIFT)
        known = former.at_reduced_friction.arrays if former and former.at_reduced_friction else ()
        less = begin(run_motion, reduced, check_models=False, former=known)
        known = former.low_velocity.arrays if former else ()
        slow = begin(run_motion, with_low_velocity(data), check_models=False, former=known)
        acceptance = former.acceptance if former else shaking_acceptance(shaking, targets(data))
        whole = partial(_assess, sheet, shaking, acceptance=acceptance, pool=pool)
        at_reduced_friction = partial(whole, reduced, begun=less, has_pairs=False)
        done = whole(data, begun=begun, slow=slow, reduced_friction=at_reduced_friction)
        other = under_code(data)
        if other is data or project is not None:
            return done
        acceptance = shaking_acceptance(shaking, targets(other))  # of another edition maybe
        return _beside(whole(other, begun=begun, acceptance=acceptance), done)


def _beside(other: Assessment, given: Assessment) -> Assessment:
    """Return an assessment with the outcome by the rule set of its building code in its rows."""
    linked = tuple(replace(row, design=by_id(other.arrays, row.design.id)) for row in given.linked)
    one, two = ((each.project.overrides, each.project.options) for each in (given, other))
    how = "the same motions and S_DS" + ("" if one == two else ", without overrides and departures")
    words = outcome(replace(other, linked=linked)).words(given.project.us_first)
    text = f"By {other.rules.name} 13.6.12 with {how}: {words}."
    ids = "rule_set", "edition_name"
    rows = [
        row.model_copy(update={"remedy": f"{row.remedy} {text}"}) if row.id in ids else row
        for row in given.rows
    ]
    return replace(given, rows=tuple(rows))


def reassess(
    given: Assessment,
    project: ProjectInput,
    run: RunMotion = run_motion,
    key: Callable[[Array], Hashable] = scene_key,
) -> Assessment:
    """Assess another input under the same motions, with its own models only.

    Parameters
    ----------
    run, key : callable, optional
        As in `begin_runs`.
    """
    motions = given.shaking.motions
    with ThreadPoolExecutor(THREADS) as pool:
        begun = begin_runs(pool, run, project, motions, check_models=False, key=key)
        return _assess(given.sheet, given.shaking, project, acceptance=given.acceptance,
                       pool=pool, begun=begun)  # fmt: skip


def anticipate(given: Assessment, project: ProjectInput) -> Assessment:
    """Assess another input in one axis, for provisional values (`runs.run_along`).

    Each motion runs in the orientation that governs in the given assessment, where it still has it.
    """
    governing = {
        array.id: {run.motion.id: run.governing.orientation for run in array.motions}
        for array in given.arrays
    }

    def along(array: Array, motion: Motion) -> MotionRun:
        orientation = governing.get(array.id, {}).get(motion.id)
        orientations = [orientation] if orientation in motion.orientations else motion.orientations
        return run_along(array, motion, orientations)

    def key(array: Array) -> Hashable:
        # Arrays that are alike now may have had other orientations that govern.
        return scene_key(array), tuple(governing.get(array.id, {}).items())

    return reassess(given, project, along, key)


def _assess(
    sheet: Sheet,
    shaking: Shaking,
    data: ProjectInput,
    *,
    acceptance: Acceptance,
    pool: Executor,
    begun: PendingRuns,
    slow: PendingRuns = (),
    has_pairs: bool = True,
    reduced_friction: Callable[[], Assessment] | None = None,
) -> Assessment:
    """Assess an input from its runs.

    Parameters
    ----------
    slow : PendingRuns, optional
        Runs of the arrays of `with_low_velocity`; given with `reduced_friction`.
    has_pairs : bool
        Whether the plan is measured: with less friction it is the same.
    reduced_friction : callable, optional
        Assesses the same with less friction. With it, one rigid block is compared with a row of
        linked blocks, and the verdicts with those for less friction.
    """
    rules = rule_set_of(data)
    arrays = tuple(
        assess_array(data, rules, array, *wait(), motions_qualify=acceptance.qualifies)
        for array, wait in zip(data.arrays, begun, strict=True)
    )
    links = data.links if reduced_friction else ()
    linked = tuple(assess_linked(pool, rules, row, by_id(arrays, row.array)) for row in links)
    clearances = tuple(check_clearance(data, rules, arrays, row) for row in data.clearances)
    pairs = _plan_pairs(sheet, data, rules, arrays) if has_pairs else ()
    rows = [
        *project_rows(data, shaking.prepared),
        *motion_rows(acceptance, (item.route for item in arrays)),
        *(row for item in arrays for row in array_rows(data, item)),
    ]
    # Last, as these runs are begun last.
    by_runs = {item.id for item in arrays if item.is_by_runs}
    reduced, slower = reduced_friction() if reduced_friction else None, NOT_BY_VELOCITY
    if slow:
        slower = low_velocity(data, rules, arrays, slow, motions_qualify=acceptance.qualifies)
    return Assessment(
        sheet=sheet,
        shaking=shaking,
        project=data,
        rules=rules,
        targets=targets(data),
        building_checks=building_limits(data, rules),
        arrays=arrays,
        clearances=clearances,
        linked=linked,
        pairs=pairs,
        acceptance=acceptance,
        rows=(
            *noted(rows, by_runs),
            *noted(velocity_rows(data, arrays, slower) if reduced_friction else (), by_runs),
            *pathway_rows(data, arrays, clearances),
            *plan_rows(data, [pair for pair in pairs if pair.is_listed]),
            *(less_friction_rows(arrays, clearances, reduced) if reduced else ()),
        ),
        at_reduced_friction=reduced,
        low_velocity=slower,
    )


def _plan_pairs(
    sheet: Sheet, data: ProjectInput, rules: RuleSet, arrays: Sequence[ArrayAssessment]
) -> tuple[PlanNeighbor, ...]:
    largest_m = largest_separation_m(data, rules, arrays)

    def required(near: PlanNeighbor) -> tuple[float, str]:
        # Most pairs of a large roof are out of reach, and farther apart than any separation.
        if not near.given and near.gap_m > max(largest_m, near.reach_m):
            return math.nan, ""
        return minimum_gap(data, rules, arrays, near)

    return plan_pairs(data, reaches_of(arrays), sheet.addresses, required)
