"""What peer review permits, and a departure from the rule set, for the summary and the letter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.assessment.arrays import ArrayAssessment, Route
from report.pages.parts import PackageData, check_value, shortened

_STEEP = "analysis_max_slope_deg"


def exceptional(package: PackageData) -> Sequence[tuple[str, str, str]]:
    """Return what peer review permits and a departure from the rule set, with who reviewed them."""
    return (*_review(package), *_steep(package), *_departure(package))


def review_sentences(package: PackageData) -> Iterator[str]:
    """Yield what peer review permits, for the client."""
    if package.data.options.peer_reviewed and _by_analysis(package):
        yield "The floor on the displacement from analysis is not applied: peer review is stated."
    if steep := _steeper(package):
        yield (
            f"The roof slope of {_named(steep)} is over the {_limit(package, steep)} of "
            f"{package.clause(_STEEP)}, which permits it in SDC A, B, C with peer review."
        )


def _review(package: PackageData) -> Iterator[tuple[str, str, str]]:
    """Yield what peer review does to the floor, which only a value from analysis has."""
    if not package.data.options.peer_reviewed:
        return
    arrays, clause = package.assessment.arrays, package.clause("analysis_floor")
    by_analysis = _by_analysis(package)
    if by_analysis:
        of = "" if len(by_analysis) == len(arrays) else f" ({_named(by_analysis)})"
        yield f"Floor{of}", f"removed by peer review: {package.reviewer}", clause
    else:
        why = "no floor is used: the design displacements are prescriptive"
        yield "Peer review", f"{package.reviewer}; {why}", clause


def _steep(package: PackageData) -> Iterator[tuple[str, str, str]]:
    if steep := _steeper(package):
        yield (
            f"Roof slope ({_named(steep)})",
            f"permitted over {_limit(package, steep)}: SDC {package.data.site.sdc_text}, analysis "
            "peer reviewed",
            package.clause(_STEEP),
        )


def _departure(package: PackageData) -> Iterator[tuple[str, str, str]]:
    if package.data.options.directional:
        reason = shortened(package.data.options.directional_reason, 80)
        yield "Departure", f"displacement by direction: {reason}", package.part("provisions")


def _by_analysis(package: PackageData) -> Sequence[ArrayAssessment]:
    return [item for item in package.assessment.arrays if item.route is Route.ANALYSIS]


def _steeper(package: PackageData) -> Sequence[ArrayAssessment]:
    """Return the arrays on roofs over the slope limit, which peer review permits."""
    return [
        item
        for item in package.assessment.arrays
        if any(check.passes_by_exception for check in item.limits)
    ]


def _limit(package: PackageData, steep: Sequence[ArrayAssessment]) -> str:
    check = next(check for check in steep[0].limits if check.passes_by_exception)
    return check_value(check, check.limit, package.fmt) + package.mark(_STEEP)


def _named(arrays: Sequence[ArrayAssessment]) -> str:
    return f"array{'' if len(arrays) == 1 else 's'} {', '.join(item.id for item in arrays)}"
