"""The legend of a roof plan: its symbols, north and the scale bar. Read `key_on_paper`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from report.drawing.dimensions import draw_ng
from report.drawing.layers import Layer
from report.drawing.paper_items import Arrow, Look, Mark, width_in
from report.drawing.placer import Frame, Placer, centered
from report.drawing.sheet import BASE_IN, LINE_IN, Paper, PlanSheet
from report.project.model.shapes import Point
from report.text.units import Quantity, round_below

_MEANINGS: dict[Look, str] = {
    Layer.ARRAY: "array, downslope direction",
    Layer.OBJECT: "fixed object",
    Layer.UNLIKE: "array of different construction",
    Layer.PARAPET: "roof edge with parapet",
    Layer.EDGE: "roof edge without parapet",
    Layer.BARE_EDGE: "roof edge, not an object",
    Layer.DESIGN: "array displaced by Δ",
    Layer.RUNS: "array in all runs",
    Mark.NUMBER: "clearance No.",
    Layer.CLEARANCE_NG: "clearance not satisfied",
}
_LINES = (Layer.PARAPET, Layer.EDGE, Layer.BARE_EDGE)
_SAMPLE_IN, _GAP_IN = 0.26, 0.16
_HEAD_IN, _ROW_IN = 1.86, LINE_IN + 0.025  # width of north and the scale bar; of a symbol


def key_on_paper(plan: PlanSheet) -> Paper:
    """Return the legend of a full plan on a paper of its own, as wide as the plan."""
    # What is on the plan; the samples come after it.
    drawn = {item.look for item in plan.paper.items if hasattr(item, "look")}
    symbols = [look for look in _MEANINGS if look in drawn]
    rows = _rows(symbols, plan.size.wide)
    frame = Frame(0.0, 0.0, plan.size.wide, rows * _ROW_IN)
    key = replace(plan.paper, tall=frame.tall, placer=Placer(frame), items=[])
    draw_key(plan, frame, key)
    x = _HEAD_IN
    for start in range(0, len(symbols), rows):
        column = symbols[start : start + rows]
        for count, look in enumerate(column):
            y = frame.tall - (count + 0.5) * _ROW_IN
            _sample(key, look, centered(x + _SAMPLE_IN / 2, y, _SAMPLE_IN, 0.11))
            key.text(x + _SAMPLE_IN + 0.06, y - BASE_IN, _MEANINGS[look])
        x += _column_in(column)
    return key


def _rows(symbols: Sequence[Look], wide_in: float) -> int:
    """Return the fewest rows, three or more, whose columns are as wide as the plan or less."""
    # As tall as north and the scale bar beside them.
    rows = 3
    while rows < len(symbols):
        columns = (symbols[start : start + rows] for start in range(0, len(symbols), rows))
        if _HEAD_IN + sum(map(_column_in, columns)) - _GAP_IN <= wide_in:
            break
        rows += 1
    return rows


def _column_in(column: Sequence[Look]) -> float:
    return max(width_in(_MEANINGS[look]) for look in column) + _SAMPLE_IN + _GAP_IN


def draw_key(plan: PlanSheet, frame: Frame, paper: Paper) -> None:
    """Draw north and the scale bar."""
    half, (x, y) = 0.15, (frame.x0 + 0.3, frame.y1 - 0.29)
    north = math.radians(plan.assessment.project.roof.north_deg)
    paper.arrow(Layer.NORTH, (x, y), north, half)
    dx, dy = (1.35 * half * f(north) for f in (math.cos, math.sin))
    paper.text(x + dx, y + dy - 0.042125, "N", is_centered=True, is_bold=True)
    _scale_bar(plan, (frame.x0 + 0.62, y - 0.04), paper)


def _scale_bar(plan: PlanSheet, corner: Point, paper: Paper) -> None:
    """Draw the scale bar; at a round scale of US units, it is an inch long."""
    unit, (left, base) = plan.fmt.units(Quantity.PLAN)[0], corner
    per_in = paper.scale.m_per_in / unit.si
    is_inch = plan.fmt.us_first and paper.scale.name
    most_in = 1.5 if plan.size.is_screen else 1.05
    length = per_in if is_inch else round_below(most_in * per_in)
    long = length / per_in
    for k, look in enumerate((Mark.DARK, Mark.LIGHT)):
        paper.box(look, Frame(left + k * long / 2, base, left + (k + 1) * long / 2, base + 0.06))
    for share in (0.0, 0.5, 1.0):
        words = f"{length * share:g}" + (f" {unit.symbol}" if share == 1.0 else "")
        paper.text(left + share * long, base - 0.14, words, is_centered=True)
    if paper.scale.name:
        paper.text(left, base + 0.13, paper.scale.name, is_bold=True)


def _sample(paper: Paper, look: Look, frame: Frame) -> None:
    (x, y), ends = frame.middle, ((frame.x0, frame.middle[1]), (frame.x1, frame.middle[1]))
    if look in _LINES:
        paper.lines(look, ends)
    elif look is Mark.NUMBER:
        paper.dimension(Layer.CLEARANCE, *ends)
        paper.circle(Mark.NUMBER_SAMPLE, (x, y), 0.06)
    elif look is Layer.CLEARANCE_NG:
        paper.box(Mark.FAILED, frame)
        draw_ng(paper, (x, y))
    else:
        paper.box(look, frame)
    if look is Layer.ARRAY:
        paper.items.append(
            Arrow(look=Mark.SLOPE_SAMPLE, tail=(x, frame.y1), tip=(x, frame.y0 - 0.02))
        )
