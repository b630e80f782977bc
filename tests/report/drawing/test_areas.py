"""Hatches, faces and meshes of a drawing, as the outlines that they show."""

import math

import pytest
import shapely
from ezdxf.render.forms import cube

from inputs import FT
from sketch import BOX_FT, ROOF_FT, UNIT_FT, Sketch, plan

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
         "a 3DFACE with a value that is no number up to 1e+12"),
    ],
)  # fmt: skip
def test_an_area_that_cannot_be_read_is_listed(tmp_path, draw, reason):
    sketch = Sketch()
    draw(sketch)
    assert shown(sketch, tmp_path) == ([], [reason])
