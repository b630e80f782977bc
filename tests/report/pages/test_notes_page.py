"""The notes for the construction documents print what the package computes, and nothing else."""

import math
import re

import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.envelopes import keep_clear_m, keep_clear_words
from solver.model import INCH_M

pytestmark = pytest.mark.quick

FOOT = stand_in.FOOT
ARRAYS = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)]
GAPS = [stand_in.clearance("A1", "A2", 120 * FOOT)]


def package(**changes):
    return scenes.package(**{"arrays": ARRAYS, "objects": [], "clearances": GAPS} | changes)


def notes(**changes):
    return printed(package(**changes), "notes")


def test_schedules_have_what_plan_and_runs_have():
    made = package()
    table = printed(made, "notes").table("Schedule of arrays")
    for item in made.assessment.arrays:
        row = table.row(item.id)
        ends = [
            math.hypot(run.result.residual_m, run.result.residual_across_m) for run in item.runs
        ]
        assert f"keep clear {row['Keep clear']}" == keep_clear_words(
            keep_clear_m(made.assessment, item), us_first=True
        )
        assert float(row["Design displ. [in]"].rstrip("†")) * INCH_M >= item.permitted_m
        assert row["Residual [in]"] == f"{max(ends) / INCH_M:.1f}"
        assert row["Weight W [lb]"] == "42000"
        assert row["Interconnection [lb]"] == "4374"
    near = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42)
    rows = [*GAPS, stand_in.clearance("A1", "RTU-9", FOOT)]
    made = package(objects=[near], clearances=rows, options={"peer_reviewed": True})
    table = printed(made, "notes").table("Schedule of gaps")
    least = [math.ceil(gap.required_m * 1e3) for gap in made.assessment.clearances]
    assert [(row["To"], row["At least [mm]"], row["Measured, date, by"]) for row in table.rows] == [
        ("A2", str(least[0]), ""), ("RTU-9", str(least[1]), ""),
    ]  # fmt: skip
    assert least[1] != round(made.assessment.clearances[1].required_m * 1e3)


def test_gaps_without_a_row_or_not_satisfied_are_named_and_none_without():
    near = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42)
    line = notes(objects=[near]).line("Neighbors in plan without a clearance")
    assert line.endswith("to be resolved first (part 1): A1 to RTU-9.")
    assert "without a clearance" not in notes()
    rows = [*GAPS, stand_in.clearance("A2", "A1", 0.1)]
    (note,) = notes(clearances=rows).table("Schedule of gaps").notes
    assert note == "Not satisfied as designed: No. 2."
    assert "gap" not in notes(clearances=[])


def test_membrane_supports_and_report_are_those_of_the_workbook_or_by_others():
    made = package(friction_tests=scenes.TESTS)
    line = printed(made, "notes").line("Roof membrane:")
    assert line.startswith("Roof membrane: TPO, 60 mil. Supports of the arrays: EPDM pad.")
    assert "Example Laboratories, ASTM G115-10, report FT-118, 2025-06-12" in line
    letter = printed(made, "letter").line("Friction.")
    assert "All arrays: ASTM G115, Lab 1234, 2025-06-12; entered; no runs of friction tes" in letter
    line = notes().line("Roof membrane:")
    assert line.startswith("Roof membrane: by others. Supports of the arrays: by others. Frict")


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({}, r"\w+ conditions? of part 1 (is|are) to be met first\."),
        ({"clearances": [stand_in.clearance("A1", "A2", 0.1)]}, r"Not for construction: its verdi"),
    ],
)
def test_the_first_note_says_whether_the_package_is_for_construction(changes, text):
    assert re.search(text, notes(**changes).line("Source: calculation package 24-117, revision 0"))


@pytest.mark.parametrize("height_m", [1.2, 0.3])
def test_only_a_parapet_that_qualifies_is_relied_on(height_m):
    edge = stand_in.roof_object("N", "edge with parapet", 0, 400, 200, 202, height=height_m)
    page = notes(objects=[edge], clearances=[stand_in.clearance("A1", "N", 60.0)])
    assert ("Parapets that the clearances rely on" in page) is (height_m == 1.2)
    assert ("Height of the parapets above the roof is measured: N." in page) is (height_m == 1.2)


def test_wiring_takes_the_elongation_of_links_and_no_displacement_is_printed_without_a_route():
    done = scenes.unpermitted()
    (item,) = done.linked
    most = max(run.row.stretch_m for motion in item.motions for run in motion.runs)
    line = printed(done, "notes").line("Wiring, conduit")
    assert f"links elongate by up to {most * 1e3:.0f} mm" in line
    assert "links" not in notes()
    row = printed(scenes.unpermitted(), "notes").table("Schedule of arrays").row("A1")
    assert [row["Design displ. [mm]"], row["Keep clear"]] == ["none", "unknown"]


def test_the_letter_has_a_row_for_each_governing_distance():
    made = package(clearances=[*GAPS, stand_in.clearance("A2", "A1", 100 * FOOT)])
    table = printed(made, "letter").table("Results")
    for item in made.assessment.arrays:
        row, gap = table.row(item.id), made.assessment.governing_gap(item.id)
        assert row["Required [in]"] == f"{gap.required_m / INCH_M:.1f}"
        assert row["Provided [in]"] == "1200.0"
        keep = keep_clear_words(keep_clear_m(made.assessment, item), us_first=True)
        assert f"keep clear {row['Keep clear']}" == keep
    arrays = [stand_in.array("A1", 0.5, i_p=1.0), stand_in.array("A2", 0.5, x=220, i_p=1.5)]
    made = package(arrays=arrays, clearances=[])
    table = printed(made, "letter").table("Results")
    for item in made.assessment.arrays:
        keep = keep_clear_words(keep_clear_m(made.assessment, item), us_first=True)
        assert f"keep clear {table.row(item.id)['Keep clear'].rstrip('†')}" == keep


def test_the_letter_says_what_its_results_rest_on_and_is_in_the_contents():
    page = printed(package(friction_tests=scenes.TESTS), "letter")
    assert page.line("the roof membrane is TPO, 60 mil and the supports of the arrays are EPDM")
    assert page.line("Friction.").endswith("report FT-118, 2025-06-12.")
    attached = page.line("Attachments.")
    assert "clearances in part 3, " in attached
    assert "In its file: workbook " in attached
    assert "and what appendix A lists with it." in attached
    page = printed(package(), "letter")
    assert page.line("Friction.").endswith("No friction test report is entered.")
    assert page.line("the roof membrane and the supports of the arrays give the friction above;")
    line = printed(package(), "contents").line("Contents")
    assert line.startswith("Contents (sheet) 1 Summary; Letter of results; 2 Comparison")
