"""The clearances of a plan, numbered in their gaps, and equal ones dimensioned once.

    [ A1 ]<--(3)-->[ RTU-1 ]    3: the row of the schedule

Required separations are in a table beside the plan. Read `draw_numbers` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from report.assessment.support.plan_gaps import PlanGap
from report.drawing.layers import Layer
from report.drawing.paper_items import TYPE_PT, Mark, width_in
from report.drawing.placer import Frame, Placer, centered
from report.drawing.sheet import BASE_IN, LINE_IN, Gap, Paper, PlanSheet
from report.project.model.shapes import Point, Rectangle, between
from report.text.amounts import capacity, demand, shown_in_order
from report.text.grouping import grouped_by
from report.text.names import joined
from report.text.unit_format import UnitFormat
from solver.rules.provisions import Neighbor

RADIUS_IN = 0.1
NG_TALL_IN = TYPE_PT / 72.0 + 0.03
_STEP_IN = 0.06  # by which a label slides
# Less is rounding error: the gap lies along an axis of the paper.
_ALIGNED_IN = 1e-6
_MOST_NAMED = 4  # gaps of several kinds that one dimension names
_OVERHANG_IN = 0.6  # of a dimension beyond the facing sides, where they are short


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """Line on which labels of a gap may move: through its middle, along the facing sides."""

    gap: Gap
    along: Point  # of length 1
    half: float  # of the facing sides [in]; 0 where corners are the nearest
    number: Frame  # of its label, as far as it is placed

    @property
    def is_upright(self) -> bool:
        """Whether text along the lane reads from below."""
        # Steeper than 64°, arcsin 0.9.
        return abs(self.along[1]) > 0.9

    @property
    def narrow(self) -> float:
        """A width across that is within the gap [in]."""
        return max(math.dist(self.gap.a, self.gap.b) - 0.03, 0.01)

    def frame(self, shift: float, long: float, across: float) -> Frame:
        """Return the frame of a label at a distance along the lane."""
        (x, y), (dx, dy) = self.gap.middle, self.along
        wide, tall = (across, long) if self.is_upright else (long, across)
        return centered(x + shift * dx, y + shift * dy, wide, tall)


def draw_numbers(plan: PlanSheet) -> Sequence[Lane]:
    """Draw the gaps with their numbers, those not satisfied first."""
    # What is NG must find its place; the rest may have a leader.
    first = sorted(plan.gaps, key=lambda gap: not plan.is_ng(gap))
    return [_numbered(plan, lane_of(plan.paper, gap)) for gap in first]


def draw_dimensions(plan: PlanSheet, lanes: Sequence[Lane]) -> None:
    """Write the provided clearance, once for all equal gaps; if types differ, for which."""
    for provided, equal in grouped_by(lanes, lambda lane: _provided(plan, lane.gap)).items():
        # `typ.` on a drawing means that the others are the same: of another factor they are not,
        # though they measure the same.
        kinds = grouped_by(equal, lambda lane: _kind(plan, lane.gap))
        if len(kinds) > 1 and len(equal) <= _MOST_NAMED:
            numbers = sorted(lane.gap.of.number for lane in equal)
            _dimension(plan, f"{provided}: No. {joined([*map(str, numbers)])}", equal)
            continue
        for some in kinds.values():
            _dimension(plan, f"{provided} typ. of {len(some)}" if some[1:] else provided, some)


def _kind(plan: PlanSheet, gap: Gap) -> Neighbor | None:
    """Return the item across a clearance; None for a gap without one."""
    plan_gap = gap.of
    return plan.assessment.clearances[plan_gap.number - 1].neighbor if plan_gap.is_given else None


def lane_of(paper: Paper, gap: Gap) -> Lane:
    """Return the lane of a gap."""
    dx, dy = gap.b[0] - gap.a[0], gap.b[1] - gap.a[1]
    long = math.hypot(dx, dy)
    # A quarter turn from the gap: a label slides along the facing sides, and stays between them.
    along = (-dy / long, dx / long) if long else (1.0, 0.0)
    area = between(gap.of.near, gap.of.far)
    # Between two corners nothing faces: a label has no way to slide.
    is_diagonal = isinstance(area, Rectangle) and min(abs(dx), abs(dy)) > _ALIGNED_IN
    reach = [0.0]
    if area is not None and long and not is_diagonal:
        reach = [x * along[0] + y * along[1] for x, y in map(paper.at, area.points)]
    half = (max(reach) - min(reach)) / 2
    return Lane(gap=gap, along=along, half=half, number=centered(*gap.middle, 0.0, 0.0))


def _steps(start: float, end: float) -> Iterator[float]:
    """Yield distances on both sides, the nearest first."""
    for step in range(max(math.floor((end - start) / _STEP_IN + 1e-9), -1) + 1):
        # As keys, so that 0 and -0, or one distance on both sides, come once and in order.
        yield from {start + step * _STEP_IN: 0, -start - step * _STEP_IN: 0}


def _numbered(plan: PlanSheet, lane: Lane) -> Lane:
    """Draw a gap with its number, and NG next to it; return the lane with their frame."""
    gap, is_ng = lane.gap, plan.is_ng(lane.gap)
    circle = 2 * RADIUS_IN if gap.of.is_given else 0.0
    ng = (NG_TALL_IN if lane.is_upright else ng_wide()) if is_ng else 0.0
    size = circle + ng, (ng_wide() if is_ng and lane.is_upright else 2 * RADIUS_IN)
    # It slides along the gap to where it touches nothing; where no place is left it has a leader.
    shift = _slid(plan.paper.placer, lane, *size)
    if shift is None:
        draw_gap(plan, gap)
        frame = plan.paper.placer.place(
            circle + (ng_wide() if is_ng else 0.0),
            2 * RADIUS_IN,
            gap.middle,
            maximum=plan.leader_in,
        )
        if frame is None:
            # What is not on the plan is listed below it: a clearance must not be missing because a
            # roof is crowded.
            plan.unnamed.append(gap.name)
            return lane
        plan.leader(gap.middle, frame)
    else:
        frame = lane.frame(shift, *size)
        dx, dy = (shift * way for way in lane.along)
        a, b = ((x + dx, y + dy) for x, y in (gap.a, gap.b))
        draw_gap(plan, replace(gap, a=a, b=b))
    (x, y), is_row = frame.middle, frame.wide >= frame.tall
    if gap.of.is_given:
        center = (frame.x0 + RADIUS_IN, y) if is_row else (x, frame.y1 - RADIUS_IN)
        number = str(gap.of.number)
        plan.paper.circle(Mark.NUMBER, center, RADIUS_IN - 0.01, number)
        plan.paper.text(center[0], center[1] - BASE_IN, number, is_centered=True)
    if is_ng:
        center = (frame.x1 - ng_wide() / 2, y) if is_row else (x, frame.y0 + NG_TALL_IN / 2)
        draw_ng(plan.paper, center)
    return replace(lane, number=frame)


def _slid(placer: Placer, lane: Lane, long: float, tall: float) -> float | None:
    """Reserve the first free position of a number on its lane; return its offset, if any."""
    shifts = list(_steps(0.0, lane.half))
    # With its dimension line, or else where labels leave no place for that, without.
    for across in (max(tall, lane.narrow), tall):
        for some in (shifts[:1], shifts[1:]):  # most have room in the middle
            taken = placer.take_first([lane.frame(shift, long, across) for shift in some])
            if taken is not None:
                return some[taken]
    return None


def gap_texts(gap: PlanGap, fmt: UnitFormat) -> tuple[str, str]:
    """Return the provided and the required separation, in the preferred unit."""
    shows = shown_in_order(capacity(gap.provided_m), demand(gap.required_m))
    values = gap.provided_m, gap.required_m
    provided, required = (fmt.short(v, show=show) for v, show in zip(values, shows, strict=True))
    return provided, required


def _provided(plan: PlanSheet, gap: Gap) -> str:
    plan_gap, fmt = gap.of, plan.fmt
    provided, required = gap_texts(plan_gap, fmt)
    if plan_gap.is_given:
        return provided
    # It is in no table.
    mark = "" if math.isnan(plan_gap.required_m) else plan_gap.mark
    return f"not entered; in plan {provided}, required {required}{mark}"


def _dimension(plan: PlanSheet, words: str, equal: Sequence[Lane]) -> None:
    """Write the provided clearance in one of several equal gaps, next to its number."""
    long = width_in(words) + 0.06
    tall = LINE_IN - 0.02
    # Between the facing sides first, then beyond their ends.
    for overhang in (0.0, _OVERHANG_IN):
        places: list[tuple[Lane, float]] = []
        for lane in equal:
            places += [(lane, shift) for shift in alongside(lane, long, overhang)]
        frames = [lane.frame(shift, long, tall) for lane, shift in places]
        within = [lane.frame(shift, long, min(lane.narrow, tall)) for lane, shift in places]
        taken = plan.paper.placer.take_first(frames, within)
        if taken is not None:
            (lane, _), frame = places[taken], frames[taken]
            plan.paper.box(Mark.BACKING, frame)
            (x, y), is_upright = frame.middle, lane.is_upright
            base = (x + BASE_IN, y) if is_upright else (x, y - BASE_IN)
            plan.paper.text(*base, words, is_centered=True, is_upright=is_upright)
            return
    if not plan.beside(equal[0].number, words.split(", "), RADIUS_IN):
        plan.unnamed.append(words)


def alongside(lane: Lane, long: float, overhang: float) -> Iterator[float]:
    """Yield distances along a lane on both sides of its number for a text of this length."""
    (x, y), number = lane.gap.middle, lane.number
    shift = (number.middle[0] - x) * lane.along[0] + (number.middle[1] - y) * lane.along[1]
    apart = ((number.tall if lane.is_upright else number.wide) + long) / 2 + 0.02
    reach = lane.half + overhang - long / 2
    for away in _steps(apart, reach + abs(shift)):
        if abs(shift + away) <= reach:
            yield shift + away


def draw_gap(plan: PlanSheet, gap: Gap) -> None:
    """Draw a dimension line; a gap that is not satisfied is hatched."""
    is_ng = plan.is_ng(gap)
    area = between(gap.of.near, gap.of.far) if is_ng else None
    if area is not None:
        plan.paper.shape(Mark.FAILED, area.points)
    plan.paper.dimension(Layer.CLEARANCE_NG if is_ng else Layer.CLEARANCE, gap.a, gap.b)
    plan.paper.placer.take_segment(gap.a, gap.b)


def draw_ng(paper: Paper, middle: Point) -> None:
    """Draw the mark of a gap that is not satisfied about a point: white on black."""
    x, y = middle
    paper.box(Mark.NG, centered(x, y, ng_wide(), NG_TALL_IN))
    paper.text(x, y - 0.038, "NG", is_centered=True, is_bold=True, is_light=True)


def ng_wide() -> float:
    """Return the width of the mark of a gap that is not satisfied [in]."""
    return width_in("NG", is_bold=True) + 0.06
