"""Runs every array under every motion and checks the result against the rule set.

Orders the work and collects the results; computes no physics (`solver.sliding.checked`) and reads
no code rule itself (`solver.rules.provisions`). Read `report.assessment.arrays`,
`report.assessment.clearances`, `report.assessment.links` first, then `assess`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Collection, Hashable, Mapping, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace
from functools import cache, partial
from typing import Any

from report.assessment.arrays import ArrayAssessment, assess_array
from report.assessment.clearances import by_id, check_clearance, largest_separation_m, minimum_gap
from report.assessment.friction import (
    NOT_BY_VELOCITY,
    low_velocity,
    with_friction,
    with_low_velocity,
)
from report.assessment.links import assess_linked
from report.assessment.neighbors import PlanNeighbor, plan_pairs, reaches_of
from report.assessment.precheck import shaking_acceptance
from report.assessment.prices import prices
from report.assessment.project import THREADS, Assessment
from report.assessment.runs import (
    MotionRun,
    PendingRuns,
    RunMotion,
    largest_two,
    run_motion,
    scene_key,
)
from report.assessment.verdict import SHIFT, rule_set_of
from report.motions.history import targets
from report.motions.prepare import Shaking
from report.sheet.checking.checks import faults
from report.sheet.checking.covered import outdated
from report.sheet.reading.read import Sheet
from report.sheet.schema import ProjectInput, linked
from report.sheet.schema.fields import Draft, Finding
from report.sheet.schema.scene import Array
from report.sheet.workbook import SECTIONS
from solver.model import Motion
from solver.records.acceptance import Acceptance
from solver.rules.provisions import RuleSet

Reference = Mapping[str, Mapping[str, Sequence[str]]]
"""By array and motion, the orientations with the largest PRDs: data for JSON."""


def assess(
    sheet: Sheet,
    shaking: Shaking,
    former: Assessment | None = None,
    project: ProjectInput | None = None,
    *,
    is_whole: bool = True,
) -> Assessment:
    """Run every array under every motion and check every limit and clearance.

    From a `former` assessment of the same motions and targets come the limits on them, and the runs
    of arrays with the same slope and friction. A `project` is assessed in place of that of
    the sheet, without what the building code's rule set gives. Unless it is whole, that is left out
    too, and less friction, half of the runs: an OK may still be one with conditions. Raises as
    `rule_set_of`.
    """
    data = outdated(project or sheet.project, shaking.hashes)
    with ThreadPoolExecutor(THREADS) as pool:
        begin = partial(begin_runs, pool, motions=shaking.motions)
        begun = begin(run_motion, data, former=former.arrays if former else ())
        # The runs with less friction follow without a pause, while motions and arrays are checked.
        reduced = with_friction(data, 1.0 - SHIFT)
        less: PendingRuns = ()
        known = former.at_reduced_friction.arrays if former and former.at_reduced_friction else ()
        if is_whole:
            less = begin(run_motion, reduced, former=known)
        known = former.low_velocity.arrays if former else ()
        slow = begin(run_motion, with_low_velocity(data), former=known)
        acceptance = former.acceptance if former else shaking_acceptance(shaking, targets(data))
        whole = partial(_assess, sheet, shaking, acceptance=acceptance, pool=pool)

        def at_reduced_friction() -> Assessment | None:
            return whole(reduced, begun=less, has_pairs=False) if is_whole else None

        done = whole(data, begun=begun, slow=slow, reduced_friction=at_reduced_friction)
        if project is not None or not is_whole:
            return done

        def without(other: ProjectInput, motions: Collection[str]) -> Assessment:
            """Assess another input, without some motions."""
            fewer = replace(
                shaking,
                motions=tuple(each for each in shaking.motions if each.id not in motions),
                prepared=tuple(each for each in shaking.prepared if each.motion_id not in motions),
            )
            former = [
                replace(item, motions=tuple(m for m in item.motions if m.motion.id not in motions))
                for item in (*done.arrays, *done.low_velocity.arrays)
            ]
            # The targets may be those of another edition.
            is_same = not motions and other.site is data.site
            limits = acceptance if is_same else shaking_acceptance(fewer, targets(other))
            runs = begin_runs(pool, run_motion, other, fewer.motions, former=former)
            return _assess(sheet, fewer, other, acceptance=limits, pool=pool, begun=runs)

        return replace(done, otherwise=prices(done, without))


def reassess(assessment: Assessment, project: ProjectInput) -> Assessment:
    """Assess another input under the same motions, without variations of it."""
    return _alone(assessment.sheet, assessment.shaking, project, assessment.acceptance, run_motion)


# Of the PRD. Far less than is printed changes, and runs take three quarters of the time.
_PASSING = 1e-4


def anticipate(
    sheet: Sheet, shaking: Shaking, known: Reference, acceptance: Acceptance | None = None
) -> Assessment:
    """Assess a workbook in the orientations that gave the largest PRDs in a full assessment.

    The limits on the motions are those of `acceptance`, where it is known for these motions.
    """

    # As long as these two stay the largest, with the displacements of all.
    def run(array: Array, motion: Motion) -> MotionRun:
        names = known.get(array.id, {}).get(motion.id, ())
        return run_motion(array, motion, names=names, tolerance=_PASSING)

    def key(array: Array) -> Hashable:
        # Arrays that are alike now may have had others at the reference.
        return scene_key(array), json.dumps(known.get(array.id, {}))

    data = outdated(sheet.project, shaking.hashes)
    acceptance = acceptance or shaking_acceptance(shaking, targets(data))
    return _alone(sheet, shaking, data, acceptance, run, key)


def reference_of(done: Assessment) -> Reference:
    """Return what `anticipate` runs."""
    return {
        item.id: {run.motion.id: largest_two(run) for run in item.motions} for item in done.arrays
    }


def _alone(
    sheet: Sheet,
    shaking: Shaking,
    data: ProjectInput,
    acceptance: Acceptance,
    run: RunMotion,
    key: Callable[[Array], Hashable] = scene_key,
) -> Assessment:
    with ThreadPoolExecutor(THREADS) as pool:
        begun = begin_runs(pool, run, data, shaking.motions, key=key)
        return _assess(sheet, shaking, data, acceptance=acceptance, pool=pool, begun=begun)


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
    reduced_friction: Callable[[], Assessment | None] | None = None,
) -> Assessment:
    """Assess an input from its runs, and from `slow`, those of `with_low_velocity`."""
    rules = rule_set_of(data)
    # Of a variation neither its own variations nor its rows of linked blocks are asked for.
    has_runs = bool(reduced_friction and shaking.motions)
    arrays = tuple(
        assess_array(data, rules, array, wait(), motions_qualify=acceptance.qualifies)
        for array, wait in zip(data.arrays, begun, strict=True)
    )
    links = data.links if has_runs else ()
    linked = tuple(assess_linked(pool, rules, row, by_id(arrays, row.array)) for row in links)
    clearances = tuple(check_clearance(data, rules, arrays, row) for row in data.clearances)
    # With less friction the plan is the same, and is not measured again.
    pairs = _plan_pairs(sheet, data, rules, arrays) if has_pairs else ()
    # Last, as these runs are begun last.
    reduced, slower = reduced_friction() if reduced_friction else None, NOT_BY_VELOCITY
    if slow and has_runs:
        slower = low_velocity(data, rules, arrays, slow, motions_qualify=acceptance.qualifies)
    return Assessment(
        sheet=sheet,
        shaking=shaking,
        project=data,
        rules=rules,
        targets=targets(data),
        arrays=arrays,
        clearances=clearances,
        linked=linked,
        pairs=pairs,
        acceptance=acceptance,
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


def refused(data: ProjectInput, changed: ProjectInput) -> list[Finding]:
    """Return what `check` refuses of a changed input and not of the one given."""
    before = _faults(data)
    return [fault for fault in _faults(changed) if fault not in before]


def changed(data: ProjectInput, **sections: Any) -> ProjectInput:
    """Return an input with other sections."""
    return linked(data.model_copy(update=sections))


def entered(assessment: Assessment, project: ProjectInput) -> Assessment | None:
    """Assess a changed input under the same motions; None where `check` would refuse it."""
    if refused(assessment.project, project):
        return None
    return assess(assessment.sheet, assessment.shaking, assessment, project)


def _faults(data: ProjectInput) -> list[Finding]:
    draft: Draft = {
        part.key: [dict(row) for row in (rows if part.is_table else (rows,))]
        for part in SECTIONS
        for rows in (getattr(data, part.key),)
    }
    return faults(draft, lambda place: place.section)


def begin_runs(
    pool: Executor,
    run: RunMotion,
    data: ProjectInput,
    motions: Sequence[Motion],
    *,
    key: Callable[[Array], Hashable] = scene_key,
    former: Sequence[ArrayAssessment] = (),
) -> PendingRuns:
    """Begin the runs of an input."""
    # Arrays with one key share their runs: those of a former assessment have them already.
    known = {key(item.array): item.motions for item in former}

    def begun(array: Array) -> Callable[[], tuple[MotionRun, ...]]:
        if (runs_of := known.get(key(array))) is not None:
            return lambda: runs_of
        # Runs in two axes and of rows release the GIL: two proceed in parallel.
        runs = [pool.submit(run, array, motion) for motion in motions]
        return lambda: tuple(each.result() for each in runs)

    by_key = {key(array): array for array in data.arrays}
    # One result for all arrays of a key: what follows from the runs alone is computed once.
    runs = {each: cache(begun(array)) for each, array in by_key.items()}
    return [runs[key(array)] for array in data.arrays]
