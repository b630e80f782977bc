"""A real roof goes from its drawing to a verdict with no coordinate, clearance or record typed."""

import datetime as dt

import pytest

from commands import printed, refused
from report.sheet.reading.read import read
from report.sheet.schema.choices import ClearanceSource
from report.sheet.schema.shapes import Polygon
from sheets import type_into
from sketch import Sketch
from typed import typed_cells

pytestmark = pytest.mark.nightly

WIDE, TALL = 217.0, 118.0
FIELDS = ((6, 6, 10, 10), (80, 6, 10, 10), (156, 6, 8, 10), (6, 57, 10, 12), (156, 57, 8, 12))
"""Corner [ft], columns and rows of five fields of modules; the second is an L."""
UNITS = {"RTU-1": (128, 34), "RTU-2": (84, 60), "RTU-3": (125, 100)}
EDGES = ((0, -1, WIDE, 0), (WIDE, 0, WIDE + 1, TALL), (0, TALL, WIDE, TALL + 1), (-1, 0, 0, TALL))

PROJECT = {"Project name": "Harbor Warehouse", "Project number": "26-041", "Prepared by": "RG",
           "Date": dt.date(2026, 11, 26), "Revision": "0"}  # fmt: skip
SITE = {"Rule set": "ASCE 7-16", "Risk category": "II", "Importance factor I_e": 1.0, "S_S": 1.5,
        "S_1": 0.6, "Site class": "D", "F_a": 1.2, "F_v": 1.7, "Seismic design category": "D",
        "Number of stories": 1, "Structure height h": 30, "Height of the array z": 30}  # fmt: skip
ARRAY = {"Slope": 1.0, "Slope unit": "degrees", "Friction coefficient": 0.45,
         "Construction": "Tray 10 deg, landscape", "Module weight": 56, "Ballast weight": 6200,
         "CG height": 9, "Support spacing": 40, "Downslope direction": 270}  # fmt: skip


def box(x0, y0, x1, y1):
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def layout():
    """Modules as blocks, an outline of lines, parapets, and units with their heights."""
    sketch = Sketch()
    space = sketch.space
    corners = box(0, 0, WIDE, TALL)
    for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        space.add_line(start, end, dxfattribs={"layer": "A-ROOF-OTLN"})
    for sides in EDGES:
        sketch.ring("A-ROOF-PARAPET", box(*sides), 'HT 30"')
    module, unit = (sketch.document.blocks.new(name) for name in ("MODULE", "RTU"))
    module.add_lwpolyline(box(0, 0, 6.8, 3.4), close=True)
    unit.add_lwpolyline(box(0, 0, 10, 7), close=True)
    for x, y, columns, rows in FIELDS:
        for i in range(columns):
            for j in range(rows):
                if x != 80 or i < 6 or j < 5:
                    at = (x + 6.85 * i, y + 4.6 * j)
                    space.add_blockref("MODULE", at, dxfattribs={"layer": "PV_Modules"})
    for name, at in UNITS.items():
        put = space.add_blockref("RTU", at, dxfattribs={"layer": "M-HVAC-EQPM"})
        put.add_attrib("TAG", name)
        put.add_attrib("HT", "4'-6\"")
    return sketch


def typed():
    """What a person types: 5 cells of the project, 12 of the site, 9 of each array."""
    return {
        **{f"Project/{label}": value for label, value in PROJECT.items()},
        **{f"Site/{label}": value for label, value in SITE.items()},
        **{f"Arrays/A{k}/{label}": value for k in range(1, 6) for label, value in ARRAY.items()},
    }


def test_a_roof_goes_from_its_drawing_to_a_verdict_with_no_place_clearance_or_record_typed(
    tmp_path,
):
    drawing, roof = layout().saved(tmp_path), tmp_path / "roof"
    workbook = roof / "input.xlsx"
    printed("new", roof)
    assert "nothing is written" in refused("plan", "read", drawing, roof)
    assert all(not cells for cells in typed_cells(workbook).values())
    printed("plan", "read", drawing, roof, "--accept")
    filled = typed_cells(workbook)
    type_into(workbook, typed())
    by_hand = [
        field
        for sheet, cells in typed_cells(workbook).items()
        for address, field in cells.items()
        if address not in filled[sheet]
    ]
    assert {field.partition(".")[0] for field in by_hand} == {"project", "site", "arrays"}
    assert not any(field.endswith(("_from_m", "_to_m", ".id")) for field in by_hand)
    printed("motion", "suite", roof / "records", "--into", roof, "--count", 3)
    printed("plan", "clearances", roof)

    every = sum(map(len, typed_cells(workbook).values()))
    assert (len(by_hand), every - len(by_hand)) == (62, 193)  # as in docs/roof-drawing.md

    data = read(workbook).project
    assert [array.modules for array in data.arrays] == [120, 96, 100, 80, 80]
    assert isinstance(data.arrays[3].shape, Polygon)
    assert len(data.arrays[3].shape.points) == 6
    assert [row.height_m for row in data.objects] == pytest.approx([0.762] * 4 + [1.3716] * 3)
    assert len(data.motions) == 3
    assert {row.source for row in data.clearances} == {ClearanceSource.DRAWING}
    assert len(data.clearances) == 11
    done = printed("report", roof, "--out", tmp_path / "out")
    assert "verdict: OK with conditions" in done
    assert "clear distances from the drawing: not confirmed" in done
    assert "no clearance" not in done
