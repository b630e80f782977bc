"""results.xlsx: the tables, and live formulas from the peaks to the separations.

Computes nothing: each formula is written with the value from `report.assessment`, and that
value is repeated beside it as a number, so that a checker can trace, change and compare it.
"""

from __future__ import annotations

import io
from collections.abc import Sequence

from report.assessment.assessment import Assessment
from report.assessment.support.response_spectra import Spectra
from report.provenance.package_sources import fingerprint
from report.results.clearances_sheet import result_cells, write_clearances
from report.results.design_sheet import DESIGN, write_design, write_inputs, write_peaks
from report.results.linked_sheets import link_cells, write_link_runs, write_links
from report.results.list_sheets import write_lists, write_requirements
from report.results.sheet_columns import Cells
from report.results.sheet_pages import TOP, Pages, text_workbook
from report.results.summary_sheet import write_summary
from report.text.names import shortened

# The sheets in the order of the package.
_ORDER = (
    "Summary", "Design", "Clearances", "Adjacent items", "Requirements", "Inputs", "Motions",
    "Records", "Spectra", "Peaks", "Runs", "Links", "LinkRuns",
)  # fmt: skip

# The sheets that a workbook without motions has not.
OF_MOTIONS = {"Motions", "Records", "Spectra", "Peaks", "Runs"}


def results_xlsx(assessment: Assessment, spectra: Sequence[Spectra]) -> bytes:
    """Return the tables as a workbook, with live formulas from the peaks to the separations."""
    buffer = io.BytesIO()
    absent = set() if assessment.linked else {"Links", "LinkRuns"}
    absent |= set() if assessment.neighbors else {"Adjacent items"}
    absent |= set() if assessment.has_motions else OF_MOTIONS
    project = assessment.project.project
    revision = (
        f"revision {project.revision}, hash {fingerprint(assessment.source, assessment.shaking)}"
    )
    title = f"{project.number} {project.name}, {revision}"
    with text_workbook(buffer, project.date, title) as workbook:
        head = f"{shortened(project.number, 24)}   {shortened(project.name, 60)}   {revision}"
        # An ampersand begins a code in the header of a page.
        head = head.replace("&", "&&")
        pages = Pages(workbook, head, is_a4=not assessment.project.us_first)
        for name in _ORDER:
            # All before any is written: xlsxwriter keeps them in the order in which they were
            # added.
            if name not in absent:
                workbook.add_worksheet(name)
        write_lists(pages, assessment, spectra)
        _write_live(pages, assessment)
    return buffer.getvalue()


def _write_live(pages: Pages, assessment: Assessment) -> None:
    """Write the sheets with formulas, and the runs of rows of linked blocks."""
    peaks = write_peaks(pages, assessment) if assessment.has_motions else {}
    inputs = write_inputs(pages, assessment)
    ids = [item.id for item in assessment.arrays]
    results = {id: [*result_cells(assessment, id), *link_cells(assessment, id)] for id in ids}
    designs = {id: Cells(DESIGN, row) for row, id in enumerate(ids, start=TOP)}
    rows = write_design(pages, assessment, peaks, inputs, results)
    write_requirements(pages, assessment)
    if assessment.linked:
        write_link_runs(pages, assessment)
        write_links(pages, assessment, designs)
    gaps = write_clearances(pages, assessment, inputs)
    write_summary(pages, assessment, rows, gaps)
