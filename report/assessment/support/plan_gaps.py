"""Distances drawn on the plan: clearances, and the keep-clear distance of each array."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.rule_set import mark_of
from report.assessment.design.separation import importance_factor
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import PlanNeighbor
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from report.project.model.shapes import Point, Shape, closest
from solver.model import INCH_M
from solver.rules import provisions
from solver.rules.provisions import Neighbor
from solver.rules.rulesets import RULE_SETS
from solver.spaces import NO_BREAK


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanGap:
    """A clearance between two shapes of the plan, or a gap without one that is NG."""

    number: int  # in the workbook, from 1; 0 where no clearance is given
    # what it is between; `other` names a bare roof edge in words
    array: str
    other: str
    near: Shape
    far: Shape
    provided_m: float  # as given [m]; where no clearance is, the gap of the plan
    required_m: float  # required separation [m]; NaN if it is not known
    mark: str  # of the required separation
    verdict: Verdict

    @property
    def is_given(self) -> bool:
        """Whether the workbook lists the clearance."""
        return self.number > 0

    @property
    def is_ng(self) -> bool:
        """Whether it is not satisfied."""
        return self.verdict is Verdict.NG

    @property
    def ends(self) -> tuple[Point, Point]:
        """The points nearest to each other [m]."""
        return closest(self.near, self.far)


def plan_gaps(assessment: Assessment) -> Iterator[PlanGap]:
    """Yield the clearances between shapes in plan, and after them what is NG without one."""
    shapes = assessment.project.shapes
    gaps: list[tuple[int, ClearanceCheck | PlanNeighbor]]
    gaps = [*enumerate(assessment.clearances, start=1)]
    for number, gap in (*gaps, *((0, missing) for missing in assessment.missing_gaps)):
        array, across = gap.between
        far = gap.far if isinstance(gap, PlanNeighbor) else shapes.get(across)
        if far is not None:  # an object may have no place in plan
            yield PlanGap(
                number=number,
                array=array,
                other=across,
                near=shapes[array],
                far=far,
                provided_m=gap.provided_m,
                required_m=gap.required_m,
                mark=gap.mark,
                verdict=gap.verdict,
            )


def parapet_note(assessment: Assessment, item: RoofObject) -> str:
    """Return that a parapet does not qualify, and for which arrays where it does for others."""
    gaps = [gap for gap in assessment.clearances if gap.clearance.object == item.id]
    arrays = [gap.clearance.array for gap in gaps if gap.neighbor is Neighbor.EDGE]
    if item.kind is not ObjectKind.EDGE_WITH_PARAPET or not arrays:
        return ""
    return ", does not qualify" + (f" for {', '.join(arrays)}" if len(arrays) < len(gaps) else "")


def keep_clear_m(
    assessment: Assessment, array: ArrayAssessment, neighbor: Neighbor = Neighbor.FIXED
) -> float:
    """Return the separation from any fixed object [m]; NaN without a permitted displacement."""
    rules, i_e = assessment.rules, assessment.project.site.i_e
    # Any object that may come: its I_p is taken as that of the array.
    importance = importance_factor(rules, neighbor, i_e=i_e, i_p=array.array.i_p)
    return provisions.required_separation(
        rules, neighbor, design_m=array.permitted_m, importance=importance
    )


def keep_clear_mark(assessment: Assessment, array: ArrayAssessment) -> str:
    """Return the mark of the separation of an array from any fixed object; none without one."""
    if math.isnan(keep_clear_m(assessment, array)):
        return ""
    factor, plain = (
        rules["separation_fixed"] for rules in (assessment.rules, RULE_SETS[assessment.rules.name])
    )
    return array.overridden.design or mark_of(factor, plain)


def keep_clear(separation_m: float, us_first: bool) -> str:
    """Return a distance to keep clear, rounded up to 1 in or 10 mm; `unknown` for NaN."""
    if math.isnan(separation_m):
        return "unknown"  # "none" would read as no distance
    # Minus 1e-9: 43 in of meters, divided by the inch again, are 43.00000000000001.
    steps = math.ceil(separation_m / (INCH_M if us_first else 0.01) - 1e-9)
    return f"{steps}{NO_BREAK}in" if us_first else f"{10 * steps}{NO_BREAK}mm"
