"""results.xlsx, for a process that only asks for it. Read `json` and `xlsx`."""

from __future__ import annotations

from collections.abc import Sequence

from report.assessment.project import Assessment
from report.assessment.spectra import Spectra


def results_table(assessment: Assessment, spectra: Sequence[Spectra]) -> bytes:
    """Return results.xlsx."""
    # Imported here: pandas takes longer to load than the table to write, and the process that
    # only asks for it does without it.
    from report.results.xlsx import results_xlsx

    return results_xlsx(assessment, spectra)
