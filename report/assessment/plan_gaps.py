"""The gaps that a plan shows: each clearance, and each gap without one that is less than required.

What draws or writes a plan takes them from here. Read `plan_gaps`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.sheet.schema.choices import ObjectKind
from report.sheet.schema.scene import RoofObject
from report.sheet.schema.shapes import Point, Shape, closest
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
    shapes = shapes_of(assessment)
    for count, gap in enumerate(assessment.clearances, start=1):
        row = gap.clearance
        if row.array in shapes and row.object in shapes:
            yield PlanGap(
                number=count,
                array=row.array,
                other=row.object,
                near=shapes[row.array],
                far=shapes[row.object],
                provided_m=row.provided_m,
                required_m=gap.required_m,
                mark=gap.mark,
                verdict=gap.verdict,
            )
    for pair in assessment.missing_gaps:
        yield PlanGap(
            number=0,
            array=pair.array,
            other=pair.other,
            near=pair.near,
            far=pair.far,
            provided_m=pair.gap_m,
            required_m=pair.required_m,
            mark=pair.mark,
            verdict=Verdict.NG,
        )


def shapes_of(assessment: Assessment) -> dict[str, Shape]:
    """Return the arrays and the objects that have a place in plan, by id."""
    data = assessment.project
    shapes: dict[str, Shape] = {item.id: item.placed for item in data.objects if item.placed}
    return shapes | {array.id: array.shape for array in data.arrays}


def parapet_note(assessment: Assessment, item: RoofObject) -> str:
    """Return that a parapet does not qualify, and for which arrays where it does for others."""
    gaps = [gap for gap in assessment.clearances if gap.clearance.object == item.id]
    arrays = [gap.clearance.array for gap in gaps if gap.neighbor is Neighbor.EDGE]
    if item.kind is not ObjectKind.EDGE_WITH_PARAPET or not arrays:
        return ""
    return ", does not qualify" + (f" for {', '.join(arrays)}" if len(arrays) < len(gaps) else "")
