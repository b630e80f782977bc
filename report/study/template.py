"""Writes the study workbook from its schema, blank or filled in. Read `write_study`."""

from __future__ import annotations

import io
from pathlib import Path

from openpyxl import Workbook

from report.sheet.schema import UnitsFirst
from report.sheet.schema.layout import Layout
from report.sheet.writing import style
from report.sheet.writing.grids import write_answers, write_block, write_table
from report.sheet.writing.marks import mark_block, mark_table
from report.study.read import StudyInput
from report.study.schema import SECTIONS
from solver.files import write_whole


def write_study(path: Path, *, units: UnitsFirst, example: StudyInput | None = None) -> None:
    """Write a study workbook, blank or with the values of a study.

    Parameters
    ----------
    path : Path
        The .xlsx file to write or replace.
    units : UnitsFirst
        System of units of the sheets.
    example : StudyInput, optional
        Values to fill in.
    """
    is_us = units is UnitsFirst.US
    book, layout = Workbook(), Layout()
    book.worksheets[0].title = SECTIONS[0].sheet
    for section in SECTIONS:
        if section.sheet not in book.sheetnames:
            book.create_sheet(section.sheet)
        if section.is_table:
            rows = () if example is None else getattr(example, section.key)
            layout.tables[section.key] = write_table(book, section, units, rows)
        else:
            block = () if example is None else (getattr(example, section.key),)
            layout.blocks[section.key] = write_block(book, section, units, block)
    for place in layout.tables.values():
        write_answers(book, layout, place, is_us=is_us)
        mark_table(book[place.section.sheet], place)
    for made in layout.blocks.values():
        mark_block(book[made.section.sheet], made)
    for sheet in book.worksheets:
        style.finish(sheet, is_us)
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    write_whole(path, buffer.getvalue())
