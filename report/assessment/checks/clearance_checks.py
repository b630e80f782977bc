"""Whether each clearance is as wide as is required."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from report.assessment.checks.check import Check, Sense, dagger
from report.assessment.checks.fire_access import pathway_check
from report.assessment.design.verdict import Verdict
from report.assessment.design.words import NO_DESIGN
from report.project.model.place import Place
from report.text.amounts import capacity, demand
from report.text.units import Quantity

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.clearances import ClearanceCheck


def of_clearances(done: Assessment) -> Iterator[Check]:
    """Yield whether each clearance is as wide as is required, and what is left of a pathway."""
    ids = [item.id for item in done.arrays]
    for index, gap in enumerate(done.clearances):
        yield clearance_check(gap, index, ids)
    for index, gap in enumerate(done.clearances):
        if gap.clearance.pathway_m:
            yield pathway_check(done, gap, gap.clearance.pathway_m, index)


def clearance_check(gap: ClearanceCheck, index: int = 0, ids: Sequence[str] = ()) -> Check:
    """Return whether a clearance is as wide as is required; of the arrays among `ids`."""
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
