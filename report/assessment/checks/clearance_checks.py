"""Checks of clearances against the required width and the roof plan, and of the plan itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from report.assessment.checks.check import PLAN_ROW, Check, Sense, condition, dagger
from report.assessment.checks.fire_access import of_sections, pathway_check
from report.assessment.design.verdict import NO_DESIGN, NOT_GIVEN, Verdict
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import ClearanceSource, DistanceBasis
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES
from report.text.amounts import Amount, capacity, demand
from report.text.letter_case import capitalized
from report.text.units import Quantity, no_more, pair
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.clearances import ClearanceCheck
    from report.assessment.plan.neighbors import PlanNeighbor


def of_clearances(done: Assessment) -> Iterator[Check]:
    """Yield whether each clearance is as wide as required, and the remaining pathway width."""
    ids = [item.id for item in done.arrays]
    for index, gap in enumerate(done.clearances):
        yield clearance_check(gap, index, ids)
    for index, gap in enumerate(done.clearances):
        if gap.clearance.pathway_m:
            yield pathway_check(done, gap, gap.clearance.pathway_m, index)


def clearance_check(gap: ClearanceCheck, index: int = 0, ids: Sequence[str] = ()) -> Check:
    """Return whether a clearance is as wide as required, for the arrays among `ids`."""
    row, has_limit = gap.clearance, not math.isnan(gap.required_m)
    return Check(
        id="clearance",
        title="Clearance",
        subject=f"{row.array} to {row.object}",
        arrays=tuple(name for name in (row.array, row.object) if name in ids),
        found=capacity(row.provided_m, Quantity.SIZE),
        limit=demand(gap.required_m, Quantity.SIZE, gap.mark) if has_limit else NO_DESIGN,
        sense=Sense.AT_LEAST if has_limit else Sense.STATED,
        clause=gap.separation.clause + dagger(gap.separation),
        # Beside an array without a permitted route it has no verdict of its own.
        is_satisfied=gap.verdict is Verdict.OK,
        remedy="Widen the clearance, or reduce the displacement.",
        places=(Place("clearances", index, "provided_m"),),
    )


def of_neighbors(done: Assessment) -> Iterator[Check]:
    """Yield items on the plan near an array whose clearance is missing or contradicts the plan."""
    for near in done.neighbors:
        found_value, limit = _found_and_required(near, done.project.us_first)
        for cell, words in near.shortcomings():
            yield Check(
                id=PLAN_ROW,
                title="Clearance as on the plan",
                subject=near.names,
                arrays=(near.array,),
                found=found_value,
                note=NOT_GIVEN if near.is_short else "",
                limit=limit,
                sense=Sense.STATED if isinstance(limit, str) else Sense.AT_LEAST,
                clause="roof plan",
                is_satisfied=False,
                # Where a row and the plan differ it is not known here which of them is right.
                consequence=Consequence.NG if near.is_short else Consequence.CONDITION,
                remedy=f"{capitalized(words)}.",
                cell=cell,
            )
    if done.neighbors and not any(near.shortcomings() for near in done.neighbors):
        yield condition(
            id=PLAN_ROW,
            title="Clearances as on the plan",
            found=f"{len(done.neighbors)} of {len(done.neighbors)} adjacent pairs",
            limit="all, in agreement with the plan",
            clause="roof plan",
            is_satisfied=True,
        )


def _found_and_required(near: PlanNeighbor, us_first: bool) -> tuple[Amount | str, Amount | str]:
    if near.is_short:
        required = demand(near.required_m, Quantity.SIZE, near.mark)
        has_limit = not math.isnan(near.required_m)
        return capacity(near.gap_m, Quantity.SIZE), required if has_limit else NO_DESIGN
    gap = pair(near.gap_m, Quantity.SIZE, us_first, no_more)
    if near.is_missing:
        found_text = f"{NOT_GIVEN}; {gap} on the plan, within twice the design displacement"
        return found_text, "a clearance that agrees with the plan"
    # Several rows of a pair may give several distances.
    values = {row.clearance.provided_m for row in near.contradictions}
    sizes = " and ".join(pair(m, Quantity.SIZE, us_first, no_more) for m in sorted(values))
    return f"{sizes} entered, {gap} on the plan", "as on the plan"


def of_roof(data: ProjectInput) -> Iterator[Check]:
    """Yield the requirements on the roof plan: outline, array sections, confirmed distances."""
    has_outline = data.roof.placed is not None
    yield condition(
        id="roof_outline",
        title="Outline of the roof",
        found="entered" if has_outline else NOT_GIVEN,
        limit="entered",
        clause="roof plan",
        is_satisfied=has_outline,
        remedy="Enter the outline of the roof on the Building worksheet; without it, roof edges "
        "near the arrays are not identified.",
        places=tuple(Place("roof", 0, side) for side in SIDES),
    )
    yield from of_sections(data)
    for array in data.arrays:
        yield from _drawing_distances(data, array)


def _drawing_distances(data: ProjectInput, array: Array) -> Iterator[Check]:
    """Yield the distances of an array that are from the drawing and not compared by a check."""
    drawn = [
        index
        for index, row in enumerate(data.clearances)
        if row.source is ClearanceSource.DRAWING and array.id in (row.array, row.object)
    ]
    if drawn:  # their numbers are below the table of clearances: so arrays share a condition
        by, date = data.project.drawing_confirmed_by, data.project.drawing_confirmed_date
        is_confirmed = data.basis_of(data.clearances[drawn[0]]) is DistanceBasis.CONFIRMED
        yield condition(
            id="drawing_distances",
            title="Clear distances from the drawing",
            subject=array.id,
            arrays=(array.id,),
            found=f"confirmed by {by}, {date}" if is_confirmed else "not confirmed",
            limit="measured, or confirmed by name and date",
            clause="roof plan",
            is_satisfied=is_confirmed,
            remedy="Enter measured on the Clearances worksheet, or on the Project worksheet who "
            "confirmed them and when.",
            places=tuple(Place("clearances", index, "source") for index in drawn),
        )
