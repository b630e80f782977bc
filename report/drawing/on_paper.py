"""The roof plan on paper, to scale: items on the roof, their displacements, every clearance.

Places finished numbers and texts, which `report.figures.plan_figure` and `report.web.plan` paint.
`report.drawing.plan_layers` has the same plan on layers, for CAD. Read `plan_on_paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from report.assessment.assessment import Assessment
from report.drawing.dimensions import draw_dimensions, draw_numbers
from report.drawing.labels import (
    label_array,
    label_edges,
    label_object,
    name_spot,
    own_frame,
    reserve_name,
)
from report.drawing.layers import Layer
from report.drawing.legend import draw_key, key_on_paper
from report.drawing.paper_items import Mark, level, width_in
from report.drawing.placer import Frame, Placer, centered
from report.drawing.plan_layers import outlines
from report.drawing.plan_tables import Schedule, alike_arrays, fitted_schedule
from report.drawing.sheet import (
    A3,
    A4,
    COLUMN_IN,
    LETTER,
    LINE_IN,
    TABLOID,
    Paper,
    PlanSheet,
    PlanSize,
    Scale,
    round_scale,
    unit_format,
)
from report.project.model.choices import PlanPaper
from report.project.model.shapes import Point, Rectangle, around, sides
from report.text.units import Quantity, number

# One over the other; those of one rank in the order of the workbook.
_OVER = {
    Layer.OUTLINE: 0,
    Layer.BARE_EDGE: 1,
    Layer.RUNS: 2,
    Layer.DESIGN: 2,
    Layer.ARRAY: 3,
    Layer.UNLIKE: 4,
    Layer.OBJECT: 4,
    Layer.PARAPET: 5,
    Layer.EDGE: 5,
}
_NAMED = (Layer.ARRAY, Layer.UNLIKE, Layer.OBJECT)
_TICKS = 6  # at most, between coordinates


def draw_outlines(plan: PlanSheet) -> None:
    """Draw the roof and the items on it, and keep labels off them."""
    lines = outlines(plan.assessment, plan.envelopes)
    for line in sorted(lines, key=lambda line: _OVER[line.layer]):
        name = line.name if line.layer in _NAMED else ""
        if line.layer in (Layer.PARAPET, Layer.EDGE):
            for ends in _edge_lines(plan, line.name):
                plan.paper.lines(line.layer, ends, name=line.name)
        elif not line.is_closed:
            plan.paper.lines(line.layer, tuple(map(plan.paper.at, line.points)))
        elif len(line.points) > 2:
            plan.paper.shape(line.layer, line.points, name)
    _avoid(plan)


def _avoid(plan: PlanSheet) -> None:
    """Let labels cover objects and sides of arrays only if there is no other room."""
    paper = plan.paper
    for array in plan.assessment.arrays:
        for side in paper.sides(array.array.shape.points):
            paper.placer.wall(side)
    frames: list[Frame] = []
    for item in plan.placed:
        shape = plan.shapes[item.id]
        if isinstance(shape, Rectangle):
            frames.append(paper.frame(shape))
        else:
            frames += paper.sides(shape.points)
    for frame in frames:
        paper.placer.avoid(frame)


def _edge_lines(plan: PlanSheet, name: str) -> Sequence[tuple[Point, Point]]:
    """Return the lines of a roof edge: the middle of a strip, or else its outline."""
    paper, shape = plan.paper, plan.shapes[name]
    if not isinstance(shape, Rectangle):
        return tuple(sides(tuple(map(paper.at, shape.points))))
    frame = paper.frame(shape)
    x, y = frame.middle
    if frame.tall > frame.wide:
        return (((x, frame.y0), (x, frame.y1)),)
    return (((frame.x0, y), (frame.x1, y)),)


def draw_coordinates(plan: PlanSheet, extent: Rectangle) -> None:
    """Draw coordinates of the plan to the left and below."""
    paper, unit = plan.paper, plan.fmt.units(Quantity.PLAN)[0]
    box = paper.frame(extent)
    for tick in _ticks(extent.x_from_m / unit.si, extent.x_to_m / unit.si):
        (x, _), words = paper.at((tick * unit.si, 0.0)), number(tick, 0)
        paper.lines(Mark.TICK, ((x, box.y0 - 0.26), (x, box.y0 - 0.31)))
        _write(plan, (x, box.y0 - 0.39), words)
    for tick in _ticks(extent.y_from_m / unit.si, extent.y_to_m / unit.si):
        (_, y), words = paper.at((0.0, tick * unit.si)), number(tick, 0)
        paper.lines(Mark.TICK, ((box.x0 - 0.26, y), (box.x0 - 0.31, y)))
        _write(plan, (box.x0 - 0.34 - width_in(words) / 2, y), words)
    names = [f"{axis} [{unit.symbol}]" for axis in "xy"]
    for name, y in zip(names, (box.y0 - 0.39, box.y1 + 0.17), strict=True):
        _write(plan, (box.x0 - 0.62 + width_in(name) / 2, y), name)


def _ticks(low: float, high: float) -> list[float]:
    """Return the round values within a range."""
    min_step = (high - low) / _TICKS
    decade = 10.0 ** math.floor(math.log10(min_step))
    # 1e-9 here and below: 0.3 / 0.1 is 2.9999999999999996, and the tick at 0.3 would be lost.
    step = next(s * decade for s in (1, 2, 5, 10) if s * decade >= min_step * (1.0 - 1e-9))
    first = math.ceil(low / step - 1e-9)
    return [k * step for k in range(first, math.floor(high / step + 1e-9) + 1)]


def _write(plan: PlanSheet, middle: Point, words: str) -> None:
    frame = centered(*middle, width_in(words), LINE_IN)
    plan.paper.label(frame, [words])
    plan.paper.placer.take(frame)


def plan_on_paper(
    assessment: Assessment,
    size: PlanSize,
    designs: Mapping[str, str] = {},
    *,
    has_verdicts: bool = True,
) -> PlanSheet:
    """Return the plan at a round scale, or for a screen; displacements may be given as text."""
    extent = _extent(assessment)
    paper, key = _empty(extent, size, _scale(assessment, extent, size))
    plan = PlanSheet(
        assessment=assessment, size=size, paper=paper, designs=designs, has_verdicts=has_verdicts
    )
    if not size.is_full:
        paper.placer.take(key)
    _draw(plan, extent)
    if not size.is_full:
        draw_key(plan, key, paper)
    paper.items.sort(key=level)
    return plan


# Longest name that a table beside a plan has room for: with longer ones it follows the plan.
BESIDE_LETTERS = 12


class PrintedPlan(NamedTuple):
    """The plan, its legend, the tables next to it, and items without room for a label."""

    size: PlanSize
    plan: Paper
    key: Paper
    beside: Schedule
    unnamed: Sequence[str]


def printed_plan(assessment: Assessment) -> PrintedPlan:
    """Return the plan on the requested paper, or on the first with enough room."""
    arrays = alike_arrays(assessment, unit_format(assessment))
    schedules = {size: fitted_schedule(assessment, arrays, size) for size in _sizes(assessment)}
    # A plan whose schedule has no room beside it need not be drawn.
    roomy = [
        size for size, rows in schedules.items() if not size.columns or rows.is_all(assessment)
    ]
    # The last is taken as it is: there is no larger paper.
    for size in roomy or list(schedules)[-1:]:
        sheet = plan_on_paper(assessment, size)
        if not sheet.unnamed + sheet.crowded:
            break
    return PrintedPlan(size, sheet.paper, key_on_paper(sheet), schedules[size], sheet.unnamed)


def _sizes(assessment: Assessment) -> Sequence[PlanSize]:
    """Return the sizes on the requested paper, or on any, the smallest first."""
    small, large = (A4, A3) if assessment.project.is_on_a4 else (LETTER, TABLOID)
    data = assessment.project
    ids = (*(array.id for array in data.arrays), *(item.id for item in data.objects))
    if max(map(len, ids)) > BESIDE_LETTERS:
        sheet = large[0]
        large = (replace(sheet, wide=sheet.wide + sheet.columns * COLUMN_IN, columns=0),)
    return {
        PlanPaper.BY_SIZE: (small, *large),
        **dict.fromkeys((PlanPaper.LETTER, PlanPaper.A4), (small,)),
        **dict.fromkeys((PlanPaper.TABLOID, PlanPaper.A3), large),
    }[assessment.project.options.plan_paper]


def _empty(extent: Rectangle, size: PlanSize, scale: Scale) -> tuple[Paper, Frame]:
    """Return the paper with the plan centered in the area left by the legend, and its frame."""
    left, right, bottom, top = size.fringe
    wide = (extent.x_to_m - extent.x_from_m) / scale.m_per_in
    tall = (extent.y_to_m - extent.y_from_m) / scale.m_per_in
    below = size.key_tall if size.is_screen else 0.0
    height = size.tall if size.is_screen else max(tall + bottom + top + below, size.key_tall)
    room = size.wide - (0.0 if size.is_screen else size.key_wide) - left - right
    origin = (
        left + max(room - wide, 0.0) / 2 - extent.x_from_m / scale.m_per_in,
        below + bottom + (height - below - bottom - top - tall) / 2
        - extent.y_from_m / scale.m_per_in,
    )  # fmt: skip
    placer = Placer(Frame(0.01, 0.01, size.wide - 0.01, height - 0.01))
    key = Frame(size.wide - size.key_wide, 0.0, size.wide, size.key_tall if below else height)
    return Paper(size.wide, height, scale, origin, placer), key


def _draw(plan: PlanSheet, extent: Rectangle) -> None:
    """Draw everything; labels last, the least movable first."""
    draw_outlines(plan)
    if plan.size.is_full:
        draw_coordinates(plan, extent)
    label_edges(plan, extent)
    # Names hold their room first, dimensions slide around it, and labels then take what is left:
    # an array without a name is the worst of the three.
    names = [reserve_name(plan, array) for array in plan.assessment.arrays]
    spots = list(filter(None, [name_spot(plan, item) for item in plan.placed]))
    for spot in spots:
        plan.paper.placer.take(spot)
    lanes = draw_numbers(plan)
    for item in plan.edges:
        for a, b in _edge_lines(plan, item.id):
            plan.paper.placer.take_segment(a, b)
    if plan.size.is_full or plan.size.is_screen:
        draw_dimensions(plan, lanes)
    # A small object would disappear between two names: none covers it.
    for item in plan.placed:
        if frame := own_frame(plan, item):
            plan.paper.placer.take(frame)
    for array, name in zip(plan.assessment.arrays, names, strict=True):
        if name is not None:
            plan.paper.placer.release(name)
            label_array(plan, array, name)
    for spot in spots:
        plan.paper.placer.release(spot)
    for item in plan.placed:
        label_object(plan, item)


def _extent(assessment: Assessment) -> Rectangle:
    data = assessment.project
    rows = (*data.arrays, *data.objects, data.roof)
    return around(row.placed for row in rows if row.placed is not None)


def _scale(assessment: Assessment, extent: Rectangle, size: PlanSize) -> Scale:
    """Return the largest scale that lets the plan fit; on paper, a round one."""
    left, right, bottom, top = size.fringe
    wide = size.wide - left - right - (0.0 if size.is_screen else size.key_wide)
    tall = size.tall - bottom - top - (size.key_tall if size.is_screen else 0.0)
    need = max((extent.x_to_m - extent.x_from_m) / wide, (extent.y_to_m - extent.y_from_m) / tall)
    if size.is_screen:
        return Scale("", need)
    return round_scale(need, unit_format(assessment).us_first)
