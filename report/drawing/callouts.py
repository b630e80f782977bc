"""The clearances of the plan on a screen: a label each, with provided and required separation.

`report.drawing.dimensions` has those on paper. Read `report.drawing.on_paper` first.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.drawing.items import Mark
from report.drawing.layers import Layer
from report.drawing.paper import BASE_IN, Paper, text_size
from report.drawing.placer import Frame, centered
from report.drawing.sheet import Gap, PlanSheet
from report.drawing.widths import TYPE_PT, width_in
from report.entities.clearance import callout
from report.sheet.schema.shapes import Point, between

RADIUS_IN = 0.1
NG_TALL_IN = TYPE_PT / 72.0 + 0.03


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
    above = 2 * RADIUS_IN if gap.of.is_given else 0.0
    below = NG_TALL_IN + 0.02 if gap.of.is_ng else 0.0
    beside = max(above, ng_wide()) + 0.02
    for shown in (callout(gap.of, plan.fmt), ()):
        wide, tall = text_size(shown) if shown else (0.0, 0.0)
        label = plan.paper.placer.place(
            beside + wide,
            max(tall, above + below, 2 * RADIUS_IN),
            gap.middle,
            maximum=4.0 if gap.of.is_ng and not shown else plan.leader_in,
        )
        if label is not None:
            _draw_callout(plan, gap, label, label.x0 + beside, shown)
            return
    plan.unnamed.append(gap.name)


def _draw_callout(
    plan: PlanSheet, gap: Gap, label: Frame, text_x0: float, shown: Sequence[str]
) -> None:
    paper, is_ng = plan.paper, plan.is_ng(gap)
    x, y = (label.x0 + text_x0) / 2, label.middle[1]
    is_alone = gap.of.is_given and not shown
    plan.leader(gap.middle, centered(x, y, RADIUS_IN, RADIUS_IN) if is_alone else label)
    if shown:
        paper.box(Mark.FRAME, label)
        paper.label(Frame(text_x0, label.y0, label.x1, label.y1), shown)
    if gap.of.is_given:
        draw_number(paper, (x, y + (NG_TALL_IN / 2 if is_ng else 0.0)), gap)
    if is_ng:
        draw_ng(paper, (x, y - (RADIUS_IN if gap.of.is_given else 0.0)))


def draw_number(paper: Paper, middle: Point, gap: Gap) -> None:
    """Draw the number of a clearance in its circle."""
    paper.circle(Mark.NUMBER, middle, RADIUS_IN - 0.01)
    paper.text(middle[0], middle[1] - BASE_IN, str(gap.of.number), is_centered=True)


def draw_ng(paper: Paper, middle: Point) -> None:
    """Draw the mark of a gap that is not satisfied about a point: white on black."""
    x, y = middle
    paper.box(Mark.NG, centered(x, y, ng_wide(), NG_TALL_IN))
    paper.text(x, y - 0.038, "NG", is_centered=True, is_bold=True, is_light=True)


def ng_wide() -> float:
    """Return the width of the mark of a gap that is not satisfied [in]."""
    return width_in("NG", is_bold=True) + 0.06
