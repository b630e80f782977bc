"""The sections of the verification manual that show its checks: the summary and all tables."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from report.document.columns import centered, text, words
from report.document.sections import Section, section
from report.document.tables import grouped
from report.manual import paper_sections
from report.manual.precision import floor
from report.pages.parts import verdict
from report.text.error_text import scientific, ten_digits
from report.text.formula_text import lettered, unbroken
from report.text.grouping import grouped_by
from solver.verification.building import BY_HEIGHT
from solver.verification.evidence import Verification, Verified
from solver.verification.workprecision import TIME


def judged(is_passed: bool) -> Markup:
    """Return PASS, or FAIL highlighted."""
    return verdict(is_passed, ("PASS", "FAIL"))


def summary(verification: Verification) -> Section:
    """Return verdict, key results and checks by section."""
    work, maps, links = verification.work, verification.maps, verification.links
    paper = work[(work["method"] == "paper") & (work["setting"] == 64)]
    # Of the same record and case.
    compared = paper.merge(work[work["method"] == "exact"], on=["record", "case"])
    worst = max(links, key=lambda link: link.worst_percent) if links else None
    return section(
        "manual/summary",
        "Summary",
        floor=floor(verification),
        exact_s=work.loc[work["method"] == "exact", TIME].median(),
        times_longer=(compared[f"{TIME}_x"] / compared[f"{TIME}_y"]).median(),
        paper_percent=paper["PRD error [%]"].max(),
        failed_runs=work[TIME].isna().sum(),
        failed_cells=sum(int(sweep.failed.sum()) for sweep in maps),
        cells=sum(sweep.failed.size for sweep in maps),
        worst=worst,
        worst_mm=paper_sections.worst_mm(worst) if worst else math.nan,
        links_percent=float(np.mean([link.mean_percent for link in links] or [math.nan])),
        PAPER_WORST_PERCENT=paper_sections.PAPER_WORST_PERCENT,
        PAPER_MEAN_PERCENT=paper_sections.PAPER_MEAN_PERCENT,
        BY_HEIGHT=BY_HEIGHT,
        by_section=grouped_by(verification.checks, lambda row: row.section),
        used=_used,
    )


def _used(rows: Sequence[Verified]) -> str:
    # A tolerance of 0 is met or not: there is no share of it.
    shares = [row.error / row.tolerance for row in rows if row.tolerance > 0.0]
    return f"{100.0 * max(shares):.2g}%" if shares else "—"


_CHECK_COLUMNS = (
    (words("Problem", 3.15), lambda row: unbroken(lettered(row.problem))),
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
        return f"{row.id}. Source: {lettered(row.source)}"

    return section(
        "manual/checks",
        "Checks",
        by_section={
            name: grouped(grouped_by(rows, source), _CHECK_COLUMNS)
            for name, rows in grouped_by(verification.checks, lambda row: row.section).items()
        },
    )


def _quantity(row: Verified) -> str:
    return row.quantity if row.unit == "1" else f"{row.quantity} [{lettered(row.unit)}]"
