"""Gaps between outlines: by hand, by sampling their boundaries, and as between rectangles."""

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from report.project.model import shapes
from report.project.model.shapes import Polygon, Rectangle, closest, crossing, gap_m, outside, ring

# An L: 10 m x 10 m without its upper right 6 m x 6 m.
L_SHAPE = Polygon(((0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (4.0, 4.0), (4.0, 10.0), (0.0, 10.0)))


GAPS = {
    Rectangle(6, 8, 6, 8): 2.0,  # within the notch, 2 m from both legs
    Rectangle(7, 8, 6, 8): 2.0,  # 3 m from one leg, 2 m from the other
    Rectangle(13, 14, 8, 9): 5.0,  # 3-4-5 from the corner (10, 4)
    Rectangle(4, 6, 4, 6): 0.0,  # touches both legs
    Rectangle(10, 12, 0, 1): 0.0,
    Rectangle(3, 6, 6, 8): -1.0,  # 1 m into the upright leg
    Rectangle(1, 2, 1, 3): -1.0,  # within it: the smaller side
}


@pytest.mark.parametrize(("other", "gap"), GAPS.items())
@pytest.mark.quick
def test_the_gap_to_an_l_shape_by_hand(other, gap):
    assert gap_m(L_SHAPE, other) == pytest.approx(gap, abs=1e-12)
    assert gap_m(other, L_SHAPE) == pytest.approx(gap, abs=1e-12)
    assert gap_m(L_SHAPE, other) == pytest.approx(gap_m(L_SHAPE, Polygon(other.points)), abs=1e-12)


def test_closest_points_overlaps_and_rings_by_hand():
    # Midway along facing sides.
    assert closest(L_SHAPE, Rectangle(7, 9, 6, 8)) == ((8.0, 4.0), (8.0, 6.0))
    assert closest(L_SHAPE, Rectangle(13, 14, 8, 9)) == ((10.0, 4.0), (13.0, 8.0))
    assert L_SHAPE.area_m2 == 64.0
    assert L_SHAPE.bounds == Rectangle(0.0, 10.0, 0.0, 10.0)
    assert shapes.around([L_SHAPE, Rectangle(-1.0, 2.0, 3.0, 12.0)]) == Rectangle(
        -1.0, 10.0, 0.0, 12.0
    )
    a, b = Rectangle(0, 4, 0, 7), Rectangle(-2, 6, 0, 6)  # 4 m by 6 m in common
    for one, other in itertools.product((a, Polygon(a.points)), (b, Polygon(b.points))):
        assert gap_m(one, other) == gap_m(other, one) == -4.0
    clockwise = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)]
    assert ring(clockwise) == ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    assert ring(L_SHAPE.points) == L_SHAPE.points


# No roof has a coordinate of 1e-308 m, where the polygons' own arithmetic ends.
places = st.floats(-20.0, 20.0, allow_subnormal=False)
boxes = st.tuples(*[places, st.floats(0.1, 20.0)] * 2).map(
    lambda r: Rectangle(r[0], r[0] + r[1], r[2], r[2] + r[3])
)


@given(boxes, boxes)
def test_polygons_of_four_right_angles_are_as_far_apart_as_rectangles(a, b):
    gap = gap_m(a, b)
    assume(not 0.0 < abs(gap) < 1e-6)
    assert gap_m(Polygon(a.points), Polygon(b.points)) == pytest.approx(gap, abs=1e-9)


@st.composite
def stars(draw):
    """A polygon around a point, by rising angles: neither convex nor crossing itself."""
    count = draw(st.integers(3, 9))
    x, y = draw(st.floats(-15.0, 15.0)), draw(st.floats(-15.0, 15.0))
    radii = draw(st.lists(st.floats(1.0, 8.0), min_size=count, max_size=count))
    turns = [(k + draw(st.floats(0.1, 0.9))) * 2.0 * math.pi / count for k in range(count)]
    points = [(x + r * math.cos(a), y + r * math.sin(a)) for r, a in zip(radii, turns, strict=True)]
    assume(crossing(tuple(points)) is None)
    return Polygon(ring(points))


def sampled(shape, count=400):
    points = np.array([*shape.points, shape.points[0]])
    shares = np.linspace(0.0, 1.0, count)[:, None]
    return np.concatenate([a + shares * (b - a) for a, b in itertools.pairwise(points)])


@pytest.mark.parametrize("examples", [8, pytest.param(80, marks=pytest.mark.nightly)])
def test_the_gap_is_that_between_densely_sampled_boundaries(examples):
    settings(max_examples=examples)(given(stars(), stars())(assert_gap_is_as_sampled))()


def assert_gap_is_as_sampled(a, b):
    gap = gap_m(a, b)
    p, q = sampled(a), sampled(b)
    least = min(float(np.hypot(*(q - point).T).min()) for point in p)
    step = 16.0 / 399
    if gap >= 0.0:
        assert least - step <= gap <= least + 1e-9
    else:
        assert least < step or _contains(a, b) or _contains(b, a)


def _contains(outer, inner):
    """Whether each vertex is within, by the winding of angles (no library)."""
    ends = np.array([*outer.points, outer.points[0]])
    for point in inner.points:
        angles = np.unwrap(np.arctan2(*(ends - point).T[::-1]))
        if abs(angles[-1] - angles[0]) < math.pi:
            return False
    return True


@settings(max_examples=40)
@given(boxes | stars(), boxes | stars())
def test_closest_points_lie_on_the_shapes_at_the_gap(a, b):
    gap = gap_m(a, b)
    start, end = closest(a, b)
    assert math.dist(start, end) == pytest.approx(max(gap, 0.0), abs=2e-6)
    for point, shape in ((start, a), (end, b)):
        assert shapely.Polygon(shape.points).distance(shapely.Point(point)) <= 1e-6


@pytest.mark.quick
def test_rings_that_cross_themselves_and_areas_between_shapes():
    bow_tie = ((0, 0), (1, 1), (1, 0), (0, 1))
    vertex_on_a_side = ((0, 0), (4, 0), (4, 4), (2, 0), (0, 4))
    assert crossing(bow_tie) == (0.5, 0.5)
    assert crossing(vertex_on_a_side) == (2.0, 0.0)
    assert crossing(((0, 0), (2, 0), (2, 2), (0, 2))) is None
    notch = shapes.between(L_SHAPE, Rectangle(7.0, 9.0, 6.0, 8.0))
    assert notch.bounds == Rectangle(7.0, 9.0, 4.0, 6.0)
    assert shapes.between(L_SHAPE, Rectangle(10.0, 12.0, 0.0, 1.0)) is None
    assert shapes.between(L_SHAPE, Rectangle(13, 14, 8, 9)) is None
    common = shapes.between(L_SHAPE, Rectangle(3.0, 6.0, 6.0, 8.0))
    assert common.area_m2 == 2.0


def test_parts_of_roofs_and_merged_rings_by_hand():
    assert outside(Rectangle(1, 9, 1, 3), L_SHAPE) is None
    assert outside(Rectangle(0, 4, 0, 10), L_SHAPE) is None  # along its sides
    # All corners of this strip are inside; its middle crosses the notch.
    bridge = Polygon(((1.0, 9.0), (9.0, 1.0), (9.0, 2.0), (2.0, 9.0)))
    x, y = outside(bridge, L_SHAPE)
    assert x > 4.0
    assert y > 4.0
    strip = Polygon(((0.0, 0.1), (0.1, 0.0), (3.1, 3.0), (3.0, 3.1)))
    (part,) = shapes.spans_near(strip, (0.0, 0.0), (10.0, 10.0), 0.3)
    along = [(x + y) / math.sqrt(2.0) for x, y in part]
    assert min(along) == pytest.approx(0.1 / math.sqrt(2.0))
    assert max(along) == pytest.approx(6.1 / math.sqrt(2.0))
    assert shapes.spans_near(strip, (0.0, 5.0), (5.0, 10.0), 0.3) == []
    sides = [((0, 0), (5, 0), (5, 1), (0, 1)), ((4, 0), (5, 0), (5, 5), (4, 5)),
             ((0, 4), (5, 4), (5, 5), (0, 5)), ((0, 0), (1, 0), (1, 5), (0, 5))]  # fmt: skip
    assert Polygon(shapes.merged(sides)).area_m2 == 25.0
    long_leg = Polygon(((0, 0), (20, 0), (20, 4), (4, 4), (4, 10), (0, 10)))
    assert shapes.room(long_leg) == Rectangle(0, 20, 0, 4)
    assert shapes.room(Rectangle(0, 1, 0, 2)) == Rectangle(0, 1, 0, 2)


@settings(max_examples=30)
@given(stars())
def test_the_room_is_within(shape):
    box = shapes.room(shape)
    assert box.area_m2 > 0.0
    assert outside(box, shape) is None
