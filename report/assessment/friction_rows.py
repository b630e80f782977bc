"""The friction tests of a project: their means, and the rows that a plan checker looks for.

Each row that is not satisfied is a condition, not NG. Read `solver.friction_tests` first.
"""

from __future__ import annotations

import re

from report.assessment.verdict import Row
from report.sheet.schema import ProjectInput
from solver.friction_tests import Series, Surface, series
from solver.records.acceptance_row import Consequence

LEAST_RUNS = 3
"""Runs in each condition, of which the kinetic coefficients are averaged (PV1-2012)."""

NOT_GIVEN = "not given"
_STANDARD = re.compile(r"\bASTM[\s-]*G[\s-]*115\b", re.IGNORECASE)


def tested(data: ProjectInput) -> tuple[Series, ...]:
    """Return the runs of a project by report and condition."""
    return series(row.run(data.friction_tests.report) for row in data.friction_runs)


def friction_rows(data: ProjectInput) -> tuple[Row, ...]:
    """Return the rows on the friction tests."""
    return _on_file(data), _standard(data), _wet_and_dry(data)


def _on_file(data: ProjectInput) -> Row:
    tests = data.friction_tests
    date = tests.date.isoformat() if tests.date else ""
    stated = (("laboratory", tests.laboratory), ("report number", tests.report), ("date", date))
    missing = [name for name, value in stated if not value]
    given = [value for _, value in stated if value]
    if missing and given:
        given.append(f"{', '.join(missing)} {NOT_GIVEN}")
    return _row(
        title="Friction test report on file",
        found="; ".join(given) or NOT_GIVEN,
        limit="laboratory, report number, date",
        is_satisfied=not missing,
        remedy="Obtain the friction test report and complete the sheet Friction tests.",
    )


def _standard(data: ProjectInput) -> Row:
    tests = data.friction_tests
    by_standard = bool(_STANDARD.search(tests.standard))
    standard = f"standard {tests.standard or NOT_GIVEN}"
    accreditation = f"accreditation {tests.accreditation or NOT_GIVEN}"
    return _row(
        title="Tested to ASTM G115",
        found=f"{standard}; {accreditation}",
        limit="ASTM G115, accredited laboratory",
        is_satisfied=by_standard and bool(tests.accreditation),
        remedy="Obtain tests to ASTM G115 by an accredited laboratory, and state both on the sheet "
        "Friction tests.",
    )


def _wet_and_dry(data: ProjectInput) -> Row:
    counts = {(one.report, one.surface): len(one.runs) for one in tested(data)}
    reports = dict.fromkeys(report for report, _ in counts)
    found = [
        (f"report {report or 'without a number'}: " if len(reports) > 1 else "")
        + ", ".join(
            f"{surface} {runs_text(counts.get((report, surface), 0))}" for surface in Surface
        )
        for report in reports
    ]
    return _row(
        title="Wet and dry, three runs each",
        found="; ".join(found) or "no runs",
        limit=f"{LEAST_RUNS} runs or more in each condition",
        is_satisfied=bool(reports)
        and all(counts.get((r, s), 0) >= LEAST_RUNS for r in reports for s in Surface),
        remedy="Obtain the runs that are missing, and enter them on the sheet Friction tests.",
    )


def _row(*, title: str, found: str, limit: str, is_satisfied: bool, remedy: str) -> Row:
    return Row(
        id="friction_tests",
        title=title,
        found=found,
        limit=limit,
        basis="friction tests",
        is_satisfied=is_satisfied,
        consequence=Consequence.CONDITION,
        remedy=remedy,
    )


def runs_text(count: int) -> str:
    """Return a number of runs in words, such as `3 runs`."""
    return "1 run" if count == 1 else f"{count} runs"
