"""Sentences that once claimed what the tables of their package denied."""

import re
from dataclasses import replace

import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.conditions import project_rows
from report.assessment.envelopes import keep_clear_m, keep_clear_words
from report.assessment.remedies import remedies
from report.drawing.plan import plan_drawing
from scenes import FOOT, REVIEW

COMPLETE = scenes.motions()
ONE_WITHOUT = (replace(COMPLETE[0], az_mps2=stand_in.NO_RECORD), *COMPLETE[1:])
NONE_WITH = scenes.level()


@pytest.fixture(scope="module")
def unqualified():
    """A1 has no route; A2 has the prescriptive one, which 5 % less friction closes."""
    arrays = [stand_in.array("A1", 0.5, mu=0.3), stand_in.array("A2", 0.5, mu=0.41, x=120)]
    gaps = [stand_in.clearance("A1", "RTU-1", 7 * FOOT), stand_in.clearance("A1", "A2", 2 * FOOT)]
    return scenes.package(ONE_WITHOUT, arrays=arrays, clearances=gaps)


def test_a_route_that_is_not_permitted_is_said_wherever_its_value_is(unqualified):
    page = printed(unqualified, "comparison")
    first, second = page.line("Array A1: "), page.line("Array A2: ")
    assert "the analysis route is not permitted (Number of components" in first
    assert "the prescriptive route is not permitted" in first
    assert "the prescriptive route is taken" in second
    for id in ("basis", "summary"):
        assert printed(unqualified, id).line("Array A1: the value from analysis is not permitted")


def test_a_clearance_without_a_permitted_route_is_said_to_be_neither_ok_nor_ng(unqualified):
    """The floor of A1 is larger than the second clearance and smaller than the first."""
    for id in ("summary", "clearances"):
        table = printed(unqualified, id).table("Clearances")
        for row in table.rows:
            assert {row[k] for k in ("Required [in]", "Required [mm]", "D/C", "Verdict")} == {
                "none"
            }
        assert (
            "Verdict none: no route to a design displacement is permitted for A1; the required "
            "separation is not known."
        ) in table.notes
    assert remedies(unqualified.assessment) == ()
    assert printed(unqualified, "how-sure").line("Clearances 1, 2 have no verdict, and no margin.")
    assert printed(unqualified, "letter").line("None of the two clearances is satisfied.")


@pytest.mark.parametrize(
    ("array", "none", "words"),
    [
        ("A1", slice(2, None), "no permitted design displacement, so no sensitivity to friction"),
        ("A2", slice(2, 4), "is none: no route is permitted"),
    ],
)
def test_less_friction_says_nothing_of_a_displacement_that_is_not_permitted(
    unqualified, array, none, words
):
    page = printed(unqualified, "accuracy")
    row = [*page.table("Design displacement with").row(array).values()]
    assert {*row[none], row[-2]} == {"none"}
    assert words in page.line(f"Array {array}:")
    assert "remain satisfied" not in page


def test_runs_without_a_vertical_component_are_not_said_to_have_one(unqualified):
    models = printed(unqualified, "model").table("Model used").column("Model")
    assert any("runs without)" in name for name in models)
    alone = printed(scenes.package(NONE_WITH, clearances=[]), "model").table("Model used")
    assert not any("vertical" in name for name in alone.column("Model"))


@pytest.mark.parametrize(
    ("provided_ft", "text"),
    [
        ((0.1, 0.2), "None of the two clearances is satisfied."),
        ((0.1, 30.0), "One of two clearances is satisfied."),
        ((30.0, 30.0), "Both clearances are satisfied."),
        ((0.1,), "The clearance is not satisfied."),
        ((30.0,), "The clearance is satisfied."),
    ],
)
def test_the_letter_counts_the_clearances(provided_ft, text):
    given = zip(("A1", "A2"), provided_ft, strict=False)
    rows = [stand_in.clearance(name, "RTU-1", ft * FOOT) for name, ft in given]
    assert printed(scenes.package(clearances=rows), "letter").line(text)


def test_the_smallest_margin_is_that_of_a_satisfied_clearance():
    """A1 alone would satisfy the first one; A3 beside it does not."""
    arrays = [stand_in.array("A1", 0.5, mu=1.0), stand_in.array("A3", 4.0, y=90)]

    def made(provided_m):
        gaps = [stand_in.clearance("A1", "A3", provided_m)]
        return scenes.package(arrays=arrays, options=REVIEW, clearances=gaps)

    low, high = (array.design_m for array in made(9.0).assessment.arrays)
    page = printed(made((low + high) / 2.0), "how-sure")
    assert "satisfied clearance" not in page
    assert page.line("Clearance 1 is not satisfied as given")


@pytest.mark.parametrize(("name", "is_said"), [("A2", True), ("RTU-1", False)])
def test_what_alike_arrays_assume_is_said_where_there_are_any(name, is_said):
    arrays = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=120)]
    gaps = [stand_in.clearance("A1", name, 30.0)]
    page = printed(scenes.package(arrays=arrays, options=REVIEW, clearances=gaps), "how-sure")
    assert ("Arrays that are alike remain alike" in page) is is_said


def test_the_drawing_keeps_clear_what_the_package_does():
    done = scenes.package(options=REVIEW).assessment
    words = {text.words for text in plan_drawing(done).texts}
    for array in done.arrays:
        keep = keep_clear_words(keep_clear_m(done, array), us_first=True)
        assert f"{keep}; no conduit" in words


def test_the_height_factor_and_the_reduction_are_printed_and_give_the_ratio():
    site = stand_in.project().site.model_dump()
    edition = {"rule_set": "ASCE 7-22", "force_factor": 1.4, "force_divisor": 1.5}
    package = scenes.package(site=site | edition, clearances=[], spectrum=[])
    text, formula, *_ = printed(package, "method").equation(r"\frac{F_p}")
    above, below = map(float, re.findall(r"[\d.]+", text.split(" = ")[1]))
    ratio = text.split(" = ")[2]
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


@pytest.mark.parametrize("options", [{}, REVIEW])
def test_a_floor_that_peer_review_removes_is_none_and_not_a_length(options):
    page = printed(scenes.package(options=options), "comparison")
    row = page.table("Displacement by analysis").rows[0]
    assert (row["Floor [in]"] == row["Floor [mm]"] == "none") is bool(options)


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
    package = scenes.package(site=site, arrays=[array], clearances=[])
    text = printed(package, "inputs").line("Center of gravity at most 36.0 in (914 mm)")
    assert text.endswith(words)
    (check,) = [c for c in package.assessment.arrays[0].checks if "center" in c.title]
    length_m = 1.524 if "60.0" in words else 1.016
    assert check.limit == pytest.approx(min(0.5 * length_m, 0.9144))
