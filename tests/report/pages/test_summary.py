"""What the summary, on its page and in the terminal, says where no route is permitted."""

import pytest

import stand_in
from places import ROOT
from printed import printed
from report.assessment.arrays import Route
from report.assessment.assess import assess
from report.pages.summary import document, summary
from report.web.controls import opened, with_values

pytestmark = pytest.mark.quick


def test_prescriptive_designs_have_no_floor_and_clearances_without_verdict_are_counted():
    arrays = [stand_in.array("A2", 0.5, x=120)]
    done = stand_in.unpermitted(arrays=arrays, clearances=[])
    assert {array.route for array in done.arrays} == {Route.PRESCRIPTIVE}
    shown = printed(done, "summary").facts
    assert "Floor" not in shown
    assert shown["Peer review"] == (
        "reviewer not given; no floor is used: no array takes the value from analysis"
    )
    assert "floor" not in printed(done, "letter")
    gaps = [stand_in.clearance("A1", "RTU-1", 7 * stand_in.FOOT)]
    page = printed(stand_in.unpermitted(clearances=gaps), "summary")
    assert page.line("NG ").endswith("; without a verdict: 1 of 1 clearance.")


@pytest.mark.nightly
def test_the_terminal_marks_what_is_not_permitted_and_calls_nothing_beside_it_ok():
    weak = with_values(opened(ROOT / "projects/school"), {"intensity": 0.32, "together": "no"})
    done = assess(weak.sheet, weak.shaking)
    lines = list(summary(done))
    for item, line in zip(document(done)["arrays"], lines[1:], strict=False):
        assert line.startswith(item["id"])
        assert "488 mm (19.2 in), not permitted" in line  # at another S_DS it is not reviewed
        assert "none  NG: roof slope, analysis route" in line
        causes = [cause for cause in item["causes"] if cause.startswith("clearance to ")]
        assert causes
        assert all(cause.endswith(", no verdict") for cause in causes)
    assert not any("OK" in line or line.startswith("NG: clearance") for line in lines)
    assert lines[-1] == "verdict: NG"


def test_what_is_alike_of_several_arrays_or_clearances_is_said_once():
    arrays = [stand_in.array(f"A{k}", 0.5, x=120 * k) for k in (1, 2, 3)]
    done = stand_in.assess_input(stand_in.project(arrays=arrays), stand_in.motions(1, seconds=4.0))
    (group,) = [ids for row, ids in done.alike_conditions if row.id == "interconnection"]
    assert group == ["A1", "A2", "A3"]
    assert sum(len(ids) for _, ids in done.alike_conditions) == len(done.conditions)
    page = printed(done, "summary")
    assert "not given" in page.line("Arrays A1 to A3, interconnection strength")
    arrays = [stand_in.array(f"A{k}", 0.5, x=120 * k, y=20) for k in (1, 2, 3)]
    rows = [stand_in.clearance("A1", "A2", 2.0), stand_in.clearance("A2", "A3", 2.0)]
    data = stand_in.project(arrays=arrays, clearances=rows, objects=[])
    done = stand_in.assess_input(data, stand_in.motions(1, seconds=4.0))
    differing = [row for row in done.conditions if row.id == "neighbors"]
    (one,) = [row for row, _ in done.alike_conditions if row.id == "neighbors"]
    assert (len(differing), one.title) == (2, "Clearances A1 to A2, A2 to A3")
    cells = [row.remedy.split(":")[0] for row in differing]
    assert one.remedy.startswith(f"{', '.join(dict.fromkeys(cells))}: correct the clearance")
    line = printed(done, "summary").line("Clearances A1 to A2, A2 to A3: differs from the plan")
    assert "required: as in the plan" in line


def test_a_requirement_that_is_found_differently_is_one_row_with_each_array_before_its_own():
    given = {"A1": 10.0, "A2": 20.0, "A3": 20.0}
    arrays = [
        stand_in.array(id, 0.5, x=120 * k, interconnection_n=strength_n)
        for k, (id, strength_n) in enumerate(given.items())
    ]
    done = stand_in.assess_input(stand_in.project(arrays=arrays), stand_in.motions(1, seconds=4.0))
    line = printed(done, "summary").line("NG: Arrays A1 to A3, interconnection strength provided")
    # 1 lb = 4.448 N; provided is rounded down
    assert "provided: A1: 2 lb (0.01 kN); A2, A3: 4 lb (0.02 kN); required: ≥ 4374 lb" in line
