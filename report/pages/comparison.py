"""The comparison with the prescriptive displacement: chart, limits of the route, other inputs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from report.assessment.arrays import ArrayAssessment
from report.assessment.cases import cases
from report.assessment.evidence import Evidence
from report.pages.limits import analysis_faults, check_table
from report.pages.parts import PackageData
from report.sheet.schema import SECTION
from report.sheet.schema.years import StudyYears, YearsOfArray


def comparison(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the comparison needs beside the arrays."""
    arrays = package.assessment.arrays
    checks = [(item.id, check) for item in arrays for check in item.prescriptive_checks]
    return {
        "cases": list(cases(package.assessment, evidence)),
        "faults": {item.id: analysis_faults(package, item) for item in arrays},
        "years": list(_years(package)),
        "routes": check_table(package, checks, ("satisfied", "not satisfied")),
    }


def _years(package: PackageData) -> Iterator[Mapping[str, object]]:
    """Yield the study of years with its file, and the arrays of both; nothing without one."""
    sheet = package.assessment.sheet
    label = SECTION["options"].entry("study_years").cell.label
    by_id = {array.id.casefold(): array for array in package.assessment.arrays}
    for document in sheet.documents:
        if document.label != label:
            continue
        study = StudyYears.model_validate_json(sheet.book.files[document.sha256])
        shared = [
            (by_id[one.array.casefold()], one)
            for one in study.arrays
            if one.array.casefold() in by_id
        ]
        yield {
            "study": study,
            "document": document,
            "arrays": shared,
            "unlike": [array.id for array, one in shared if _is_unlike(array, one)],
        }


def _is_unlike(array: ArrayAssessment, one: YearsOfArray) -> bool:
    """Whether an array has another friction coefficient or slope in the study, as printed."""
    slope_deg = math.degrees(array.array.slope_rad)
    return abs(array.array.mu - one.mu) >= 5e-4 or abs(slope_deg - one.slope_deg) >= 5e-3
