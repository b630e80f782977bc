"""What stands still on the roof plan, and where each array may move.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.drawing.items import Mark
from report.drawing.layers import Layer
from report.drawing.paper import LINE_IN
from report.drawing.placer import Frame, centered
from report.drawing.plan import outlines
from report.drawing.sheet import PlanSheet
from report.drawing.widths import width_in
from report.sheet.schema.shapes import Point, Rectangle, sides
from report.words.units import Quantity, number

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
"""One over the other; those of one rank in the order of the workbook."""
_NAMED = (Layer.ARRAY, Layer.UNLIKE, Layer.OBJECT)
_TICKS = 6  # at most, between coordinates


def draw_outlines(plan: PlanSheet) -> None:
    """Draw the roof and what is on it, and keep labels off it."""
    shown = outlines(plan.assessment, plan.envelopes)
    for line in sorted(shown, key=lambda line: _OVER[line.layer]):
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
    """Let labels cover objects and sides of arrays only where there is no other room."""
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


def take_edges(plan: PlanSheet) -> None:
    """Keep labels off the roof edges."""
    for item in plan.edges:
        for a, b in _edge_lines(plan, item.id):
            plan.paper.placer.take_segment(a, b)


def _edge_lines(plan: PlanSheet, name: str) -> Sequence[tuple[Point, Point]]:
    """Return the lines of a roof edge: the middle of a strip, or else its outline."""
    paper, shape = plan.paper, plan.shapes[name]
    if isinstance(shape, Rectangle):
        return (_spine(paper.frame(shape)),)
    return tuple(sides(tuple(map(paper.at, shape.points))))


def _spine(frame: Frame) -> tuple[Point, Point]:
    """Return the center line of a strip."""
    x, y = frame.middle
    if frame.tall > frame.wide:
        return (x, frame.y0), (x, frame.y1)
    return (frame.x0, y), (frame.x1, y)


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
    least = (high - low) / _TICKS
    decade = 10.0 ** math.floor(math.log10(least))
    step = next(s * decade for s in (1, 2, 5, 10) if s * decade >= least * (1.0 - 1e-9))
    first = math.ceil(low / step - 1e-9)
    return [k * step for k in range(first, math.floor(high / step + 1e-9) + 1)]


def _write(plan: PlanSheet, middle: Point, words: str) -> None:
    frame = centered(*middle, width_in(words), LINE_IN)
    plan.paper.label(frame, [words])
    plan.paper.placer.take(frame)
