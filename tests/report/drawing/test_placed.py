"""The texts of plan.dxf: none over another, and a dimension says what the schedule does."""

import io
import itertools
import math
from functools import cache

import ezdxf
import numpy as np
import pytest
from ezdxf.enums import TextEntityAlignment
from ezdxf.fonts.fonts import make_font
from ezdxf.math import BoundingBox2d, Vec2

import scenes
import stand_in
from inputs import sides
from places import ROOT
from printed import printed
from report.assessment.plan_clearances import plan_gaps
from report.drawing.items import write_dxf
from report.drawing.plan import plan_drawing
from sketch import plan

SHIPPED = sorted(
    {path.parent.name for path in (ROOT / "projects").glob("*/make.py")} - {"curves", "study"}
)


@cache
def crowded():
    """Small arrays six inches apart, with long names, and a unit a foot from them."""
    ids = [f"NORTHWEST CORNER OF THE UPPER ROOF {k}" for k in range(12)]
    arrays = [
        stand_in.array(name, 1.0)
        | sides(8.5 * (k % 4), 8.5 * (k % 4) + 8, 8.5 * (k // 4), 8.5 * (k // 4) + 8)
        for k, name in enumerate(ids)
    ]
    unit = stand_in.roof_object(
        "MAKE-UP AIR UNIT OF THE KITCHEN", "fixed object", 34.5, 36, 3, 5, 1.2
    )
    return scenes.package(
        arrays=arrays,
        objects=[unit, stand_in.roof_object("E", "edge with parapet", 40, 40.5, 0, 26, 0.5)],
        clearances=[
            *(stand_in.clearance(near, far, 6.0) for near, far in itertools.pairwise(ids)),
            stand_in.clearance(ids[3], unit["id"], 12.0),
        ],
    ).assessment


@pytest.fixture(scope="module", params=[*SHIPPED, "unpermitted", "crowded"])
def done(request):
    others = {"unpermitted": scenes.unpermitted, "crowded": crowded}
    return others[request.param]() if request.param in others else scenes.shipped(request.param)


@pytest.fixture(scope="module")
def space(done):
    return ezdxf.read(io.StringIO(write_dxf(plan_drawing(done)).decode())).modelspace()


def texts(space):
    """Return every text that a viewer shows, those of dimensions too."""
    return [*space.query("TEXT"), *itertools.chain(*map(texts_of, space.query("DIMENSION")))]


def texts_of(dimension):
    return [part for part in dimension.get_geometry_block() if part.dxftype() == "MTEXT"]


def box(text):
    """Return where a text of one line is, which is centered in height."""
    is_mtext = text.dxftype() == "MTEXT"
    font = make_font(text.doc.styles.get(text.dxf.style).dxf.font,
                     text.dxf.char_height if is_mtext else text.dxf.height)  # fmt: skip
    wide, tall = font.text_width(text.plain_text()), font.measurements.total_height
    at = text.dxf.insert if is_mtext else text.dxf.align_point
    is_left = not is_mtext and text.get_align_enum() is TextEntityAlignment.MIDDLE_LEFT
    corners = [
        (x * wide, y * tall) for x in ((0, 1) if is_left else (-0.5, 0.5)) for y in (-0.5, 0.5)
    ]
    turn = text.dxf.get("rotation", 0.0)
    return BoundingBox2d(at.vec2 + Vec2(corner).rotate_deg(turn) for corner in corners)


def over(shown):
    """Return the pairs of texts of which one is over the other."""
    boxes = [(text.plain_text(), box(text)) for text in shown]
    return [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2)
            if one.has_overlap(other)]  # fmt: skip


def test_no_text_is_over_another_and_one_that_is_is_found(done, space):
    shown = texts(space)
    assert len(shown) > 2 * len(list(plan_gaps(done)))  # a dimension and a line of the list
    assert over(shown) == []
    first, second, *_ = texts(space)
    moved = second.copy()
    moved.dxf.insert = moved.dxf.align_point = first.dxf.align_point
    assert over([first, moved]) == [(first.plain_text(), second.plain_text())]


def test_every_gap_is_a_dimension_whose_text_is_that_of_the_schedule(done, space):
    unit = "in" if done.project.us_first else "mm"
    head = f"Prov’d [{unit}]"
    tables = [table for table in printed(done, "plan").tables if head in table.headings]
    schedule = {row["No."]: row[head] for table in tables for row in table.rows}
    assert len(schedule) == len(done.clearances)
    unit_m = 0.3048 if done.project.us_first else 1.0
    for gap, dimension in zip(plan_gaps(done), space.query("DIMENSION"), strict=True):
        given = f"{gap.number}: {schedule.get(str(gap.number))}"
        start = given if gap.is_given else f"not given: {gap.provided_m / 0.0254:.1f}"
        words = f"{start} {unit}" + " NG" * gap.is_ng
        has_room = done is not crowded() or dimension.dxf.text != " "
        assert [text.plain_text() for text in texts_of(dimension)] == [words] * has_room
        assert dimension.dxf.text == (words if has_room else " ")
        assert dimension.get_measurement() == pytest.approx(math.dist(*gap.ends) / unit_m)


def test_what_has_no_room_for_its_name_has_a_number_in_the_list(done):
    texts = plan_drawing(done).texts
    numbered = {text.of: text.words for text in texts if text.is_left and text.of}
    ids = [array.id for array in done.arrays] if done is crowded() else []
    assert numbered == {name: f"({k}) {name}" for k, name in enumerate(ids, start=1)}
    named = {text.of: text.words for text in texts if not text.is_left}
    assert [named[name] for name in ids] == [f"({k})" for k in range(1, len(ids) + 1)]
    assert {array.id for array in done.arrays} <= named.keys()


def test_a_plan_of_ours_reads_back_with_its_outlines_and_the_heights_beside_them(done, file):
    read = plan(file(write_dxf(plan_drawing(done)), "plan.dxf"))
    found = {item.name: item for item in (*read.arrays, *read.objects)}
    placed = [item for item in done.project.objects if item.placed is not None]
    for item in (*done.project.arrays, *placed):
        assert np.array(found[item.id].shape.points) == pytest.approx(
            np.array(item.placed.points), abs=1e-5
        )
    for item in done.project.objects:
        height_m = math.nan if item.height_m is None else item.height_m
        assert found[item.id].height_m == pytest.approx(height_m, abs=1.5e-3, nan_ok=True)
