"""The roof plan, to scale."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch
from matplotlib.patches import Rectangle as Box
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator

from report.figures.base import (
    ACCENT,
    GREY,
    INK,
    PALE,
    WIDTH_IN,
    bare,
    framed,
    style,
    svg_text,
    tick_text,
)
from report.sheet.schema import ObjectKind, ProjectInput, Rectangle
from report.words.units import Quantity, Unit, number


def roof_plan(data: ProjectInput, us_first: bool) -> str:
    """Return arrays, objects and edges to scale, with checked gaps and downslope directions."""
    unit = Quantity.PLAN.us if us_first else Quantity.PLAN.si
    shapes: dict[str, Rectangle | None] = {item.id: item.rectangle for item in data.objects}
    shapes |= {item.id: item.rectangle for item in data.arrays}
    drawn = [shape for shape in shapes.values() if shape is not None]
    x0, x1 = min(r.x_from_m for r in drawn), max(r.x_to_m for r in drawn)
    y0, y1 = min(r.y_from_m for r in drawn), max(r.y_to_m for r in drawn)
    span = max(x1 - x0, y1 - y0)
    height = min(max((WIDTH_IN - 0.6) * (y1 - y0) / max(x1 - x0, 1e-9), 2.0), 6.0)
    with style():
        figure, axes = framed(height + 0.55, 0.5, 0.1, 0.1, 0.45)
        _objects(axes, data, span)
        for array in data.arrays:
            _array(axes, array.id, array.rectangle, array.downslope_deg, array.slope_rad)
        _gaps(axes, data, shapes, span)
        _plan_axes(axes, unit, (x0, x1, y0, y1), span)
        return svg_text(figure)


def _plan_axes(axes: Axes, unit: Unit, box: tuple[float, float, float, float], span: float) -> None:
    x0, x1, y0, y1 = box
    pad = 0.03 * span
    axes.set_xlim(x0 - pad, x1 + pad)
    axes.set_ylim(y0 - pad, y1 + pad)
    axes.set_aspect("equal")
    bare(axes)
    for axis, name in ((axes.xaxis, "x"), (axes.yaxis, "y")):
        ticks = MaxNLocator(8).tick_values(*(v / unit.si for v in axis.get_view_interval()))
        low, high = axis.get_view_interval()
        kept = [t for t in ticks if low <= t * unit.si <= high]
        axis.set_major_locator(FixedLocator([t * unit.si for t in kept]))
        axis.set_major_formatter(FuncFormatter(lambda v, _: number(v / unit.si, 0)))
        axis.set_label_text(f"{name} [{unit.symbol}]")


_FILLS: Mapping[ObjectKind, dict[str, Any]] = {
    ObjectKind.FIXED: {"facecolor": PALE, "hatch": "//"},
    ObjectKind.UNLIKE_ARRAY: {"facecolor": "white", "hatch": "\\\\"},
    ObjectKind.EDGE_WITH_PARAPET: {"facecolor": GREY},
    ObjectKind.EDGE_WITHOUT_PARAPET: {"facecolor": "white", "linestyle": "--"},
}


def _objects(axes: Axes, data: ProjectInput, span: float) -> None:
    for item in data.objects:
        shape = item.rectangle
        if shape is None:
            continue
        axes.add_patch(_box(shape, linewidth=0.7, edgecolor=INK, **_FILLS[item.kind]))
        wide, tall = shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m
        x, y = (shape.x_from_m + shape.x_to_m) / 2, (shape.y_from_m + shape.y_to_m) / 2
        is_vertical = tall > 3 * wide
        room = (tall if is_vertical else wide) / span
        if room < 0.012 * len(item.id) + 0.04:  # no space inside: label below
            axes.text(
                x,
                shape.y_from_m - 0.008 * span,
                tick_text(item.id),
                ha="center",
                va="top",
                fontsize=7,
            )
            continue
        axes.text(
            # Away from the middle of an edge, where clearances are drawn.
            x if tall > wide or room < 0.6 else shape.x_from_m + 0.2 * wide,
            y if wide > tall or room < 0.6 else shape.y_from_m + 0.2 * tall,
            tick_text(item.id),
            ha="center",
            va="center",
            fontsize=7,
            rotation=90 if is_vertical else 0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )


def _box(shape: Rectangle, **look: Any) -> Box:
    wide, tall = shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m
    return Box((shape.x_from_m, shape.y_from_m), wide, tall, **look)


def _array(axes: Axes, name: str, shape: Rectangle, downslope_deg: float, slope: float) -> None:
    axes.add_patch(_box(shape, facecolor="#e8eef5", edgecolor=ACCENT, linewidth=1.2))
    x, y = (shape.x_from_m + shape.x_to_m) / 2, (shape.y_from_m + shape.y_to_m) / 2
    reach = 0.22 * min(shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m)
    dx, dy = (reach * f(math.radians(downslope_deg)) for f in (math.cos, math.sin))
    axes.text(x - 1.2 * dx, y - 1.2 * dy, name, ha="center", va="center", weight="semibold")
    axes.add_patch(
        FancyArrowPatch(
            (x - 0.4 * dx, y - 0.4 * dy),
            (x + 1.6 * dx, y + 1.6 * dy),
            arrowstyle="-|>",
            mutation_scale=8,
            color=INK,
            linewidth=1.0,
        )
    )
    axes.annotate(
        f"{number(math.degrees(slope), 2)}°",
        (x + 0.6 * dx, y + 0.6 * dy),
        (4 * abs(math.sin(math.radians(downslope_deg))), 4),
        textcoords="offset points",
        fontsize=7,
    )


def _gaps(
    axes: Axes, data: ProjectInput, shapes: Mapping[str, Rectangle | None], span: float
) -> None:
    for count, row in enumerate(data.clearances, start=1):
        near, far = shapes.get(row.array), shapes.get(row.object)
        if near is None or far is None:
            continue
        (xa, ya), (xb, yb) = _closest(near, far)
        aside = 0.02 * span
        across = abs(xb - xa) >= abs(yb - ya)
        axes.annotate(
            "",
            (xa, ya),
            (xb, yb),
            arrowprops={
                "arrowstyle": "|-|,widthA=0.25,widthB=0.25",
                "shrinkA": 0,
                "shrinkB": 0,
                "linewidth": 0.8,
                "color": INK,
            },
        )
        axes.text(
            (xa + xb) / 2 + (0.0 if across else aside),
            (ya + yb) / 2 + (aside if across else 0.0),
            str(count),
            fontsize=6.5,
            ha="center",
            va="center",
            bbox={
                "boxstyle": "circle,pad=0.18",
                "facecolor": "white",
                "edgecolor": INK,
                "linewidth": 0.6,
            },
        )


def _closest(a: Rectangle, b: Rectangle) -> tuple[tuple[float, float], tuple[float, float]]:
    xa, xb = _nearest((a.x_from_m, a.x_to_m), (b.x_from_m, b.x_to_m))
    ya, yb = _nearest((a.y_from_m, a.y_to_m), (b.y_from_m, b.y_to_m))
    return (xa, ya), (xb, yb)


def _nearest(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the closest points of two ranges; the middle of the overlap if they overlap."""
    if a[1] <= b[0]:
        return a[1], b[0]
    if b[1] <= a[0]:
        return a[0], b[1]
    middle = (max(a[0], b[0]) + min(a[1], b[1])) / 2
    return middle, middle
