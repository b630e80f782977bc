"""The object across each clearance, its required separation, and the governing displacement."""

import math

import pytest

import scenes
import stand_in
from report.assessment.verdict import Verdict
from report.sheet.schema.choices import Direction
from solver.rules.provisions import Neighbor

SEVEN = scenes.motions(7, 12.0)  # half a second less than those of eight seconds
PEER = {"peer_reviewed": True}
SAME_SLOPE = {"slope_value": 100.0 * math.tan(math.radians(0.5)), "slope_unit": "percent"}


def assessed(shaking=SEVEN, **changes):
    return scenes.package(shaking, **changes).assessment


@pytest.fixture(scope="module")
def done():
    return assessed()


def test_clearances_take_the_factor_of_what_lies_across(done):
    assert [(item.neighbor, item.factor) for item in done.clearances] == [
        (Neighbor.UNLIKE, 1.0),  # of another slope
        (Neighbor.FIXED, 1.0),
        (Neighbor.UNLIKE, 1.0),
        (Neighbor.PARAPET, 1.0),
        (Neighbor.EDGE, 1.5),
    ]
    for item in done.clearances:
        assert item.required_m == pytest.approx(item.factor * item.design_m)
        assert item.demand_capacity == item.required_m / item.clearance.provided_m


def test_larger_displacements_and_low_parapets_govern():
    arrays = [stand_in.array("A1", 0.5, mu=0.6), stand_in.array("A2", 3.0, mu=0.3, x=120)]
    done = assessed(arrays=arrays, clearances=[stand_in.clearance("A1", "a2", 3.0)], options=PEER)
    (gap,) = done.clearances
    assert gap.governing_array == "A2"
    assert gap.design_m == done.arrays[1].design_m > done.arrays[0].design_m
    assert done.governing_gap("A2") is gap
    assert (gap.across_from("A2"), gap.across_from("A1")) == ("A1", "A2")
    objects = [stand_in.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=0.5)]
    done = assessed(objects=objects, clearances=[stand_in.clearance("A1", "N", 5.0)])
    assert done.clearances[0].neighbor is Neighbor.EDGE


@pytest.mark.parametrize(
    ("change", "neighbor"),
    [
        ({}, Neighbor.LIKE),
        ({"slope_value": 0.6}, Neighbor.UNLIKE),
        ({"slope_value": 0.51}, Neighbor.UNLIKE),
        ({"mu": 0.46}, Neighbor.UNLIKE),
        ({"mu_static": 0.5}, Neighbor.UNLIKE),
        ({"downslope_deg": 90.0}, Neighbor.UNLIKE),
        ({"construction": "Tray 5 deg, portrait"}, Neighbor.UNLIKE),
        (SAME_SLOPE, Neighbor.LIKE),
    ],
)
def test_like_arrays_slide_alike(change, neighbor):
    arrays = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=120) | change]
    (gap,) = assessed(arrays=arrays, clearances=[stand_in.clearance("A1", "A2", 3.0)]).clearances
    assert gap.neighbor is neighbor
    assert gap.factor == (0.5 if neighbor is Neighbor.LIKE else 1.0)


def test_importance_enters_as_each_code_has_it():
    pv1 = assessed(site=stand_in.site(risk_category="III", i_e=1.25))
    asce = assessed(site=stand_in.site(risk_category="III", i_e=1.25, rule_set="ASCE 7-16"))
    assert [gap.importance for gap in pv1.clearances] == [1.0, 1.0, 1.0, 1.25, 1.25]
    assert pv1.clearances[4].factor == 1.5 * 1.25
    assert asce.clearances[1].factor == 1.0
    ratio = asce.arrays[0].prescriptive.value_m / pv1.arrays[0].prescriptive.value_m
    assert ratio == pytest.approx(1.25)
    arrays = [stand_in.array("A1", 0.5) | {"i_p": 1.25}, stand_in.array("A2", 0.5, x=120)]
    objects = [stand_in.roof_object("RTU", "fixed object", 107, 112, 35, 42) | {"i_p": 1.5}]
    gaps = [stand_in.clearance("A2", "A1", 3.0), stand_in.clearance("A1", "RTU", 7.0)]
    for rule_set, expected in (("SEAOC PV1-2012", [1.25, 1.5]), ("ASCE 7-16", [1.0, 1.0])):
        done = assessed(
            arrays=arrays, objects=objects, clearances=gaps, site=stand_in.site(rule_set=rule_set)
        )
        assert [gap.importance for gap in done.clearances] == expected


@pytest.mark.quick
def test_asce_requires_four_feet_to_an_edge():
    resting = scenes.motions(7, 12.0, peak_g=0.05, vertical_peak_g=0.01)
    site = stand_in.site(rule_set="ASCE 7-16", s_ds_g=0.5)
    done = assessed(resting, site=site, options=PEER)
    edge = done.clearances[4]
    assert edge.required_m == pytest.approx(4 * 0.3048)
    assert edge.is_minimum_value
    assert not done.clearances[1].is_minimum_value


def test_a_clearance_takes_the_full_displacement_unless_the_workbook_departs():
    full = assessed(options=PEER)
    assert {gap.governing_direction for gap in full.clearances} == {Direction.ANY}
    by_direction = assessed(options=scenes.REVIEW | scenes.DEPARTURE)
    pairs = list(zip(full.clearances, by_direction.clearances, strict=True))
    assert all(one.design_m >= other.design_m for one, other in pairs)
    assert any(one.design_m > other.design_m for one, other in pairs)


@pytest.fixture(scope="module")
def unpermitted():
    return stand_in.unpermitted()


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


@pytest.mark.quick
def test_beside_no_permitted_route_other_clearances_keep_their_verdicts(unpermitted):
    third = unpermitted.clearances[2]
    assert third.required_m == pytest.approx(1.5 * unpermitted.arrays[1].prescriptive.value_m)
    assert third.verdict is Verdict.OK
    narrow = [stand_in.clearance("A2", "S edge", 5 * stand_in.FOOT)]
    assert stand_in.unpermitted(clearances=narrow).clearances[0].verdict is Verdict.NG
    assert [unpermitted.array_verdict(item) for item in unpermitted.arrays] == [Verdict.NG] * 2
    assert unpermitted.governing_gap("A2").verdict is Verdict.NONE
    alone = [stand_in.clearance("A2", "S edge", 15 * stand_in.FOOT)]
    done = stand_in.unpermitted(clearances=alone, objects=stand_in.project().objects[3:])
    assert done.array_verdict(done.arrays[1]) is not Verdict.NG
