"""A row of a table says what its verdict is due to, and which of its numbers is rounded up."""

import re

import pytest

import scenes
import stand_in
from printed import printed
from report.pages.summary import summary

pytestmark = pytest.mark.quick

NEAR = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


def test_an_array_that_is_ng_by_a_missing_clearance_says_so_in_its_row():
    """The clearance that is listed is OK, and its D/C alone stands beside the NG."""
    made = scenes.package(
        arrays=[stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)],
        objects=[NEAR],
        clearances=[stand_in.clearance("A2", "A1", 40.0)],
    )
    for key, title in (("letter", "Results"), ("summary", "Arrays")):
        one, other = printed(made, key).table(title).column("Verdict")
        assert one == "NG clearance A1 to RTU-9 not given"
        assert other == "Condition"
    assert (
        "Condition: all are satisfied once the conditions below are met; NG: a "
        "requirement is not satisfied, or no design displacement is permitted"
    ) in printed(made, "summary")
    assert any("NG: clearance A1 to RTU-9 not given" in line for line in summary(made.assessment))


@pytest.fixture(scope="module")
def barely():
    """A clearance, a slack and a strength a hair below what is required."""
    array = stand_in.array("A1", 0.5)
    objects = [stand_in.roof_object("RTU-1", "fixed object", 140, 145, 35, 42, height=1.0)]
    gap = stand_in.clearance("A1", "RTU-1", 9.0)
    given = scenes.package(arrays=[array], objects=objects, clearances=[gap]).assessment
    (item,), (gap,) = given.arrays, given.clearances
    less_m, less_n = ((1.0 - 1e-5) * v for v in (gap.required_m, item.interconnection_n))
    array |= {"slack_m": less_m, "interconnection_n": less_n}
    listed = [stand_in.clearance("A1", "RTU-1", less_m)]
    return scenes.package(arrays=[array], objects=objects, clearances=listed)


def test_what_is_short_by_a_hair_prints_as_less_than_is_required(barely):
    (row,) = printed(barely, "summary").table("Clearances").rows
    assert float(row["Required [in]"].strip("†")) > float(row["Provided [in]"])
    slack = printed(barely, "summary").line("NG: Array A1, electrical slack")
    had, least = re.search(r"provided: ([\d.]+) in .* required: ≥ ([\d.]+) in", slack).groups()
    assert float(had) < float(least)
    (strength,) = printed(barely, "limits").tables[-1].rows
    assert float(strength["Provided [lb]"]) < float(strength["Required [lb]"].strip("†"))


def test_deleting_the_row_of_a_clearance_lowers_nothing():
    """What the plan shows and no row covers counts as the row did: D/C, letter, cover, counts."""
    array, far = stand_in.array("A1", 0.5), stand_in.clearance("A1", "RTU-8", 40.0 * stand_in.FOOT)
    objects = [NEAR, stand_in.roof_object("RTU-8", "fixed object", 140, 145, 35, 42, height=1.0)]
    near = stand_in.clearance("A1", "RTU-9", stand_in.FOOT)  # as in plan
    both = scenes.package(arrays=[array], objects=objects, clearances=[far, near])
    deleted = scenes.package(arrays=[array], objects=objects, clearances=[far])
    ratios, names = [], []
    for made in (both, deleted):
        gap = made.assessment.governing_gap()
        assert gap.demand_capacity == made.assessment.governing_gap("A1").demand_capacity > 1.0
        ratios.append(gap.demand_capacity)
        row = printed(made, "letter").table("Results").row("A1")
        names.append((row["Governing clearance to"], row["D/C"]))
        worst = printed(made, "summary").table("Clearances").rows[0]["Between"]
        assert worst == ("A1–RTU-8" if made is deleted else "A1–RTU-9")
        assert "One of two clearances is satisfied." in printed(made, "letter")
    assert f"A1 to RTU-9, not given: D/C {row['D/C']}" in str(printed(deleted, "summary"))
    assert ratios[0] == pytest.approx(ratios[1])
    assert names == [("RTU-9", names[0][1]), ("RTU-9 (not given)", names[0][1])]
    assert "The plan shows one of them without a row" in printed(deleted, "letter")


def test_the_letter_and_the_cause_say_what_is_not_given():
    made = scenes.package(arrays=[stand_in.array("A1", 0.5)], objects=[NEAR], clearances=[])
    said = printed(made, "letter")
    assert (
        "The clearance is not satisfied. The plan shows it without a row in the workbook." in said
    )
    given = scenes.package(arrays=[stand_in.array("A1", 0.5)], objects=[], clearances=[])
    item = given.assessment.arrays[0]
    rows = {row.id: row.cause for row in given.assessment.rows_of(item.id)}
    assert rows["electrical_slack"] == "electrical slack not given"
    assert rows["interconnection"] == "interconnection strength not given"


@pytest.mark.parametrize(
    ("array", "gap", "cause"),
    [
        ({"slack_m": 0.001}, {}, "electrical slack too short"),
        ({"interconnection_n": 1.0}, {}, "interconnection strength too low"),
        ({"roof_capacity_pa": 1.0}, {}, "weight over the roof capacity"),
        ({}, {"pathway_m": 8.9}, "fire pathway A1 to RTU-1 too narrow"),
        ({"slope_value": 6.9}, {}, "roof slope, any ballasted system, over its limit"),
    ],
)
def test_a_cause_says_what_is_wrong_and_not_what_is_compared(array, gap, cause):
    given = scenes.package(
        arrays=[stand_in.array("A1", 0.5) | array],
        objects=[stand_in.roof_object("RTU-1", "fixed object", 140, 145, 35, 42, height=1.0)],
        clearances=[stand_in.clearance("A1", "RTU-1", 9.0) | gap],
    )
    assert printed(given, "letter").table("Results").column("Verdict") == [f"NG {cause}"]
