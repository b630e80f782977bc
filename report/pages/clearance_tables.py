"""Tables of the clearances: the schedule next to the plan, the field schedule, adjacent items.

Computes nothing. Each table is a list of columns over what it lists.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.plan.neighbors import PlanNeighbor
from report.document.columns import ColumnHead, centered, plain, provided, required, text, words
from report.document.tables import Column, Table, listed
from report.pages.parts import PackageData, bar
from report.project.model.choices import Direction
from report.text.unit_format import UnitFormat
from report.text.units import ratio
from solver.rules.provisions import SEPARATION_KEYS


@dataclass(frozen=True, slots=True)
class NumberedGap:
    """A clearance with its number in the workbook, which the plan and the schedules print."""

    number: int
    check: ClearanceCheck

    @property
    def key(self) -> str:
        """The provision of its factor."""
        return SEPARATION_KEYS[self.check.neighbor]


def numbered_gaps(assessment: Assessment) -> Sequence[NumberedGap]:
    """Return the clearances with their numbers."""
    return [NumberedGap(n, check) for n, check in enumerate(assessment.clearances, start=1)]


def plan_schedule(package: PackageData, fmt: UnitFormat) -> Table:
    """Return the schedule of clearances next to the plan, in one system of units."""
    columns: Sequence[Column] = (
        (text("No.", share=0.42), lambda gap: gap.number),
        (words("From", 0.84), lambda gap: gap.check.clearance.array),
        (words("To", 1.14), lambda gap: gap.check.clearance.object),
        (plain("×", share=0.62), lambda gap: gap.check.factor,
         lambda gap: package.marks.of(gap.key)),
        (required("Req’d", 0.88), lambda gap: gap.check.required_m,
         lambda gap: package.marks.required(gap.check), lambda gap: gap.check.shows[1]),
        (provided("Prov’d", 0.82), lambda gap: gap.check.provided_m, lambda _: "",
         lambda gap: gap.check.shows[0]),
        (ColumnHead(head="D/C", text=ratio, share=0.68), lambda gap: gap.check.demand_capacity,
         lambda gap: gap.check.mark),
        (centered("Verdict", 0.88), lambda gap: gap.check.verdict),
    )  # fmt: skip
    return _listed(package, columns, fmt)


def field_schedule(package: PackageData) -> Table:
    """Return the schedule of clearances to be measured in the field."""
    columns: Sequence[Column] = (
        (text("No.", share=0.42), lambda gap: gap.number),
        (words("From", 0.9), lambda gap: gap.check.clearance.array),
        (words("To", 1.4), lambda gap: gap.check.clearance.object),
        (words("Type", 3.4), lambda gap: _kind(gap.check)),
        (required("Minimum", 0.8), lambda gap: gap.check.required_m,
         lambda gap: package.marks.required(gap.check), lambda gap: gap.check.shows[1]),
        (words("Measured, date, by", 1.7), lambda _: ""),
    )  # fmt: skip
    return _listed(package, columns, package.fmt)


def _listed(package: PackageData, columns: Sequence[Column], fmt: UnitFormat) -> Table:
    changed = package.changes.clearances
    return listed(
        numbered_gaps(package.assessment),
        columns,
        fmt,
        kind="compact",
        style=lambda gap: bar(gap.number in changed),
    )


def _kind(check: ClearanceCheck) -> str:
    """Return the type of the item across a clearance, and the direction, if it has one."""
    direction = check.clearance.direction
    toward = "" if direction is Direction.ANY else f", {direction.value}"
    return check.neighbor.value + toward


def neighbor_table(package: PackageData, pairs: Sequence[PlanNeighbor]) -> Table:
    """Return pairs of the plan with their clearances."""
    columns: Sequence[Column] = (
        (words("Array", 0.7), lambda pair: pair.array),
        (words("Adjacent item", 1.3), lambda pair: pair.other),
        (words("Type", 1.8), lambda pair: pair.what),
        (provided("On plan", 0.8), lambda pair: pair.gap_m),
        (required("Twice displ.", 0.8), lambda pair: pair.reach_m),
        (words("Clearance", 0.9), lambda pair: pair.numbers),
        (words("Remark", 2.8), lambda pair: pair.cover),
    )
    return listed(pairs, columns, package.fmt, kind="compact")
