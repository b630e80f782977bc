"""How many cells a begun row or block lacks or has wrong, as formulas for the sheet.

The status of a row is one defined name for each table, whose references are to the row that asks;
its cells hold the name alone. `conditions` says what is required and what is wrong, for `checks`
too. Read `row_status`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator

from report.sheet.checking import conditions
from report.sheet.schema.fields import Entry, SheetSection, entries
from report.sheet.schema.layout import BlockPlace, Layout, TablePlace

WRONG = 1_000_000
"""A status is the count of cells that a row lacks, less so much for each that is wrong."""


def condition(section: str, entry: Entry, refer: Callable[[str], str]) -> str:
    """Return when an optional cell is required, with references to cells; empty for never."""
    required = conditions.REQUIRED.get((section, entry.name))
    return required.when.formula(refer) if required else ""


def status_name(section: SheetSection) -> str:
    """Return the defined name of the status of a row."""
    return f"status_{section.key}"


def row_status(place: TablePlace, layout: Layout) -> str:
    """Return the number of cells that a begun row lacks; an empty text for a row not begun.

    Negative where a cell is wrong: see `WRONG`. For the defined name of the table: the row is that
    of the cell that asks for it.
    """
    cells = [place.here(entry.name) for entry in entries(place.section.model)]
    lacking = "+".join(_lacking(place.section, place.here)) or "0"
    tests = "+".join(f"({test})" for test in _wrong_in_row(place, layout))
    wrong = f"-{WRONG}*({tests})" if tests else ""
    return f'IF(TRIM({"&".join(cells)})="","",{lacking}{wrong})'


def status_in(row: int, place: TablePlace, layout: Layout) -> str:
    """Return the status of a row for a workbook of 0.2, which has no name for it."""
    return re.sub(r"(!\$[A-Z]+)1\b", rf"\g<1>{row}", row_status(place, layout))


def _lacking(section: SheetSection, refer: Callable[[str], str]) -> Iterator[str]:
    for entry in entries(section.model):
        blank = f'TRIM({refer(entry.name)})=""'
        needed = condition(section.key, entry, refer)
        if entry.is_required:
            yield f"IF({blank},1,0)"
        elif needed:
            yield f"IF(AND({needed},{blank}),1,0)"


def _wrong_in_row(place: TablePlace, layout: Layout) -> Iterator[str]:
    """Yield what makes a cell of a row wrong."""
    section = place.section.key
    yield from _refused(place.section, place.here)
    for alike in conditions.UNIQUE:
        if section in alike:
            given = f"TRIM({place.here('id')})"  # with any capitals
            ids = (layout.tables[table].all("id") for table in alike)
            count = "+".join(f"SUMPRODUCT(--(TRIM({column})={given}))" for column in ids)
            yield f'AND({given}<>"",{count}>1)'
    for (home, field), tables in conditions.REFERENCES.items():
        if home == section:
            given = f"TRIM({place.here(field)})"
            ids = (layout.tables[table].all("id") for table in tables)
            count = "+".join(f"SUMPRODUCT(--EXACT(TRIM({column}),{given}))" for column in ids)
            if other := conditions.OTHER_NAMES.get((home, field)):
                count += f'+(LOWER({given})="{other}")'
            yield f'AND({given}<>"",{count}=0)'
    for low, high in conditions.ORDERED:
        if high in place.letters:
            cells = [place.here(name) for name in (low, high)]
            given = ",".join(f"ISNUMBER({cell})" for cell in cells)
            least, most = (f"N({place.here(name)})*unit_{section}_{name}" for name in (low, high))
            yield f"AND({given},{least}>={most})"
    if "slope_deg" in place.letters:
        slope = place.here("slope_deg")
        yield f"AND(ISNUMBER({slope}),{slope}>={conditions.MAX_SLOPE_DEG:g})"


def _refused(section: SheetSection, refer: Callable[[str], str]) -> Iterator[str]:
    """Yield whether each cell has what its field does not accept."""
    for entry in entries(section.model):
        yield from is_wrong(refer(entry.name), entry, f"unit_{section.key}_{entry.name}")


def is_wrong(cell: str, entry: Entry, unit: str) -> Iterator[str]:
    """Yield whether a filled cell has what its field does not accept, where a formula can tell."""
    if entry.choices:
        known = f"|{'|'.join(entry.choices)}|".casefold()
        yield f'AND(TRIM({cell})<>"",ISERROR(FIND("|"&LOWER(TRIM({cell}))&"|","{known}")))'
    elif entry.kind in (int, float):
        tests = [*_beyond(f"{cell}*{unit}" if entry.quantity else cell, entry)]
        tests += [f"{cell}<>INT({cell})"] if entry.kind is int else []
        # Excel shows 0.45 as 45% where that was typed, and `check` asks which is meant.
        tests.append(f'LEFT(CELL("format",{cell}))="P"')
        yield f'IF(ISNUMBER({cell}),OR({",".join(tests)}),TRIM({cell})<>"")'


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
    return "+".join(_lacking(place.section, place.section.cell_name))


def block_wrong(place: BlockPlace) -> str:
    """Return the number of cells of a block that are wrong."""
    tests = _refused(place.section, place.section.cell_name)
    return "+".join(f"IF({test},1,0)" for test in tests)


def block_begun(place: BlockPlace) -> str:
    """Return whether any required cell of a block is filled; empty if it requires none."""
    cells = [place.cell(entry.name) for entry in entries(place.section.model) if entry.is_required]
    return f'TRIM({"&".join(cells)})<>""' if cells else ""
