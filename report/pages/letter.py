"""The letter of results, one page for the client: what its template needs beside the package."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.overrides import LOWERING
from report.pages.parts import PackageData
from report.pages.review import review


def letter(package: PackageData) -> Mapping[str, object]:
    """Return what requires less than the rule set, and what peer review permits."""
    return {
        "lowered": [row for row in package.assessment.rows if row.id in LOWERING],
        "review": review(package),
    }
