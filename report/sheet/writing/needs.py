"""How many cells a begun row or block lacks or has wrong, as formulas for the sheet.

The status of a row is one defined name for each table, whose references are to the row that asks;
its cells hold the name alone. `conditions` says what is required and what is wrong, for `checks`
too. Read `row_status`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from datetime import date

from report.sheet.checking import conditions
from report.sheet.checking.refused import REFUSED, SHORT, UNDECIDED
from report.sheet.reading.cells import EARLIEST, LARGEST
from report.sheet.schema import SECTIONS
from report.sheet.schema.answers import written
from report.sheet.schema.fields import Entry, SheetSection, entries
from report.sheet.schema.layout import BlockPlace, Layout, TablePlace

WRONG = 1_000_000
"""A status is the count of cells that a row lacks, less so much for each that is wrong."""


_EARLIEST = (EARLIEST - date(1899, 12, 30)).days  # as a spreadsheet counts days


def undecided_names(sections: Iterable[SheetSection]) -> list[str]:
    """Return the defined names of whether no formula tells that `check` accepts some sections."""
    return [f"undecided_{s.key}" for s in sections if s in SECTIONS and s.key in UNDECIDED]


def lacks(section: SheetSection, entry: Entry, refer: Callable[[str], str]) -> str:
    """Return whether a cell is required and blank; empty if it is never required."""
    blank = f'TRIM({refer(entry.name)})=""'
    if entry.is_required:
        return blank
    required = conditions.REQUIRED.get((section.key, entry.name))
    return f"AND({required.when.formula(refer)},{blank})" if required else ""


def status_name(section: SheetSection) -> str:
    """Return the defined name of the status of a row."""
    return f"status_{section.key}"


def row_status(place: TablePlace, tests: Iterable[str]) -> str:
    """Return the number of cells that a begun row lacks; an empty text for a row not begun.

    Negative where a cell is wrong, by tests: see `WRONG`. For the defined name of the table: the
    row is that of the cell that asks for it.
    """
    cells = [place.here(entry.name) for entry in entries(place.section.model)]
    lacking = _lacking(place.section, place.here) or "0"
    wrong = "+".join(f"({test})" for test in tests)
    return f'IFERROR(IF(TRIM({"&".join(cells)})="","",{lacking}-{WRONG}*({wrong})),-{WRONG})'


def status_in(row: int, place: TablePlace, layout: Layout) -> str:
    """Return the status of a row for a workbook of 0.2, which has no names for it."""
    status = row_status(place, wrong_cells(place, layout, SHORT).values())
    return re.sub(r"(!\$[A-Z]+)1\b", rf"\g<1>{row}", status)


def wrong_cells(
    place: TablePlace | BlockPlace, layout: Layout, refused: Iterable[tuple[str, str]] = REFUSED
) -> Mapping[str, str]:
    """Return whether each cell of a section is wrong, by its defined name."""
    refer = place.here if isinstance(place, TablePlace) else place.section.cell_name
    found = {}
    for entry in entries(place.section.model):
        cell, key = refer(entry.name), place.section.cell_name(entry.name)
        tests = [is_wrong(cell, entry, f"unit_{key}")]
        for name, test in refused if place.section in SECTIONS else ():
            if name == key:
                tests.append(f"IFERROR({written(test, layout, refer)},FALSE)")
        test = ",".join(tests)
        found[f"wrong_{key}"] = f"IF(ISERROR({cell}),TRUE,OR({test}))"
    return found


def wrong_name(section: SheetSection, field: str) -> str:
    """Return the defined name of whether a cell is wrong."""
    return f"wrong_{section.cell_name(field)}"


def wrong_names(section: SheetSection) -> list[str]:
    """Return these names of all fields."""
    return [wrong_name(section, entry.name) for entry in entries(section.model)]


def _lacking(section: SheetSection, refer: Callable[[str], str]) -> str:
    """Return the number of cells that are required and blank; empty if none may be."""
    tests = (lacks(section, entry, refer) for entry in entries(section.model))
    return "+".join(f"IF({test},1,0)" for test in tests if test)


def is_wrong(cell: str, entry: Entry, unit: str) -> str:
    """Return whether a filled cell has what its field does not accept, where a formula can tell."""
    text = f"TRIM({cell})"
    if entry.choices:
        known = f"|{'|'.join(entry.choices)}|".casefold()
        is_known = f'ISNUMBER(FIND("|"&LOWER({text})&"|","{known}"))'
        return f'AND({text}<>"",OR(NOT({is_known}),ISNUMBER(FIND("|",{cell}))))'
    if entry.kind in (int, float):
        value = f"{cell}*{unit}" if entry.quantity else cell
        tests = [*_beyond(value, entry), f"ABS({value})>{LARGEST:.0f}"]
        tests += [f"{cell}<>INT({cell})"] if entry.kind is int else []
        # Excel shows 0.45 as 45% where that was typed, and `check` asks which is meant.
        # A logical value is a number for LibreOffice.
        tests += [f'LEFT(CELL("format",{cell}))="P"', f"ISLOGICAL({cell})"]
        return f'IF(ISNUMBER({cell}),OR({",".join(tests)}),{text}<>"")'
    if entry.kind is date:
        no_date = f'OR(LEN({text})<>10,MID({text},5,1)<>"-",ISERROR(DATEVALUE({text})))'
        return f'IF(ISNUMBER({cell}),{cell}<{_EARLIEST},AND({text}<>"",{no_date}))'
    return f"OR(LEN({cell})>{entry.max_length},ISLOGICAL({cell}))"


def _beyond(value: str, entry: Entry) -> Iterator[str]:
    bounds = entry.bounds
    if math.isfinite(bounds.low):
        yield f"{value}{'<=' if bounds.excludes_low else '<'}{bounds.low:.12g}"
    if math.isfinite(bounds.high):
        yield f"{value}{'>=' if bounds.excludes_high else '>'}{bounds.high:.12g}"


def table_lacks(place: TablePlace) -> str:
    """Return the number of cells that the rows of a table lack or have wrong."""
    total = f"SUM({place.all('status')})"
    return f"MOD({total},{WRONG})+(MOD({total},{WRONG})-{total})/{WRONG}"


def block_lacks(place: BlockPlace) -> str:
    """Return the number of cells that a block lacks; empty if it requires none."""
    return _lacking(place.section, place.section.cell_name)


def block_begun(place: BlockPlace) -> str:
    """Return whether any required cell of a block is filled; empty if it requires none."""
    cells = [place.cell(entry.name) for entry in entries(place.section.model) if entry.is_required]
    return f'TRIM({"&".join(cells)})<>""' if cells else ""
