"""results.xlsx: the tables, and live formulas from the peaks to the separations.

Computes nothing: each formula is written with the value from `report.assessment.project`, and that
value is repeated beside it as a number, so that a checker can trace, change and compare it.
"""

from __future__ import annotations

import io
from collections.abc import Sequence

from report.assessment.project import Assessment
from report.assessment.spectra import Spectra
from report.results.design import DesignRow, write_design
from report.results.directions import write_directions, write_peaks
from report.results.gaps import result_cells, write_clearances
from report.results.inputs import write_inputs
from report.results.links import LinkRunRow, link_cells, link_run_rows, write_links
from report.results.lists import write_lists, write_requirements
from report.results.sheets import TOP, Cells, Pages, text_workbook, write_list

_ORDER = (
    "Design", "Clearances", "Neighbors", "Requirements", "Inputs", "Motions", "Records", "Spectra",
    "Directions", "Peaks", "Runs", "Links", "LinkRuns",
)  # fmt: skip
"""The sheets in the order of the package."""


OF_MOTIONS = {"Motions", "Records", "Spectra", "Directions", "Peaks", "Runs"}
"""The sheets that a workbook without motions has not."""


def results_xlsx(assessment: Assessment, spectra: Sequence[Spectra]) -> bytes:
    """Return the tables as a workbook, with live formulas from the peaks to the separations."""
    buffer = io.BytesIO()
    absent = set() if assessment.linked else {"Links", "LinkRuns"}
    absent |= set() if assessment.neighbors else {"Neighbors"}
    absent |= set() if assessment.has_motions else OF_MOTIONS
    with text_workbook(buffer, assessment.project.project.date) as workbook:
        pages = Pages(workbook, is_a4=not assessment.project.us_first)
        for name in _ORDER:
            if name not in absent:
                workbook.add_worksheet(name)
        write_lists(pages, assessment, spectra)
        _write_live(pages, assessment)
        workbook.set_calc_mode("auto")
    return buffer.getvalue()


def _write_live(pages: Pages, assessment: Assessment) -> None:
    """Write the sheets with formulas, and the runs of rows of linked blocks."""
    peaks = write_peaks(pages, assessment) if assessment.has_motions else {}
    inputs = write_inputs(pages, assessment)
    ids = [item.id for item in assessment.arrays]
    results = {id: [*result_cells(assessment, id), *link_cells(assessment, id)] for id in ids}
    designs = {id: Cells(DesignRow, row) for row, id in enumerate(ids, start=TOP)}
    write_design(pages, assessment, peaks, inputs, results)
    write_requirements(pages, assessment)
    if assessment.linked:
        write_list(pages, LinkRunRow.sheet, list(link_run_rows(assessment)))
        write_links(pages, assessment, designs)
    if assessment.has_motions:
        write_directions(pages, assessment, peaks, designs)
    write_clearances(pages, assessment, inputs)
