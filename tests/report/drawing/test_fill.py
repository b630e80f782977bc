"""A plan from a drawing fills a workbook, and loses nothing that is in it."""

import re

import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from cells import cell
from inputs import FT, NO_SIDES
from report.cli.main import main
from report.sheet.reading.read import read
from report.sheet.schema import ClearanceSource, Polygon, UnitsFirst
from report.sheet.writing.live import overwritten
from sheets import at, blank, edit, make, parts, project, put, same, type_into
from sketch import BOX_FT, L_FT, ROOF_FT, Sketch


def run(*words, exit_code=0):
    """The output of a command that fills a workbook, or refuses to."""
    done = CliRunner().invoke(main, ["plan", "read", *map(str, words)])
    assert done.exit_code == exit_code, done.output
    return done.output


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


@pytest.mark.parametrize("units", UnitsFirst)
@pytest.mark.by_day(1)
def test_a_blank_workbook_is_filled(tmp_path, units):
    path = new(tmp_path, units)
    output = run(drawing(tmp_path), path)
    assert "A1: array, 6 vertices" in output
    assert "Clearances are not added yet: Project!" in output
    sheet = read(path)
    draft = sheet.draft
    assert [row["id"] for row in draft["arrays"]] == ["A1", "A2"]
    assert draft["arrays"][0]["x_from_m"] is None
    assert draft["arrays"][1]["x_to_m"] == pytest.approx(200 * FT, abs=1e-6)
    assert [(row["name"], round(row["x_m"] / FT), round(row["y_m"] / FT))
            for row in draft["outlines"]] == [("A1", x, y) for x, y in L_FT]  # fmt: skip
    assert draft["roof"][0]["x_to_m"] == pytest.approx(240 * FT, abs=1e-6)
    ids = [row["id"] for row in draft["objects"]]
    assert ids == ["N", "EDGE-1", "EDGE-2", "EDGE-3"]
    assert draft["objects"][0]["height_m"] == pytest.approx(36 * 0.0254)
    assert not [p for p in sheet.problems if p[0].section in ("roof", "objects", "outlines")]


def test_places_that_are_filled_stay_unless_they_may_be_replaced(tmp_path):
    path = make(tmp_path)
    before = path.read_bytes()
    output = run(drawing(tmp_path), tmp_path, exit_code=2)
    assert "the place of A1 is filled already; add --replace to overwrite it" in output
    assert "Objects!" in output  # N
    assert path.read_bytes() == before


def test_replacing_changes_the_places_and_keeps_the_rest(tmp_path):
    path = make(tmp_path, clearances=[])
    run(drawing(tmp_path), tmp_path, "--replace")
    data, was = read(path).project, project(clearances=[])
    drawn = {(row.array, row.object): row.source for row in data.clearances}
    assert drawn
    assert set(drawn.values()) == {ClearanceSource.DRAWING}
    assert isinstance(data.arrays[0].shape, Polygon)
    assert [item.id for item in data.objects] == [
        "RTU-1", "OLD", "N", "S", "EDGE-1", "EDGE-2", "EDGE-3"
    ]  # fmt: skip
    assert same(without_places(data), without_places(was))


def without_places(data):
    arrays = tuple(array.model_copy(update=NO_SIDES) for array in data.arrays)
    nothing = dict.fromkeys(("objects", "outlines", "clearances"), ())
    return data.model_copy(update={"arrays": arrays, "roof": None} | nothing)


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


def test_formulas_and_all_other_parts_stay(tmp_path):
    path = make(tmp_path, clearances=[])
    weight = "Arrays/A1/Weight"
    before = parts(type_into(path, {weight: "=40000+2000"}))
    output = run(drawing(tmp_path), tmp_path, "--replace")
    assert "Formulas keep their former values until Excel or LibreOffice saves it." in output
    after = parts(path)
    assert before.keys() == after.keys()
    different = {name for name in before if before[name] != after[name]}
    assert len(different) <= 5  # Arrays, Objects, Outlines, the roof, and when to compute
    assert cell(load_workbook(path), weight).value == "=40000+2000"


@pytest.mark.parametrize("units", UnitsFirst)
@pytest.mark.by_day(1)
def test_rows_that_a_table_grows_by_have_their_formulas(tmp_path, units):
    path = new(tmp_path, units)
    sketch = Sketch("R2018")
    for number in range(30):
        box = ((x + 20 * number, y) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10)))
        sketch.ring("ARRAY", tuple(box), f"A{number}")
    run(sketch.saved(tmp_path), path)
    sheet = read(path)
    assert len(sheet.draft["arrays"]) == 30
    assert overwritten(sheet.book) == ()
    last = cell(load_workbook(sheet.path), "Arrays/A29/Status")
    assert last.value == "=status_arrays"


def test_a_row_of_totals_with_no_blank_row_above_it_is_told(tmp_path):
    def close(book):
        book["Outlines"].tables["outlines_table"].totalsRowCount = 1
        put(book, {f"Outlines/{row}/Outline of": "A9" for row in range(1, 20)})

    output = run(drawing(tmp_path), edit(new(tmp_path), close), exit_code=2)
    row = re.sub(r"[A-Z]+(?=\d)", "", at("Outlines/20/Outline of"))
    assert f"{row}: the table has a row of totals, and no blank row above it" in output


def test_layers_of_the_workbook_name_what_is_drawn(tmp_path):
    path = make(tmp_path, clearances=[], layers=[{"layer": "PV", "kind": "array"}])
    sketch = Sketch()
    sketch.ring("pv", BOX_FT, "A9")
    run(sketch.saved(tmp_path), tmp_path)
    assert [row.get("id") for row in read(path).draft["arrays"]] == ["A1", "A2", "A9"]


def test_a_drawing_without_a_unit_asks_for_it(tmp_path):
    path, book = drawing(tmp_path, "R12"), new(tmp_path)
    output = run(path, book, exit_code=2)
    assert "states no unit; add --units with one of in, ft, mm, cm, m" in output
    run(path, book, "--units", "ft")


def test_a_drawing_without_anything_known_lists_what_there_is(tmp_path):
    sketch = Sketch()
    ring = sketch.ring("MODULES", BOX_FT)
    output = run(sketch.saved(tmp_path), new(tmp_path), exit_code=2)
    assert "nothing to fill in: give the layers on the sheet Layers" in output
    listed = f"layer MODULES, a closed line on a layer that is not in Layers: {ring.dxf.handle}"
    assert listed in output


def test_polygons_need_the_sheet_outlines(tmp_path):
    path = make(tmp_path, clearances=[])
    edit(path, lambda book: book.remove(book["Outlines"]))
    output = run(drawing(tmp_path), tmp_path, "--replace", exit_code=2)
    assert "Outlines: the sheet is missing, which A1 in the drawing need" in output
    assert "Run roofslip new FOLDER and copy your cells" in output


@pytest.mark.parametrize("name", ["none.dxf", "."])
def test_a_drawing_that_is_not_there_is_told(tmp_path, name):
    assert "cannot be read" in run(tmp_path / name, new(tmp_path), exit_code=2)
