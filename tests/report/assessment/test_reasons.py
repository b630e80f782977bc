"""The reason of an NG stands first; what concerns an analysis that none takes is a note."""

import numpy as np
import pytest

import altered
import inputs
import scenes
import stand_in
from nightly import by_day
from printed import printed
from report.assessment.checks.check import sentence
from report.assessment.routes import Route
from report.assessment.verdict import Verdict
from report.pages.summary import summary
from report.text.counts import lowered
from report.web.answers import answer

ARRAY, GAP, FOOT = stand_in.array, stand_in.clearance, stand_in.FOOT
WIDE = {
    "arrays": [ARRAY("A1", 0.5), ARRAY("A2", 0.5, x=220)],
    "objects": [],
    "clearances": [GAP("A1", "A2", 110 * FOOT)],
}
WEAK = tuple(
    stand_in.motion(f"W{k}", 0.05 * m.ax_mps2[:400], dt_s=m.dt_s)
    for k, m in enumerate(scenes.motions())
)
LIFTING = stand_in.motion("UP", np.zeros(300), np.repeat((0.0, -1.4 * stand_in.G, 0.0), 100))
SLIPPERY = {"arrays": [ARRAY("A1", 3.0, mu=0.03), WIDE["arrays"][1]]}
BARE = {"arrays": [ARRAY("A1", 0.5, interconnection_n=1.0), WIDE["arrays"][1]]}
NEAR = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


CASES = {
    "risk category": (None, {"site": stand_in.site(risk_category="IV", i_e=1.5)}, "Risk category"),
    "stories": (None, {"site": stand_in.site(stories=7)}, "Number of stories: 7"),
    "slope": (None, {"arrays": [ARRAY("A1", 8.0), WIDE["arrays"][1]]}, "Roof slope, any ballasted"),
    "friction below the slope": (WEAK, SLIPPERY, "Number of components of each motion"),
    "uplift": ((*scenes.motions(), LIFTING), {}, "Design displacement, A1, A2: none"),
    "clearance": (None, {"clearances": [GAP("A1", "A2", 0.5 * FOOT)]}, "Clearance, A1 to A2: 6.0"),
    "no row": (None, {"objects": [NEAR]}, "Clearance as on the plan, A1 to RTU-9"),
    "strength": (None, BARE, "Interconnection strength, A1"),
    "too few": (None, {"options": {"statistic": "mean"}, "arrays": [ARRAY("A1", 4.0)],
                       "clearances": []}, "Design displacement, A1: none"),
}  # fmt: skip


@pytest.mark.parametrize("name", by_day(CASES, 5))
def test_the_reason_stands_first_wherever_the_verdict_does(name):
    shaking, changes, start = CASES[name]
    made = scenes.package(shaking or scenes.motions(), **WIDE | changes)
    done = made.assessment
    assert done.verdict is Verdict.NG
    first = sentence(done.open[0], us_first=True)
    failed = [check for check in done.checks if check.verdict is Verdict.NG]
    title = lowered(failed[0].title)
    for page in ("letter", "summary"):
        (line,) = (x for x in printed(made, page).splitlines() if " not satisfied: " in x)
        assert line.startswith(f"NG {len(failed)} of {len(done.checks)} checks ")
        assert title in line
    governing = printed(made, "summary").table("Governing").rows
    assert governing[0]["Verdict"] == "NG"
    lines = list(summary(done))
    levels = [line.split(":")[0] for line in lines if line.startswith(("NG: ", "condition: "))]
    assert f"NG: {first}" in lines
    assert levels == sorted(levels)
    shown = answer(done, is_provisional=False)
    assert title in shown["verdict_text"]
    assert start.lower() in first.lower()
    assert shown["reasons"][0] == {"level": "NG", "text": first}
    assert "Limits" not in printed(made, "summary").table("Arrays").rows[0]


@pytest.mark.quick
def test_what_is_not_ng_has_no_reason_and_what_slides_on_no_longer_record():
    done = scenes.package(**WIDE).assessment
    assert done.verdict is Verdict.CONDITIONS
    assert all(check.verdict is Verdict.CONDITION for check in done.open)
    done = scenes.package(WEAK, **WIDE | SLIPPERY).assessment
    (found,) = (check for check in done.open if check.id == "runs")
    assert "the friction coefficient is not above tan θ of the roof slope" in found.remedy
    assert "longer record" not in found.remedy
    cut = tuple(
        stand_in.motion(f"C{k}", np.full(100, 8.0), dt_s=0.01, signs=(1,)) for k in range(3)
    )
    done = scenes.package(cut, **WIDE).assessment
    (other,) = (check for check in done.open if check.id == "runs")
    assert other.remedy.startswith("Enter a longer record")


@pytest.mark.quick
def test_a_prescriptive_value_that_is_not_permitted_says_so_wherever_it_stands():
    arrays = [ARRAY("A1", 4.0), ARRAY("A2", 0.5, x=220)]
    made = scenes.package(**WIDE | {"arrays": arrays})
    for page, table in (("summary", "Arrays"), ("comparison", "Displacement by analysis")):
        one, other = printed(made, page).table(table).column("Prescriptive [in]")
        assert one.endswith("§")
        assert "§" not in other
    terminal = list(summary(made.assessment))
    assert ["mm), not permitted" in line for line in terminal[1:3]] == [True, False]
    rows = answer(made.assessment, is_provisional=False)["arrays"]["rows"]
    assert ["not permitted" in row[3]["text"] for row in rows] == [True, False]


def test_the_prescriptive_value_is_not_offered_where_the_analysis_exceeds_it():
    strong = scenes.motions(3, 30.0, peak_g=6.0, vertical_peak_g=0.1)
    made = scenes.package(strong, **WIDE | {"options": inputs.REVIEW})
    item = made.assessment.arrays[0]
    assert item.analysis.value_m > item.prescriptive.value_m
    words = printed(made, "comparison")
    assert "may be used instead" not in words
    assert "the displacement by analysis exceeds its value" in words


@pytest.mark.parametrize(
    ("changes", "failed"),
    [({}, ""),
     ({"arrays": [ARRAY("A1", 0.5, cg_height_m=40 * stand_in.INCH)]},
      "height of the center of gravity (D/C 2.00)"),
     ({"site": stand_in.site(risk_category="IV", i_e=1.5)},
      "risk category, I = 1 to IV = 4 (4, at most 3†)"),
     ({"site": stand_in.site(stories=20)}, "number of stories (20, at most 6†)"),
     ({"arrays": [ARRAY("A1", 4.0)]}, "roof slope, prescriptive procedure (D/C 1.34)"),
     ({"arrays": [ARRAY("A1", 0.5, mu=0.3)]},
      "friction coefficient, prescriptive procedure (D/C 1.34)")],
)  # fmt: skip
def test_the_prescriptive_value_is_offered_only_where_every_limit_of_its_route_is_met(
    changes, failed
):
    given = {"arrays": [ARRAY("A1", 0.5)], "objects": [], "clearances": []} | changes
    words = printed(scenes.package(scenes.motions(), **given), "comparison")
    assert ("may be used instead" in words) is not failed
    assert (f"he prescriptive procedure is not permitted: {failed}." in words) is bool(failed)


FLAT = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)]
GAPS = [stand_in.clearance("A1", "A2", 110 * stand_in.FOOT)]
ALONE = scenes.along(scenes.motions())  # one component: the analysis route is not permitted


def made(shaking=ALONE, **changes):
    given = {"arrays": FLAT, "objects": [], "clearances": GAPS} | changes
    return scenes.package(shaking, **given)


def test_the_motions_and_the_review_are_notes_and_not_counted():
    package = made(options=inputs.REVIEW | {"peer_license": ""})
    done = package.assessment
    assert {item.route for item in done.arrays} == {Route.PRESCRIPTIVE}
    notes = {row.id for row in done.notes}
    assert {"motions", "peer_review"} <= notes
    assert not notes & {row.id for row in done.open}
    assert all(row.verdict is Verdict.NOTE for row in done.notes)
    first = printed(package, "summary")
    assert f"{len(done.open)} open conditions below must be closed" in first
    noted = first.line("Not satisfied, without effect on the design displacement: ")
    assert all(lowered(row.title) in noted for row in done.notes)
    table = printed(package, "limits").table("All checks")
    verdicts = {row["Check"]: row["Verdict"] for row in table.rows}
    assert verdicts["Peer review of the analysis"] == "note"


@pytest.mark.quick
def test_by_analysis_they_are_what_they_were():
    steep = [row | {"slope_value": 4.0} for row in FLAT]
    done = made(arrays=steep).assessment
    assert not done.notes
    assert any(row.id == "motions" and row.verdict is Verdict.NG for row in done.checks)


@pytest.mark.parametrize("shaking", [
    scenes.motions(2, 30.0, peak_g=6.0, vertical_peak_g=0.1),  # slides farther than is prescribed
    (*scenes.motions(2), stand_in.lifting()),
])  # fmt: skip
def test_a_design_that_follows_from_a_run_keeps_its_conditions(shaking):
    package = made(shaking)
    done = package.assessment
    assert {item.route for item in done.arrays} == {Route.PRESCRIPTIVE}
    assert any(item.is_by_runs for item in done.arrays)
    assert not done.notes
    assert any(row.id == "motions" for row in done.open)
    words = printed(package, "basis")
    assert "design displacements are prescriptive" not in words


def test_what_slides_without_end_is_not_told_to_replace_its_motions():
    done = altered.assessed("slides without end")
    (design,) = (c for c in done.checks if c.id == "design" and not c.is_satisfied)
    assert done.acceptance.qualifies
    assert design.remedy == ""
    (runs,) = (c for c in done.checks if c.id == "runs" and not c.is_satisfied)
    assert runs.remedy.startswith("Provide more friction")
