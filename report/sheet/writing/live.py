"""The live formulas of a workbook as they should be, and the cells where others stand instead.

The formulas are written again for the headings that the workbook has, and found in it by table and
by defined name. Read `overwritten`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, product

from openpyxl import Workbook
from openpyxl.utils import get_column_letter

from report.sheet.reading.archive import OpenBook
from report.sheet.reading.cells import Found, plain
from report.sheet.reading.formula_text import canonical, moved
from report.sheet.reading.locate_tables import TableArea, table_area
from report.sheet.reading.positions import (
    FRESH,
    CellPosition,
    area_named,
    found_at,
    label_key,
    labels_of,
)
from report.sheet.schema import SECTIONS
from report.sheet.schema.answers import LEGACY_ANSWERS, SITE_ANSWERS
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.fields import Finding, Level, Place, SheetSection
from report.sheet.schema.layout import TablePlace, Tables, name_cell
from report.sheet.writing.grids import columns_of, table_formulas
from report.sheet.writing.lookups import write_lookups
from report.sheet.writing.results_panel import write_panel
from report.sheet.writing.rules import write_rules
from report.words.letters import cut

_PANEL = "live_prescriptive_in"
BROKEN = "#REF!"
"""In a formula that refers to a column which the workbook lacks."""

_SHOWN = 100
_NAME = re.compile(r'"[^"]*"|\b([a-z]+_\w+)\b(?!\[)')
_ASIDE = 20
"""A column that nothing else is written to."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Overwritten:
    """A cell that has lost its live formula."""

    position: CellPosition
    found: Found  # what it contains instead
    title: str  # what the formula computes
    formula: str  # what it should be, with its equals sign

    @property
    def is_broken(self) -> bool:
        """Whether the workbook lacks a column that the formula refers to."""
        return BROKEN in self.formula


def overwritten(book: OpenBook) -> tuple[Overwritten, ...]:
    """Return the cells that have lost their live formula, by sheet, column and row.

    A workbook without live formulas, as of 0.1, has none. Not watched: a part of a sheet in which
    rows were inserted or deleted, unless it is a table.
    """
    lost = [
        Overwritten(position=position, found=found, title=_title(book, position), formula=formula)
        for position, formula in live_formulas(book).items()
        if _differs(found := found_at(book, position), formula)
    ]
    titles = book.book.sheetnames
    lost.sort(key=lambda o: (titles.index(o.position.sheet), o.position.column, o.position.row))
    return tuple(lost)


def _differs(found: Found, formula: str) -> bool:
    if BROKEN in formula:
        return BROKEN in found.formula
    return found.formula != formula and canonical(found.formula) != canonical(formula)


def findings(lost: Sequence[Overwritten]) -> Iterator[Finding]:
    """Yield a warning for each run of cells below each other."""
    keys = {section.sheet: section.key for section in reversed(SECTIONS)}
    for run in _runs(lost):
        first, last = run[0], run[-1]
        cell = first.position.address
        cells = f"{cell}:{last.position.cell}" if len(run) > 1 else cell
        place = Place(keys.get(first.position.sheet, SECTIONS[0].key))
        text = _text(first, len(run))
        yield Finding(level=Level.WARNING, place=place, text=text, cell=cells)


def _runs(lost: Sequence[Overwritten]) -> Iterator[list[Overwritten]]:
    def key(numbered: tuple[int, Overwritten]) -> tuple[str, int, int, bool]:
        count, item = numbered
        at = item.position
        return at.sheet, at.column, at.row - count, item.is_broken

    for _, run in groupby(enumerate(lost), key):
        yield [item for _, item in run]


def _text(item: Overwritten, count: int) -> str:
    title = f"{item.title} ({count} cells)" if count > 1 else item.title
    if item.is_broken:
        return f"{title} refers to a column that is missing; write its heading again, or {FRESH}"
    formula, found = cut(item.formula, _SHOWN), item.found
    if found.is_blank:
        what = f"is blank, and its formula is gone: {formula}"
    elif found.formula:
        what = f"is {cut(found.formula, _SHOWN)}, which is not its formula {formula}"
    else:
        what = f"is {cut(plain(found.value))}, typed over its formula {formula}"
    return f"{title} {what}; {FRESH}"


def _title(book: OpenBook, position: CellPosition) -> str:
    """Return what a cell computes: the heading of its column, or else the label of its row."""
    sheet = book.book[position.sheet]
    for section in SECTIONS:
        area = table_area(book, section) if section.is_table else None
        if area and area.sheet == position.sheet and area.header < position.row <= area.last:
            return str(sheet.cell(area.header, position.column).value)
    labels = (sheet.cell(position.row, column).value for column in range(1, position.column))
    found = next((str(label) for label in labels if isinstance(label, str) and label), "cell")
    return f"{found.removesuffix(' *')}, computed," if position.sheet == "Site" else found


def has_live_formulas(book: OpenBook) -> bool:
    """Whether a workbook computes while it is filled in, as those of 0.1 do not."""
    return area_named(book.book, _PANEL) is not None


def live_formulas(book: OpenBook) -> Mapping[CellPosition, str]:
    """Return every live formula that a workbook should have, with its equals sign.

    A formula that refers to a column which the workbook lacks has `#REF!` in it.
    """
    panel = area_named(book.book, _PANEL)
    if panel is None:
        return {}
    is_us = panel[1][0] == 2  # inches are in the first of its columns
    units = UnitsFirst.US if is_us else UnitsFirst.SI
    areas = {s.key: area for s in SECTIONS if s.is_table and (area := table_area(book, s))}
    tables = {s.key: _place(book, s, areas.get(s.key), units) for s in SECTIONS if s.is_table}
    formulas = dict(_in_tables(tables, areas, is_us=is_us))
    return formulas | dict(_named(book, _written(tables, is_us=is_us)))


def _place(
    book: OpenBook, section: SheetSection, area: TableArea | None, units: UnitsFirst
) -> TablePlace:
    headings, letters = {}, {}
    for column in columns_of(section, units):
        entry = column.entry
        labels = labels_of(section, entry) if entry else {label_key(column.heading)}
        given = area.headings if area else {}
        at = next((given[label] for label in labels if label in given), None)
        headings[column.name] = str(found_at(book, at).value) if at else BROKEN
        letters[column.name] = get_column_letter(at.column) if at else BROKEN
    return TablePlace(
        section=section,
        sheet=area.sheet if area else section.sheet,
        header=area.header if area else 0,
        size=area.last - area.header if area else 0,
        headings=headings,
        letters=letters,
    )


def _in_tables(
    tables: Tables, areas: Mapping[str, TableArea], *, is_us: bool
) -> Iterator[tuple[CellPosition, str]]:
    for key, area in areas.items():
        place = tables[key]
        for name, (formula, _) in table_formulas(tables, place, is_us=is_us).items():
            heading = area.headings.get(label_key(place.headings[name]))
            if heading is not None:
                for row in range(area.header + 1, area.last + 1):
                    yield CellPosition(area.sheet, row, heading.column), f"={formula}"


def legacy_statuses(book: OpenBook) -> Iterator[tuple[CellPosition, str]]:
    """Yield the formulas of the column Status, which tables of earlier workbooks have."""
    for section in SECTIONS:
        area, name = (
            table_area(book, section) if section.is_table else None,
            f"status_{section.key}",
        )
        heading = area.headings.get("status") if area else None
        if area and heading and name in book.book.defined_names:
            for row in range(area.header + 1, area.last + 1):
                yield CellPosition(area.sheet, row, heading.column), f"={name}"


def _written(tables: Tables, *, is_us: bool) -> Workbook:
    """Return a workbook that has the formulas outside of tables, at places of its own."""
    book = Workbook()
    for title in dict.fromkeys(section.sheet for section in SECTIONS):
        book.create_sheet(title)
    for row, (formula, name) in enumerate(SITE_ANSWERS.values(), start=1):
        book["Site"].cell(row, _ASIDE).value = f"={formula}"
        name_cell(name, book["Site"], row, _ASIDE)
    write_panel(book, is_us=is_us)
    write_rules(book, tables)
    write_lookups(book, tables)
    return book


def _named(book: OpenBook, written: Workbook) -> Iterator[tuple[CellPosition, str]]:
    """Yield the formulas within named ranges, moved to where the workbook has these names.

    Not those that refer to a name which came later: a workbook has the formulas of its version.
    """
    known = {"", *(str(name).casefold() for name in book.book.defined_names)}
    for name in written.defined_names:
        here, there = area_named(written, name), area_named(book.book, name)
        if here is None or there is None or _size(here[1]) != _size(there[1]):
            continue
        right, down = (there[1][side] - here[1][side] for side in (0, 1))
        left, top, last_column, last_row = here[1]
        for row, column in product(range(top, last_row + 1), range(left, last_column + 1)):
            cell = written[here[0]].cell(row, column)
            text = str(cell.value)
            if cell.data_type == "f" and known.issuperset(_NAME.findall(text)):
                at = CellPosition(there[0], row + down, column + right)
                former = f"={LEGACY_ANSWERS.get(name)}"
                is_former = not _differs(found_at(book, at), former)
                yield at, former if is_former else moved(text, down)


def _size(bounds: tuple[int, int, int, int]) -> tuple[int, int]:
    left, top, right, bottom = bounds
    return right - left, bottom - top
