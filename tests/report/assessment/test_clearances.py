"""The object across each clearance, its separation, and envelopes that no run leaves."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from fixtures import assessments, project_parts, projects
from report.assessment.design.verdict import Verdict
from report.assessment.support.envelopes import design_envelope, hull, runs_envelope
from report.assessment.support.plan_gaps import keep_clear_m
from report.project.model.choices import Direction
from report.project.model.shapes import Polygon, Rectangle, gap_m
from solver.rules.provisions import Neighbor

SEVEN = assessments.motions(7, 12.0)  # half a second less than those of eight seconds
PEER = project_parts.REVIEW
SAME_SLOPE = {"slope_value": 100.0 * math.tan(math.radians(0.5)), "slope_unit": "percent"}


def assessed(shaking=SEVEN, **changes):
    return assessments.package(shaking, **changes).assessment


@pytest.fixture(scope="module")
def done():
    return assessed()


def test_clearances_take_the_factor_of_what_lies_across(done):
    unlike = Neighbor.UNLIKE  # of another slope
    wanted = [unlike, Neighbor.FIXED, unlike, Neighbor.PARAPET, Neighbor.EDGE]
    assert [item.neighbor for item in done.clearances] == wanted
    assert [item.factor for item in done.clearances] == [1.0, 1.0, 1.0, 1.0, 1.5]
    for item in done.clearances:
        assert item.required_m == pytest.approx(item.factor * item.design_m)
        assert item.demand_capacity == item.required_m / item.clearance.provided_m


def test_larger_displacements_and_low_parapets_govern():
    arrays = [projects.array("A1", 0.5, mu=0.6), projects.array("A2", 3.0, mu=0.3, x=120)]
    done = assessed(arrays=arrays, clearances=[projects.clearance("A1", "a2", 3.0)], options=PEER)
    (gap,) = done.clearances
    assert gap.governing_array == "A2"
    assert gap.design_m == done.arrays[1].design_m > done.arrays[0].design_m
    assert done.governing_gap("A2") is gap
    assert (gap.across_from("A2"), gap.across_from("A1")) == ("A1", "A2")
    objects = [projects.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=0.5)]
    done = assessed(objects=objects, clearances=[projects.clearance("A1", "N", 5.0)])
    assert done.clearances[0].neighbor is Neighbor.EDGE


@pytest.mark.parametrize(
    ("change", "neighbor"),
    [({}, Neighbor.LIKE), ({"slope_value": 0.51}, Neighbor.UNLIKE), ({"mu": 0.46}, Neighbor.UNLIKE),
     ({"mu_static": 0.5}, Neighbor.UNLIKE), ({"downslope_deg": 90.0}, Neighbor.UNLIKE),
     ({"construction": "Tray 5 deg, portrait"}, Neighbor.UNLIKE), (SAME_SLOPE, Neighbor.LIKE)],
)  # fmt: skip
def test_like_arrays_slide_alike(change, neighbor):
    arrays = [projects.array("A1", 0.5), projects.array("A2", 0.5, x=120) | change]
    (gap,) = assessed(arrays=arrays, clearances=[projects.clearance("A1", "A2", 3.0)]).clearances
    assert gap.neighbor is neighbor
    assert gap.factor == (0.5 if neighbor is Neighbor.LIKE else 1.0)


def test_importance_enters_as_each_code_has_it():
    pv1 = assessed(site=projects.site(risk_category="III", i_e=1.25))
    asce = assessed(site=projects.site(risk_category="III", i_e=1.25, rule_set="ASCE 7-16"))
    assert [gap.importance for gap in pv1.clearances] == [1.0, 1.0, 1.0, 1.25, 1.25]
    assert pv1.clearances[4].factor == 1.5 * 1.25
    assert asce.clearances[1].factor == 1.0
    ratio = asce.arrays[0].prescriptive.value_m / pv1.arrays[0].prescriptive.value_m
    assert ratio == pytest.approx(1.25)
    arrays = [projects.array("A1", 0.5) | {"i_p": 1.25}, projects.array("A2", 0.5, x=120)]
    objects = [projects.roof_object("RTU", "fixed object", 107, 112, 35, 42) | {"i_p": 1.5}]
    gaps = [projects.clearance("A2", "A1", 3.0), projects.clearance("A1", "RTU", 7.0)]
    for rule_set, expected in (("SEAOC PV1-2012", [1.25, 1.5]), ("ASCE 7-16", [1.0, 1.0])):
        done = assessed(
            arrays=arrays, objects=objects, clearances=gaps, site=projects.site(rule_set=rule_set)
        )
        assert [gap.importance for gap in done.clearances] == expected


def test_a_clearance_takes_the_full_displacement_in_any_direction():
    done = assessed(options=PEER)
    assert {gap.clearance.direction for gap in done.clearances} > {Direction.ANY}
    full_m = {item.id: item.design_m for item in done.arrays}
    for gap in done.clearances:
        beside = [full_m[name] for name in gap.between if name in full_m]
        assert gap.design_m == max(beside) == full_m[gap.governing_array]


@pytest.fixture(scope="module")
def unpermitted():
    return projects.unpermitted()


def test_without_a_permitted_route_there_is_no_required_separation_and_no_verdict(unpermitted):
    """A displacement of 0 from motions that do not qualify is no displacement to design for."""
    first, second = unpermitted.arrays
    assert (first.design_m, first.source) == (0.0, "analysis, not permitted")
    assert second.source == "prescriptive"
    for gap in unpermitted.clearances[:2]:  # also where the permitted side is the longer one
        assert math.isnan(gap.required_m)
        assert math.isnan(gap.demand_capacity)
        assert gap.governing_array == "A1"
        assert (gap.verdict, gap.ok) == (Verdict.NONE, False)
    assert unpermitted.verdict is Verdict.NG
    assert design_envelope(first) == ()
    assert math.isnan(keep_clear_m(unpermitted, first))
    assert keep_clear_m(unpermitted, second) == second.design_m


@pytest.mark.quick
def test_beside_no_permitted_route_other_clearances_keep_their_verdicts(unpermitted):
    third = unpermitted.clearances[2]
    assert third.required_m == pytest.approx(1.5 * unpermitted.arrays[1].prescriptive.value_m)
    assert third.verdict is Verdict.OK
    narrow = [projects.clearance("A2", "S edge", 5 * projects.FOOT)]
    assert projects.unpermitted(clearances=narrow).clearances[0].verdict is Verdict.NG
    assert [unpermitted.array_verdict(item) for item in unpermitted.arrays] == [Verdict.NG] * 2
    assert unpermitted.governing_gap("A2").verdict is Verdict.NONE
    alone = [projects.clearance("A2", "S edge", 15 * projects.FOOT)]
    done = projects.unpermitted(clearances=alone, objects=projects.project().objects[3:])
    assert done.array_verdict(done.arrays[1]) is not Verdict.NG


CIRCUMSCRIBED = 1.0 / math.cos(math.pi / 24)
"""Of a circle, its polygon of 24 sides around it: 0.9% outside."""


@pytest.fixture(scope="module")
def turned():
    arrays = [projects.array("A1", 2.0, downslope_deg=205.0), projects.array("A2", 3.0, x=120)]
    return assessments.package(
        assessments.motions(3, 12.0), arrays=arrays, clearances=[]
    ).assessment


def margins(outline, points):
    """Distances [m] of points inside each side of a convex outline; negative outside."""
    p, x = np.array(outline), np.array(points)
    side = np.roll(p, -1, axis=0) - p
    inward = np.column_stack((-side[:, 1], side[:, 0])) / np.hypot(*side.T)[:, None]
    return np.min(inward @ x.T - np.sum(inward * p, axis=1)[:, None], axis=0)


@pytest.mark.quick
def test_the_envelope_of_the_runs_contains_each_and_reaches_no_farther(turned):
    for array in turned.arrays:
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
    for array in turned.arrays:
        largest = max(run.result.prd_m for m in array.motions for run in m.runs)
        reach = [point_gap(array.array.shape, point) for point in runs_envelope(array)]
        assert max(reach) <= largest * CIRCUMSCRIBED + 1e-12


def point_gap(shape, point):
    if isinstance(shape, Polygon):
        return shapely.Polygon(shape.points).distance(shapely.Point(point))
    return max(gap_m(shape, Rectangle(point[0], point[0], point[1], point[1])), 0.0)


@pytest.mark.quick
def test_the_design_envelope_is_close_to_its_offset_and_needs_a_displacement(turned):
    for array in turned.arrays:
        reach = [point_gap(array.array.shape, point) for point in design_envelope(array)]
        assert max(reach) == pytest.approx(array.design_m, rel=0.009)
        for corner in array.array.shape.points:
            circle = np.linspace(0.0, 2.0 * np.pi, 100)
            points = array.design_m * np.column_stack((np.cos(circle), np.sin(circle))) + corner
            assert margins(design_envelope(array), points).min() > -1e-9
    assert design_envelope(replace(turned.arrays[0], design_m=math.nan)) == ()
    assert (
        keep_clear_m(turned, turned.arrays[0]) == turned.arrays[0].design_m
    )  # factor 1.0, I_e = 1.0


@given(st.lists(st.tuples(st.integers(-20, 20), st.integers(-20, 20)), min_size=3, max_size=40))
def test_a_hull_contains_its_points_and_is_convex(points):
    outline = hull((float(x), float(y)) for x, y in points)
    assert set(outline) <= {(float(x), float(y)) for x, y in points}
    if len(outline) > 2:
        assert margins(outline, points).min() > -1e-9


L_SHAPE = Polygon(((0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (4.0, 4.0), (4.0, 10.0), (0.0, 10.0)))


@pytest.mark.parametrize("design_m", [0.5, 2.0])
def test_the_envelope_of_an_outline_is_as_far_away_as_it_moves_everywhere(turned, design_m):
    outlined = SimpleNamespace(shape=L_SHAPE)
    moved = replace(turned.arrays[0], array=outlined, design_m=design_m)
    outline = Polygon(design_envelope(moved))
    reach = [point_gap(L_SHAPE, point) for point in outline.points]
    assert min(reach) >= design_m - 1e-9
    assert max(reach) <= design_m * CIRCUMSCRIBED + 1e-9
    # Five corners round off; in the notch two strips of the width of the move overlap.
    exact = 64.0 + 40.0 * design_m + (5.0 * math.pi / 4.0 - 1.0) * design_m**2
    assert exact <= outline.area_m2 <= exact * 1.01
