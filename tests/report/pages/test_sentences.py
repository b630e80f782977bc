"""Sentences that once claimed what the tables of their package denied."""

import math
import re
from dataclasses import replace

import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.conditions import project_rows
from report.assessment.envelopes import keep_clear_m, keep_clear_words
from report.drawing.plan import plan_drawing
from scenes import DEPARTURE, FOOT, REVIEW
from stand_in import INCH


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


def test_the_smallest_margin_is_of_a_satisfied_clearance_and_a_drift_over_its_limit_larger():
    """A1 alone would satisfy the first one; A3 beside it does not."""
    arrays = [stand_in.array("A1", 0.5, mu=1.0), stand_in.array("A3", 4.0, y=90)]

    def made(provided_m):
        gaps = [stand_in.clearance("A1", "A3", provided_m)]
        return scenes.package(arrays=arrays, options=REVIEW, clearances=gaps)

    low, high = (array.design_m for array in made(9.0).assessment.arrays)
    page = printed(made((low + high) / 2.0), "accuracy")
    assert "satisfied clearance" not in page
    assert page.line("Clearance 1 is not satisfied as given")
    book = stand_in.book(stand_in.project(clearances=[]), scenes.motions())
    drifting = replace(
        book.shaking.prepared[0].measures["horizontal"], final_displacement_m=0.010004
    )
    first = replace(book.shaking.prepared[0], measures={"horizontal": drifting})
    rows = project_rows(book.sheet.project, [first])
    (row,) = [row for row in rows if row.id == "drift"]
    numbers = [float(re.search(r"\((\d+) mm\)", text)[1]) for text in (row.found, row.limit)]
    assert numbers[0] > numbers[1]


@pytest.mark.quick
def test_keep_clear_distances_and_low_parapets_are_those_of_the_package():
    done = scenes.package(options=REVIEW).assessment
    words = {text.words for text in plan_drawing(done).texts}
    for array in done.arrays:
        keep = keep_clear_words(keep_clear_m(done, array), us_first=True)
        assert any(f"; {keep}; no conduit" in text for text in words)
    edge = stand_in.roof_object("N", "edge with parapet", 0, 220, 170, 171, height=20 * INCH)
    package = scenes.package(objects=[edge], clearances=[stand_in.clearance("A3", "N", 6.0)])
    row = printed(package, "plan").table("Parapets").row("N")
    assert (row["Beside"], row["Result"]) == ("A3", "does not qualify")
    assert row["Top above the roof [in]"] == "20.0"
    of_center = float(row["Center of gravity [in]"])
    assert float(row["Top above it [in]"]) == pytest.approx(20.0 - of_center, abs=0.05)


@pytest.mark.quick
@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "the factor ×, importance included, times Δ, of two"),
        (DEPARTURE, "importance included, times the displacement toward it, of"),
    ],
)
def test_the_plan_says_which_displacement_a_separation_takes(options, words):
    assert words in printed(scenes.package(options=REVIEW | options), "plan")


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


@pytest.mark.parametrize("clearances", [[], [stand_in.clearance("A1", "RTU-1", 60 * FOOT)]])
def test_a_limit_that_may_be_exceeded_is_nowhere_said_to_be_satisfied(clearances):
    package = scenes.package(
        scenes.motions(7),
        site=stand_in.site(rule_set="ASCE 7-16", sdc="C"),
        options=REVIEW,
        arrays=[stand_in.array("A1", 3.5, mu=0.6)],
        clearances=clearances,
    )
    assert package.assessment.verdict.is_permitted
    assert any(check.passes_by_exception for _, check in package.checks)
    gaps = ", and all clearances are satisfied; " if clearances else "; the workbook lists no"
    for key in ("letter", "summary"):
        text = f"All limits are satisfied or, where permitted, exceeded{gaps}"
        assert text in printed(package, key)


@pytest.mark.quick
def test_the_largest_peak_of_a_prescriptive_array_is_printed_with_one_rounding():
    """Rounded up in the design displacement, it was another number three lines below."""
    gaps = [stand_in.clearance("A1", "RTU-1", 60 * FOOT)]
    package = scenes.package(scenes.motions(1), arrays=[stand_in.array("A1", 0.5)], clearances=gaps)
    (item,) = package.assessment.arrays
    assert item.route.value == "prescriptive"
    inches = item.analysis.largest_m / INCH
    assert f"{inches:.1f}" != f"{math.ceil(10.0 * inches) / 10.0:.1f}"
    found = re.findall(r"max\([\d.]+ in \(\d+ mm\), ([\d.]+) in", printed(package, "method"))
    assert found == [f"{inches:.1f}"]
