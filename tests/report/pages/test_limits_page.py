"""The part on limits, the conditions and the verdict are worded from the project at hand."""

from dataclasses import replace

import pytest

import stand_in
from report.pages.front import verdict_sentence
from report.pages.limits import conditions, limits
from report.pages.registry import package_data

MOTIONS = stand_in.motions(3, seconds=4.0)
ONE_COMPONENT = [replace(motion, ay_mps2=stand_in.NO_RECORD) for motion in MOTIONS]


def package(motions=MOTIONS, **changes):
    return package_data(stand_in.assess_input(stand_in.project(**changes), motions))


@pytest.mark.parametrize(
    ("motions", "slopes_deg", "caption"),
    [
        (MOTIONS, (1.0, 2.0), "Limits of the building and of the analysis route"),
        (ONE_COMPONENT, (1.0, 2.0), "Limits of the building and of the prescriptive route"),
        (
            ONE_COMPONENT,
            (1.0, 4.0),
            "Limits of the building, of the analysis route (A2) and of the prescriptive route (A1)",
        ),
    ],
)
def test_the_limits_are_called_those_of_the_routes_taken(motions, slopes_deg, caption):
    arrays = [stand_in.array(f"A{k}", slope) for k, slope in enumerate(slopes_deg, start=1)]
    made = package(motions, arrays=arrays, objects=[], clearances=[])
    assert limits(made)["tables"][0].caption == caption


def test_a_condition_and_a_requirement_marked_ng_are_named_as_such():
    array = stand_in.array("A1", 0.5, slack_m=0.1)
    made = package(arrays=[array], objects=[], clearances=[])
    texts = conditions(made)
    assert any(text.startswith("NG: array A1, Electrical slack") for text in texts)
    assert any(text.startswith("Condition: array A1, Interconnection") for text in texts)
    assert all(text.startswith(("NG: ", "Condition: ")) for text in texts)


def test_a_verdict_claims_no_clearance_where_none_is_listed():
    array = stand_in.array("A1", 0.5)
    text = verdict_sentence(package(arrays=[array], objects=[], clearances=[]))
    assert text.startswith(
        "All limits are satisfied; the workbook lists no clearance, and none is checked; "
    )
    gap = stand_in.clearance("A1", "RTU-1", 30.0)
    listed = verdict_sentence(package(arrays=[array], clearances=[gap]))
    assert listed.startswith("All limits and clearances are satisfied; ")
