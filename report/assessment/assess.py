"""Assesses a project under its motions: arrays, clearances, and changes of the verdict.

Orders the work and collects the results; computes no physics (`report.runs`) and reads no code rule
itself (`solver.rules.provisions`). Other possible inputs are also assessed by `assess`, from the
same runs. Read `assess`, then `reassess`.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from enum import IntEnum
from typing import Any

from report.assessment.assessment import Assessment, low_velocity
from report.assessment.checks.motion_checks import shaking_acceptance
from report.assessment.design.arrays import assess_array, marked
from report.assessment.design.clearances import by_id, check_clearance, marked_gap
from report.assessment.design.friction import SHIFT, with_friction, with_low_velocity
from report.assessment.design.linked_blocks import assess_linked
from report.assessment.design.rule_set import as_adopted, rule_set_of
from report.assessment.prices import prices
from report.motions.history import targets
from report.motions.prepare import Shaking
from report.project.check.covered import outdated
from report.project.check.faults import faults
from report.project.model import ProjectInput
from report.project.model.finding import Finding
from report.project.read.workbook_data import Sheet, WorkbookSource
from report.project.workbook import SECTIONS
from report.runs import Runs
from solver.records.acceptance import Acceptance


class Extent(IntEnum):
    """Scope of an assessment beyond arrays and clearances; each value includes those before it."""

    ALONE = 0  # nothing: of another input that a project is compared with
    AS_GIVEN = 1  # rows of linked blocks
    LESS_FRICTION = 2  # less friction, half of the runs: an OK may be one with conditions
    OPEN = 3  # what the project comes to without what checks ask for that are not satisfied
    WHOLE = 4  # and without what the others do; the low-velocity coefficient alone


def assess(
    sheet: Sheet,
    shaking: Shaking,
    runs: Runs | None = None,
    *,
    acceptance: Acceptance | None = None,
    extent: Extent = Extent.WHOLE,
) -> Assessment:
    """Assess a project under its motions, with existing runs and those still missing.

    The `acceptance` of the motions is computed unless it is known. Raises the errors of
    `rule_set_of`.
    """
    # Before everything else, and once the records are read, whose hashes it takes: a peer review
    # of other inputs removes no floor, and a confirmation of other inputs no mark.
    data = outdated(sheet.project, shaking.hashes)
    return _assess(data, sheet.source, shaking, runs or Runs(), acceptance, extent)


def _assess(
    data: ProjectInput,
    source: WorkbookSource,
    shaking: Shaking,
    runs: Runs,
    acceptance: Acceptance | None,
    extent: Extent,
) -> Assessment:
    motions = shaking.motions
    rules, goals = rule_set_of(data), targets(data)
    less_friction, slow = with_friction(data, 1.0 - SHIFT), with_low_velocity(data)
    runs.begin(data.arrays, motions)
    # Those of other friction follow without a pause, while motions and arrays are checked.
    if extent >= Extent.LESS_FRICTION:
        runs.begin(less_friction.arrays, motions)
    if extent >= Extent.WHOLE:
        runs.begin(slow.arrays, motions)
    acceptance = acceptance or shaking_acceptance(shaking, goals)
    arrays = tuple(
        assess_array(
            data, rules, array, runs.of(array, motions), motions_qualify=acceptance.qualifies
        )
        for array in data.arrays
    )
    # Clearances come after all arrays: between two of them the larger displacement governs.
    slides = {item.id: item.displacement for item in arrays}
    clearances = tuple(check_clearance(data, rules, slides, row) for row in data.clearances)
    # A mark comes from comparing numbers with those of the rule set as adopted, so that an
    # override that changes nothing has none. This second assessment runs nothing: no override
    # changes a run.
    plain, adopted = as_adopted(data), None
    if plain is not data:
        adopted = _assess(plain, source, shaking, runs, acceptance, Extent.ALONE)
        arrays = tuple(map(marked, arrays, adopted.arrays))
        pairs = zip(clearances, adopted.clearances, strict=True)
        clearances = tuple(marked_gap(gap, as_adopted_gap, arrays) for gap, as_adopted_gap in pairs)
    done = Assessment(
        project=data,
        source=source,
        shaking=shaking,
        runs=runs,
        rules=rules,
        targets=goals,
        arrays=arrays,
        clearances=clearances,
        acceptance=acceptance,
        adopted=adopted,
    )
    if extent >= Extent.AS_GIVEN and motions:
        rows = (assess_linked(runs, rules, row, by_id(arrays, row.array)) for row in data.links)
        done = replace(done, linked=tuple(rows))
    if extent >= Extent.LESS_FRICTION:
        done = replace(done, at_reduced_friction=reassess(done, less_friction))
    if extent >= Extent.WHOLE and motions and slow is not data:
        done = replace(done, low_velocity=low_velocity(done, reassess(done, slow)))
    if extent >= Extent.OPEN:
        otherwise = prices(done, reassess, of_all=extent is Extent.WHOLE)
        done = replace(done, otherwise=otherwise)
    return done


def reassess(
    done: Assessment,
    project: ProjectInput,
    without: Collection[str] = (),
    extent: Extent = Extent.ALONE,
) -> Assessment:
    """Assess another input from the same runs, without some of the motions."""
    shaking, same = done.shaking, ("site", "target", "spectrum", "motions")
    if without:
        shaking = replace(
            shaking,
            motions=tuple(motion for motion in shaking.motions if motion.id not in without),
            prepared=tuple(
                motion for motion in shaking.prepared if motion.motion_id not in without
            ),
        )
    # The limits on motions depend on these parts of the input alone.
    is_known = not without and all(getattr(project, k) == getattr(done.project, k) for k in same)
    acceptance = done.acceptance if is_known else None
    return _assess(project, done.source, shaking, done.runs, acceptance, extent)


def entered(done: Assessment, project: ProjectInput) -> Assessment | None:
    """Assess a changed input under the same motions; None if `check` would reject it."""
    if refused(done.project, project):
        return None
    known = outdated(project, done.shaking.hashes)
    # With less friction, since the verdict is printed beside a remedy: an OK that 5% less friction
    # breaks is one with conditions.
    return reassess(done, known, extent=Extent.LESS_FRICTION)


def refused(data: ProjectInput, changed: ProjectInput) -> list[Finding]:
    """Return the errors that `check` finds in a changed input but not in the original one."""
    before = _faults(data)
    return [fault for fault in _faults(changed) if fault not in before]


def _faults(data: ProjectInput) -> list[Finding]:
    inputs = dict[str, list[dict[str, Any]]]()
    for part in SECTIONS:
        rows = getattr(data, part.key)
        inputs[part.key] = [dict(row) for row in (rows if part.is_table else (rows,))]
    return faults(inputs, lambda place: place.section)
