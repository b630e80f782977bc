"""The roof plan as outlines for the page: what is on the roof, how far it may move, the gaps.

Points are in plan [m], y upward. Reads finished numbers; the package draws the same in
`report.figures.plan`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from report.assessment.envelopes import design_envelope
from report.assessment.neighbors import EDGES
from report.assessment.plan_gaps import plan_gaps
from report.assessment.project import Assessment
from report.assessment.verdict import Verdict
from report.entities.clearance import ClearanceResult
from report.entities.columns import UnitFormat
from report.sheet.schema import ObjectKind, ProjectInput, Shape
from report.sheet.shapes import Point, around, label_point
from report.words.units import Quantity, round_below

NO_VALUE = "no value"
"""In place of a length that no run gives: nothing is required only where it is zero."""

ShowVerdict = Callable[[Verdict], str | None]


def plan(
    assessment: Assessment, gaps: Sequence[ClearanceResult], fmt: UnitFormat, show: ShowVerdict
) -> Mapping[str, Any]:
    """Return the plan, with its clearances as they are shown."""
    data = assessment.project
    envelopes = {item.id: design_envelope(item) for item in assessment.arrays}
    return {
        "extent": _extent(data),
        "north_deg": data.roof.north_deg,
        "roof": _outline(data.roof.placed),
        "arrays": [
            {
                "id": item.id,
                "outline": _outline(item.array.shape),
                "downslope_deg": item.array.downslope_deg,
                "envelope": _points(envelopes[item.id]),
                "center": _point(label_point(item.array.shape)),
            }
            for item in assessment.arrays
        ],
        "objects": [
            {
                "id": item.id,
                "kind": item.kind.value,
                "outline": _outline(item.placed),
                "is_edge": item.kind in EDGES,
                "has_parapet": item.kind is ObjectKind.EDGE_WITH_PARAPET,
                "center": _point(label_point(item.placed)),
            }
            for item in data.objects
            if item.placed is not None
        ],
        "gaps": list(_gaps(assessment, gaps, fmt, show)),
        "scale_bar": _scale_bar(data),
    }


def _extent(data: ProjectInput) -> Sequence[float]:
    rows = (*data.arrays, *data.objects, data.roof)
    box = around(row.placed for row in rows if row.placed is not None)
    return [box.x_from_m, box.y_from_m, box.x_to_m, box.y_to_m]


def _scale_bar(data: ProjectInput) -> Mapping[str, Any]:
    """Return a round length, about a seventh of the width."""
    x0, _, x1, _ = _extent(data)
    unit = Quantity.PLAN.us if data.project.units_first.is_us else Quantity.PLAN.si
    length = round_below((x1 - x0) / 6.0 / unit.si)
    return {"length_m": length * unit.si, "text": f"{length:g} {unit.symbol}"}


def _gaps(
    assessment: Assessment, rows: Sequence[ClearanceResult], fmt: UnitFormat, show: ShowVerdict
) -> Iterator[Mapping[str, Any]]:
    for gap in plan_gaps(assessment):
        start, end = gap.ends
        row = rows[gap.number - 1] if gap.is_given else None
        yield {
            "clearance": gap.number - 1 if gap.is_given else None,
            "from": _point(start),
            "to": _point(end),
            "provided": row.short("provided_m", fmt) if row else _short(gap.provided_m, fmt),
            "required": row.short("required_m", fmt)
            if row
            else _short(gap.required_m, fmt) + gap.mark,
            "verdict": show(gap.verdict),
        }


def _short(value_m: float, fmt: UnitFormat) -> str:
    return fmt.short(value_m, Quantity.DISPLACEMENT)


def _outline(shape: Shape | None) -> Sequence[Sequence[float]]:
    return [] if shape is None else _points(shape.points)


def _points(points: Sequence[Point]) -> Sequence[Sequence[float]]:
    return [_point(point) for point in points]


def _point(point: Point) -> Sequence[float]:
    return [round(value, 4) for value in point]
