"""Drawings that are damaged, endless or no drawings are refused with the limit that they exceed."""

import io
import math
import random
import subprocess
import sys

import pytest
from ezdxf.xclip import XClip
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fixtures.commands import output_of
from fixtures.dxf import BOX_FT, LIBRECAD_R12, UNIT_FT, Sketch, plan
from fixtures.errors import input_problems
from fixtures.growth import grows_faster
from fixtures.marks import by_day, nightly
from fixtures.workbooks import make
from report.drawing_read.dxf_file import MAX_ENTITIES, MAX_VALUES
from report.drawing_read.read_dxf import MAX_LETTERS, read_dxf
from report.project.model.choices import LayerKind
from report.project.read.read import read
from solver.errors import InputError


def hostile(file, content):
    (problem,) = input_problems(read_dxf, file(content), 1.0)
    return problem


def test_a_million_entities_are_refused_with_the_limit(file):
    def entities(count):
        body = "0\nPOINT\n8\n0\n" * count
        return f"0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n"

    found = hostile(file, entities(1_000_000))
    assert found.startswith(f"2,000,004 values, more than {MAX_VALUES:,}; save only the layers")
    found = hostile(file, entities(400_000))
    assert found.startswith(f"400,003 entities, more than {MAX_ENTITIES:,}; save only the layers")


@pytest.mark.quick
def test_large_files_and_long_names_are_refused(file):
    assert hostile(file, b" " * 26_000_000).startswith("larger than 25 MB")
    sketch = Sketch()
    sketch.ring("L" * 1_000_000, BOX_FT)
    found = hostile(file, written(sketch))
    assert found.startswith(
        "1,000,000 characters in a line, more than 10,000; save only the layers"
    )


@pytest.mark.parametrize(
    ("content", "start"),
    [
        (b"AC1032\x00\x00", "a DWG drawing"),
        (b"AutoCAD Binary DXF\r\n\x1a\x00", "a binary DXF"),
        (b"%PDF-1.7\n", "a PDF; use the DXF from which it was plotted"),
        (b"PK\x03\x04\x14\x00", "a zip; unpack it and use the DXF in it"),
        (
            b'\xef\xbb\xbf<?xml version="1.0"?>\n<!-- made -->\n<svg width="9">',
            "an SVG; save it as DXF",
        ),
        (b'<?xml version="1.0"?><kml>', "XML or a web page; export the roof plan as DXF"),
        (b'\n {"type": "FeatureCollection"}', "JSON, such as GeoJSON; export the roof plan as DXF"),
        (b"\x89PNG\r\n\x1a\n", "a picture; use the drawing as DXF"),
        (b"ISO-10303-21;\n", "an IFC or STEP model; export its roof plan as DXF"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1", "a model of Revit, or an old Office file; export"),
        (b"", "not a DXF drawing"),
        (LIBRECAD_R12[:200].encode(), "not a DXF drawing"),
        (b"\x00\xff" * 1000, "not a DXF drawing"),
    ],
)
def test_what_is_no_drawing_is_refused(file, content, start):
    assert hostile(file, content).startswith(start)


@pytest.mark.parametrize("unit", ["m", "ft"])
@pytest.mark.parametrize("close", [True, False])
@pytest.mark.parametrize("corner", [(-118.25, 34.05), (34.05, -118.25), (151.2, -33.87)])
def test_a_drawing_in_degrees_is_refused_as_such(tmp_path, unit, close, corner):
    sketch = Sketch(unit=unit)
    x, y = corner
    for wide, tall in ((3e-4, 2e-4), (2e-5, 1e-5)):
        points = [(x, y), (x + wide, y), (x + wide, y + tall), (x, y + tall)]
        sketch.space.add_lwpolyline(points, close=close, dxfattribs={"layer": "ARRAY"})
    (problem,) = input_problems(read_dxf, sketch.saved(tmp_path))
    assert problem == (
        f"the drawing is in degrees: {x:.5f}, {y:.5f} is a longitude and latitude; export it in ft"
        " or m, such as in State Plane or UTM coordinates"
    )


def written(sketch):
    out = io.StringIO()
    sketch.document.write(out)
    return out.getvalue()


def nested(levels, each, *, rows=1):
    sketch = Sketch()
    previous = None
    for level in range(levels):
        block = sketch.document.blocks.new(f"B{level}")
        if previous is None:
            block.add_lwpolyline([(0, 0), (1, 0), (1, 1)], close=True)
        for k in range(each if previous else 0):
            block.add_blockref(previous, (k, 0))
        previous = block.name
    counts = {"row_count": rows, "column_count": rows}
    sketch.space.add_blockref(previous, (0, 0), dxfattribs=counts)
    return written(sketch)


@pytest.mark.nightly
def test_blocks_that_expand_without_end_are_refused(file):
    assert "expand to more than" in hostile(file, nested(7, 10))
    assert "expand to more than" in hostile(file, nested(1, 1, rows=30_000))
    assert "nested more than 8 deep" in hostile(file, nested(12, 1))


@pytest.mark.parametrize("spacing", [0, 1])
def test_an_empty_block_is_not_shown_without_end(file, spacing):
    sketch = Sketch()
    sketch.document.blocks.new("NONE")
    counts = {f"{of}_count": 30_000 for of in ("row", "column")}
    sketch.space.add_blockref("NONE", (0, 0), dxfattribs=counts | {"row_spacing": spacing})
    assert "expand to more than" in hostile(file, written(sketch))


@pytest.mark.quick
def test_a_block_that_the_drawing_does_not_have_is_listed(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    sketch.space.add_blockref("GO\u202eNE", (0, 0), dxfattribs={"layer": "ARRAY"})
    found = plan(sketch.saved(tmp_path))
    assert [place.name for place in found.arrays] == ["A1"]
    (missing,) = found.unread
    assert missing.reason == "a missing block"
    assert missing.detail == "'GONE'"


def test_a_block_without_a_name_is_listed(file):
    start, text = LIBRECAD_R12.split("0\nTEXT\n")
    path = file(f"{start}0\nINSERT\n8\nPV\n10\n0.0\n20\n0.0\n0\nTEXT\n{text}")
    (missing,) = plan(path, "m", {"PV": LayerKind.ARRAY}).unread
    assert missing.reason.startswith("an INSERT that cannot be read")


def test_bulges_and_flat_arcs_become_no_more_chords_than_they_need(tmp_path):
    sketch = Sketch()
    line = sketch.ring("OBJECT", BOX_FT, "RTU-1")
    line.set_points([(x, y, 1e-300) for x, y in BOX_FT], format="xyb")
    (found,) = plan(sketch.saved(tmp_path)).objects
    assert len(found.shape.points) == 4
    # Of a circle of 3 million km an arc 100 km long, which bulges by 417 mm.
    sketch = Sketch(unit="m")
    bulge = math.tan(1e5 / 3e9 / 4.0)
    points = [(0.0, 0.0, bulge), (1e5, 0.0, 0.0), (1e5, 1e5, 0.0)]
    sketch.space.add_lwpolyline(points, "xyb", close=True, dxfattribs={"layer": "OBJECT"})
    (line,) = read_dxf(sketch.saved(tmp_path)).lines
    chord = 1e5 / (len(line.shape.points) - 2)
    assert 0.5 * 0.003 < chord**2 / (8.0 * 3e9) <= 0.003


@pytest.mark.parametrize("letter", by_day(["\u202e", "\x00", "\x07", "\ufffe", "\u2028"], 1))
def test_what_cannot_be_printed_is_neither_printed_nor_written(tmp_path, letter):
    book = make(tmp_path)
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, f"A{letter}1")
    sketch.ring("OBJECT", UNIT_FT, letter)
    sketch.ring("NOT-KNOWN", UNIT_FT)
    path = sketch.saved(tmp_path)
    path.write_bytes(path.read_bytes().replace(b"NOT-KNOWN", f"NOT-{letter}KNOWN".encode()))
    output = output_of("plan", "read", path, book, "--replace", "--accept")
    assert "A1: array" in output
    assert " is not on the Layers worksheet: 1 on NOT-KNOWN (" in output
    assert letter not in output
    inputs = read(book).inputs
    assert inputs["arrays"][0]["id"] == "A1"
    assert "OBJ-1" in [row["id"] for row in inputs["objects"]]


@pytest.mark.nightly
def test_the_library_prints_nothing_of_its_own(file):
    path = file(LIBRECAD_R12.replace("\nVERTEX\n", "\nVERTEX\n5\n1F\n"))
    code = (
        "import sys; from pathlib import Path; from report.drawing_read.read_dxf import read_dxf;"
        "print(len(read_dxf(Path(sys.argv[1]), 1.0).lines))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, path], capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("1\n", "")


def spline(space, count=4, degree=3, knots=None, at=1.0):
    found = space.add_spline(dxfattribs={"layer": "ARRAY"})
    found.dxf.degree = degree
    found.control_points = [(at * math.cos(k), at * math.sin(k), 0.0) for k in range(count)]
    found.knots = knots or list(map(float, range(count + degree + 1)))


INF, NAN = math.inf, math.nan
MANY, NO_NUMBER, NO_AREA = (
    "of more than 2000 points",
    "with a value that is not a number up to 1e+12",
    "without an area",
)
OPEN_LINE = "an open line that is not part of a closed outline"


@pytest.mark.parametrize(
    ("draw", "reason"),
    [
        (lambda s: spline(s, 600), f"a SPLINE {MANY}"),
        (lambda s: spline(s, 1900, 1800), "a SPLINE of a degree above 10"),
        (lambda s: spline(s, knots=[0] * 4 + [INF] * 4), f"a SPLINE {NO_NUMBER}"),
        (lambda s: spline(s, knots=[8, 7, 6, 5, 4, 3, 2, 1]), OPEN_LINE),
        (lambda s: spline(s, knots=[1.0] * 999), "a SPLINE that cannot be read (ValueError)"),
        (lambda s: s.add_ellipse((0, 0), (1e200, 0), 0.5), f"an ELLIPSE {NO_NUMBER}"),
        (lambda s: s.add_ellipse((0, 0), (5, 0), 0.5, 0, 1e300), OPEN_LINE),
        (lambda s: s.add_ellipse((0, 0), (5, 0), 0.5, 1, 1), f"an ELLIPSE {NO_AREA}"),
        (lambda s: s.add_arc((0, 0), 5, NAN, 90), f"an ARC {NO_NUMBER}"),
        (lambda s: s.add_line((0, 0), (NAN, 1)), f"a LINE {NO_NUMBER}"),
        (lambda s: s.add_lwpolyline([(k, 0) for k in range(2001)]), f"a LWPOLYLINE {MANY}"),
        (lambda s: s.add_circle((0, 0), 2e12), f"a CIRCLE {NO_NUMBER}"),
    ],
)  # fmt: skip
def test_a_curve_without_measure_is_listed_with_its_cause(tmp_path, draw, reason):
    sketch = Sketch(unit="m")
    draw(sketch.space)
    found = read_dxf(sketch.saved(tmp_path))
    assert (found.lines, [item.reason for item in found.unread]) == ([], [reason])


def test_curves_and_texts_of_too_much_in_all_are_refused(tmp_path, file):
    sketch = Sketch(unit="m")
    for _ in range(300):
        sketch.space.add_circle((0, 0), 3500)
    with pytest.raises(InputError, match=r"points of curves, more than 500,000; save"):
        read_dxf(sketch.saved(tmp_path))
    sketch = Sketch()
    for _ in range(4):
        sketch.space.add_mtext("\\S1/2;" * 50_000)
    found = hostile(file, written(sketch))
    assert found.startswith(
        f"600,000 characters of text, more than {MAX_LETTERS:,}; save only the layers"
    )


def starred(k):
    return (0, 0), (math.cos(k), math.sin(k))


def ringed(k):
    angles = (math.tau * each / 3000 for each in (k, k + 1))
    return [(50 * math.cos(angle), 50 * math.sin(angle)) for angle in angles]


@pytest.mark.parametrize(
    ("line", "count", "reasons"),
    by_day([
        (starred, 300, {"three or more open lines that meet at a point"}),
        (ringed, 3000, {f"a closed line {MANY}"}),
        (lambda k: (((k // 2) % 30, k // 60), ((k // 2) % 30 + k % 2, k // 60 + 1 - k % 2)), 1800,
         {"three or more open lines that meet at a point"}),
        (lambda k: ((0, 0), (0, 0)), 300, {OPEN_LINE}),
    ], 1),
    ids=["star", "ring", "grid", "points"],
)  # fmt: skip
def test_open_lines_without_measure_are_listed(tmp_path, line, count, reasons):
    sketch = Sketch(unit="m")
    for k in range(count):
        sketch.space.add_line(*line(k))
    found = read_dxf(sketch.saved(tmp_path))
    assert found.lines == []
    assert {item.reason for item in found.unread} >= reasons


@pytest.mark.parametrize("code", by_day(["\\S1/2;", "\\C", "{\\H2x;"], 1))
def test_a_text_of_many_codes_takes_time_as_its_length(tmp_path, code):
    def drawn(count):
        sketch = Sketch()
        sketch.space.add_mtext(code * count)
        return sketch.saved(tmp_path)

    assert not grows_faster(read_dxf, drawn, 8000)


ANY = st.one_of(st.integers(-60, 60).map(float), st.floats(width=32))
POINTS = st.lists(st.tuples(ANY, ANY), min_size=0, max_size=7)
EXTRUSIONS = st.sampled_from([(0, 0, 1), (0, 0, -1), (0, 1, 0), (0, 0, 0.5)])
SETTINGS = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
CASES = pytest.mark.parametrize("count", [10, nightly(10_000)])


def is_accounted_for(path):
    """Whether everything drawn is a line, a text or named as not read."""
    try:
        found = read_dxf(path, 1.0)
    except InputError:
        return True
    return bool(found.lines or found.unread)


def hatch(sketch, points, extrusion, seed):
    made = sketch.space.add_hatch(dxfattribs={"layer": "ARRAY", "extrusion": extrusion})
    if seed % 2:
        made.paths.add_polyline_path([(x, y, seed % 5 - 2) for x, y in points], is_closed=True)
        return
    path = made.paths.add_edge_path()
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1], strict=True):
        if seed % 3 == 0 and abs(x1) < 1e3:
            path.add_arc((x0, y0), abs(x1) + 0.1, y0 if abs(y0) < 1e6 else 0.0, 270)
        path.add_line((x0, y0), (x1, y1))


def face(sketch, points, extrusion, seed):
    corners = [(x, y, seed % 7) for x, y in [*points, *BOX_FT][:4]]
    sketch.space.add_3dface(corners, dxfattribs={"layer": "ARRAY"})


def mesh(sketch, points, extrusion, seed):
    drawn = sketch.space.add_mesh(dxfattribs={"layer": "ARRAY"})
    with drawn.edit_data() as data:
        data.vertices = [(x, y, 0.0) for x, y in points or UNIT_FT]
        data.faces = [random.Random(seed).choices(range(len(data.vertices)), k=3)] * 2


def clip(sketch, points, extrusion, seed):
    sketch.document.blocks.new("UNIT").add_lwpolyline(UNIT_FT, close=True)
    look = {"layer": "ARRAY", "xscale": seed % 5 - 2 or 1, "zscale": seed % 2}
    put = sketch.space.add_blockref("UNIT", (0, 0), dxfattribs=look)
    if len(points) > 1:
        XClip(put).set_block_clipping_path(points)


@CASES
@pytest.mark.parametrize("draw", by_day([hatch, face, mesh, clip], 2))
def test_whatever_is_drawn_is_an_outline_or_named(tmp_path, draw, count):
    @settings(SETTINGS, max_examples=max(count // 4, 10))
    @given(POINTS, EXTRUSIONS, st.integers(0, 1000))
    def holds(points, extrusion, seed):
        sketch = Sketch()
        draw(sketch, points, extrusion, seed)
        # A vertical face is a side of others.
        assert is_accounted_for(sketch.saved(tmp_path)) or draw is face

    holds()


@CASES
def test_a_damaged_drawing_is_read_or_refused(tmp_path, count):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    hatch(sketch, list(UNIT_FT), (0, 0, 1), 1)
    path = sketch.saved(tmp_path)
    whole = path.read_bytes()
    start = whole.index(b"ENTITIES")
    for seed in range(count):
        chance = random.Random(seed)
        at = chance.randrange(start, len(whole))
        piece = chance.choice([b"", b"x", b"\n", b"9", b"\xff", b"  0\nENDSEC\n", b"-"])
        path.write_bytes(whole[:at] + piece + whole[at + chance.randrange(3) :])
        try:
            found = read_dxf(path)
        except InputError:
            continue
        # One that ends before its first entity shows nothing, which `plan read` refuses.
        assert found.lines or found.unread or found.repairs or not found.counts, seed
