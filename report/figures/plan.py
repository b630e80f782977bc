"""The roof plan, to scale: what is on the roof, how far it may move, and every clearance.

Draws finished numbers; read `plan_figure` first. `report.drawing` writes the same plan as DXF.
"""

from __future__ import annotations

from matplotlib.figure import Figure

from report.assessment.project import Assessment
from report.figures.base import style, svg_text
from report.figures.labels import Frame
from report.figures.paper_plan import PlanPaper, round_scale
from report.figures.plan_dimensions import draw_callout, draw_gap
from report.figures.plan_key import draw_key
from report.figures.plan_labels import (
    label_array,
    label_edges,
    label_object,
    name_spot,
    reserve_name,
)
from report.figures.plan_notes import key_of
from report.figures.plan_shapes import draw_arrays, draw_coordinates, draw_objects, draw_roof
from report.figures.plan_sheet import LANDSCAPE, PORTRAIT, PlanSheet, PlanSize, is_us_first
from report.sheet.schema import Rectangle
from report.sheet.schema.shapes import around


def is_wide(assessment: Assessment) -> bool:
    """Whether the large plan goes on a page in landscape: for a larger scale, or a wide roof."""
    extent, us_first = _extent(assessment), is_us_first(assessment)
    flat, tall = (
        round_scale(_needed(extent, size), us_first).m_per_in for size in (LANDSCAPE, PORTRAIT)
    )
    if flat == tall:
        return extent.x_to_m - extent.x_from_m >= extent.y_to_m - extent.y_from_m
    return flat < tall


def roof_plan(assessment: Assessment, size: PlanSize) -> str:
    """Return the plan as SVG, at true scale where it is printed in its own size."""
    with style():
        return svg_text(plan_figure(assessment, size))


def plan_figure(assessment: Assessment, size: PlanSize) -> Figure:
    """Draw the plan at a round scale."""
    extent = _extent(assessment)
    us_first = is_us_first(assessment)
    scale = round_scale(_needed(extent, size), us_first)
    left, right, bottom, top = size.fringe
    wide = (extent.x_to_m - extent.x_from_m) / scale.m_per_in
    tall = (extent.y_to_m - extent.y_from_m) / scale.m_per_in
    below = size.key_tall if size.is_key_below else 0.0
    height = max(tall + bottom + top + below, size.key_tall)
    room = size.wide - (0.0 if size.is_key_below else size.key_wide) - left - right
    origin = (
        left + max(room - wide, 0.0) / 2 - extent.x_from_m / scale.m_per_in,
        below + bottom + (height - below - bottom - top - tall) / 2
        - extent.y_from_m / scale.m_per_in,
    )  # fmt: skip
    paper = PlanPaper(size.wide, height, scale, origin)
    plan = PlanSheet.of(assessment, size, paper)
    key = Frame(size.wide - size.key_wide, 0.0, size.wide, size.key_tall if below else height)
    paper.placer.take(key)
    _draw(plan, extent)
    draw_key(paper, key, key_of(plan))
    return paper.figure


def _draw(plan: PlanSheet, extent: Rectangle) -> None:
    """Draw everything; labels last, the least movable first."""
    draw_roof(plan)
    draw_arrays(plan)
    draw_objects(plan)
    for gap in plan.gaps:
        draw_gap(plan, gap)
    if plan.size.is_full:
        draw_coordinates(plan, extent)
    label_edges(plan, extent)
    names = [reserve_name(plan, array) for array in plan.assessment.arrays]
    spots = [spot for item in plan.placed if (spot := name_spot(plan, item)) is not None]
    for spot in spots:
        plan.paper.placer.take(spot)
    for gap in sorted(plan.gaps, key=lambda gap: not gap.of.is_ng):
        draw_callout(plan, gap)
    for array, name in zip(plan.assessment.arrays, names, strict=True):
        plan.paper.placer.release(name)
        label_array(plan, array, name)
    for spot in spots:
        plan.paper.placer.release(spot)
    for item in plan.placed:
        label_object(plan, item)


def _extent(assessment: Assessment) -> Rectangle:
    """Return what the plan must show, in plan."""
    data = assessment.project
    rows = (*data.arrays, *data.objects, data.roof)
    return around(row.placed for row in rows if row.placed is not None)


def _needed(extent: Rectangle, size: PlanSize) -> float:
    """Return the least plan length [m] per inch of paper that lets the plan fit."""
    left, right, bottom, top = size.fringe
    wide = size.wide - left - right - (0.0 if size.is_key_below else size.key_wide)
    tall = size.tall - bottom - top - (size.key_tall if size.is_key_below else 0.0)
    return max((extent.x_to_m - extent.x_from_m) / wide, (extent.y_to_m - extent.y_from_m) / tall)
