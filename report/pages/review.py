"""What peer review concerns, and what it lets exceed a limit: for the letter and the summary."""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import alike, sentence
from report.assessment.design.routes import Route


def by_analysis(done: Assessment) -> Sequence[str]:
    """Return the arrays that take the displacement by analysis, whose floor peer review lifts."""
    return [item.id for item in done.arrays if item.route is Route.ANALYSIS]


def excepted(done: Assessment) -> Sequence[str]:
    """Return the checks that are exceeded where the rule set permits it, in sentences."""
    checks = alike(check for check in done.checks if check.is_excepted)
    return [sentence(check, done.project.us_first) for check in checks]
