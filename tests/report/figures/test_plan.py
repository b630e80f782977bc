"""The roof plan: at true scale, complete, and no label on another."""

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from fixtures import assessments, projects
from fixtures.dxf import L_FT
from fixtures.marks import by_day
from fixtures.pages import page_of
from fixtures.plan_pictures import SMALL, roof_plan
from fixtures.project_parts import NO_SIDES
from fixtures.projects import FOOT
from fixtures.spaces import spaced
from report.assessment.support.plan_gaps import keep_clear
from report.drawing.on_paper import plan_on_paper, printed_plan
from report.drawing.paper_items import TYPE_PT, Text, width_in
from report.drawing.sheet import LETTER, PlanSize, round_scale
from report.figures.base import style
from report.figures.plan_figure import painted, paper_svg
from solver.model import INCH_M

NARROW = PlanSize(wide=4.5, tall=8.0, is_full=True)
SIZES = [SMALL, LETTER, NARROW]


@pytest.fixture(scope="module")
def done():
    return assessments.package().assessment


@pytest.fixture(scope="module")
def crowded():
    return assessments.twelve(is_long=False).assessment


ROOF_FT = ((0, 0), (240, 0), (240, 90), (150, 160), (0, 160))
PARAPET_FT = ((240, 90), (241, 91), (151, 161), (150, 160))


@pytest.fixture(scope="module")
def outlined():
    """An array around a unit, a roof with an oblique side, and a parapet along it."""
    return assessments.package(
        arrays=[
            projects.array("A1", 2.0) | NO_SIDES,
            projects.array("A2", 2.0, x=120, y=20, x_to_m=180 * FOOT, y_to_m=75 * FOOT),
        ],
        objects=[
            projects.roof_object("RTU-1", "fixed object", 67, 75, 55, 65),
            {"id": "NE", "kind": "edge with parapet", "height_m": 30 * INCH_M},
        ],
        clearances=[
            projects.clearance("A1", "RTU-1", 5 * FOOT),
            projects.clearance("A1", "A2", 20 * FOOT),
        ],
        outlines=[
            {"name": name, "x_m": x * FOOT, "y_m": y * FOOT}
            for name, ring in (("A1", L_FT), ("roof", ROOF_FT), ("NE", PARAPET_FT))
            for x, y in ring
        ],
    ).assessment


def words(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def legend(done):
    return paper_svg(printed_plan(done).key)


def figure(done, size):
    with style():
        drawn = painted(plan_on_paper(done, size).paper)
        drawn.set_dpi(400)  # extents are rounded to pixels
        FigureCanvasAgg(drawn)
    return drawn


def patches(drawn):
    """What is drawn, by name."""
    return {patch.get_gid(): patch for patch in drawn.axes[0].patches if patch.get_gid()}


def place(drawn, name):
    """Lower left corner and size on paper [in]."""
    points = patches(drawn)[name].get_xy()
    return points.min(axis=0), np.ptp(points, axis=0)


def extents(drawn):
    """The texts and their extents on paper [in]."""
    renderer = drawn.canvas.get_renderer()
    boxes = [(text, text.get_window_extent(renderer)) for text in drawn.axes[0].texts]
    return [(text, box.transformed(drawn.dpi_scale_trans.inverted())) for text, box in boxes]


@pytest.mark.parametrize("size", by_day(SIZES, 1))
@pytest.mark.parametrize("name", ["done", "crowded", "outlined"])
def test_no_label_touches_another_or_leaves_the_sheet(request, name, size):
    drawn = figure(request.getfixturevalue(name), size)
    found = extents(drawn)
    wide, tall = drawn.get_size_inches()
    for text, box in found:
        assert 0.0 <= box.x0 < box.x1 <= wide, text
        assert 0.0 <= box.y0 < box.y1 <= tall, text
    for (a, box), (b, other) in itertools.combinations(found, 2):
        apart_x = max(box.x0, other.x0) - min(box.x1, other.x1)
        apart_y = max(box.y0, other.y0) - min(box.y1, other.y1)
        assert max(apart_x, apart_y) > 0.0, (a.get_text(), b.get_text())


@pytest.mark.parametrize("size", SIZES)
def test_the_picture_is_at_the_scale_that_it_states(done, size):
    drawn = figure(done, size)
    # The legend of a large plan is a picture of its own.
    shown = words(roof_plan(done, SMALL) if size is SMALL else legend(done))
    stated = next(text for text in shown if text.startswith("1 in ="))
    if size is NARROW:
        stated = plan_on_paper(done, size).paper.scale.name
    feet_per_inch = int(re.fullmatch(r"1 in = (\d+) ft", stated).group(1))
    for name, wide, tall in (("A1", 80, 60), ("T-1", 53, 30)):
        _, size_in = place(drawn, name)
        assert size_in * feet_per_inch == pytest.approx([wide, tall])
    svg = roof_plan(done, size)
    points = float(re.search(r'width="([\d.]+)pt"', svg).group(1))
    assert points == pytest.approx(72.0 * size.wide)
    assert drawn.get_size_inches()[1] <= size.tall + 1e-9


def test_arrays_objects_and_clearances_are_drawn_marked_and_named(done):
    found = words(roof_plan(done, LETTER))
    for name in ("A1", "A2", "A3", "RTU-1", "T-1", "1", "2", "3", "4", "5", "x [ft]"):
        assert name in found
    assert "N edge: parapet 30.0 in (762 mm)" in spaced(found)
    assert "S edge: no parapet" in found
    (table,) = (table for table in page_of(done, "plan").tables if table.title.startswith("Sched"))
    for gap, row in zip(done.clearances, table.rows, strict=True):
        values = gap.required_m, gap.clearance.provided_m
        heads = "Req’d [in]", "Prov’d [in]"
        assert [row[head] for head in heads] == [f"{v / INCH_M:.1f}" for v in values]
        assert any(spaced(text).startswith(row["Prov’d [in]"] + " in") for text in found)
    marked = sum(not gap.ok for gap in done.clearances)
    assert marked == 1
    for size in SIZES:
        drawn = figure(done, size)
        assert [t.get_text() for t in drawn.axes[0].texts].count("NG") == marked
        heavy = [p for p in drawn.axes[0].patches if (p.get_hatch() or "").startswith("xxx")]
        assert len(heavy) == marked
    assert words(legend(done)).count("NG") == 1
    gaps = tuple(gap for gap in done.clearances if gap.ok)
    satisfied = replace(done, clearances=gaps, at_reduced_friction=None)
    assert "NG" not in words(roof_plan(satisfied, LETTER))
    lost = replace(done, arrays=tuple(replace(a, design_m=math.nan) for a in done.arrays))
    found = words(roof_plan(lost, LETTER))
    assert found.count("no value") == 3
    assert not any("keep clear 4" in text for text in found)


def test_upright_edges_and_dollar_signs_are_named_as_they_are():
    west = projects.roof_object("W", "edge with parapet", -1, 0, 0, 170, height=30)
    objects = [*projects.project().objects, west]
    drawn = figure(assessments.package(objects=objects).assessment, LETTER)
    box = next(box for text, box in extents(drawn) if text.get_text().startswith("W: "))
    (_, low), (_, tall) = place(drawn, "A2")
    middle = low + (85.0 - 15.0) * tall / 60.0
    assert (box.y0 + box.y1) / 2 == pytest.approx(middle, abs=0.02)
    given = assessments.package(arrays=[projects.array("$x_1$", 2.0)], objects=[], clearances=[])
    assert "$x_1$" in words(roof_plan(given.assessment, SMALL))
    shown = printed_plan(assessments.shipped("conditions")).key
    texts = [item for item in shown.items if isinstance(item, Text)]
    assert "clearance not satisfied" in [text.words for text in texts]
    for text in texts:
        assert text.at[0] + width_in(text.words) * (0.5 if text.is_centered else 1.0) < shown.wide


def on_roof(drawn, points):
    """Points on paper as points of the plan [ft]."""
    (x0, y0), (wide, _) = place(drawn, "A2")
    per_ft = wide / 60.0
    return [(120.0 + (x - x0) / per_ft, 20.0 + (y - y0) / per_ft) for x, y in points]


@pytest.mark.parametrize("size", SIZES)
def test_an_outline_is_drawn_as_it_is(outlined, size):
    drawn = figure(outlined, size)
    found = on_roof(drawn, patches(drawn)["A1"].get_xy()[:-1])
    assert found == [pytest.approx(point) for point in L_FT]


def test_outlines_gaps_and_names_are_where_they_are(outlined):
    drawn = figure(outlined, LETTER)
    ends = [tuple(zip(*line.get_data(), strict=True))[:2] for line in drawn.axes[0].lines]
    found = [on_roof(drawn, pair) for pair in ends if len(pair) == 2]
    # RTU-1 is 5 ft from the lower leg, which it faces from x = 67 ft to 75 ft.
    assert any(pair == [pytest.approx((71.0, 50.0)), pytest.approx((71.0, 55.0))] for pair in found)
    drawn = figure(outlined, LETTER)
    (box,) = (box for text, box in extents(drawn) if text.get_text() == "A1")
    ((x, y),) = on_roof(drawn, [((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2)])
    assert 20.0 < x < 100.0
    assert 20.0 < y < 75.0
    assert x < 60.0 or y < 50.0


def test_all_is_named_and_neighbors_without_a_clearance_are_in_the_notes(crowded):
    on = printed_plan(crowded)
    shown, page = words(paper_svg(on.plan)), page_of(crowded, "plan")
    for item in (*crowded.arrays, *crowded.project.objects):
        assert item.id in shown
        assert item.id not in on.unnamed
    missing = page.table("Adjacent items")
    assert "A5" in {row[0] for row in missing.cells}
    assert ("Not labeled, for lack of space" in page) == bool(on.unnamed)


@pytest.mark.parametrize("size", SIZES)
def test_a_displacement_that_is_not_permitted_marks_nothing_and_keeps_nothing_clear(size):
    found = words(roof_plan(projects.unpermitted(), size))
    assert "Δ 0.0 in (0 mm)" not in found
    assert not any("keep clear 0" in text.lower() for text in found)
    assert not {"OK", "NG"} & set(found)
    if size.is_full:
        assert "Δ not permitted" in found or size is NARROW  # where A1 has room for its name alone
        page = page_of(projects.unpermitted(), "plan")
        assert "neither procedure is permitted for A1," in page
        row = page.tables[0].row("A1")
        assert (row["Δ [in]"], row["Keep clear [in]"]) == ("none", "unknown")
        required = [row["Req’d [in]"] for row in page.tables[1].rows]
        assert required[:2] == ["none", "none"]


@pytest.mark.parametrize(
    ("inches", "us_first", "name"),
    [*((feet * 12, True, f"1 in = {scale} ft") for feet, scale in (
        (3.0, 10), (10.0, 10), (10.1, 20), (60.5, 80), (80.1, 100), (101.0, 150), (151.0, 200))),
     *((ratio, False, f"1:{scale}") for ratio, scale in (
        (99.0, 100), (201.0, 250), (500.0, 500), (760.0, 1000)))],
)  # fmt: skip
def test_scales_are_those_of_an_engineers_ruler_or_round(inches, us_first, name):
    scale = round_scale(inches * INCH_M, us_first=us_first)
    assert scale.name == name
    per = scale.m_per_in / (FOOT if us_first else INCH_M)
    assert per == pytest.approx(float(re.search(r"(\d+)(?: ft)?$", name).group(1)))


@pytest.mark.parametrize(
    ("inches", "us", "si"), [(40.0, "41", "1020"), (40.8, "41", "1040"), (41.0, "41", "1050")]
)
def test_keep_clear_is_never_rounded_down(inches, us, si):
    inches = 40.0 + 1e-6 if inches == 40.0 else inches
    assert spaced(keep_clear(inches * INCH_M, True)) == f"{us} in"
    assert spaced(keep_clear(inches * INCH_M, False)) == f"{si} mm"


@pytest.mark.quick
def test_text_is_as_wide_as_it_is_drawn(done):
    for text, box in extents(figure(done, LETTER)):
        if text.get_rotation() == 0 and text.get_fontsize() == TYPE_PT and text.get_text() != "N":
            is_bold = text.get_weight() == "semibold"
            assert width_in(text.get_text(), is_bold=is_bold) == pytest.approx(box.width, abs=0.02)
