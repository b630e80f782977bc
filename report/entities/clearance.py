"""A clearance as it is written and shown.

Computes nothing: see `report.assessment.clearances`. Read `ClearanceResult`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated

from pydantic import BeforeValidator

from report.assessment.clearances import ClearanceCheck
from report.assessment.project import ChangeKind
from report.assessment.verdict import Verdict
from report.entities.requirement import Marked, joined
from report.entities.shown import (
    Column,
    Entity,
    Number,
    Shown,
    Told,
    at,
    centered,
    plain,
    printed,
    provided,
    required,
    unwritten,
    up_column,
    words,
)
from report.project.model.choices import Direction, DistanceBasis
from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import ratio, round_up
from solver.rules.provisions import SEPARATION_KEYS, Neighbor

_REQUIRED = '=IF(ISTEXT({design_m}),"none",MAX({design_m}*{factor},{minimum_m}))'
# Rounded up as `ratio` does, so that 1.00 never hides a failure.
_UP = "MAX(0,ROUNDUP({required_m}/{provided_m}-0.000000001,2))"
_RATIO = f'=IF(ISTEXT({{required_m}}),"none",IF({{provided_m}}>0,{_UP},"none"))'
_OK = '=IF(ISTEXT({required_m}),"{unknown}",IF({required_m}<={provided_m},"OK","NG"))'


# The value beside the formula is rounded as the formula is, and as the page.
def _as_printed(value: float) -> float:
    return round_up(value, 2) if math.isfinite(value) else math.nan


class ClearanceResult(Entity):
    """A clearance: required and provided separation."""

    array: Annotated[str, at("clearance.array"), words("From", 0.9), Column("Array")]
    object: Annotated[str, at("clearance.object"), words("To", 1.3), Column("Object")]
    direction: Annotated[Direction, at("clearance.direction"), Column("Direction")]
    """Direction of the clearance from the array; any where none is entered."""
    neighbor: Annotated[Neighbor, Column("Kind")]
    """Kind of neighbor, which gives the separation factor."""
    governing_array: str
    """Array whose displacement governs."""
    design_m: Annotated[Number, up_column("Design [in]", 1, "={largest}", is_always=True)]
    importance: Annotated[float, Column("Importance factor", 2, "={inputs[i_e]}", is_input=True)]
    """Importance factor in the required separation."""
    factor: Annotated[
        float, plain("Factor", share=0.75), Column("", 2, "={rule_factor}*{importance}")
    ]
    """Separation factor of the rule set, with the importance factor."""
    required_m: Annotated[
        Number,
        required("Required", 0.8),
        up_column("[in]", 1, _REQUIRED, is_always=True),
        up_column("[mm]", 0, is_always=True),
        # Of a new clearance the verdict is told, which says as much.
        Told(
            ChangeKind.CLEARANCE, "{row.array} to {row.object}{row.toward}, required", of_new=False
        ),
    ]
    required_is_overridden: Annotated[bool, at("mark"), BeforeValidator(bool)]
    """Whether a number of the rule set behind it is overridden."""
    provided_m: Annotated[
        float,
        at("clearance.provided_m"),
        provided("Provided", 0.8),
        Column("[in]", is_input=True),
        Told(),
    ]
    basis: Annotated[DistanceBasis, Column("Distance from")] = DistanceBasis.ENTERED
    """Basis of the separation entered."""
    demand_capacity: Annotated[
        Number,
        Shown(head="D/C", text=ratio, share=0.75),
        Column("", 2, _RATIO, value=_as_printed, is_always=True),
        Told(ChangeKind.CLEARANCE, "{row.array} to {row.object}{row.toward}, D/C", of_new=False),
    ]
    """Required / provided separation."""
    verdict: Annotated[
        Verdict,
        centered("Verdict", 0.95),
        Column("Verdict", formula=_OK, is_always=True),
        Told(ChangeKind.VERDICT, "Clearance {row.array} to {row.object}"),
    ]
    """OK, NG, or none where the required separation is not known."""
    count: Annotated[int, Shown(head="No.", share=0.42)] = printed(0)
    clause: str = printed("")

    @property
    def toward(self) -> str:
        """The direction after a comma, if it has one."""
        return "" if self.direction is Direction.ANY else f", {self.direction.value}"

    @unwritten(words("Between", 1.6))
    def between(self) -> str:
        """What is on either side."""
        return f"{self.array}–{self.object}"

    @unwritten(words("Kind", 2.2))
    def condition(self) -> str:
        """Kind of what is across it, and the direction, if it has one."""
        return self.neighbor.value + self.toward

    @unwritten(required("At least", 0.8))
    def least_m(self) -> float:
        """Required separation [m]."""
        return self.required_m

    @unwritten(words("Measured", 1.1))
    def measured(self) -> str:
        """Room for a value from the field."""
        return ""


def clearance_results(
    marked: Marked, gaps: Mapping[int, ClearanceCheck]
) -> Iterator[ClearanceResult]:
    """Yield clearances, by their number in the workbook, with their marks."""
    for count, gap in gaps.items():
        key = SEPARATION_KEYS[gap.neighbor]
        # Where the minimum governs, the number that is marked is the minimum.
        least = marked.mark("separation_edge_min_in") if gap.is_minimum_value else ""
        had, needed = shown_in_order(capacity(gap.clearance.provided_m), demand(gap.required_m))
        yield ClearanceResult.of(
            gap,
            count=count,
            clause=marked.clause(key),
            marks={
                "factor": marked.mark(key),
                **dict.fromkeys(("required_m", "least_m"), joined(least, gap.mark)),
                "demand_capacity": gap.mark,
            },
            rounds={"provided_m": had, "required_m": needed, "least_m": needed},
        )
