"""Writes the study workbook from its schema, blank or filled in. Read `write_study`."""

from __future__ import annotations

from pathlib import Path

from report.sheet.schema import UnitsFirst
from report.sheet.writing.template import book_of, save
from report.study.read import StudyInput
from report.study.schema import SECTIONS


def write_study(path: Path, *, units: UnitsFirst, example: StudyInput | None = None) -> None:
    """Write or replace a study workbook, with the values of a study or blank but for defaults.

    Parameters
    ----------
    units : UnitsFirst
        System of units of the sheets.
    """
    book, _ = book_of(SECTIONS, SECTIONS[0].sheet, units, example)
    save(book, path, units)
