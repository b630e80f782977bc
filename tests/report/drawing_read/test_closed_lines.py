"""Hatches, faces and meshes of a drawing, as the outlines that they show."""

import math
import random

import pytest
import shapely
from ezdxf.render.forms import cube

from fixtures.dxf import BOX_FT, ROOF_FT, UNIT_FT, Sketch, plan
from fixtures.project_parts import FT
from report.drawing_read.closed_lines import BRANCHED, OPEN, join
from report.drawing_read.curves import curve
from report.drawing_read.read_dxf import read_dxf
from report.project.model.shapes import Polygon, ring

pytestmark = pytest.mark.quick


ARRAY = {"layer": "ARRAY"}
OBJECT = {"layer": "OBJECT"}


def shown(sketch, tmp_path):
    """Kinds, areas in square feet and reasons of what is read."""
    found = plan(sketch.saved(tmp_path))
    places = [
        (p.kind.value, pytest.approx(p.shape.area_m2 / FT**2, rel=1e-3))
        for p in (*found.arrays, *found.objects)
        if p.handle
    ]
    return places, [one.reason for one in found.unread]


def hatched(sketch, points, layer="ARRAY", **look):
    hatch = sketch.space.add_hatch(dxfattribs={"layer": layer, **look})
    hatch.paths.add_polyline_path(points, is_closed=True)
    return hatch


def test_a_hatch_is_where_it_appears_with_its_holes_named(tmp_path):
    sketch = Sketch()
    hatched(sketch, [(-x, y) for x, y in BOX_FT], extrusion=(0, 0, -1))
    box = plan(sketch.saved(tmp_path)).arrays[0].shape.bounds
    assert (box.x_from_m, box.x_to_m) == pytest.approx((120 * FT, 200 * FT))
    sketch = Sketch()
    hatch = hatched(sketch, ROOF_FT)
    hatch.paths.add_polyline_path(BOX_FT, is_closed=True, flags=16)
    places, left = shown(sketch, tmp_path)
    assert places == [("array", 240 * 160)]
    assert left == ["holes of a HATCH, whose outline is read"]


def test_a_hatch_of_curves_is_read_within_3_mm(tmp_path):
    """Half a disc and half an ellipse between lines, and a circle."""
    sketch = Sketch(unit="m")
    path = sketch.space.add_hatch(dxfattribs=ARRAY).paths.add_edge_path()
    path.add_line((0, 0), (20, 0))
    path.add_arc((20, 5), 5, -90, 90)
    path.add_line((20, 10), (0, 10))
    path.add_ellipse((0, 5), (0, 5), 0.5, 0, 180)
    circle = sketch.space.add_hatch(dxfattribs=ARRAY).paths.add_edge_path()
    circle.add_arc((50, 0), 4, 0, 360)
    areas = [p.shape.area_m2 for p in plan(sketch.saved(tmp_path)).arrays]
    exact = [200 + math.pi * 12.5 + math.pi * 6.25, math.pi * 16]
    assert areas == pytest.approx(exact, rel=2e-3)
    sketch = Sketch(unit="m")
    path = sketch.space.add_hatch(dxfattribs=ARRAY).paths.add_edge_path()
    points = [(0, 0), (0, 8), (8, 8), (8, 0)]
    path.add_spline(control_points=points, degree=3, knot_values=[0, 0, 0, 0, 1, 1, 1, 1])
    path.add_line((8, 0), (0, 0))
    t = [k / 2000 for k in range(2001)]
    ys = [3 * 8 * (u * (1 - u) ** 2 + u**2 * (1 - u)) for u in t]
    xs = [3 * 8 * u**2 * (1 - u) + 8 * u**3 for u in t]
    exact = shapely.Polygon([*zip(xs, ys, strict=True)]).area
    (array,) = plan(sketch.saved(tmp_path)).arrays
    assert array.shape.area_m2 == pytest.approx(exact, rel=2e-3)


def test_faces_and_grids_are_one_outline_and_a_hatch_that_fills_a_line_is_none(tmp_path):
    sketch = Sketch()
    sketch.ring("ARRAY", BOX_FT, "A1")
    hatched(sketch, [(x + 0.001, y) for x, y in BOX_FT], "OBJECT")
    sketch.ring("OBJECT", UNIT_FT)
    hatched(sketch, [(68, 56), (74, 56), (71, 64)], "OBJECT")
    places, left = shown(sketch, tmp_path)
    assert places == [("array", 80 * 55), ("fixed object", 8 * 10)]
    assert left == ["a HATCH over a closed line"] * 2
    # A box with its four upright sides, of which the plan shows the top, in two triangles.
    sketch = Sketch()
    a, b, c, d = [(*point, 3.0) for point in UNIT_FT]
    sketch.space.add_3dface([a, b, c], dxfattribs=OBJECT)
    sketch.space.add_3dface([a, c, d], dxfattribs=OBJECT)
    for p, q in ((a, b), (b, c), (c, d), (d, a)):
        sketch.space.add_3dface([p, q, (*q[:2], 0), (*p[:2], 0)], dxfattribs=OBJECT)
    sketch.space.add_3dface([(x + 50, y, 0) for x, y in UNIT_FT], dxfattribs=OBJECT)
    assert shown(sketch, tmp_path) == ([("fixed object", 80), ("fixed object", 80)], [])
    sketch = Sketch()
    mesh = sketch.space.add_polymesh((3, 4), dxfattribs={"layer": "ARRAY"})
    cache = mesh.get_mesh_vertex_cache()
    for m in range(3):
        for n in range(4):
            cache[m, n] = (10.0 * m, 5.0 * n, m * n)
    assert shown(sketch, tmp_path) == ([("array", 20 * 15)], [])


@pytest.mark.parametrize("how", ["render_mesh", "render_polyface", "render_3dfaces"])
def test_a_mesh_is_its_outline_also_in_a_block(tmp_path, how):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    getattr(cube(center=False).scale(4, 2, 3), how)(block)
    look = OBJECT | {"rotation": 30, "xscale": 2, "yscale": -2, "zscale": 0.5}
    sketch.space.add_blockref("UNIT", (50, 50), dxfattribs=look)
    assert shown(sketch, tmp_path) == ([("fixed object", 8 * 4)], [])


@pytest.mark.parametrize(
    ("draw", "reason"),
    [
        (lambda s: hatched(s, BOX_FT, extrusion=(0, 1, 0)), "a HATCH that is not parallel to the"
         " plan"),
        (lambda s: hatched(s, [(0, 0), (9, 0)]), "a HATCH without an area"),
        (lambda s: hatched(s, [(0, 0), (math.nan, 0), (1, 1)]), "a HATCH whose boundary is not"
         " read"),
        (lambda s: s.space.add_hatch(dxfattribs=ARRAY).paths.add_edge_path().add_line((0, 0),
         (1, 1)), "a HATCH whose boundary is not closed"),
        (lambda s: s.space.add_3dface([(0, 0), (math.inf, 0), (1, 1)], dxfattribs=ARRAY),
         "a 3DFACE with a value that is not a number up to 1e+12"),
    ],
)  # fmt: skip
def test_an_area_that_cannot_be_read_is_listed(tmp_path, draw, reason):
    sketch = Sketch()
    draw(sketch)
    assert shown(sketch, tmp_path) == ([], [reason])


LOOK = {"layer": "ARRAY"}


def drawn(draw):
    space = Sketch(unit="m").space
    draw(space)
    found = curve(space[0], 0.003)
    assert not isinstance(found, str), found
    return found[0]


def bent(*points, closed):
    def draw(space):
        spline = space.add_spline(dxfattribs=LOOK)
        given = [(x, y, 0.0) for x, y in points]
        (spline.set_closed if closed else spline.set_open_uniform)(given)

    return draw


def on_circle(t):
    return 1 + 5 * math.cos(t), 2 + 5 * math.sin(t)


def on_ellipse(t):
    return 1 - 2 * math.sin(t), 2 + 5 * math.cos(t)


@pytest.mark.parametrize(
    ("draw", "at", "angles"),
    [
        (lambda s: s.add_arc((1, 2), 5, 350, 100), on_circle, (350, 460)),
        (lambda s: s.add_arc((1, 2), 5, 40, 300), on_circle, (40, 300)),
        (lambda s: s.add_ellipse((1, 2), (0, 5), 0.4, 0, math.tau), on_ellipse, (0, 360)),
    ],
)
def test_chords_are_within_3_mm_of_an_arc(draw, at, angles):
    low, high = map(math.radians, angles)
    exact = [at(low + (high - low) * k / 2000) for k in range(2001)]
    points = drawn(draw)
    assert points[0] == pytest.approx(exact[0], abs=1e-9)
    assert points[-1] == pytest.approx(exact[-1], abs=1e-9)
    assert shapely.hausdorff_distance(*map(shapely.LineString, (points, exact))) <= 0.003
    assert len(points) < 200


def test_an_arc_that_looks_down_is_mirrored():
    points = drawn(lambda s: s.add_arc((1, 0), 5, 0, 90, dxfattribs={"extrusion": (0, 0, -1)}))
    assert points[0] == pytest.approx((-6.0, 0.0))
    assert points[-1] == pytest.approx((-1.0, 5.0))


@pytest.mark.parametrize("angles", [(0, 360), (90, 450), (-180, 180)])
def test_an_arc_of_a_whole_turn_is_the_circle(angles):
    def read(draw):
        space = Sketch(unit="m").space
        draw(space)
        return curve(space[0], 0.003)

    arc = read(lambda s: s.add_arc((1, 2), 5, *angles))
    assert arc == read(lambda s: s.add_circle((1, 2), 5))
    assert arc[1]


def test_splines_stay_within_their_hulls_and_end_at_their_ends():
    # It is not clamped: the knots before its first point would lead to the origin.
    corners = ((100, 100), (110, 100), (110, 110), (100, 110))
    points = drawn(bent(*corners, closed=True))
    assert points[0] == pytest.approx(points[-1])
    assert all(100.0 <= x <= 110.0 and 100.0 <= y <= 110.0 for x, y in points)
    # A uniform cubic B-spline passes midway through (P0 + 4 P1 + P2) / 6 of its corners.
    ring = shapely.LinearRing(points)
    for k in range(4):
        (x0, y0), (x1, y1), (x2, y2) = (corners[(k + j) % 4] for j in range(3))
        on_it = shapely.Point((x0 + 4 * x1 + x2) / 6, (y0 + 4 * y1 + y2) / 6)
        assert ring.distance(on_it) <= 0.003
    points = drawn(bent((0, 0), (5, 9), (10, -9), (15, 0), closed=False))
    assert points[0] == (0.0, 0.0)
    assert points[-1] == pytest.approx((15.0, 0.0))


BOX = ((0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0))
SIDES = [(BOX[k], BOX[(k + 1) % 4]) for k in range(4)]


def found(*lines):
    rings, rest = join(lines, 0.005)
    areas = [round(Polygon(ring(points)).area_m2, 2) for points, _ in rings]
    return areas, rest


@pytest.mark.parametrize("seed", range(5))
def test_sides_in_any_order_and_direction_are_joined(seed):
    dice = random.Random(seed)
    lines = [side if dice.random() < 0.5 else side[::-1] for side in SIDES]
    dice.shuffle(lines)
    ((points, parts),), rest = join(lines, 0.005)
    assert (parts[0], rest) == (0, {})
    assert sorted(points) == sorted(BOX)
    assert Polygon(ring(points)).area_m2 == pytest.approx(40.0)


@pytest.mark.parametrize(
    ("lines", "areas", "rest"),
    [
        (SIDES[:3], [], {0: OPEN, 1: OPEN, 2: OPEN}),
        ([BOX, SIDES[3]], [40.0], {}),  # a polyline and a line
        ([(*BOX, (0.003, 0.0))], [40.0], {}),  # a polyline that closes by itself, nearly
        ([*SIDES[:3], ((0.0, 5.0), (0.0, 0.0049))], [40.0], {}),
        ([*SIDES[:3], ((0.0, 5.0), (0.0, 0.0051))], [], {0: OPEN, 1: OPEN, 2: OPEN, 3: OPEN}),
        ([*SIDES, SIDES[0], SIDES[1][::-1]], [40.0], {}),  # sides that are drawn twice
        ([*SIDES, ((8.0, 0.0), (4.0, 2.0)), ((4.0, 2.0), (4.0, 3.0))], [],
         {0: BRANCHED, 1: BRANCHED, 2: OPEN, 3: OPEN, 4: BRANCHED, 5: OPEN}),
        ([*SIDES, (BOX[0], BOX[2])], [], dict.fromkeys(range(5), BRANCHED)),
        ([*SIDES, (BOX[0], BOX[0])], [40.0], {4: OPEN}),  # a line without a length
    ],
)  # fmt: skip
def test_what_closes_in_one_way_is_joined_and_the_rest_is_returned(lines, areas, rest):
    assert found(*lines) == (areas, rest)


def test_lines_of_one_layer_are_joined_without_end(tmp_path):
    sketch = Sketch()
    for k, side in enumerate(SIDES):
        sketch.space.add_line(*side, dxfattribs={"layer": "AB"[k % 2]})
    read = read_dxf(sketch.saved(tmp_path))
    assert (read.lines, [item.reason for item in read.unread]) == ([], [OPEN] * 4)
    # Of three ends at a corner the second is near both others, which are not near each other: from
    # one of them a walk would turn around the box forever.
    lines = [((-5.0, -5.0), (-0.004, 0.0)), *SIDES[:3], (BOX[3], (0.004, 0.0))]
    assert found(*lines) == ([], dict.fromkeys(range(5), OPEN))


def test_lines_of_a_block_are_joined_with_its_name_at_each_place(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    for start, end in SIDES:
        block.add_line(start, end)
    for name, x in (("RTU-1", 0), ("RTU-2", 8)):  # with a common side
        put = sketch.space.add_blockref("UNIT", (x, 0), dxfattribs={"layer": "OBJECT"})
        put.add_attrib("NAME", name)
    found = read_dxf(sketch.saved(tmp_path))
    assert [line.name for line in found.lines] == ["RTU-1", "RTU-2"]
    assert found.unread == []
