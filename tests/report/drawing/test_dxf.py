"""The plan as DXF: read back as it was written, clean, and the same every time."""

import io
import itertools
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from functools import cache

import ezdxf
import pytest
from ezdxf.enums import TextEntityAlignment
from ezdxf.fonts.fonts import make_font
from ezdxf.math import BoundingBox2d, Vec2

from fixtures import assessments, projects
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.project_parts import FT, sides
from fixtures.spaces import spaced
from report.assessment.support.envelopes import design_envelope
from report.assessment.support.plan_gaps import plan_gaps
from report.drawing.layers import Layer
from report.drawing.plan_dxf import APPLICATION, write_dxf
from report.drawing.plan_layers import gap_cells, plan_drawing, title_block
from report.project.model.choices import UnitsFirst


@pytest.fixture(scope="module")
def done():
    return assessments.package(roof=sides(0, 220, 0, 170) | {"north_deg": 30.0}).assessment


@pytest.fixture(scope="module", params=UnitsFirst)
def plan(request, done):
    project = done.project.project.model_copy(update={"units_first": request.param})
    return plan_drawing(replace(done, project=done.project.model_copy(update={"project": project})))


@pytest.fixture(scope="module")
def document(plan):
    return read(write_dxf(plan))


def rows(plan):
    """Return the rows of the tables beside the plan, headings too."""
    cells = [text for text in plan.texts if text.is_left]
    lines = itertools.groupby(cells, lambda text: text.at[1])
    return [tuple(text.words for text in line) for _, line in lines]


def read(data):
    return ezdxf.read(io.StringIO(data.decode("utf-8")))


@pytest.mark.quick
def test_texts_name_what_is_drawn_and_the_same_plan_gives_the_same_bytes(done):
    assert write_dxf(plan_drawing(done)) == write_dxf(plan_drawing(done))
    plan = plan_drawing(done)
    said = [spaced(text.words) for text in plan.texts]
    arrays = {f"{a.id}: displacement {a.design_m / 0.0254:.1f} in" for a in done.arrays}
    assert arrays | {"RTU-1, height 42.0 in", "T-1", "S edge", "N"} <= set(said)
    gap = spaced(next(row for row in rows(plan) if row[:2] == ("5", "A2 to S edge")))
    assert gap[2:] == ("60.0 in (1524 mm)", "61.2 in (1554 mm)", "NG")
    failed = [gap.name for gap in plan.dimensions if gap.layer is Layer.CLEARANCE_NG]
    assert failed == ["A2 to S edge"]


@pytest.mark.nightly
def test_every_process_writes_the_same_bytes():
    code = (
        "from report.drawing.plan_dxf import write_dxf; from report.drawing.plan_dxf import *; "
        "gap = PlanDimension(layer=Layer.CLEARANCE, name='A1 to N', ends=((0, 0), (4, 0)), "
        "words='1: 48.0 in', at=(2, 3)); drawn = PlanDrawing("
        "is_feet=True, height=1.0, lines=(), texts=(), dimensions=(gap,), title=(), "
        "middle=(0, 0), per_in=1.0); "
        "print(write_dxf(drawn).hex())"
    )
    seeds = ("1", "5")  # sets of the library's kinds in two orders
    written = {
        subprocess.run(
            [sys.executable, "-c", code],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in seeds
    }
    assert len(written) == 1


@pytest.mark.quick
def test_the_auditor_finds_nothing_and_lines_texts_and_dimensions_are_read_back(plan, document):
    auditor = document.audit()
    assert not auditor.errors
    assert not auditor.fixes
    assert document.header["$INSUNITS"] == (2 if plan.is_feet else 6)  # feet, meters
    space = document.modelspace()
    for line, drawn in zip(plan.lines, space.query("LWPOLYLINE"), strict=True):
        assert drawn.dxf.layer == line.layer.title
        assert drawn.closed is line.is_closed
        assert drawn.get_xdata(APPLICATION)[0].value == line.name
        for point, wanted in zip(drawn.get_points("xy"), line.points, strict=True):
            assert point == pytest.approx(wanted, abs=1e-6)
    assert [text.dxf.text for text in space.query("TEXT")] == [
        spaced(text.words) for text in plan.texts
    ]
    for gap, drawn in zip(plan.dimensions, space.query("DIMENSION"), strict=True):
        assert (drawn.dxf.layer, drawn.dxf.text) == (gap.layer.title, spaced(gap.words))
        assert drawn.get_xdata(APPLICATION)[0].value == gap.name
        for point, wanted in zip((drawn.dxf.defpoint2, drawn.dxf.defpoint3), gap.ends, strict=True):
            assert point.vec2.isclose(wanted, abs_tol=1e-6)
    style = document.dimstyles.get("ROOFSLIP").dxf
    assert (style.dimlfac, style.dimdec) == ((12.0, 1) if plan.is_feet else (1000.0, 0))
    assert (style.dimtxt, chr(style.dimdsep), style.dimzin) == (plan.height, ".", 0)


@pytest.mark.quick
def test_each_kind_has_its_layer_and_each_text_shows_as_it_is(document, plan):
    assert {layer.title for layer in Layer} <= {layer.dxf.name for layer in document.layers}
    used = {entity.dxf.layer for entity in document.modelspace()}
    elsewhere = {Layer.CLEARANCE_NONE, Layer.TITLE, Layer.WINDOW}
    assert used == {layer.title for layer in set(Layer) - elsewhere}
    assert all(re.fullmatch("S(-[A-Z]{4}){1,3}", layer.title) for layer in Layer)
    words = "%%c 5%% %%u^J a^ b 100%"
    texts = [replace(text, words=words) for text in plan.texts]
    (shown,) = {
        text.plain_text()
        for text in read(write_dxf(replace(plan, texts=texts))).modelspace().query("TEXT")
    }
    assert shown == words


@pytest.mark.quick
def test_the_layout_says_what_it_is_of_and_shows_the_whole_plan_to_scale(done, plan, document):
    layout = document.paperspace("Layout1")
    said = [text.dxf.text for text in layout.query("TEXT")]
    project = done.project.project
    for words in (f"{project.number} {project.name}", project.revision, str(project.date)):
        assert words in said
    shown = dict(zip(said[::2], said[1::2], strict=True))
    assert shown | dict(title_block(done)) == shown
    assert shown["VERDICT"] == done.verdict.value
    (window,) = (each for each in layout.query("VIEWPORT") if each.dxf.id > 1)
    unit_in = 12.0 if plan.is_feet else 1.0 / 0.0254
    ratio = window.dxf.view_height / window.dxf.height * unit_in
    stated = re.fullmatch(r"1 in = (\d+) ft|1:(\d+)", shown["SCALE"])
    assert ratio == pytest.approx(12.0 * float(stated[1]) if stated[1] else float(stated[2]))
    (x, y), tall = window.dxf.view_center_point.vec2, window.dxf.view_height
    wide = tall * window.dxf.width / window.dxf.height
    box_shown = BoundingBox2d([(x - wide / 2, y - tall / 2), (x + wide / 2, y + tall / 2)])
    for entity in document.modelspace().query("TEXT"):
        assert box_shown.contains(box(entity)), entity.dxf.text
    for line in plan.lines:
        assert box_shown.contains(BoundingBox2d(line.points))
    names = [
        text for text in document.modelspace().query("TEXT") if text.dxf.text.startswith("A1:")
    ]
    assert [text.dxf.color for text in names] == [7]


def test_the_envelope_is_that_of_the_design_displacement_if_there_is_one(done):
    line = next(line for line in plan_drawing(done).lines if line.layer is Layer.DESIGN)
    wanted = [(x / FT, y / FT) for x, y in design_envelope(done.arrays[0])]
    assert line.points == tuple(wanted)
    lost = replace(done, arrays=tuple(replace(a, design_m=math.nan) for a in done.arrays))
    plan = plan_drawing(lost)
    assert not [line for line in plan.lines if line.layer is Layer.DESIGN]
    said = {text.words for text in plan.texts}
    assert {f"A{k}: displacement no value" for k in (1, 2, 3)} <= said
    assert not read(write_dxf(plan)).audit().errors


def test_a_gap_short_by_less_than_a_digit_does_not_read_as_enough(done):
    gap = next(one for one in done.clearances if one.clearance.object == "RTU-1")
    near = gap.clearance.model_copy(update={"provided_m": gap.required_m - 1e-5})
    (gap,) = plan_gaps(
        replace(done, clearances=(replace(gap, clearance=near),), at_reduced_friction=None)
    )
    *_, provided, required, verdict = gap_cells(gap, us_first=True)
    assert float(required.split()[0]) > float(provided.split()[0])
    assert verdict == "NG"


def test_a_displacement_that_is_not_permitted_marks_nothing_and_keeps_nothing_clear():
    plan = plan_drawing(projects.unpermitted())
    said = [text.words for text in plan.texts]
    assert said.count("A1: displacement not permitted") == 1
    array = next(row for row in rows(plan) if row[0] == "A1")
    assert array[1:3] == ("not permitted", "no value")
    first = next(row for row in rows(plan) if row[:2] == ("1", "A1 to RTU-1"))
    assert spaced(first[2:]) == ("84.0 in (2133 mm)", "no value", "no verdict")
    layers = {gap.name: gap.layer for gap in plan.dimensions}
    assert layers == {
        "A1 to RTU-1": Layer.CLEARANCE_NONE,
        "A2 to A1": Layer.CLEARANCE_NONE,
        "A2 to S edge": Layer.CLEARANCE,
    }
    assert [line.name for line in plan.lines if line.layer is Layer.DESIGN] == ["A2"]


@cache
def crowded():
    """Small arrays six inches apart, with long names, and a unit a foot from them."""
    ids = [f"NORTHWEST CORNER OF THE UPPER ROOF {k}" for k in range(12)]
    arrays = [
        projects.array(name, 1.0)
        | sides(8.5 * (k % 4), 8.5 * (k % 4) + 8, 8.5 * (k // 4), 8.5 * (k // 4) + 8)
        for k, name in enumerate(ids)
    ]
    unit = projects.roof_object(
        "MAKE-UP AIR UNIT OF THE KITCHEN", "fixed object", 34.5, 36, 3, 5, height=1.2
    )
    return assessments.package(
        arrays=arrays,
        objects=[unit, projects.roof_object("E", "edge with parapet", 40, 40.5, 0, 26, height=0.5)],
        clearances=[
            *(projects.clearance(near, far, 6.0) for near, far in itertools.pairwise(ids)),
            projects.clearance(ids[3], unit["id"], 12.0),
        ],
    ).assessment


@pytest.fixture(scope="module", params=by_day([*assessments.SHIPPED, "unpermitted", "crowded"], 2))
def roof(request):
    others = {"unpermitted": assessments.unpermitted, "crowded": crowded}
    return (
        others[request.param]() if request.param in others else assessments.shipped(request.param)
    )


@pytest.fixture(scope="module")
def space(roof):
    return ezdxf.read(io.StringIO(write_dxf(plan_drawing(roof)).decode())).modelspace()


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


def test_no_text_is_over_another_and_one_that_is_is_found(roof, space):
    shown = texts(space)
    assert len(shown) > 2 * len(list(plan_gaps(roof)))  # a dimension and a line of the list
    assert over(shown) == []
    first, second, *_ = texts(space)
    moved = second.copy()
    moved.dxf.insert = moved.dxf.align_point = first.dxf.align_point
    assert over([first, moved]) == [(first.plain_text(), second.plain_text())]


def test_every_gap_is_a_dimension_whose_text_is_that_of_the_schedule(roof, space):
    unit = "in" if roof.project.us_first else "mm"
    head = f"Prov’d [{unit}]"
    tables = [table for table in page_of(roof, "plan").tables if head in table.headings]
    schedule = {row["No."]: row[head] for table in tables for row in table.rows}
    assert len(schedule) == len(roof.clearances)
    unit_m = 0.3048 if roof.project.us_first else 1.0
    for gap, dimension in zip(plan_gaps(roof), space.query("DIMENSION"), strict=True):
        given = f"{gap.number}: {schedule.get(str(gap.number))}"
        start = (
            given
            if gap.is_given
            else f"not entered: {math.floor(gap.provided_m / 0.00254) / 10:.1f}"
        )
        words = f"{start} {unit}" + " NG" * gap.is_ng
        has_room = roof is not crowded() or dimension.dxf.text != " "
        assert [text.plain_text() for text in texts_of(dimension)] == [words] * has_room
        assert dimension.dxf.text == (words if has_room else " ")
        assert dimension.get_measurement() == pytest.approx(math.dist(*gap.ends) / unit_m)


def test_what_has_no_room_for_its_name_has_a_number_in_the_list(roof):
    texts = plan_drawing(roof).texts
    numbered = {text.of: text.words for text in texts if text.is_left and text.of}
    ids = [array.id for array in roof.arrays] if roof is crowded() else []
    assert numbered == {name: f"({k}) {name}" for k, name in enumerate(ids, start=1)}
    named = {text.of: text.words for text in texts if not text.is_left}
    assert [named[name] for name in ids] == [f"({k})" for k in range(1, len(ids) + 1)]
    assert {array.id for array in roof.arrays} <= named.keys()
