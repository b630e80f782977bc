"""Roof drawings as others draw them: by layer, by name, in any version and unit."""

import io
import math

import ezdxf
import pytest
import shapely
from ezdxf.math import UCS

from fixtures import assessments, projects
from fixtures.architect_plan import at
from fixtures.dxf import BOX_FT, L_FT, LIBRECAD_R12, ROOF_FT, UNIT_FT, UNITS, Sketch, plan
from fixtures.project_parts import FT, INCH, NO_SIDES
from fixtures.spaces import spaced
from report.drawing.layers import Layer
from report.drawing.plan_dxf import write_dxf
from report.drawing.plan_layers import plan_drawing
from report.drawing_read.closed_lines import OPEN
from report.drawing_read.geometry import own_axes
from report.drawing_read.heights import first_height, read_line
from report.drawing_read.layer_names import proposed
from report.drawing_read.plan_read import LAYERS
from report.drawing_read.read_dxf import read_dxf
from report.project.model.choices import LayerKind
from report.project.model.shapes import Polygon, Rectangle

pytestmark = pytest.mark.quick


def warehouse(version="R2018", unit="ft"):
    sketch = Sketch(version, unit)
    sketch.ring("ROOF-OUTLINE", ROOF_FT)
    sketch.ring("ARRAY", L_FT, "A1")
    sketch.ring("ARRAY", BOX_FT, "A2")
    sketch.ring("OBJECT", UNIT_FT, "RTU-1, height 42.0 in (1067 mm)")
    return sketch


def in_feet(points):
    return [pytest.approx((x * FT, y * FT), abs=1e-6) for x, y in points]


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
@pytest.mark.parametrize("unit", list(UNITS))
def test_a_roof_is_read_in_its_version_and_unit(tmp_path, version, unit):
    path = warehouse(version, unit).saved(tmp_path)
    found = plan(path, unit if version == "R12" else None)
    assert [place.name for place in found.arrays] == ["A1", "A2"]
    assert list(found.arrays[0].shape.points) == in_feet(L_FT)
    assert isinstance(found.arrays[1].shape, Rectangle)
    assert list(found.arrays[1].shape.points) == in_feet(BOX_FT)
    item = found.objects[0]
    assert (item.name, item.kind) == ("RTU-1", LayerKind.FIXED)
    assert item.height_m == pytest.approx(42 * INCH)
    assert list(found.roof[0].shape.points) == in_feet(ROOF_FT)
    assert found.unread == ()


def test_the_edges_of_square_and_oblique_roofs_are_read(tmp_path):
    sketch = warehouse()
    sketch.ring("ROOF-PARAPET", ((0, 160), (240, 160), (240, 161), (0, 161)), "N")
    edges = plan(sketch.saved(tmp_path)).objects[1:]
    assert [(edge.name, edge.kind.value) for edge in edges] == [
        ("N", "edge with parapet"),
        ("EDGE-1", "edge without parapet"),
        ("EDGE-2", "edge without parapet"),
        ("EDGE-3", "edge without parapet"),
    ]
    south = edges[1].shape
    assert isinstance(south, Rectangle)
    assert list(south.points) == in_feet(((0, -1), (240, -1), (240, 0), (0, 0)))
    assert "south edge of the roof" in edges[1].unnamed
    sketch = Sketch()
    sketch.ring("ROOF-OUTLINE", ((0, 0), (100, 0), (0, 100)))
    found = plan(sketch.saved(tmp_path))
    roof = shapely.Polygon(found.roof[0].shape.points)
    lengths = [100.0, 100.0 * math.sqrt(2.0), 100.0]
    for edge, long in zip(found.objects, lengths, strict=True):
        strip = shapely.Polygon(edge.shape.points)
        assert strip.area == pytest.approx(FT * long * FT)
        assert strip.intersection(roof).area == pytest.approx(0.0, abs=1e-9)
        assert strip.distance(roof) == pytest.approx(0.0, abs=1e-9)


def test_arcs_and_rotated_coordinates_are_read_as_they_are_in_the_world(tmp_path):
    # A quarter of a circle about (0, 0), outward, and the same cut out of a square.
    bulge = math.tan(math.pi / 8.0)
    sketch = Sketch(unit="m")
    for points in ([(0, 0, 0), (9, 0, bulge), (0, 9, 0)],
                   [(9, 0, 0), (9, 9, 0), (0, 9, -bulge)]):  # fmt: skip
        sketch.space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": "ARRAY"})
    outward, inward = (place.shape.area_m2 for place in plan(sketch.saved(tmp_path)).arrays)
    most = 2.0 / 3.0 * 0.003 * 4.5 * math.pi  # of chords within 3 mm of the arc
    assert 0.0 < math.pi * 81.0 / 4.0 - outward < most
    assert 0.0 < inward - 81.0 * (1.0 - math.pi / 4.0) < most
    cos, sin = math.cos(0.5), math.sin(0.5)
    ucs = UCS(origin=(50, 10, 0), ux=(cos, sin, 0), uz=(0, 0, 1))
    sketch = Sketch()
    header = sketch.document.header
    header["$UCSORG"], header["$UCSXDIR"] = (50, 10, 0), (cos, sin, 0)
    header["$UCSYDIR"] = (-sin, cos, 0)
    points = [(p.x, p.y) for p in ucs.points_to_wcs([(0, 0), (40, 0), (40, 20), (0, 20)])]
    sketch.ring("ARRAY", points)
    shape = plan(sketch.saved(tmp_path)).arrays[0].shape
    assert isinstance(shape, Polygon)
    assert list(shape.points) == in_feet(points)
    assert shape.area_m2 == pytest.approx(800 * FT**2)


def test_blocks_are_read_where_they_are_put_with_their_attribute_as_name(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    block.add_lwpolyline([(0, 0), (4, 0), (4, 2), (0, 2)], close=True)  # on layer 0
    for name, corner, turn in (("RTU-1", (100, 50), 0), ("RTU-2", (50, 20), 90)):
        look = {"layer": "OBJECT", "rotation": turn, "xscale": 2, "yscale": 2}
        sketch.space.add_blockref("UNIT", corner, dxfattribs=look).add_attrib("TAG", name)
    outer = sketch.document.blocks.new("OUTER")
    outer.add_blockref("UNIT", (1, 1), dxfattribs={"layer": "OBJECT"})
    put = sketch.space.add_blockref("OUTER", (200, 100))  # what is nested has its attributes
    put.add_attrib("TAG", "AC-1")
    put.add_attrib("HT", "4")
    found = plan(sketch.saved(tmp_path)).objects
    assert [place.name for place in found] == ["RTU-1", "RTU-2", "AC-1"]
    assert found[2].height_m == pytest.approx(4 * FT)
    wanted = [(100, 108, 50, 54), (46, 50, 20, 28), (201, 205, 101, 103)]
    for place, sides in zip(found, wanted, strict=True):
        box = place.shape.bounds
        got = (box.x_from_m, box.x_to_m, box.y_from_m, box.y_to_m)
        assert got == pytest.approx([side * FT for side in sides])


def test_r12_without_handles_and_with_own_layers_is_read(file):
    path = file(LIBRECAD_R12.replace("\n", "\r\n"), "roof.dxf")
    (array,) = plan(path, "m", {"pv": LayerKind.ARRAY}).arrays
    assert array.name == "A7"
    assert array.shape == Rectangle(0.0, 10.0, 0.0, 5.0)


def test_a_plan_that_report_wrote_reads_back_to_itself(file):
    """With an L-shaped array, and a roof with an oblique side."""
    first, *others = (array.model_dump() for array in projects.project().arrays)
    vertices = [
        {"name": name, "x_m": x * FT, "y_m": y * FT}
        for name, ring in (("A1", L_FT), ("roof", ((0, 0), (220, 0), (220, 170), (-9, 170))))
        for x, y in ring
    ]
    package = assessments.package(arrays=[first | NO_SIDES, *others], outlines=vertices)
    path = file(write_dxf(plan_drawing(package.assessment)), "plan.dxf")
    assert read_dxf(path).layouts == ()  # a title block is no plan
    found = plan(path)
    data = package.data
    assert found.unread == ()
    assert [place.name for place in found.arrays] == [array.id for array in data.arrays]
    kinds = {place.name: place.kind.value for place in found.objects}
    assert kinds == {item.id: item.kind.value for item in data.objects}
    rows = (*data.arrays, *data.objects, data.roof)
    for place, row in zip((*found.arrays, *found.objects, *found.roof), rows, strict=True):
        assert type(place.shape) is type(row.placed)
        for point, wanted in zip(place.shape.points, row.placed.points, strict=True):
            assert point == pytest.approx(wanted, abs=1e-9)
    heights = [math.nan if item.height_m is None else item.height_m for item in data.objects]
    assert [place.height_m for place in found.objects] == pytest.approx(heights, nan_ok=True)


def test_a_height_that_is_changed_in_a_plan_of_ours_is_read_wherever_its_text_is(file):
    document = ezdxf.read(io.StringIO(write_dxf(plan_drawing(assessments.usual())).decode()))
    (text,) = document.modelspace().query('TEXT[text == "RTU-1, height 42.0 in"]')
    text.dxf.text = "RTU-1, height 50.0 in"
    text.set_placement((0.0, -90.0))
    path = file("", "changed.dxf")
    document.saveas(path)
    (unit,) = (place for place in plan(path).objects if place.name == "RTU-1")
    assert unit.height_m == pytest.approx(50.0 * INCH)


def test_what_was_not_understood_is_listed_with_handle_and_layer(tmp_path):
    sketch = warehouse()
    line = sketch.space.add_line((0, -9), (1, -8), dxfattribs={"layer": "ARRAY"})
    opened = sketch.space.add_lwpolyline([(0, 0), (5, 0), (5, 5)], dxfattribs={"layer": "ARRAY"})
    vent = sketch.ring("VENTS", UNIT_FT)
    crossed = sketch.ring("ARRAY", ((0, 0), (10, 10), (10, 0), (0, 10)))
    flat = sketch.ring("ARRAY", ((0, 0), (10, 0), (5, 0)))
    twice = sketch.ring("ARRAY", ((210, 20), (230, 20), (230, 40), (210, 40)), "A1")
    sketch.space.add_line((0, 0), (1, 1), dxfattribs={"layer": "NOTES"})
    listed = plan(sketch.saved(tmp_path)).unread
    found = {(item.handle, item.layer): (item.reason, item.detail) for item in listed}
    owner = next(p.handle for p in plan(sketch.saved(tmp_path)).arrays if p.name == "A1")
    assert found == {
        (line.dxf.handle, "ARRAY"): (OPEN, ""),
        (opened.dxf.handle, "ARRAY"): (OPEN, ""),
        (vent.dxf.handle, "VENTS"): ("a closed line on a layer that is not on the Layers"
                                     " worksheet", ""),
        (crossed.dxf.handle, "ARRAY"):
            ("a closed line that touches or crosses itself", "near 5, 5"),
        (flat.dxf.handle, "ARRAY"): ("a closed line without an area", ""),
        (twice.dxf.handle, "ARRAY"): ("a second outline of the same name", f"'A1' of {owner}"),
    }  # fmt: skip


def test_layers_and_names_are_known_or_free(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT)
    sketch.ring("ARRAY", L_FT, "A1")
    assert [place.name for place in plan(sketch.saved(tmp_path)).arrays] == ["A2", "A1"]
    assert {layer.title for layer in Layer} < LAYERS.keys()


@pytest.mark.quick
def test_a_plan_of_version_0_3_reads_back_by_its_former_layers():
    for layer, former in (
        (Layer.OUTLINE, "ROOF-OUTLINE"), (Layer.ARRAY, "ARRAY"), (Layer.UNLIKE, "ARRAY-UNLIKE"),
        (Layer.EDGE, "ROOF-EDGE"), (Layer.PARAPET, "ROOF-PARAPET"), (Layer.OBJECT, "OBJECT"),
        (Layer.DESIGN, "ENVELOPE-DESIGN"), (Layer.CLEARANCE_NG, "CLEARANCE-NG"),
        (Layer.NORTH, "NORTH"),
    ):  # fmt: skip
        assert LAYERS[former] is LAYERS[layer.title]
    assert LAYERS["ARRAY"] is LayerKind.ARRAY
    assert LAYERS["NORTH"] is LayerKind.NOT_READ


@pytest.mark.parametrize(
    ("shape", "sizes", "angle"),
    [
        (Rectangle(0.0, 8.0, 1.0, 4.0), (8.0, 3.0), 0.0),
        (Polygon(L_FT), (80.0, 55.0), 0.0),
        *((Polygon(tuple(at(p, deg) for p in L_FT)), (80.0, 55.0), deg) for deg in (17, -17, 44)),
        # From 45 deg on the other side is the one nearer x.
        *((Polygon(tuple(at(p, deg) for p in L_FT)), (55.0, 80.0), deg - 90) for deg in (46, 80)),
    ],
)
def test_sizes_are_along_the_longest_side_of_an_outline(shape, sizes, angle):
    wide, tall, found = own_axes(shape)
    assert (wide, tall) == pytest.approx(sizes)
    assert found == pytest.approx(angle, abs=1e-9)


UNIT_M = 1.0


@pytest.mark.parametrize(
    ("text", "name", "value_m", "has_unit"),
    [
        ("RTU-1, height 42.0 in (1067 mm)", "RTU-1", 42 * INCH, True),
        ("RTU-1 HEIGHT (IN): 48", "RTU-1", 48 * INCH, True),
        ("EL. [FT] = 4.5", "", 4.5 * FT, True),
        ('HEIGHT (FT): 48"', "", 48 * INCH, True),
        ('RTU-1 HT 42"', "RTU-1", 42 * INCH, True),
        ("HT: 3'-6\"", "", 3.5 * FT, True),
        ("HT 3.5 ft, 900 LBS", "", 3.5 * FT, True),
        ("Height 42 1/2''", "", 42.5 * INCH, True),
        ("ELEV 1.2 m", "", 1.2, True),
        ("ELEV: 1.2", "", 1.2, False),
        ('RTU-1 48"H', "RTU-1", 48 * INCH, True),
        ("H=4'-0\"", "", 4 * FT, True),
        ("AHU 4'-6\" H", "AHU", 4.5 * FT, True),
        ('SKYLIGHT 12 1/2" TALL', "SKYLIGHT", 12.5 * INCH, True),
        ('60"W x 48"H', "", 48 * INCH, True),
        ("RTU-2 4 ft. 6 in. high", "RTU-2", 4.5 * FT, True),
        ("RTU-2 3\u00bd' HIGH", "RTU-2", 3.5 * FT, True),
        ("RTU-2 height of 42 inches", "RTU-2", 42 * INCH, True),
        ("RTU HT 1,2 m", "RTU", 1.2, True),
        ('RTU-1,42" HIGH', "RTU-1", 42 * INCH, True),
        ("HT 4'-1/2\"", "", 48.5 * INCH, True),
        ("RTU-1 4' 1/2\" HIGH", "RTU-1", 48.5 * INCH, True),
        ('(N) RTU-1, HT 42"', "(N) RTU-1", 42 * INCH, True),
        ('(E) AHU (48"H)', "(E) AHU", 48 * INCH, True),
        ('(RTU-1, 48"H)', "RTU-1", 48 * INCH, True),
        ('RTU-1 +48"', "RTU-1", 48 * INCH, True),
        ("RTU-1 (+4'-6\")", "RTU-1", 4.5 * FT, True),
        ('RTU-1 ±48"', "RTU-1", 48 * INCH, True),
        ('RTU-1 HT +48"', "RTU-1", 48 * INCH, True),
        ('T.O. 48"', "", 48 * INCH, True),
        ('T.O. CURB = 18"', "", 18 * INCH, True),
        ('T.O.P. +30"', "", 30 * INCH, True),
        ('T/O UNIT 48"', "", 48 * INCH, True),
        ("RTU-1 TOP EL. +4'-0\"", "RTU-1", 4 * FT, True),
        ('TOP OF PARAPET EL: 30"', "", 30 * INCH, True),
        ('TOP 48"', "", 48 * INCH, True),
        ("EL. 1.2 m", "", 1.2, True),
        ("ELEVATION 1.2 m", "", 1.2, True),
        ("Z=1.2", "", 1.2, False),
        ("Z = 1200 mm", "", 1.2, True),
        ('RTU-1 48" ABOVE ROOF', "RTU-1", 48 * INCH, True),
        ('48" A.F.R.', "", 48 * INCH, True),
        ('RTU-1 48" ABV ROOF', "RTU-1", 48 * INCH, True),
        ("4'-0\" (H)", "", 4 * FT, True),
        ('HEIGHT ABOVE ROOF: 48"', "", 48 * INCH, True),
        ('T/PARAPET 30"', "", 30 * INCH, True),
        ('TOP OF EQUIPMENT CURB 18"', "", 18 * INCH, True),
        ('HT ~48"', "", 48 * INCH, True),
        ("HT .5'", "", 0.5 * FT, True),
        ("HT. .75 m", "", 0.75, True),
        ("HT.3'-6\"", "", 3.5 * FT, True),
        ("RTU-2 4 ft, 6 in. high", "RTU-2", 4.5 * FT, True),
        ("HT 4', 6\"", "", 4.5 * FT, True),
        ("HT 48 (IN.)", "", 48 * INCH, True),
        ('HT 48"±', "", 48 * INCH, True),
        ("RTU–1 HT 3’–6”", "RTU–1", 3.5 * FT, True),
        ("RTU-1 3'−6\" HIGH", "RTU-1", 3.5 * FT, True),
        ("HT 3.5 (FT)", "", 3.5 * FT, True),
        ("HT 48“", "", 48 * INCH, True),
        ("HT 0'-42\"", "", 42 * INCH, True),
        ('HT 48", 60" W', "", 48 * INCH, True),
        ("HT 1200 mm (3'-11\")", "", 1.2, True),
    ],
)
def test_a_height_is_read_with_its_unit_or_that_of_the_drawing(text, name, value_m, has_unit):
    found = read_line(text, UNIT_M)
    assert found[0] == name
    assert found[1] is not None
    assert found[1].value_m == pytest.approx(value_m)
    assert found[1].has_unit == has_unit


@pytest.mark.parametrize(
    "text", ["HT 42x60", "HT 42-48 in", "HT 42.5.1", "HEIGHT 12345678", "HT 42 yd", "HT 1,200 mm",
             'RTU 1,42" HIGH', "TANK 1,200 mm high", 'HT 481#2"', 'RTU 481#2" HIGH', 'HT 481^2"',
             "HT 42a", r'HT 48{\S1#2;}"', 'HT 48" 1/2', '60x48"H', 'H 48"', 'TOP/CURB 18"',
             '48" A.F.F.', "RTU-1 +48", "EF-1 + 2", 'HT 48" A.F.F.', 'HT 48" ABOVE GRADE',
             'HT 48±"', "HT 48´´", "HT 48%%34", 'HT 42" TO 48"', 'HT 42" OR 48"',
             'RTU 42" TO 48" HIGH', "HT 42 to 48", 'HT 42"–48"', "HT 4'-11/2\"", "HT 4' 61/2\"",
             "HT 4'-42\"", "HT 1'200 mm", "HT 1’200 mm", 'HT 24"+24"', 'HT 24" + 14" CURB',
             "HT 3'-6\" & 4'-0\"", "HT 3'-6\", 4'-0\"", "HT 1 m 20 cm", 'RTU 42" HIGH A.F.F.']
)  # fmt: skip
def test_a_number_that_is_not_read_whole_is_no_height(text):
    assert math.isnan(read_line(text, UNIT_M)[1].value_m)


@pytest.mark.parametrize(
    "text", ["HT-1", "HEIGHT VARIES", "WEIGHT 42", "ELEVATOR 2", "42 in", "H-1", "H 42", "PH=7",
             "42H", "RTU-12 H", 'DUCT TO 48"', "480V 60 Hz", "12 HIGH ST", "ROOF TOP 2",
             "ROOF-TOP UNIT 2", "GEL 5", "MODEL 48", "UP TO 48 V", "C++ 2", "(N) RTU-1"]
)  # fmt: skip
def test_a_number_that_no_word_calls_a_height_is_none(text):
    assert read_line(text, UNIT_M)[1] is None


@pytest.mark.parametrize("text", ["HT 48%%034", r"HT 4\U+0038\U+2033", 'HT %%u48"%%u', "HT %%p4'"])
def test_codes_of_letters_in_a_text_or_an_attribute_are_letters(tmp_path, text):
    sketch = Sketch()
    sketch.ring("OBJECT", UNIT_FT, text)
    block = sketch.document.blocks.new("RTU")
    block.add_lwpolyline([(x + 20, y) for x, y in UNIT_FT], close=True)
    insert = sketch.space.add_blockref("RTU", (0, 0), dxfattribs={"layer": "OBJECT"})
    insert.add_attrib("HEIGHT", text.removeprefix("HT "), (90, 60))
    heights = [item.height_m for item in plan(sketch.saved(tmp_path)).objects]
    assert heights == pytest.approx([48 * INCH] * 2)


def test_the_first_line_is_the_name_and_the_first_height_counts(tmp_path):
    lines = ["RTU-1", "HT 42 1/0 in", "EL 9 m", "HT 2 m", "HEIGHT 2.00 m"]
    height, unclear = first_height(lines, UNIT_M)
    assert height is not None
    assert (height.value_m, unclear) == (2.0, "")
    assert first_height(lines[:2], UNIT_M) == (None, "HT 42 1/0 in")
    sketch = Sketch()
    sketch.ring("OBJECT", UNIT_FT)
    look = {"layer": "OBJECT"}
    sketch.space.add_mtext('RTU-7\\P5 TONS\\PHT 48"', dxfattribs=look).set_location((69, 60))
    (item,) = plan(sketch.saved(tmp_path)).objects
    assert spaced((item.name, item.note)) == ("RTU-7", "HT 48.0 in (1219 mm)")
    assert item.height_m == pytest.approx(48 * INCH)


def test_two_heights_of_one_outline_are_listed_and_none_is_read(tmp_path):
    sketch = Sketch()
    ring = sketch.ring("OBJECT", ((0, 158), (240, 158), (240, 160), (0, 160)))
    for x, height in ((20, 60), (120, 30)):
        sketch.space.add_text(f'HT {height}"', dxfattribs={"layer": "OBJECT", "insert": (x, 159)})
    found = plan(sketch.saved(tmp_path))
    assert math.isnan(found.objects[0].height_m)
    (item,) = found.unread
    reason = "a height that could not be interpreted"
    assert (item.handle, item.reason, item.detail) == (
        ring.dxf.handle, reason, "'HT 60\"; HT 30\"'"
    )  # fmt: skip


@pytest.mark.parametrize("look", [{"xscale": -1.0}, {"extrusion": (0, 0, -1)}])
def test_a_text_of_a_mirrored_block_is_in_its_outline(tmp_path, look):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    block.add_lwpolyline([(0, 0), (8, 0), (8, 10), (0, 10)], close=True)
    block.add_text('RTU-1 HT 42"').set_placement((2, 3))
    at = (-120, 80) if "extrusion" in look else (120, 80)
    sketch.space.add_blockref("UNIT", at, dxfattribs={"layer": "OBJECT", **look})
    # Where the text would be without its mirror.
    sketch.ring("OBJECT", ((-122, 80), (-114, 80), (-114, 90), (-122, 90)))
    unit, other = plan(sketch.saved(tmp_path)).objects
    assert (unit.name, other.name) == ("RTU-1", "OBJ-1")
    assert unit.shape.bounds.x_to_m == pytest.approx(120 * FT)
    assert unit.height_m == pytest.approx(42 * INCH)
    assert math.isnan(other.height_m)


def test_a_height_that_may_be_above_a_datum_is_said_as_above_the_roof(tmp_path):
    sketch = Sketch()
    sketch.ring("OBJECT", UNIT_FT, '(N) RTU-1 T.O. 48"')
    (item,) = plan(sketch.saved(tmp_path)).objects
    assert item.name == "(N) RTU-1"
    assert spaced(item.note) == "T.O. 48.0 in (1219 mm); assumed to be above the roof"


@pytest.mark.parametrize(
    ("text", "name", "inches"),
    [
        (r'RTU-1 HT 48{\H0.7x;\S1#2;}"', "RTU-1", 48.5),
        (r'HT 48\S1/2;"', "", 48.5),
        (r"HT 48 \A1;{\H0.7x;\S3^4;} in", "", 48.75),
        (r'RTU-1 48{\S1^ 2;}" HIGH', "RTU-1", 48.5),
        ("HT 4'-{\\S1#2;}\"", "", 48.5),
        ("HT 4'-0{\\H0.7x;\\S 1 / 2 ;}\"", "", 48.5),
        (r"UNIT {\S1#2;}, HT 3{\S1#2;}'", "UNIT 1/2", 42.0),
        (r"C:\\S1 HT 48 in", r"C:\S1", 48.0),
        (r'RTU-1 {\KHT 60"\k} HT 42"', "RTU-1", 42.0),
        (r'RTU-1\P{\C1;\KHT 60"}\PHT 42"', "RTU-1", 42.0),
        (r"C:\\K HT 48 in", r"C:\K", 48.0),
    ],
)
def test_a_stacked_fraction_is_one_behind_a_blank_and_struck_text_is_none(
    tmp_path, text, name, inches
):
    sketch = Sketch()
    sketch.ring("OBJECT", UNIT_FT)
    sketch.space.add_mtext(text, dxfattribs={"layer": "OBJECT"}).set_location((69, 60))
    (item,) = plan(sketch.saved(tmp_path)).objects
    assert item.height_m == pytest.approx(inches * INCH)
    assert item.name == (name or "OBJ-1")


def test_an_attribute_of_lines_is_read_as_a_text_of_lines(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    block.add_lwpolyline([(0, 0), (8, 0), (8, 4), (0, 4)], close=True)
    put = sketch.space.add_blockref("UNIT", (50, 20), dxfattribs={"layer": "OBJECT"})
    put.add_attrib("TAG", "RTU-1")
    height = sketch.space.add_mtext(r'48{\H0.7x;\S1#2;}"')
    put.add_attrib("HT", "481#2").set_mtext(height)
    (item,) = plan(sketch.saved(tmp_path)).objects
    assert (item.name, item.height_m) == ("RTU-1", pytest.approx(48.5 * INCH))


def test_a_height_that_is_not_understood_is_listed(tmp_path):
    sketch = Sketch()
    ring = sketch.ring("OBJECT", UNIT_FT, "RTU-7 HT 42-48 in")
    found = plan(sketch.saved(tmp_path))
    assert found.objects[0].name == "RTU-7"
    assert math.isnan(found.objects[0].height_m)
    (item,) = found.unread
    assert (item.handle, item.reason, item.detail) == (
        ring.dxf.handle, "a height that could not be interpreted", "'RTU-7 HT 42-48 in'"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "layers"),
    [
        ("roof", ["A-ROOF-OTLN", "A-ROOF-OTLN-N", "a-roof", "X-ROOF|A-ROOF-OTLN", "pvcRoof", "ROOF",
                  "X-ROOF$0$A-ROOF-OTLN", "Roof Outline", "Building Outline"]),
        ("not read", ["A-ROOF-PATT", "A-ROOF-OTLN-IDEN", "G-ANNO-TTLB", "pvcSetback"]),
        ("edge with parapet", ["A-ROOF-PARAPET"]),
        ("array", ["E-SOLR-PANL", "PV_Modules", "PV Array", "Solar Panels", "pvcLayout", "PANELS",
                   "Modules", "PV", "PV - Modules"]),
        ("fixed object", ["M-HVAC-EQPM", "M-ROOF-EQPM-E", "E-POWR-EQPM", "pvcObstruction", "HVAC",
                          "Skylights", "Keepout", "KEEP-OUT", "Keep Outs", "MECHANICAL UNITS",
                          "Rooftop Units", "EXHAUST FANS"]),
        (None, ["ROOF-PV", "ROOF PLAN", "HVAC-DUCT", "A-WALL", "A-ROOF-DRAN", "E-POWR-PANL",
                "PVC PIPE", ""]),
    ],
)  # fmt: skip
def test_a_name_proposes_a_kind_or_none(kind, layers):
    assert {layer: proposed(layer) for layer in layers} == dict.fromkeys(layers, kind)
