"""Writes the study workbook from its schema, blank or filled in. Read `write_study`."""

from __future__ import annotations

from pathlib import Path

from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.fields import sections_of
from report.sheet.writing.template import book_of, saved
from report.study.schema import StudyInput
from solver.files import write_whole


def write_study(path: Path, *, units: UnitsFirst, example: StudyInput | None = None) -> None:
    """Write or replace a study workbook, with the values of a study or blank but for defaults.

    Parameters
    ----------
    units : UnitsFirst
        System of units of the sheets.
    """
    sections = sections_of(StudyInput)
    book, _ = book_of(sections, sections[0].sheet, units, example)
    write_whole(path, saved(book, units))
