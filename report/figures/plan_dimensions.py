"""The clearances of the roof plan: a dimension line each, numbered, provided and required.

Read `report.figures.plan` first.
"""

from __future__ import annotations

from collections.abc import Sequence

from report.entities.clearance import callout
from report.entities.columns import UnitFormat
from report.figures.base import GRAY, INK
from report.figures.labels import Frame
from report.figures.paper_plan import PAD_IN, text_size
from report.figures.plan_key import FAILED, gap_line, ng_box, ng_size
from report.figures.plan_sheet import Gap, PlanSheet
from report.sheet.schema.shapes import between

RADIUS_IN = 0.1


def draw_gap(plan: PlanSheet, gap: Gap) -> None:
    """Draw a dimension line; a gap that is not satisfied is hatched."""
    if gap.of.is_ng:
        area = between(gap.of.near, gap.of.far)
        if area is not None:
            plan.paper.shape(area, **FAILED)
    gap_line(plan.paper, gap.a, gap.b)
    plan.paper.placer.take_segment(gap.a, gap.b)


def draw_callout(plan: PlanSheet, gap: Gap) -> None:
    """Label a gap: number, provided and required separation; the number if tight."""
    lines = callout(gap.of, UnitFormat(us_first=plan.us_first, none="no value"))
    for shown in (lines, ()) if plan.size.is_full else ((),):
        wide, tall = text_size(shown) if shown else (0.0, 2 * RADIUS_IN)
        mark = ng_size()[0] + PAD_IN if gap.of.is_ng else 0.0
        label = plan.paper.placer.place(
            wide + _circle(gap) + mark,
            max(tall, 2 * RADIUS_IN),
            gap.middle,
            maximum=4.0 if gap.of.is_ng and not shown else plan.leader_in,
        )
        if label is not None:
            _draw_callout(plan, gap, label, shown, mark)
            return
    plan.unnamed.append(_name(gap))


def _circle(gap: Gap) -> float:
    """Return the width [in] of the number, which a gap without a clearance does not have."""
    return 2 * RADIUS_IN if gap.of.is_given else 0.04


def _name(gap: Gap) -> str:
    return f"clearance {gap.of.number}" if gap.of.is_given else f"{gap.of.array} to {gap.of.other}"


def _draw_callout(
    plan: PlanSheet, gap: Gap, label: Frame, shown: Sequence[str], mark: float
) -> None:
    paper, y = plan.paper, label.middle[1]
    plan.leader(gap.middle, label)
    if shown:
        paper.box(label, facecolor="white", edgecolor=GRAY, linewidth=0.4, zorder=2)
        paper.lines(Frame(label.x0 + _circle(gap), label.y0, label.x1 - mark, label.y1), shown)
    if gap.of.is_given:
        center = label.x0 + RADIUS_IN, y
        paper.circle(center, RADIUS_IN - 0.01, facecolor="white", edgecolor=INK, linewidth=0.7,
                     zorder=2)  # fmt: skip
        paper.text(center[0], y - 0.04, str(gap.of.number), ha="center")
    if mark:
        ng_box(paper, label.x1 - ng_size()[0] / 2 - 0.01, y)
