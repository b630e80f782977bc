"""Writes the input workbook from the schema, blank or filled in.

Owns the order of the sheets and what is on each; `grids` writes blocks and tables, `style` owns
their appearance, `answers` the formulas. `read` finds the cells by names and headings, so positions
here may change.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from openpyxl import Workbook

from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.fields import SheetSection
from report.sheet.schema.layout import Layout
from report.sheet.writing import style
from report.sheet.writing.counts import START, write_counts
from report.sheet.writing.grids import define_tests, write_answers, write_block, write_table
from report.sheet.writing.lookups import write_lookups
from report.sheet.writing.marks import mark_block, mark_lost, mark_ratio, mark_table
from report.sheet.writing.results_panel import write_panel
from report.sheet.writing.rules import write_rules
from report.sheet.writing.start import color_tabs, write_start
from solver.files import write_whole


def write_template(path: Path, *, units: UnitsFirst, example: ProjectInput | None = None) -> None:
    """Write or replace an input workbook, which `template` returns."""
    write_whole(path, template(units, example))


def template(units: UnitsFirst, example: ProjectInput | None = None) -> bytes:
    """Return an input workbook, with the values of a project or blank but for defaults.

    Parameters
    ----------
    units : UnitsFirst
        System of units of the sheets.
    """
    book, layout = book_of(SECTIONS, START, units, example)
    write_panel(book, is_us=units.is_us)
    write_rules(book, layout)
    write_lookups(book, layout)
    mark_ratio(book["Clearances"], layout.tables["clearances"], "demand_capacity")
    write_counts(book, layout, write_start(book))
    mark_lost(book, layout)
    color_tabs(book)
    return saved(book, units)


def book_of(
    sections: Iterable[SheetSection], first_sheet: str, units: UnitsFirst, example: object
) -> tuple[Workbook, Layout]:
    """Return a book with the blocks and tables of sections, their formulas and marks.

    An example has the values of each section as an attribute; None leaves the inputs blank.
    """
    book, layout = Workbook(), Layout()
    book.worksheets[0].title = first_sheet
    for section in sections:
        if section.sheet not in book.sheetnames:
            book.create_sheet(section.sheet)
        given: Any = getattr(example, section.key, None)
        if section.is_table:
            layout.tables[section.key] = write_table(book, section, units, given or ())
        else:
            layout.blocks[section.key] = write_block(book, section, units, given)
    define_tests(book, layout)
    for place in layout.tables.values():
        write_answers(book, layout, place, is_us=units.is_us)
        mark_table(book[place.section.sheet], place)
    for block in layout.blocks.values():
        mark_block(book[block.section.sheet], block)
    return book, layout


def saved(book: Workbook, units: UnitsFirst) -> bytes:
    """Set up the pages of a finished book and return it; programs compute it when they open it."""
    for sheet in book.worksheets:
        style.finish(sheet, units.is_us)
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()
