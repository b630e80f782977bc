"""A row of a table says what its verdict is due to, and which of its numbers is rounded up."""

import re

import pytest

import stand_in
from report.pages.clearances import clearance_table
from report.pages.cover import cover
from report.pages.front import summary
from report.pages.letter import letter
from report.pages.limits import conditions, limits
from report.pages.registry import package_data
from report.pages.summary import summary as printed

MOTIONS = stand_in.motions(3, seconds=8.0)
NEAR = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


def package(motions=MOTIONS, **changes):
    return package_data(stand_in.assess_input(stand_in.project(**changes), motions))


def plain(text):
    return re.sub(r"<[^>]*>", "", text)


def test_an_array_that_is_ng_by_a_missing_clearance_says_so_in_its_row():
    """The clearance that is listed is OK, and its D/C alone stands beside the NG."""
    made = package(
        arrays=[stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)],
        objects=[NEAR],
        clearances=[stand_in.clearance("A2", "A1", 40.0)],
    )
    for table in (letter(made)["arrays"], summary(made, (), ())["arrays"]):
        one, other = (plain(row.cells[-1]) for row in table.rows)
        assert one == "NG clearance A1 to RTU-9 not given"
        assert other == "OK with conditions"
    assert any("NG: clearance A1 to RTU-9 not given" in line for line in printed(made.assessment))


def test_the_governing_array_is_one_that_is_ng_where_any_is():
    arrays = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, mu=0.6, x=220)]
    far = [stand_in.clearance("A1", "A2", 40.0)]
    for objects, name, verdict in (
        ([], "A1", "μ 0.45"),
        ([stand_in.roof_object("RTU-9", "fixed object", 301, 306, 35, 42, 1.0)], "A2", "NG"),
    ):
        made = package(arrays=arrays, objects=objects, clearances=far)
        assert made.governing.id == "A1"
        assert dict(cover(made)["block"])["Governing array"].startswith(f"{name}: {verdict}; ")


@pytest.fixture(scope="module")
def barely():
    """A clearance, a slack and a strength a hair below what is required."""
    array = stand_in.array("A1", 0.5)
    objects = [stand_in.roof_object("RTU-1", "fixed object", 140, 145, 35, 42, height=1.0)]
    given = package(
        arrays=[array], objects=objects, clearances=[stand_in.clearance("A1", "RTU-1", 9.0)]
    )
    (item,), (gap,) = given.assessment.arrays, given.assessment.clearances
    less_m, less_n = ((1.0 - 1e-5) * v for v in (gap.required_m, item.interconnection_n))
    array |= {"slack_m": less_m, "interconnection_n": less_n}
    listed = [stand_in.clearance("A1", "RTU-1", less_m)]
    return package(arrays=[array], objects=objects, clearances=listed)


def test_a_value_that_prints_otherwise_than_rounded_is_said_to(barely):
    note = "required and provided are rounded apart: both would print alike, and less is provided."
    table = clearance_table(barely, brief=True)
    assert table.notes == (f"No. 1: {note}",)
    required, provided = (float(table.rows[0].cells[k].strip("†")) for k in (4, 6))
    assert required > provided
    (slack,) = (text for text in conditions(barely) if "Electrical slack" in text)
    assert re.search(r"required: ≥ [\d.]+ in \(\d+ mm\) \(rounded apart: both would", slack)
    assert f"A1: {note}" in limits(barely)["tables"][-1].notes


def test_nothing_is_said_of_rounding_where_none_changes_a_number():
    made = package(
        arrays=[stand_in.array("A1", 0.5)],
        objects=[NEAR],
        clearances=[stand_in.clearance("A1", "RTU-9", 0.5)],
    )
    assert clearance_table(made, brief=True).notes == ()
    assert not any("rounded" in text for text in conditions(made))
    assert not any("rounded" in note for t in limits(made)["tables"] for note in t.notes)
