"""A plan that has moved as a whole keeps what was typed where it was, or names what is lost."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fixtures.commands import output_of, stdout_of
from fixtures.dxf import Sketch
from fixtures.project_parts import FT
from fixtures.workbooks import blank, type_into
from report.drawing_read.plan_read import plan_of
from report.drawing_read.roof_drawing import DrawnOutline, RoofDrawing
from report.drawing_read.row_matching import matched
from report.project.model.choices import UnitsFirst
from report.project.model.shapes import SIDES, Polygon
from report.project.read.read import read
from solver.errors import InputError

ROOFS = (
    ((0, 0), (60, 0), (60, 45), (0, 45)),
    ((0, 0), (50, 0), (50, 50), (0, 50)),
    ((0, 0), (60, 0), (60, 20), (30, 20), (30, 45), (0, 45)),
    ((0, 0), (70, 0), (50, 40), (0, 40)),
    ((0, 0), (60, 0), (60, 45), (20, 45), (20, 40), (0, 40)),
)


def at(point, move):
    """Where a point is after a move: turn [deg], factor, shift, and whether it is mirrored."""
    turn_deg, factor, (x, y), is_mirrored = move
    turn = factor * complex(math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg)))
    z = turn * complex(point[0], -point[1] if is_mirrored else point[1]) + complex(x, y)
    return z.real, z.imag


def box(x, y, wide, tall):
    return ((x, y), (x + wide, y), (x + wide, y + tall), (x, y + tall))


def drawn(roof, places, move=(0.0, 1.0, (0.0, 0.0), False)):
    """The plan of a roof and its places [m]: layer, name or none, and corners, by a move."""
    every = [("ROOF-OUTLINE", "", roof), *places]
    lines = [
        DrawnOutline(handle=f"{k:X}", layer=layer, name=name,
                     shape=Polygon(tuple(at(point, move) for point in points)))
        for k, (layer, name, points) in enumerate(every, start=1)
    ]  # fmt: skip
    return plan_of(RoofDrawing("m", lines=lines), 1.0, {})


def draft_of(plan):
    """The rows of a workbook that a plan has filled."""
    inputs = {"project": [], "roof": [{}], "outlines": []}
    for key, places in (("arrays", plan.arrays), ("objects", plan.objects)):
        inputs[key] = [
            {"id": place.name, "place_from": "drawing"}
            | ({"kind": place.kind} if key == "objects" else {})
            for place in places
        ]
    for place in (*plan.roof, *plan.arrays, *plan.objects):
        inputs["outlines"] += [
            {"name": place.name, "x_m": x, "y_m": y} for x, y in place.shape.points
        ]
    return inputs


def middle(shape):
    box = shape.bounds
    return (box.x_from_m + box.x_to_m) / 2, (box.y_from_m + box.y_to_m) / 2


def edges(plan):
    return {p.name: middle(p.shape) for p in plan.objects if p.kind.value.startswith("edge")}


def after(first, second, move, unmoved=None):
    """What is told of a plan, and which edges are not those of their name; the lost are named."""
    told = matched(second, draft_of(first))
    now, was = edges(told), edges(unmoved or first)
    shared = now.keys() & edges(first).keys()
    astray = [
        name for name in shared if math.dist(now[name], at(was[name], move)) > 0.2 + 0.3 * move[1]
    ]
    assert edges(first).keys() <= now.keys() | {*told.gone}
    return told, astray


A1, A2, A3 = box(4, 5, 20, 12), box(27, 3, 15, 10), box(6, 22, 9, 16)
UNIT = box(24, 15, 3, 2)
NAMED = [("ARRAY", "A1", A1), ("ARRAY", "A2", A2), ("ARRAY", "A3", A3), ("OBJECT", "RTU-1", UNIT)]
UNNAMED = [(layer, "", points) for layer, _, points in NAMED]
SHIFT, QUARTER, TURN = (
    (0.0, 1.0, (45.0, -8.0), False),
    (90.0, 1.0, (0, 0), False),
    (17, 1, (9, 3), False),
)


@pytest.mark.quick
@pytest.mark.parametrize("places", [NAMED, UNNAMED])
@pytest.mark.parametrize("roof", ROOFS)
@pytest.mark.parametrize(
    "move",
    [SHIFT, (0.0, 1.0, (60.0, 0.0), False), QUARTER, (180.0, 1.0, (60, 45), False), TURN,
     (0.0, 3.28084, (0, 0), False), (0.0, 12.0, (5, 5), False), (90.0, 1 / 12, (5, 5), False)],
)  # fmt: skip
def test_an_edge_and_a_row_without_a_name_stay_where_they_were(roof, places, move):
    first, second = drawn(roof, places), drawn(roof, places, move)
    told, astray = after(first, second, move)
    assert not astray
    assert not told.gone
    assert told.move.factor == pytest.approx(move[1], abs=1e-5)
    assert told.move.way_deg(0.0) == pytest.approx(move[0], abs=1e-5)
    names = [place.name for place in (*first.arrays, *first.objects)]
    assert {place.name for place in (*told.arrays, *told.objects)} == {*names}
    for name, shape in first.shapes.items():
        assert math.dist(middle(told.shapes[name]), at(middle(shape), move)) < 9


@pytest.mark.quick
def test_a_sheet_that_is_mirrored_is_told_by_a_roof_without_symmetry_and_else_its_edges_are_lost():
    move = (0.0, 1.0, (0.0, 45.0), True)
    for roof, is_told in ((ROOFS[3], True), (ROOFS[0], False)):
        told, astray = after(drawn(roof, NAMED), drawn(roof, NAMED, move), move)
        assert not astray
        assert (told.move is not None and told.move.is_mirrored) is is_told
        assert bool(told.gone) is not is_told
    assert any("how the plan has moved cannot be told" in line for line in told.lines(replace=True))


_MOVES = st.tuples(
    st.sampled_from([0.0, 0.0, 90.0, 180.0, 270.0, 17.0, 233.3]), st.just(1.0),
    st.tuples(st.integers(-80, 80), st.integers(-80, 80)), st.sampled_from([False, False, True]),
)  # fmt: skip


@pytest.mark.nightly
@settings(max_examples=400)
@given(data=st.data(), roof=st.sampled_from(ROOFS), move=_MOVES, is_named=st.lists(
    st.booleans(), min_size=4, max_size=4))  # fmt: skip
def test_no_edge_takes_what_was_typed_of_another(data, roof, move, is_named):
    names = ["A1", "A2", "A3", "RTU-1"]
    places = [
        (layer, name if given_name else "", points)
        for (layer, _, points), name, given_name in zip(NAMED, names, is_named, strict=True)
    ]
    first = drawn(roof, places)
    revised = list(places)
    change = data.draw(st.sampled_from(["none", "added", "removed", "resized", "roof"]))
    if change == "added":
        revised.append(("ARRAY", "A9", box(44, 4, 5, 8)))
    elif change == "removed":
        del revised[data.draw(st.integers(0, 3))]
    elif change == "resized":
        revised[0] = ("ARRAY", places[0][1], box(4, 5, 22, 12))
    larger = [(x * 1.2 if x > 40 else x, y) for x, y in roof] if change == "roof" else roof
    unmoved = drawn(larger, revised)
    try:
        _, astray = after(first, drawn(larger, revised, move), move, unmoved)
    except InputError:
        return  # what has no name and cannot be told stops the command
    assert not astray


_ROOF = st.tuples(
    st.sampled_from([-20, 0, 10]), st.sampled_from([-15, 0, 8]),
    st.sampled_from([40, 60, 80]), st.sampled_from([30, 45, 90]),
)  # fmt: skip


def faces(plan):
    """To which side of a rectangular roof each edge lies: in x, and in y."""
    roof = plan.roof_shape
    return {
        name: ((x > roof.x_to_m) - (x < roof.x_from_m), (y > roof.y_to_m) - (y < roof.y_from_m))
        for name, (x, y) in edges(plan).items()
    }


@pytest.mark.quick
@settings(max_examples=60)
@given(first=_ROOF, second=_ROOF)
def test_an_edge_keeps_its_side_where_the_roof_is_another_one_around_the_same_arrays(first, second):
    was, now = (drawn(box(*roof), NAMED) for roof in (first, second))
    told = matched(now, draft_of(was))
    before, after = faces(was), faces(told)
    kept = before.keys() & after.keys()
    assert {name: after[name] for name in kept} == {name: before[name] for name in kept}


FEET = [
    ("ARRAY", "A1", box(20, 20, 80, 40)),
    ("ARRAY", "A2", box(120, 20, 80, 40)),
    ("OBJECT", "RTU-1", box(110, 80, 10, 8)),
    ("OBJECT", "RTU-2", box(30, 90, 8, 8)),
]
ROOF_FT = box(0, 0, 240, 160)


def saved(tmp_path, places, move=(0.0, 1.0, (0.0, 0.0), False), unit="ft"):
    """A drawing of a roof and places [ft], by a move."""
    sketch = Sketch(unit=unit)
    for layer, name, points in [("ROOF-OUTLINE", "", ROOF_FT), *places]:
        sketch.ring(layer, [at(point, move) for point in points], name)
    return sketch.saved(tmp_path)


def first_day(tmp_path):
    """A workbook with the plan, and what was typed: a parapet, weights, distances, a typed unit."""
    folder = tmp_path / "project"
    folder.mkdir()
    path = blank(folder / "input.xlsx", UnitsFirst.US)
    stdout_of("plan", "read", saved(tmp_path, FEET), path)
    return type_into(path, {
        "Objects/EDGE-2/Type": "edge with parapet", "Objects/EDGE-2/Height": 36,
        "Objects/RTU-2/Location source": None,
        "Arrays/A1/Downslope direction": 270, "Arrays/A1/Weight": 42000,
        "Arrays/A2/Weight": 41000,
        "Clearances/1/Array": "A1", "Clearances/1/Object": "A2",
        "Clearances/1/Provided clearance": 240, "Clearances/1/Clearance source": "measured",
    })  # fmt: skip


def second_day(tmp_path, path, places, move, *words, exit_code=0, **options):
    drawing = saved(tmp_path, places, move, **options)
    return output_of("plan", "read", drawing, path, "--replace", *words, exit_code=exit_code)


def in_feet(path, key):
    return {row["id"]: tuple(round(row[side] / FT, 3) for side in SIDES)
            for row in read(path).inputs[key] if row["x_from_m"] is not None}  # fmt: skip


def test_what_was_typed_turns_with_the_sheet_and_what_is_lost_is_named(tmp_path):
    path = first_day(tmp_path)
    resized = ("ARRAY", "A1", box(20, 20, 80, 50))
    move = (90.0, 1.0, (150.0, 0.0), False)
    # A2 is not drawn any more, RTU-2 was typed.
    output = second_day(tmp_path, path, [resized, FEET[2]], move)
    assert (
        "the plan as a whole is rotated counterclockwise by 90°, moved by x 150.00, y"
        " 0.00" in output
    )
    assert "A1: downslope direction 270° is 0° now" in output
    assert (
        "A1 has another size; stays as typed: weight 42000 lb, downslope direction 270 deg"
        in output
    )
    (line,) = (text for text in output.splitlines() if text.startswith("deleted with A2: "))
    assert "weight 41000 lb" in line
    assert "array A1, object A2, provided clearance 240 in, clearance source measured" in line
    inputs = read(path).inputs
    assert inputs["arrays"][0]["downslope_deg"] == 0.0
    edge = next(row for row in inputs["objects"] if row["id"] == "EDGE-2")
    assert (edge["kind"].value, edge["height_m"]) == (
        "edge with parapet",
        pytest.approx(36 * FT / 12),
    )
    places = in_feet(path, "objects")
    assert places["EDGE-2"] == (-10, 150, 240, 241)
    assert places["RTU-2"] == (52, 60, 30, 38)


def test_a_plan_of_another_size_is_asked_about_and_the_unit_answers(tmp_path):
    path = first_day(tmp_path)
    before = path.read_bytes()
    meters = (0.0, 1 / FT, (0.0, 0.0), False)
    output = second_day(tmp_path, path, FEET, meters, exit_code=2, unit="m")
    assert (
        "3.281 times as large as in the workbook; enter the unit of the drawing (--units" in output
    )
    assert "ft, or m if it is so, as it states" in output
    assert path.read_bytes() == before
    output = second_day(tmp_path, path, FEET, meters, "--units", "ft", unit="m")
    assert "times as large" not in output
    assert in_feet(path, "objects")["EDGE-2"] == (240, 241, 0, 160)


@pytest.mark.nightly
def test_a_kind_and_a_height_that_the_drawing_changes_are_named(tmp_path):
    path = first_day(tmp_path)
    edge = ("ROOF-EDGE", "EDGE-2, HT 30 in", box(240, 0, 1, 160))
    output = second_day(tmp_path, path, [*FEET, edge], SHIFT)
    assert "EDGE-2: type edge with parapet is edge without parapet now, as drawn" in output
    assert "EDGE-2: height 36 in is 30.0 now, as drawn" in output
