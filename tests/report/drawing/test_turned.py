"""A drawing that is turned, and sizes along the axes of an outline."""

import pytest

import scenes
from architect import at
from report.drawing.dxf import write_dxf
from report.drawing.plan import plan_drawing
from report.drawing.plan_read import own_axes
from report.drawing.read_dxf import read_dxf
from report.sheet.schema.shapes import Polygon, Rectangle
from sketch import L_FT

pytestmark = pytest.mark.quick


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


@pytest.mark.parametrize("degrees", [17.0, -90.0, 200.0])
def test_a_plan_of_ours_is_turned_with_its_texts(file, degrees):
    drawing = read_dxf(file(write_dxf(plan_drawing(scenes.package().assessment)), "plan.dxf"))
    found = drawing.turned(degrees)
    for line, was in zip(found.lines, drawing.lines, strict=True):
        for point, before in zip(line.points, was.points, strict=True):
            assert point == pytest.approx(at(before, degrees))
    for text, before in zip(found.texts, drawing.texts, strict=True):
        assert text.at == pytest.approx(at(before.at, degrees))
