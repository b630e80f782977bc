"""What the letter, the summary and the basis need beside the package.

Computes nothing. Read `report.pages.parts` first.

The head of the first sheet: project, codes and revisions. Read `cover`.

What changed since a former revision, and the bars beside changed rows.

The comparison with the prescriptive displacement: chart, limits of the route, other inputs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from report.assessment.arrays import ArrayAssessment
from report.assessment.evidence import Evidence
from report.assessment.project import ChangeKind, Changes
from report.assessment.requirement_rows import tested
from report.assessment.routes import Route
from report.assessment.spectra import departures
from report.assessment.verdict import LOWERING, Verdict, nan_is_worst
from report.entities.clearance import ClearanceResult
from report.pages.limits import analysis_faults, check_table, troubles
from report.pages.parts import PackageData, statistic
from report.pages.summary import remedy_lines
from report.pages.symbols import friction_standard
from report.sheet.reading.linked_files import StudyYears, YearsOfArray
from report.sheet.schema import SECTION
from report.sheet.schema.project import Revision
from report.text.formats import VALIDATION

# Clearances of the summary, where all are OK: the complete schedule stands in their part.
N_WORST = 3


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
        # What asks for less than the rule set stands in the letter, too.
        "lowered": [row for row in package.assessment.rows if row.id in LOWERING],
        "review": _review(package),
    }


def summary(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the summary page needs beside the package."""
    missed = departures(evidence.spectra)
    last = {departure.is_short: departure for departure in missed}.values()
    # Without a permitted design displacement, the ratio of the slack of an array is not known.
    ratios = [item for item in _ratios(package) if not math.isnan(item.ratio)]
    return {
        "statistic": statistic(package.governing.analysis.basis),
        "worst": _worst(package.clearances),
        "gap": package.assessment.governing_gap(),
        "review": _review(package),
        # What follows from a missed target is said once, with the last.
        "missed": [(departure, departure in last) for departure in missed],
        "other": max(ratios, key=lambda item: item.ratio, default=None),
        "what_if": list(_what_if(package, evidence)),
        "troubles": troubles(package),
        "remedies": list(remedy_lines(package.assessment, evidence.remedies)),
    }


class _Ratio(NamedTuple):
    """Required / provided of a check beside the clearances."""

    ratio: float
    title: str
    array: str
    part: str  # id of the page that has it


def _ratios(package: PackageData) -> Iterator[_Ratio]:
    for item in package.assessment.arrays:
        array = item.array
        # Without runs, tipping is by the most that friction transmits: no ratio of a run.
        if item.runs:
            yield _Ratio(item.tipping.ratio, "tipping", item.id, "model")
        # What is not given has a condition of its own, and no ratio.
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
    assessment, us_first = package.assessment, package.fmt.us_first
    of_rows = [row.outcome for row in assessment.rows if row.outcome]
    of_cases = [case.words(us_first) for case in evidence.cases]
    # A case of the comparison may repeat the outcome of a condition: the same words stand once.
    yield from dict.fromkeys((*of_rows, *of_cases))


def _worst(clearances: Sequence[ClearanceResult]) -> Sequence[ClearanceResult]:
    """Return the clearances with the largest D/C: three, or all that are not OK."""
    # A ratio that is not known, beside an array without a design displacement, comes first.
    ordered = sorted(clearances, key=lambda gap: -nan_is_worst(gap.demand_capacity))
    return ordered[: max(N_WORST, sum(gap.verdict != Verdict.OK for gap in clearances))]


def basis(package: PackageData) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    return {
        "motions": [run.motion for run in package.governing.motions],
        "is_tested": bool(tested(package.data)),
        "validation": VALIDATION,
    }


def cover(package: PackageData) -> Mapping[str, object]:
    """Return what the head needs beside the package."""
    return {
        "friction_standard": friction_standard(package),
        "revisions": list(_revisions(package)),
    }


def _revisions(package: PackageData) -> Iterator[Sequence[object]]:
    """Yield revision, date, description and author of each, or of the first issue."""
    project = package.data.project
    first = Revision(
        revision=project.revision,
        date=project.date,
        description="First issue",
        by=project.prepared_by,
    )
    # A title block has a first line even where the sheet Revisions is empty.
    for row in package.data.revisions or [first]:
        yield row.revision, row.date, row.description, row.by or "—"


def counted(changes: Changes) -> str:
    """Return the number of changes by kind, as a clause."""
    total = len(changes.items)
    if not total:
        return "no change in inputs, records, results or verdicts"
    counts = ((kind, changes.count(kind)) for kind in ChangeKind)
    parts = [f"{kind.value} {count}" for kind, count in counts if count]
    return f"{total} change{'s' if total > 1 else ''} ({', '.join(parts)})"


def page(package: PackageData) -> Mapping[str, object]:
    """Return the changes as rows of a table."""
    items = package.changes.items
    return {
        "counted": counted(package.changes),
        "rows": [(item.kind.value, item.title, item.cell, item.before, item.now) for item in items],
    }


def comparison(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the comparison needs beside the arrays."""
    arrays = package.assessment.arrays
    checks = [(item.id, check) for item in arrays for check in item.prescriptive_checks]
    return {
        "cases": evidence.cases,
        "faults": {item.id: analysis_faults(package, item) for item in arrays},
        "years": list(_years(package)),
        "routes": check_table(package, checks, ("satisfied", "not satisfied")),
    }


def _years(package: PackageData) -> Iterator[Mapping[str, object]]:
    """Yield the study of years with its file, and the arrays of both; nothing without one."""
    sheet = package.assessment.sheet
    label = SECTION["options"].entry("study_years").cell.label
    # Ids are the same in any case, as in the workbook.
    by_id = {array.id.casefold(): array for array in package.assessment.arrays}
    for document in sheet.documents:
        if document.label != label:
            continue
        study = StudyYears.model_validate_json(sheet.book.files[document.sha256])
        shared = [
            (by_id[array_years.array.casefold()], array_years)
            for array_years in study.arrays
            if array_years.array.casefold() in by_id
        ]
        yield {
            "study": study,
            "document": document,
            "arrays": shared,
            # The study may be of a former revision: its years are shown, and the arrays that differ
            # named.
            "unlike": [array.id for array, array_years in shared if _is_unlike(array, array_years)],
        }


def _is_unlike(array: ArrayAssessment, array_years: YearsOfArray) -> bool:
    """Whether an array has another friction coefficient or slope in the study."""
    # As printed, with three decimals and two.
    slope_deg = math.degrees(array.array.slope_rad)
    return (
        abs(array.array.mu - array_years.mu) >= 5e-4
        or abs(slope_deg - array_years.slope_deg) >= 5e-3
    )
