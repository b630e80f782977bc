"""Reads an input workbook: every value with its cell, or every error with its cell.

Combines opening (`archive`), finding (`locate`), converting (`cells`) and checking (`checks`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from openpyxl.utils import coordinate_to_tuple

from report.project.check.faults import faults
from report.project.model import ProjectInput
from report.project.model.finding import Finding
from report.project.model.input_rows import Inputs, Place, Where
from report.project.read.archive import OpenBook, open_book
from report.project.read.cells import (
    CellError,
    Found,
    as_used,
    blank_value,
    read_cell,
    stated_unit,
    wish_for_missing,
)
from report.project.read.documents import read_documents
from report.project.read.locate import (
    FieldColumn,
    added_later,
    beside,
    cell_as_column,
    find_cell,
    find_table,
    gone_cells,
    is_absent,
)
from report.project.read.positions import FRESH, CellPosition, found_at
from report.project.read.unseen import (
    by_cell,
    copies,
    from_outside,
    not_calculated,
    over_example,
    unseen,
)
from report.project.read.workbook_data import (
    IGNORED,
    EchoRow,
    Sheet,
    SheetOf,
    Whole,
    located_problems,
    where,
)
from report.project.workbook import SECTION, SECTIONS
from report.project.workbook.earlier_workbooks import GoneInput
from report.project.workbook.entries import Entry, SheetSection
from report.text.command_line import quoted
from report.text.letter_case import lowered
from report.text.typed_letters import cut, trimmed
from solver.errors import InputError, Problem

# Sheet of a workbook that `roofslip study` reads.
_STUDY = "Study"


def read(path: Path) -> Sheet:
    """Read the input workbook at a path, or `input.xlsx` in a folder; raises as `read_book`."""
    return read_book(open_book(path))


def read_book(book: OpenBook) -> Sheet:
    """Read an input workbook; run nothing.

    Raises `InputError` if there is no workbook to read. `Sheet.project` raises the errors within
    it, and `report.motions.prepare` those together with the errors of its records.
    """
    if _STUDY in book.scans and SECTIONS[0].sheet not in book.scans:
        run = f"roofslip study {quoted(book.path)}"
        raise InputError(f"{_STUDY}: this is the workbook of a study; run {run}")
    sheet = read_as(ProjectInput, SECTIONS, book, faults)
    if sheet.unfound >= {"project", "site"}:
        raise InputError(
            "not an input workbook: the worksheets Project and Site are missing; use input.xlsx,"
            " or a new workbook (roofslip new FOLDER)"
        )
    documents, wrong = read_documents(book, sheet.inputs)
    problems = (*sheet.problems, *located_problems(wrong, sheet.addresses, sheet.unfound))
    return replace(sheet, documents=documents, problems=problems)


def without_motions(sheet: Sheet) -> ProjectInput:
    """Return the input regardless of its motions; its clearances may contradict the plan."""
    fields, rows = len(SECTION["clearances"].entries), sheet.inputs["clearances"]
    # A contradiction has all of its cells.
    passed = {"motions"} | ({"clearances"} if all(len(row) == fields for row in rows) else set())
    problems = (
        (place, problem)
        for place, problem in sheet.problems
        if place.section not in passed or place == Place("clearances")  # of its headings
    )
    inputs = {**sheet.inputs, "motions": ()}
    return replace(sheet, inputs=inputs, problems=tuple(problems)).project


def read_as(
    model: type[Whole],
    sections: tuple[SheetSection, ...],
    book: OpenBook,
    check: Callable[[Inputs, Where], Iterable[Finding]],
) -> SheetOf[Whole]:
    """Read every field of a whole input, with the errors of single cells and those of a check."""
    gathered = Gathered()
    for section in sections:
        # A rare sheet that was never added: its inputs have their defaults.
        if section.may_be_absent and is_absent(book, section):
            defaults = {entry.name: entry.default for entry in section.entries}
            gathered.inputs[section.key] = [] if section.is_table else [defaults]
            continue
        gathered.inputs[section.key] = []
        try:
            if section.is_table:
                _read_table(book, section, gathered)
            else:
                _read_block(book, section, gathered)
        except InputError as error:
            # Faults that only follow from the missing table are left out (`located_problems`):
            # without Arrays every clearance would name an unknown one.
            gathered.unfound.add(section.key)
            gathered.add(Place(section.key), error.parts)
    # Also where cells could not be read: every error is told at once.
    gathered.take(check(gathered.inputs, partial(where, gathered.addresses)))
    hidden = unseen(book, gathered.used)
    marks, titles = by_cell(hidden), book.book.sheetnames
    return SheetOf(
        path=book.path,
        sha256=book.sha256,
        book=book,
        whole=model,
        sections=sections,
        check=check,
        inputs=gathered.inputs,
        echo=tuple(
            replace(row, unseen=marks.get(row.address, ""))
            # In the order of the sheets and rows, wherever a user has moved them.
            for row in sorted(
                gathered.echo,
                key=lambda row: (titles.index(row.sheet), coordinate_to_tuple(row.cell)[0]),
            )
        ),
        problems=tuple(gathered.problems),
        addresses=gathered.addresses,
        unfound=frozenset(gathered.unfound),
        unseen=hidden,
        warnings=(
            *gathered.warnings,
            *copies(book, sections, gathered.addresses),
            *not_calculated(book, gathered.used, Place(sections[0].key)),
            *from_outside(book, Place(sections[0].key)),
        ),
    )


@dataclass(slots=True)
class Gathered:
    """The input read so far; problems have the place used for sorting."""

    inputs: dict[str, list[dict[str, Any]]] = field(default_factory=dict)
    echo: list[EchoRow] = field(default_factory=list)
    problems: list[tuple[Place, Problem]] = field(default_factory=list)
    addresses: dict[Place, str] = field(default_factory=dict)
    unfound: set[str] = field(default_factory=set)
    used: list[tuple[Place, Found]] = field(default_factory=list)
    warnings: list[Finding] = field(default_factory=list)

    def use(self, place: Place, cell: Found) -> None:
        """Note that the content of a cell is read."""
        if not cell.is_blank:
            self.used.append((place, cell))

    def add(self, place: Place, problems: Iterable[Problem]) -> None:
        """Add problems of a place."""
        self.problems += [(place, problem) for problem in problems]

    def take(self, faults: Iterable[Finding]) -> None:
        """Add faults."""
        self.problems += located_problems(faults, self.addresses, self.unfound)


def _read_block(book: OpenBook, section: SheetSection, gathered: Gathered) -> None:
    if is_absent(book, section):
        raise InputError(
            f"{section.sheet}: the worksheet is missing, or all labels of {section.title}; {FRESH}"
        )
    absent = added_later(book, section)
    row = {entry.name: entry.default for entry in absent}
    typed = beside(book, section)
    gathered.inputs[section.key].append(row)
    cells_read: list[_Typed] = []
    for entry in section.entries:
        if entry in absent:
            continue
        place = Place(section.key, 0, entry.name)
        try:
            position = find_cell(book, section, entry)
            gathered.addresses[place] = position.address
            column = cell_as_column(book, section, entry, position)
        except InputError as error:
            gathered.add(place, error.parts)
            continue
        # A row that was copied has its label twice: nobody knows which value is meant.
        for labeled in typed.get(entry.name, ()):
            if labeled != position and labeled.column == position.column:
                twice = f"label '{entry.heading}' appears twice, also in {labeled.address}"
                gathered.add(place, [Problem(twice, "keep one", position.address)])
        cell = found_at(book, position)
        # The cell of the unit is read with the value, and must be in sight as it.
        if not cell.is_blank and column.heading != position:
            gathered.use(place, found_at(book, column.heading))
        cells_read.append(_Typed(entry, place, cell, column))
    for gone, position in gone_cells(book, section):
        _refuse_gone(gone, Place(section.key), found_at(book, position), gathered)
    # What a blank cell is computed from must have been read.
    for typed_cell in sorted(cells_read, key=lambda typed_cell: typed_cell.is_computed):
        _read_field(typed_cell, row, {}, gathered)


def _refuse_gone(gone: GoneInput, place: Place, cell: Found, gathered: Gathered) -> None:
    """Add a problem for an input that no longer exists, unless its cell has no effect."""
    answer = trimmed(cell.shown)
    if not cell.is_blank and answer.casefold() not in gone.defaults:
        text = f"{lowered(gone.label)} is '{cut(answer)}'"
        gathered.add(place, [Problem(text, gone.remedy, cell.address)])


def _read_table(book: OpenBook, section: SheetSection, gathered: Gathered) -> None:
    table = find_table(book, section)
    gathered.addresses[Place(section.key)] = table.heading.address
    gathered.add(Place(section.key), table.problems)
    for heading in table.others:
        label = f"column '{found_at(book, heading).shown}'"
        ignored = EchoRow(
            sheet=heading.sheet, cell=heading.cell, label=label, typed="", unit="", value=IGNORED
        )
        gathered.echo.append(ignored)
    headings = {name: column.heading for name, column in table.columns.items()}
    gathered.warnings += over_example(book, section, headings) if headings else ()
    sheet = table.heading.sheet
    for number in table.rows:
        cells = {
            name: found_at(book, CellPosition(sheet, number, column.number))
            for name, column in table.columns.items()
        }
        # Blank rows are passed over, within a table as well: people leave them between groups.
        if not all(cell.is_empty for cell in cells.values()):
            rows = gathered.inputs[section.key]
            row = {name: section.entry(name).default for name in table.absent}
            # Before its cells are read: a row with an unreadable cell has its place, and the
            # others keep theirs.
            rows.append(row)
            for entry in section.entries:
                if cell := cells.get(entry.name):
                    place = Place(section.key, len(rows) - 1, entry.name)
                    gathered.addresses[place] = cell.address
                    typed = _Typed(entry, place, cell, table.columns[entry.name])
                    _read_field(typed, row, cells, gathered)
        for gone, heading in table.gone:
            position = CellPosition(sheet, number, heading.column)
            _refuse_gone(gone, Place(section.key), found_at(book, position), gathered)
    # A heading states the unit of its column: it is read with the values, and must be in sight as
    # they.
    read = {place.field for place, _ in gathered.used if place.section == section.key}
    for name, column in table.columns.items():
        if name in read:
            gathered.use(Place(section.key), found_at(book, column.heading))


@dataclass(frozen=True, slots=True)
class _Typed:
    """The typed value of an input, and its unit."""

    entry: Entry
    place: Place
    cell: Found
    column: FieldColumn

    @property
    def is_computed(self) -> bool:
        """Whether a blank cell is computed from other inputs."""
        return self.cell.is_empty and self.entry.computed is not None


def _read_field(
    typed: _Typed, row: dict[str, Any], cells: Mapping[str, Found], gathered: Gathered
) -> None:
    """Read an input into its row of values; `cells` are those of the row by field."""
    entry, place, cell, column = typed.entry, typed.place, typed.cell, typed.column
    gathered.use(place, cell)
    try:
        if not cell.is_empty:
            stated = stated_unit(entry, row, cells)
            value = read_cell(cell, entry, column.unit, column.si, stated)
        elif entry.is_required:
            raise CellError("is missing", wish_for_missing(entry, column.unit, column.si))
        else:
            value = blank_value(entry, row)
    except CellError as error:
        gathered.add(place, [error.parts[0].at(cell.address, entry.spoken)])
        return
    row[entry.name] = value
    value_text = as_used(value, entry, column.unit)
    if cell.is_empty and value_text:
        computed = f"computed, {entry.rule}" if entry.rule else "computed"
        value_text += f" ({'default' if value == entry.default else computed})"
    echoed = EchoRow(
        sheet=cell.sheet,
        cell=cell.cell,
        label=entry.heading,
        typed=cell.text,
        unit=column.unit,
        value=value_text or "—",
    )
    gathered.echo.append(echoed)
