"""The roof plan as outlines for the page: what is on the roof, how far it may move, the gaps.

Points are in plan [m], y upward. Reads finished numbers; the package draws the same in
`report.figures.plan`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from report.assessment.envelopes import design_envelope
from report.assessment.neighbors import EDGES
from report.assessment.plan_gaps import PlanGap, plan_gaps
from report.assessment.project import Assessment
from report.entities.clearance import ClearanceResult, callout
from report.entities.columns import UnitFormat
from report.sheet.schema import ObjectKind, ProjectInput, Shape
from report.sheet.schema.shapes import Point, around, label_point
from report.web.tables import Cell, ShowVerdict
from report.words.units import Quantity, round_below

NO_VALUE = "no value"
"""In place of a length that no run gives: nothing is required only where it is zero."""


def plan(
    assessment: Assessment,
    designs: Mapping[str, Cell],
    clearances: Sequence[ClearanceResult],
    fmt: UnitFormat,
    verdict: ShowVerdict,
) -> Mapping[str, Any]:
    """Return the plan, with its design displacements and clearances as they are shown."""
    data = assessment.project
    extent = _extent(data)
    return {
        "extent": extent,
        "north_deg": data.roof.north_deg,
        "roof": _outline(data.roof.placed),
        "arrays": [
            {
                "id": item.id,
                "outline": _outline(item.array.shape),
                "downslope_deg": item.array.downslope_deg,
                "envelope": _points(design_envelope(item)),
                "center": _point(label_point(item.array.shape)),
                "label": f"Δ {designs[item.id]['text']}",
            }
            for item in assessment.arrays
        ],
        "objects": [
            {
                "id": item.id,
                "outline": _outline(item.placed),
                "is_edge": item.kind in EDGES,
                "has_parapet": item.kind is ObjectKind.EDGE_WITH_PARAPET,
            }
            for item in data.objects
            if item.placed is not None
        ],
        "title": "Roof plan to scale",
        "described": [
            {"text": _sentence(row, fmt), "verdict": verdict(row.verdict)} for row in clearances
        ],
        "gaps": [_gap(gap, fmt, verdict) for gap in plan_gaps(assessment)],
        "scale_bar": _scale_bar(extent[2] - extent[0], fmt),
    }


def _extent(data: ProjectInput) -> Sequence[float]:
    rows = (*data.arrays, *data.objects, data.roof)
    box = around(row.placed for row in rows if row.placed is not None)
    return [box.x_from_m, box.y_from_m, box.x_to_m, box.y_to_m]


def _scale_bar(width_m: float, fmt: UnitFormat) -> Mapping[str, Any]:
    """Return a round length, about a seventh of the width."""
    unit = fmt.units(Quantity.PLAN)[0]
    length = round_below(width_m / 6.0 / unit.si)
    return {"length_m": length * unit.si, "text": f"{length:g} {unit.symbol}"}


def _sentence(row: ClearanceResult, fmt: UnitFormat) -> str:
    provided, required = (row.both(name, fmt) for name in ("provided_m", "required_m"))
    name = f"Clearance {row.count}, {row.array} to {row.object}, {row.direction}"
    return f"{name}: provided {provided}, required {required}"


def _gap(gap: PlanGap, fmt: UnitFormat, verdict: ShowVerdict) -> Mapping[str, Any]:
    start, end = gap.ends
    return {
        "number": f"{gap.number}" if gap.is_given else None,
        "from": _point(start),
        "to": _point(end),
        "lines": callout(gap, fmt),
        "verdict": verdict(gap.verdict),
    }


def _outline(shape: Shape | None) -> Sequence[Sequence[float]]:
    return [] if shape is None else _points(shape.points)


def _points(points: Sequence[Point]) -> Sequence[Sequence[float]]:
    return [_point(point) for point in points]


def _point(point: Point) -> Sequence[float]:
    return [round(value, 4) for value in point]
