"""Fire code requirements: pathways along clearances, and the size of array sections.

96 in less the 40.8 in that an array slides leave 55.2 in, enough for a pathway of 48 in.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from report.assessment.checks.check import Actor, Check, Sense, condition
from report.assessment.design.clearances import slides_m
from report.assessment.design.verdict import NO_DESIGN, NOT_GIVEN, STAYS
from report.assessment.plan.neighbors import direction_of
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES, around, gap_m
from report.text.amounts import Amount, capacity, demand, entered
from report.text.counts import numbered
from report.text.names import ranged
from report.text.units import Quantity, no_less, no_more, pair

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.clearances import ClearanceCheck
    from report.assessment.plan.neighbors import PlanNeighbor


_NOISE = 1e-9  # a width in other units is no more than itself


def pathway_check(done: Assessment, gap: ClearanceCheck, pathway_m: float, index: int) -> Check:
    """Return the remaining width of a fire pathway after adjacent arrays have slid into it."""
    row, us_first = gap.clearance, done.project.us_first
    slides = slides_m(done.arrays, gap)
    left_m = row.provided_m - math.fsum(slides)
    found_value: Amount | str = capacity(left_m, Quantity.SIZE, gap.design_mark)
    slid = (pair(m, Quantity.SIZE, us_first, no_less) for m in slides)
    terms = " − ".join((pair(row.provided_m, Quantity.SIZE, us_first, no_more), *slid))
    if math.isnan(left_m):
        found_value, terms = NO_DESIGN, ""
    return Check(
        id="fire_pathway",
        title="Fire pathway after displacement",
        subject=f"{row.array} to {row.object}",
        arrays=(row.array,),
        found=found_value,
        note=terms,
        limit=demand(pathway_m, Quantity.SIZE),
        sense=Sense.AT_LEAST,
        clause="fire code, as entered",
        # False for NaN: without a displacement nothing is known to be left.
        is_satisfied=left_m >= pathway_m * (1.0 - _NOISE),
        remedy="Widen the clearance, or reduce the displacement.",
        places=(Place("clearances", index, "pathway_m"),),
    )


def of_pathways(data: ProjectInput, pairs: Sequence[PlanNeighbor] = ()) -> Iterator[Check]:
    """Yield for each array whether its clearances state if a fire pathway runs along them.

    The pairs of the plan that lack a clearance do not say so, if they are given: those that are
    near, and those that face each other where a pathway may be left too narrow.
    """
    # Deleting the row of a clearance must not make its pathway pass
    # (test_evidence_never_hurts.py).
    silent = []
    for near in pairs:
        is_within = not near.given and near.gap_m <= near.reach_m + data.site.fire_lane_m
        # Those that face each other: a pathway does not run across corners.
        may_narrow = is_within and direction_of(near, 0.0) is not Direction.ANY
        if near.is_missing or may_narrow:
            silent.append(near)
    for array in data.arrays:
        rows = [(index, row) for index, row in enumerate(data.clearances) if row.array == array.id]
        blank = [index for index, row in rows if row.pathway_m is None]
        without_row = [near.names for near in silent if near.array == array.id]
        count = len(blank) + len(without_row)
        yield condition(
            id="fire_pathways",
            title="Fire pathways along the clearances",
            subject=array.id,
            arrays=(array.id,),
            found=f"{numbered(count, 'clearance')} without an entry" if count else "entered",
            note=f"no row: {', '.join(without_row)}" if without_row else "",
            limit="none or a width, for each clearance",
            clause="fire code, as entered",
            is_satisfied=not count,
            remedy="In each row of the Clearances worksheet, enter the width of the fire pathway "
            "along the clearance, or none.",
            places=tuple(Place("clearances", index, "pathway_m") for index in blank)
            or (Place("clearances"),),
        )


# Largest plan dimension of an array section [m]: 150 ft, which local codes amend: hence †.
FIRE_LANE_M = 150 * 0.3048

_MOST_M = FIRE_LANE_M * (1.0 + 1e-9)  # 150 ft given in meters is no more than 150 ft
_ROUNDING_M = 1e-3  # a pathway of 4 ft is typed as 1.22 m


def of_sections(data: ProjectInput) -> Iterator[Check]:
    """Yield for each array the plan dimension of all that no fire pathway separates from it."""
    # The section of the code is an input: local fire codes amend the limit and its number.
    lane_m, section = data.site.fire_lane_m, data.site.fire_code_section
    rows = {array.id: row for row, array in enumerate(data.arrays)}
    yield condition(
        id="fire_code",
        title="Section of the fire code",
        arrays=tuple(rows),
        found=section or NOT_GIVEN,
        limit="section on rooftop arrays",
        clause="fire code",
        is_satisfied=bool(section),
        remedy="Enter the section of the fire code on the Site worksheet.",
        places=(Place("site", 0, "fire_code_section"),),
    )
    for group in _undivided(data.arrays, lane_m):
        plan = around(array.shape for array in group)
        dimension_m = max(plan.x_to_m - plan.x_from_m, plan.y_to_m - plan.y_from_m)
        for array in group:
            yield condition(
                id="fire_lanes",
                title="Array section without a fire pathway of "
                + pair(lane_m, Quantity.PLAN, data.us_first, no_less),
                subject=array.id,
                arrays=(array.id,),
                found=entered(dimension_m, Quantity.PLAN),
                note=ranged(array.id for array in group) if len(group) > 1 else "",
                limit=capacity(FIRE_LANE_M, Quantity.PLAN, mark="†"),
                sense=Sense.AT_MOST,
                clause=f"{section or 'fire code'}†",
                actor=Actor.FIRE,
                is_satisfied=dimension_m <= _MOST_M,
                remedy="Separate the arrays with a fire pathway, or obtain the fire department's "
                f"approval. {STAYS}",
                places=tuple(Place("arrays", rows[array.id], side) for side in SIDES),
            )


def _undivided(arrays: Sequence[Array], lane_m: float) -> Sequence[Sequence[Array]]:
    """Return arrays in groups: each is nearer than a pathway to another one of its group."""
    groups: list[list[Array]] = []
    for array in arrays:
        # One array may join groups that were apart until it came.
        apart: list[list[Array]] = []
        joined = [array]
        for group in groups:
            # Between shapes, not their boxes: a ring may surround an array without being near it.
            if any(gap_m(array.shape, neighbor.shape) < lane_m - _ROUNDING_M for neighbor in group):
                joined += group
            else:
                apart.append(group)
        groups = [*apart, joined]
    return groups
