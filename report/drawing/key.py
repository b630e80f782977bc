"""The legend of the plan: north, scale bar, symbols, field notes.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from report.drawing.callouts import draw_ng
from report.drawing.items import Arrow, Look, Mark
from report.drawing.layers import Layer
from report.drawing.notes import notes_of
from report.drawing.paper import BASE_IN, LINE_IN, Paper, wrapped
from report.drawing.placer import Frame, centered
from report.drawing.sheet import PlanSheet
from report.sheet.schema.shapes import Point
from report.words.units import Quantity, round_below

_MEANINGS: dict[Look, str] = {
    Layer.ARRAY: "array, downslope direction",
    Layer.OBJECT: "fixed object",
    Layer.UNLIKE: "unlike array",
    Layer.PARAPET: "roof edge with parapet",
    Layer.EDGE: "roof edge without parapet",
    Layer.BARE_EDGE: "roof edge, not an object",
    Layer.DESIGN: "array displaced by Δ",
    Layer.RUNS: "array in all runs",
    Mark.NUMBER: "clearance, numbered",
    Layer.CLEARANCE_NG: "clearance not satisfied",
}
_LINES = (Layer.PARAPET, Layer.EDGE, Layer.BARE_EDGE)
_SAMPLE_IN = 0.34


def draw_key(plan: PlanSheet, frame: Frame) -> None:
    """Draw the legend, in one column or, in a frame wider than tall, in three."""
    paper, columns = plan.paper, _columns(frame)
    # What is on the plan; the samples come after it.
    drawn = {item.look for item in paper.items if hasattr(item, "look")}
    _north_and_scale(plan, columns[0])
    if not plan.size.is_full:
        return
    symbols, notes = [look for look in _MEANINGS if look in drawn], list(notes_of(plan))
    if len(columns) == 1:
        used = _symbols(paper, columns[0], symbols, 0.95)
        _notes(paper, columns[0], notes, used + 0.1)
        return
    _notes(paper, columns[0], notes[:1], 0.95)
    _symbols(paper, columns[1], symbols, 0.1)
    _notes(paper, columns[2], notes[1:], 0.1)


def _columns(frame: Frame) -> Sequence[Frame]:
    if frame.wide < frame.tall or frame.wide < 3.0:
        return (frame,)
    each = frame.wide / 3
    return [
        Frame(frame.x0 + k * each, frame.y0, frame.x0 + (k + 1) * each - 0.12, frame.y1)
        for k in range(3)
    ]


def _north_and_scale(plan: PlanSheet, frame: Frame) -> None:
    paper, (half, below) = plan.paper, (0.26, 0.46) if frame.tall > 0.6 else (0.15, 0.27)
    x, y = frame.x0 + 0.3, frame.y1 - below
    north = math.radians(plan.assessment.project.roof.north_deg)
    paper.arrow(Layer.NORTH, (x, y), north, half)
    dx, dy = (1.35 * half * f(north) for f in (math.cos, math.sin))
    paper.text(x + dx, y + dy - 0.042125, "N", is_centered=True, is_bold=True)
    _scale_bar(plan, (frame.x0 + 0.75, y - 0.06))


def _scale_bar(plan: PlanSheet, corner: Point) -> None:
    """Draw the scale bar; at a round scale of US units, it is an inch long."""
    paper, unit, (left, base) = plan.paper, plan.fmt.units(Quantity.PLAN)[0], corner
    per_in = paper.scale.m_per_in / unit.si
    is_inch = plan.fmt.us_first and paper.scale.name
    most_in = 1.5 if plan.size.is_screen else 1.05
    whole = per_in if is_inch else round_below(most_in * per_in)
    long = whole / per_in
    for k, look in enumerate((Mark.DARK, Mark.LIGHT)):
        paper.box(look, Frame(left + k * long / 2, base, left + (k + 1) * long / 2, base + 0.06))
    for share in (0.0, 0.5, 1.0):
        words = f"{whole * share:g}" + (f" {unit.symbol}" if share == 1.0 else "")
        paper.text(left + share * long, base - 0.14, words, is_centered=True)
    if paper.scale.name:
        paper.text(left, base + 0.13, paper.scale.name, is_bold=True)


def _symbols(paper: Paper, frame: Frame, symbols: Sequence[Look], used: float) -> float:
    """Draw the symbols below what is used of a column; return how much is used then."""
    x = frame.x0 + 0.05
    for look in symbols:
        y = frame.y1 - used - LINE_IN / 2
        _sample(paper, look, centered(x + _SAMPLE_IN / 2, y, _SAMPLE_IN, 0.11))
        lines = wrapped(_MEANINGS[look], frame.x1 - x - _SAMPLE_IN - 0.1)
        for count, words in enumerate(lines):
            paper.text(x + _SAMPLE_IN + 0.08, y - BASE_IN - count * LINE_IN, words)
        used += len(lines) * LINE_IN + 0.025
    return used


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


def _notes(paper: Paper, frame: Frame, notes: Sequence[str], used: float) -> None:
    for note in notes:
        for words in wrapped(note, frame.wide - 0.1):
            used += LINE_IN
            paper.text(frame.x0 + 0.05, frame.y1 - used, words)
        used += 0.06
