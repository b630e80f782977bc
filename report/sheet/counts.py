"""How many cells each sheet lacks: a line on the sheet itself, and a list on the sheet Start.

`needs` has the formulas of rows and blocks. Read `write_counts`.
"""

from __future__ import annotations

from openpyxl import Workbook
from openpyxl.utils import get_column_letter

from report.sheet import style
from report.sheet.layout import Layout, TablePlace, name_cell
from report.sheet.marks import mark_count
from report.sheet.needs import block_lacks
from report.sheet.schema import SECTIONS

START = "Start"
COUNTS_COLUMN = 4
"""Column of the names of the sheets in the list; the counts are beside it."""

_NEED_ROWS = ("arrays", "motions")
_COUNT_FORMAT = '[<0]"no row yet";[=0]"✓";0" missing"'


def write_counts(book: Workbook, layout: Layout, top: int) -> None:
    """Write what each sheet lacks: on the sheet itself, and in a list on Start, from a row on."""
    start = book[START]
    for row, title in enumerate(dict.fromkeys(s.sheet for s in SECTIONS), start=top):
        blocks, tables = layout.on(title)
        lacks = [text for text in map(block_lacks, blocks) if text]
        lacks += [_lacking_in(place) for place in tables]
        style.put(start, row, COUNTS_COLUMN, title)
        sheet_name = title.lower().replace(" ", "_")
        name = f"lacks_{sheet_name}"
        count = start.cell(row, COUNTS_COLUMN + 1)
        style.put_answer(count, "+".join(lacks) or "0", _COUNT_FORMAT)
        name_cell(book, name, start, row, COUNTS_COLUMN + 1)
        mark_count(start, count.coordinate, f"${get_column_letter(COUNTS_COLUMN + 1)}{row}")
        _write_line(book, title, name)
        name_cell(book, f"line_{sheet_name}", book[title], 3, 1)


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
