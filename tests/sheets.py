"""A small project with its records, and helpers to change its workbook, for the input tests."""

from __future__ import annotations

import datetime as dt
import math
import re
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import BinaryIO
from zipfile import ZipFile

import pytest
from lxml import etree
from openpyxl import Workbook, load_workbook
from openpyxl.cell import Cell
from openpyxl.utils import coordinate_to_tuple, range_boundaries

import inputs
from cells import address, addressed, cell
from inputs import FT, INCH, clearance, motion, roof_object
from places import DATA, ROOT
from report.assessment.precheck import findings
from report.motions.prepare import Shaking, prepare
from report.project.check.findings import located
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.read.parts import changed
from report.project.read.positions import CellPosition
from report.project.read.read import Sheet, read
from report.project.write.template import write_template
from solver.model import InputError


@dataclass(frozen=True)
class Book:
    """A workbook and its motions."""

    sheet: Sheet
    shaking: Shaking

    @property
    def input(self) -> ProjectInput:
        """The input of the workbook."""
        return self.sheet.project

    def having(self, **changes: object) -> Book:
        """Return the book with other motions, records or processing."""
        return Book(self.sheet, replace(self.shaking, **changes))  # type: ignore[arg-type]

    def __getattr__(self, name: str) -> object:
        return getattr(self.shaking if hasattr(self.shaking, name) else self.sheet, name)


def read_workbook(path: Path) -> Book:
    """Read a workbook and the records that it names."""
    sheet = read(path)
    return Book(sheet, prepare(sheet))


def project(**changes: object) -> ProjectInput:
    """Return a complete input: two arrays, four objects, five clearances, three motions."""
    return inputs.project(**SECTIONS | changes)


SECTIONS = {
    "project": inputs.HEAD | {"number": "007", "checked_by": "MT", "revision": "1"},
    "revisions": [
        {"revision": "0", "date": dt.date(2026, 1, 5), "description": "Draft", "by": "RG"},
        {"revision": "1", "date": dt.date(2026, 3, 5), "description": "Permit"},
    ],
    "arrays": [
        inputs.array("A1", 0.5),
        inputs.array("A2", 3.5, x=110, x_to_m=200 * FT, slope_unit="percent"),
    ],
    "objects": [
        roof_object("RTU-1", "fixed object", 130, 140, 80, 90, height=42 * INCH),
        roof_object("OLD", "unlike array"),
        roof_object("N", "edge with parapet", 0, 300, 120, 121, height=36 * INCH),
        roof_object("S", "edge without parapet", 0, 300, -1, 0),
    ],
    "clearances": [
        clearance("A1", "A2", 120 * INCH, "across"),
        clearance("A1", "S", 180 * INCH, "down"),
        clearance("A2", "RTU-1", 60 * INCH),
        clearance("A2", "OLD", 400 * INCH),
        clearance("A2", "N", 540 * INCH, "up"),
    ],
    "motions": [
        motion("M1", dt_s=0.01, vertical="records/z.csv", source="made"),
        motion("M2", "x2", dt_s=0.01, scaling="factor", scale_value=2.0, polarity="reversed"),
        motion("M3", "x3", dt_s=0.02, scaling="PPA", scale_value=1.5, polarity="as recorded"),
    ],
    "options": {"statistic": "1.1 x mean", "peer_reviewed": True},
    "overrides": [{"provision": "parapet_height_in", "value": 18.0, "reason": "Agreed 2026-02-10"}],
}


def site(**changes: object) -> dict[str, object]:
    """Return the site of the project with changes."""
    return project().site.model_dump() | changes


def row_changed(section: str, index: int | None, **changes: object) -> ProjectInput:
    """Return the project with one row of a section changed; with no index, the section itself."""
    rows = project().model_dump()[section]
    if index is None:
        return project(**{section: rows | changes})
    rows = [dict(row) for row in rows]
    rows[index] |= changes
    return project(**{section: rows})


WAVES = (("x", 0.5, 0.3), ("x2", 0.5, 0.31), ("x3", 0.5, 0.32), ("z", 0.25, 0.3))
"""Records of the project: name, peak [g], angle from one sample to the next [rad]."""


def make(folder: Path, units: UnitsFirst = UnitsFirst.US, **changes: object) -> Path:
    """Write the project's workbook and records into a folder; return the workbook."""
    records = folder / "records"
    records.mkdir(parents=True, exist_ok=True)
    for name, peak, per_step in WAVES:
        samples = (peak * math.sin(per_step * i) for i in range(200))
        text = "".join(f"{sample:.6f}\n" for sample in samples)
        (records / f"{name}.csv").write_text(text)
    path = folder / "input.xlsx"
    path.write_bytes(_book(units, project(**changes)))
    return path


def saved_by_libreoffice(folder: Path) -> Path:
    """Write the project as LibreOffice saved it, with two formulas and their values."""
    path = make(folder)
    path.write_bytes((DATA / "saved-by-libreoffice.xlsx").read_bytes())
    # A cell was written since, so that it asks to be calculated when it is opened.
    return type_into(path, {"Motions/M2/Horizontal record": "records/x2.csv"})


def blank(path: Path, units: UnitsFirst = UnitsFirst.US) -> Path:
    """Write a workbook without inputs; return it."""
    path.write_bytes(_book(units, None))
    return path


@cache
def _book(units: UnitsFirst, example: ProjectInput | None) -> bytes:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "input.xlsx"
        write_template(path, units=units, example=example)
        return path.read_bytes()


def arrays(**changes: object) -> list[dict[str, object]]:
    """Return the arrays of the project, the first with changes."""
    first, second = (array.model_dump() for array in project().arrays)
    return [first | changes, second]


def parts(path: Path | BinaryIO) -> dict[str, bytes]:
    """Return the parts of a workbook by name."""
    with ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def different(before: Mapping[str, bytes], after: Mapping[str, bytes]) -> set[str]:
    """Return the parts that hold something else, whatever their XML looks like."""
    assert before.keys() == after.keys()
    return {name for name in before if _in_one_form(before[name]) != _in_one_form(after[name])}


def _in_one_form(part: bytes) -> bytes:
    return etree.tostring(etree.fromstring(part), method="c14n") if part[:1] == b"<" else part


def pack(path: Path, parts: Mapping[str, bytes]) -> Path:
    """Write a workbook of these parts."""
    with ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return path


def edit(path: Path, change: Callable[[Workbook], object]) -> Path:
    """Change a workbook in place."""
    book = load_workbook(path)
    change(book)
    book.save(path)
    return path


def formula_cells(book: Workbook) -> list[Cell]:
    """Return the cells that have formulas."""
    return [c for sheet in book for row in sheet for c in row if c.data_type == "f"]


def retitle(book: Workbook, sheet: str, heading: str, text: str) -> None:
    """Write another heading, as Excel does in the table as well."""
    head = cell(book, f"{sheet}/heading/{heading}")
    head.value = text
    (table,) = book[sheet].tables.values()
    left, *_ = range_boundaries(table.ref)
    table.tableColumns[head.column - left].name = text


def type_into(path: Path, cells: Mapping[str, object]) -> Path:
    """Type values into cells, given as `Arrays/A1/Slope` or as `Sheet!A1`, in place.

    Plain values change in the parts of the file, which takes a tenth of a load and save.
    """
    content = path.read_bytes()
    cells = {address(content, name): value for name, value in cells.items()}
    if not all(map(_is_plain, cells.values())):
        return edit(path, lambda book: put(book, cells))
    changes = {_position(place): value for place, value in cells.items()}
    path.write_bytes(changed(content, changes))  # type: ignore[arg-type]
    return path


def without_motions(folder: Path) -> Path:
    """Copy the shipped example into a folder, the rows of its sheet Motions emptied, no record."""
    example = ROOT / "projects" / "example"
    shutil.copytree(example / "documents", folder / "documents")
    path = Path(shutil.copy(example / "input.xlsx", folder))
    cells = read(path).addresses.items()
    return type_into(
        path, {at: None for place, at in cells if place.section == "motions" and place.field}
    )


def of(row: str, values: Mapping[str, object]) -> dict[str, object]:
    """Return the values of a row such as `Motions/M1`, given by heading, for `type_into`."""
    return {f"{row}/{heading}": value for heading, value in values.items()}


def at(text: str) -> str:
    """Return the address of a cell of `make`, or a line with those that it names as `<Site/F_a>`.

    The rows and columns of a workbook without inputs are the same.
    """
    usual = _book(UnitsFirst.US, project())
    return addressed(usual, text) if "<" in text else address(usual, text)


def said(*lines: str) -> tuple[str, ...]:
    """Return lines with the addresses of the cells of `make` that they name.

    `Arrays/A1/Slope is 50` is short for `<Arrays/A1/Slope>: slope is 50`.
    """
    return tuple(at(_SHORT.sub(_with_label, line)) for line in lines)


_WORDS = r"(?:(?! is )[^<>/])+"
_SHORT = re.compile(rf"\A([A-Z][^<>/]*/(?:{_WORDS}/)?({_WORDS})) is ")


def _with_label(line: re.Match[str]) -> str:
    name, label = line.groups()
    spoken = label[0].lower() + label[1:] if label[1:2].islower() else label
    return f"<{name}>: {spoken} is "


def _position(place: str) -> CellPosition:
    sheet, coordinate = place.split("!")
    return CellPosition(sheet, *coordinate_to_tuple(coordinate))


def put(book: Workbook, cells: Mapping[str, object]) -> None:
    """Give cells of a workbook that is open their values, by name or as `Sheet!A1`."""
    for name, value in [(address(book, name), value) for name, value in cells.items()]:
        sheet, coordinate = name.split("!")
        book[sheet][coordinate] = value


def _is_plain(value: object) -> bool:
    """Whether a value is a blank, a number or a text that Excel stores as it is typed."""
    if isinstance(value, str):
        return not value.startswith(("=", "#")) and "_x" not in value
    return value is None or type(value) in (int, float)


def problems(path: Path) -> tuple[str, ...]:
    """Return the problems that the reader reports for a workbook."""
    with pytest.raises(InputError) as caught:
        read_workbook(path)
    return caught.value.problems


def told(path: Path) -> list[tuple[str, str, str]]:
    """Return name, cell and text of each warning and note on a workbook."""
    book = read_workbook(path)
    found = findings(book.sheet, book.shaking)
    cells = located(found, book.sheet.addresses)
    return [(f.id, cell, f.text) for f, cell in zip(found, cells, strict=True)]


def same(actual: ProjectInput, wanted: ProjectInput) -> bool:
    """Whether two inputs agree, numbers within the rounding error of a cell."""
    return _same(actual.model_dump(), wanted.model_dump())


def _same(a, b):
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_same(a[k], b[k]) for k in a)
    if isinstance(a, tuple | list):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9)
    return a == b
