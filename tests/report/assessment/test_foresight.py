"""What `check` says without a run is what the report finds with all of them."""

from functools import partial

import pytest

import scenes
import stand_in
from report.assessment.arrays import Route
from report.assessment.foresight import foreseen
from report.sheet.fields import Place
from report.sheet.findings import Level
from sheets import Book

motions = partial(scenes.motions, seconds=12.0)  # half a second less for a run of seven
SITE = stand_in.site()
BARE = stand_in.project(
    arrays=[stand_in.array("A1", 8.0, mu_report="", x_to_m=200 * 0.3048)], clearances=[]
)
CASES = {
    "the usual project": (stand_in.project(), motions(7)),
    "slope, risk category and stories": (
        stand_in.project(
            arrays=[stand_in.array("A1", 8.0)],
            clearances=[],
            site=SITE | {"risk_category": "IV", "i_e": 1.5, "stories": 7},
        ),
        motions(7),
    ),
    "two motions on a slope that only analysis permits": (stand_in.steep(), motions(2)),
    "two motions on a slope that the prescriptive route permits": (
        stand_in.project(),
        motions(2),
    ),
    "no vertical, no test report, no fire lane": (
        BARE,
        tuple(stand_in.motion(m.id, m.ax_mps2, ay=m.ay_mps2, dt_s=m.dt_s) for m in motions(3)),
    ),
}
NEED_RUNS = {"neighbors", "less_friction", "electrical_slack"}


@pytest.mark.parametrize("case", CASES)
def test_check_and_report_name_the_same_limits_and_requirements(case):
    book = stand_in.book(*CASES[case])
    assessment = stand_in.assessed(book)
    limits = [
        check
        for checks in (assessment.building_checks, *(a.limits for a in assessment.arrays))
        for check in checks
        if not check.ok
    ]
    rows = [row for row in assessment.conditions if row.id not in NEED_RUNS]
    slack = [a for a in assessment.arrays if a.array.slack_m is None]
    found = [f for f in foreseen(book.sheet, book.shaking) if f.level is Level.WARNING]
    assert len(found) == len(limits) + len(rows) + len(slack)
    words = [finding.text for finding in found]
    for title in (*(c.title for c in limits), *(row.title for row in rows)):
        assert any(title[1:] in text for text in words), title
    prescribed = [a for a in assessment.arrays if a.route is Route.PRESCRIPTIVE]
    notes = [f for f in foreseen(book.sheet, book.shaking) if f.level is Level.NOTE]
    assert len(notes) == len(prescribed)


def test_a_limit_names_its_cell_its_value_and_the_limit():
    book = stand_in.book(*CASES["slope, risk category and stories"])
    found = {finding.place: finding.text for finding in foreseen(book.sheet, book.shaking)}
    assert found[Place("site", 0, "risk_category")] == (
        "risk category (I = 1 to IV = 4): 4; at most 3 is permitted (PV1-2012): NG"
    )
    assert found[Place("site", 0, "stories")] == (
        "number of stories: 7; at most 6 is permitted (PV1-2012): NG"
    )
    slopes = [
        f.text
        for f in foreseen(book.sheet, book.shaking)
        if f.place == Place("arrays", 0, "slope_value")
    ]
    assert slopes == [
        "roof slope, any ballasted system: 8.00° (14.1 %); at most 4.76° (8.3 %) is permitted"
        " (IBC 1613.3): NG",
        "roof slope, analysis route: 8.00° (14.1 %); at most 7.00° (12.3 %) is permitted"
        " (PV1-2012): NG",
    ]


def test_too_few_motions_and_no_vertical_are_said_at_the_motions():
    for case, text in (
        ("two motions on a slope that only analysis permits", "number of motions: 2; ≥ 3 required"),
        ("no vertical, no test report, no fire lane", "two horizontal and the vertical together"),
    ):
        book = stand_in.book(*CASES[case])
        found = [f for f in foreseen(book.sheet, book.shaking) if f.place == Place("motions")]
        assert any(text in finding.text for finding in found), case


def test_a_limit_has_no_name_to_acknowledge():
    book: Book = stand_in.book(*CASES["slope, risk category and stories"])
    assert {finding.id for finding in foreseen(book.sheet, book.shaking)} == {""}


def test_a_statistic_that_needs_more_motions_is_named_as_the_reason():
    options = stand_in.project().options.model_dump() | {"statistic": "mean"}
    book = stand_in.book(stand_in.project(options=options), motions(7))
    found = [f.text for f in foreseen(book.sheet, book.shaking) if f.level is Level.NOTE]
    assert found
    assert all(
        "7 motions are given, and the statistic 'mean' needs 11 or more" in text for text in found
    )
