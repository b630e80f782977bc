"""What is on file, stated and confirmed."""

from __future__ import annotations

from collections.abc import Collection

from report.assessment.checks.check import Check
from report.assessment.verdict import Requirement


def of_row(row: Requirement, arrays: Collection[str]) -> Check:
    """Return a requirement as a check in words."""
    return Check(
        id=row.id,
        title=row.title,
        subject=row.subject,
        arrays=(row.subject,) if row.subject in arrays else (),
        found=row.found,
        limit=row.limit,
        clause=row.basis,
        is_satisfied=row.is_satisfied,
        consequence=row.consequence,
        remedy=row.remedy,
        otherwise=row.outcome,
        places=row.places,
    )
