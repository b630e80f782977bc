"""The roof plan as a picture: paints what `report.drawing.on_paper` places, and decides nothing.

Read `painted` first.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle as Round
from matplotlib.patches import FancyArrowPatch, Polygon
from matplotlib.text import Text as Words

from report.drawing.items import Arrow, Circle, Item, Lines, Look, Mark, Outline
from report.drawing.layers import Layer
from report.drawing.paper import Paper
from report.drawing.widths import TYPE_PT
from report.figures.base import ACCENT, GRAY, INK, PALE, Broken, canvas, style, svg_text

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
        axes.add_artist(_artist(item)).set_zorder(order)
    return figure


def _artist(item: Item) -> Artist:
    if isinstance(item, Outline):
        return Polygon(item.points, closed=True, gid=item.name or None, **_LOOKS[item.look])
    if isinstance(item, Circle):
        return Round(item.center, item.radius, **_LOOKS[item.look])
    if isinstance(item, Lines):
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
