"""A plan from a drawing fills a workbook, and loses nothing that is in it."""

import re
from functools import partial

import pytest
from openpyxl import load_workbook
from openpyxl.utils import range_boundaries

from fixtures.architect_plan import ARRAYS, roof_plan
from fixtures.cells import cell
from fixtures.commands import output_of
from fixtures.dxf import BOX_FT, L_FT, ROOF_FT, UNIT_FT, Sketch
from fixtures.marks import by_day
from fixtures.project_parts import FT, HEAD, NO_SIDES
from fixtures.workbooks import (
    blank,
    cell_address,
    different,
    edit,
    make,
    parts,
    project,
    put,
    same,
    type_into,
)
from report.project.model.choices import ClearanceSource, UnitsFirst
from report.project.model.shapes import SIDES, Polygon
from report.project.read.read import read
from report.project.write.overwritten import overwritten

run = partial(output_of, "plan", "read")


def drawing(tmp_path, version="R2018"):
    sketch = Sketch(version)
    sketch.ring("ROOF-OUTLINE", ROOF_FT)
    sketch.ring("ARRAY", L_FT, "A1")
    sketch.ring("ARRAY", BOX_FT, "A2")
    sketch.ring("ROOF-PARAPET", ((0, 160), (240, 160), (240, 161), (0, 161)), "N, height 36.0 in")
    return sketch.saved(tmp_path)


def new(tmp_path, units=UnitsFirst.US):
    folder = tmp_path / "new"
    folder.mkdir()
    return blank(folder / "input.xlsx", units)


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_a_blank_workbook_is_filled(tmp_path, units):
    path = new(tmp_path, units)
    output = run(drawing(tmp_path), path)
    assert "A1: array, 6 vertices" in output
    assert "Clearances have not been added: Project!" in output
    sheet = read(path)
    inputs = sheet.inputs
    assert [row["id"] for row in inputs["arrays"]] == ["A1", "A2"]
    assert inputs["arrays"][0]["x_from_m"] is None
    assert inputs["arrays"][1]["x_to_m"] == pytest.approx(200 * FT, abs=1e-6)
    assert [(row["name"], round(row["x_m"] / FT), round(row["y_m"] / FT))
            for row in inputs["outlines"]] == [("A1", x, y) for x, y in L_FT]  # fmt: skip
    assert inputs["roof"][0]["x_to_m"] == pytest.approx(240 * FT, abs=1e-6)
    ids = [row["id"] for row in inputs["objects"]]
    assert ids == ["N", "EDGE-1", "EDGE-2", "EDGE-3"]
    assert inputs["objects"][0]["height_m"] == pytest.approx(36 * 0.0254)
    assert not [p for p in sheet.problems if p[0].section in ("roof", "objects", "outlines")]


def test_filled_places_and_full_tables_are_told(tmp_path):
    path = make(tmp_path)
    before = path.read_bytes()
    output = run(drawing(tmp_path), tmp_path, exit_code=2)
    (line,) = (line for line in output.splitlines() if "already filled in" in line)
    assert line.startswith("  Arrays!N8, Arrays!N9, Objects!")
    assert " 1 more: the location of A1, A2, N and S is already filled in; use --replace " in line
    assert path.read_bytes() == before

    def close(book):
        book["Outlines"].tables["outlines_table"].totalsRowCount = 1
        put(book, {f"Outlines/{row}/Outline of": "A9" for row in range(1, 20)})

    output = run(drawing(tmp_path), edit(new(tmp_path), close), exit_code=2)
    row = re.sub(r"[A-Z]+(?=\d)", "", cell_address("Outlines/20/Outline of"))
    assert f"{row}: the table has a totals row with no blank row above it" in output


@pytest.mark.nightly
def test_replacing_changes_the_places_and_who_confirmed_them_alone(tmp_path):
    path = make(tmp_path, clearances=[])
    run(drawing(tmp_path), tmp_path, "--replace")
    data, was = read(path).project, project(clearances=[])
    drawn = {(row.array, row.object): row.source for row in data.clearances}
    assert drawn
    assert set(drawn.values()) == {ClearanceSource.DRAWING}
    assert isinstance(data.arrays[0].shape, Polygon)
    # S is the side of the roof that the drawing shows; nothing in it says that it has no parapet.
    assert [item.id for item in data.objects] == ["RTU-1", "OLD", "N", "S", "EDGE-1", "EDGE-2"]
    assert data.objects[3].kind is was.objects[3].kind
    assert same(without_places(data), without_places(was))
    head = HEAD | {"drawing_confirmed_by": "RG", "drawing_confirmed_date": "2025-11-18"}
    path = make(tmp_path, clearances=[], project=head)
    output = run(drawing(tmp_path), tmp_path, "--replace")
    assert "'Drawing distances confirmed by RG, 2025-11-18' was cleared" in output
    assert read(path).project.project.drawing_confirmed_date is None


def without_places(data):
    arrays = tuple(array.model_copy(update=NO_SIDES | {"place_from": ""}) for array in data.arrays)
    nothing = dict.fromkeys(("objects", "outlines", "clearances"), ())
    return data.model_copy(update={"arrays": arrays, "roof": None} | nothing)


@pytest.mark.nightly
def test_an_outline_is_replaced_by_the_one_that_is_drawn_now(tmp_path):
    path = make(tmp_path, clearances=[])
    run(drawing(tmp_path), tmp_path, "--replace")
    sketch = Sketch()
    sketch.ring("ARRAY", ((20, 20), (100, 20), (60, 75)), "A1")
    sketch.ring("ARRAY", ((130, 20), (190, 20), (160, 75)), "A2")
    run(sketch.saved(tmp_path), tmp_path, "--replace")
    data = read(path).project
    assert [row.name for row in data.outlines] == ["A1"] * 3 + ["A2"] * 3
    assert data.arrays[0].shape.area_m2 == pytest.approx(80 * 55 / 2 * FT**2)
    assert data.arrays[1].x_from_m is None


@pytest.mark.nightly
def test_formulas_and_all_other_parts_stay(tmp_path):
    path = make(tmp_path, clearances=[])
    weight = "Arrays/A1/Weight"
    before = parts(type_into(path, {weight: "=40000+2000"}))
    output = run(drawing(tmp_path), tmp_path, "--replace")
    assert (
        "Open and save the workbook in Excel or LibreOffice once to recalculate its formulas."
        in output
    )
    assert (
        len(different(before, parts(path))) <= 5
    )  # Arrays, Objects, Outlines, the roof, and when to compute
    assert cell(load_workbook(path), weight).value == "=40000+2000"


@pytest.mark.parametrize("units", by_day(UnitsFirst, 1))
def test_rows_that_a_table_grows_by_have_its_formulas_and_formats(tmp_path, units):
    def format_last(book):
        left, _, right, last = range_boundaries(book["Arrays"].tables["arrays_table"].ref)
        for column in range(left, right + 1):
            book["Arrays"].cell(last, column).number_format = "0.0000"

    path = edit(new(tmp_path, units), format_last)
    sketch = Sketch("R2018")
    for number in range(30):
        box = ((x + 20 * number, y) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10)))
        sketch.ring("ARRAY", tuple(box), f"A{number}")
    output = run(sketch.saved(tmp_path), path)
    sheet = read(path)
    assert len(sheet.inputs["arrays"]) == 30
    written = load_workbook(sheet.path)
    first, last = (cell(written, f"Arrays/{name}/ID") for name in ("A0", "A29"))
    assert f"{first.parent.title}!{first.coordinate}:" in output
    table = range_boundaries(first.parent.tables["arrays_table"].ref)
    formats = [first.parent.cell(last.row, column).number_format for column in
               range(table[0], table[2] + 1)]  # fmt: skip
    assert formats == ["0.0000"] * len(formats)
    assert overwritten(sheet.book) == ()
    last = cell(load_workbook(sheet.path), "Arrays/A29/Array type")
    assert str(last.value).startswith("=IF(")


def test_a_drawing_without_a_unit_and_polygons_without_their_sheet_are_refused(tmp_path):
    path, book = drawing(tmp_path, "R12"), new(tmp_path)
    output = run(path, book, exit_code=2)
    assert (
        "the drawing does not state its unit; use --units with one of in, ft, mm, cm, m" in output
    )
    run(path, book, "--units", "ft")
    path = make(tmp_path, clearances=[])
    edit(path, lambda book: book.remove(book["Outlines"]))
    output = run(drawing(tmp_path), tmp_path, "--replace", exit_code=2)
    assert "Outlines: the worksheet is missing, which A1 in the drawing need" in output
    assert "Run roofslip new FOLDER and copy your cells" in output


@pytest.mark.quick
def test_a_drawing_without_anything_known_lists_what_there_is(tmp_path):
    sketch = Sketch()
    ring = sketch.ring("STRUCTURE", BOX_FT)
    output = run(sketch.saved(tmp_path), new(tmp_path), "--accept", exit_code=2)
    assert "nothing to fill in: enter the types of the layers on the Layers worksheet" in output
    listed = (
        "a closed line on a layer that is not on the Layers worksheet: 1 on STRUCTURE"
        f" ({ring.dxf.handle})"
    )
    assert listed in output


def layers_of(path):
    return [(row["layer"], row["kind"].value) for row in read(path).inputs["layers"]]


def test_layers_that_nobody_named_are_shown_with_a_proposal_and_nothing_is_written(tmp_path):
    path, drawn = new(tmp_path), roof_plan().saved(tmp_path)
    before = path.read_bytes()
    output = run(drawn, path, exit_code=2)
    rows = [line.split("  ") for line in output.splitlines() if "POLY" in line or "ARC" in line]
    assert [[cell.strip() for cell in row if cell.strip()] for row in rows] == [
        ["A-ANNO-NOTE", "1", "1 LWPOLYLINE", "not read"],
        ["A-ROOF-TANK", "1", "2 ARC, 2 TEXT", "none"],
        ["E-SOLR-PANL", "2", "2 LWPOLYLINE, 2 MTEXT", "array"],
        ["M-HVAC-EQPM", "2", "2 LWPOLYLINE", "fixed object"],
    ]
    assert "nothing was written: no type is known for 5 layers; use --accept" in output
    run(drawn, path, "--layer", "A-ROOF-TANK=fixed object", exit_code=2)  # and the other four
    assert path.read_bytes() == before


@pytest.mark.nightly
def test_layers_that_are_accepted_or_given_are_kept_on_the_sheet(tmp_path):
    path, drawn = new(tmp_path), roof_plan().saved(tmp_path)
    output = run(drawn, path, "--accept", "--layer", "a-roof-tank=Fixed object", "--rotate", "-17")
    inputs = read(path).inputs
    assert layers_of(path) == [
        ("a-roof-tank", "fixed object"), ("A-ANNO-NOTE", "not read"), ("A-ROOF-OTLN", "roof"),
        ("E-SOLR-PANL", "array"), ("M-HVAC-EQPM", "fixed object"),
    ]  # fmt: skip
    for row, points in zip(inputs["arrays"], ARRAYS.values(), strict=True):
        sides = [row[side] / FT for side in SIDES]
        (x0, y0), _, (x1, y1), _ = points
        assert sides == pytest.approx([x0, x1, y0, y1], abs=1e-4)
    heights = {row["id"]: row.get("height_m") for row in inputs["objects"]}
    assert heights["RTU-1"] == pytest.approx(3.5 * FT)
    assert heights["RTU-2"] == pytest.approx(4.0 * FT)
    assert heights["TANK"] == pytest.approx(5.0 * FT)
    for said in ("rotated counterclockwise by -17°", "the drawing does not state north: check",
                 "layer a-roof-tank: fixed object\nlayer A-ANNO-NOTE: ",
                 "A1: array, 4 vertices, 80.00 ft (24.38 m) by 30.00 ft (9.14 m) from ",
                 "(ELEV 60.0 in (1524 mm); assumed to be above the roof)",
                 "(HT 48.0 in (1219 mm); no unit stated; read in the unit of the"
                 " drawing)"):  # fmt: skip
        assert said in output
    # They are known from now on; one that is given again is changed in its row.
    again = run(drawn, path, "--replace", "--layer", "A-ROOF-TANK=not read")
    assert layers_of(path)[0] == ("A-ROOF-TANK", "not read")
    assert len(layers_of(path)) == 5
    assert "A1: array, 4 vertices, 80.00 ft (24.38 m) by 30.00 ft (9.14 m) at 17° to the" in again


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--layer", "AR-RAY=array"), "no layer 'AR-RAY'; did you mean 'ARRAY'?"),
        (("--layer", "ARRAY=arrays"),
         "'ARRAY=arrays' is not NAME=TYPE, where TYPE is one of array"),
        (("--layer", "=array"), "'=array' is not NAME=TYPE"),
        (("--rotate", "400"), "it is 400 deg; enter more than -360 deg and less than 360 deg."),
        (("--rotate", "nan"), "it is nan deg; enter more than"),
        (("--rotate", "north"), "the drawing does not state north (GEODATA); use"),
    ],
)  # fmt: skip
def test_options_that_say_nothing_are_refused(tmp_path, words, said):
    assert said in run(drawing(tmp_path), new(tmp_path), *words, exit_code=2)


def facing(tmp_path, east, north):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    sketch.space.new_geodata().dxf.north_direction = (east, north)
    return sketch.saved(tmp_path)


@pytest.mark.nightly
def test_the_north_of_the_drawing_turns_it(tmp_path):
    path = new(tmp_path)
    output = run(facing(tmp_path, -1, 1), path)
    assert "north is 135° counterclockwise from +x" in output
    output = run(facing(tmp_path, -1, 1), path, "--rotate", "north", "--replace")
    assert "rotated counterclockwise by -45° about the origin of the drawing" in output
    assert "north is 90° counterclockwise from +x" in output
    assert "at -45° to the axes" in output


@pytest.mark.nightly
def test_what_is_not_read_is_said_once_for_each_cause(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    for k in range(40):
        look = {"layer": f"L{k % 8}"}
        sketch.space.add_line((k, 900), (k, 901), dxfattribs=look)
        sketch.space.add_point((k, 900), dxfattribs=look)
    lines = [line for line in run(sketch.saved(tmp_path), new(tmp_path)).splitlines()
             if line.startswith("not read")]  # fmt: skip
    assert [re.sub(r"\(.*\)", "(...)", line) for line in lines] == [
        "not read: a POINT: 40 on L0, L1, L2 and 5 more (...)",
        "not read: an open line that is not part of a closed outline: 40 on L0, L1, L2 and 5"
        " more (...)",
    ]
    assert all(line.endswith(" and 37 more)") for line in lines)


def test_a_rectangle_left_far_from_the_roof_is_asked_about(tmp_path):
    sketch, east = Sketch(), 6_000_000
    sketch.ring("ROOF-OUTLINE", [(x + east, y) for x, y in ROOF_FT])
    sketch.ring("ARRAY", [(x + east, y) for x, y in BOX_FT], "A1")
    sketch.ring("OBJECT", UNIT_FT)
    output = run(sketch.saved(tmp_path), new(tmp_path))
    assert "OBJ-1 is 5999925.00 ft (1828777.14 m) from the roof; was it left over? Del" in output


@pytest.mark.parametrize(
    ("name", "said"),
    [("none.dxf", "no such file; use a DXF drawing"), (".", "is a folder; use a file")],
)
def test_a_drawing_that_is_not_there_is_told(tmp_path, name, said):
    assert said in run(tmp_path / name, new(tmp_path), exit_code=2)
