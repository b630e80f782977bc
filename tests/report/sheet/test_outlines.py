"""Outlines and the roof in the workbook: read back as written, checked by cell, optional."""

import pytest
from openpyxl import load_workbook

from inputs import FT, NO_SIDES, SIDES, clearance, sides
from report.sheet.reading.read import read
from report.sheet.schema.choices import UnitsFirst
from report.sheet.schema.scene import ROOF
from report.sheet.schema.shapes import Polygon, Rectangle
from sheets import arrays, at, blank, make, of, problems, project, read_workbook, same, type_into

L_FT = ((20, 15), (100, 15), (100, 45), (60, 45), (60, 75), (20, 75))
ROOF_FT = ((0, -1), (300, -1), (300, 121), (150, 121), (150, 140), (0, 140))


def vertices(name, points):
    return [{"name": name, "x_m": x * FT, "y_m": y * FT} for x, y in points]


def outlined(points=L_FT, *, roof=(), clearances=()):
    """Changes to the project: A1 by an outline."""
    return {
        "arrays": arrays(**NO_SIDES),
        "outlines": [*vertices("A1", points), *vertices(ROOF, roof)],
        "clearances": list(clearances),
    }


def in_meters(points):
    return [pytest.approx((x * FT, y * FT)) for x, y in points]


ROOF_SIDES = dict(zip(SIDES, (0.0, 300 * FT, 0.0, 120 * FT), strict=True))


def test_a_rectangular_roof_is_read_back_as_written_and_without_one_north_is_up(tmp_path):
    roof = ROOF_SIDES | {"north_deg": 60.0}
    data = read_workbook(make(tmp_path, roof=roof)).input
    assert same(data, project(roof=roof))
    assert data.roof.placed.x_to_m == pytest.approx(300 * FT)
    bare = read_workbook(make(tmp_path)).input.roof
    assert (bare.placed, bare.north_deg) == (None, 90.0)


@pytest.mark.parametrize("units", list(UnitsFirst))
def test_outlines_are_read_back_as_written(tmp_path, units):
    changes = outlined(roof=ROOF_FT)
    data = read_workbook(make(tmp_path, units, **changes)).input
    assert same(data, project(**changes))
    assert list(data.arrays[0].shape.points) == in_meters(L_FT)
    assert isinstance(data.arrays[1].shape, Rectangle)
    assert list(data.roof.placed.points) == in_meters(ROOF_FT)


def test_outlines_are_read_in_either_direction_and_refused_in_two_places(tmp_path):
    backwards = (*L_FT[::-1], L_FT[-1])
    data = read_workbook(make(tmp_path, **outlined(backwards))).input
    first, *rest = L_FT[::-1]
    assert list(data.arrays[0].shape.points) == in_meters([first, *rest[::-1]])
    here, before = "<Outlines/5/Outline of>", "<Outlines/3/Outline of>"
    line = f"outline of 'A1' goes on here after {before}; put all of its rows together"
    assert at(f"{here}: {line}") in changed(tmp_path, {"4/Outline of": "A2"})


@pytest.mark.quick
def test_the_blank_sheet_asks_for_sides_or_an_outline(tmp_path):
    sheet = load_workbook(blank(tmp_path / "input.xlsx"))["Arrays"]
    hints = {cell.value for row in sheet.iter_rows() for cell in row}
    assert "required, or an outline" in hints


def changed(tmp_path, cells):
    """The problems of a workbook with an outline of A1, after cells of it are typed."""
    return problems(type_into(make(tmp_path, **outlined()), of("Outlines", cells)))


FIRST = "<Outlines/1/Outline of>"


def test_an_unknown_name_is_told_by_its_cell(tmp_path):
    found = changed(tmp_path, {f"{row}/Outline of": "A11" for row in range(1, 7)})
    assert found[-1] == at(
        f"{FIRST}: outline of 'A11', which is not in Arrays or Objects; did you mean 'A1'?"
    )
    assert found[0].endswith(
        "x from is missing; give all four sides of the rectangle, or an outline on the sheet"
        " Outlines"
    )


BEYOND_TWO = {f"{row}/{head}": None for head in ("Outline of", "x", "y") for row in range(3, 7)}
NO_NUMBER = "<Outlines/2/y>: y is "


@pytest.mark.parametrize(
    ("typed", "begin", "end"),
    [
        (BEYOND_TWO, f"{FIRST}: A1 has 2 vertices", "; give at least 3, one to a row"),
        ({"2/x": 30, "2/y": 90},  # across the upper side
         f"{FIRST}: outline of A1 touches or crosses itself near x ",
         "; give its vertices in order, none of them twice"),
        ({"2/y": "nan"}, NO_NUMBER, "; give a number [ft]"),
        ({"2/y": None}, NO_NUMBER, "; give a number [ft]"),
    ],
)  # fmt: skip
def test_what_is_no_outline_is_told_by_its_cell(tmp_path, typed, begin, end):
    (line,) = changed(tmp_path, typed)
    assert line.startswith(at(begin))
    assert line.endswith(end)


ROOF_AS_ID = project().objects[0].model_dump() | {"id": "Roof"}
NOTCHED = ((0, 0), (300, 0), (300, 60), (80, 60), (80, 100), (0, 100))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (outlined() | {"arrays": arrays()},
         f": x from is given, and A1 has an outline at {FIRST}; leave the four sides blank, or"
         " delete the outline"),
        (outlined(roof=ROOF_FT) | {"objects": [ROOF_AS_ID]},
         "<Outlines/7/Outline of>: outline of 'roof', which is also the ID of an array or object;"
         " give that another ID"),
        # A1, an L, is beside the notch, which A2 spans.
        (outlined(roof=NOTCHED), "A2 is outside the roof near x "),
        (outlined(roof=NOTCHED), "or the outline of the roof at <Outlines/7/Outline of>"),
        (outlined() | {"arrays": arrays(**NO_SIDES)[:1], "roof": ROOF_SIDES | {"y_to_m": 74 * FT}},
         f"{FIRST}: A1 is outside the roof near x "),
    ],
)  # fmt: skip
def test_what_contradicts_an_outline_is_told_by_its_cell(tmp_path, changes, words):
    (line,) = problems(make(tmp_path, **changes))
    assert at(words) in line


def test_a_clearance_is_compared_with_the_gap_to_the_outline(tmp_path):
    # RTU-1 stands in the notch of A1: 10 ft from one leg, 5 ft from the other.
    unit = project().objects[0].model_dump() | sides(70, 80, 50, 60)
    row = clearance("A1", "RTU-1", 5 * FT)
    path = make(tmp_path, **outlined(clearances=[row]) | {"objects": [unit]})
    assert read(path).problems == ()
    (found,) = problems(type_into(path, {"Clearances/1/Provided clearance": 72}))
    assert "A1 and RTU-1 are 60.0 in (1524 mm) apart in plan" in found
    assert found.endswith(
        at(f"reduce it, or correct the outlines in {FIRST} and <Objects/RTU-1/x from:y to>")
    )


@pytest.mark.quick
def test_an_object_may_have_an_outline_and_an_array_needs_a_place():
    item = project().objects[1].model_dump()
    data = project(objects=[item], clearances=[], outlines=vertices("old", L_FT))
    assert isinstance(data.objects[0].placed, Polygon)
    assert {row.name for row in data.outlines} == {"OLD"}
    changes = outlined() | {"outlines": []}
    with pytest.raises(ValueError, match="no rectangle and no outline of A1"):
        project(**changes)
