"""The names of arrays, objects and edges on the roof plan. Read `report.drawing.on_paper` first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.support.plan_gaps import parapet_note
from report.drawing.paper_items import Mark, width_in
from report.drawing.placer import Frame, centered
from report.drawing.plan_tables import size_words
from report.drawing.sheet import LINE_IN, PAD_IN, PlanSheet, text_size
from report.project.model.choices import ObjectKind
from report.project.model.roof import RoofObject
from report.project.model.shapes import Point, Rectangle
from report.text.units import Quantity, no_less, number, pair, with_unit

ARROW_IN, SCREEN_ARROW_IN = 0.3, 0.2
_BASE_IN = 0.0625  # from the middle of a line along an edge to its baseline


def label_edges(plan: PlanSheet, extent: Rectangle) -> None:
    """Write the name and height of each edge along it, outside of the roof."""
    middle = plan.paper.frame(extent).middle
    for item in plan.edges:
        shape, name = plan.shapes[item.id], " ".join(plan.name_lines(item.id))
        if item.kind is ObjectKind.EDGE_WITHOUT_PARAPET:
            words = f"{name}: no parapet"
        else:
            height_m = math.nan if item.height_m is None else item.height_m
            height = pair(height_m, Quantity.SIZE, plan.fmt.us_first)
            words = f"{name}: parapet {height}{parapet_note(plan.assessment, item)}"
        if not isinstance(shape, Rectangle):
            plan.name_beside(plan.room(item.id), [words])
            continue
        frame = plan.paper.frame(shape)
        if width_in(words) > max(frame.wide, frame.tall) or not plan.size.is_full:
            words = name
        label, is_upright = along_strip(frame, middle, width_in(words))
        x, y = label.middle
        base = (x + _BASE_IN, y) if is_upright else (x, y - _BASE_IN)
        plan.paper.placer.take(label)
        plan.paper.text(*base, words, is_centered=True, is_upright=is_upright)


def along_strip(frame: Frame, middle: Point, wide: float) -> tuple[Frame, bool]:
    """Return the frame of text next to a strip, away from a point; whether it reads from below."""
    (x, y), aside = frame.middle, 0.05 + LINE_IN / 2
    if frame.tall > frame.wide:
        x = frame.x1 + aside if x > middle[0] else frame.x0 - aside
        return centered(x, y, LINE_IN, wide), True
    y = frame.y1 + aside if y > middle[1] else frame.y0 - aside
    return centered(x, y, wide, LINE_IN), False


def reserve_name(plan: PlanSheet, array: ArrayAssessment) -> Frame | None:
    """Reserve room for the name of an array, if possible for its label; None if that is written."""
    # On a screen it comes before the clearances.
    if plan.size.is_screen and _label_in_middle(plan, array):
        return None
    labels = list(_array_labels(plan, array))
    (wide, tall), name = (text_size(lines, first_bold=True) for lines in (labels[0], labels[-1]))
    middle = plan.room(array.id).middle
    # Only avoided: the full label gives way to a clearance, the name alone does not.
    plan.paper.placer.avoid(centered(*middle, wide + ARROW_IN, tall))
    reserved = centered(*middle, *name)
    plan.paper.placer.take(reserved)
    return reserved


def _label_in_middle(plan: PlanSheet, array: ArrayAssessment) -> bool:
    """Write as much of a label as fits in the middle of its array; return whether any fits."""
    frame = plan.room(array.id)
    for lines, arrow in product(_array_labels(plan, array), (SCREEN_ARROW_IN, 0.0)):
        wide, tall = text_size(lines, first_bold=True)
        if wide - PAD_IN < frame.wide and tall + arrow < frame.tall:
            label = centered(*frame.middle, wide, tall + arrow)
            _write(plan, array, label, lines, 0.0, arrow)
            foot = label.y0 + arrow
            plan.paper.placer.take(Frame(label.x0, foot, label.x1, label.y1))
            plan.paper.placer.take(centered(label.middle[0], foot - arrow / 2, PAD_IN, arrow))
            return True
    return False


def label_array(plan: PlanSheet, array: ArrayAssessment, name: Frame) -> None:
    """Label an array inside its outline with as many lines as fit, or outside."""
    frame, labels = plan.room(array.id), list(_array_labels(plan, array))
    places = [*product(labels, ((ARROW_IN, 0.0), (0.0, ARROW_IN))), (labels[-1], (0.0, 0.0))]
    # From the fullest label to the name alone, each with its arrow beside and below.
    for lines, (aside, below) in places:
        wide, tall = text_size(lines, first_bold=True)
        label = plan.paper.placer.place(wide + aside, tall + below, frame.middle, _inner(frame))
        if label is not None:
            _write(plan, array, label, lines, aside, below)
            break
    else:
        lines = []
        if frame.wide < name.wide or frame.tall < name.tall:
            plan.name_beside(frame, labels[-1])
        else:
            plan.paper.placer.take(name)
            plan.paper.label(name, labels[-1], first_bold=True)
    if len(lines) < min(3, len(labels[0])):
        plan.crowded.append(array.id)


def _write(
    plan: PlanSheet,
    array: ArrayAssessment,
    label: Frame,
    lines: Sequence[str],
    aside: float,
    below: float,
) -> None:
    """Write the lines of a label, with its arrow, if it has one, to the right of them or below."""
    text = Frame(label.x0, label.y0 + below, label.x1 - aside, label.y1)
    plan.paper.label(text, lines, first_bold=True)
    if aside or below:
        foot = label.middle[0], label.y0 + below / 2
        center = (label.x1 - aside / 2, label.middle[1]) if aside else foot
        downslope = math.radians(array.array.downslope_deg)
        plan.paper.arrow(Mark.SLOPE, center, downslope, 0.45 * max(aside, below))


def _array_labels(plan: PlanSheet, array: ArrayAssessment) -> Iterator[list[str]]:
    """Yield the lines of an array's label, then fewer for less room."""
    name, fmt, says = plan.name_lines(array.id), plan.fmt, [plan.fmt.short]
    # The browser page has a text for each, and no room for more.
    if plan.designs:
        yield [*name, f"Δ {plan.designs[array.id]}"]
        yield [*name]
        return
    if plan.size.is_full:
        says.insert(0, fmt.both)
    moves = [
        f"Δ {say(array.design_m, Quantity.SIZE, no_less)}{array.overridden.design}" for say in says
    ]
    if math.isnan(array.permitted_m):
        moves = [f"Δ {NOT_PERMITTED}" if array.has_unpermitted_value else "no value"]
    if plan.size.is_full:
        unit = fmt.units(Quantity.PLAN)[0]
        size = with_unit(size_words(array.array.shape, fmt), unit.symbol)
        slope = f"slope {number(math.degrees(array.array.slope_rad), 2)}°"
        yield from ([*name, words, size, slope] for words in moves)
        yield from ([*name, words, size] for words in moves)
    yield from ([*name, words] for words in moves)
    yield [*name]


def name_spot(plan: PlanSheet, item: RoofObject) -> Frame | None:
    """Return the position of an object's name in its middle, if it fits."""
    frame = plan.room(item.id)
    wide, tall = text_size(plan.name_lines(item.id))
    is_room = wide < frame.wide and tall < frame.tall
    return centered(*frame.middle, wide, tall) if is_room else None


def own_frame(plan: PlanSheet, item: RoofObject) -> Frame | None:
    """Return the frame of an object that has no room for its name; None for others."""
    shape = plan.shapes[item.id]
    is_small = isinstance(shape, Rectangle) and name_spot(plan, item) is None
    return plan.paper.frame(shape) if is_small and isinstance(shape, Rectangle) else None


def label_object(plan: PlanSheet, item: RoofObject) -> None:
    """Write the name of an object inside its outline, or next to it with a leader."""
    frame = plan.room(item.id)
    lines = plan.name_lines(item.id)
    wide, tall = text_size(lines)
    label = plan.paper.placer.place(wide, tall, frame.middle, _inner(frame))
    if label is None:
        object_frame = own_frame(plan, item)
        # The leader to its name begins in it.
        if object_frame:
            plan.paper.placer.release(object_frame)
        plan.name_beside(frame, lines)
        if object_frame:
            plan.paper.placer.take(object_frame)
        return
    plan.paper.box(Mark.BACKING, label)
    plan.paper.label(label, lines)


def _inner(frame: Frame) -> Frame:
    return Frame(frame.x0 + 0.03, frame.y0 + 0.03, frame.x1 - 0.03, frame.y1 - 0.03)
