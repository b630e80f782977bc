"""Requirements beside the numeric limits, and the three verdicts."""

import datetime as dt

import pytest

import scenes
import stand_in
from report.assessment.hazard_rows import hazard_rows
from report.assessment.verdict import Verdict, worst
from solver.records.acceptance_row import Consequence

STATED = {
    "peer_reviewer": "Reviewer of record",
    "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1),
}


def assessed(**changes):
    return scenes.package(**changes).assessment


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
    assert (
        row(assessed(site=stand_in.site(hazard=hazard)), "site_specific_hazard").is_satisfied
        is satisfied
    )
    assert row(assessed(site=stand_in.site(site_class="C")), "site_specific_hazard") is None


SOURCED = {"hazard_source": "ASCE 7 Hazard Tool", "hazard_date": dt.date(2026, 2, 20)}
BLANK = dict.fromkeys(("s_s_g", "s_1_g", "f_a", "f_v", "s_ms_g", "s_m1_g", "s_d1_g", "site_class"))


def conditions(**changes):
    """Ids of the open requirements on the hazard."""
    keys = ("hazard_source", "sdc", "site_class", "site_specific_hazard")
    found = hazard_rows(stand_in.project(site=stand_in.site(**changes)))
    assert {item.consequence for item in found} == {Consequence.CONDITION}
    return [key for key in keys for item in found if item.id == key and not item.is_satisfied]


@pytest.mark.parametrize("missing", [None, *SOURCED])
def test_a_hazard_without_source_or_date_is_a_condition(missing):
    given = {name: value for name, value in SOURCED.items() if name != missing}
    assert conditions(site_class="C", **given) == (["hazard_source"] if missing else [])


def test_s_ds_alone_is_ok_with_conditions_at_most():
    alone = conditions(**BLANK | {"s_ds_g": 1.0})
    assert alone == ["hazard_source", "sdc", "site_class", "site_specific_hazard"]
    assert conditions(**BLANK | SOURCED | {"s_ds_g": 1.0, "site_class": "C"}) == ["sdc"]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "S_1 and S_D1 not given: SDC D is not confirmed"),
        ({"s_1_g": 0.5}, "S_D1 not given: SDC D is not confirmed"),
        ({"s_d1_g": 0.5}, "S_1 not given: SDC D is not confirmed"),
        ({"s_1_g": 0.5, "s_m1_g": 0.9}, "S_1 = 0.500 g, S_D1 = 0.600 g"),
        ({"s_1_g": 0.5, "f_v": 1.8}, "S_1 = 0.500 g, S_D1 = 0.600 g"),
    ],
)
def test_the_sdc_is_confirmed_by_s_1_and_s_d1_only(given, words):
    data = stand_in.project(site=stand_in.site(**BLANK | given | {"s_ds_g": 1.0}))
    (found,) = (item for item in hazard_rows(data) if item.id == "sdc")
    assert found.found == words
    assert found.is_satisfied is ("not" not in words)
    assert data.site.sdc_text == ("D" if found.is_satisfied else "D (not confirmed)")


@pytest.mark.parametrize("site_class", [None, "D (default)"])
def test_site_class_d_by_default_says_11_4_8(site_class):
    found = hazard_rows(stand_in.project(site=stand_in.site(site_class=site_class)))
    (by_default,) = (item for item in found if item.id == "site_class")
    assert not by_default.is_satisfied
    assert "F_a is then at least 1.2" in by_default.remedy
    assert "ASCE 7-16 11.4.8" in by_default.remedy
    (asked,) = (item for item in found if item.id == "site_specific_hazard")
    assert asked.title == "Hazard analysis for site class D by default with S_1 = 0.7 g"
    assert conditions(site_class=site_class, s_1_g=0.1, **SOURCED) == ["site_class"]
    studied = {"hazard": "site-specific analysis", "hazard_report": "GE-12", **SOURCED}
    assert conditions(site_class=site_class, **studied) == []


def test_a_site_class_is_asked_for_with_any_edition():
    given = BLANK | SOURCED | {"s_ms_g": 1.5, "s_1_g": 0.5, "s_m1_g": 0.6}
    given |= {"s_ds_g": None, "edition_name": "ASCE 7-22"}
    assert conditions(**given) == ["site_class"]
    (found,) = (
        item
        for item in hazard_rows(stand_in.project(site=stand_in.site(**given)))
        if item.id == "site_class"
    )
    assert "11.4.8" not in found.remedy


@pytest.mark.parametrize(
    ("given", "asked"),
    [
        ({"site_class": "D", "s_1_g": None}, "site class D, S_1 not given"),
        ({"site_class": "E", "s_s_g": 0.9, "s_1_g": 0.05}, "site class E with S_S = 0.9 g"),
        ({"site_class": "E", "s_s_g": 0.5, "s_1_g": 0.15}, "site class E with S_1 = 0.15 g"),
        ({"site_class": "E", "s_s_g": None, "s_1_g": 0.05}, "site class E, S_S not given"),
        ({"site_class": "E", "s_s_g": 0.5, "s_1_g": 0.05}, ""),
        ({"site_class": "D", "s_1_g": 0.1}, ""),
    ],
)
def test_what_11_4_8_asks_for_is_said_also_where_it_cannot_be_told(given, asked):
    rows = hazard_rows(stand_in.project(site=stand_in.site(**given)))
    found = [item.title for item in rows if item.id == "site_specific_hazard"]
    assert found == ([f"Hazard analysis for {asked}"] if asked else [])


@pytest.mark.parametrize("missing", [None, "hazard_report", *SOURCED])
def test_a_site_specific_analysis_without_its_report_is_a_condition(missing):
    stated = {"hazard_report": "GE-12", **SOURCED}
    given = {name: value for name, value in stated.items() if name != missing}
    data = stand_in.project(site=stand_in.site(hazard="site-specific analysis", **given))
    (found,) = (item for item in hazard_rows(data) if item.id == "hazard_source")
    assert found.title == "Report on the site-specific hazard analysis"
    assert found.is_satisfied is (missing is None)
    assert found.verdict is (Verdict.CONDITIONS if missing else Verdict.OK)


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
        options={"peer_reviewed": True, **STATED}, site=stand_in.site(rule_set="ASCE 7-16"),
    )  # fmt: skip
    (near,) = done.neighbors
    assert near.gap_m == pytest.approx(1.0)
    assert near.reach_m < near.gap_m < near.required_m == pytest.approx(4 * stand_in.FOOT)
    assert row(done, "neighbors").verdict is Verdict.NG
    assert "nearer than is required" in row(done, "neighbors").remedy


def test_a_value_from_analysis_that_is_not_permitted_is_named_so():
    """The motions have no vertical component, and the friction is too small for prescription."""
    arrays = [stand_in.array("A1", 0.5, mu=0.3), stand_in.array("A2", 0.5, x=120)]
    done = scenes.package(scenes.level(), arrays=arrays, clearances=[]).assessment
    low, high = done.arrays
    assert [low.source, high.source] == ["floor, not permitted", "prescriptive"]
    assert [low.is_permitted, high.is_permitted] == [False, True]
    assert done.array_verdict(low) is Verdict.NG
    found = row(done, "motions")
    assert found.verdict is Verdict.NG
    assert "the value from analysis is not permitted" in found.remedy


def test_no_slack_and_no_gap_of_the_plan_is_enough_for_a_displacement_that_is_not_permitted():
    done = stand_in.unpermitted(clearances=[])
    found = row(done, "electrical_slack")
    assert (found.subject, found.verdict) == ("A1", Verdict.NG)
    near = next(item for item in done.rows if item.title == "Clearance A1 to RTU-1")
    assert near.verdict is Verdict.NG
    for item in (found, near):
        assert item.limit == "unknown without a permitted design displacement"
    reach = "or the prescriptive one where none is permitted (163.1 in (4144 mm))"
    assert reach in near.remedy
    assert not any(item.title.startswith("Clearance A2 to S") for item in done.rows)


def test_a_route_that_five_percent_less_friction_closes_is_a_condition():
    for mu, is_closed in ((0.41, True), (0.43, False)):  # the limit is 0.40
        arrays = [stand_in.array("A1", 0.5, mu=mu)]
        done = scenes.package(scenes.level(), arrays=arrays, clearances=[]).assessment
        found = row(done, "less_friction")
        assert (found is not None) is is_closed
        if is_closed:
            assert found.title == "The prescriptive route with 5 % less friction"
            assert found.verdict is Verdict.CONDITIONS
            assert found.remedy == (
                "With 5 % less friction no route is permitted: confirm the friction coefficient."
            )
