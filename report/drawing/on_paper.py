"""The roof plan on paper, to scale: what is on the roof, how far it may move, every clearance.

Places finished numbers and words; `report.figures.plan` and `report.web.plan` paint them. Read
`plan_on_paper` first. `report.drawing.plan` has the same plan on layers, for CAD.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from report.assessment.project import Assessment
from report.drawing.dimensions import draw_dimensions, draw_numbers
from report.drawing.items import level
from report.drawing.key import draw_key, key_on_paper
from report.drawing.labels import (
    label_array,
    label_edges,
    label_object,
    name_spot,
    reserve_name,
)
from report.drawing.paper import Paper, Scale, round_scale
from report.drawing.placer import Frame, Placer
from report.drawing.schedule import Schedule, alike_arrays, beside, key_tall
from report.drawing.shapes import draw_coordinates, draw_outlines, take_edges
from report.drawing.sheet import A3, A4, LETTER, TABLOID, PlanSheet, PlanSize, unit_format
from report.sheet.schema.choices import PlanPaper
from report.sheet.schema.shapes import Rectangle, around


def plan_on_paper(
    assessment: Assessment,
    size: PlanSize,
    designs: Mapping[str, str] = {},
    *,
    has_verdicts: bool = True,
) -> PlanSheet:
    """Return the plan with its labels, at a round scale, or on a screen as large as it can be.

    Parameters
    ----------
    designs : mapping of str to str, optional
        The design displacement of each array in words.
    """
    extent = _extent(assessment)
    paper, key = _empty(extent, size, _scale(assessment, extent, size))
    plan = PlanSheet(
        assessment=assessment,
        size=size,
        paper=paper,
        designs=designs,
        has_verdicts=has_verdicts,
    )
    if not size.is_full:
        paper.placer.take(key)
    _draw(plan, extent)
    if not size.is_full:
        draw_key(plan, key, paper)
    paper.items.sort(key=level)
    return plan


class PrintedPlan(NamedTuple):
    """The plan, its legend, the tables beside it, and what has no room for a label."""

    size: PlanSize
    plan: Paper
    key: Paper
    beside: Schedule
    unnamed: Sequence[str]


def printed_plan(assessment: Assessment) -> PrintedPlan:
    """Return the plan on the paper asked for, or on the first that has room for all."""
    arrays = alike_arrays(assessment, unit_format(assessment))
    schedules = {size: beside(assessment, arrays, size) for size in _sizes(assessment)}
    # A plan whose schedule has no room beside it need not be drawn.
    roomy = [size for size, rows in schedules.items() if not size.sheet or rows.is_all(assessment)]
    for size in roomy or list(schedules)[-1:]:
        sheet = plan_on_paper(assessment, size)
        if not sheet.unnamed + sheet.crowded:
            break
    return PrintedPlan(size, sheet.paper, key_on_paper(sheet), schedules[size], sheet.unnamed)


def _sizes(assessment: Assessment) -> Sequence[PlanSize]:
    """Return the sizes on the paper asked for, or on any, the smallest first."""
    small, large = (A4, A3) if assessment.project.is_on_a4 else (LETTER, TABLOID)
    large = tuple(replace(size, tall=size.tall - key_tall(assessment, size)) for size in large)
    return {
        PlanPaper.BY_SIZE: (small, *large),
        **dict.fromkeys((PlanPaper.LETTER, PlanPaper.A4), (small,)),
        **dict.fromkeys((PlanPaper.TABLOID, PlanPaper.A3), large),
    }[assessment.project.options.plan_paper]


def _empty(extent: Rectangle, size: PlanSize, scale: Scale) -> tuple[Paper, Frame]:
    """Return the paper with the plan in the middle of what the legend leaves, and its frame."""
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
    names = [reserve_name(plan, array) for array in plan.assessment.arrays]
    spots = [spot for item in plan.placed if (spot := name_spot(plan, item)) is not None]
    for spot in spots:
        plan.paper.placer.take(spot)
    lanes = draw_numbers(plan)
    take_edges(plan)
    if plan.size.is_full or plan.size.is_screen:
        draw_dimensions(plan, lanes)
    for array, name in zip(plan.assessment.arrays, names, strict=True):
        if name is not None:
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


def _scale(assessment: Assessment, extent: Rectangle, size: PlanSize) -> Scale:
    """Return the largest scale that lets the plan fit; on paper, a round one."""
    left, right, bottom, top = size.fringe
    wide = size.wide - left - right - (0.0 if size.is_screen else size.key_wide)
    tall = size.tall - bottom - top - (size.key_tall if size.is_screen else 0.0)
    least = max((extent.x_to_m - extent.x_from_m) / wide, (extent.y_to_m - extent.y_from_m) / tall)
    return (
        Scale("", least) if size.is_screen else round_scale(least, unit_format(assessment).us_first)
    )
