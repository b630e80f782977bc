"""What the letter, the summary, the roof plan and the basis need beside the package.

Computes nothing. Read `report.pages.parts` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from report.assessment.arrays import Route
from report.assessment.cases import cases
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
        "other": _worst_other(package),
        "what_if": list(_what_if(package, evidence)),
        "troubles": troubles(package),
        "answers": answers(package, evidence.remedies),
    }


class _Ratio(NamedTuple):
    """Required / provided of a check beside the clearances."""

    ratio: float
    title: str
    array: str
    part: str  # id of the page that has it


def _worst_other(package: PackageData) -> _Ratio | None:
    """Return the largest ratio of the checks of the arrays beside their clearances, if any.

    Of an array without a permitted design displacement, that of its slack is not known.
    """
    known = (item for item in _ratios(package) if not math.isnan(item.ratio))
    return max(known, key=lambda item: item.ratio, default=None)


def _ratios(package: PackageData) -> Iterator[_Ratio]:
    for item in package.assessment.arrays:
        array = item.array
        if item.runs:
            yield _Ratio(item.tipping.ratio, "tipping", item.id, "model")
        if array.interconnection_n:
            strength = item.interconnection_n / array.interconnection_n
            yield _Ratio(strength, "interconnection strength", item.id, "limits")
        if array.slack_m:
            yield _Ratio(item.permitted_m / array.slack_m, "electrical slack", item.id, "limits")
        if array.roof_capacity_pa:
            weight = array.weight_pa / array.roof_capacity_pa
            yield _Ratio(weight, "weight per roof capacity", item.id, "limits")


def _what_if(package: PackageData, evidence: Evidence) -> Iterator[str]:
    """Yield what another input comes to, of the conditions and of the comparison, each once."""
    given, us_first = package.assessment, package.fmt.us_first
    of_rows = [row.outcome for row in given.conditions if row.outcome]
    of_cases = [case.words(us_first) for case in cases(given, evidence)]
    yield from dict.fromkeys((*of_rows, *of_cases))


def _worst(clearances: Sequence[ClearanceResult]) -> Sequence[ClearanceResult]:
    """Return the clearances with the largest D/C: three, or all that are not OK."""
    ordered = sorted(clearances, key=lambda gap: -nan_is_worst(gap.demand_capacity))
    return ordered[: max(N_WORST, sum(gap.verdict != Verdict.OK for gap in clearances))]


def plan(package: PackageData) -> Mapping[str, object]:
    """Return what the tables and notes of the roof plan need beside its drawings."""
    fmt = replace(unit_format(package.assessment), systems=1, none="none")
    return {
        "fmt": fmt,
        "arrays": alike_arrays(package.assessment, fmt),
        "friction": mus_words(package.data.arrays),
        "drawn": list(plan_gaps(package.assessment)),
    }


def basis(package: PackageData) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    return {
        "motions": [run.motion for run in package.governing.motions],
        "is_tested": bool(tested(package.data)),
        "validation": explained(SHIPPED),
    }
