"""What `check` says without a run is what the report finds with all of them."""

import pytest

import scenes
import stand_in
from report.assessment.arrays import Route
from report.assessment.precheck import limits_before_runs
from report.sheet.schema.fields import Level, Place

pytestmark = pytest.mark.quick

SEVEN = scenes.motions(7)
BARE = stand_in.project(
    arrays=[stand_in.array("A1", 8.0, mu_report="", x_to_m=200 * stand_in.FOOT)], clearances=[]
)
CASES = {
    "the usual project": (stand_in.project(), SEVEN),
    "slope, risk category and stories": (
        stand_in.project(
            arrays=[stand_in.array("A1", 8.0)],
            clearances=[],
            site=stand_in.site(risk_category="IV", i_e=1.5, stories=7),
        ),
        SEVEN,
    ),
    "two motions on a slope that only analysis permits": (stand_in.steep(), SEVEN[:2]),
    "two motions on a slope that the prescriptive route permits": (
        stand_in.project(),
        SEVEN[:2],
    ),
    "no vertical, no test report, no fire lane": (
        BARE,
        tuple(stand_in.motion(m.id, m.ax_mps2, ay=m.ay_mps2, dt_s=m.dt_s) for m in SEVEN[:3]),
    ),
}
NEED_RUNS = {"neighbors", "less_friction", "electrical_slack"}


@pytest.mark.parametrize("case", CASES)
def test_check_and_report_name_the_same_limits_and_requirements(case):
    book = stand_in.book(*CASES[case])
    assessment = stand_in.assessed(book)
    checks = [*assessment.building_checks, *(c for a in assessment.arrays for c in a.limits)]
    limits = [check for check in checks if not check.ok]
    rows = [row for row in assessment.conditions if row.id not in NEED_RUNS]
    slack = [a for a in assessment.arrays if a.array.slack_m is None]
    listed = list(limits_before_runs(book.sheet.project, book.shaking))
    found = [f for f in listed if f.level is Level.WARNING]
    assert len(found) == len(limits) + len(rows) + len(slack)
    words = [finding.text for finding in found]
    for title in (*(c.title for c in limits), *(row.title for row in rows)):
        assert any(title[1:] in text for text in words), title
    prescribed = [a for a in assessment.arrays if a.route is Route.PRESCRIPTIVE]
    assert sum(f.level is Level.NOTE for f in listed) == len(prescribed) + len(assessment.notes)


def findings(*given):
    book = stand_in.book(*given)
    return list(limits_before_runs(book.sheet.project, book.shaking))


def test_a_limit_names_its_cell_its_value_and_the_limit_and_cannot_be_acknowledged():
    listed = findings(*CASES["slope, risk category and stories"])
    assert {finding.id for finding in listed} == {""}
    found = {finding.place: finding.text for finding in listed}
    assert found[Place("site", 0, "risk_category")] == (
        "risk category (I = 1 to IV = 4): 4; at most 3 is permitted (PV1-2012): NG"
    )
    assert found[Place("site", 0, "stories")] == (
        "number of stories: 7; at most 6 is permitted (PV1-2012): NG"
    )
    slope = Place("arrays", 0, "slope_value")
    assert [finding.text for finding in listed if finding.place == slope] == [
        "roof slope, any ballasted system: 8.00° (14.1 %); at most 4.76° (8.3 %) is permitted"
        " (IBC 1613.3): NG",
        "roof slope, analysis route: 8.00° (14.1 %); at most 7.00° (12.2 %) is permitted"
        " (PV1-2012): NG",
    ]


@pytest.mark.parametrize(
    ("case", "text"),
    [
        ("two motions on a slope that only analysis permits", "number of motions: 2; ≥ 3 required"),
        ("no vertical, no test report, no fire lane", "two horizontal and the vertical together"),
    ],
)
def test_too_few_motions_and_no_vertical_are_said_at_the_motions(case, text):
    found = [f.text for f in findings(*CASES[case]) if f.place == Place("motions")]
    assert any(text in words for words in found)


def test_a_statistic_that_needs_more_motions_is_the_reason_or_ng_at_its_cell():
    data = stand_in.project(options={"statistic": "mean"})
    notes = [f.text for f in findings(data, SEVEN) if f.level is Level.NOTE]
    found = [text for text in notes if "takes the prescriptive displacement" in text]
    reason = "7 motions are given, and the statistic 'mean' needs 11 or more"
    assert found
    assert all(reason in text for text in found)
    found = findings(stand_in.steep(options={"statistic": "mean"}), SEVEN)
    texts = [f.text for f in found if f.place == Place("options", 0, "statistic")]
    assert "7 motions are given, and the statistic 'mean' needs 11 or more: NG" in texts
    prescribed = findings(stand_in.project(options={"statistic": "mean"}), SEVEN)
    assert not any(f.text.endswith(": NG") for f in prescribed if f.place.section == "options")
