"""The part on limits, the conditions and the verdict are worded from the project at hand."""

import pytest

import scenes
import stand_in
from printed import printed

MOTIONS = scenes.motions(3, seconds=4.0)
ALONE = {"objects": [], "clearances": []}


@pytest.mark.parametrize(
    ("motions", "slopes_deg", "caption"),
    [
        (MOTIONS, (1.0, 2.0), "Limits of the building and of the analysis route"),
        (scenes.along(MOTIONS), (1.0, 2.0), "Limits of the building and of the prescriptive route"),
        (
            scenes.along(MOTIONS),
            (1.0, 4.0),
            "Limits of the building, of the analysis route (A2) and of the prescriptive route (A1)",
        ),
    ],
)
def test_the_limits_are_called_those_of_the_routes_taken(motions, slopes_deg, caption):
    arrays = [stand_in.array(f"A{k}", slope) for k, slope in enumerate(slopes_deg, start=1)]
    page = printed(scenes.package(motions, arrays=arrays, **ALONE), "limits")
    assert page.tables[0].title == caption


def test_a_condition_and_a_requirement_marked_ng_are_named_as_such():
    array = stand_in.array("A1", 0.5, slack_m=0.1)
    page = printed(scenes.package(MOTIONS, arrays=[array], **ALONE), "summary")
    assert page.line("NG: array A1, Electrical slack")
    assert page.line("Condition: array A1, Interconnection")
    _, listed = page.split("Conditions and requirements not satisfied\n")
    lines = listed.partition("[")[0].splitlines()
    assert [line for line in lines if not line.startswith(("- NG: ", "- Condition: "))] == []


def test_a_verdict_claims_no_clearance_where_none_is_listed():
    arrays = {"arrays": [stand_in.array("A1", 0.5)]}
    assert "All limits are satisfied; the workbook lists no clearance, and none is checked; " in (
        printed(scenes.package(MOTIONS, **arrays, **ALONE), "summary")
    )
    listed = {"clearances": [stand_in.clearance("A1", "RTU-1", 30.0)]}
    assert "All limits and clearances are satisfied; " in (
        printed(scenes.package(MOTIONS, **arrays, **listed), "summary")
    )
