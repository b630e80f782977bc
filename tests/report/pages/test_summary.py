"""Summary and letter: what they count, what a verdict is due to, and nothing a table denies."""

import math
import re
from dataclasses import replace

import pytest

from fixtures import altered_projects, assessments, packages, projects
from fixtures.assessments import FOOT, REVIEW
from fixtures.pages import page_of
from fixtures.paths import ROOT
from fixtures.projects import INCH
from fixtures.spaces import spaced
from report.assessment.assess import assess
from report.assessment.checks.check import OVERRIDE_ID
from report.assessment.checks.motion_checks import of_records
from report.assessment.checks.sentence import texts, words
from report.assessment.design.routes import Route
from report.assessment.support.evidence import support
from report.package.html import pages
from report.pages.checks import first_sheet
from report.pages.terminal import document, summary
from report.web.open_project import open_project


@pytest.mark.quick
def test_prescriptive_designs_have_no_floor_and_clearances_without_verdict_are_counted():
    arrays = [projects.array("A2", 0.5, x=120)]
    done = projects.unpermitted(arrays=arrays, clearances=[])
    assert {array.route for array in done.arrays} == {Route.PRESCRIPTIVE}
    shown = page_of(done, "summary")
    assert "Floor" not in shown
    review = "Peer review by Reviewer of record, CA S0000, 2026-03-01; no array uses the analysis"
    assert review in shown
    assert "floor" not in page_of(done, "letter")
    gaps = [projects.clearance("A1", "RTU-1", 7 * projects.FOOT)]
    page = page_of(projects.unpermitted(clearances=gaps), "summary")
    assert "cannot be made without a permitted design displacement" in page


@pytest.mark.nightly
def test_the_terminal_marks_what_is_not_permitted_and_calls_nothing_beside_it_ok():
    weak = open_project(ROOT / "projects/school").at({"intensity": 0.32, "together": "no"})
    done = assess(weak.sheet, weak.shaking)
    lines = [spaced(line) for line in summary(done)]
    for item, line in zip(document(done)["arrays"], lines[1:], strict=False):
        assert line.startswith(item["id"])
        assert "488 mm (19.2 in), not permitted" in line  # at another S_DS it is not reviewed
        assert "none  NG: roof slope, analysis procedure" in line
        assert any(cause.startswith("clearance A") for cause in item["causes"])
    assert not any("OK" in line or line.startswith("NG: Clearance A1 to A2: ") for line in lines)
    assert lines[-1] == "verdict: NG"


@pytest.mark.quick
def test_what_is_alike_of_several_arrays_or_clearances_is_said_once():
    arrays = [projects.array(f"A{k}", 0.5, x=120 * k) for k in (1, 2, 3)]
    done = projects.assess_input(projects.project(arrays=arrays), projects.motions(1, seconds=4.0))
    (one,) = [check for check in done.open if check.id == "interconnection"]
    assert one.arrays == ("A1", "A2", "A3")
    row = page_of(done, "limits").table("All checks").row("Interconnection strength")
    assert row["Item"] == "A1 to A3"
    assert "not entered" in row["Found"]
    arrays = [projects.array(f"A{k}", 0.5, x=120 * k, y=20) for k in (1, 2, 3)]
    rows = [projects.clearance("A1", "A2", 2.0), projects.clearance("A2", "A3", 2.0)]
    data = projects.project(arrays=arrays, clearances=rows, objects=[])
    done = projects.assess_input(data, projects.motions(1, seconds=4.0))
    differing = [row for row in done.checks if row.id == "neighbors"]
    (one,) = [check for check in done.open if check.id == "neighbors"]
    assert (len(differing), one.subject) == (2, "A1 to A2 and 1 more")
    assert one.remedy.startswith("Correct the clearance")
    rows = page_of(done, "limits").table("All checks").rows
    found = [row["Found"] for row in rows if row["Required"] == "as on the plan"]
    assert found
    assert all(" on the plan" in text for text in found)


@pytest.mark.quick
def test_a_requirement_that_is_found_differently_is_one_row_with_each_array_before_its_own():
    given = {"A1": 10.0, "A2": 20.0, "A3": 20.0}
    arrays = [
        projects.array(id, 0.5, x=120 * k, interconnection_n=strength_n)
        for k, (id, strength_n) in enumerate(given.items())
    ]
    done = projects.assess_input(projects.project(arrays=arrays), projects.motions(1, seconds=4.0))
    row = page_of(done, "limits").table("All checks").row("Interconnection strength")
    # 1 lb = 4.448 N; provided is rounded down
    assert (row["Item"], row["Found"]) == ("A1 to A3", "2 lb (0.01 kN)")  # the worst
    assert row["Required"] == "≥ 4374 lb (19.46 kN) (A1)"


NEAR = projects.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


@pytest.mark.quick
def test_an_array_that_is_ng_by_a_missing_clearance_says_so_in_its_row():
    """The clearance that is listed is OK, and its D/C alone stands beside the NG."""
    made = assessments.package(
        arrays=[projects.array("A1", 0.5), projects.array("A2", 0.5, x=220)],
        objects=[NEAR],
        clearances=[projects.clearance("A2", "A1", 40.0)],
    )
    verdicts = page_of(made, "letter").table("Results").column("Verdict")
    assert verdicts == ["NG clearance as on the plan A1 to RTU-9 (D/C 3.40)", "Condition"]
    assert page_of(made, "summary").table("Arrays").column("Verdict") == ["NG", "Condition"]
    assert any(
        "NG: clearance as on the plan A1 to RTU-9 (D/C 3.40)" in line
        for line in summary(made.assessment)
    )


@pytest.fixture(scope="module")
def barely():
    """A clearance, a slack and a strength a hair below what is required."""
    array = projects.array("A1", 0.5)
    objects = [projects.roof_object("RTU-1", "fixed object", 140, 145, 35, 42, height=1.0)]
    gap = projects.clearance("A1", "RTU-1", 9.0)
    given = assessments.package(arrays=[array], objects=objects, clearances=[gap]).assessment
    (item,), (gap,) = given.arrays, given.clearances
    less_m, less_n = ((1.0 - 1e-5) * v for v in (gap.required_m, item.interconnection_n))
    array |= {"slack_m": less_m, "interconnection_n": less_n}
    listed = [projects.clearance("A1", "RTU-1", less_m)]
    return assessments.package(arrays=[array], objects=objects, clearances=listed)


@pytest.mark.quick
def test_what_is_short_by_a_hair_prints_as_less_than_is_required(barely):
    governing = page_of(barely, "summary").table("Governing")
    for check in ("Clearance", "Electrical slack", "Interconnection strength"):
        row = governing.row(check)
        had, least = (re.search(r"[\d.]+", row[name])[0] for name in ("Found", "Required"))
        assert float(had) < float(least)


@pytest.mark.quick
def test_deleting_the_row_of_a_clearance_lowers_nothing():
    """What the plan shows and no row covers counts as the row did: D/C, letter, cover, counts."""
    array, far = projects.array("A1", 0.5), projects.clearance("A1", "RTU-8", 40.0 * projects.FOOT)
    objects = [NEAR, projects.roof_object("RTU-8", "fixed object", 140, 145, 35, 42, height=1.0)]
    near = projects.clearance("A1", "RTU-9", projects.FOOT)  # as in plan
    both = assessments.package(arrays=[array], objects=objects, clearances=[far, near])
    deleted = assessments.package(arrays=[array], objects=objects, clearances=[far])
    ratios, names = [], []
    for made in (both, deleted):
        gap = made.assessment.governing_gap()
        assert gap.demand_capacity == made.assessment.governing_gap("A1").demand_capacity > 1.0
        ratios.append(gap.demand_capacity)
        row = page_of(made, "letter").table("Results").row("A1")
        names.append((row["Governing clearance"], row["D/C"]))
        failed = page_of(made, "summary").table("Governing").rows[0]
        assert failed["Verdict"] == "NG"
        assert "A1 to RTU-9" in failed["Item"] + failed["Check"]
        assert "One of two clearances is satisfied." in page_of(made, "letter")
    assert ratios[0] == pytest.approx(ratios[1])
    assert names == [("RTU-9", names[0][1]), ("RTU-9 (not entered)", names[0][1])]
    assert "The plan shows one of them without a row" in page_of(deleted, "letter")


@pytest.mark.quick
def test_the_letter_and_the_cause_say_what_is_not_given():
    made = assessments.package(arrays=[projects.array("A1", 0.5)], objects=[NEAR], clearances=[])
    said = page_of(made, "letter")
    assert (
        "The clearance is not satisfied. The plan shows it without a row in the workbook." in said
    )
    given = assessments.package(arrays=[projects.array("A1", 0.5)], objects=[], clearances=[])
    rows = {check.id: words(check, "A1") for check in given.assessment.checks}
    assert rows["electrical_slack"] == "electrical slack (not entered)"
    assert rows["interconnection"] == "interconnection strength (not entered)"


@pytest.mark.parametrize(
    ("array", "gap", "cause"),
    [
        ({"slack_m": 0.001}, {}, "electrical slack (D/C > 100)"),
        ({"interconnection_n": 1.0}, {}, "interconnection strength (D/C > 100)"),
        ({"roof_capacity_pa": 1.0}, {}, "weight per plan area (D/C > 100)"),
        ({}, {"pathway_m": 8.9}, "fire pathway after displacement A1 to RTU-1 (D/C 1.12)"),
        ({"slope_value": 6.9}, {}, "roof slope, any ballasted system (D/C 1.45)"),
    ],
)
def test_a_cause_says_what_is_wrong_and_not_what_is_compared(array, gap, cause):
    given = assessments.package(
        arrays=[projects.array("A1", 0.5) | array],
        objects=[projects.roof_object("RTU-1", "fixed object", 140, 145, 35, 42, height=1.0)],
        clearances=[projects.clearance("A1", "RTU-1", 9.0) | gap],
    )
    assert page_of(given, "letter").table("Results").column("Verdict") == [f"NG {cause}"]


@pytest.mark.parametrize(
    ("provided_ft", "text"),
    [
        ((0.1, 0.2), "None of the two clearances is satisfied."),
        ((30.0, 30.0), "Both clearances are satisfied."),
        ((0.1,), "The clearance is not satisfied."),
    ],
)
def test_the_letter_counts_the_clearances(provided_ft, text):
    given = zip(("A1", "A2"), provided_ft, strict=False)
    rows = [projects.clearance(name, "RTU-1", ft * FOOT) for name, ft in given]
    assert page_of(assessments.package(clearances=rows), "letter").line(text)


@pytest.mark.quick
def test_the_smallest_margin_is_of_a_satisfied_clearance_and_a_drift_over_its_limit_larger():
    """A1 alone would satisfy the first one; A3 beside it does not."""
    arrays = [projects.array("A1", 0.5, mu=1.0), projects.array("A3", 4.0, y=90)]

    def made(provided_m):
        gaps = [projects.clearance("A1", "A3", provided_m)]
        return assessments.package(arrays=arrays, options=REVIEW, clearances=gaps)

    low, high = (array.design_m for array in made(9.0).assessment.arrays)
    page = page_of(made((low + high) / 2.0), "accuracy")
    assert "satisfied clearance" not in page
    assert page.line("Clearance 1 is not satisfied;")
    book = projects.book(projects.project(clearances=[]), assessments.motions())
    drifting = replace(
        book.shaking.prepared[0].measures["horizontal"], final_displacement_m=0.010004
    )
    first = replace(book.shaking.prepared[0], measures={"horizontal": drifting})
    (row,) = of_records(book.sheet.project, [first])
    both = texts(row, us_first=True)
    numbers = [float(re.search(r"\(([\d.]+)\smm\)", text)[1]) for text in both]
    assert numbers[0] > numbers[1]


@pytest.mark.quick
def test_a_low_parapet_does_not_qualify_by_the_heights_of_the_package():
    edge = projects.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=20 * INCH)
    package = assessments.package(objects=[edge], clearances=[projects.clearance("A3", "N", 6.0)])
    row = page_of(package, "plan").table("Parapets").row("N")
    assert (row["Arrays"], row["Result"]) == ("A3", "does not qualify")
    assert row["Top above the roof [in]"] == "20.0"
    of_center = float(row["Center of gravity [in]"])
    assert float(row["Top above c.g. [in]"]) == pytest.approx(20.0 - of_center, abs=0.05)


def test_the_plan_says_which_displacement_a_separation_takes():
    words = "factor × (including importance) times Δ; between two"
    assert words in page_of(assessments.package(options=REVIEW), "plan")


@pytest.mark.quick
@pytest.mark.parametrize(
    ("rule_set", "base_m", "words"),
    [
        ("SEAOC PV1-2012", 1.524, "supporting base: A1 60.0 in (1524 mm)."),
        (
            "SEAOC PV1-2012",
            None,
            "A1 40.0 in (1016 mm) (support spacing; no base dimension entered).",
        ),
        ("ASCE 7-16", 1.524, "smallest spacing of the supports: A1 40.0 in (1016 mm)."),
    ],
)
def test_the_length_that_limits_the_center_of_gravity_is_the_one_compared(rule_set, base_m, words):
    site = projects.project().site.model_dump() | {"rule_set": rule_set}
    array = projects.array("A1", 0.5, base_m=base_m)
    package = assessments.package(site=site, arrays=[array], clearances=[])
    text = page_of(package, "inputs").line("Center of gravity at most 36.0 in (914 mm)")
    assert text.endswith(words)
    (check,) = [c for c in package.assessment.arrays[0].limits.checks if "center" in c.title]
    length_m = 1.524 if "60.0" in words else 1.016
    assert check.limit == pytest.approx(min(0.5 * length_m, 0.9144))


@pytest.mark.quick
@pytest.mark.parametrize("clearances", [[], [projects.clearance("A1", "RTU-1", 60 * FOOT)]])
def test_a_limit_that_may_be_exceeded_is_nowhere_said_to_be_satisfied(clearances):
    package = assessments.package(
        assessments.motions(7),
        site=projects.site(rule_set="ASCE 7-16", sdc="C"),
        options=REVIEW,
        arrays=[projects.array("A1", 3.5, mu=0.6)],
        clearances=clearances,
    )
    assert package.assessment.verdict.is_permitted
    assert any(check.is_excepted for check in package.assessment.checks)
    for key in ("letter", "summary"):
        page = page_of(package, key)
        assert "No check is NG" in page or "or exceeded where the rule set permits it" in page
        assert ("No clearance is entered, so none is checked." in page) is not bool(clearances)
    row = page_of(package, "limits").table("All checks").row("Roof slope, analysis procedure")
    assert "permitted" in row["Found"]


@pytest.mark.quick
def test_the_largest_peak_of_a_prescriptive_array_is_printed_with_one_rounding():
    """Rounded up in the design displacement, it is the same number three lines below."""
    gaps = [projects.clearance("A1", "RTU-1", 60 * FOOT)]
    package = assessments.package(
        assessments.motions(1), arrays=[projects.array("A1", 0.5)], clearances=gaps
    )
    (item,) = package.assessment.arrays
    assert item.route.value == "prescriptive"
    inches = item.analysis.largest_m / INCH
    rounded_up = f"{math.ceil(10.0 * inches) / 10.0:.1f}"
    assert f"{inches:.1f}" != rounded_up
    found = re.findall(r"max\([\d.]+ in \(\d+ mm\), ([\d.]+) in", page_of(package, "method"))
    assert found == [rounded_up]


@pytest.mark.quick
def test_a_design_displacement_has_what_governs_that_of_the_array_named_beside_it():
    done = assessments.shipped("example")
    row = page_of(done, "limits").table("All checks").row("Design displacement")
    assert row["Found"] == "47.4 in (1204 mm) (A3) (analysis)"  # of A1 and A2 the floor governs


@pytest.mark.quick
def test_each_number_of_a_sheet_is_of_the_row_or_table_with_the_check():
    done = assessments.shipped("example")
    with packages.undrawn():
        html = pages(done, support(done))
    targets = set(re.findall(r'class="at"[^>]* href="#([^"]+)"', html))
    assert {"limits:roof_capacity", "limits:electrical_slack", "plan:schedule"} <= targets
    places = re.findall(r' id="([^"]+)"', html)
    assert len(places) == len(set(places))
    assert targets <= set(places)


@pytest.mark.quick
def test_conditions_that_change_the_result_come_first_on_the_first_sheet():
    opened = first_sheet(altered_projects.assessed("friction tests deleted")).conditions
    priced = [bool(check.otherwise) for check in opened]
    assert any(priced)
    assert priced == sorted(priced, reverse=True)


@pytest.mark.quick
def test_too_few_motions_are_stated_once_and_are_no_statistic():
    done = altered_projects.assessed("two motions")
    shown = page_of(done, "summary")
    assert "Arrays: analysis displacement (none: too few motions), prescriptive" in shown
    assert shown.line("Not satisfied, without effect").count("number of motions") == 1
    assert page_of(done, "comparison").count("number of motions (2, at least 3†)") == 1


@pytest.mark.quick
def test_checks_without_effect_are_not_among_those_that_are_satisfied():
    done = altered_projects.assessed("low hazard, no motions")
    (note,) = done.notes
    shown = page_of(done, "summary")
    count = len(done.checks)
    others = "the other has no effect on the design displacement"
    assert f"OK {count - 1} of {count} checks are satisfied; {others}." in shown
    assert "the prescriptive procedure with 5% less friction" in shown.line("Not satisfied")
    assert not note.is_satisfied
    done = assessments.shipped("example")
    assert f"OK All {len(done.checks)} checks are satisfied." in page_of(done, "summary")


@pytest.mark.quick
def test_an_override_shows_whether_the_value_that_it_replaces_is_verified():
    done = altered_projects.assessed("overrides")
    pairs = {spaced(check.limit): check.clause for check in done.checks if check.id == OVERRIDE_ID}
    assert pairs == {"≥ 1": "PV1-2012 Sec. 6", "≤ 36 in†": "PV1-2012 Sec. 5†"}


@pytest.mark.quick
def test_arrays_of_the_same_friction_by_velocity_are_stated_together():
    law = {"mu": 0.5, "mu_fast": 0.6, "mu_rate_s_per_m": 20.0}
    arrays = [projects.array(id, 0.5, **law) for id in ("A1", "A2")]
    done = assessments.package(arrays=arrays, clearances=[])
    shown = page_of(done, "model")
    assert "(except A1, A2: 0.50–0.60 (velocity-dependent); see" in spaced(shown)
