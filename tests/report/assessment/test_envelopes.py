"""Envelopes of an array in plan: nothing that a run does is outside of them."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

import scenes
import stand_in
from report.assessment.envelopes import design_envelope, hull, keep_clear_m, runs_envelope
from report.sheet.schema.shapes import Polygon, Rectangle, closest, gap_m

pytestmark = pytest.mark.quick

CIRCUMSCRIBED = 1.0 / math.cos(math.pi / 24)
"""Of a circle, its polygon of 24 sides around it: 0.9 % outside."""


@pytest.fixture(scope="module")
def done():
    arrays = [stand_in.array("A1", 2.0, downslope_deg=205.0), stand_in.array("A2", 3.0, x=120)]
    return scenes.package(scenes.motions(3, 12.0), arrays=arrays, clearances=[]).assessment


def margins(outline, points):
    """Distances [m] of points inside each side of a convex outline; negative outside."""
    p, x = np.array(outline), np.array(points)
    side = np.roll(p, -1, axis=0) - p
    inward = np.column_stack((-side[:, 1], side[:, 0])) / np.hypot(*side.T)[:, None]
    return np.min(inward @ x.T - np.sum(inward * p, axis=1)[:, None], axis=0)


def test_the_envelope_of_the_runs_contains_each_and_reaches_no_farther(done):
    for array in done.arrays:
        outline = runs_envelope(array)
        turn = math.radians(array.array.downslope_deg)
        for motion in array.motions:
            path = motion.history()
            along, across = np.asarray(path.u_m), np.asarray(path.across_m)
            x = along * math.cos(turn) - across * math.sin(turn)
            y = along * math.sin(turn) + across * math.cos(turn)
            for corner in array.array.shape.points:
                points = np.column_stack((corner[0] + x, corner[1] + y))
                assert margins(outline, points).min() > -1e-6
    for array in done.arrays:
        largest = max(run.result.prd_m for m in array.motions for run in m.runs)
        reach = [point_gap(array.array.shape, point) for point in runs_envelope(array)]
        assert max(reach) <= largest * CIRCUMSCRIBED + 1e-12


def point_gap(shape, point):
    if isinstance(shape, Polygon):
        return shapely.Polygon(shape.points).distance(shapely.Point(point))
    return max(gap_m(shape, Rectangle(point[0], point[0], point[1], point[1])), 0.0)


def test_the_design_envelope_is_close_to_its_offset_and_needs_a_displacement(done):
    for array in done.arrays:
        reach = [point_gap(array.array.shape, point) for point in design_envelope(array)]
        assert max(reach) == pytest.approx(array.design_m, rel=0.009)
        for corner in array.array.shape.points:
            circle = np.linspace(0.0, 2.0 * np.pi, 100)
            points = array.design_m * np.column_stack((np.cos(circle), np.sin(circle))) + corner
            assert margins(design_envelope(array), points).min() > -1e-9
    assert design_envelope(replace(done.arrays[0], design_m=math.nan)) == ()
    assert keep_clear_m(done, done.arrays[0]) == done.arrays[0].design_m  # factor 1.0, I_e = 1.0


number = st.floats(-50.0, 50.0)
rectangles = st.tuples(number, st.floats(0.01, 20.0), number, st.floats(0.01, 20.0)).map(
    lambda r: Rectangle(r[0], r[0] + r[1], r[2], r[2] + r[3])
)


@given(rectangles, rectangles)
def test_closest_points_are_as_far_apart_as_the_gap(a, b):
    (xa, ya), (xb, yb) = closest(a, b)
    assert math.hypot(xa - xb, ya - yb) == pytest.approx(max(gap_m(a, b), 0.0), abs=1e-9)
    assert point_gap(a, (xa, ya)) == pytest.approx(0.0, abs=1e-9)
    assert point_gap(b, (xb, yb)) == pytest.approx(0.0, abs=1e-9)


@given(st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20)), min_size=3, max_size=40))
def test_a_hull_contains_its_points_and_is_convex(points):
    outline = hull((float(x), float(y)) for x, y in points)
    assert set(outline) <= {(float(x), float(y)) for x, y in points}
    if len(outline) > 2:
        assert margins(outline, points).min() > -1e-9


L_SHAPE = Polygon(((0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (4.0, 4.0), (4.0, 10.0), (0.0, 10.0)))


@pytest.mark.parametrize("design_m", [0.5, 2.0])
def test_the_envelope_of_an_outline_is_as_far_away_as_it_moves_everywhere(done, design_m):
    outlined = SimpleNamespace(shape=L_SHAPE)
    moved = replace(done.arrays[0], array=outlined, design_m=design_m)
    outline = Polygon(design_envelope(moved))
    reach = [point_gap(L_SHAPE, point) for point in outline.points]
    assert min(reach) >= design_m - 1e-9
    assert max(reach) <= design_m * CIRCUMSCRIBED + 1e-9
    # Five corners round off; in the notch two strips of the width of the move overlap.
    exact = 64.0 + 40.0 * design_m + (5.0 * math.pi / 4.0 - 1.0) * design_m**2
    assert exact <= outline.area_m2 <= exact * 1.01


def test_a_displacement_that_is_not_permitted_keeps_nothing_clear():
    done = stand_in.unpermitted()
    first, second = done.arrays
    assert design_envelope(first) == ()
    assert math.isnan(keep_clear_m(done, first))
    assert keep_clear_m(done, second) == second.design_m
