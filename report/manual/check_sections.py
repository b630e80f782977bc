"""The sections of the verification manual that show its checks: the summary and all tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from markupsafe import Markup

from report.document.columns import centered, text, words
from report.document.sections import Section, section
from report.document.tables import grouped, headed, listed
from report.manual import paper_sections
from report.manual.measured_buildings import middle, span
from report.manual.paper_sections import PAPER_MEAN_PERCENT, PAPER_WORST_PERCENT
from report.manual.precision import floor
from report.pages.parts import verdict
from report.text.counts import numbered
from report.text.error_text import percent, scientific, seconds, ten_digits
from report.text.grouping import grouped_by
from report.text.names import ranged
from report.text.units import NO_BREAK, number
from report.text.validation import NOT_VALIDATED, VALIDATION
from solver.verification.building import BY_HEIGHT
from solver.verification.evidence import SECOND, WORST, Verification, Verified
from solver.verification.features import FeatureStatus, statuses
from solver.verification.workprecision import TIME


def judged(is_passed: bool) -> Markup:
    """Return PASS, or FAIL highlighted."""
    return verdict(is_passed, ("PASS", "FAIL"))


def passed(verification: Verification) -> str:
    """Return how many checks of all passed."""
    return f"{sum(row.passed for row in verification.checks)} of {len(verification.checks)}"


def outcome(verification: Verification) -> Markup:
    """Return whether all checks passed, how many did, and how many were left out."""
    # Without checks none failed, which is no pass.
    verdict = judged(verification.passed and len(verification.checks) > 0)
    left_out = numbered(len(verification.left_out), "check")
    without = f" {left_out} left out: SciPy is not installed." if verification.left_out else ""
    return Markup("{} {} checks passed.{}").format(verdict, passed(verification), without)


def summary(verification: Verification) -> Section:
    """Return verdict, key results and checks by section."""
    return section(
        "manual/summary",
        "Summary",
        outcome=outcome(verification),
        results=headed(
            ("Quantity", 2.6), ("Result", 2.9), ("Section", 0.7), rows=_results(verification)
        ),
        sections=listed(_by_section(verification).items(), _SECTION_COLUMNS),
        failed=[row for row in verification.checks if not row.passed],
    )


def _by_section(verification: Verification) -> Mapping[str, Sequence[Verified]]:
    return grouped_by(verification.checks, lambda row: row.section)


def _results(verification: Verification) -> Iterator[tuple[str, str, int]]:
    """Yield each result, its value, and the section with details."""
    work, maps, links = verification.work, verification.maps, verification.links
    checked = statuses(verification.checks)
    # P = 64 sub-steps in each sampling interval, for which the paper states its errors.
    paper = work[(work["method"] == "paper") & (work["setting"] == 64)]
    exact = work[work["method"] == "exact"]
    # Of the same record and case.
    compared = paper.merge(exact, on=["record", "case"])
    # The median of ratios, not the ratio of medians: a case that slides long takes longer by
    # either.
    times_longer = (compared[f"{TIME}_x"] / compared[f"{TIME}_y"]).median()
    largest = scientific(floor(verification))
    yield "Largest relative error of the exact method against 50-digit arithmetic", largest, 3
    if not math.isnan(exact_s := exact[TIME].median()):
        yield "Median time per run of the exact method", seconds(exact_s), 5
    if not math.isnan(times_longer):
        up_to = f"errors in PRD up to {percent(paper['PRD error [%]'].max())}"
        result = f"{number(times_longer, 0)} times the run time (median), {up_to}"
        yield "The paper's method with 64 sub-steps, same analysis cases", result, 5
    yield "Failed runs, all methods", f"{work[TIME].isna().sum()} of {len(work)}", 5
    failed, cells = (sum(count(sweep.failed) for sweep in maps) for count in (np.sum, np.size))
    yield "Failed cells of the stability maps, other methods", f"{failed} of {cells}", 6
    if links:
        worst = max(links, key=lambda link: link.worst_percent)
        mean = percent(float(np.mean([link.mean_percent for link in links])))
        yield (
            "Difference in RRD from the link of the paper's SAP 2000 model",
            f"{percent(worst.worst_percent)} largest ({paper_sections.worst_mm(worst):.2g}"
            f"{NO_BREAK}mm), {mean} mean; the paper reports {PAPER_WORST_PERCENT}% and "
            f"{PAPER_MEAN_PERCENT}%",
            8,
        )
    runs = sum(study.runs for study in verification.curves)
    took = seconds(sum(study.seconds for study in verification.curves))
    yield "The paper's parametric study", f"{runs:,} runs in {took}", 9
    # The model building, which is first, has no recorded roof: it checks the algebra, not the
    # model.
    for roof in [roof for roof in verification.roofs if roof.is_recorded][:1]:
        best = roof.predictions[0]
        by_height = (fit for fit in roof.predictions if fit.name == BY_HEIGHT)
        stated = [f"; {fit.name}: PRD {span(fit, roof)} times" for fit in by_height]
        yield (
            "Roof motion of a recorded building, computed from its ground motion",
            f"{best.name}: PRD {span(best, roof)} times that of the recorded roof motion, "
            f"{number(100.0 * best.unexplained, 0)}% of the motion unexplained{''.join(stated)}",
            11,
        )
    for evidence in verification.models:
        second, worst_heading = (evidence.study.named(name) for name in (SECOND, WORST))
        if second.ratios.size and worst_heading.ratios.size:
            yield (
                "PRD in two axes relative to one axis, median",
                f"{number(second.median, 2)} times (10 to 90% of the runs: {middle(second)}); "
                f"{number(worst_heading.median, 2)} times for the worst heading",
                12,
            )
    yield "Validation", NOT_VALIDATED, 13
    n_verified = sum(status.is_verified for status in checked)
    yield "Features verified by checks of this run", f"{n_verified} of {len(checked)}", 13
    extent = "quick: fewer records, cases and settings" if verification.quick else "full"
    total = f"{number(verification.seconds, 0)}{NO_BREAK}s in total"
    yield "Extent of this verification", f"{extent}; {total}", 2


_SECTION_COLUMNS = (
    (words("Section", 3.0), lambda row: row[0]),
    (text("Checks"), lambda row: len(row[1])),
    (text("Passed"), lambda row: sum(check.passed for check in row[1])),
    (text("Largest error", share=1.4), lambda row: scientific(max(of.error for of in row[1]))),
    (text("Tolerance used", share=1.4), lambda row: _used(row[1])),
    (centered("Result"), lambda row: judged(all(check.passed for check in row[1]))),
)


def _used(rows: Sequence[Verified]) -> str:
    # A tolerance of 0 is met or not: there is no share of it.
    shares = [row.error / row.tolerance for row in rows if row.tolerance > 0.0]
    return f"{100.0 * max(shares):.2g}%" if shares else "—"


_CHECK_COLUMNS = (
    (words("Problem", 3.15), lambda row: row.problem),
    (words("Quantity", 1.95), lambda row: _quantity(row)),
    (text("Expected", share=1.55), lambda row: ten_digits(row.expected)),
    (text("Computed", share=1.55), lambda row: ten_digits(row.computed)),
    (text("Error", share=1.1), lambda row: scientific(row.error)),
    (text("Tolerance", share=1.1), lambda row: scientific(row.tolerance)),
    (centered("Result", 0.7), lambda row: judged(row.passed)),
)


def checks(verification: Verification) -> Section:
    """Return every check, a table for each section."""

    def source(row: Verified) -> str:
        return f"{row.id}. Source: {row.source}"

    return section(
        "manual/checks",
        "Checks",
        by_section=[
            (name, grouped(grouped_by(rows, source), _CHECK_COLUMNS))
            for name, rows in _by_section(verification).items()
        ],
    )


def _quantity(row: Verified) -> str:
    return row.quantity if row.unit == "1" else f"{row.quantity} [{row.unit}]"


_FEATURE_COLUMNS = (
    (words("Feature", 2.9), lambda status: status.feature.name),
    (words("Checks (section 3)", 1.9), lambda status: ranged(status.ids) or "—"),
    (
        text("Passed", share=0.9),
        lambda status: f"{status.n_passed} of {status.n_checks}" if status.n_checks else "—",
    ),
    (words("Status", 1.8), lambda status: _status(status)),
    (words("Limits of the checks", 3.2), lambda status: _limits(status)),
)


def features(verification: Verification) -> Section:
    """Return the status of every feature, and what is not validated."""
    return section(
        "manual/features",
        "Status of each feature",
        validation=VALIDATION,
        features=listed(statuses(verification.checks), _FEATURE_COLUMNS, kind="compact"),
    )


def _status(status: FeatureStatus) -> str:
    if status.n_passed < status.n_checks:
        return judged(False)
    return "verified" if status.is_verified else "not verified"


def _limits(status: FeatureStatus) -> str:
    missing = f"Did not run: {', '.join(status.missing)}" if status.missing else ""
    return "; ".join(filter(None, (status.feature.only, missing)))
