"""What stands still on the roof plan, and where each array may move.

Read `report.figures.plan` first.
"""

from __future__ import annotations

from matplotlib.ticker import MaxNLocator

from report.assessment.envelopes import design_envelope, runs_envelope
from report.assessment.neighbors import bare_edges
from report.figures.labels import LINE_IN, Frame, centered, width_in
from report.figures.plan_key import ARRAY, BARE, DESIGN, EDGES, FILLS, ROOF, RUNS
from report.figures.plan_sheet import PlanSheet
from report.sheet.schema import Rectangle, RoofObject
from report.sheet.schema.shapes import Point, sides
from report.words.units import Quantity, number


def draw_roof(plan: PlanSheet) -> None:
    """Draw the outline of the roof, and its edges that are no objects."""
    data, paper = plan.assessment.project, plan.paper
    if data.roof.placed is not None:
        paper.shape(data.roof.placed, **ROOF)
    for edge in bare_edges(data):
        start, end = map(paper.at, edge.ends)
        paper.line(start, end, **BARE)


def draw_arrays(plan: PlanSheet) -> None:
    """Draw the arrays, and on the large plan where each may move."""
    for array in plan.assessment.arrays if plan.size.is_full else ():
        for outline, look in ((runs_envelope(array), RUNS), (design_envelope(array), DESIGN)):
            if len(outline) > 2:
                plan.paper.polygon(outline, **look)
    for array in plan.assessment.arrays:
        plan.paper.shape(array.array.shape, gid=array.id, **ARRAY)
        for side in plan.paper.sides(array.array.shape):
            plan.paper.placer.avoid(side)


def draw_objects(plan: PlanSheet) -> None:
    """Draw what else is on the roof."""
    for item in plan.placed:
        shape = plan.shapes[item.id]
        plan.paper.shape(shape, gid=item.id, **FILLS[item.kind])
        frames = [plan.paper.frame(shape)] if isinstance(shape, Rectangle) else []
        for frame in frames or plan.paper.sides(shape):
            plan.paper.placer.avoid(frame)
    for item in plan.edges:
        _draw_edge(plan, item)


def _draw_edge(plan: PlanSheet, item: RoofObject) -> None:
    shape = plan.shapes[item.id]
    if isinstance(shape, Rectangle):
        a, b = _spine(plan.paper.frame(shape))
        plan.paper.line(a, b, **EDGES[item.kind])
        plan.paper.placer.take(Frame(min(a[0], b[0]), min(a[1], b[1]), max(a[0], b[0]),
                                     max(a[1], b[1])))  # fmt: skip
        return
    for a, b in sides(tuple(map(plan.paper.at, shape.points))):
        plan.paper.line(a, b, **EDGES[item.kind])
        plan.paper.placer.take_segment(a, b)


def draw_coordinates(plan: PlanSheet, extent: Rectangle) -> None:
    """Draw coordinates of the plan to the left and below."""
    paper, unit = plan.paper, Quantity.PLAN.us if plan.us_first else Quantity.PLAN.si
    box = paper.frame(extent)
    for axis, low, high in (
        ("x", extent.x_from_m, extent.x_to_m),
        ("y", extent.y_from_m, extent.y_to_m),
    ):
        ticks = [
            tick
            for tick in MaxNLocator(6, steps=[1, 2, 5, 10]).tick_values(
                low / unit.si, high / unit.si
            )
            if low <= tick * unit.si <= high
        ]
        for tick in ticks:
            x, y = paper.at((tick * unit.si, tick * unit.si))
            words = number(tick, 0)
            if axis == "x":
                paper.line((x, box.y0 - 0.26), (x, box.y0 - 0.31), linewidth=0.6)
                _write(plan, centered(x, box.y0 - 0.39, width_in(words), LINE_IN), words)
            else:
                paper.line((box.x0 - 0.26, y), (box.x0 - 0.31, y), linewidth=0.6)
                wide = width_in(words)
                _write(plan, centered(box.x0 - 0.34 - wide / 2, y, wide, LINE_IN), words)
    words = f"x [{unit.symbol}]"
    _write(plan, centered(box.middle[0], box.y0 - 0.56, width_in(words), LINE_IN), words)
    words = f"y [{unit.symbol}]"
    _write(
        plan,
        centered(box.x0 - 0.62 + width_in(words) / 2, box.y1 + 0.17, width_in(words), LINE_IN),
        words,
    )


def _write(plan: PlanSheet, frame: Frame, words: str) -> None:
    plan.paper.lines(frame, [words])
    plan.paper.placer.take(frame)


def _spine(frame: Frame) -> tuple[Point, Point]:
    """Return the center line of a strip."""
    x, y = frame.middle
    if frame.tall > frame.wide:
        return (x, frame.y0), (x, frame.y1)
    return (frame.x0, y), (frame.x1, y)
