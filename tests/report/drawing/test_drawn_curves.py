"""Curves of a drawing as chords that stay within 3 mm of them, wherever the library goes beyond."""

import math

import pytest
import shapely

from report.drawing.closed_lines import curve
from sketch import Sketch

pytestmark = pytest.mark.quick

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
