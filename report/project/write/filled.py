"""Writes cells of a workbook; the only way for a command to change one. Read `changing`."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import starmap
from pathlib import Path

from openpyxl.formula import Tokenizer
from openpyxl.formula.tokenizer import Token, TokenizerError
from openpyxl.formula.translate import Translator
from openpyxl.utils import coordinate_to_tuple
from openpyxl.utils.escape import unescape

from report.project.check.finding_lines import listed
from report.project.model.choices import ClearanceSource
from report.project.model.input_rows import InputRow, Place
from report.project.read.archive import OpenBook, book_of, located, open_book
from report.project.read.cells import Found
from report.project.read.changed_cells import Formula, Value, changed
from report.project.read.locate import MAX_ROWS, TableFound, find_table, table_area
from report.project.read.positions import FRESH, CellPosition, bounds_of, found_at
from report.project.read.read import read_book
from report.project.read.what_if import cells
from report.project.read.workbook_data import Sheet
from report.project.workbook import SECTION, SECTIONS
from report.project.write.style import is_answer
from report.text.grouping import grouped_by
from report.text.names import joined
from solver.errors import InputError, Problem
from solver.file_checks import check_plain
from solver.file_writing import locked, write_all

# Ends the name under which a workbook is kept as it was before the last command changed it.
BEFORE = ".before.xlsx"
# Decimals of a number that is written in the unit of its column.
DIGITS = 6

# Files that Excel and LibreOffice put beside a workbook while they have it open.
_OPEN_ELSEWHERE = ("~${}", ".~lock.{}#")


@dataclass
class WorkbookChange:
    """A workbook that is being changed, and files to write next to it, by name."""

    book: OpenBook
    files: dict[str, bytes] = field(default_factory=dict)
    before: OpenBook = field(init=False)
    written: set[CellPosition] = field(default_factory=set)
    # What `fill_in` will fill in, and why it may not: cells that are filled already.
    cells: dict[CellPosition, Value] = field(default_factory=dict)
    refusals: dict[str, list[tuple[str, str]]] = field(default_factory=dict)
    tables: dict[str, TableFound] = field(default_factory=dict)
    next_rows: dict[str, int] = field(default_factory=dict)  # free ones of tables with new rows

    def __post_init__(self) -> None:
        self.before = self.book

    def fill(self, cells: Mapping[CellPosition, Value]) -> None:
        """Change cells; raises as `filled`."""
        self.book = filled(self.book, cells)
        self.written |= cells.keys()
        self.tables.clear()
        self.next_rows.clear()

    def fill_in(self, *, replace: bool) -> None:
        """Change the cells that were put.

        Raises `InputError` for those that were filled already, unless they may be replaced.
        """
        if self.refusals and not replace:
            raise InputError(
                [
                    Problem(
                        f"the {noun} of {joined(list(dict.fromkeys(owners)))} is already filled in",
                        "use --replace to overwrite it",
                        listed(addresses),
                    )
                    for noun, noted in self.refusals.items()
                    for addresses, owners in [zip(*noted, strict=True)]
                ]
            )
        self.fill(self.cells)
        self.cells, self.refusals = {}, {}

    def refuse(self, key: str, row: int, name: str, noun: str, owner: str) -> None:
        """Note that a field of a row is filled already, such as the location of A1."""
        self.refuse_cell(self.position(key, row, name), noun, owner)

    def refuse_cell(self, position: CellPosition, noun: str, owner: str) -> None:
        """Note that a cell is filled already."""
        self.refusals.setdefault(noun, []).append((position.address, owner))

    def put(self, key: str, row: int, values: Mapping[str, Value]) -> None:
        """Note values of a row of a table, by field, for `fill_in`."""
        self.cells |= {self.position(key, row, name): value for name, value in values.items()}

    def table(self, key: str) -> TableFound:
        """Return a table by the key of its section."""
        if key not in self.tables:
            self.tables[key] = find_table(self.book, SECTION[key])
        return self.tables[key]

    def position(self, key: str, row: int, name: str) -> CellPosition:
        """Return the position of a field of a row of a table."""
        table = self.table(key)
        if name not in table.columns:
            label = SECTION[key].entry(name).heading
            raise InputError(f"{table.heading.address}: heading '{label}' is missing; {FRESH}")
        return CellPosition(table.heading.sheet, row, table.columns[name].number)

    def cell(self, key: str, row: int, name: str) -> Found:
        """Return a cell of a row of a table as it is in the workbook."""
        return found_at(self.book, self.position(key, row, name))

    def number(self, key: str, name: str, value_si: float) -> float:
        """Return a value in the unit of a column."""
        # Without the rounding of the conversion: 12 in, not 11.999999999999998.
        return round(value_si / self.table(key).columns[name].si, DIGITS)

    def rows(self, key: str, name: str, value: str) -> list[int]:
        """Return the rows of a table whose field is a text."""
        return [
            row
            for row in self.table(key).rows
            if unescape(self.cell(key, row, name).shown).strip().casefold() == value.casefold()
        ]

    def added_row(self, key: str) -> int:
        """Return the next free row of a table."""
        table = self.table(key)
        top = table.heading.row
        if key not in self.next_rows:
            filled_rows = [
                row
                for row in table.rows
                if not all(self.cell(key, row, name).is_blank for name in table.columns)
            ]
            # Below the last one: blank rows between others may be meant to be there.
            self.next_rows[key] = max(filled_rows, default=top) + 1
        row = self.next_rows[key]
        self.next_rows[key] += 1
        area = table_area(self.book, SECTION[key])
        if area and area.last < row <= area.totals:
            raise InputError(
                f"{table.heading.sheet}!{area.totals}: the table has a totals row with no blank"
                " row above it; delete the totals row, or insert rows above it"
            )
        if row > top + MAX_ROWS:
            limit = f"the {MAX_ROWS} that a table may have"
            raise InputError(f"{table.heading.address}: more rows are needed than {limit}")
        return row

    def note(self, cells: Mapping[CellPosition, Value]) -> None:
        """Change cells that no formula refers to."""
        self.book = book_of(self.book.path, changed(self.book.data, cells, recalculates=False))

    @cached_property
    def sheet_before(self) -> Sheet:
        """The data read from the workbook before the change."""
        return read_book(self.before)

    @property
    def areas(self) -> str:
        """The cells that were written, by runs of rows: `Arrays!A7:W9, Outlines!A8:D19`."""
        ranges = []
        for sheet in self.book.scans:
            cells = [position for position in self.written if position.sheet == sheet]
            rows = sorted({position.row for position in cells})
            starts = [row for row in rows if row - 1 not in rows]
            ends = [row for row in rows if row + 1 not in rows]
            for start, end in zip(starts, ends, strict=True):
                columns = [position.column for position in cells if start <= position.row <= end]
                first = CellPosition(sheet, start, min(columns))
                last = CellPosition(sheet, end, max(columns))
                ranges.append(first.address + (f":{last.cell}" if last != first else ""))
        return ", ".join(ranges)

    @property
    def has_formulas(self) -> bool:
        """Whether it has formulas, whose cached values stay."""
        return any(scan.formulas for scan in self.book.scans.values())


@contextmanager
def changing(source: Path, *, keeps_copy: bool = True) -> Iterator[WorkbookChange]:
    """Provide a workbook to change, once no other command is changing it; write it at the end. It
    and the files next to it are written together, with `NAME.before.xlsx`, the workbook as it was,
    unless no copy is kept; nothing is written if the work on it fails, or changes nothing.

    Raises `InputError` if the workbook cannot be read or written, or a program has it open.
    """
    # A workbook that is a link is changed where it lies: to replace the link would leave two
    # workbooks.
    path = Path(os.path.realpath(source)) if source.is_file() else located(source)
    check_plain(path, path.parent)
    # Read only within the lock: what another command wrote before it is kept.
    with locked(path.parent):
        for pattern in _OPEN_ELSEWHERE:
            if os.path.lexists(lock := path.with_name(pattern.format(path.name))):
                raise InputError(
                    f"{lock} exists, so a program has the workbook open; close it there, or"
                    " delete this file if no program has it open"
                )
        change = WorkbookChange(open_book(path))
        yield change
        # A command that changes nothing leaves the file, its time and the copy as they are.
        if change.files or change.book.data != change.before.data:
            # The workbook goes last: where its cells name a file or the copy is asked for, these
            # are there.
            copy = {f"{path.stem}{BEFORE}": change.before.data} if keeps_copy else {}
            write_all({**change.files, **copy, path.name: change.book.data}, path.parent)


def filled(book: OpenBook, cells: Mapping[CellPosition, Value]) -> OpenBook:
    """Return a workbook with other contents of cells, formulas in new rows; raises as `changed`."""
    if not cells:
        return book
    # Formulas that may refer to the cells lose their values.
    after = book_of(book.path, changed(book.data, cells, _dependents(book, cells.keys())))
    looks = dict(_grown(book, after))
    # Excel gives the rows that a table has grown by their formulas only where they are typed.
    formulas = {}
    for position, last in looks.items():
        formula = book.formula(last.sheet, last.cell)
        if formula and is_answer(book.book[last.sheet].cell(last.row, last.column)):
            formulas[position] = Formula(
                Translator(formula, last.cell).translate_formula(position.cell)
            )
    return book_of(book.path, changed(after.data, formulas, looks=looks)) if looks else after


def _grown(before: OpenBook, after: OpenBook) -> Iterator[tuple[CellPosition, CellPosition]]:
    """Yield the cells of the rows that each table has grown by, with those of its last row."""
    for section in (section for section in SECTIONS if section.is_table):
        was, after_area = table_area(before, section), table_area(after, section)
        if was is None or after_area is None:
            continue
        for heading in was.headings.values():
            last = replace(heading, row=was.last)
            for row in range(was.last + 1, after_area.last + 1):
                yield replace(heading, row=row), last


def _dependents(book: OpenBook, cells: Set[CellPosition]) -> Set[CellPosition]:
    """Return the formulas that may refer to cells, also by other formulas."""
    areas = {}
    for title, scan in book.scans.items():
        for cell in scan.formulas:
            position = CellPosition(title, *coordinate_to_tuple(cell))
            areas[position] = [
                _area(reference, title) for reference in references(scan.formula(cell))
            ]
    titles, dependents = {title.casefold() for title in book.scans}, set(cells)

    def may_refer(title: str, bounds: tuple[int, int, int, int] | None) -> bool:
        if bounds is None or title not in titles:  # a name, a column of a table, other files
            return True
        left, top, right, bottom = bounds
        return any(
            left <= position.column <= right and top <= position.row <= bottom
            for position in places[title]
        )

    places: Mapping[str, list[CellPosition]]
    added: Set[CellPosition] = cells
    while added:
        # What refers to the others is found already.
        places = defaultdict(list, grouped_by(added, lambda position: position.sheet.casefold()))
        added = {
            position
            for position in areas
            if position not in dependents and any(starmap(may_refer, areas[position]))
        }
        dependents |= added
    # What is written itself has its value.
    return dependents - cells


def _area(reference: str, title: str) -> tuple[str, tuple[int, int, int, int] | None]:
    """Return the sheet of a reference, if its own is another, and its bounds where it has any."""
    name, _, cells = reference.rpartition("!")
    named = name.removeprefix("'").removesuffix("'").replace("''", "'")
    return (named or title).casefold(), bounds_of(cells)


def withdrawn(change: WorkbookChange) -> list[str]:
    """Clear the confirmation of the distances from the drawing if they changed; report it."""
    before = change.sheet_before
    row = before.inputs["project"][0] if before.inputs["project"] else {}
    fields = ("drawing_confirmed_by", "drawing_confirmed_date", "drawing_covered")
    stated = {Place("project", 0, field): row[field] for field in fields if row.get(field)}
    # As they are read, not as cells: rows that were sorted, or the same distance in another unit,
    # are the same distances.
    if not stated or _drawn(before) == _drawn(read_book(change.book)):
        return []
    emptied = cells(before, dict.fromkeys(stated))
    change.fill(emptied)
    where = ", ".join(position.address for position in emptied)
    by = ", ".join(str(value) for value in [*stated.values()][:2])
    return [
        f"{where}: 'Drawing distances confirmed by {by}' was cleared: distances from the drawing"
        " have changed; confirm them again"
    ]


def _drawn(sheet: Sheet) -> list[InputRow]:
    rows = sheet.inputs["clearances"]
    return [row for row in rows if row.get("source") is ClearanceSource.DRAWING]


_COMPUTED = re.compile(r":|\b(?:INDIRECT|OFFSET|TABLE)\b", re.IGNORECASE)


# The rows of a table have the same formula.
@lru_cache(maxsize=1024)
def references(formula: str) -> Sequence[str]:
    """Return the cells and names that a formula refers to; one is empty where it computes some."""
    try:
        tokens: Sequence[Token] = Tokenizer(formula).items
    except (TokenizerError, IndexError):  # the second of a bracket that closes nothing
        return [""]
    # A colon among the operators joins the results of functions, as A1:INDEX(…) does: which cells
    # it spans is known to Excel alone.
    operators = "".join(token.value for token in tokens if token.type != Token.OPERAND)
    if not tokens or _COMPUTED.search(operators):
        return [""]
    return [token.value for token in tokens if token.subtype == Token.RANGE]
