"""Modules of a layout become the arrays that they make up, with exact outlines."""

import cmath
import itertools
import math
import random

import pytest

from fixtures.commands import errors_of, output_of
from fixtures.dxf import Sketch, plan
from fixtures.marks import by_day
from fixtures.project_parts import INCH
from fixtures.spaces import spaced
from fixtures.workbooks import blank, edit, make, retitle
from report.drawing_read.modules import GAP_M
from report.drawing_read.plan_read import plan_of
from report.drawing_read.read_dxf import read_dxf
from report.project.model.choices import LayerKind
from report.project.model.shapes import Rectangle
from report.project.read.read import read
from solver.errors import InputError

pytestmark = pytest.mark.quick

LONG, SHORT = 2.0, 1.1
ROW, COLUMN = 0.4, 0.02
"""Gaps between the rows and the columns of modules [m]."""

PITCH_X, PITCH_Y = LONG + COLUMN, SHORT + ROW
CORNERS = ((0, 0), (LONG, 0), (LONG, SHORT), (0, SHORT))

# Rows from the bottom, each with its columns from and to; lower left corner [m].
FIELDS = {
    "A1": ((0.0, 40.0), [(0, 8)] * 5),
    "A2": ((30.0, 41.0), [(0, 6)] * 2 + [(0, 3)] * 3),  # an L
    "A3": ((60.0, 40.0), [(0, 4)] * 5),
    "A4": ((0.0, 10.0), [(0, 10)] * 4),
}
COUNTS = {"A1": 40, "A2": 21, "A3": 20, "A4": 40}


def modules(fields=FIELDS):
    """The lower left corners of modules [m]."""
    for (x, y), rows in fields.values():
        for row, (start, end) in enumerate(rows):
            yield from ((x + k * PITCH_X, y + row * PITCH_Y) for k in range(start, end))


def turned(points, deg):
    cos, sin = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return [(x * cos - y * sin, x * sin + y * cos) for x, y in points]


def layout(deg=0.0, noise=0.0, seed=1):
    """A sketch of all fields turned about the origin, with vertices that are off by a noise [m]."""
    sketch, chance = Sketch(unit="m"), random.Random(seed)
    corners = list(modules())
    chance.shuffle(corners)
    for x, y in corners:
        start = chance.randrange(4)  # any corner first, either way round
        points = turned([(x + a, y + b) for a, b in CORNERS], deg)
        points = (points[start:] + points[:start])[:: chance.choice((1, -1))]
        points = [(x + chance.uniform(-noise, noise), y + chance.uniform(-noise, noise))
                  for x, y in points]  # fmt: skip
        closed(sketch, points)
    return sketch


def closed(sketch, points, layer="ARRAY"):
    """Draw a closed line [unit of the drawing]."""
    sketch.space.add_lwpolyline(points, close=True, dxfattribs={"layer": layer})


def edges(columns):
    """Where a run of columns, or of rows, starts and ends."""
    return columns[0] * PITCH_X, (columns[1] - 1) * PITCH_X + LONG


def outline(name):
    """The exact outline of a field, from its lowest left corner."""
    (x, y), rows = FIELDS[name]
    top = (len(rows) - 1) * PITCH_Y + SHORT
    (x0, x1) = edges(rows[0])
    points = {
        "A2": [(x0, 0), (x1, 0), (x1, PITCH_Y + SHORT), (edges((0, 3))[1], PITCH_Y + SHORT),
               (edges((0, 3))[1], top), (x0, top)],
    }.get(name, [(x0, 0), (x1, 0), (x1, top), (x0, top)])  # fmt: skip
    return [(x + a, y + b) for a, b in points]


def is_ring(got, wanted, within):
    """Whether two rings have the same vertices in the same order, from any first one."""
    got, wanted = list(got), list(wanted)
    near = min(range(len(got)), key=lambda k: math.dist(got[k], wanted[0]))
    turned_on = got[near:] + got[:near]
    return len(got) == len(wanted) and all(
        math.dist(a, b) <= within for a, b in zip(turned_on, wanted, strict=True)
    )


@pytest.mark.parametrize("deg", by_day([0.0, 17.0, 45.0, -3.5, 90.0], 2))
@pytest.mark.parametrize(("noise", "within"), [(0.0, 1e-8), (0.0005, 0.0015)])
def test_modules_become_arrays_with_their_outlines(tmp_path, deg, noise, within):
    found = plan(layout(deg, noise).saved(tmp_path))
    assert found.unread == ()
    assert sorted(place.name for place in found.arrays) == sorted(FIELDS)
    for place in found.arrays:
        wanted = {name: turned(outline(name), deg) for name in FIELDS}
        (name,) = (n for n in FIELDS if is_ring(place.shape.points, wanted[n], within))
        assert place.modules == COUNTS[name]
        ((_, long, short),) = place.sizes
        assert (long, short) == pytest.approx((LONG, SHORT), abs=max(within, 1e-9))
        is_box = deg in (0.0, 90.0) and name in ("A1", "A3", "A4") and noise == 0.0
        assert isinstance(place.shape, Rectangle) or not is_box
        if deg == 0.0:
            assert place.name == name  # in reading order
            assert place.unnamed == "named in reading order"


def grid(sketch, columns, rows, x=0.0, y=0.0, skip=(), size=(LONG, SHORT), layer="ARRAY"):
    """Draw modules in columns and rows [m], but for some."""
    for k in range(columns):
        for row in range(rows):
            if (k, row) not in skip:
                x0, y0 = x + k * (size[0] + COLUMN), y + row * (size[1] + ROW)
                points = [(x0, y0), (x0 + size[0], y0), (x0 + size[0], y0 + size[1]),
                          (x0, y0 + size[1])]  # fmt: skip
                closed(sketch, points, layer)


def text(sketch, words, x, y):
    sketch.space.add_text(words, dxfattribs={"layer": "ARRAY"}).set_placement((x, y))


def counts(found):
    """The number of modules of each array by name; None for an array that is drawn as such."""
    return {place.name: place.modules or None for place in found.arrays}


@pytest.mark.parametrize(
    ("columns", "size", "wanted"),
    [
        (2, (LONG, SHORT), {"A1": None, "A2": None}),  # fewer than three equal ones
        (3, (LONG, SHORT), {"A1": 3}),
        (3, (6.0, SHORT), {"A1": None, "A2": None, "A3": None}),  # larger than a module
        (3, (LONG, 0.4), {"A1": None, "A2": None, "A3": None}),  # narrower than a module
    ],
)
def test_few_rectangles_and_those_of_other_sizes_are_arrays(tmp_path, columns, size, wanted):
    sketch = Sketch(unit="m")
    grid(sketch, columns, 1, size=size)
    assert counts(plan(sketch.saved(tmp_path))) == wanted


def test_rectangles_that_are_no_modules_are_left_and_too_many_refused(tmp_path):
    sketch = Sketch(unit="m")
    grid(sketch, 4, 1)
    grid(sketch, 1, 1, y=20.0, size=(LONG, SHORT + 0.02))
    found = plan(sketch.saved(tmp_path))
    assert counts(found) == {"A1": None, "A2": 4}
    sketch = Sketch(unit="m")
    for k in range(40):
        grid(sketch, 1, 1, x=0.001 * k)
    with pytest.raises(InputError, match="layer ARRAY: 40 module-size rectangles on one"):
        plan(sketch.saved(tmp_path))


@pytest.mark.parametrize(("gap_m", "arrays"), [(ROW - 0.02, 2), (ROW, 1), (GAP_M, 1)])
def test_gaps_up_to_a_width_are_within_an_array(tmp_path, gap_m, arrays):
    sketch = Sketch(unit="m")
    grid(sketch, 4, 2)
    found = plan_of(read_dxf(sketch.saved(tmp_path)), 1.0, {}, gap_m)
    assert [place.modules for place in found.arrays] == [8 // arrays] * arrays


def test_an_array_takes_its_name_from_a_text_inside_that_is_its_own(tmp_path):
    sketch = Sketch(unit="m")
    grid(sketch, 3, 2, y=30.0)  # two texts: the upper one is the name
    text(sketch, "ROOF B", 1.0, 31.0)
    text(sketch, "6 modules", 1.0, 30.5)
    grid(sketch, 3, 2, x=20.0, y=30.0)  # texts of the modules
    for k in range(4):
        text(sketch, f"S{k}", 20.5 + 0.5 * k, 30.5)
    grid(sketch, 3, 2)  # one text in several arrays
    grid(sketch, 3, 2, x=20.0)
    text(sketch, "10 deg", 1.0, 0.5)
    text(sketch, "10 deg", 21.0, 0.5)
    found = plan(sketch.saved(tmp_path))
    assert counts(found) == dict.fromkeys(("ROOF B", "A1", "A2", "A3"), 6)
    assert found.arrays[1].shape.bounds.x_from_m == pytest.approx(20.0)
    assert found.unread == ()


def test_modules_are_counted_once_in_blocks_with_inner_lines(tmp_path):
    sketch = Sketch(unit="m")
    block = sketch.document.blocks.new("MODULE")
    for inset in (0.0, 0.05):
        points = [(inset, inset), (LONG - inset, inset), (LONG - inset, SHORT - inset),
                  (inset, SHORT - inset)]  # fmt: skip
        block.add_lwpolyline(points, close=True)
    for k in range(3):
        at = {"layer": "ARRAY", "rotation": 90.0}
        for x in (0.0, 30.0):
            put = sketch.space.add_blockref(
                "MODULE", (x + k * (SHORT + COLUMN), 0.0), dxfattribs=at
            )
            put.add_attrib("TAG", "LG400")
    counted = {"row_count": 2, "column_count": 4, "row_spacing": PITCH_Y, "column_spacing": PITCH_X}
    put = sketch.space.add_blockref("MODULE", (0, 40), dxfattribs={"layer": "ARRAY"} | counted)
    put.add_attrib("NAME", "EAST")
    grid(sketch, 3, 1, x=60.0)
    grid(sketch, 3, 1, x=60.001)  # drawn twice
    found = plan(sketch.saved(tmp_path))
    assert counts(found) == {"EAST": 8, "A1": 3, "A2": 3, "A3": 3}
    assert {item.reason for item in found.unread} == {
        "a closed line within or around an array of modules"
    }
    assert len(found.unread) == 14 + 3
    assert found.arrays[1].shape.area_m2 == pytest.approx(LONG * (3 * SHORT + 2 * COLUMN))


def test_modules_around_openings_are_one_array_and_an_outline_around_them_no_second(tmp_path):
    sketch = Sketch(unit="m")
    grid(sketch, 4, 4, skip=[(k, row) for k in (1, 2) for row in (1, 2)])
    wide = 4 * PITCH_X
    grid(sketch, 3, 1, x=wide, size=(SHORT, LONG))  # the same, upright
    grid(sketch, 3, 1, x=wide + 5.0, size=(1.65, 1.0))
    (found,) = plan(sketch.saved(tmp_path)).arrays[:1]
    assert [n for n, *_ in found.sizes] == [15]
    around = (wide - COLUMN) * (3 * PITCH_Y + SHORT) + 3 * (SHORT + COLUMN) * LONG
    assert found.shape.area_m2 == pytest.approx(around)
    sketch = Sketch(unit="m")
    grid(sketch, 4, 3)
    for layer, y in (("ARRAY", 0.0), ("PV", 0.0), ("ARRAY", 20.0)):
        points = [(x, y + z) for x, z in ((-1, -1), (9, -1), (9, 6), (-1, 6))]
        closed(sketch, points, layer)
    found = plan(sketch.saved(tmp_path), layers={"PV": LayerKind.ARRAY})
    assert counts(found) == {"A1": None, "A2": 12}
    around = [(item.layer, item.reason) for item in found.unread]
    reason = "a closed line within or around an array of modules"
    assert around == [("ARRAY", reason), ("PV", reason)]


def test_modules_that_are_turned_to_each_other_are_arrays_of_their_own(tmp_path):
    sketch = Sketch(unit="m")
    for deg in (0.0, 30.0):
        for k in range(3):
            points = [(12.0 * deg / 30.0 + k * PITCH_X + x, y) for x, y in CORNERS]
            closed(sketch, turned(points, deg), "ARRAY-UNLIKE")
    found = plan(sketch.saved(tmp_path)).objects
    assert [(place.name, place.kind, place.modules) for place in found] == [
        ("PV-1", LayerKind.UNLIKE_ARRAY, 3), ("PV-2", LayerKind.UNLIKE_ARRAY, 3)
    ]  # fmt: skip


@pytest.mark.nightly
def test_counts_are_filled_in_where_there_is_a_column(tmp_path):
    path, book = layout().saved(tmp_path), blank(tmp_path / "input.xlsx")
    output = output_of("plan", "read", path, book, "--gap", 18, "in")
    assert "A2: array of 21 modules 78.7 in (2000 mm) by 43.3 in (1100 mm) with gaps of" in output
    assert " of at most 18.0 in (457 mm), 6 vertices, " in output
    rows = read(book).inputs["arrays"]
    assert {row["id"]: row["modules"] for row in rows} == COUNTS
    assert "it is 0; enter more than 0." in errors_of("plan", "read", path, book, "--gap", 0, "in")
    book = make(tmp_path, clearances=[])
    edit(book, lambda found: retitle(found, "Arrays", "Modules", ""))
    output_of("plan", "read", layout().saved(tmp_path), book, "--replace")
    assert [row["modules"] for row in read(book).inputs["arrays"]] == [None] * 5  # with A2 as typed


def rounded(unit, decimals, angle_deg, long=2.1):
    """A sketch of 40 modules in rows 20 in apart, the largest gap, each corner rounded."""
    sketch = Sketch(unit=unit)
    turn = cmath.rect(1.0, math.radians(angle_deg))
    for row, column in itertools.product(range(5), range(8)):
        x, y = 0.137 + column * (long + 0.02), 0.291 + row * (1.05 + 20 * INCH)
        corners = (complex(x + dx, y + dy) * turn / sketch.unit_m
                   for dx, dy in ((0, 0), (long, 0), (long, 1.05), (0, 1.05)))  # fmt: skip
        closed(sketch, [(round(z.real, decimals), round(z.imag, decimals)) for z in corners])
    return sketch


@pytest.mark.parametrize("angle_deg", by_day([0.0, 5.0, 17.0, 45.0], 2))
@pytest.mark.parametrize(
    ("unit", "decimals"), [("m", 2), ("ft", 2), ("ft", 1), ("in", 1), ("in", 0), ("mm", 0)]
)
def test_modules_that_an_export_has_rounded_are_one_array(tmp_path, angle_deg, unit, decimals):
    found = plan(rounded(unit, decimals, angle_deg).saved(tmp_path))
    (array,) = found.arrays
    assert (array.modules, found.unread) == (40, ())
    size = (8 * 2.12 - 0.02) * (5 * 1.05 + 4 * 20 * INCH)
    is_coarse = (unit, decimals) in (("ft", 1), ("in", 0))
    assert array.shape.area_m2 == pytest.approx(size, rel=1.5e-2 if is_coarse else 5e-3)
    step_in = {("ft", 1): "1.2 in (30 mm)", ("in", 0): "1.0 in (25 mm)"}.get((unit, decimals), "")
    assert ("rounded to" in array.note) == (angle_deg > 0.0 and (unit, decimals) != ("mm", 0))
    assert not is_coarse or angle_deg == 0.0 or step_in in spaced(array.note)


def test_rounded_modules_are_joined_turned_or_of_two_sizes(tmp_path):
    drawing = read_dxf(rounded("in", 0, 17.0).saved(tmp_path)).turned(-17.0)
    (array,) = plan_of(drawing, INCH, {}).arrays
    assert array.modules == 40
    # In whole inches, as they were meant: nothing says that a rounding made them.
    sketch = Sketch(unit="in")
    for k in range(12):
        long = 65 + (k >= 6)
        corners = ((0, 0), (long, 0), (long, 39), (0, 39))
        closed(sketch, [(70 * (k % 6) + x, 59 * (k // 6) + y) for x, y in corners])
    (array,) = plan(sketch.saved(tmp_path)).arrays
    assert [(count, round(long / INCH, 6)) for count, long, _ in array.sizes] == [(6, 65), (6, 66)]
    assert array.note == ""
    with pytest.raises(InputError, match=r"layer ARRAY: .* rounded to 304\.8 mm, .* more decimals"):
        plan(rounded("ft", 0, 17.0).saved(tmp_path))
