"""What is NG is marked on the plan, wherever it is drawn: also where no clearance is given."""

import math
import re

import pytest

import scenes
import stand_in
from plans import roof_plan
from report.assessment.plan_clearances import parapet_note, plan_gaps
from report.drawing.items import Layer
from report.drawing.plan import plan_drawing
from report.drawing.sheet import LETTER
from report.entities.shown import UnitFormat
from report.web.plan import plan, stamp

pytestmark = pytest.mark.quick

PARAPET = stand_in.roof_object("N", "edge with parapet", 0, 400, 200, 202, height=0.3)
HIGH = stand_in.roof_object("S", "edge with parapet", 0, 400, -202, -200, height=1.2)
NEAR = stand_in.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


@pytest.fixture(scope="module")
def done():
    """A unit a foot from an array without a row of its own, and a parapet of 11.8 in."""
    return scenes.package(
        arrays=[stand_in.array("A1", 0.5), stand_in.array("A2", 0.5, x=220)],
        objects=[NEAR, PARAPET, HIGH],
        clearances=[
            stand_in.clearance("A2", "A1", 40.0),
            stand_in.clearance("A1", "N", 60.0),
            stand_in.clearance("A1", "S", 60.0),
        ],
    ).assessment


def test_a_short_gap_without_a_row_is_ng_in_the_drawing_the_picture_and_on_the_page(done):
    gaps = list(plan_gaps(done))
    assert [(gap.number, gap.array, gap.other) for gap in gaps] == [
        (1, "A2", "A1"), (2, "A1", "N"), (3, "A1", "S"), (0, "A1", "RTU-9"),
    ]  # fmt: skip
    assert [gap.is_ng for gap in gaps] == [False, False, False, True]
    missing = gaps[-1]
    assert missing.provided_m == pytest.approx(0.3048)  # from x = 100 to 101 ft
    assert missing.required_m == done.arrays[0].design_m
    gap = "no clearance given: 12.0 in (305 mm) in plan, required 40.8 in (1036 mm), NG"
    words = f"A1 to RTU-9: {gap}"
    assert [t.layer for t in plan_drawing(done).texts if t.words == words] == [Layer.CLEARANCE_NG]
    shown = re.findall(r"<text[^>]*>([^<]*)</text>", roof_plan(done, LETTER))
    label = {"NG", "not given; in plan 12.0 in", "required 40.8 in"}
    assert label <= set(shown)
    designs = {item.id: {"text": ""} for item in done.arrays}
    items = plan(done, designs, ((), ()), UnitFormat(us_first=True), stamp)["items"]
    said = [item.get("text") for item in items]
    assert label <= set(said)


def lowered(**changes):
    overrides = [{"provision": key, "value": 0.75, "reason": "Agreed"}
                 for key in ("separation_fixed", "separation_edge")]  # fmt: skip
    options = {"clearances": [], "overrides": overrides}
    return scenes.package(**options | changes).assessment


@pytest.mark.parametrize(
    "near",
    [
        {"arrays": [stand_in.array("A1", 0.5)], "objects": [NEAR]},
        {
            "arrays": [stand_in.array("A1", 0.5, x=1)],
            "objects": [],
            "roof": {"x_from_m": 0.0, "x_to_m": 120.0, "y_from_m": -60.0, "y_to_m": 120.0},
        },
    ],
    ids=["object", "bare edge"],
)
def test_a_required_separation_that_an_override_lowers_is_marked_without_a_row_too(near):
    done = lowered(**near)
    (gap,) = plan_gaps(done)
    assert (gap.number, gap.mark) == (0, "‡")
    (row,) = (row for row in done.rows if row.id == "neighbors")
    assert re.search(r"^≥ [\d.]+ in \([\d.]+ mm\)‡", row.limit)
    assert done.is_overridden
    designs = {item.id: {"text": ""} for item in done.arrays}
    items = plan(done, designs, ((), ()), UnitFormat(us_first=True), stamp)["items"]
    said = " ".join(item.get("text", "") for item in items)
    assert re.search(r"required [\d.]+ in‡", said)
    assert re.search(r"required [\d.]+ in‡", roof_plan(done, LETTER))
    words = [t.words for t in plan_drawing(done).texts if t.layer is Layer.CLEARANCE_NG]
    assert any("mm) (overridden), NG" in text for text in words)
    assert not any(gap.mark for gap in plan_gaps(lowered(**near, overrides=[])))


def test_a_parapet_says_where_it_does_not_qualify(done):
    notes = {item.id: parapet_note(done, item) for item in done.project.objects}
    assert notes == {"RTU-9": "", "N": ", does not qualify", "S": ""}
    texts = [text.words for text in plan_drawing(done).texts]
    assert "N, height 11.8 in, does not qualify" in texts


def test_of_two_bare_parts_of_a_side_the_one_that_is_near_is_marked():
    """A parapet along the middle of the west side leaves a part on each side of it bare."""
    done = scenes.package(
        roof={"x_from_m": 0.0, "x_to_m": 120.0, "y_from_m": 0.0, "y_to_m": 60.0},
        arrays=[stand_in.array("A1", 0.5, x=1)],
        objects=[stand_in.roof_object("W", "edge with parapet", 0, 0.5, 90, 120, height=1.2)],
        clearances=[],
    ).assessment
    bare = [gap for gap in plan_gaps(done) if gap.other == "the west edge of the roof"]
    assert len(bare) == 1
    for gap in bare:
        (x0, y0), (x1, y1) = gap.ends
        assert math.hypot(x1 - x0, y1 - y0) == pytest.approx(gap.provided_m, rel=1e-9)
