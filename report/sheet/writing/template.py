"""Writes the input workbook from the schema, blank or filled in.

Owns the order of the sheets and what is on each; `grids` writes blocks and tables, `style` owns
their appearance, `answers` the formulas. `read` finds the cells by names and headings, so positions
here may change.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

from openpyxl import Workbook

from report.sheet.schema import SECTIONS, ProjectInput, UnitsFirst
from report.sheet.schema.fields import Frozen, SheetSection
from report.sheet.schema.layout import Layout
from report.sheet.writing import style
from report.sheet.writing.counts import START, write_counts
from report.sheet.writing.grids import write_answers, write_block, write_table
from report.sheet.writing.lookups import write_lookups
from report.sheet.writing.marks import mark_block, mark_lost, mark_ratio, mark_table
from report.sheet.writing.results_panel import write_panel
from report.sheet.writing.rules import write_rules
from report.sheet.writing.start import write_start
from solver.files import write_whole


def write_template(path: Path, *, units: UnitsFirst, example: ProjectInput | None = None) -> None:
    """Write an input workbook, blank or with the values of a project.

    Parameters
    ----------
    path : Path
        The .xlsx file to write or replace.
    units : UnitsFirst
        System of units of the sheets.
    example : ProjectInput, optional
        Values to fill in; without it the inputs are blank except for defaults.
    """
    is_us = units is UnitsFirst.US
    book = Workbook()
    book.worksheets[0].title = START
    layout = Layout()
    for section in SECTIONS:
        _write_section(book, layout, section, units, _rows(section, example))
    write_panel(book, is_us=is_us)
    write_rules(book, layout)
    write_lookups(book, layout)
    for place in layout.tables.values():
        write_answers(book, layout, place, is_us=is_us)
        mark_table(book[place.section.sheet], place)
    for block in layout.blocks.values():
        mark_block(book[block.section.sheet], block)
    clearances = layout.tables["clearances"]
    ratio = clearances.cell("demand_capacity")
    mark_ratio(book["Clearances"], clearances.cells("demand_capacity"), ratio)
    write_counts(book, layout, write_start(book, is_us=is_us))
    mark_lost(book, layout)
    for sheet in book.worksheets:
        style.finish(sheet, is_us)
    style.fit_on_one_page(book[START])
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    write_whole(path, buffer.getvalue())


def _rows(section: SheetSection, example: ProjectInput | None) -> Sequence[Frozen]:
    if example is None:
        return ()
    value = getattr(example, section.key)
    return value if section.is_table else (value,)


def _write_section(
    book: Workbook, layout: Layout, section: SheetSection, units: UnitsFirst, rows: Sequence[Frozen]
) -> None:
    if section.sheet not in book.sheetnames:
        book.create_sheet(section.sheet)
    if section.is_table:
        layout.tables[section.key] = write_table(book, section, units, rows)
        return
    layout.blocks[section.key] = write_block(book, section, units, rows)
