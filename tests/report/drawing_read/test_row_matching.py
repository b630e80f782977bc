"""A revised drawing moves the rows that it moves, and no property goes to another array."""

import datetime as dt
import math
import re
from functools import partial
from itertools import zip_longest

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fixtures.commands import errors_of, output_of, stdout_of
from fixtures.dxf import ROOF_FT, Sketch
from fixtures.filled_cells import typed_cells
from fixtures.project_parts import FT
from fixtures.workbooks import blank, type_into
from report.drawing_read.plan_as_drawn import RoofPlan
from report.drawing_read.roof_drawing import DrawnOutline
from report.drawing_read.row_matching import MOST_TOLD, matched
from report.project.model.choices import ClearanceSource, LayerKind, UnitsFirst
from report.project.model.shapes import SIDES, Polygon, Rectangle
from report.project.read.read import read
from solver.errors import InputError

SIZE_FT = (80, 40)


def box(x, y, size=SIZE_FT):
    wide, tall = size
    return ((x, y), (x + wide, y), (x + wide, y + tall), (x, y + tall))


def drawn(tmp_path, arrays, objects=(), roof=ROOF_FT):
    """A drawing of arrays and objects: corner or outline, and a name or none."""
    sketch = Sketch()
    sketch.ring("ROOF-OUTLINE", roof)
    for layer, places in (("ARRAY", arrays), ("OBJECT", objects)):
        for place, name in places:
            sketch.ring(layer, place if len(place) > 2 else box(*place), name)
    return sketch.saved(tmp_path)


plan_read = partial(output_of, "plan", "read")


def filled(tmp_path, arrays, objects=(), **roof):
    """A workbook with the plan of a drawing, and a slope for each array."""
    folder = tmp_path / "project"
    folder.mkdir()
    path = blank(folder / "input.xlsx", UnitsFirst.US)
    plan_read(drawn(tmp_path, arrays, objects, **roof), path)
    ids = [row["id"] for row in read(path).inputs["arrays"]]
    type_into(path, {f"Arrays/{name}/Slope": 1.0 + k for k, name in enumerate(ids)})
    return path


def revised(tmp_path, path, arrays, objects=(), *, exit_code=0, **roof):
    drawing = drawn(tmp_path, arrays, objects, **roof)
    return plan_read(drawing, path, "--replace", exit_code=exit_code)


def slopes(path):
    """The slope of each array by its lower left corner [ft]."""
    return {
        (round(row["x_from_m"] / FT), round(row["y_from_m"] / FT)): (row["id"], row["slope_value"])
        for row in read(path).inputs["arrays"]
    }


@pytest.mark.nightly
def test_the_lower_array_moves_to_the_top_and_each_keeps_its_slope(tmp_path):
    path = filled(tmp_path, [((20, 60), ""), ((20, 10), "")])
    assert slopes(path) == {(20, 60): ("A1", 1.0), (20, 10): ("A2", 2.0)}
    output = revised(tmp_path, path, [((20, 110), ""), ((20, 60), "")])
    assert slopes(path) == {(20, 60): ("A1", 1.0), (20, 110): ("A2", 2.0)}
    table = output[output.index("name  from") :].splitlines()
    assert re.split("  +", table[1]) == [
        "A2", "x 20.00 to 100.00, y 10.00 to 50.00 ft",
        "x 20.00 to 100.00, y 110.00 to 150.00 ft",
    ]  # fmt: skip
    assert not table[2].startswith("A1")


def test_an_array_split_in_halves_stops_and_nothing_is_changed(tmp_path):
    path = filled(tmp_path, [((20, 60), ""), ((20, 10), "")])
    before = path.read_bytes()
    halves = [(box(20, 60, (39, 40)), ""), (box(61, 60, (39, 40)), "")]
    output = revised(tmp_path, path, [*halves, ((20, 10), "")], exit_code=2)
    assert "x 20.00 to 59.00, y 60.00 to 100.00 ft), " in output
    assert "x 61.00 to 100.00, y 60.00 to 100.00 ft) may be A1: write its name inside" in output
    assert path.read_bytes() == before


@pytest.mark.quick
def test_of_many_that_cannot_be_told_some_are_named():
    places = [(20.0 * (k % 10), 12.0 * (k // 10), 16.0, 8.0) for k in range(3 * MOST_TOLD)]
    with pytest.raises(InputError) as caught:
        matched_with(places, [(x + 1e3, *rest) for x, *rest in places])
    assert len(caught.value.problems) == MOST_TOLD
    assert max(map(len, map(str, caught.value.problems))) < 1000


@pytest.mark.nightly
def test_what_the_drawing_no_longer_has_is_taken_out_with_its_clearances(tmp_path):
    arrays = [((20, 60), "A1"), ((20, 10), "A2")]
    objects = [(box(110, 60, (10, 8)), "RTU-1")]
    path = filled(tmp_path, arrays, objects)
    rows = {"Clearances/1/Array": "A1", "Clearances/1/Object": "A2",
            "Clearances/2/Array": "A1", "Clearances/2/Object": "RTU-1"}  # fmt: skip
    type_into(path, rows)
    output = revised(tmp_path, path, [((20, 60), "A1")])
    inputs = read(path).inputs
    assert [row["id"] for row in inputs["arrays"]] == ["A1"]
    assert not [row for row in inputs["objects"] if row["id"] == "RTU-1"]
    assert [row for row in inputs["clearances"] if row] == []
    for name in ("A2", "RTU-1"):
        (line,) = (line for line in output.splitlines() if line.startswith(f"{name} "))
        assert line.endswith("not in the drawing; deleted")


@pytest.mark.nightly
def test_what_is_typed_stays_and_is_named(tmp_path):
    path = filled(tmp_path, [((20, 60), "A1"), ((20, 10), "A2")])
    type_into(path, {"Arrays/A2/Location source": None})
    output = revised(tmp_path, path, [((20, 60), "A1")])
    assert slopes(path)[20, 10] == ("A2", 2.0)
    assert "not in the drawing; stays as typed" in output


@pytest.mark.nightly
def test_a_second_drawing_adds_to_the_first_without_replace(tmp_path):
    path = filled(tmp_path, [((20, 60), "A1")])
    sketch = Sketch()
    sketch.ring("ARRAY", box(20, 10), "A2")
    output = plan_read(sketch.saved(tmp_path), path)
    assert [row["id"] for row in read(path).inputs["arrays"]] == ["A1", "A2"]
    assert "A1      x 20.00 to 100.00, y 60.00 to 100.00 ft" in output
    assert "not in the drawing; kept without --replace" in output


def grid(sketch, x, y):
    for k in range(6):
        sketch.ring("ARRAY", box(x + 7 * k, y, (6.8, 3.4)))


@pytest.mark.nightly
def test_modules_that_are_not_drawn_any_more_are_taken_out(tmp_path):
    folder = tmp_path / "project"
    folder.mkdir()
    path = blank(folder / "input.xlsx", UnitsFirst.US)
    sketch = Sketch()
    grid(sketch, 20, 20)
    plan_read(sketch.saved(tmp_path), path)
    assert read(path).inputs["arrays"][0]["modules"] == 6
    sketch = Sketch()
    sketch.ring("ARRAY", box(20, 20, (41.8, 3.4)))
    output = plan_read(sketch.saved(tmp_path), path, "--replace")
    assert "A1: 6 modules deleted, as they are not drawn" in output
    assert read(path).inputs["arrays"][0]["modules"] is None
    # Typed, they stay.
    type_into(path, {"Arrays/A1/Modules": 30})
    output = plan_read(sketch.saved(tmp_path), path, "--replace")
    assert "A1: 30 modules stay as typed" in output
    assert read(path).inputs["arrays"][0]["modules"] == 30


@pytest.mark.nightly
def test_a_roof_that_grows_keeps_what_was_typed_of_its_edges(tmp_path):
    path = filled(tmp_path, [((20, 60), "A1")])
    ids = [row["id"] for row in read(path).inputs["objects"]]
    assert len(ids) == 4
    type_into(path, {f"Objects/{ids[1]}/Type": "edge with parapet",
                     f"Objects/{ids[1]}/Height": 36})  # fmt: skip
    before = {row["id"]: row["kind"] for row in read(path).inputs["objects"]}
    larger = ((0, 0), (300, 0), (300, 160), (0, 160))
    revised(tmp_path, path, [((20, 60), "A1")], roof=larger)
    after = read(path).inputs["objects"]
    assert {row["id"]: row["kind"] for row in after} == before
    assert max(row["x_to_m"] for row in after) == pytest.approx(301 * FT, abs=1e-5)


def drawn_at(places, names=()):
    """Outlines of arrays: corner and size [m], and a name or none."""
    return [
        DrawnOutline(
            name=name or f"A{k}", kind=LayerKind.ARRAY, shape=Rectangle(x, x + wide, y, y + tall),
            handle=str(k), layer="ARRAY", height_m=math.nan, note="",
            unnamed="" if name else "no text inside",
        )
        for k, ((x, y, wide, tall), name) in enumerate(zip_longest(places, names), start=1)
    ]  # fmt: skip


def rows_at(places):
    return [
        {"id": f"A{k}", "place_from": "drawing"}
        | dict(zip(SIDES, (x, x + wide, y, y + tall), strict=True))
        for k, (x, y, wide, tall) in enumerate(places, start=1)
    ]


def matched_with(rows, places, names=()):
    """The plan of drawn places with the names of the rows of a workbook."""
    inputs = {"arrays": rows_at(rows), "objects": [], "outlines": [], "project": [], "roof": []}
    arrays = tuple(drawn_at(places, names))
    return matched(RoofPlan(roof=(), arrays=arrays, objects=(), unread=()), inputs).arrays


UPPER, LOWER, TOP = (20, 60, 80, 40), (20, 10, 80, 40), (20, 110, 80, 40)


@pytest.mark.parametrize(
    ("places", "written", "names"),
    [
        ([TOP, UPPER], ["", ""], ["A2", "A1"]),  # the lower one moves to the top
        *(([(x + dx, y + dy, *size) for x, y, *size in (UPPER, LOWER)], ["", ""], ["A1", "A2"])
          for dx, dy in ((5, 0), (0, -8), (30, 12))),
        ([UPPER, LOWER], ["A2", "A1"], ["A2", "A1"]),  # a name counts wherever it is
        ([UPPER, LOWER], ["PV-7", "A2"], ["A1", "A2"]),  # called otherwise, in its place
        ([TOP, UPPER, LOWER], ["", "", ""], ["A3", "A1", "A2"]),  # a new one
    ],
)  # fmt: skip
@pytest.mark.quick
def test_an_outline_is_the_row_that_its_name_its_place_or_its_size_says(places, written, names):
    arrays = matched_with([UPPER, LOWER], places, written)
    assert [place.name for place in arrays] == names
    assert (arrays[0].unnamed == "'PV-7' in the drawing") == (written[0] == "PV-7")


@pytest.mark.parametrize(
    ("places", "candidates"),
    [
        ([(20, 10, 80, 90)], "may be A1 or A2"),  # one over both
        ([(20, 35, 80, 40)], "may be A1 or A2"),  # half of each
        ([UPPER, (130, 10, 30, 30)], "may be A2, or new"),  # elsewhere and of another size
    ],
)
@pytest.mark.quick
def test_what_cannot_be_told_stops_with_the_candidates(places, candidates):
    with pytest.raises(InputError, match=f"{candidates}: write its name inside it as a text"):
        matched_with([UPPER, LOWER], places)


_CELLS = st.lists(
    st.tuples(st.integers(0, 5), st.integers(0, 4)), min_size=2, max_size=8, unique=True
)


@settings(max_examples=150)
@given(data=st.data(), cells=_CELLS, moves=st.integers(0, 3))
def test_what_stays_or_moves_by_less_than_half_its_size_is_never_taken_for_another(
    data, cells, moves
):
    sizes = [data.draw(st.sampled_from([(16.0, 8.0), (14.0, 9.0)])) for _ in cells]
    places = [(20.0 * x, 12.0 * y, *size) for (x, y), size in zip(cells, sizes, strict=True)]
    after = dict(enumerate(places))
    free = [(x, y) for x in range(6) for y in range(5) if (x, y) not in cells]
    moved = set()
    for _ in range(moves):
        k = data.draw(st.sampled_from(range(len(places))))
        if data.draw(st.booleans()):
            x, y, wide, tall = places[k]
            dx, dy = (data.draw(st.floats(-3, 3)) for _ in "xy")
            after[k] = (x + dx, y + dy, wide, tall)
        elif free:
            x, y = free.pop(data.draw(st.integers(0, len(free) - 1)))
            after[k] = (20.0 * x, 12.0 * y, *places[k][2:])
            moved.add(k)
    order = data.draw(st.permutations(range(len(places))))
    try:
        arrays = matched_with(places, [after[k] for k in order])
    except InputError:
        assert len(moved) > 1  # one that moved is told from all that stayed
        return
    named = {place.name: place.shape for place in arrays}
    for k, (x, y, wide, tall) in after.items():
        if k not in moved or len(moved) == 1:
            assert named[f"A{k + 1}"] == Rectangle(x, x + wide, y, y + tall)


WIDE, TALL = 217.0, 118.0
FIELDS = ((6, 6, 10, 10), (80, 6, 10, 10), (156, 6, 8, 10), (6, 57, 10, 12), (156, 57, 8, 12))
"""Corner [ft], columns and rows of five fields of modules; the second is an L."""
UNITS = {"RTU-1": (128, 34), "RTU-2": (84, 60), "RTU-3": (125, 100)}
EDGES = ((0, -1, WIDE, 1), (WIDE, 0, 1, TALL), (0, TALL, WIDE, 1), (-1, 0, 1, TALL))

PROJECT = {"Project name": "Harbor Warehouse", "Project number": "26-041", "Prepared by": "RG",
           "Date": dt.date(2026, 11, 26), "Revision": "0"}  # fmt: skip
SITE = {"Rule set": "ASCE 7-16", "Risk category": "II", "Importance factor I_e": 1.0, "S_S": 1.5,
        "S_1": 0.6, "Site class": "D", "F_a": 1.2, "F_v": 1.7, "Seismic design category": "D",
        "Number of stories": 1, "Structure height h": 30, "Roof height z": 30}  # fmt: skip
ARRAY = {"Slope": 1.0, "Slope unit": "degrees", "Friction coefficient": 0.45,
         "Construction": "Tray 10 deg, landscape", "Module weight": 56, "Ballast weight": 6200,
         "CG height": 9, "Support spacing": 40, "Downslope direction": 270}  # fmt: skip


def layout():
    """Modules as blocks, an outline of lines, parapets, and units with their heights."""
    sketch = Sketch()
    space = sketch.space
    corners = box(0, 0, (WIDE, TALL))
    for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        space.add_line(start, end, dxfattribs={"layer": "A-ROOF-OTLN"})
    for sides in EDGES:
        sketch.ring("A-ROOF-PARAPET", box(*sides[:2], sides[2:]), 'HT 30"')
    module, unit = (sketch.document.blocks.new(name) for name in ("MODULE", "RTU"))
    module.add_lwpolyline(box(0, 0, (6.8, 3.4)), close=True)
    unit.add_lwpolyline(box(0, 0, (10, 7)), close=True)
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


@pytest.mark.nightly
def test_a_roof_goes_from_its_drawing_to_a_verdict_with_no_place_clearance_or_record_typed(
    tmp_path,
):
    drawing, roof = layout().saved(tmp_path), tmp_path / "roof"
    workbook = roof / "input.xlsx"
    stdout_of("new", roof)
    assert "nothing was written" in errors_of("plan", "read", drawing, roof)
    assert all(not cells for cells in typed_cells(workbook).values())
    stdout_of("plan", "read", drawing, roof, "--accept")
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
    stdout_of("motion", "suite", roof / "records", "--into", roof, "--count", 3)
    stdout_of("plan", "clearances", roof)

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
    done = stdout_of("report", roof, "--out", tmp_path / "out")
    assert "verdict: OK with conditions" in done
    assert "not confirmed" in (tmp_path / "out" / "results.json").read_text()
    assert "no clearance" not in done
