"""How many cells each sheet lacks or has wrong: a line on it, and a list on the sheet Start.

`needs` has the formulas of rows and blocks. Read `write_counts`.
"""

from __future__ import annotations

from collections.abc import Sequence

from openpyxl import Workbook
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.hyperlink import Hyperlink

from report.sheet.schema import SECTIONS
from report.sheet.schema.fields import SheetSection, entries
from report.sheet.schema.layout import Layout, TablePlace, name_cell
from report.sheet.writing import style
from report.sheet.writing.marks import SEE_CHECK, mark_count
from report.sheet.writing.needs import (
    block_lacks,
    table_lacks,
    undecided_names,
    wrong_names,
)

START = "Start"
COUNTS_COLUMN = 4
"""Column of the names of the sheets in the list; the counts are beside it."""

COUNT_FORMAT = '[<0]"no row yet";[=0]"✓";0" open"'


def write_counts(book: Workbook, layout: Layout, top: int) -> None:
    """Write what each sheet lacks: on the sheet itself, and in a list on Start, from a row on."""
    start = book[START]
    for row, title in enumerate(dict.fromkeys(s.sheet for s in SECTIONS), start=top):
        sections = [section for section in SECTIONS if section.sheet == title]
        blocks = [layout.blocks[each.key] for each in sections if each.key in layout.blocks]
        tables = [layout.tables[each.key] for each in sections if each.key in layout.tables]
        wrong = [f"IF({name},1,0)" for place in blocks for name in wrong_names(place.section)]
        lacks = [*(text for text in map(block_lacks, blocks) if text), *wrong]
        lacks += [_lacking_in(place) for place in tables]
        wrong += [f'COUNTIF({p.all("status")},"<0")+{_uncounted(p)}' for p in tables]
        sheet_name = title.lower().replace(" ", "_")
        to_sheet = style.put(start, row, COUNTS_COLUMN, title)
        # By a defined name, which follows a sheet that is renamed.
        to_sheet.hyperlink = Hyperlink(ref=to_sheet.coordinate, location=f"line_{sheet_name}")
        to_sheet.font = Font(name="Calibri", size=10, color=style.INK, underline="single")
        name = f"lacks_{sheet_name}"
        count = start.cell(row, COUNTS_COLUMN + 1)
        style.put_answer(count, "+".join(lacks) or "0", COUNT_FORMAT)
        name_cell(name, start, row, COUNTS_COLUMN + 1)
        at = f"${get_column_letter(COUNTS_COLUMN + 1)}{row}"
        mark_count(start, count.coordinate, at, sections)
        _write_line(book, title, name, "+".join(wrong) or "0", sections)
        name_cell(f"line_{sheet_name}", book[title], 3, 1)


def _lacking_in(place: TablePlace) -> str:
    """Return the number of cells that a table lacks; -1 where it needs a row and has none."""
    status = place.all("status")
    lacking = f"{table_lacks(place)}+{_uncounted(place)}"
    return f"IF(COUNT({status})=0,-1,{lacking})" if place.section.is_needed else lacking


def _uncounted(place: TablePlace) -> str:
    """Return the number of begun rows that lack the formula of their status: inserted ones."""
    names = place.all(entries(place.section.model)[0].name)
    return f'SUMPRODUCT((TRIM({names})<>"")*(1-ISNUMBER({place.all("status")})))'


def _write_line(
    book: Workbook, title: str, name: str, wrong: str, sections: Sequence[SheetSection]
) -> None:
    """Write how many cells a sheet lacks, and whether some are filled, but not as they can be."""
    sheet = book[title]
    what = f'" missing"&IF({wrong}>0," or wrong","")'
    count = f'{name}&IF({name}=1," cell"," cells")&{what}'
    none, undecided = '"No cells missing"', ",".join(undecided_names(sections))
    none += f'&IF(OR({undecided}),"; {SEE_CHECK}","")' if undecided else ""
    line = f'IF({name}<0,"Fill in at least one row",IF({name}=0,{none},{count}))'
    cell = style.put(sheet, 3, 1, "", bold=True, wrap=False)
    cell.value = f"={line}"
    mark_count(sheet, "A3", 'IF(LEFT($A$3,2)="No",0,1)', sections)
