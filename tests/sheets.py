"""A small project with its records, and helpers to change its workbook, for the input tests."""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import BinaryIO
from zipfile import ZipFile

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.cell import Cell
from openpyxl.utils import coordinate_to_tuple

from cells import address, addressed, cell
from report.motions.prepare import Shaking, prepare
from report.sheet.parts import changed
from report.sheet.positions import CellPosition
from report.sheet.read import Sheet, read
from report.sheet.schema import ProjectInput, UnitsFirst
from report.sheet.template import write_template
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


FT, INCH, LB = 0.3048, 0.0254, 4.4482216152605


def project(**changes: object) -> ProjectInput:
    """Return a complete input: two arrays, five objects, six clearances, three motions."""
    parts: dict[str, object] = {
        "project": {
            "name": "Alameda Warehouse",
            "number": "007",
            "client": "Harbor Logistics",
            "address": "1200 Alameda St",
            "prepared_by": "RG",
            "checked_by": "MT",
            "date": dt.date(2026, 3, 5),
            "revision": "1",
            "units_first": "US",
        },
        "revisions": [
            {"revision": "0", "date": dt.date(2026, 1, 5), "description": "Draft", "by": "RG"},
            {"revision": "1", "date": dt.date(2026, 3, 5), "description": "Permit"},
        ],
        "site": {
            "rule_set": "SEAOC PV1-2012",
            "risk_category": "II",
            "i_e": 1.0,
            "s_1_g": 0.7,
            "site_class": "D",
            "s_ds_g": 1.566,
            "sdc": "D",
            "stories": 1,
            "structure_height_m": 36 * FT,
            "roof_height_m": 36 * FT,
        },
        "arrays": [
            _array("A1", 20, 100, 0.5, "degrees"),
            _array("A2", 110, 200, 3.5, "percent"),
        ],
        "objects": [
            _object("RTU-1", "fixed object", 42, (130, 140, 80, 90)),
            _object("OLD", "unlike array", None, None),
            _object("N", "edge with parapet", 36, (0, 300, 120, 121)),
            _object("S", "edge without parapet", None, (0, 300, -1, 0)),
        ],
        "clearances": [
            _clearance("A1", "A2", "across", 120),
            _clearance("A1", "S", "down", 180),
            _clearance("A2", "RTU-1", "any", 60),
            _clearance("A2", "OLD", "any", 400),
            _clearance("A2", "N", "up", 540),
        ],
        "motions": [
            _motion("M1", vertical="records/z.csv", source="made"),
            _motion("M2", "x2", scaling="factor", scale_value=2.0, polarity="reversed"),
            _motion("M3", "x3", scaling="PPA", scale_value=1.5, polarity="as recorded", dt_s=0.02),
        ],
        "options": {"statistic": "1.1 x mean", "peer_reviewed": True},
        "overrides": [
            {"provision": "parapet_height_in", "value": 18.0, "reason": "Agreed 2026-02-10"}
        ],
    }
    return ProjectInput(**(parts | changes))


def _array(name: str, x_from: float, x_to: float, slope: float, unit: str) -> dict[str, object]:
    return {
        "id": name,
        "slope_value": slope,
        "slope_unit": unit,
        "mu": 0.45,
        "mu_report": "Lab 12",
        "construction": "Tray 10 deg",
        "weight_n": 42000 * LB,
        "cg_height_m": 9 * INCH,
        "support_spacing_m": 40 * INCH,
        "x_from_m": x_from * FT,
        "x_to_m": x_to * FT,
        "y_from_m": 15 * FT,
        "y_to_m": 75 * FT,
        "downslope_deg": 270.0,
    }


def _object(
    name: str, kind: str, height: float | None, sides: tuple[float, ...] | None
) -> dict[str, object]:
    names = ("x_from_m", "x_to_m", "y_from_m", "y_to_m")
    rectangle = dict(zip(names, (side * FT for side in sides), strict=True)) if sides else {}
    return {"id": name, "kind": kind, "height_m": height and height * INCH, **rectangle}


def _clearance(array: str, other: str, direction: str, provided: float) -> dict[str, object]:
    return {
        "array": array,
        "object": other,
        "direction": direction,
        "provided_m": provided * INCH,
    }


def _motion(name: str, record: str = "x", **changes: object) -> dict[str, object]:
    return {"id": name, "record": f"records/{record}.csv", "units": "g", "dt_s": 0.01, **changes}


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
    table.tableColumns[head.column - 1].name = text


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
    """Return lines with the addresses of the cells of `make` that they name."""
    return tuple(map(at, lines))


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
        return not value.startswith(("=", "#"))
    return value is None or type(value) in (int, float)


def problems(path: Path) -> tuple[str, ...]:
    """Return the problems that the reader reports for a workbook."""
    with pytest.raises(InputError) as caught:
        read_workbook(path)
    return caught.value.problems


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
