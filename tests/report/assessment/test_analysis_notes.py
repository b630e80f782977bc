"""Where the design is prescriptive, what concerns the analysis alone is a note that none must meet.

Where a design displacement follows from a run all the same, it is a condition.
"""

import pytest

import scenes
import stand_in
from printed import printed
from report.assessment.arrays import Route
from report.assessment.verdict import Verdict

FLAT = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)]
GAPS = [stand_in.clearance("A1", "A2", 110 * stand_in.FOOT)]
ALONE = scenes.along(scenes.motions())  # one component: the analysis route is not permitted


def made(shaking=ALONE, **changes):
    given = {"arrays": FLAT, "objects": [], "clearances": GAPS} | changes
    return scenes.package(shaking, **given)


def test_the_motions_and_the_review_are_notes_and_not_counted():
    package = made(options={"peer_reviewed": True})
    done = package.assessment
    assert {item.route for item in done.arrays} == {Route.PRESCRIPTIVE}
    notes = {row.id for row in done.notes}
    assert {"motions", "peer_review"} <= notes
    assert not notes & {row.id for row in done.conditions}
    assert all(row.verdict is Verdict.NOTE for row in done.notes)
    summary = printed(package, "summary")
    assert f"{len(done.alike_conditions)} conditions listed in part 1" in summary
    assert f"{len(done.notes)} limits on the analysis are not satisfied, and no design" in summary
    table = printed(package, "limits").table("Other requirements")
    noted = {row["Requirement"] for row in table.rows if row["Verdict"] == "note"}
    assert noted == {row.title for row in done.notes}


@pytest.mark.quick
def test_by_analysis_they_are_what_they_were():
    steep = [row | {"slope_value": 4.0} for row in FLAT]
    done = made(arrays=steep).assessment
    assert not done.notes
    assert any(row.id == "motions" and row.verdict is Verdict.NG for row in done.rows)


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
    assert any(row.id == "motions" for row in done.conditions)
    words = printed(package, "basis")
    assert "design displacements are prescriptive" not in words
