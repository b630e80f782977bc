"""A clearance as it is written and shown.

Computes nothing: see `report.assessment.clearances`. Read `ClearanceResult`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated

from pydantic import BeforeValidator, Field

from report.assessment.clearances import ClearanceCheck
from report.assessment.plan_gaps import PlanGap
from report.assessment.verdict import Verdict
from report.entities.columns import UnitFormat
from report.entities.marks import Marked, joined
from report.entities.shown import Entity, Number, Shown, at, length, plain, unwritten, words
from report.sheet.schema import Direction
from report.words.units import Quantity, compared, ratio, rounded_apart
from solver.rules.provisions import SEPARATION_KEYS, Neighbor


class ClearanceResult(Entity):
    """A clearance: required and provided separation."""

    array: Annotated[str, at("clearance.array"), words("From", 0.9)]
    object: Annotated[str, at("clearance.object"), words("To", 1.3)]
    direction: Annotated[Direction, at("clearance.direction")]
    neighbor: Neighbor
    governing_array: Annotated[str, words("Array", 0.75)]
    governing_direction: Annotated[Direction, words("Direction", 1.05)]
    design_m: Annotated[Number, length("Displ.", 0.8)]
    importance: float
    factor: Annotated[float, plain("Factor", share=0.75)]
    required_m: Annotated[Number, length("Required", 0.8)]
    required_is_overridden: Annotated[bool, at("mark"), BeforeValidator(bool)]
    provided_m: Annotated[float, at("clearance.provided_m"), length("Provided", 0.8)]
    demand_capacity: Annotated[Number, Shown(head="D/C", text=ratio, share=0.75)]
    verdict: Annotated[Verdict, Shown(head="Verdict", align="center", share=0.95)]
    count: Annotated[int, Shown(head="No.", share=0.42)] = Field(default=0, exclude=True)
    clause: Annotated[str, words("Clause", 2.1)] = Field(default="", exclude=True)

    @unwritten(words("Condition", 2.2))
    def condition(self) -> str:
        """Kind of what is across it, and the direction, if it has one."""
        where = "" if self.direction is Direction.ANY else f", {self.direction.value}"
        return self.neighbor.value + where

    @property
    def is_rounded_apart(self) -> bool:
        """Whether required and provided separation would print alike, and do not."""
        return rounded_apart(self.required_m, self.provided_m, Quantity.DISPLACEMENT)


def clearance_results(
    marked: Marked, gaps: Mapping[int, ClearanceCheck]
) -> Iterator[ClearanceResult]:
    """Yield clearances, by their number in the workbook, with their marks."""
    for count, gap in gaps.items():
        key = SEPARATION_KEYS[gap.neighbor]
        least = marked.mark("separation_edge_min_in") if gap.is_minimum_value else ""
        required, provided = compared(gap.required_m, gap.clearance.provided_m)
        yield ClearanceResult.of(
            gap,
            count=count,
            clause=marked.clause(key),
            marks={
                "design_m": gap.design_mark,
                "factor": marked.mark(key),
                "required_m": joined(least, gap.mark),
                "demand_capacity": gap.mark,
            },
            rounds={"required_m": required, "provided_m": provided},
        )


def callout(gap: PlanGap, fmt: UnitFormat) -> tuple[str, str]:
    """Return what a plan says of a gap: provided and required, in the preferred system."""
    show_required, show_provided = compared(gap.required_m, gap.provided_m)
    provided = fmt.short(gap.provided_m, show=show_provided)
    required = fmt.short(gap.required_m, show=show_required)
    mark = "" if math.isnan(gap.required_m) else gap.mark
    return (
        f"{'provided' if gap.is_given else 'not given; in plan'} {provided}",
        f"required {required}{mark}",
    )
