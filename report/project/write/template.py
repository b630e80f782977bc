"""Writes the input workbook from its sections, blank or filled in.

`grids` writes blocks and tables, `style` defines their appearance, `answer_columns` the formulas.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path

from openpyxl import Workbook

from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.read.read import read
from report.project.workbook import SECTIONS
from report.project.workbook.entries import SheetSection
from report.project.workbook.layout import TablePlace, Tables
from report.project.write import style
from report.project.write.grids import write_answers, write_block, write_table
from report.project.write.lookups import write_lookups
from report.project.write.provisions_sheet import write_rules
from report.project.write.start_sheet import RARE, START, write_start
from solver.file_writing import write_whole


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
    sections: Sequence[SheetSection], first_sheet: str, units: UnitsFirst, example: object
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
            write_block(book, section, sections, units, example)
    for place in tables.values():
        write_answers(book, tables, place, is_us=units.is_us)
    return book, tables


def saved(book: Workbook, units: UnitsFirst) -> bytes:
    """Set up the pages of a finished book and return it; programs compute it when they open it."""
    for sheet in book.worksheets:
        style.finish(sheet, units.is_us)
    # openpyxl writes formulas without values: no program may show them as they are.
    book.calculation.fullCalcOnLoad = True
    buffer = io.BytesIO()
    book.save(buffer)
    return buffer.getvalue()


def mark_sheets(book: Workbook, example: object) -> None:
    """Color the tab of each worksheet by its need; hide seldom-used empty ones."""
    for sheet in book.worksheets:
        sections = [section for section in SECTIONS if section.sheet == sheet.title]
        fill = style.OPTIONAL_FILL if sections else style.HELP_FILL
        if any(section.is_needed for section in sections):
            fill = style.REQUIRED_FILL
        if sheet.title in RARE:
            fill = style.RARE_FILL
            if not any(getattr(example, section.key, ()) for section in sections):
                sheet.sheet_state = "hidden"
        sheet.sheet_properties.tabColor = fill.start_color.rgb


_REPORT = Path(__file__).resolve().parents[2]
_HOMES = (_REPORT / "web" / "example", _REPORT.parent / "projects" / "example")
# Within the package where it is installed, or of the checkout.
EXAMPLE = next(path for path in _HOMES if path.is_dir())


def example_files(units: UnitsFirst) -> dict[str, bytes]:
    """Return records/ and documents/ as shipped, and input.xlsx in a system of units, by name."""
    paths = (*sorted((EXAMPLE / "records").iterdir()), *sorted((EXAMPLE / "documents").iterdir()))
    files = {f"{path.parent.name}/{path.name}": path.read_bytes() for path in paths}
    project = read(EXAMPLE).project
    issue = project.project.model_copy(update={"units_first": units})
    example = project.model_copy(update={"project": issue})
    return files | {"input.xlsx": template(units, example)}
