"""What the plan shows near each array, what the workbook says of it, and where NG is marked."""

import math
import re
from dataclasses import replace
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fixtures import assessments, projects
from fixtures.plan_pictures import roof_plan
from fixtures.project_parts import FT, INCH, NO_SIDES, sides
from fixtures.spaces import spaced
from fixtures.workbooks import cell_address, make, project
from report.assessment.assess import assess
from report.assessment.checks.sentence import texts
from report.assessment.plan.bare_edges import bare_edges
from report.assessment.plan.neighbors import Cover, NearbyKind
from report.assessment.support.plan_gaps import plan_gaps
from report.drawing.layers import Layer
from report.drawing.plan_layers import plan_drawing
from report.drawing.sheet import LETTER
from report.motions.prepare import prepare
from report.project.model import ProjectInput
from report.project.model.shapes import Rectangle, gap_m
from report.project.read.read import read
from report.web.plan import plan

OUTLINE = sides(0, 220, 0, 170)


@pytest.fixture(scope="module")
def done():
    return assessments.package(assessments.motions(3, 12.0)).assessment


def having(done, design_m=None, **changes):
    """The assessment with another input and, for each array, another design displacement."""
    data = ProjectInput.model_validate(done.project.model_dump() | changes)
    arrays = [
        replace(assessed, array=array, design_m=assessed.design_m if design_m is None else design_m)
        for assessed, array in zip(done.arrays, data.arrays, strict=False)
    ]
    return replace(done, project=data, arrays=tuple(arrays))


def by_pair(done):
    return {(neighbor.array, neighbor.other): neighbor for neighbor in done.neighbors}


@pytest.mark.quick
def test_every_pair_with_a_clearance_from_either_side_is_listed(done):
    pairs = by_pair(having(done, design_m=0.01))
    assert list(pairs) == [
        ("A1", "A3"), ("A1", "RTU-1"), ("A2", "S edge"), ("A3", "T-1"), ("A3", "N edge"),
    ]  # fmt: skip
    assert not any(neighbor.is_missing for neighbor in pairs.values())
    assert pairs["A1", "A3"].given[0].clearance == done.project.clearances[0]
    rows = [projects.clearance("A3", "A1", 15 * FT)]
    pairs = by_pair(having(done, design_m=10 * FT, clearances=rows))
    assert pairs["A1", "A3"].given
    assert not pairs["A1", "A3"].is_missing


@pytest.mark.parametrize(("design_ft", "is_near"), [(10.01, True), (9.99, False)])
@pytest.mark.quick
def test_a_neighbor_within_twice_the_design_displacement_is_missing(done, design_ft, is_near):
    pairs = by_pair(having(done, design_m=design_ft * FT))
    assert (("A1", "A2") in pairs) is is_near  # 20 ft apart
    if is_near:
        assert pairs["A1", "A2"].is_missing


def test_the_larger_displacement_or_the_prescriptive_one_decides(done):
    quiet = having(done, design_m=0.01)
    moving = replace(quiet.arrays[1], design_m=11 * FT)
    pairs = by_pair(replace(quiet, arrays=(quiet.arrays[0], moving, quiet.arrays[2])))
    assert pairs["A1", "A2"].reach_m == pytest.approx(22 * FT)
    pairs = by_pair(having(done, design_m=math.nan))
    expected = 2.0 * done.arrays[0].prescriptive.value_m
    assert pairs["A1", "A3"].reach_m == expected


@pytest.mark.parametrize(
    ("provided", "is_named"), [(84.0, False), (83.01, False), (82.9, True), (85.1, True)]
)
def test_a_gap_of_the_plan_that_contradicts_the_clearance_by_an_inch_is_named(
    done, provided, is_named
):
    rows = [projects.clearance("A1", "RTU-1", provided * INCH)]  # 7 ft apart on the plan
    neighbor = by_pair(having(done, clearances=rows))["A1", "RTU-1"]
    assert bool(neighbor.contradictions) is is_named
    assert len(neighbor.shortcomings()) == is_named
    for _, words in neighbor.shortcomings():
        assert words == "correct the clearance or the rectangles"


@pytest.mark.parametrize(
    ("design_ft", "provided", "cover"),
    [(4.0, 84.0, Cover.AS_IN_PLAN), (0.1, 90.0, Cover.DIFFERS), (0.1, 84.0, Cover.BEYOND)],
)
def test_a_clearance_covers_a_neighbor_as_the_plan_has_it(done, design_ft, provided, cover):
    rows = [projects.clearance("A1", "RTU-1", provided * INCH)]  # 7 ft apart on the plan
    neighbor = by_pair(having(done, design_m=design_ft * FT, clearances=rows))["A1", "RTU-1"]
    assert (neighbor.cover, [row.number for row in neighbor.given]) == (cover, [1])
    alone = by_pair(having(done, design_m=4 * FT, clearances=[]))["A1", "RTU-1"]
    assert replace(alone, required_m=6.99 * FT).cover is Cover.SUFFICIENT
    assert replace(alone, required_m=7.01 * FT).cover is Cover.SHORT


def test_cells_are_those_of_the_workbook_or_the_sheet_to_add_to(done, tmp_path):
    neighbor = by_pair(having(done, design_m=10.5 * FT))["A1", "A2"]
    assert neighbor.shortcomings() == (
        ("Clearances", "add a row with their clearance, or run roofslip plan clearances"),
    )
    sheet = read(make(tmp_path, clearances=[project().clearances[2].model_dump()]))
    listed = assess(sheet, prepare(sheet)).neighbors
    row = next(neighbor for neighbor in listed if neighbor.given)
    assert row.given[0].cell == cell_address("Clearances/1/Provided clearance")
    to_add = {near.to_add for near in listed if near.kind is not NearbyKind.BARE_EDGE}
    assert to_add == {cell_address("Clearances/heading/Array")}


def test_an_edge_of_the_roof_that_no_object_covers_is_a_neighbor(done):
    edge = having(done, design_m=10.5 * FT, roof=OUTLINE)
    edges = [neighbor for neighbor in edge.neighbors if neighbor.kind is NearbyKind.BARE_EDGE]
    others = {neighbor.array: neighbor.other for neighbor in edges}
    west, east = "the west edge of the roof", "the east edge of the roof"
    assert others == {"A1": west, "A2": east, "A3": west}
    assert len(edges) == 3
    for neighbor in edges:
        assert (neighbor.is_missing, neighbor.gap_m) == (True, pytest.approx(20 * FT))
    added = "add the edge as an object, and a clearance to it"
    assert edges[0].shortcomings() == (("Objects", added),)


@pytest.mark.parametrize(
    ("north_deg", "names"),
    [(90.0, "east west"), (0.0, "north south"), (180.0, "south north"),
     (45.0, "northeast southwest")],
)  # fmt: skip
def test_edges_are_named_by_the_compass(north_deg, names):
    edges = bare_edges(projects.project(roof=OUTLINE | {"north_deg": north_deg}))
    assert [edge.name for edge in edges] == [f"{name} edge of the roof" for name in names.split()]


def test_the_edges_of_an_l_shaped_roof_are_its_sides_and_none_without_an_outline():
    assert bare_edges(projects.project()) == ()
    data = projects.project(outlines=vertices("roof", L_ROOF))
    edges = bare_edges(data)
    assert [edge.name for edge in edges] == [
        "east edge of the roof (side 2)",
        "north edge of the roof (side 3)",
        "east edge of the roof (side 4)",
        "west edge of the roof (side 6)",
    ]  # the objects N edge and S edge cover the others
    start, end = edges[2].ends
    assert start == pytest.approx((120 * FT, 100 * FT))
    assert end == pytest.approx((120 * FT, 170 * FT))


length = st.floats(0.0, 60.0)


@given(st.lists(st.tuples(length, length), max_size=6))
def test_bare_parts_and_strips_make_up_the_side(spans):
    strips = [
        {"id": f"E{k}", "kind": "edge without parapet", "x_from_m": min(a, b) - 5.0,
         "x_to_m": max(a, b) - 4.0, "y_from_m": -0.1, "y_to_m": 0.0}
        for k, (a, b) in enumerate(spans)
    ]  # fmt: skip
    roof = {"x_from_m": 0.0, "x_to_m": 50.0, "y_from_m": 0.0, "y_to_m": 40.0}
    data = projects.project(arrays=[projects.array("A1", 1.0)], objects=strips, clearances=[],
                            roof=roof)  # fmt: skip
    south = [edge.line for edge in bare_edges(data) if edge.name.startswith("south")]
    for x_m in (0.25 + 0.5 * k for k in range(100)):
        covered = any(row["x_from_m"] <= x_m <= row["x_to_m"] for row in strips)
        bare = any(line.x_from_m <= x_m <= line.x_to_m for line in south)
        assert covered or bare or _is_short(x_m, strips)
        assert not (bare and any(row["x_from_m"] < x_m < row["x_to_m"] for row in strips))


def _is_short(at, strips):
    """Whether no stretch of a foot around a point is free of strips."""
    below = max([row["x_to_m"] for row in strips if row["x_to_m"] <= at] + [0.0])
    above = min([row["x_from_m"] for row in strips if row["x_from_m"] >= at] + [50.0])
    return above - below <= FT


@cache
def one_array():
    alone = {"arrays": [projects.array("A1", 1.0)], "objects": [], "clearances": []}
    return assessments.package(assessments.motions(3, 12.0), **alone).assessment


@given(st.floats(0.0, 30.0), st.floats(0.01, 8.0), st.floats(-10.0, 30.0), st.floats(-10.0, 30.0))
def test_a_pair_is_listed_exactly_if_it_is_within_reach(design, size, x, y):
    done = one_array()
    item = {"id": "RTU-1", "kind": "fixed object", "x_from_m": x, "x_to_m": x + size,
            "y_from_m": y, "y_to_m": y + size}  # fmt: skip
    pairs = by_pair(having(done, design_m=design, objects=[item], clearances=[]))
    gap = gap_m(done.arrays[0].array.shape, Rectangle(x, x + size, y, y + size))
    assert (("A1", "RTU-1") in pairs) is (gap <= 2.0 * design)
    assert all(neighbor.is_missing and not neighbor.contradictions for neighbor in pairs.values())


L_ROOF = [(0, 0), (220, 0), (220, 100), (120, 100), (120, 170), (0, 170)]


def vertices(name, points):
    return [{"name": name, "x_m": x * FT, "y_m": y * FT} for x, y in points]


def test_a_unit_in_the_notch_of_an_outlined_array_is_as_far_as_its_nearer_leg(done):
    # A1 without its upper right quarter, and a unit 5 ft and 7 ft from the legs around it.
    first, *others = (array.model_dump() for array in done.project.arrays)
    notch = [(20, 20), (100, 20), (100, 50), (60, 50), (60, 75), (20, 75)]
    unit = projects.roof_object("RTU-1", "fixed object", 67, 75, 55, 65)
    rows = [projects.clearance("A1", "RTU-1", 10 * FT)]
    near = having(done, arrays=[first | NO_SIDES, *others], outlines=vertices("A1", notch),
                  objects=[unit], clearances=rows)  # fmt: skip
    pair = by_pair(near)["A1", "RTU-1"]
    assert pair.gap_m == pytest.approx(5 * FT)
    ((_, words),) = pair.shortcomings()
    assert words == "correct the clearance or the outlines"


def test_an_oblique_edge_is_covered_by_an_oblique_strip():
    triangle = [(0, 0), (200, 0), (0, 200)]
    strip = [(200, 0), (201, 0.5), (101, 100.5), (100, 100)]  # along half of side 2
    edge = {"id": "E", "kind": "edge without parapet"}
    data = projects.project(
        arrays=[projects.array("A1", 1.0)], objects=[edge], clearances=[],
        outlines=[*vertices("roof", triangle), *vertices("E", strip)],
    )  # fmt: skip
    edges = bare_edges(data)
    assert [edge.name for edge in edges] == [
        "south edge of the roof (side 1)",
        "northeast edge of the roof (side 2)",
        "west edge of the roof (side 3)",
    ]
    start, end = edges[1].ends
    assert end == pytest.approx((0.0, 200 * FT))
    assert math.dist(start, (100 * FT, 100 * FT)) < 1.0 * FT


PARAPET = projects.roof_object("N", "edge with parapet", 0, 400, 200, 202, height=0.3)
HIGH = projects.roof_object("S", "edge with parapet", 0, 400, -202, -200, height=1.2)
NEAR = projects.roof_object("RTU-9", "fixed object", 101, 106, 35, 42, height=1.0)


@pytest.fixture(scope="module")
def unlisted():
    """A unit a foot from an array without a row of its own, and a parapet of 11.8 in."""
    return assessments.package(
        arrays=[projects.array("A1", 0.5), projects.array("A2", 0.5, x=220)],
        objects=[NEAR, PARAPET, HIGH],
        clearances=[
            projects.clearance("A2", "A1", 40.0),
            projects.clearance("A1", "N", 60.0),
            projects.clearance("A1", "S", 60.0),
        ],
    ).assessment


@pytest.mark.quick
def test_a_short_gap_without_a_row_is_ng_in_the_drawing_the_picture_and_on_the_page(unlisted):
    gaps = list(plan_gaps(unlisted))
    assert [(gap.number, gap.array, gap.other) for gap in gaps] == [
        (1, "A2", "A1"), (2, "A1", "N"), (3, "A1", "S"), (0, "A1", "RTU-9"),
    ]  # fmt: skip
    assert [gap.is_ng for gap in gaps] == [False, False, False, True]
    missing = gaps[-1]
    assert missing.provided_m == pytest.approx(0.3048)  # from x = 100 to 101 ft
    assert missing.required_m == unlisted.arrays[0].design_m
    row = [t.words for t in plan_drawing(unlisted).texts if t.layer is Layer.CLEARANCE_NG]
    assert spaced(row) == [
        "not entered",
        "A1 to RTU-9",
        "12.0 in (304 mm)",
        "40.8 in (1036 mm)",
        "NG",
    ]
    shown = re.findall(r"<text[^>]*>([^<]*)</text>", roof_plan(unlisted, LETTER))
    label = {"NG", "not entered; in plan 12.0 in", "required 40.8 in"}
    assert label <= spaced({*shown})
    designs = {item.id: {"text": ""} for item in unlisted.arrays}
    drawn = plan(unlisted, designs, {})["drawn"]
    assert label <= spaced({*re.findall(r"<text[^>]*>([^<]*)</text>", drawn)})


def lowered(**changes):
    overrides = [{"provision": key, "value": 0.75, "reason": "Agreed"}
                 for key in ("separation_fixed", "separation_edge")]  # fmt: skip
    options = {"clearances": [], "overrides": overrides}
    return assessments.package(**options | changes).assessment


@pytest.mark.parametrize(
    "near",
    [{"arrays": [projects.array("A1", 0.5)], "objects": [NEAR]},
     {"arrays": [projects.array("A1", 0.5, x=1)], "objects": [],
      "roof": {"x_from_m": 0.0, "x_to_m": 120.0, "y_from_m": -60.0, "y_to_m": 120.0}}],
    ids=["object", "bare edge"],
)  # fmt: skip
@pytest.mark.quick
def test_a_required_separation_that_an_override_lowers_is_marked_without_a_row_too(near):
    unlisted = lowered(**near)
    (gap,) = plan_gaps(unlisted)
    assert (gap.number, gap.mark) == (0, "‡")
    (row,) = (row for row in unlisted.checks if row.id == "neighbors")
    assert re.search(r"^≥ [\d.]+\sin \([\d.]+\smm\)‡", texts(row, us_first=True)[1])
    assert unlisted.is_overridden
    designs = {item.id: {"text": ""} for item in unlisted.arrays}
    drawn = plan(unlisted, designs, {})["drawn"]
    assert re.search(r"required [\d.]+\sin‡", drawn)
    assert re.search(r"required [\d.]+\sin‡", roof_plan(unlisted, LETTER))
    words = [t.words for t in plan_drawing(unlisted).texts if t.layer is Layer.CLEARANCE_NG]
    assert any("mm) (overridden)" in text for text in words)
    assert "NG" in words
    assert not any(gap.mark for gap in plan_gaps(lowered(**near, overrides=[])))


def test_of_two_bare_parts_of_a_side_the_one_that_is_near_is_marked():
    """A parapet along the middle of the west side leaves a part on each side of it bare."""
    unlisted = assessments.package(
        roof={"x_from_m": 0.0, "x_to_m": 120.0, "y_from_m": 0.0, "y_to_m": 60.0},
        arrays=[projects.array("A1", 0.5, x=1)],
        objects=[projects.roof_object("W", "edge with parapet", 0, 0.5, 90, 120, height=1.2)],
        clearances=[],
    ).assessment
    bare = [gap for gap in plan_gaps(unlisted) if gap.other == "the west edge of the roof"]
    assert len(bare) == 1
    for gap in bare:
        (x0, y0), (x1, y1) = gap.ends
        assert math.hypot(x1 - x0, y1 - y0) == pytest.approx(gap.provided_m, rel=1e-9)
