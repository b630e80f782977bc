"""The clearances of the roof plan: a dimension line each, numbered, provided and required.

Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from report.drawing.items import Mark
from report.drawing.layers import Layer
from report.drawing.paper import BASE_IN, PAD_IN, Paper, text_size
from report.drawing.placer import Frame, centered
from report.drawing.sheet import Gap, PlanSheet
from report.drawing.widths import TYPE_PT, width_in
from report.entities.clearance import callout
from report.sheet.schema.shapes import Point, between

RADIUS_IN = 0.1
_NG_TALL_IN = TYPE_PT / 72.0 + 0.03


def draw_gap(plan: PlanSheet, gap: Gap) -> None:
    """Draw a dimension line; a gap that is not satisfied is hatched."""
    is_ng = plan.is_ng(gap)
    area = between(gap.of.near, gap.of.far) if is_ng else None
    if area is not None:
        plan.paper.shape(Mark.FAILED, area.points)
    plan.paper.dimension(Layer.CLEARANCE_NG if is_ng else Layer.CLEARANCE, gap.a, gap.b)
    plan.paper.placer.take_segment(gap.a, gap.b)


def draw_callout(plan: PlanSheet, gap: Gap) -> None:
    """Label a gap: number, provided and required separation; the number if tight."""
    lines, beside = callout(gap.of, plan.fmt), _beside(plan, gap)
    for shown in (lines, ()) if plan.has_dimensions else ((),):
        wide, tall = text_size(shown) if shown else (0.0, 0.0)
        label = plan.paper.placer.place(
            beside.left + wide + beside.right,
            max(tall, beside.tall),
            gap.middle,
            maximum=4.0 if gap.of.is_ng and not shown else plan.leader_in,
        )
        if label is not None:
            _draw_callout(plan, gap, label, shown)
            return
    plan.unnamed.append(_name(gap))


class _Beside(NamedTuple):
    """Room [in] for number and mark NG to the left and right of the text, and their height."""

    left: float
    right: float
    tall: float


def _beside(plan: PlanSheet, gap: Gap) -> _Beside:
    """Return the room beside the text; on a screen the mark NG has its room below the number."""
    number = 2 * RADIUS_IN if gap.of.is_given else 0.04
    if plan.size.is_screen:
        above = 2 * RADIUS_IN if gap.of.is_given else 0.0
        below = _NG_TALL_IN + 0.02 if gap.of.is_ng else 0.0
        return _Beside(max(number, _ng_wide()) + 0.02, 0.0, max(above + below, 2 * RADIUS_IN))
    return _Beside(number, _ng_wide() + PAD_IN if gap.of.is_ng else 0.0, 2 * RADIUS_IN)


def _name(gap: Gap) -> str:
    return f"clearance {gap.of.number}" if gap.of.is_given else f"{gap.of.array} to {gap.of.other}"


def _draw_callout(plan: PlanSheet, gap: Gap, label: Frame, shown: Sequence[str]) -> None:
    paper, beside, is_ng = plan.paper, _beside(plan, gap), plan.is_ng(gap)
    x, y = label.x0 + beside.left / 2, label.middle[1]
    ng = (label.x1 - _ng_wide() / 2 - 0.01, y)
    if plan.size.is_screen:  # number and mark one over the other
        ng = (x, y - (RADIUS_IN if gap.of.is_given else 0.0))
    is_alone = plan.size.is_screen and gap.of.is_given and not shown
    plan.leader(gap.middle, centered(x, y, RADIUS_IN, RADIUS_IN) if is_alone else label)
    if shown:
        paper.box(Mark.FRAME, label)
        text = Frame(label.x0 + beside.left, label.y0, label.x1 - beside.right, label.y1)
        paper.label(text, shown)
    if gap.of.is_given:
        above = y + (_NG_TALL_IN / 2 if is_ng and plan.size.is_screen else 0.0)
        paper.circle(Mark.NUMBER, (x, above), RADIUS_IN - 0.01)
        paper.text(x, above - BASE_IN, str(gap.of.number), is_centered=True)
    if is_ng:
        draw_ng(paper, ng)


def draw_ng(paper: Paper, middle: Point) -> None:
    """Draw the mark of a gap that is not satisfied about a point: white on black."""
    x, y = middle
    paper.box(Mark.NG, centered(x, y, _ng_wide(), _NG_TALL_IN))
    paper.text(x, y - 0.038, "NG", is_centered=True, is_bold=True, is_light=True)


def _ng_wide() -> float:
    return width_in("NG", is_bold=True) + 0.06
