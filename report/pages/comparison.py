"""The comparison with the prescriptive displacement: chart, limits of the route, other inputs."""

from __future__ import annotations

from collections.abc import Mapping

from report.assessment.cases import cases
from report.assessment.evidence import Evidence
from report.pages.limits import analysis_faults, check_table
from report.pages.parts import PackageData


def comparison(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the comparison needs beside the arrays."""
    arrays = package.assessment.arrays
    checks = [(item.id, check) for item in arrays for check in item.prescriptive_checks]
    return {
        "cases": list(cases(package.assessment, evidence)),
        "faults": {item.id: analysis_faults(package, item) for item in arrays},
        "routes": check_table(package, checks, ("satisfied", "not satisfied")),
    }
