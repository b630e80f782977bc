"""The summary of the manual: verdict, key results, checks by section."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from markupsafe import Markup

from report.document.sections import Section, section
from report.manual import studies
from report.manual.precision import floor
from report.pages.parts import verdict
from report.words.counts import grouped_by
from solver.verification.building import BY_HEIGHT
from solver.verification.evidence import Check, Verification

_TIME = "time per run [s]"


def judged(is_passed: bool) -> Markup:
    """Return PASS, or FAIL highlighted."""
    return verdict(is_passed, ("PASS", "FAIL"))


def summary(verification: Verification) -> Section:
    """Return verdict, key results and checks by section."""
    work, maps, links = verification.work, verification.maps, verification.links
    paper = work[(work["method"] == "paper") & (work["setting"] == 64)]
    # Of the same record and case.
    beside = paper.merge(work[work["method"] == "exact"], on=["record", "case"])
    worst = max(links, key=lambda link: link.worst_percent) if links else None
    return section(
        "manual/summary",
        "Summary",
        floor=floor(verification),
        exact_s=work.loc[work["method"] == "exact", _TIME].median(),
        times_longer=(beside[f"{_TIME}_x"] / beside[f"{_TIME}_y"]).median(),
        paper_percent=paper["PRD error [%]"].max(),
        failed_runs=work[_TIME].isna().sum(),
        failed_cells=sum(int(sweep.failed.sum()) for sweep in maps),
        cells=sum(sweep.failed.size for sweep in maps),
        worst=worst,
        worst_mm=studies.worst_mm(worst) if worst else math.nan,
        links_percent=float(np.mean([link.mean_percent for link in links] or [math.nan])),
        PAPER_WORST_PERCENT=studies.PAPER_WORST_PERCENT,
        PAPER_MEAN_PERCENT=studies.PAPER_MEAN_PERCENT,
        BY_HEIGHT=BY_HEIGHT,
        by_section=grouped_by(verification.checks, lambda row: row.section),
        used=_used,
    )


def _used(rows: Sequence[Check]) -> str:
    shares = [row.error / row.tolerance for row in rows if row.tolerance > 0.0]
    return f"{100.0 * max(shares):.2g} %" if shares else "—"
