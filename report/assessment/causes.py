"""What gives an array its verdict, in a few words, for its row in a table.

Draws no verdict: `Assessment.array_verdict` does. Read `unshown_cause`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from report.assessment.verdict import Verdict
from report.words.counts import lowered
from solver.model import Status

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.clearances import ClearanceCheck
    from report.assessment.project import Assessment


def unshown_cause(assessment: Assessment, item: ArrayAssessment) -> str:
    """Return the first cause of a verdict and the count of others; nothing where the D/C shows it.

    Nothing for OK.
    """
    verdict, found = assessment.array_verdict(item), causes(assessment, item)
    is_shown = any(gap.demand_capacity > 1.0 for gap in assessment.gaps_of(item.id))
    if not found or (verdict is Verdict.NG and is_shown):
        return ""
    return found[0] + (f" and {len(found) - 1} more" if len(found) > 1 else "")


def causes(assessment: Assessment, item: ArrayAssessment) -> Sequence[str]:
    """Return what gives an array its verdict, in a few words each; nothing for OK."""
    verdict = assessment.array_verdict(item)
    rows = [row for row in assessment.rows_of(item.id) if row.verdict is verdict]
    of_rows = [row.cause or lowered(row.title) for row in rows if not row.is_satisfied]
    if verdict is not Verdict.NG:
        return of_rows
    statuses = {run.result.status for run in item.runs}
    on_motions = item.governs is not item.governs.PRESCRIPTIVE
    return [
        # Up to its colon a sentence says what happened, and after it what follows.
        *(s.sentence.split(":")[0] for s in Status if s in statuses and s is not Status.OK),
        *(lowered(check.title) for check in item.limits if not check.ok),
        *(["limits on the motions"] if on_motions and not assessment.acceptance.qualifies else []),
        *([] if item.is_model_enough else ["requested model"]),
        *([] if item.tipping.is_ok else ["tipping"]),
        *([] if assessment.is_rigid_enough(item) else ["one rigid block"]),
        *(_gap(item, gap) for gap in assessment.gaps_of(item.id) if not gap.ok),
        *of_rows,
    ]


def _gap(item: ArrayAssessment, gap: ClearanceCheck) -> str:
    words = f"clearance to {gap.across_from(item.id)}"
    return words if gap.is_permitted else f"{words}, no verdict"
