"""Makes the campus: 30 arrays on both slopes of a roof, with three of the school's ground motions.

Site, friction tests, peer review and the records themselves are the school's, a building of the
same campus. Run from the repository root: .venv/bin/python projects/campus/make.py
"""

from __future__ import annotations

import datetime as dt
import shutil
from itertools import pairwise
from pathlib import Path
from runpy import run_path

from report.sheet.schema import ProjectInput, UnitsFirst
from report.sheet.writing.rows import Range, Row, clearance, issued, rectangle, roof_object
from report.sheet.writing.template import write_template

HERE = Path(__file__).resolve().parent
SCHOOL = run_path(str(HERE.parent / "school" / "make.py"))
COUNT = 3
COLUMNS, ROWS = 5, 6
WIDTH_M, DEPTH_M, LANE_M, SETBACK_M = 16.0, 7.2, 1.2, 2.4
ROOF_X, ROOF_Y, RIDGE_Y = (0.0, 94.4), (0.0, 60.0), 30.0
SHORT, SHORT_WIDTH_M = "A10", 12.0
"""The array that leaves room for a rooftop unit at its end."""
OLD_MEMBRANE = ("A9", "A10", "A24", "A25")


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    (HERE / "records").mkdir(exist_ok=True)
    for row in project().motions:
        for name in (row.record, row.transverse, row.vertical):
            shutil.copyfile(HERE.parent / "school" / name, HERE / name)
    write_template(HERE / "input.xlsx", units=UnitsFirst.SI, example=project())


def project() -> ProjectInput:
    """Return the project: the school's, with the roof and the arrays of the classroom building."""
    school = SCHOOL["project"]()
    title = "Campus Classrooms, Rooftop Solar", "SC-717", school.project.client
    return ProjectInput.model_validate(
        {
            **dict(school),
            **issued(*title, school.project.address, "SI", date=dt.date(2026, 11, 20)),
            "roof": rectangle(ROOF_X, ROOF_Y, 1.0),
            "arrays": [_array(row, column) for row in range(ROWS) for column in range(COLUMNS)],
            "objects": [
                *(
                    roof_object(f"RTU-{n}", "fixed object", 1.4, (x, x + 4.0), (28.8, 31.2), 1.0)
                    for n, x in enumerate((8.0, 42.4, 76.8), start=1)
                ),
                roof_object("RTU-4", "fixed object", 1.4, (87.2, 89.2), (12.0, 16.0), 1.0),
                _parapet("NORTH", ROOF_X, (60.0, 60.3)),
                _parapet("SOUTH", ROOF_X, (-0.3, 0.0)),
                _parapet("EAST", (94.4, 94.7), ROOF_Y),
                _parapet("WEST", (-0.3, 0.0), ROOF_Y),
            ],
            "clearances": _clearances(),
            "motions": school.motions[:COUNT],
        }
    )


def _array(row: int, column: int) -> Row:
    """Return an array of the school's product; each slope falls from the ridge to its parapet."""
    name, is_south = _name(row, column), row < ROWS // 2
    x, width = 4.8 + column * (WIDTH_M + LANE_M), SHORT_WIDTH_M if name == SHORT else WIDTH_M
    inward = SETBACK_M + (row if is_south else ROWS - 1 - row) * (DEPTH_M + LANE_M)
    y = inward if is_south else ROOF_Y[1] - inward - DEPTH_M
    return {
        **SCHOOL["_array"](name, (x, x + width), (y, y + DEPTH_M)),
        "slope_value": 2.0 if is_south else 4.0,
        "slope_unit": "percent",
        "downslope_deg": 270.0 if is_south else 90.0,
        "mu": 0.45 if name in OLD_MEMBRANE else 0.50,
    }


def _name(row: int, column: int) -> str:
    return f"A{row * COLUMNS + column + 1}"


def _parapet(name: str, x: Range, y: Range) -> Row:
    return roof_object(name, "edge with parapet", 0.9, x, y, 1.0)


def _clearances() -> list[Row]:
    """Return those between neighbors in a row and in a column, to parapets and to the units."""
    found = []
    for row in range(ROWS):
        names = (_name(row, column) for column in range(COLUMNS))
        found += [clearance(*pair, "across", LANE_M) for pair in pairwise(names)]
    for column in range(COLUMNS):
        south = [_name(row, column) for row in range(ROWS // 2)]
        north = [_name(row, column) for row in reversed(range(ROWS // 2, ROWS))]
        for edge, names in (("SOUTH", south), ("NORTH", north)):
            found.append(clearance(names[0], edge, "down", SETBACK_M))
            found += [clearance(*pair, "up", LANE_M) for pair in pairwise(names)]
    for unit, column in (("RTU-1", 0), ("RTU-2", 2), ("RTU-3", 4)):
        found += [clearance(_name(row, column), unit, "up", 2.4) for row in (2, 3)]
    return [*found, clearance("A10", "RTU-4", "across", 1.6)]


if __name__ == "__main__":
    main()
