"""How many cells a begun row or block lacks or has wrong, as formulas for the sheet.

The status of a row is one defined name for each table, whose references are to the row that asks;
its cells hold the name alone. `conditions` says what is required and what is wrong, for `checks`
too. Read `row_status`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

from report.sheet.conditions import (
    MAX_SLOPE_DEG,
    ORDERED,
    OTHER_NAMES,
    REFERENCES,
    REQUIRED,
    UNIQUE,
)
from report.sheet.fields import Entry, SheetSection, entries
from report.sheet.layout import BlockPlace, Layout, TablePlace

WRONG = 1_000_000
"""A status is the count of cells that a row lacks, less so much for each that is wrong."""


def condition(section: str, entry: Entry, refer: Callable[[str], str]) -> str:
    """Return when an optional cell is required, with references to cells; empty for never."""
    required = REQUIRED.get((section, entry.name))
    return required.when.formula(refer) if required else ""


def status_name(section: SheetSection) -> str:
    """Return the defined name of the status of a row."""
    return f"status_{section.key}"


def row_status(place: TablePlace, layout: Layout) -> str:
    """Return the number of cells that a begun row lacks; an empty text for a row not begun.

    Negative where a cell is wrong: see `WRONG`. For the defined name of the table: the row is that
    of the cell that asks for it.
    """
    fields = entries(place.section.model)
    lacking = [_count(place, run, '=""') for run in _runs(place, _required(fields))]
    for entry in fields:
        needed = condition(place.section.key, entry, place.this)
        if needed:
            lacking.append(f'IF(AND({needed},TRIM({place.here(entry.name)})=""),1,0)')
    begun = "+".join(_count(place, run, '<>""') for run in _runs(place, [e.name for e in fields]))
    tests = "+".join(f"({test})" for test in _wrong_in_row(place, layout))
    wrong = f"-{WRONG}*({tests})" if tests else ""
    return f'IF({begun}=0,"",{"+".join(lacking)}{wrong})'


def _wrong_in_row(place: TablePlace, layout: Layout) -> Iterator[str]:
    """Yield what makes a cell of a row wrong."""
    section = place.section.key
    for entry in entries(place.section.model):
        yield from is_wrong(place.here(entry.name), entry, f"unit_{section}_{entry.name}")
    for alike in UNIQUE:
        if section in alike:
            yield is_twice(place.here("id"), alike, layout)
    for (home, field), tables in REFERENCES.items():
        if home == section:
            yield is_nowhere(place.here(field), tables, OTHER_NAMES.get((home, field), ""), layout)
    for low, high in ORDERED:
        if high in place.letters:
            cells = [place.here(name) for name in (low, high)]
            given = ",".join(f"ISNUMBER({cell})" for cell in cells)
            least, most = (f"N({place.here(name)})*unit_{section}_{name}" for name in (low, high))
            yield f"AND({given},{least}>={most})"
    if "slope_deg" in place.letters:
        slope = place.here("slope_deg")
        yield f"AND(ISNUMBER({slope}),{slope}>={MAX_SLOPE_DEG:g})"


def is_wrong(cell: str, entry: Entry, unit: str) -> Iterator[str]:
    """Yield whether a filled cell has what its field does not accept, where a formula can tell."""
    if entry.choices:
        yield is_unknown(cell, entry)
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


def is_unknown(cell: str, entry: Entry) -> str:
    """Return whether a filled cell has a text that is none of its choices."""
    known = f"|{'|'.join(entry.choices)}|".casefold()
    return f'AND(TRIM({cell})<>"",ISERROR(FIND("|"&LOWER(TRIM({cell}))&"|","{known}")))'


def is_twice(cell: str, tables: Sequence[str], layout: Layout) -> str:
    """Return whether an id is given more than once in some tables, with any capitals."""
    ids = [layout.tables[table].all("id") for table in tables]
    count = "+".join(f"SUMPRODUCT(--(TRIM({column})=TRIM({cell})))" for column in ids)
    return f'AND(TRIM({cell})<>"",{count}>1)'


def is_nowhere(cell: str, tables: Sequence[str], other: str, layout: Layout) -> str:
    """Return whether a name is that of no row of some tables."""
    ids = [layout.tables[table].all("id") for table in tables]
    count = "+".join(f"SUMPRODUCT(--EXACT(TRIM({column}),TRIM({cell})))" for column in ids)
    count += f'+(LOWER(TRIM({cell}))="{other}")' if other else ""
    return f'AND(TRIM({cell})<>"",{count}=0)'


def _required(fields: Sequence[Entry]) -> list[str]:
    return [entry.name for entry in fields if entry.is_required]


def _count(place: TablePlace, run: tuple[str, str], test: str) -> str:
    return f"SUMPRODUCT(--(TRIM({place.here(*run)}){test}))"


def _runs(place: TablePlace, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield first and last of the columns that stand side by side."""
    order = {name: count for count, name in enumerate(place.letters)}
    ranked = sorted(names, key=order.__getitem__)
    for _, group in groupby(enumerate(ranked), lambda item: order[item[1]] - item[0]):
        run = [name for _, name in group]
        yield run[0], run[-1]


def table_lacks(place: TablePlace) -> str:
    """Return the number of cells that the rows of a table lack or have wrong."""
    total = f"SUM({place.all('status')})"
    return f"MOD({total},{WRONG})+(MOD({total},{WRONG})-{total})/{WRONG}"


def block_lacks(place: BlockPlace) -> str:
    """Return the number of cells that a block lacks; empty if it requires none."""
    parts = []
    for entry in entries(place.section.model):
        name = place.section.cell_name(entry.name)
        blank = f'TRIM({name})=""'
        needed = condition(place.section.key, entry, place.section.cell_name)
        if entry.is_required:
            parts.append(f"IF({blank},1,0)")
        elif needed:
            parts.append(f"IF(AND({needed},{blank}),1,0)")
    return "+".join(parts)


def block_wrong(place: BlockPlace) -> str:
    """Return the number of cells of a block that are wrong."""
    name = place.section.cell_name
    tests = [
        test
        for entry in entries(place.section.model)
        for test in is_wrong(name(entry.name), entry, f"unit_{place.section.key}_{entry.name}")
    ]
    return "+".join(f"IF({test},1,0)" for test in tests)


def block_begun(place: BlockPlace) -> str:
    """Return whether any required cell of a block is filled; empty if it requires none."""
    names = _required(entries(place.section.model))
    return f'TRIM({"&".join(place.cell(name) for name in names)})<>""' if names else ""
