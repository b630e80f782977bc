"""What the letter, the summary and the basis need beside the package.

Computes nothing. Read `report.pages.parts` first.

The head of the first sheet: project, codes and revisions. Read `cover`.

What changed since a former revision, and the bars beside changed rows.

The comparison with the prescriptive displacement: chart, limits of the route, other inputs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.assessment import Assessment
from report.assessment.checks.alike import alike
from report.assessment.checks.ids import LOWERING, VELOCITY_ROW
from report.assessment.checks.rule_limits import building_limits, of_limit
from report.assessment.checks.sentence import sentence, words
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import Route
from report.assessment.remedies.remedies import Remedies
from report.assessment.revision_changes import ChangeKind, Changes
from report.assessment.support.evidence import Evidence
from report.pages.array_tables import comparison_table, letter_table, summary_table
from report.pages.checks import (
    FirstSheet,
    condition_table,
    first_sheet,
    governing_table,
    verdict_sentence,
)
from report.pages.parts import PackageData, statistic
from report.pages.symbols import friction_standard
from report.project.model.issue import Revision
from report.project.read.study_years import StudyYears, YearsOfArray
from report.project.workbook import SECTION
from report.text.counts import capitalized, ids_by, numbered
from report.text.formats import VALIDATION
from report.text.units import number


def _review(package: PackageData) -> Mapping[str, object]:
    """Return the arrays that peer review concerns, and what it lets exceed a limit."""
    done = package.assessment
    excepted = alike(check for check in done.checks if check.is_excepted)
    return {
        "by_analysis": [item.id for item in done.arrays if item.route is Route.ANALYSIS],
        "excepted": [sentence(check, done.project.us_first) for check in excepted],
    }


def letter(package: PackageData) -> Mapping[str, object]:
    """Return what requires less than the rule set, and what peer review permits."""
    return {
        "verdict": verdict_sentence(package.assessment, f"in {package.part('summary')}"),
        "arrays": letter_table(package),
        # What asks for less than the rule set stands in the letter, too.
        "lowered": [row for row in package.assessment.checks if row.id in LOWERING],
        "review": _review(package),
    }


def summary(
    package: PackageData, evidence: Evidence, sheet: FirstSheet | None = None
) -> Mapping[str, object]:
    """Return what decides: verdict, arrays, the checks that govern and the conditions.

    `sheet` are the checks for which the first sheet has room; without it all of them.
    """
    done, numbers = package.assessment, package.numbers
    sheet = sheet or first_sheet(done)
    notes = alike(check for check in done.checks if check.is_note and not check.is_satisfied)
    return {
        "verdict": verdict_sentence(done),
        "statistic": statistic(package.governing.analysis.basis),
        "arrays": summary_table(package),
        "prescriptive_clause": done.rules.values[package.prescriptive_key(done.governing)].clause,
        "review": _review(package),
        "n_checks": len(done.checks),
        "sheet": sheet,
        "governing": governing_table(sheet, done, numbers),
        "conditions": condition_table(sheet, done, numbers),
        "remedy": _enough(done, evidence.remedies),
        "effects": list(_what_if(package, evidence)),
        "notes": [check.title for check in notes],
    }


def _enough(done: Assessment, found: Remedies) -> str:
    """Return what is enough for a project that is NG, in a sentence; or that nothing found is."""
    if found.own and not found.together:
        return "No set of the changes that were tried is enough."
    return found.sentence


def _what_if(package: PackageData, evidence: Evidence) -> Iterator[str]:
    """Yield what another input comes to; of a condition its own row says it."""
    done = package.assessment
    # Of a rule set that the jurisdiction accepts no row says it.
    says = {check.id for check in done.checks if check.is_open} & {"rule_set", "edition_name"}
    if "rule_set" in done.otherwise and not says:
        yield done.otherwise["rule_set"]
    for case in evidence.cases:
        is_slow = done.low_velocity.of(case.array.id) is case.array
        if not (is_slow and VELOCITY_ROW in done.otherwise):
            yield case.words(package.fmt.us_first)


def basis(package: PackageData) -> Mapping[str, object]:
    """Return what the page on basis and limits needs beside the package."""
    return {
        "motions": [run.motion for run in package.governing.motions],
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
    done = package.assessment
    return {
        "arrays": comparison_table(package),
        "prescriptive_clause": package.clause(package.prescriptive_key(done.governing)),
        "cases": evidence.cases,
        "routes": ids_by(done.arrays, lambda item: _routes(package, item)),
        "years": list(_years(package)),
    }


def _routes(package: PackageData, item: ArrayAssessment) -> str:
    """Return why an array has its procedure, and whether the other would be permitted."""
    done, given_m, analysis = package.assessment, item.prescriptive.value_m, item.analysis
    building = building_limits(done.project, done.rules)
    limits = (*item.limits.prescriptive_checks, *item.limits.checks, *building)
    failed = [words(of_limit(limit)) for limit in limits if not limit.ok]
    if failed:
        other = f"the prescriptive procedure is not permitted: {_reasons(package, failed)}"
    elif analysis.value_m > given_m:
        other = (
            "the limits of the prescriptive procedure are satisfied, but the displacement by "
            "analysis exceeds its value"
        )
    else:
        other = f"the prescriptive displacement may be used instead ({package.part('limits')})"
    faults = _reasons(package, done.against_analysis(item))
    refused = f"the analysis procedure is not permitted: {faults}"
    parts: list[str] = []
    if item.route is Route.PRESCRIPTIVE:
        parts.append("the prescriptive procedure is taken")
        if analysis.largest_m > given_m:
            parts.append("the largest PRD exceeds the prescriptive displacement and is used")
        return _sentences([*parts, refused])
    if math.isnan(item.design_m):
        return _sentences(["no value from analysis", other])
    n_above = sum(run.governing.prd_m > given_m for run in item.motions)
    above = f"{n_above} of {len(item.motions)} PRDs"
    if analysis.value_m > given_m:
        parts.append(
            f"the displacement by analysis is {number(analysis.value_m / given_m, 2)} times the "
            f"prescriptive displacement ({above} exceed it) and governs"
        )
    elif n_above:
        parts.append(
            f"{above} exceed the prescriptive displacement, but the displacement by analysis does "
            "not"
        )
    if package.data.is_peer_reviewed:
        parts.append("no floor applies because the analysis is peer reviewed")
    if not item.is_permitted:
        parts.append(refused)
    return _sentences([*parts, other])


def _reasons(package: PackageData, limits: Sequence[str]) -> str:
    """Return the first two limits that do not permit a procedure, and where the others are."""
    count = len(limits) - 2
    more = [f"{numbered(count, 'more limit')} in {package.part('limits')}"] if count > 0 else []
    return "; ".join([*limits[:2], *more])


def _sentences(parts: Sequence[str]) -> str:
    """Return parts as sentences, the first after a colon and the last without its full stop."""
    return ". ".join([parts[0], *map(capitalized, parts[1:])])


def _years(package: PackageData) -> Iterator[Mapping[str, object]]:
    """Yield the study of years with its file, and the arrays of both; nothing without one."""
    sheet = package.assessment.sheet
    label = SECTION["options"].entry("study_years").heading
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
