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

from report.sheet import style
from report.sheet.fields import Frozen, Section
from report.sheet.grids import write_answers, write_block, write_table
from report.sheet.layout import Layout, TablePlace, name_cell
from report.sheet.lookups import write_lookups
from report.sheet.marks import mark_block, mark_count, mark_ratio, mark_table
from report.sheet.needs import block_lacks
from report.sheet.results_panel import write_panel
from report.sheet.rules import write_rules
from report.sheet.schema import SECTIONS, ProjectInput, UnitsFirst
from report.sheet.start import START, write_start
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
        write_answers(book[place.section.sheet], layout, place, is_us=is_us)
        mark_table(book[place.section.sheet], place)
    for block in layout.blocks.values():
        mark_block(book[block.section.sheet], block)
    clearances = layout.tables["clearances"]
    ratio = clearances.cell("demand_capacity")
    mark_ratio(book["Clearances"], clearances.cells("demand_capacity"), ratio)
    _write_counts(book, layout, write_start(book, is_us=is_us))
    for sheet in book.worksheets:
        style.finish(sheet, is_us)
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    write_whole(path, buffer.getvalue())


def _rows(section: Section, example: ProjectInput | None) -> Sequence[Frozen]:
    if example is None:
        return ()
    value = getattr(example, section.key)
    return value if section.is_table else (value,)


def _write_section(
    book: Workbook,
    layout: Layout,
    section: Section,
    units: UnitsFirst,
    rows: Sequence[Frozen],
) -> None:
    if section.sheet not in book.sheetnames:
        book.create_sheet(section.sheet)
    if section.is_table:
        layout.tables[section.key] = write_table(book, section, units, rows)
        return
    layout.blocks[section.key] = write_block(book, section, units, rows)


def _write_counts(book: Workbook, layout: Layout, counts: int) -> None:
    """Write what each sheet lacks: on the sheet itself, and in a list on the first sheet."""
    titles = dict.fromkeys(section.sheet for section in SECTIONS)
    for row, title in enumerate(titles, start=counts):
        blocks, tables = layout.on(title)
        lacks = [text for text in map(block_lacks, blocks) if text]
        lacks += [_lacking_in(place) for place in tables]
        start = book[START]
        style.put(start, row, 2, title)
        name = f"lacks_{title.lower().replace(' ', '_')}"
        style.put_answer(start.cell(row, 3), "+".join(lacks) or "0", _COUNT_FORMAT)
        name_cell(book, name, start, row, 3)
        mark_count(start, f"C{row}", f"$C{row}")
        _write_line(book, title, name)


_NEED_ROWS = ("arrays", "motions")
_COUNT_FORMAT = '[<0]"no row yet";[=0]"✓";0" missing"'


def _lacking_in(place: TablePlace) -> str:
    """Return the number of cells that a table lacks; -1 where it needs a row and has none."""
    status = place.all("status")
    lacking = f"SUM({status})"
    return f"IF(COUNT({status})=0,-1,{lacking})" if place.section.key in _NEED_ROWS else lacking


def _write_line(book: Workbook, title: str, name: str) -> None:
    sheet = book[title]
    count = f'{name}&IF({name}=1," cell missing"," cells missing")'
    line = f'IF({name}<0,"Fill in at least one row",IF({name}=0,"No cells missing",{count}))'
    cell = style.put(sheet, 3, 1, "", bold=True, wrap=False)
    cell.value = f"={line}"
    mark_count(sheet, "A3", 'IF(LEFT($A$3,2)="No",0,1)')
