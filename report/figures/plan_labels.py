"""The names on the roof plan: of arrays with their displacement, of objects and of edges.

Read `report.figures.plan` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.assessment.arrays import NOT_PERMITTED, ArrayAssessment
from report.assessment.envelopes import keep_clear_m, keep_clear_mark, keep_clear_words
from report.assessment.plan_gaps import parapet_note
from report.figures.base import tick_text
from report.figures.labels import LINE_IN, Frame, centered, width_in
from report.figures.paper_plan import text_size
from report.figures.plan_sheet import PlanSheet
from report.sheet.schema import ObjectKind, Rectangle, RoofObject
from report.words.units import number

ARROW_IN = 0.3


def label_edges(plan: PlanSheet, extent: Rectangle) -> None:
    """Write the name and height of each edge along it, outside of the roof."""
    middle = plan.paper.frame(extent).middle
    for item in plan.edges:
        shape, words = plan.shapes[item.id], _edge_words(plan, item)
        if not isinstance(shape, Rectangle):
            plan.beside(plan.room(item.id), words)
            continue
        frame = plan.paper.frame(shape)
        if width_in(words) > max(frame.wide, frame.tall) or not plan.size.is_full:
            words = tick_text(item.id)
        (x, y), wide = frame.middle, width_in(words)
        is_upright = frame.tall > frame.wide
        aside = 0.05 + LINE_IN / 2
        if is_upright:
            x = frame.x1 + aside if x > middle[0] else frame.x0 - aside
            label = centered(x, y, LINE_IN, wide)
        else:
            y = frame.y1 + aside if y > middle[1] else frame.y0 - aside
            label = centered(x, y, wide, LINE_IN)
        plan.paper.placer.take(label)
        plan.paper.text(x, y, words, ha="center", va="center_baseline",
                        rotation=90 if is_upright else 0, rotation_mode="anchor")  # fmt: skip


def _edge_words(plan: PlanSheet, item: RoofObject) -> str:
    if item.kind is ObjectKind.EDGE_WITHOUT_PARAPET:
        return f"{tick_text(item.id)}: no parapet"
    height = math.nan if item.height_m is None else item.height_m
    note = parapet_note(plan.assessment, item)
    return f"{tick_text(item.id)}: parapet {plan.both(height)}{note}"


def reserve_name(plan: PlanSheet, array: ArrayAssessment) -> Frame:
    """Keep room for the name of an array, and where possible for all of its label."""
    middle = plan.room(array.id).middle
    shown = list(_array_labels(plan, array))
    whole, name = (text_size(lines, first_bold=True) for lines in (shown[0], shown[-1]))
    plan.paper.placer.avoid(centered(*middle, whole[0], whole[1] + ARROW_IN))
    reserved = centered(*middle, *name)
    plan.paper.placer.take(reserved)
    return reserved


def label_array(plan: PlanSheet, array: ArrayAssessment, name: Frame) -> None:
    """Label an array inside of it with as many lines as there is room for, or outside."""
    frame = plan.room(array.id)
    shown = [(lines, ARROW_IN) for lines in _array_labels(plan, array)]
    for lines, arrow in (*shown, (shown[-1][0], 0.0)):
        wide, tall = text_size(lines, first_bold=True)
        label = plan.paper.placer.place(wide, tall + arrow, frame.middle, _inner(frame))
        if label is not None:
            above = Frame(label.x0, label.y0 + arrow, label.x1, label.y1)
            plan.paper.lines(above, lines, first_bold=True)
            if arrow:
                _slope_arrow(plan, label.middle[0], label.y0 + arrow / 2, array)
            return
    if frame.wide < name.wide or frame.tall < name.tall:
        plan.beside(frame, tick_text(array.id))
    else:
        plan.paper.placer.take(name)
        plan.paper.lines(name, [tick_text(array.id)], first_bold=True)


def _array_labels(plan: PlanSheet, array: ArrayAssessment) -> Iterator[list[str]]:
    """Yield the lines of an array's label, then fewer where there is less room."""
    name, slope = tick_text(array.id), math.degrees(array.array.slope_rad)
    if math.isnan(array.permitted_m):
        yield [name, f"Δ {NOT_PERMITTED}" if array.has_unpermitted_value else "no value"]
    elif plan.size.is_full:
        moves = f"Δ {plan.both(array.design_m)}{array.design_mark}"
        keep = keep_clear_words(keep_clear_m(plan.assessment, array), plan.us_first)
        keep += keep_clear_mark(plan.assessment, array)
        yield [name, moves, keep, "no conduit", f"slope {number(slope, 2)}°"]
        yield [name, moves, keep]
    if not math.isnan(array.permitted_m):
        yield [name, f"Δ {plan.first(array.design_m)}{array.design_mark}"]
    yield [name]


def _slope_arrow(plan: PlanSheet, x: float, y: float, array: ArrayAssessment) -> None:
    turn = math.radians(array.array.downslope_deg)
    dx, dy = 0.45 * ARROW_IN * math.cos(turn), 0.45 * ARROW_IN * math.sin(turn)
    plan.paper.arrow((x - dx, y - dy), (x + dx, y + dy), linewidth=1.0)


def name_spot(plan: PlanSheet, item: RoofObject) -> Frame | None:
    """Return where the name of an object fits in the middle of it, if it does."""
    frame = plan.room(item.id)
    wide, tall = text_size([tick_text(item.id)])
    is_room = wide < frame.wide and tall < frame.tall
    return centered(*frame.middle, wide, tall) if is_room else None


def label_object(plan: PlanSheet, item: RoofObject) -> None:
    """Name an object inside of it, or beside it with a leader."""
    frame = plan.room(item.id)
    words = tick_text(item.id)
    wide, tall = text_size([words])
    label = plan.paper.placer.place(wide, tall, frame.middle, _inner(frame))
    if label is None:
        plan.beside(frame, words)
        return
    plan.paper.box(label, facecolor="white", edgecolor="none", zorder=2)
    plan.paper.lines(label, [words])


def _inner(frame: Frame) -> Frame:
    return Frame(frame.x0 + 0.03, frame.y0 + 0.03, frame.x1 - 0.03, frame.y1 - 0.03)
