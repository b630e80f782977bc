"""What an array must keep from all that is near it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from report.assessment.checks.check import Check, Sense, dagger
from report.assessment.verdict import NO_DESIGN, Verdict
from report.sheet.schema.fields import Place
from report.text.amounts import capacity, demand
from report.text.units import Quantity
from solver.rules.provisions import SEPARATION_KEYS, RuleSet

if TYPE_CHECKING:
    from report.assessment.clearances import ClearanceCheck
    from report.assessment.project import Assessment


def of_clearances(done: Assessment) -> Iterator[Check]:
    """Yield whether each clearance is as wide as is required."""
    ids = [item.id for item in done.arrays]
    for index, gap in enumerate(done.clearances):
        yield _clearance(gap, done.rules, index, ids)


def _clearance(gap: ClearanceCheck, rules: RuleSet, index: int, ids: Sequence[str]) -> Check:
    row, separation = gap.clearance, rules.values[SEPARATION_KEYS[gap.neighbor]]
    has_limit, mark = not math.isnan(gap.required_m), dagger(separation)
    return Check(
        id="clearance",
        title="Clearance",
        subject=f"{row.array} to {row.object}",
        arrays=tuple(each for each in (row.array, row.object) if each in ids),
        found=capacity(row.provided_m, Quantity.SIZE),
        limit=demand(gap.required_m, Quantity.SIZE, gap.mark) if has_limit else NO_DESIGN,
        sense=Sense.AT_LEAST if has_limit else Sense.STATED,
        clause=separation.clause + mark,
        # Beside an array without a permitted route it has no verdict of its own.
        is_satisfied=gap.verdict is Verdict.OK,
        remedy="Widen the clearance, or reduce the displacement.",
        places=(Place("clearances", index, "provided_m"),),
    )
