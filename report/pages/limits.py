"""Limits, requirements and interconnection strength, and what of them the summary says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.precheck import findings
from report.assessment.verdict import STRENGTH_ROW, as_one
from report.document.tables import Table, listed, table_of
from report.entities.array import array_results
from report.entities.marks import dagger
from report.entities.requirement import requirement_rows
from report.entities.shown import centered, text, words
from report.pages.links import link_troubles
from report.pages.model import model_troubles
from report.pages.parts import NG, OK, PackageData, verdict
from report.pages.symbols import with_symbols
from report.sheet.checking.findings import lines
from report.sheet.schema.fields import Level
from report.words.counts import grouped_by, ranged
from solver.rules.limit import Consequence, Limit
from solver.rules.provisions import Basis

EXCEPTED = "permitted*"
"""Verdict on a value beyond a limit that the rule set permits to be exceeded."""


def analysis_faults(package: PackageData, array: ArrayAssessment) -> Sequence[str]:
    """Return why the analysis route of an array is not permitted, in a few words each."""
    few = ["too few motions"] if array.analysis.basis is Basis.TOO_FEW else []
    return [
        *(check.title for check in array.analysis_checks if not check.ok),
        *_motion_faults(package),
        *few,
    ]


def _motion_faults(package: PackageData) -> Sequence[str]:
    missed = package.assessment.acceptance.missed
    return [row.title for row in missed if row.consequence is Consequence.NG]


def troubles(package: PackageData) -> Mapping[str, Sequence[object]]:
    """Return everything that prevents an OK, except clearances, by kind; nothing if all is OK."""
    arrays, is_refused = package.assessment.arrays, bool(_motion_faults(package))
    found: Mapping[str, Sequence[object]] = {
        "warnings": package.assessment.warnings,
        "few": [array for array in arrays if array.lacks_motions],
        "refused": [array for array in arrays if is_refused and array.route is Route.ANALYSIS],
        "models": tuple(model_troubles(package)),
        "tipping": [array for array in arrays if not array.tipping.is_ok],
        "links": tuple(link_troubles(package)),
        "limits": [(place, check) for place, check in package.checks if not check.ok],
    }
    return found if any(found.values()) else {}


def _requirements(package: PackageData) -> Table:
    """Return the requirements beside the numeric limits, those that ask the same as one."""
    others = (row for row in package.assessment.rows if row.id != STRENGTH_ROW)
    alike = grouped_by(others, lambda row: (*row.asked, row.basis, row.verdict))
    each = (
        as_one(rows).model_copy(update={"subject": ranged(row.subject for row in rows)})
        for rows in alike.values()
    )
    rows = [
        row.model_copy(
            update={name: with_symbols(getattr(row, name)) for name in ("title", "found", "limit")}
        )
        for row in requirement_rows(each)
    ]
    return table_of(rows, "subject title found limit basis verdict", package.fmt, kind="compact")


def check_table(
    package: PackageData,
    checks: Sequence[tuple[str, Limit]],
    outcomes: tuple[str, str] = (OK, NG),
) -> Table:
    """Return limits and values of the project; `outcomes` are satisfied and not satisfied."""

    def limit(check: Limit) -> str:
        return package.of_check(check.limit, check) + dagger(check.provision)

    columns = (
        (words("Item", 0.9), lambda row: row[0]),
        (words("Quantity", 3.9), lambda row: row[1].title),
        (text("Value", share=1.45), lambda row: package.of_check(row[1].found, row[1])),
        (centered("", 0.3), lambda row: ">" if row[1].passes_by_exception else row[1].sign),
        (text("Limit", share=1.6), lambda row: limit(row[1])),
        (words("Clause", 2.1), lambda row: row[1].provision.clause + dagger(row[1].provision)),
        (
            centered("Verdict", 1.3),
            lambda row: verdict(
                row[1].ok, (EXCEPTED, NG) if row[1].passes_by_exception else outcomes
            ),
        ),
    )
    return listed(checks, columns, package.fmt, kind="compact")


def limits(package: PackageData) -> Mapping[str, object]:
    """Return the part on limits and interconnection strength."""
    excepted = [check for _, check in package.checks if check.passes_by_exception]
    return {
        "checks": check_table(package, package.checks),
        "excepted": excepted[:1],
        "routes": package.routes,
        "arrays": tuple(array_results(package)),
        "requirements": _requirements(package),
        "warnings": list(_warnings(package)),
    }


def _warnings(package: PackageData) -> Iterator[Sequence[str]]:
    """Yield cells, text and reason of each warning on the input.

    A contradiction of the plan is also among the requirements.
    """
    sheet = package.assessment.sheet
    found = findings(sheet, package.assessment.shaking)
    warnings = [finding for finding in found if finding.level is Level.WARNING]
    for line in lines(warnings, sheet.addresses):
        yield line.cells, f"{line.finding.text}.", line.finding.reason or "not acknowledged"
