"""Effect of peer review, and limits exceeded with it: for the letter and the summary."""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import alike, sentence
from report.assessment.design.routes import Route


def by_analysis(done: Assessment) -> Sequence[str]:
    """Return the arrays that use the analysis displacement, whose floor peer review removes."""
    return [item.id for item in done.arrays if item.route is Route.ANALYSIS]


def excepted(done: Assessment) -> Sequence[str]:
    """Return the limits exceeded as permitted by the rule set, as sentences."""
    checks = alike(check for check in done.checks if check.is_excepted)
    return [sentence(check, done.project.us_first) for check in checks]
