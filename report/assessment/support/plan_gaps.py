"""The clearances between shapes in plan, to be drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import PlanNeighbor
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from report.project.model.shapes import Point, Shape, closest
from solver.rules.provisions import Neighbor


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
        """Whether the workbook has the clearance."""
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
        array, other = gap.between
        far = gap.far if isinstance(gap, PlanNeighbor) else shapes.get(other)
        if far is not None:  # an object may have no place in plan
            yield PlanGap(
                number=number,
                array=array,
                other=other,
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
