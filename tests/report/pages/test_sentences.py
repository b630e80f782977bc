"""Sentences that once claimed what the tables of their package denied."""

import datetime as dt
import re
from dataclasses import replace

import pytest

import stand_in
from report.assessment.certainty import certainty
from report.assessment.conditions import project_rows
from report.assessment.envelopes import keep_clear_m, keep_clear_words
from report.assessment.remedies import remedies
from report.assessment.sensitivity import accuracy
from report.drawing.plan import plan_drawing
from report.pages import accuracy as accuracy_page
from report.pages import certainty as certainty_page
from report.pages import clearances, inputs, letter, limits, model, results
from report.pages.demand import demand_lines
from report.pages.registry import package_data
from stand_in import FOOT

REVIEW = {
    "peer_reviewed": True,
    "peer_reviewer": "Reviewer of record",
    "peer_license": "CA S0000",
    "peer_date": dt.date(2026, 3, 1),
}
COMPLETE = stand_in.motions(3, seconds=8.0)
ONE_WITHOUT = (replace(COMPLETE[0], az_mps2=stand_in.NO_RECORD), *COMPLETE[1:])


def made(motions=COMPLETE, **changes):
    return package_data(stand_in.assess_input(stand_in.project(**changes), motions))


@pytest.fixture(scope="module")
def unqualified():
    """A1 has no route; A2 has the prescriptive one, which 5 % less friction closes."""
    arrays = [stand_in.array("A1", 0.5, mu=0.3), stand_in.array("A2", 0.5, mu=0.41, x=120)]
    gaps = [stand_in.clearance("A1", "RTU-1", 7 * FOOT), stand_in.clearance("A1", "A2", 2 * FOOT)]
    return made(ONE_WITHOUT, arrays=arrays, clearances=gaps)


def test_a_route_that_is_not_permitted_is_said_wherever_its_value_is(unqualified):
    first, second = results.comparison(unqualified)["sentences"]
    assert "the analysis route is not permitted (Number of components" in first
    assert "the prescriptive route is not permitted" in first
    assert "the prescriptive route is taken" in second
    (text,) = [text for text in limits.troubles(unqualified) if "these motions" in text]
    assert text.startswith("Array A1: the value from analysis is not permitted")


def test_a_clearance_without_a_permitted_route_is_said_to_be_neither_ok_nor_ng(unqualified):
    """The floor of A1 is larger than the second clearance and smaller than the first."""
    for brief in (True, False):
        table = clearances.clearance_table(unqualified, brief=brief)
        for row in table.rows:
            assert row.cells[-6:-4] == ("none", "none")
            assert [str(cell) for cell in row.cells[-2:]] == ["none", '<b class="none">none</b>']
        assert table.notes == (
            "Verdict none: no route to a design displacement is permitted for A1; the required "
            "separation is not known.",
        )
    assert remedies(unqualified.assessment) == ()
    margins = certainty_page.page(unqualified, certainty(unqualified.assessment))
    assert margins["margin"] == "Clearances 1, 2 have no verdict, and no margin."
    assert letter._clearances(unqualified) == "None of the two clearances is satisfied."


def test_less_friction_says_nothing_of_a_displacement_that_is_not_permitted(unqualified):
    content = accuracy_page.page(unqualified, accuracy(unqualified.assessment))
    row = next(row for row in content["friction"].rows if row.cells[0] == "A1")
    assert set(row.cells[2:]) == {"none"}
    assert (
        "Array A1: no permitted design displacement, so no sensitivity to friction is given."
        in content["sentences"]
    )
    assert not any("remain satisfied" in text for text in content["sentences"])


def test_less_friction_that_closes_the_route_leaves_no_design_displacement(unqualified):
    found = accuracy(unqualified.assessment)
    content = accuracy_page.page(unqualified, found)
    (text,) = [text for text in content["sentences"] if text.startswith("Array A2")]
    assert "is none: no route is permitted" in text
    row = next(row for row in content["friction"].rows if row.cells[0] == "A2")
    assert row.cells[2:4] == ("none", "none")
    assert row.cells[-2] == "none"


def test_runs_without_a_vertical_component_are_not_said_to_have_one(unqualified):
    cells = model._model_rows(unqualified.assessment.arrays[0])
    names = {row[1]: row[2] for row in cells}
    assert any("runs without)" in name for name in names)
    alone = made(tuple(replace(m, az_mps2=stand_in.NO_RECORD) for m in COMPLETE), clearances=[])
    for row in model._model_rows(alone.assessment.arrays[0]):
        assert "vertical" not in row[1]


@pytest.mark.parametrize(
    ("provided_ft", "text"),
    [
        ((0.1, 0.2), "None of the two clearances is satisfied."),
        ((0.1, 30.0), "One of two clearances is satisfied."),
        ((30.0, 30.0), "All two clearances are satisfied."),
        ((0.1,), "The clearance is not satisfied."),
        ((30.0,), "The clearance is satisfied."),
    ],
)
def test_the_letter_counts_the_clearances(provided_ft, text):
    names = ("A1", "A2")
    rows = [
        stand_in.clearance(name, "RTU-1", ft * FOOT)
        for name, ft in zip(names, provided_ft, strict=False)
    ]
    assert letter._clearances(made(clearances=rows)) == text


def test_the_smallest_margin_is_that_of_a_satisfied_clearance():
    """A1 alone would satisfy the first one; A3 beside it does not."""
    arrays = [stand_in.array("A1", 0.5, mu=1.0), stand_in.array("A3", 4.0, y=90)]
    wide = made(arrays=arrays, options=REVIEW, clearances=[stand_in.clearance("A1", "A3", 9.0)])
    low, high = (array.design_m for array in wide.assessment.arrays)
    gap = [stand_in.clearance("A1", "A3", (low + high) / 2.0)]
    package = made(arrays=arrays, options=REVIEW, clearances=gap)
    text = certainty_page.page(package, certainty(package.assessment))["margin"]
    assert "satisfied clearance" not in text
    assert text.startswith("Clearance 1 is not satisfied as given")


def test_what_alike_arrays_assume_is_said_where_there_are_any():
    arrays = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=120)]
    for names, is_said in (("A2", True), ("RTU-1", False)):
        rows = [stand_in.clearance("A1", names, 30.0)]
        package = made(arrays=arrays, options=REVIEW, clearances=rows)
        table = certainty_page.page(package, certainty(package.assessment))["margins"]
        assert ("Arrays that are alike remain alike" in table.notes[0]) is is_said


def test_the_drawing_keeps_clear_what_the_package_does():
    package = made(options=REVIEW)
    words = {text.words for text in plan_drawing(package.assessment).texts}
    for array in package.assessment.arrays:
        keep = keep_clear_words(keep_clear_m(package.assessment, array), us_first=True)
        assert f"{keep}; no conduit" in words


def test_the_height_factor_and_the_reduction_are_printed_and_give_the_ratio():
    site = stand_in.project().site.model_dump()
    edition = {"rule_set": "ASCE 7-22", "force_factor": 1.4, "force_divisor": 1.5}
    package = made(site=site | edition, clearances=[], spectrum=[])
    force = next(line for line in demand_lines(package) if "F_p" in line.latex)
    (text, ratio), (formula, _), *_ = force.steps
    above, below = map(float, re.findall(r"[\d.]+", str(text).split("=")[1]))
    assert above / below == pytest.approx(float(ratio), abs=1e-3)
    assert ratio in formula


def test_a_drift_over_its_limit_prints_larger():
    book = stand_in.book(stand_in.project(clearances=[]), COMPLETE)
    drifting = replace(
        book.shaking.prepared[0].measures["horizontal"], final_displacement_m=0.010004
    )
    first = replace(book.shaking.prepared[0], measures={"horizontal": drifting})
    rows = project_rows(book.sheet.project, [first])
    (row,) = [row for row in rows if row.id == "drift"]
    numbers = [float(re.search(r"\((\d+) mm\)", text)[1]) for text in (row.found, row.limit)]
    assert numbers[0] > numbers[1]


@pytest.mark.parametrize(
    ("signs", "count"),
    [((1,), "so in the polarities requested two are run"), ((1, -1), "so four are run")],
)
def test_the_runs_of_a_motion_are_those_of_its_polarities(signs, count):
    motions = tuple(replace(motion, signs=signs) for motion in COMPLETE)
    assert count in model._combinations(made(motions, clearances=[]))


@pytest.mark.parametrize("options", [{}, REVIEW])
def test_a_floor_that_peer_review_removes_is_none_and_not_a_length(options):
    package = made(options=options)
    row = results.comparison(package)["table"].rows[0]
    is_none = row.cells[7:9] == ("none", "none")
    assert is_none is bool(options)


@pytest.mark.parametrize(
    ("rule_set", "base_m", "words"),
    [
        ("SEAOC PV1-2012", 1.524, "supporting base: A1 60.0 in (1524 mm)."),
        ("SEAOC PV1-2012", None, "A1 40.0 in (1016 mm) (support spacing; no base given)."),
        ("ASCE 7-16", 1.524, "least spacing of the supports: A1 40.0 in (1016 mm)."),
    ],
)
def test_the_length_that_limits_the_center_of_gravity_is_the_one_compared(rule_set, base_m, words):
    site = stand_in.project().site.model_dump() | {"rule_set": rule_set}
    array = stand_in.array("A1", 0.5, base_m=base_m)
    package = made(site=site, arrays=[array], clearances=[])
    text = inputs._low_profile(package)
    assert text.endswith(words)
    assert text.startswith("Center of gravity at most 36.0 in (914 mm)")
    (check,) = [c for c in package.assessment.arrays[0].checks if "center" in c.title]
    length_m = 1.524 if "60.0" in words else 1.016
    assert check.limit == pytest.approx(min(0.5 * length_m, 0.9144))
