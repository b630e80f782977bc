"""The printed roof plan: no leader crosses an array or a label, and no label is left out."""

import itertools
from functools import cache, partial

import pikepdf
import pytest
import shapely

from fixtures import assessments, projects
from fixtures.pages import page_of
from fixtures.plan_pictures import SMALL
from fixtures.project_parts import HEAD, sides
from fixtures.projects import FOOT
from fixtures.spaces import spaced
from report.drawing.layers import Layer
from report.drawing.on_paper import plan_on_paper, printed_plan
from report.drawing.paper_items import TYPE_PT, Circle, Lines, Mark, Outline, Text, width_in
from report.drawing.placer import Frame, Placer, centered
from report.drawing.sheet import PlanSize
from report.figures import plan_figure as figures
from report.package.html import part
from report.pages.registry import package_data
from report.project.model.choices import PlanPaper
from report.typeset.pdf import lay_out

ROWS, COLUMNS = 6, 5
WIDE, DEEP, LANE = 52, 24, 4  # ft


@cache
def thirty(paper=PlanPaper.BY_SIZE, us_first=True):
    """Thirty arrays in lanes of 4 ft, units between them and at an end, 58 clearances."""
    arrays, rows, units = [], [], []
    for row, column in itertools.product(range(ROWS), range(COLUMNS)):
        name, x, y = f"A{1 + row * COLUMNS + column}", 16 + column * 56, 8 + row * 28
        wide = WIDE - 16 if name == "A10" else WIDE
        arrays.append(projects.array(name, 1.0) | sides(x, x + wide, y, y + DEEP))
        if column:
            rows.append(projects.clearance(name, f"A{row * COLUMNS + column}", LANE * FOOT))
        if row:
            rows.append(
                projects.clearance(name, f"A{1 + (row - 1) * COLUMNS + column}", LANE * FOOT)
            )
    units = [
        projects.roof_object("RTU-1", "fixed object", 282, 288, 40, 52, height=1.0),
        projects.roof_object("RTU-2", "fixed object", 100, 114, 182, 190, height=1.0),
        projects.roof_object("W", "edge with parapet", -1, 0, 0, 200, height=1.0),
    ]
    rows += [
        projects.clearance("A10", "RTU-1", 6 * FOOT),
        projects.clearance("A27", "RTU-2", 0.5 * FOOT),
        *(projects.clearance(f"A{1 + row * COLUMNS}", "W", 16 * FOOT) for row in range(ROWS)),
    ]
    roof = sides(0, 310, 0, 200)
    return assessments.package(
        arrays=arrays,
        objects=units,
        clearances=rows,
        roof=roof,
        options={"plan_paper": paper},
        project=HEAD | {"units_first": "US" if us_first else "SI"},
    ).assessment


PLANS = {
    "thirty": thirty,
    **{name: partial(assessments.shipped, name) for name in assessments.SHIPPED},
}


@pytest.fixture(params=PLANS)
def done(request):
    return PLANS[request.param]()


def words_of(paper):
    return [item for item in paper.items if isinstance(item, Text)]


def area(text):
    """The area of a text: `TYPE_PT` tall, on its baseline."""
    wide = width_in(text.words, is_bold=text.is_bold)
    tall, (x, y) = 0.7 * TYPE_PT / 72.0, text.at
    start = -wide / 2 if text.is_centered else 0.0
    low, high = (start, 0.0), (start + wide, tall)
    if text.is_upright:
        return shapely.box(x - tall, y + low[0], x, y + high[0])
    return shapely.box(x + low[0], y, x + high[0], y + tall)


def leaders(paper):
    return [
        shapely.LineString(points)
        for item in paper.items
        if isinstance(item, Lines) and item.look is Mark.LEADER
        for points in item.lines
    ]


def inner_arrays(paper):
    return [
        shapely.Polygon(item.points).buffer(-0.01)
        for item in paper.items
        if isinstance(item, Outline) and item.look is Layer.ARRAY
    ]


def test_no_leader_crosses_an_array_or_a_label(done):
    paper = printed_plan(done).plan
    arrays = inner_arrays(paper)
    assert len(arrays) == len(done.arrays)
    labels = [area(text) for text in words_of(paper)]
    labels += [
        shapely.Point(item.center).buffer(item.radius - 0.01)
        for item in paper.items
        if isinstance(item, Circle)
    ]
    for leader in leaders(paper):
        assert not leader.intersects(shapely.union_all([*arrays, *labels])), leader
    assert [row[0] for row in scheduled(page_of(done, "plan"))] == numbers(done)


def test_the_legend_ends_within_the_sheet(done):
    key = printed_plan(done).key
    assert words_of(key)
    for text in words_of(key):
        assert area(text).bounds[2] <= key.wide, text.words


def test_large_roofs_have_leaders_and_small_plans_sizes_and_numbers():
    assert all(leaders(printed_plan(PLANS[name]()).plan) for name in ("thirty", "example"))
    shown = [text.words for text in words_of(printed_plan(assessments.shipped("example")).plan)]
    shown = spaced(shown)
    assert {"120 × 92 ft", "120 × 102 ft", "150 × 150 ft"} <= set(shown)
    tables = page_of(thirty(), "plan").tables
    (arrays,) = (table for table in tables if table.headings[:2] == ("Arrays", "Size [ft]"))
    rows = [row[:2] for row in arrays.cells]
    assert rows == [("A1 to A9, A11 to A30", "52 × 24"), ("A10", "36 × 24")]
    paper = plan_on_paper(thirty(), SMALL).paper
    solid = shapely.union_all(inner_arrays(paper))
    assert not any(leader.intersects(solid) for leader in leaders(paper))


def test_no_label_is_left_out_or_lies_on_another(done):
    printed = printed_plan(done)
    shown = [text.words for text in words_of(printed.plan)]
    assert not printed.unnamed
    for count, _ in enumerate(done.clearances, start=1):
        assert shown.count(str(count)) >= 1
    numbers = [item for item in printed.plan.items if isinstance(item, Circle)]
    assert len(numbers) == len(done.clearances)
    for item in (*done.arrays, *done.project.objects):
        assert any(words == item.id or words.startswith(f"{item.id}: ") for words in shown)
    assert bool(printed.size.sheet) == printed.beside.is_all(done)
    paper = printed_plan(done).plan
    areas = [(text, area(text)) for text in words_of(paper)]
    for (one, of_one), (other, of_other) in itertools.combinations(areas, 2):
        assert not of_one.intersects(of_other), (one.words, other.words)
    for item in paper.items:
        if isinstance(item, Lines) and item.look in (Layer.CLEARANCE, Layer.CLEARANCE_NG):
            line = shapely.MultiLineString(item.lines[:1])
            crossed = [text.words for text, of in areas if of.intersects(line)]
            assert all(words.isdigit() or words == "NG" for words in crossed)


def test_the_page_has_each_number_once_in_its_gap_and_equal_gaps_dimensioned_once(done):
    size = PlanSize(wide=7.5, tall=4.3, key_wide=7.5, key_tall=0.5, is_screen=True)
    paper = plan_on_paper(done, size, {array.id: "9 in" for array in done.arrays}).paper
    shown = [text.words for text in words_of(paper)]
    circles = [item.center[0] for item in paper.items if isinstance(item, Circle)]
    numbers = [text.words for text in words_of(paper) if text.at[0] in circles]
    assert {*numbers} >= {str(count) for count, _ in enumerate(done.clearances, start=1)}
    assert len(circles) == len(done.clearances)
    assert not [words for words in shown if "required" in words]
    equal = [words for words in shown if " typ. of " in words]
    assert len(set(equal)) == len(equal)


@pytest.mark.quick
def test_equal_gaps_of_several_kinds_are_dimensioned_once_with_their_numbers():
    """Of the example: 96 in from A1 to A2, an array, and to NORTH, a roof edge."""
    shown = [text.words for text in words_of(printed_plan(assessments.shipped("example")).plan)]
    shown = spaced(shown)
    assert shown.count("96.0 in: No. 1 and 3") == 1
    assert not [words for words in shown if "typ." in words]


@cache
def vents():
    """Small vents in rows between two arrays, so close that their names have no room between."""
    objects = [
        projects.roof_object(f"VENT-{k}", "fixed object", x, x + 3, y, y + 3, height=1.0)
        for k, (x, y) in enumerate(itertools.product(range(80, 140, 7), range(60, 100, 7)))
    ]
    arrays = [projects.array("A1", 1.0) | sides(0, 60, 0, 160),
              projects.array("A2", 1.0) | sides(160, 220, 0, 160)]  # fmt: skip
    roof = sides(-10, 230, -10, 170)
    return assessments.package(arrays=arrays, objects=objects, clearances=[], roof=roof).assessment


@pytest.mark.quick
def test_no_label_covers_an_object_that_is_smaller_than_a_name():
    paper = printed_plan(vents()).plan
    outlines = [item for item in paper.items if isinstance(item, Outline)]
    small = [shapely.Polygon(item.points) for item in outlines if item.look is Layer.OBJECT]
    labels = [
        shapely.Polygon(item.points)
        for item in outlines
        if item.look in (Mark.FRAME, Mark.BACKING, Mark.NG)
    ]
    assert len(small) == len(vents().project.objects)
    assert len(labels) > len(small) / 2
    assert not [one for one in small if shapely.union_all(labels).intersects(one)]


@pytest.mark.quick
def test_equal_gaps_are_dimensioned_once_and_those_not_satisfied_marked():
    shown = [spaced(text.words) for text in words_of(printed_plan(thirty()).plan)]
    assert shown.count("48.0 in typ. of 49") == 1
    assert shown.count("192.0 in typ. of 6") == 1
    assert shown.count("72.0 in") == 1
    assert not {"48.0 in", "192.0 in"} & set(shown)
    paper = printed_plan(thirty()).plan
    (ng,) = (text for text in words_of(paper) if text.words == "NG")
    (number,) = (text for text in words_of(paper) if text.words == "51")
    assert shapely.distance(area(ng), area(number)) < 0.15


@pytest.mark.parametrize(
    ("paper", "us_first", "size_in"),
    [
        (PlanPaper.BY_SIZE, True, (17.0, 11.0)),
        (PlanPaper.BY_SIZE, False, (420 / 25.4, 297 / 25.4)),
        (PlanPaper.LETTER, True, (8.5, 11.0)),
    ],
)
@pytest.mark.nightly
def test_the_sheet_of_the_plan_is_as_large_as_the_roof_needs_or_as_asked(
    tmp_path, paper, us_first, size_in
):
    package = package_data(thirty(paper, us_first))
    on = printed_plan(package.assessment)
    drawings = {"plan": [figures.paper_svg(on.plan), figures.paper_svg(on.key)]}
    path = tmp_path / "plan.pdf"
    path.write_bytes(lay_out(part(package, None, "plan", drawings)))
    with pikepdf.open(path) as pdf:
        sheets = [[float(v) / 72 for v in page.mediabox[2:]] for page in pdf.pages]
    all_of_it = len(sheets) if paper is PlanPaper.LETTER else 1
    assert sheets.count(pytest.approx(size_in, abs=0.01)) == all_of_it


def numbers(done):
    return [str(count) for count, _ in enumerate(done.clearances, start=1)]


def scheduled(page):
    """The rows of the schedule of clearances, which may be in several tables."""
    return [row for table in page.tables if "No." in table.headings for row in table.cells]


@pytest.mark.quick
def test_tables_stand_beside_the_large_plan_or_follow_it():
    page = page_of(thirty(), "plan")
    assert "Roof plan" in page
    for name, value in (("Scale", "1 in = 40 ft"), ("Sheet title", "Roof plan")):
        assert f"{name} {value}" in " ".join(page.split())
    page = page_of(thirty(PlanPaper.LETTER), "plan")
    assert [row[0] for row in scheduled(page)] == numbers(thirty())


PAGE = Frame(0.0, 0.0, 3.0, 2.0)
NEAR = (1.5, 1.0)


def apart(a, b):
    """The distance of two frames along the axis that separates them; negative if they overlap."""
    across = max(a.x0 - b.x1, b.x0 - a.x1)
    return max(across, a.y0 - b.y1, b.y0 - a.y1)


@pytest.fixture
def placer():
    return Placer(PAGE)


@pytest.mark.quick
def test_a_label_is_not_farther_than_it_may_be(placer):
    placer.take(centered(*NEAR, 0.2, 0.2))
    assert placer.place(0.6, 0.3, NEAR, maximum=0.2) is None
    assert placer.place(0.6, 0.3, NEAR, maximum=0.4) is not None


@pytest.mark.quick
def test_after_many_labels_without_room_the_next_are_sought_near_alone():
    placer, shut, open_side = Placer(Frame(0.0, 0.0, 8.0, 4.0)), (2.0, 2.0), (6.0, 2.0)
    for x, y in (open_side, shut):
        for row in range(-10, 11):
            placer.take_segment((x - 1.0, y + 0.1 * row), (x + 1.0, y + 0.1 * row))
    for side in ((x, y + 1.1, 2.2, 0.01), (x, y - 1.1, 2.2, 0.01)):
        placer.wall(centered(*side))
    for side in ((x + 1.1, y, 0.01, 2.2), (x - 1.1, y, 0.01, 2.2)):
        placer.wall(centered(*side))
    assert placer.place(0.1, 0.1, open_side) is not None
    assert [placer.place(0.1, 0.1, shut) for _ in range(20)] == [None] * 20
    assert placer.place(0.1, 0.1, open_side) is None
    assert placer.place(0.1, 0.1, open_side, may_cross=True) is not None
    # The label above ended the row of those without room.
    assert placer.place(0.1, 0.1, open_side) is not None


@pytest.mark.quick
def test_a_line_is_covered_only_where_there_is_no_other_room(placer):
    placer.avoid(centered(*NEAR, 0.1, 0.1))
    assert apart(placer.place(0.6, 0.3, NEAR), centered(*NEAR, 0.1, 0.1)) > 0.0
    narrow = centered(*NEAR, 0.7, 0.4)
    only = Placer(PAGE)
    only.avoid(centered(*NEAR, 0.1, 0.1))
    assert only.place(0.6, 0.3, NEAR, within=narrow) is not None
