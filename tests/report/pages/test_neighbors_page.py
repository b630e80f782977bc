"""The schedule of neighbors: what is beside each array in plan, and which clearance covers it."""

import pytest

import inputs
import scenes
import stand_in
from printed import printed
from report.assessment.neighbors import Cover
from report.assessment.verdict import Verdict

pytestmark = pytest.mark.quick

FOOT = stand_in.FOOT
NEAR = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42)
FAR = stand_in.roof_object("RTU-8", "fixed object", 190, 200, 35, 42)
NOWHERE = {"id": "OLD", "kind": "fixed object"}
ARRAYS = [stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)]
CAPTION = "Neighbors in plan"
PARTS = ["Array", "Neighbor", "Kind", "In plan [in]", "Twice displ. [in]", "Clearance", "Remark"]


def page(**changes):
    package = scenes.package(**{"arrays": ARRAYS, "objects": [], "clearances": []} | changes)
    return printed(package, "plan")


def test_distances_are_printed_with_their_rows_and_rounded_up():
    rows = [
        stand_in.clearance("A1", "RTU-9", 2 * FOOT), stand_in.clearance("A2", "A1", 120 * FOOT),
    ]  # fmt: skip
    made = page(objects=[NEAR, FAR], clearances=rows)
    table = made.table(CAPTION)
    assert [[row[part] for part in PARTS] for row in table.rows] == [
        ["A1", "RTU-9", "fixed object", "12.0", "81.6", "No. 1", "provided differs from plan"]
    ]
    assert made.line("Clearances provided as in the plan: No. 2.").endswith(
        " The other three pairs of the plan are farther apart than twice the design displacement, "
        "and no less than is required; the nearest are A2 and RTU-8, 240.0 in (6096 mm)."
    )
    arrays, options = [stand_in.array("A1", 0.5, mu=0.3)], {"peer_reviewed": True}
    made = scenes.package(arrays=arrays, objects=[NEAR], clearances=[], options=options)
    (near,) = made.assessment.neighbors
    assert near.reach_m / 0.0254 % 0.1 < 0.05  # rounded it would print less
    row = printed(made, "plan").table(CAPTION).row("RTU-9")
    assert float(row["Twice displ. [in]"]) > near.reach_m / 0.0254
    table = page(objects=[NEAR]).table(CAPTION)
    assert [[row[part] for part in PARTS] for row in table.rows] == [
        ["A1", "RTU-9", "fixed object", "12.0", "81.6", "—", "not given; NG"]
    ]


@pytest.mark.parametrize("other", [("A2", 120 * FOOT), ("RTU-9", FOOT)])
def test_clearances_that_are_as_in_the_plan_are_named_and_not_listed(other):
    made = page(objects=[NEAR], clearances=[stand_in.clearance("A1", *other)])
    assert made.line("Clearances provided as in the plan: all.")
    assert (CAPTION in made) is (other[0] == "A2")  # the near unit has no clearance


def test_what_is_not_in_plan_or_near_is_named():
    lost = NOWHERE | {"id": "LOST"}
    made = page(objects=[NOWHERE, lost], clearances=[stand_in.clearance("A1", "OLD", 9.0)])
    line = made.line("To the scale stated")
    assert "Neither drawn nor measured, because a place in plan is not given: clearance 1." in line
    assert made.line("Neither a place").endswith("LOST.")
    assert CAPTION not in made
    assert page().line("The other pair of the plan is farther apart") == (
        "The other pair of the plan is farther apart than twice the design displacement, and no "
        "less than is required: A1 and A2, 1440.0 in (36576 mm)."
    )
    assert "of the plan" not in page(arrays=ARRAYS[:1])


@pytest.mark.parametrize("is_given", [True, False])
def test_edges_are_those_of_the_outline_where_it_is_given(is_given):
    roof = stand_in.inputs.sides(0, 380, 0, 170) if is_given else {}
    assert ("The outline of the roof is not given" in page(roof=roof)) is not is_given


def test_distances_that_are_not_known_or_not_of_the_plan_are_told():
    made = printed(scenes.unpermitted(), "plan")
    (line,) = (line for line in made.splitlines() if "The other seven pairs of the plan" in line)
    assert "farther apart than twice the design displacement; the nearest are A1 and" in line
    rows = [stand_in.clearance("A1", "RTU-9", 2 * FOOT) | {"source": "drawing"}]
    (near,) = (near for near in drawn(clearances=rows).assessment.neighbors)
    assert near.cover is Cover.DIFFERS


def drawn(**changes):
    """A package with a distance from the drawing, and one that is measured."""
    rows = [
        stand_in.clearance("A1", "RTU-9", FOOT) | {"source": "drawing"},
        stand_in.clearance("A2", "A1", 120 * FOOT) | {"source": "measured"},
    ]
    given = {"arrays": ARRAYS, "objects": [NEAR], "clearances": rows}
    return scenes.package(**given | changes)


def test_drawing_distances_are_conditions_until_confirmed():
    package = drawn()
    (row,) = (row for row in package.assessment.rows if row.id == "drawing_distances")
    assert (row.subject, row.found, row.is_satisfied) == ("A1", "not confirmed", False)
    assert row.verdict is Verdict.CONDITION
    made = printed(package, "plan")
    words = " Distances provided: drawing, not confirmed No. 1; measured No. 2."
    assert made.line("Factor").endswith(words)
    line = printed(package, "notes").line("Gaps to be measured first")
    assert line.endswith("because their distance is from the drawing and not confirmed: No. 1.")
    confirmed = {"drawing_confirmed_by": "MT", "drawing_confirmed_date": inputs.HEAD["date"]}
    package = drawn(project=inputs.HEAD | confirmed)
    (row,) = (row for row in package.assessment.rows if row.id == "drawing_distances")
    assert row.is_satisfied
    assert row.found == "confirmed by MT, 2026-03-05"
    made = printed(package, "plan")
    words = " Distances provided: drawing, confirmed No. 1; measured No. 2."
    assert made.line("Factor").endswith(words)
    assert "Gaps to be measured first" not in printed(package, "notes")
