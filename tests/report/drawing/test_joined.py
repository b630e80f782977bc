"""Open lines that meet are joined to outlines, in one way or not at all."""

import random

import pytest

from report.drawing.closed_lines import BRANCHED, OPEN, join
from report.drawing.read_dxf import read_dxf
from report.sheet.schema.shapes import Polygon, ring
from sketch import Sketch

pytestmark = pytest.mark.quick

BOX = ((0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0))
SIDES = [(BOX[k], BOX[(k + 1) % 4]) for k in range(4)]


def found(*lines):
    rings, rest = join(lines, 0.005)
    areas = [round(Polygon(ring(points)).area_m2, 2) for points, _ in rings]
    return areas, rest


@pytest.mark.parametrize("seed", range(5))
def test_sides_in_any_order_and_direction_are_joined(seed):
    dice = random.Random(seed)
    lines = [side if dice.random() < 0.5 else side[::-1] for side in SIDES]
    dice.shuffle(lines)
    ((points, parts),), rest = join(lines, 0.005)
    assert (parts[0], rest) == (0, {})
    assert sorted(points) == sorted(BOX)
    assert Polygon(ring(points)).area_m2 == pytest.approx(40.0)


@pytest.mark.parametrize(
    ("lines", "areas", "rest"),
    [
        (SIDES[:3], [], {0: OPEN, 1: OPEN, 2: OPEN}),
        ([BOX, SIDES[3]], [40.0], {}),  # a polyline and a line
        ([(*BOX, (0.003, 0.0))], [40.0], {}),  # a polyline that closes by itself, nearly
        ([*SIDES[:3], ((0.0, 5.0), (0.0, 0.0049))], [40.0], {}),
        ([*SIDES[:3], ((0.0, 5.0), (0.0, 0.0051))], [], {0: OPEN, 1: OPEN, 2: OPEN, 3: OPEN}),
        ([*SIDES, SIDES[0], SIDES[1][::-1]], [40.0], {}),  # sides that are drawn twice
        ([*SIDES, ((8.0, 0.0), (4.0, 2.0)), ((4.0, 2.0), (4.0, 3.0))], [],
         {0: BRANCHED, 1: BRANCHED, 2: OPEN, 3: OPEN, 4: BRANCHED, 5: OPEN}),
        ([*SIDES, (BOX[0], BOX[2])], [], dict.fromkeys(range(5), BRANCHED)),
        ([*SIDES, (BOX[0], BOX[0])], [40.0], {4: OPEN}),  # a line without a length
    ],
)  # fmt: skip
def test_what_closes_in_one_way_is_joined_and_the_rest_is_returned(lines, areas, rest):
    assert found(*lines) == (areas, rest)


def test_lines_of_one_layer_are_joined_without_end(tmp_path):
    sketch = Sketch()
    for k, side in enumerate(SIDES):
        sketch.space.add_line(*side, dxfattribs={"layer": "AB"[k % 2]})
    read = read_dxf(sketch.saved(tmp_path))
    assert (read.lines, [item.reason for item in read.unread]) == ([], [OPEN] * 4)
    # Of three ends at a corner the second is near both others, which are not near each other: from
    # one of them a walk would turn around the box forever.
    lines = [((-5.0, -5.0), (-0.004, 0.0)), *SIDES[:3], (BOX[3], (0.004, 0.0))]
    assert found(*lines) == ([], dict.fromkeys(range(5), OPEN))


def test_lines_of_a_block_are_joined_with_its_name_at_each_place(tmp_path):
    sketch = Sketch()
    block = sketch.document.blocks.new("UNIT")
    for start, end in SIDES:
        block.add_line(start, end)
    for name, x in (("RTU-1", 0), ("RTU-2", 8)):  # with a common side
        put = sketch.space.add_blockref("UNIT", (x, 0), dxfattribs={"layer": "OBJECT"})
        put.add_attrib("NAME", name)
    found = read_dxf(sketch.saved(tmp_path))
    assert [line.name for line in found.lines] == ["RTU-1", "RTU-2"]
    assert found.unread == []
