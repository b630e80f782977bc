"""What the letter, the summary, the roof plan and the basis need beside the package.

Computes nothing. Read `report.pages.parts` first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from report.assessment.arrays import Route
from report.assessment.evidence import Evidence
from report.assessment.friction import mus_words
from report.assessment.friction_rows import tested
from report.assessment.overrides import LOWERING
from report.assessment.plan_gaps import plan_gaps
from report.assessment.runs import nan_is_worst
from report.assessment.spectra import departures
from report.assessment.verdict import Verdict
from report.drawing.schedule import alike_arrays
from report.drawing.sheet import unit_format
from report.entities.clearance import ClearanceResult
from report.pages.limits import troubles
from report.pages.parts import PackageData, statistic
from report.pages.remedies import answers
from report.words.validation import explained
from solver.verification.shake_table import SHIPPED

N_WORST = 3
"""Clearances of the summary, where all are OK; the complete schedule stands in their part."""


def _review(package: PackageData) -> Mapping[str, object]:
    """Return the arrays that peer review concerns: by analysis, and on roofs over a slope limit."""
    arrays = package.assessment.arrays
    excepted = {
        item.id: check for item in arrays for check in item.limits if check.passes_by_exception
    }
    return {
        "by_analysis": [item.id for item in arrays if item.route is Route.ANALYSIS],
        "steeper": list(excepted),
        "slope_limit": next(iter(excepted.values()), None),
    }


def letter(package: PackageData) -> Mapping[str, object]:
    """Return what requires less than the rule set, and what peer review permits."""
    return {
        "lowered": [row for row in package.assessment.rows if row.id in LOWERING],
        "review": _review(package),
    }


def summary(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the summary page needs beside the package."""
    found = departures(evidence.spectra)
    last = {departure.is_short: departure for departure in found}.values()
    return {
        "statistic": statistic(package.governing.analysis.basis),
        "worst": _worst(package.clearances),
        "gap": package.assessment.governing_gap(),
        "review": _review(package),
        # What follows from a missed target is said once, with the last.
        "missed": [(departure, departure in last) for departure in found],
        "troubles": troubles(package),
        "answers": answers(package, evidence.remedies),
    }


def _worst(clearances: Sequence[ClearanceResult]) -> Sequence[ClearanceResult]:
    """Return the clearances with the largest D/C: three, or all that are not OK."""
    ordered = sorted(clearances, key=lambda gap: -nan_is_worst(gap.demand_capacity))
    return ordered[: max(N_WORST, sum(gap.verdict != Verdict.OK for gap in clearances))]


def plan(package: PackageData) -> Mapping[str, object]:
    """Return what the tables and notes of the roof plan need beside its drawings."""
    fmt = replace(unit_format(package.assessment), systems=1)
    return {
        "fmt": fmt,
        "arrays": alike_arrays(package.assessment, fmt),
        "friction": mus_words(package.data.arrays),
        "drawn": list(plan_gaps(package.assessment)),
    }


def basis(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    return {
        "motions": [run.motion for run in package.governing.motions],
        "is_tested": bool(tested(package.data)),
        "certainty": evidence.uncertainty,
        "failed": troubles(package),
        "validation": explained(SHIPPED),
    }
