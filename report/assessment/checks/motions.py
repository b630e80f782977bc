"""The limits on the motions of an analysis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from report.assessment.checks.check import Check
from report.assessment.checks.limits import of_limit
from report.assessment.routes import Route
from report.assessment.verdict import MOTIONS_ID
from report.sheet.schema.fields import Place
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.project import Assessment


def of_motions(done: Assessment) -> Iterator[Check]:
    """Yield the limits on the motions; a note where no design displacement follows from them."""
    analyzed = tuple(item.id for item in done.arrays if item.route is Route.ANALYSIS)
    is_concerned = any(item.is_by_runs for item in done.arrays)
    remedies = {row.title: row.remedy for row in done.rows if row.id == MOTIONS_ID}
    for limit in done.acceptance.rows:
        check, consequence = of_limit(limit), limit.consequence
        # The prescriptive displacement rests on no motion: there a miss is a condition only.
        if not analyzed:
            consequence = Consequence.CONDITION
        if not is_concerned:
            consequence = Consequence.NOTE
        yield replace(
            check,
            id=MOTIONS_ID,
            arrays=analyzed if consequence is Consequence.NG else (),
            consequence=consequence,
            remedy=remedies.get(limit.title, ""),
            places=(Place("motions"),),
        )
