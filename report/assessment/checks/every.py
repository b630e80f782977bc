"""All that is required of an assessed project, satisfied or not. Read `every`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from report.assessment.checks import arrays, evidence, limits, motions, plan
from report.assessment.checks.check import Check
from report.assessment.verdict import MOTIONS_ID

if TYPE_CHECKING:
    from report.assessment.project import Assessment


def every(done: Assessment) -> tuple[Check, ...]:
    """Return everything that is required of a project."""
    ids = [item.id for item in done.arrays]
    return (
        *limits.of_building(done),
        *(check for item in done.arrays for check in limits.of_array(done, item)),
        *(check for item in done.arrays for check in arrays.of_array(done, item)),
        *map(arrays.of_links, done.linked),
        *plan.of_clearances(done),
        *motions.of_motions(done),
        *(evidence.of_row(row, ids) for row in done.rows if row.id != MOTIONS_ID),
    )
