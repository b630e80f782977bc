"""The roof plan as a picture: paints what `report.drawing.on_paper` places, and decides nothing.

Read `painted` first.

A section through an array on its roof, and its free body.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Arc, FancyArrowPatch, Polygon
from matplotlib.patches import Circle as Round
from matplotlib.text import Text as Words

from report.assessment.design.friction import mu_words
from report.drawing.drawn_slope import drawn_slope_deg
from report.drawing.layers import Layer
from report.drawing.paper_items import TYPE_PT, Arrow, Circle, Item, Lines, Look, Mark, Outline
from report.drawing.sheet import Paper
from report.figures.base import ACCENT, GRAY, INK, PALE, WIDTH_IN, Broken, canvas, style, svg_text
from report.project.model.array import Array
from report.project.model.shapes import Point
from report.text.units import Quantity, number, pair

_LOOKS: Mapping[Look, dict[str, Any]] = {
    Layer.OUTLINE: {"facecolor": "white", "edgecolor": GRAY, "linewidth": 0.7},
    Layer.BARE_EDGE: {"linewidth": 1.4, "dashes": (1, 2)},
    Layer.RUNS: {"facecolor": "#f0d2b6", "edgecolor": "#c8651b", "linewidth": 0.5},
    Layer.DESIGN: {
        "facecolor": "none",
        "edgecolor": INK,
        "linewidth": 0.7,
        "linestyle": (0, (4, 2)),
    },
    Layer.ARRAY: {"facecolor": "#e8eef5", "edgecolor": ACCENT, "linewidth": 1.2},
    Layer.OBJECT: {"facecolor": PALE, "edgecolor": INK, "hatch": "///", "linewidth": 0.8},
    Layer.UNLIKE: {"facecolor": "white", "edgecolor": GRAY, "hatch": "\\\\\\", "linewidth": 0.8},
    Layer.PARAPET: {"linewidth": 3.2, "solid_capstyle": "butt"},
    Layer.EDGE: {"linewidth": 1.4, "dashes": (5, 2)},
    Layer.CLEARANCE: {"linewidth": 1.0},
    Layer.CLEARANCE_NG: {"linewidth": 1.0},
    Mark.FAILED: {"facecolor": "white", "edgecolor": INK, "hatch": "xxxxxx", "linewidth": 1.6},
    Mark.LEADER: {"linewidth": 0.6, "color": GRAY},
    Mark.FRAME: {"facecolor": "white", "edgecolor": GRAY, "linewidth": 0.4},
    Mark.BACKING: {"facecolor": "white", "edgecolor": "none"},
    Mark.NUMBER: {"facecolor": "white", "edgecolor": INK, "linewidth": 0.7},
    Mark.NUMBER_SAMPLE: {"facecolor": "white", "edgecolor": INK, "linewidth": 0.6},
    Mark.NG: {"facecolor": INK, "edgecolor": "none"},
    Mark.SLOPE: {"linewidth": 1.0},
    Mark.SLOPE_SAMPLE: {"linewidth": 0.8},
    Layer.NORTH: {"linewidth": 1.1},
    Mark.TICK: {"linewidth": 0.6},
    Mark.DARK: {"facecolor": INK, "edgecolor": INK, "linewidth": 0.6},
    Mark.LIGHT: {"facecolor": "white", "edgecolor": INK, "linewidth": 0.6},
}
_ARROW: dict[str, Any] = {
    "arrowstyle": "-|>",
    "mutation_scale": 8,
    "color": INK,
    "shrinkA": 0,
    "shrinkB": 0,
}


def paper_svg(paper: Paper) -> str:
    """Return what is placed on a paper as SVG, at true scale."""
    with style():
        return svg_text(painted(paper))


def painted(paper: Paper) -> Figure:
    """Paint what is placed on a paper."""
    figure, axes = canvas(paper.tall, (0.0, paper.wide), (0.0, paper.tall), paper.wide)
    for order, item in enumerate(paper.items):
        # In the order of the list: matplotlib would draw all lines above all patches.
        axes.add_artist(_artist(item)).set_zorder(order)
    return figure


def _artist(item: Item) -> Artist:
    if isinstance(item, Outline):
        # The gid becomes the id of a group in the SVG, by which `report.page_file` shades an
        # array.
        return Polygon(item.points, closed=True, gid=item.name or None, **_LOOKS[item.look])
    if isinstance(item, Circle):
        return Round(item.center, item.radius, **_LOOKS[item.look])
    if isinstance(item, Lines):
        # One artist for many lines: each costs more than its points.
        path = Broken()
        for points in item.lines:
            path.add(*zip(*points, strict=True))
        return Line2D(path.x, path.y, **({"color": INK} | _LOOKS[item.look]))
    if isinstance(item, Arrow):
        return FancyArrowPatch(item.tail, item.tip, **(_ARROW | _LOOKS[item.look]))
    return Words(
        *item.at,
        item.words,
        fontsize=TYPE_PT,
        color="white" if item.is_light else INK,
        weight="semibold" if item.is_bold else "regular",
        ha="center" if item.is_centered else "left",
        rotation=90 if item.is_upright else 0,
        rotation_mode="anchor",
        clip_on=False,
    )


_HEIGHT_IN, _SPLIT_IN = 1.8, 3.75
_TYPE: Any = {"font.size": 9.0}
_FORCE_ARROW = {
    "arrowstyle": "-|>",
    "mutation_scale": 9,
    "shrinkA": 0,
    "shrinkB": 0,
    "linewidth": 1.1,
}
_SPAN: Any = {"arrowstyle": "<|-|>", "mutation_scale": 6, "linewidth": 0.6, "color": INK}


class _Roof(NamedTuple):
    """A sloping line on the page [in]: its upslope end and the drawn angle [rad]."""

    x: float
    y: float
    angle: float

    def at(self, s: float, n: float) -> Point:
        """Return the point at a distance downslope and a height normal to the roof."""
        c, d = math.cos(self.angle), math.sin(self.angle)
        return self.x + s * c + n * d, self.y - s * d + n * c


def array_section(array: Array, us_first: bool) -> str:
    """Return the section with b, c, slope and friction, and the forces during downslope slip."""
    drawn = math.radians(drawn_slope_deg(array))
    with style(), mpl.rc_context(_TYPE):
        figure, axes = canvas(_HEIGHT_IN, (0.0, WIDTH_IN), (0.0, _HEIGHT_IN))
        rise = math.tan(drawn)
        _section(axes, _Roof(0.15, 0.68 + 1.65 * rise, drawn), array, us_first)
        _free_body(axes, _Roof(_SPLIT_IN + 0.45, 0.76 + 1.3 * rise, drawn))
        for x, text in ((0.1, "Section, not to scale"), (_SPLIT_IN + 0.1, "Free body")):
            axes.text(x, _HEIGHT_IN - 0.08, text, va="top", weight="semibold")
        return svg_text(figure)


def _section(axes: Axes, roof: _Roof, array: Array, us_first: bool) -> None:
    _line(axes, roof.at(0.0, 0.0), roof.at(3.2, 0.0), color=INK, linewidth=1.4)
    # Inches on the page, along the roof from its upslope end and up from it: a picture, not to
    # scale.
    feet = (0.55, 1.25, 1.95)
    for s in feet:
        _block(axes, roof, (s - 0.05, s + 0.05), (0.0, 0.14), facecolor=INK)
    _block(axes, roof, (0.4, 2.1), (0.14, 0.19), facecolor=PALE)
    for s in (0.5, 1.35):
        _block(axes, roof, (s + 0.2, s + 0.5), (0.19, 0.29), facecolor="white", hatch="////")
        low, high = roof.at(s, 0.24), roof.at(s + 0.62, 0.46)
        _line(axes, low, high, color=ACCENT, linewidth=2.6)
    center = roof.at(1.25, 0.36)
    _center(axes, center)
    _arrow(axes, roof.at(feet[0], -0.2), roof.at(feet[1], -0.2), **_SPAN)
    for s in feet[:2]:
        _line(axes, roof.at(s, -0.02), roof.at(s, -0.26))
    size = Quantity.SIZE
    x, y = roof.at(0.9, -0.33)
    axes.text(x, y, f"b = {pair(array.support_spacing_m, size, us_first)}", ha="center", va="top")
    _line(axes, roof.at(1.33, 0.36), roof.at(2.47, 0.36))
    _arrow(axes, roof.at(2.42, 0.0), roof.at(2.42, 0.36), **_SPAN)
    x, y = roof.at(2.48, 0.16)
    axes.text(x, y, f"c = {pair(array.cg_height_m, size, us_first)}", ha="left", va="center")
    weight = pair(array.weight_n, Quantity.WEIGHT, us_first)
    top = (center[0], center[1] + 0.42)
    axes.text(*top, f"W = {weight}", ha="left", va="bottom")
    _arrow(axes, top, center)
    x, y = roof.at(1.75, 0.0)
    axes.annotate(
        f"μ = {mu_words(array.friction)}",
        roof.at(1.95, 0.0),
        (x, y - 0.46),
        ha="center",
        va="top",
        arrowprops={"arrowstyle": "-", "linewidth": 0.6, "color": INK},
    )
    _slope(axes, roof, array)


def _slope(axes: Axes, roof: _Roof, array: Array) -> None:
    """Draw the slope at the downslope end of the roof."""
    end = roof.at(3.2, 0.0)
    _line(axes, end, (end[0] - 0.75, end[1]))
    turn = math.degrees(roof.angle)
    axes.add_patch(Arc(end, 1.3, 1.3, theta1=180.0 - turn, theta2=180.0, color=INK, linewidth=0.6))
    degrees = number(math.degrees(array.slope_rad), 2)
    axes.text(end[0], end[1] - 0.05, f"θ = {degrees}°", ha="right", va="top")


def _free_body(axes: Axes, roof: _Roof) -> None:
    _line(axes, roof.at(0.0, 0.0), roof.at(2.0, 0.0), color=GRAY, linewidth=1.4)
    _block(axes, roof, (0.45, 1.55), (0.0, 0.42), facecolor="#eef2f7")
    # Seen from the roof: its acceleration acts as -m a at the center of gravity (d'Alembert), and
    # N and the friction where the supports are.
    center = roof.at(1.0, 0.24)
    _center(axes, center)
    _arrow(axes, center, (center[0], center[1] - 0.72))
    _label(axes, (center[0] + 0.06, center[1] - 0.68), "W + m a", "v")
    _arrow(axes, center, (center[0] + 0.95, center[1]))
    _label(axes, (center[0] + 0.72, center[1] + 0.07), "−m a", "h")
    low = roof.at(0.8, -0.62)
    _arrow(axes, low, roof.at(0.8, 0.0))
    axes.text(low[0] - 0.06, low[1] + 0.08, "N", ha="right", va="center")
    start = roof.at(0.42, 0.045)
    tip = roof.at(-0.2, 0.045)
    _arrow(axes, start, tip)
    axes.text(tip[0] + 0.02, tip[1] + 0.08, "μ N", ha="left", va="bottom")
    _arrow(axes, roof.at(1.15, 0.72), roof.at(1.75, 0.72), color=GRAY)
    x, y = roof.at(1.1, 0.77)
    axes.text(x, y, "downslope slip", ha="left", va="bottom", color=INK)


def _block(
    axes: Axes, roof: _Roof, s: tuple[float, float], n: tuple[float, float], **look: Any
) -> None:
    corners = [roof.at(s[0], n[0]), roof.at(s[1], n[0]), roof.at(s[1], n[1]), roof.at(s[0], n[1])]
    axes.add_patch(Polygon(corners, edgecolor=INK, linewidth=0.7, **look))


def _center(axes: Axes, xy: Point) -> None:
    axes.plot(*xy, marker="o", markersize=6, markerfacecolor="white", markeredgecolor=INK, zorder=4)
    axes.plot(*xy, marker="+", markersize=6, color=INK, zorder=5)


def _line(
    axes: Axes, start: Point, end: Point, *, color: str = GRAY, linewidth: float = 0.6
) -> None:
    axes.plot(*zip(start, end, strict=True), color=color, linewidth=linewidth)


def _arrow(axes: Axes, start: Point, tip: Point, **look: Any) -> None:
    axes.annotate("", tip, start, arrowprops={**_FORCE_ARROW, "color": ACCENT, **look})


def _label(axes: Axes, anchor: Point, text: str, subscript: str) -> None:
    """Write a symbol with its subscript."""
    # The font has no subscript letters.
    main = axes.text(*anchor, text, va="bottom", fontsize=10.0)
    axes.annotate(
        subscript, (1.0, 0.0), (0.5, -3.0), xycoords=main, textcoords="offset points", va="bottom"
    )
