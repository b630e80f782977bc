"""The result files beside the package. Read `tables`, then `json` and `xlsx`."""

from __future__ import annotations

from report.assessment.evidence import Evidence
from report.assessment.project import Assessment
from report.results.json import results_json


def tables(assessment: Assessment, evidence: Evidence) -> dict[str, bytes]:
    """Return results.xlsx and results.json, by file name."""
    # Imported here: pandas takes longer to load than the tables to write, and the process that
    # only asks for them does without it.
    from report.results.xlsx import results_xlsx

    return {
        "results.xlsx": results_xlsx(assessment, evidence.spectra),
        "results.json": results_json(assessment, evidence),
    }
