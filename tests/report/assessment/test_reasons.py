"""The reason of an NG stands first; what concerns an analysis that none takes is a note."""

import numpy as np
import pytest

from fixtures import altered_projects, assessments, project_parts, projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from report.assessment.checks.sentence import sentence
from report.assessment.design.routes import Route
from report.assessment.design.verdict import Verdict
from report.pages.terminal import summary
from report.text.letter_case import lowered
from report.web.answers import answer

ARRAY, GAP, FOOT = projects.array, projects.clearance, projects.FOOT
WIDE = {
    "arrays": [ARRAY("A1", 0.5), ARRAY("A2", 0.5, x=220)],
    "objects": [],
    "clearances": [GAP("A1", "A2", 110 * FOOT)],
}
WEAK = tuple(
    projects.motion(f"W{k}", 0.05 * m.ax_mps2[:400], dt_s=m.dt_s)
    for k, m in enumerate(assessments.motions())
)
LIFTING = projects.motion("UP", np.zeros(300), np.repeat((0.0, -1.4 * projects.G, 0.0), 100))
SLIPPERY = {"arrays": [ARRAY("A1", 3.0, mu=0.03), WIDE["arrays"][1]]}
BARE = {"arrays": [ARRAY("A1", 0.5, interconnection_n=1.0), WIDE["arrays"][1]]}
NEAR = projects.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


CASES = {
    "risk category": (None, {"site": projects.site(risk_category="IV", i_e=1.5)}, "Risk category"),
    "stories": (None, {"site": projects.site(stories=7)}, "Number of stories: 7"),
    "slope": (None, {"arrays": [ARRAY("A1", 8.0), WIDE["arrays"][1]]}, "Roof slope, any ballasted"),
    "friction below the slope": (WEAK, SLIPPERY, "Components per motion"),
    "uplift": ((*assessments.motions(), LIFTING), {}, "Design displacement, A1, A2: none"),
    "clearance": (None, {"clearances": [GAP("A1", "A2", 0.5 * FOOT)]}, "Clearance, A1 to A2: 6.0"),
    "no row": (None, {"objects": [NEAR]}, "Clearance as on the plan, A1 to RTU-9"),
    "strength": (None, BARE, "Interconnection strength, A1"),
    "too few": (None, {"options": {"statistic": "mean"}, "arrays": [ARRAY("A1", 4.0)],
                       "clearances": []}, "Design displacement, A1: none"),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(CASES, 5))
def test_the_reason_stands_first_wherever_the_verdict_does(name):
    shaking, changes, start = CASES[name]
    made = assessments.package(shaking or assessments.motions(), **WIDE | changes)
    done = made.assessment
    assert done.verdict is Verdict.NG
    first = sentence(done.open[0], us_first=True)
    failed = [check for check in done.checks if check.verdict is Verdict.NG]
    title = lowered(failed[0].title)
    for page in ("letter", "summary"):
        (line,) = (x for x in page_of(made, page).splitlines() if " not satisfied: " in x)
        assert line.startswith(f"NG {len(failed)} of {len(done.checks)} checks ")
        assert title in line
    governing = page_of(made, "summary").table("Governing").rows
    assert governing[0]["Verdict"] == "NG"
    lines = list(summary(done))
    levels = [line.split(":")[0] for line in lines if line.startswith(("NG: ", "condition: "))]
    assert f"NG: {first}" in lines
    assert levels == sorted(levels)
    shown = answer(done, is_provisional=False)
    assert title in shown["verdict_text"]
    assert start.lower() in first.lower()
    reason = shown["reasons"][0]
    assert (reason["level"], reason["text"]) == ("NG", first)
    assert "Limits" not in page_of(made, "summary").table("Arrays").rows[0]


@pytest.mark.quick
def test_what_is_not_ng_has_no_reason_and_what_slides_on_no_longer_record():
    done = assessments.package(**WIDE).assessment
    assert done.verdict is Verdict.CONDITIONS
    assert all(check.verdict is Verdict.CONDITION for check in done.open)
    done = assessments.package(WEAK, **WIDE | SLIPPERY).assessment
    (found,) = (check for check in done.open if check.id == "runs")
    assert "the friction coefficient is not above tan θ of the roof slope" in found.remedy
    assert "longer record" not in found.remedy
    cut = tuple(
        projects.motion(f"C{k}", np.full(100, 8.0), dt_s=0.01, signs=(1,)) for k in range(3)
    )
    done = assessments.package(cut, **WIDE).assessment
    (other,) = (check for check in done.open if check.id == "runs")
    assert other.remedy.startswith("Enter a longer record")


@pytest.mark.quick
def test_a_prescriptive_value_that_is_not_permitted_says_so_wherever_it_stands():
    arrays = [ARRAY("A1", 4.0), ARRAY("A2", 0.5, x=220)]
    made = assessments.package(**WIDE | {"arrays": arrays})
    for page, table in (("summary", "Arrays"), ("comparison", "Analysis displacement")):
        one, other = page_of(made, page).table(table).column("Prescriptive [in]")
        assert one.endswith("§")
        assert "§" not in other
    terminal = list(summary(made.assessment))
    assert ["mm), not permitted" in line for line in terminal[1:3]] == [True, False]
    rows = answer(made.assessment, is_provisional=False)["arrays"]["rows"]
    assert ["not permitted" in row[3]["text"] for row in rows] == [True, False]


def test_the_prescriptive_value_is_not_offered_where_the_analysis_exceeds_it():
    strong = assessments.motions(3, 30.0, peak_g=6.0, vertical_peak_g=0.1)
    made = assessments.package(strong, **WIDE | {"options": project_parts.REVIEW})
    item = made.assessment.arrays[0]
    assert item.analysis.value_m > item.prescriptive.value_m
    words = page_of(made, "comparison")
    assert "may be used instead" not in words
    assert "analysis displacement exceeds the prescriptive displacement" in words


@pytest.mark.parametrize(
    ("changes", "failed"),
    [({}, ""),
     ({"arrays": [ARRAY("A1", 0.5, cg_height_m=40 * projects.INCH)]},
      "height of the center of gravity (D/C 2.00)"),
     ({"site": projects.site(risk_category="IV", i_e=1.5)},
      "Risk Category (I = 1 to IV = 4) (4, at most 3†)"),
     ({"site": projects.site(stories=20)}, "number of stories (20, at most 6†)"),
     ({"arrays": [ARRAY("A1", 4.0)]}, "roof slope, prescriptive procedure (D/C 1.34)"),
     ({"arrays": [ARRAY("A1", 0.5, mu=0.3)]},
      "friction coefficient, prescriptive procedure (D/C 1.34)")],
)  # fmt: skip
def test_the_prescriptive_value_is_offered_only_where_every_limit_of_its_route_is_met(
    changes, failed
):
    given = {"arrays": [ARRAY("A1", 0.5)], "objects": [], "clearances": []} | changes
    words = page_of(assessments.package(assessments.motions(), **given), "comparison")
    assert ("may be used instead" in words) is not failed
    assert (f"he prescriptive procedure is not permitted: {failed}." in words) is bool(failed)


FLAT = [projects.array("A1", 0.5), projects.array("A2", 0.5, x=220)]
GAPS = [projects.clearance("A1", "A2", 110 * projects.FOOT)]
ALONE = assessments.along(
    assessments.motions()
)  # one component: the analysis route is not permitted


def made(shaking=ALONE, **changes):
    given = {"arrays": FLAT, "objects": [], "clearances": GAPS} | changes
    return assessments.package(shaking, **given)


def test_the_motions_and_the_review_are_notes_and_not_counted():
    package = made(options=project_parts.REVIEW | {"peer_license": ""})
    done = package.assessment
    assert {item.route for item in done.arrays} == {Route.PRESCRIPTIVE}
    notes = {row.id for row in done.notes}
    assert {"motions", "peer_review"} <= notes
    assert not notes & {row.id for row in done.open}
    assert all(row.verdict is Verdict.NOTE for row in done.notes)
    first = page_of(package, "summary")
    assert f"{len(done.open)} open conditions below must be closed" in first
    noted = first.line("Not satisfied, without effect on the design displacement: ")
    assert all(lowered(row.title) in noted for row in done.notes)
    table = page_of(package, "limits").table("All checks")
    verdicts = {row["Check"]: row["Verdict"] for row in table.rows}
    assert verdicts["Peer review of the analysis"] == "note"


@pytest.mark.quick
def test_by_analysis_they_are_what_they_were():
    steep = [row | {"slope_value": 4.0} for row in FLAT]
    done = made(arrays=steep).assessment
    assert not done.notes
    assert any(row.id == "motions" and row.verdict is Verdict.NG for row in done.checks)


@pytest.mark.parametrize("shaking", [
    # Slides farther than is prescribed.
    assessments.motions(2, 30.0, peak_g=6.0, vertical_peak_g=0.1),
    (*assessments.motions(2), projects.lifting()),
])  # fmt: skip
def test_a_design_that_follows_from_a_run_keeps_its_conditions(shaking):
    package = made(shaking)
    done = package.assessment
    assert {item.route for item in done.arrays} == {Route.PRESCRIPTIVE}
    assert any(item.is_by_runs for item in done.arrays)
    assert not done.notes
    assert any(row.id == "motions" for row in done.open)
    words = page_of(package, "basis")
    assert "design displacements are prescriptive" not in words


def test_what_slides_without_end_is_not_told_to_replace_its_motions():
    done = altered_projects.assessed("slides without end")
    (design,) = (c for c in done.checks if c.id == "design" and not c.is_satisfied)
    assert done.acceptance.qualifies
    assert design.remedy == ""
    (runs,) = (c for c in done.checks if c.id == "runs" and not c.is_satisfied)
    assert runs.remedy.startswith("Provide more friction")
