"""The first sheet of the letter edition: project, verdict, arrays and conditions; the plan follows.

For a permit set: one to six arrays by the prescriptive displacement, on two sheets.
`report.project.check.faults` rejects projects that do not fit.
"""

from __future__ import annotations

from collections.abc import Mapping

from report.document.tables import stamp
from report.pages import cover
from report.pages.array_tables import permit_table
from report.pages.checks import open_table, verdict_sentence
from report.pages.marks import prescriptive_key
from report.pages.parts import PackageData, friction_report


def page(package: PackageData) -> Mapping[str, object]:
    """Return the head of the project, and what each array requires."""
    done, data = package.assessment, package.data
    return {
        **cover.page(package),
        "kind": "permit letter",
        "sheet": package.printed_plan.size.sheet,
        "verdict": stamp(done.verdict, done.verdict.value),
        "verdict_sentence": verdict_sentence(done),
        "data": data,
        "rules": done.rules,
        "prescriptive_clause": done.rules.values[prescriptive_key(done.governing)].clause,
        "clause": package.marks.clause("separation_fixed"),
        "arrays": permit_table(package),
        "report": friction_report(data.friction_tests),
        "fingerprint": package.fingerprint,
        "workbook": done.source.path.name,
        "open_checks": open_table(done) if done.open else None,
    }
