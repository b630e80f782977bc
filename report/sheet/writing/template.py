"""Writes the input workbook from the schema, blank or filled in.

Owns the order of the sheets and what is on each; `grids` writes blocks and tables, `style` owns
their appearance, `answers` the formulas. The example comes with its records.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path

from openpyxl import Workbook

from report.sheet.reading.read import read
from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.fields import SheetSection
from report.sheet.schema.layout import TablePlace, Tables
from report.sheet.writing import style
from report.sheet.writing.grids import write_answers, write_block, write_table
from report.sheet.writing.lookups import write_lookups, write_rules
from report.sheet.writing.start import START, mark_sheets, write_start
from solver.files import write_whole


def write_template(path: Path, *, units: UnitsFirst, example: ProjectInput | None = None) -> None:
    """Write or replace an input workbook, which `template` returns."""
    write_whole(path, template(units, example))


def template(units: UnitsFirst, example: ProjectInput | None = None) -> bytes:
    """Return an input workbook, with the values of a project or blank but for defaults."""
    book, tables = book_of(SECTIONS, START, units, example)
    write_rules(book, tables)
    write_lookups(book, tables)
    write_start(book, tables, is_us=units.is_us)
    mark_sheets(book, example)
    return saved(book, units)


def book_of(
    sections: Iterable[SheetSection], first_sheet: str, units: UnitsFirst, example: object
) -> tuple[Workbook, Tables]:
    """Return a book with the blocks and tables of sections; without an example they are blank."""
    book = Workbook()
    tables: dict[str, TablePlace] = {}
    book.worksheets[0].title = first_sheet
    for section in sections:
        if section.sheet not in book.sheetnames:
            book.create_sheet(section.sheet)
        if section.is_table:
            rows = getattr(example, section.key, ())
            tables[section.key] = write_table(book, section, units, rows)
        else:
            write_block(book, section, units, example)
    for place in tables.values():
        write_answers(book, tables, place, is_us=units.is_us)
    return book, tables


def saved(book: Workbook, units: UnitsFirst) -> bytes:
    """Set up the pages of a finished book and return it; programs compute it when they open it."""
    for sheet in book.worksheets:
        style.finish(sheet, units.is_us)
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


_REPORT = Path(__file__).resolve().parents[2]
_HOMES = (_REPORT / "web" / "example", _REPORT.parent / "projects" / "example")
EXAMPLE = next(path for path in _HOMES if path.is_dir())
"""Within the package where it is installed, or of the checkout."""


def example_files(units: UnitsFirst) -> dict[str, bytes]:
    """Return records/, as they are shipped, and input.xlsx in a system of units, by their names."""
    records = sorted((EXAMPLE / "records").iterdir())
    files = {f"records/{path.name}": path.read_bytes() for path in records}
    project = read(EXAMPLE).project
    issue = project.project.model_copy(update={"units_first": units})
    example = project.model_copy(update={"project": issue})
    return files | {"input.xlsx": template(units, example)}
