"""Requirements beside the numeric limits, and the three verdicts."""

import datetime as dt
from dataclasses import replace

import pytest

import stand_in
from report.assessment.verdict import Verdict, worst
from solver.records.acceptance_row import Consequence

STATED = {
    "peer_reviewer": "Reviewer of record",
    "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1),
}


def assessed(**changes):
    return stand_in.assess_input(stand_in.project(**changes), stand_in.motions(3, seconds=8.0))


def site(**changes):
    return stand_in.project().site.model_dump() | changes


def row(done, key):
    return next((item for item in done.rows if item.id == key), None)


def test_the_worst_verdict_is_ng_and_none_is_ok():
    assert worst([]) is Verdict.OK
    assert worst([Verdict.OK, Verdict.CONDITIONS]) is Verdict.CONDITIONS
    assert worst([Verdict.NG, Verdict.CONDITIONS]) is Verdict.NG


@pytest.mark.parametrize("missing", [None, *STATED])
def test_a_peer_review_without_name_license_and_date_is_a_condition(missing):
    given = {name: value for name, value in STATED.items() if name != missing}
    done = assessed(options={"peer_reviewed": True, **given})
    found = row(done, "peer_review")
    assert found.is_satisfied is (missing is None)
    assert found.consequence is Consequence.CONDITION
    assert row(assessed(), "peer_review") is None


@pytest.mark.parametrize(
    ("hazard", "satisfied"),
    [("mapped values", False), ("site-specific analysis", True), ("exception of 11.4.8", True)],
)
def test_site_class_d_with_a_large_s_1_asks_for_a_hazard_analysis(hazard, satisfied):
    assert row(assessed(site=site(hazard=hazard)), "site_specific_hazard").is_satisfied is satisfied
    assert row(assessed(site=site(site_class="C")), "site_specific_hazard") is None


def test_fire_lanes_limit_an_array_to_150_feet():
    def array(to_ft):
        return stand_in.array("A1", 0.5) | {"x_to_m": to_ft * stand_in.FOOT}

    for to_ft, satisfied in ((170.0, True), (170.1, False)):
        done = assessed(arrays=[array(to_ft)], clearances=[])
        assert row(done, "fire_lanes").is_satisfied is satisfied


def test_interconnection_and_slack_are_conditions_without_a_value_and_ng_with_too_little():
    for key, field in (("interconnection", "interconnection_n"), ("electrical_slack", "slack_m")):
        plain = assessed(arrays=[stand_in.array("A1", 0.5)], clearances=[])
        item = plain.arrays[0]
        assert row(plain, key).verdict is Verdict.CONDITIONS
        needed = item.interconnection_n if key == "interconnection" else item.design_m
        for factor, verdict in ((1.001, Verdict.OK), (0.999, Verdict.NG)):
            array = stand_in.array("A1", 0.5) | {field: needed * factor}
            done = assessed(arrays=[array], clearances=[])
            assert row(done, key).verdict is verdict
            assert (done.array_verdict(done.arrays[0]) is Verdict.NG) is (verdict is Verdict.NG)


def test_a_clearance_that_five_percent_less_friction_breaks_is_a_condition():
    options = {"peer_reviewed": True, **STATED}
    wide = [stand_in.clearance("A1", "RTU-1", 30.0)]
    given = assessed(options=options, clearances=wide)
    assert row(given, "less_friction") is None
    middle = (given.clearances[0].required_m + given.less.clearances[0].required_m) / 2.0
    gap = [wide[0] | {"provided_m": middle}]
    done = assessed(options=options, clearances=gap)
    assert done.clearances[0].ok
    assert not done.less.clearances[0].ok
    assert row(done, "less_friction").verdict is Verdict.CONDITIONS
    assert "5 % less friction" in row(done, "less_friction").remedy


@pytest.mark.parametrize("provided", [None, 6.0])
@pytest.mark.parametrize(("apart_ft", "verdict"), [(2.0, Verdict.NG), (6.0, Verdict.CONDITIONS)])
def test_a_gap_of_the_plan_without_a_clearance_is_ng_where_it_is_too_small(
    provided, apart_ft, verdict
):
    """A row that is deleted turns no NG into a condition."""
    unit = stand_in.roof_object("RTU-1", "fixed object", 100 + apart_ft, 112, 35, 42)
    rows = [stand_in.clearance("A1", "RTU-1", provided * stand_in.FOOT)] if provided else []
    done = assessed(arrays=[stand_in.array("A1", 0.5)], objects=[unit], clearances=rows)
    (near,) = done.neighbors
    assert near.required_m == done.arrays[0].design_m  # factor 1.0, I_p 1.0
    assert 2.0 * stand_in.FOOT < near.required_m < 6.0 * stand_in.FOOT < near.reach_m
    found = row(done, "neighbors")
    if provided == apart_ft:
        assert found is None
        return
    expected = Verdict.CONDITIONS if provided else verdict
    assert found.verdict is expected
    assert (done.array_verdict(done.arrays[0]) is Verdict.NG) is (expected is Verdict.NG)
    if expected is Verdict.NG:
        assert "24.0 in (610 mm) in plan" in found.found
        assert found.limit.startswith("≥ ")
    if provided:
        assert "24.0 in (610 mm) apart in plan, which would be NG; correct" in found.remedy


def test_an_edge_beyond_twice_the_displacement_that_is_nearer_than_required_is_ng():
    """ASCE asks for 4 ft to an edge, however little an array moves."""
    outline = {"x_from_m": 0.0, "x_to_m": 50.0, "y_from_m": 15 * stand_in.FOOT - 1.0,
               "y_to_m": 50.0}  # fmt: skip
    done = assessed(
        arrays=[stand_in.array("A1", 0.5, mu=1.4)], objects=[], clearances=[], roof=outline,
        options={"peer_reviewed": True, **STATED}, site=site(rule_set="ASCE 7-16"),
    )  # fmt: skip
    (near,) = done.neighbors
    assert near.gap_m == pytest.approx(1.0)
    assert near.reach_m < near.gap_m < near.required_m == pytest.approx(4 * stand_in.FOOT)
    assert row(done, "neighbors").verdict is Verdict.NG
    assert "nearer than is required" in row(done, "neighbors").remedy


def test_a_value_from_analysis_that_is_not_permitted_is_named_so():
    """The motions have no vertical component, and the friction is too small for prescription."""
    motions = [
        replace(motion, az_mps2=stand_in.NO_RECORD) for motion in stand_in.motions(3, seconds=8.0)
    ]
    arrays = [stand_in.array("A1", 0.5, mu=0.3), stand_in.array("A2", 0.5, x=120)]
    done = stand_in.assess_input(stand_in.project(arrays=arrays, clearances=[]), motions)
    low, high = done.arrays
    assert [low.source, high.source] == ["floor, not permitted", "prescriptive"]
    assert [low.is_permitted, high.is_permitted] == [False, True]
    assert done.array_verdict(low) is Verdict.NG
    found = row(done, "motions")
    assert found.verdict is Verdict.NG
    assert "the value from analysis is not permitted" in found.remedy


def test_a_route_that_five_percent_less_friction_closes_is_a_condition():
    motions = [
        replace(motion, az_mps2=stand_in.NO_RECORD) for motion in stand_in.motions(3, seconds=8.0)
    ]
    for mu, is_closed in ((0.41, True), (0.43, False)):  # the limit is 0.40
        arrays = [stand_in.array("A1", 0.5, mu=mu)]
        done = stand_in.assess_input(stand_in.project(arrays=arrays, clearances=[]), motions)
        found = row(done, "less_friction")
        assert (found is not None) is is_closed
        if is_closed:
            assert found.title == "The prescriptive route with 5 % less friction"
            assert found.verdict is Verdict.CONDITIONS
            assert found.remedy == (
                "With 5 % less friction no route is permitted: confirm the friction coefficient."
            )
