"""What the summary must name: a removed floor, and a departure from the rule set."""

import pytest

import scenes
import stand_in
from places import ROOT
from printed import printed
from report.assessment.arrays import Route
from report.assessment.project import assess
from report.pages.summary import document, summary
from report.web.opened import opened, with_values


def facts(**options):
    return printed(scenes.package(options=options), "summary").facts


def test_a_removed_floor_and_a_departure_are_named_where_there_are_any():
    assert not {"Floor", "Departure"} & facts().keys()
    assert facts(**scenes.REVIEW)["Floor"] == (
        "removed by peer review: Reviewer of record, CA S0000, 2026-03-01"
    )
    assert "reviewer not given" in facts(peer_reviewed=True)["Floor"]
    assert "Agreed on 2026-02-10" in facts(**scenes.DEPARTURE)["Departure"]


def test_no_floor_is_removed_where_the_design_is_prescriptive():
    arrays = [stand_in.array("A2", 0.5, x=120)]
    done = stand_in.unpermitted(arrays=arrays, clearances=[])
    assert {array.route for array in done.arrays} == {Route.PRESCRIPTIVE}
    shown = printed(done, "summary").facts
    assert "Floor" not in shown
    assert shown["Peer review"] == (
        "reviewer not given; no floor is used: the design displacements are prescriptive"
    )
    assert "floor" not in printed(done, "letter")


@pytest.mark.parametrize(("count", "words"), [(3, "2 of 3 clearances."), (1, "1 of 1 clearance.")])
def test_clearances_without_a_verdict_are_counted_beside_what_is_ng(count, words):
    gaps = [row.model_dump() for row in stand_in.unpermitted().project.clearances]
    page = printed(stand_in.unpermitted(clearances=gaps[:count]), "summary")
    assert page.line("NG Marked NG: ").endswith(f"; without a verdict: {words}")


def test_the_terminal_marks_what_is_not_permitted_and_calls_nothing_beside_it_ok():
    weak = with_values(opened(ROOT / "projects/school"), {"intensity": 0.32, "together": "no"})
    done = assess(weak.sheet, weak.shaking)
    lines = list(summary(done))
    for item, line in zip(done.arrays, lines[1:], strict=False):
        assert line.startswith(item.id)
        assert "0 mm (0.0 in), not permitted" in line
        assert "none  NG: limits on the motions" in line
        causes = [cause for cause in causes_of(done, item) if cause.startswith("clearance to ")]
        assert causes
        assert all(cause.endswith(", no verdict") for cause in causes)
    assert not any("OK" in line or line.startswith("NG: clearance") for line in lines)
    assert lines[-1] == "verdict: NG"


def causes_of(done, item):
    """The causes of an array's verdict, as JSON has them."""
    return next(array["causes"] for array in document(done)["arrays"] if array["id"] == item.id)
