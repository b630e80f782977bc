"""Makes the campus: 30 arrays on both slopes of a roof, with three of the school's ground motions.

Site, friction tests, peer review and the records themselves are the school's, a building of the
same campus. Run from the repository root: .venv/bin/python projects/campus/make.py
"""

from __future__ import annotations

import datetime as dt
import shutil
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from pathlib import Path
from runpy import run_path

from projects.rows import Row, clearance, issued, rectangle, roof_object
from report.project.model import ProjectInput
from report.project.model.choices import UnitsFirst
from report.project.write.template import write_template

HERE = Path(__file__).resolve().parent
SCHOOL = run_path(str(HERE.parent / "school" / "make.py"))
COUNT = 3
COLUMNS, ROWS = range(5), range(3)  # of each slope, rows from the parapet to the ridge
LONG_M, DEEP_M, LANE_M, SETBACK_M = 16.0, 7.2, 1.2, 2.4
COVERED = (  # as `roofslip report` fills it in
    "2026-11-16: Site c8e60b, Arrays e9936d, Friction tests 5c1207, Motions 813bc1, Building 065d3c"
)
ROOF_X, ROOF_Y = (0.0, 94.4), (0.0, 60.0)


def main() -> None:
    """Write records/ and input.xlsx beside this file."""
    (HERE / "records").mkdir(exist_ok=True)
    for record in (HERE.parent / "school" / "records").glob(f"GM[1-{COUNT}]-*.csv"):
        shutil.copyfile(record, HERE / "records" / record.name)
    write_template(HERE / "input.xlsx", units=UnitsFirst.SI, example=project())


def project() -> ProjectInput:
    """Return the project: the school's, with the roof and the arrays of the classroom building."""
    school = SCHOOL["project"]()
    title = "Campus Classrooms, Rooftop Solar", "SC-717", school.project.client
    south, north = (
        [[f"A{first + 5 * row + k}" for k in COLUMNS] for row in ROWS] for first in (1, 16)
    )
    return ProjectInput.model_validate(
        {
            **dict(school),
            **issued(*title, school.project.address, "SI", date=dt.date(2026, 11, 20)),
            "roof": rectangle(ROOF_X, ROOF_Y, 1.0),
            "arrays": [*_arrays(south, 270.0, 2.0), *_arrays(north, 90.0, 4.0)],
            "objects": [
                roof_object("RTU-1", "fixed object", 1.4, (8.0, 12.0), (28.8, 31.2), 1.0),
                roof_object("RTU-2", "fixed object", 1.4, (42.4, 46.4), (28.8, 31.2), 1.0),
                roof_object("RTU-3", "fixed object", 1.4, (76.8, 80.8), (28.8, 31.2), 1.0),
                roof_object("RTU-4", "fixed object", 1.4, (87.2, 89.2), (12.0, 16.0), 1.0),
                roof_object("NORTH", "edge with parapet", 0.9, ROOF_X, (60.0, 60.3), 1.0),
                roof_object("SOUTH", "edge with parapet", 0.9, ROOF_X, (-0.3, 0.0), 1.0),
                roof_object("EAST", "edge with parapet", 0.9, (94.4, 94.7), ROOF_Y, 1.0),
                roof_object("WEST", "edge with parapet", 0.9, (-0.3, 0.0), ROOF_Y, 1.0),
            ],
            "clearances": [
                *_clearances(south, "SOUTH"),
                *_clearances(north, "NORTH"),
                clearance("A10", "RTU-4", "cross-slope", 1.6),
            ],
            "motions": school.motions[:COUNT],
            # The letter beside this file is on these arrays, and an example as that of the school.
            "options": school.options.model_copy(update={"peer_covered": COVERED}),
        }
    )


def _arrays(names: Sequence[Sequence[str]], downslope_deg: float, percent: float) -> Iterator[Row]:
    """Yield the arrays of a slope, of the school's product; one leaves room for RTU-4."""
    for row, column in product(ROWS, COLUMNS):
        name, inward = names[row][column], SETBACK_M + row * (DEEP_M + LANE_M)
        x = 4.8 + column * (LONG_M + LANE_M)
        y = inward if downslope_deg == 270.0 else ROOF_Y[1] - inward - DEEP_M
        to = x + (12.0 if name == "A10" else LONG_M)
        yield {
            **SCHOOL["_array"](name, (x, to), (y, y + DEEP_M)),
            "slope_value": percent,
            "slope_unit": "percent",
            "downslope_deg": downslope_deg,
            "mu": 0.45 if name in ("A9", "A10", "A24", "A25") else 0.50,  # an older membrane
        }


def _clearances(names: Sequence[Sequence[str]], parapet: str) -> Iterator[Row]:
    """Yield those in rows and columns of a slope, to its parapet and to the units on the ridge."""
    for row in names:
        yield from (clearance(*two, "cross-slope", LANE_M) for two in pairwise(row))
    for column in zip(*names, strict=True):
        yield clearance(column[0], parapet, "downslope", SETBACK_M)
        yield from (clearance(*two, "upslope", LANE_M) for two in pairwise(column))
    for number, name in enumerate(names[-1][::2], start=1):
        yield clearance(name, f"RTU-{number}", "upslope", 2.4)


if __name__ == "__main__":
    main()
