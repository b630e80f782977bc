"""The warehouse drawn in CAD with an L-shaped array around a unit: read, completed, reported."""

import json
import shutil

import pytest
import shapely
from click.testing import CliRunner
from openpyxl import load_workbook

import packages
from places import ROOT
from report.cli.main import main
from report.sheet.read import read
from report.sheet.schema import SECTIONS, Polygon, UnitsFirst
from report.sheet.template import write_template
from sheets import FT, INCH
from sketch import Sketch, plan

L_FT = ((30, 140), (180, 140), (180, 190), (140, 190), (140, 232), (30, 232))

pytestmark = pytest.mark.nightly("report/drawing/", "report/figures/")


def box(x0, x1, y0, y1):
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


def drawing(folder):
    sketch = Sketch()
    sketch.ring("ROOF-OUTLINE", box(0, 360, 0, 240))
    sketch.ring("ROOF-PARAPET", box(0, 360, 240, 241), "NORTH, height 30 in")
    sketch.ring("ARRAY", L_FT, "A1")
    sketch.ring("ARRAY", box(30, 150, 30, 132), "A2")
    sketch.ring("ARRAY", box(200, 350, 30, 180), "A3")
    sketch.ring("OBJECT", box(150, 162, 196, 208), "RTU-1, height 48 in")
    sketch.ring("OBJECT", box(260, 272, 13, 25), "RTU-2, height 48 in")
    return sketch.saved(folder)


CLEARANCES = [
    ("A1", "A2", "down", 8),
    ("A1", "RTU-1", "any", 6),
    ("A1", "NORTH", "up", 8),
    ("A3", "RTU-2", "down", 5),
    ("A3", "EDGE-2", "across", 10),
]


def complete(path, folder):
    """Fill in what a drawing cannot say, here as in the example; five clearances of the plan."""
    whole = folder / "whole.xlsx"
    example = read(ROOT / "projects" / "example" / "input.xlsx").project
    three = {"motions": example.motions[:3]}
    write_template(whole, units=UnitsFirst.US, example=example.model_copy(update=three))
    book, source = load_workbook(path), load_workbook(whole)
    for section in SECTIONS:
        if section.key in ("roof", "objects", "outlines", "clearances"):
            continue
        sheet, given = book[section.sheet], source[section.sheet]
        for row in given.iter_rows(min_row=5, min_col=2):
            for cell in row:
                is_place = section.key == "arrays" and _heading(given, cell)[:2] in ("x ", "y ")
                if sheet[cell.coordinate].value is None and not is_place:
                    sheet[cell.coordinate].value = cell.value
    for row, values in enumerate(CLEARANCES, start=8):
        for column, value in zip("BCDE", values, strict=True):
            value = value * 12 if column == "E" else value
            book["Clearances"][f"{column}{row}"] = value
    book.save(path)


def _heading(sheet, cell):
    return str(sheet.cell(7, cell.column).value)


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drawn")
    job = folder / "job"
    path = drawing(folder)
    for words in (["new", job], ["plan", "read", path, job]):
        done = CliRunner().invoke(main, list(map(str, words)))
        assert done.exit_code == 0, done.output
    complete(job / "input.xlsx", folder)
    shutil.copytree(ROOT / "projects" / "example" / "records", job / "records", dirs_exist_ok=True)
    with packages.unlaid(), packages.undrawn():
        done = CliRunner().invoke(main, ["report", str(job)])
    assert done.exit_code == 0, done.output
    return job, done.output


def test_the_gap_around_the_unit_is_that_of_the_outline(reported):
    job, _ = reported
    document = json.loads((job / "out" / "results.json").read_text())
    gaps = {(row["array"], row["other"]): row["gap_m"] for row in document["neighbors"]}
    # The unit is 6 ft above the lower leg and 10 ft from the upper one.
    assert gaps["A1", "RTU-1"] == pytest.approx(6 * FT, abs=1e-6)
    assert gaps["A1", "A2"] == pytest.approx(8 * FT, abs=1e-6)
    assert not any(row["contradictions"] for row in document["neighbors"])


def test_weight_per_area_takes_the_area_of_the_outline(reported):
    data = read(reported[0]).project
    first = data.arrays[0]
    assert first.shape.area_m2 == pytest.approx(shapely.Polygon(L_FT).area * FT**2, rel=1e-6)


def test_the_package_says_which_array_is_an_outline(reported):
    html = (reported[0] / "out" / "calc-package.pdf").read_text(encoding="utf-8")
    text = packages.words(html)
    assert "By an outline, of which the rectangle around it is given: A1 (6 vertices)." in text


def test_the_drawing_that_was_written_is_the_one_that_was_read(reported, tmp_path):
    job, _ = reported
    first, second = plan(drawing(tmp_path)), plan(job / "out" / "plan.dxf")
    assert second.unread == ()
    for one, two in zip(
        (*first.roof, *first.arrays, *first.objects),
        (*second.roof, *second.arrays, *second.objects),
        strict=True,
    ):
        assert (one.name, one.kind, type(one.shape)) == (two.name, two.kind, type(two.shape))
        for a, b in zip(one.shape.points, two.shape.points, strict=True):
            assert a == pytest.approx(b, abs=1e-6)
    assert isinstance(second.arrays[0].shape, Polygon)
    assert second.objects[0].height_m == pytest.approx(30 * INCH)
