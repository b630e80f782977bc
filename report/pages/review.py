"""What peer review permits, for the summary and the letter."""

from __future__ import annotations

from dataclasses import dataclass

from report.assessment.arrays import Route
from report.pages.parts import PackageData, check_value


@dataclass(frozen=True, slots=True, kw_only=True)
class Review:
    """Arrays that peer review concerns: by analysis, and on roofs over the slope limit."""

    by_analysis: tuple[str, ...]
    steeper: tuple[str, ...]
    slope_limit: str


def review(package: PackageData) -> Review:
    """Return the arrays that have no floor, or a steeper roof, where peer review is stated."""
    arrays = package.assessment.arrays
    excepted = {
        item.id: check for item in arrays for check in item.limits if check.passes_by_exception
    }
    limits = [check_value(check, check.limit, package.fmt) for check in excepted.values()]
    return Review(
        by_analysis=tuple(item.id for item in arrays if item.route is Route.ANALYSIS),
        steeper=tuple(excepted),
        slope_limit="".join(limits[:1]),
    )
