"""Requirements other than the numeric limits, and the three verdicts."""

import datetime as dt
import math

import numpy as np
import pytest

from fixtures import assessments, project_parts, projects
from fixtures.pages import page_of
from fixtures.projects import FOOT, INCH
from fixtures.spaces import spaced
from report.assessment.checks import (
    capacities,
    confirmations,
    motion_checks,
    seismic_parameters,
)
from report.assessment.checks.sentence import found_and_limit, words
from report.assessment.design.verdict import Verdict, worst
from report.text.units import PRESSURES, WEIGHTS
from solver import design_spectrum, spectrum
from solver.rules.limit import Consequence


def assessed(shaking=None, **changes):
    return assessments.package(shaking, **changes).assessment


def row(done, key):
    return next((item for item in done.checks if item.id == key), None)


def texts(check, *, us_first=True):
    return found_and_limit(check, us_first)


@pytest.mark.quick
def test_verdicts_have_an_order_and_a_site_specific_analysis_asks_for_its_report():
    assert worst([]) is Verdict.OK
    assert worst([Verdict.OK, Verdict.CONDITION]) is Verdict.CONDITION
    assert worst([Verdict.NG, Verdict.CONDITION]) is Verdict.NG
    title = "Report on the site-specific hazard analysis"
    assert hazard_of(**STUDIED)["hazard_source"].title == title


def without(given, missing):
    return {name: value for name, value in given.items() if name != missing}


@pytest.mark.parametrize(
    "missing", [None, "peer_reviewer", "peer_license", "peer_date", "peer_letter"]
)
def test_a_peer_review_without_name_license_date_and_letter_is_a_condition(missing):
    assert row(assessed(), "peer_review") is None
    done = assessed(options=without(assessments.REVIEW, missing))
    found = row(done, "peer_review")
    assert found.is_satisfied is (missing is None)
    assert found.consequence is Consequence.CONDITION
    # Without any of the four nothing rests on it.
    assert all((item.floor_m == 0.0) is (missing is None) for item in done.arrays)


def test_a_typed_name_alone_removes_no_floor_and_turns_no_clearance_ok():
    # The floor alone needs more than is provided: by analysis the arrays hardly slide.
    given = {"arrays": [projects.array("A1", 0.5)], "objects": [projects.SECTIONS["objects"][0]],
             "clearances": [projects.clearance("A1", "RTU-1", 30 * INCH)]}  # fmt: skip
    weak = assessments.motions(peak_g=0.1)
    name = {"peer_reviewed": True, "peer_reviewer": "J"}
    plain, named, reviewed = (
        assessments.package(weak, **given | {"options": options})
        for options in ({}, name, assessments.REVIEW)
    )
    (before,), (after,), (last,) = (p.assessment.clearances for p in (plain, named, reviewed))
    assert before.demand_capacity == after.demand_capacity == pytest.approx(1.36, abs=0.005)
    assert (after.verdict, last.verdict) == (Verdict.NG, Verdict.OK)
    said = row(named.assessment, "peer_review")
    assert said.found == "J; license, date, letter missing"
    assert "until then the floor of the analysis procedure applies" in said.remedy
    text = page_of(named, "basis")
    assert (
        "The peer review entered is not accepted (Section 1); the floor in Section 2 applies."
        in text
    )
    assert "removed by peer review" not in page_of(named, "summary")


@pytest.mark.parametrize(
    ("rule_set", "sdc", "lifts"),
    [("ASCE 7-16", "C", True), ("ASCE 7-16", "D", False), ("SEAOC PV1-2012", "C", False)],
)
def test_the_slope_limit_is_named_only_where_peer_review_lifts_it(rule_set, sdc, lifts):
    site = projects.site(rule_set=rule_set, sdc=sdc)
    data = projects.project(site=site, options={"peer_reviewed": True})
    said = next(each for each in confirmations.of_confirmations(data) if each.id == "peer_review")
    assert ("slope limit" in said.remedy) is lifts
    assert "floor" in said.remedy


CODE = {"building_code": "CBC", "building_code_year": 2022, "jurisdiction": "City of Alameda"}


@pytest.mark.parametrize(
    ("given", "found"),
    [(CODE, "2022 CBC; City of Alameda"), ({}, "not entered"),
     (without(CODE, "jurisdiction"), "2022 CBC; jurisdiction missing")],
)  # fmt: skip
def test_without_building_code_and_jurisdiction_there_is_a_condition(given, found):
    data = projects.project(site=projects.site(**given))
    said = confirmations.of_building_code(data)
    assert said.found == found
    assert said.verdict is (Verdict.OK if given == CODE else Verdict.CONDITION)


def before_runs(key, *, units="US", **given):
    """The row on an array of 42,000 lb on 80 ft x 60 ft, 8.75 psf."""
    head = project_parts.HEAD | {"units_first": units}
    data = projects.project(arrays=[projects.array("A1", 0.5, **given)], project=head)
    rows = capacities.before_runs(data, data.arrays[0], 0.0)
    return next((item for item in rows if item.id == key), None)


PSF = PRESSURES["psf"]


@pytest.mark.parametrize(
    ("weight_psf", "capacity_psf", "found", "limit", "verdict"),
    [
        (8.6, 8.6, "8.6 psf (0.41 kPa)", "≤ 8.6 psf (0.41 kPa)", Verdict.OK),
        (8.64, 8.0, "8.6 psf (0.41 kPa)", "≤ 8.0 psf (0.38 kPa)", Verdict.NG),
        (8.75, 8.7499, "8.8 psf (0.42 kPa)", "≤ 8.7 psf (0.41 kPa)", Verdict.NG),
    ],
)
def test_a_weight_over_the_roof_capacity_is_ng_and_prints_the_same_beside_the_wind_design(
    weight_psf, capacity_psf, found, limit, verdict
):
    given = {"weight_n": weight_psf * 80 * 60 * WEIGHTS["lb"], "wind_weight_pa": 8.0 * PSF}
    row = before_runs("roof_capacity", roof_capacity_pa=capacity_psf * PSF, **given)
    assert spaced((*texts(row), row.verdict)) == (found, limit, verdict)
    assert spaced(texts(before_runs("wind_weight", **given))[1]) == f"= {found}"
    row = before_runs("roof_capacity", **given)
    assert (row.found, row.verdict) == ("allowable load not entered", Verdict.CONDITION)


@pytest.mark.parametrize(
    ("wind_psf", "units", "found", "verdict"),
    [
        (8.8, "US", "8.8 psf (0.42 kPa)", Verdict.OK),
        (8.6, "US", "8.6 psf (0.41 kPa)", Verdict.CONDITION),
        (9.5, "SI", "0.45 kPa (9.5 psf)", Verdict.CONDITION),
    ],
)
def test_another_weight_in_the_wind_design_is_a_condition(wind_psf, units, found, verdict):
    said = before_runs("wind_weight", units=units, wind_weight_pa=wind_psf * PSF)
    assert spaced(texts(said, us_first=units == "US")[0]) == found
    assert said.verdict is verdict
    said = before_runs("wind_weight")
    assert (said.found, said.verdict) == ("not entered", Verdict.CONDITION)


def pathway(other, more_m, **second):
    """The row on a fire pathway where so much more is left than the 36 in required."""
    arrays = [projects.array("A1", 0.5), projects.array("A2", 0.5, x=140, **second)]
    gap = projects.clearance("A1", other, 4.0) | {"pathway_m": 36 * INCH}
    slides = [item.design_m for item in assessed(arrays=arrays, clearances=[gap]).arrays]
    gap["provided_m"] = 36 * INCH + sum(slides[: 2 if second else 1]) + more_m
    done = assessed(arrays=arrays, clearances=[gap])
    return row(done, "fire_pathway"), done.array_verdict(done.arrays[0])


def test_whether_there_is_a_fire_pathway_is_asked_of_each_clearance():
    """Also where the plan calls for one: a row that is deleted answers nothing."""
    units = [
        projects.roof_object(name, "fixed object", x_ft, x_ft + 6, 35, 42)
        for name, x_ft in (("RTU-1", 106), ("RTU-2", 180))
    ]
    gaps = [projects.clearance("A1", "RTU-2", 20.0) | {"pathway_m": m} for m in (0.0, 0.5, None)]
    near = projects.clearance("A1", "RTU-1", 6 * FOOT)

    def found(*rows):
        done = assessed(arrays=[projects.array("A1", 0.5)], objects=units, clearances=rows)
        (asked,) = (row for row in done.checks if row.title == "Fire pathways along the clearances")
        return asked.verdict, asked.found

    for answered in gaps[:2]:
        assert found(answered, near) == (Verdict.OK, "entered")
    without = Verdict.CONDITION, "1 clearance without an entry"
    assert found(gaps[2], near) == without
    assert found(gaps[0]) == without  # to RTU-1


@pytest.mark.parametrize(
    ("other", "second", "n_slides"),
    [("RTU-1", {}, 1), ("A2", {}, 1), ("A2", {"construction": "Unlike"}, 2)],
)
def test_a_fire_pathway_keeps_its_width_after_the_displacement(other, second, n_slides):
    found, _ = pathway(other, 0.001, **second)
    width, limit = texts(found)
    assert spaced((found.verdict, limit)) == (Verdict.OK, "≥ 36.0 in (915 mm)")
    assert width.count("−") == n_slides
    assert spaced(width).startswith("36.0 in (915 mm) (")
    found, of_array = pathway(other, -0.001, **second)
    assert found.verdict is Verdict.NG
    assert of_array is Verdict.NG


@pytest.mark.parametrize("left_m", [0.0, -0.06])
def test_a_fire_pathway_that_arrays_take_whole_has_the_largest_ratio_of_all(left_m):
    found, _ = pathway("RTU-1", left_m - 36 * INCH)
    assert (found.verdict, found.ratio) == (Verdict.NG, math.inf)
    assert words(found) == "fire pathway after displacement A1 to RTU-1 (D/C ∞)"


SOURCED = {
    "hazard_source": "ASCE 7 Hazard Tool",
    "hazard_date": dt.date(2026, 2, 20),
    "hazard_printout": "hazard.pdf",
}
STUDIED = SOURCED | {"hazard": "site-specific analysis", "hazard_report": "GE-12"}
BLANK = dict.fromkeys(("s_s_g", "s_1_g", "f_a", "f_v", "s_ms_g", "s_m1_g", "s_d1_g", "site_class"))
S_DS_ALONE = BLANK | {"s_ds_g": 1.0}
ASCE_7_22 = BLANK | {"s_ds_g": None, "s_ms_g": 1.5, "s_1_g": 0.5, "s_m1_g": 0.6}
ASCE_7_22 |= {"edition_name": "ASCE 7-22"}


def hazard_of(**changes):
    """The requirements on the hazard by id."""
    found = list(seismic_parameters.of_site(projects.project(site=projects.site(**changes))))
    assert {item.consequence for item in found} == {Consequence.CONDITION}
    return {item.id: item for item in found}


@pytest.mark.parametrize(
    ("given", "conditions"),
    [
        (SOURCED | {"hazard": "mapped values"}, ["site_specific_hazard"]),
        (SOURCED | {"hazard": "exception of 11.4.8"}, []),
        (SOURCED | {"site_class": "C"}, []),
        (without(SOURCED, "hazard_printout") | {"site_class": "C"}, ["hazard_source"]),
        *((without(STUDIED, name), ["hazard_source"]) for name in (*SOURCED, "hazard_report")),
        (S_DS_ALONE, ["hazard_source", "sdc", "site_class", "site_specific_hazard"]),
        (S_DS_ALONE | SOURCED | {"site_class": "C"}, ["sdc"]),
        (SOURCED | ASCE_7_22, ["site_class"]),
        (SOURCED | {"site_class": "D (default)", "s_1_g": 0.1}, ["site_class"]),
        (STUDIED | {"site_class": None}, []),
    ],
)  # fmt: skip
def test_what_is_open_on_the_hazard_is_a_condition(given, conditions):
    found = hazard_of(**given)
    assert sorted(id for id, item in found.items() if not item.is_satisfied) == conditions
    verdicts = {True: Verdict.OK, False: Verdict.CONDITION}
    assert all(item.verdict is verdicts[item.is_satisfied] for item in found.values())


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({}, "S_1 not entered: SDC D is not confirmed"),
        ({"s_ds_g": 0.4}, "S_1 and S_D1 not entered: SDC D is not confirmed"),
        ({"s_ds_g": 0.4, "s_1_g": 0.5}, "S_D1 not entered: SDC D is not confirmed"),
        ({"s_1_g": 0.5}, "S_1 = 0.500 g"),
        ({"s_d1_g": 0.5}, "S_1 not entered: SDC D is not confirmed"),
        ({"s_1_g": 0.5, "f_v": 1.8}, "S_1 = 0.500 g, S_D1 = 0.600 g"),
    ],
)
def test_the_sdc_is_confirmed_by_s_1_and_by_s_d1_where_it_matters(given, words):
    site = S_DS_ALONE | given
    found = hazard_of(**site)["sdc"]
    assert spaced(found.found) == words
    assert found.is_satisfied is ("not" not in words)
    data = projects.project(site=projects.site(**site))
    assert data.site.sdc_text == ("D" if found.is_satisfied else "D (not confirmed)")


@pytest.mark.parametrize("site_class", [None, "D (default)"])
def test_site_class_d_by_default_says_11_4_8_of_its_edition_alone(site_class):
    found = hazard_of(site_class=site_class)
    assert not found["site_class"].is_satisfied
    assert "F_a is at least 1.2" in found["site_class"].remedy
    assert "ASCE 7-16 11.4.8" in found["site_class"].remedy
    title = "Hazard analysis for site class D by default with S_1 = 0.7 g"
    assert spaced(found["site_specific_hazard"].title) == title
    assert "11.4.8" not in hazard_of(**SOURCED | ASCE_7_22)["site_class"].remedy


@pytest.mark.parametrize(
    ("given", "asked"),
    [
        ({"site_class": "D", "s_1_g": None}, "site class D, S_1 not entered"),
        ({"site_class": "E", "s_s_g": 0.9, "s_1_g": 0.05}, "site class E with S_S = 0.9 g"),
        ({"site_class": "E", "s_s_g": None, "s_1_g": 0.05}, "site class E, S_S not entered"),
        ({"site_class": "E", "s_s_g": 0.5, "s_1_g": 0.05}, ""),
        ({"site_class": "D", "s_1_g": 0.1}, ""),
    ],
)
def test_what_11_4_8_asks_for_is_said_also_where_it_cannot_be_told(given, asked):
    found = hazard_of(**given)["site_specific_hazard"]
    assert spaced(found.title) == (f"Hazard analysis for {asked}" if asked else "Hazard analysis")


@pytest.mark.parametrize(
    ("key", "field", "needed"),
    [("interconnection", "interconnection_n", "interconnection_n"),
     ("electrical_slack", "slack_m", "design_m")],
)  # fmt: skip
def test_too_little_is_ng_and_no_value_is_a_condition(key, field, needed):
    def verdicts(**given):
        done = assessed(arrays=[projects.array("A1", 0.5, **given)], clearances=[])
        return done.arrays[0], row(done, key).verdict, done.array_verdict(done.arrays[0])

    item, plain, _ = verdicts()
    assert plain is Verdict.CONDITION
    for factor, verdict in ((1.001, Verdict.OK), (0.999, Verdict.NG)):
        _, found, of_array = verdicts(**{field: getattr(item, needed) * factor})
        assert found is verdict
        assert (of_array is Verdict.NG) is (verdict is Verdict.NG)


def test_a_clearance_that_five_percent_less_friction_breaks_is_a_condition():
    def apart(provided_m):
        gap = projects.clearance("A1", "RTU-1", provided_m)
        return assessed(options=assessments.REVIEW, clearances=[gap])

    given = apart(30.0)
    assert row(given, "less_friction").is_satisfied
    done = apart(
        (given.clearances[0].required_m + given.at_reduced_friction.clearances[0].required_m) / 2.0
    )
    assert done.clearances[0].ok
    assert not done.at_reduced_friction.clearances[0].ok
    assert row(done, "clearance_less_friction").verdict is Verdict.CONDITION
    assert "5% less friction" in spaced(row(done, "clearance_less_friction").title)


@pytest.mark.parametrize("provided", [None, 6.0])
@pytest.mark.parametrize(("apart_ft", "verdict"), [(2.0, Verdict.NG), (6.0, Verdict.CONDITION)])
def test_a_gap_of_the_plan_without_a_clearance_is_ng_where_it_is_too_small(
    provided, apart_ft, verdict
):
    """A row that is deleted turns no NG into a condition."""
    unit = projects.roof_object("RTU-1", "fixed object", 100 + apart_ft, 112, 35, 42)
    rows = [projects.clearance("A1", "RTU-1", provided * FOOT)] if provided else []
    done = assessed(arrays=[projects.array("A1", 0.5)], objects=[unit], clearances=rows)
    (near,) = done.neighbors
    assert near.required_m == done.arrays[0].design_m  # factor 1.0, I_p 1.0
    assert 2.0 * FOOT < near.required_m < 6.0 * FOOT < near.reach_m
    found = row(done, "neighbors")
    if provided == apart_ft:
        assert found.is_satisfied
        return
    expected = Verdict.CONDITION if provided else verdict
    assert found.verdict is expected
    assert (done.array_verdict(done.arrays[0]) is Verdict.NG) is (expected is Verdict.NG)
    if expected is Verdict.NG:
        assert spaced(texts(found)[0]) == "24.0 in (609 mm) (not entered)"
        assert texts(found)[1].startswith("≥ ")
    if provided:
        assert "24.0 in (609 mm) on the plan" in spaced(found.found)
        assert "with the distance on the plan, it would be NG" in found.remedy


def test_an_edge_beyond_twice_the_displacement_that_is_nearer_than_required_is_ng():
    """ASCE asks for 4 ft to an edge, however little an array moves."""
    outline = project_parts.sides(0, 164, 15, 164) | {"y_from_m": 15 * FOOT - 1.0}
    alone = {"arrays": [projects.array("A1", 0.5, mu=1.4)], "objects": [], "clearances": []}
    site = projects.site(rule_set="ASCE 7-16")
    done = assessed(**alone, roof=outline, options=assessments.REVIEW, site=site)
    (near,) = done.neighbors
    assert near.gap_m == pytest.approx(1.0)
    assert near.reach_m < near.gap_m < near.required_m == pytest.approx(4 * FOOT)
    found = row(done, "neighbors")
    assert (found.verdict, texts(found)[1][:2]) == (Verdict.NG, "≥ ")


def test_no_slack_gap_or_pathway_is_enough_for_a_displacement_that_is_not_permitted():
    path = projects.clearance("A2", "A1", 20 * FOOT) | {"pathway_m": 0.9}
    done = projects.unpermitted(clearances=[path])
    unknown = "unknown without a permitted design displacement"
    slack, pathway = row(done, "electrical_slack"), row(done, "fire_pathway")
    near = next(
        each for each in done.checks if each.id == "neighbors" and each.subject == "A1 to RTU-1"
    )
    assert slack.subject == "A1"
    assert {item.verdict for item in (slack, pathway, near)} == {Verdict.NG}
    assert (slack.limit, near.limit, pathway.found) == (unknown,) * 3
    wrong = [each.subject for each in done.checks if each.id == "neighbors"]
    assert not any(subject.startswith("A2 to S") for subject in wrong)


@pytest.mark.parametrize(("mu", "is_closed"), [(0.41, True), (0.43, False)])  # the limit is 0.40
def test_a_route_that_five_percent_less_friction_closes_is_a_note(mu, is_closed):
    arrays = [projects.array("A1", 0.5, mu=mu)]
    found = row(assessed(assessments.level(), arrays=arrays, clearances=[]), "less_friction")
    assert found.is_satisfied is not is_closed
    if is_closed:
        assert spaced(found.title) == "The prescriptive procedure with 5% less friction"
        assert found.verdict is Verdict.NOTE
        assert found.found == "not permitted with μ = 0.389"
        assert (
            spaced(found.remedy)
            == "The procedure is permitted as entered but not with 5% less friction."
        )


BUILDING = {"building": {"period_s": 0.5}, "spectrum": [], "target": {"t_l_s": 8.0}}


def grounded(scale=1.0, place="ground", **changes):
    """The requirement on ground motions scaled by a factor."""
    rows = [
        {"id": f"M{k}", "record": "x", "transverse": "y", "recorded_at": place}
        | {"scaling": "factor", "scale_value": scale}
        for k in (1, 2, 3)
    ]
    data = projects.project(motions=rows, **BUILDING | changes)
    book = assessments.grounded(data, assessments.level(), transverse=True, vertical=False)
    # As it is by analysis: where no array takes that value, a package has it as a note.
    found = motion_checks.of_records(data, book.shaking.prepared)
    return next((each for each in found if each.id == "ground_motions"), None)


def largest_ratio():
    """The mean of the ground spectra / the design spectrum, the largest from 1 s to 10 s."""
    site = projects.project().site
    target = design_spectrum(s_ds_g=site.s_ds, s_d1_g=site.s_d1, t_l_s=8.0)
    periods_s = np.geomspace(1.0, 10.0, 400)
    each = [spectrum(motion, periods_s) for motion in assessments.level()]
    means = [np.mean([one.sa_mps2[axis] for one in each], axis=0) for axis in ("x", "y")]
    return max((mean / 9.80665 / target(1 / periods_s)).max() for mean in means)


def test_ground_motions_are_compared_with_the_design_spectrum_where_there_is_one():
    found = grounded().found.value
    assert found == pytest.approx(largest_ratio(), rel=0.02)  # periods up to 1/24 octave apart
    assert grounded(place="roof") is None
    for given, said in (
        ({"target": {}}, "T_L not entered: no target"),
        ({"target": {}, "site": project_parts.SITE}, "S_D1 and T_L not entered: no target"),
        ({"spectrum": projects.SHORT_SPECTRUM}, "no target from 1 s on"),
    ):
        found = grounded(**given)
        assert spaced((found.found, found.verdict)) == (said, Verdict.CONDITION)


@pytest.mark.parametrize(("ratio", "is_met"), [(1.95, True), (2.05, False)])
def test_ground_motions_far_above_the_design_spectrum_are_a_condition(ratio, is_met):
    compared = grounded().found.value
    found = grounded(scale=ratio / compared)
    assert found.is_satisfied is is_met
    assert found.consequence is Consequence.CONDITION
    # What is satisfied has no remedy.
    assert ("peer reviewer's acceptance" in found.to_close) is not is_met


def test_without_an_outline_of_the_roof_nothing_says_that_edges_were_looked_for():
    assert row(assessed(), "roof_outline").verdict is Verdict.CONDITION
    assert "are not identified" in row(assessed(), "roof_outline").remedy
    assert row(assessed(roof=project_parts.sides(0, 220, 0, 170)), "roof_outline").is_satisfied
