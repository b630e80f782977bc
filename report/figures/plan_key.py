"""The legend of the plan: north, scale bar, symbols, field notes.

Read `report.figures.plan` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from report.figures.base import ACCENT, GRAY, INK, PALE
from report.figures.labels import LINE_IN, TYPE_PT, Frame, centered, width_in
from report.figures.paper_plan import FOOT_M, PlanPaper, nice_length, wrapped
from report.sheet.schema import ObjectKind

FILLS: dict[ObjectKind, dict[str, Any]] = {
    ObjectKind.FIXED: {"facecolor": PALE, "edgecolor": INK, "hatch": "///", "linewidth": 0.8},
    ObjectKind.UNLIKE_ARRAY: {"facecolor": "white", "edgecolor": GRAY, "hatch": "\\\\\\",
                              "linewidth": 0.8},
}  # fmt: skip
EDGES: dict[ObjectKind, dict[str, Any]] = {
    ObjectKind.EDGE_WITH_PARAPET: {"linewidth": 3.2, "solid_capstyle": "butt"},
    ObjectKind.EDGE_WITHOUT_PARAPET: {"linewidth": 1.4, "dashes": (5, 2)},
}
ARRAY: dict[str, Any] = {"facecolor": "#e8eef5", "edgecolor": ACCENT, "linewidth": 1.2}
RUNS: dict[str, Any] = {"facecolor": "#f0d2b6", "edgecolor": "#c8651b", "linewidth": 0.5}
DESIGN: dict[str, Any] = {"facecolor": "none", "edgecolor": INK, "linewidth": 0.7,
                          "linestyle": (0, (4, 2))}  # fmt: skip
ROOF: dict[str, Any] = {"facecolor": "white", "edgecolor": GRAY, "linewidth": 0.7}
BARE: dict[str, Any] = {"linewidth": 1.4, "dashes": (1, 2)}
FAILED: dict[str, Any] = {"facecolor": "white", "edgecolor": INK, "hatch": "xxxxxx",
                          "linewidth": 1.6}  # fmt: skip

_SAMPLE_IN = 0.34


class Symbol(Enum):
    """A symbol of the plan, with its meaning."""

    ARRAY = "array, downslope direction"
    FIXED = "fixed object"
    UNLIKE = "unlike array"
    PARAPET = "roof edge with parapet"
    EDGE = "roof edge without parapet"
    BARE = "roof edge, not an object"
    DESIGN = "array displaced by Δ"
    RUNS = "array in all runs"
    GAP = "clearance, numbered"
    FAILED = "clearance not satisfied"


@dataclass(frozen=True, slots=True, kw_only=True)
class Key:
    """What the legend shows.

    Attributes
    ----------
    symbols : tuple of Symbol
        Those on the plan.
    notes : tuple of str
        Finished sentences.
    """

    north_deg: float
    us_first: bool
    symbols: tuple[Symbol, ...]
    notes: tuple[str, ...]


def draw_key(paper: PlanPaper, frame: Frame, key: Key) -> None:
    """Draw the legend, in one column or, in a frame wider than tall, in three."""
    columns = _columns(frame)
    _north_and_scale(paper, columns[0], key)
    used = 0.95
    if len(columns) == 1:
        used = _symbols(paper, columns[0], key.symbols, used)
        _notes(paper, columns[0], key.notes, used + 0.1)
        return
    _notes(paper, columns[0], key.notes[:1], used)
    _symbols(paper, columns[1], key.symbols, 0.1)
    _notes(paper, columns[2], key.notes[1:], 0.1)


def _columns(frame: Frame) -> Sequence[Frame]:
    if frame.wide < frame.tall or frame.wide < 3.0:
        return (frame,)
    each = frame.wide / 3
    return [
        Frame(frame.x0 + k * each, frame.y0, frame.x0 + (k + 1) * each - 0.12, frame.y1)
        for k in range(3)
    ]


def _north_and_scale(paper: PlanPaper, frame: Frame, key: Key) -> None:
    x, y = frame.x0 + 0.3, frame.y1 - 0.46
    dx, dy = (0.26 * f(math.radians(key.north_deg)) for f in (math.cos, math.sin))
    paper.arrow((x - dx, y - dy), (x + dx, y + dy), linewidth=1.1)
    paper.text(x + 1.35 * dx, y + 1.35 * dy, "N", ha="center", va="center", weight="semibold")
    unit = FOOT_M if key.us_first else 1.0
    symbol = "ft" if key.us_first else "m"
    whole = nice_length(1.05 * paper.scale.m_per_in / unit)
    if key.us_first:
        whole = paper.scale.m_per_in / unit  # exactly 1 in long
    long, left, base = whole * unit / paper.scale.m_per_in, frame.x0 + 0.75, frame.y1 - 0.52
    for k, color in enumerate((INK, "white")):
        half = Frame(left + k * long / 2, base, left + (k + 1) * long / 2, base + 0.06)
        paper.box(half, facecolor=color, edgecolor=INK, linewidth=0.6)
    for share in (0.0, 0.5, 1.0):
        words = f"{whole * share:g}" + (f" {symbol}" if share == 1.0 else "")
        paper.text(left + share * long, base - 0.14, words, ha="center")
    paper.text(left, base + 0.13, paper.scale.name, weight="semibold")


def _symbols(paper: PlanPaper, frame: Frame, symbols: Sequence[Symbol], used: float) -> float:
    """Draw the symbols below what is used of a column; return how much is used then."""
    x = frame.x0 + 0.05
    for symbol in symbols:
        y = frame.y1 - used - LINE_IN / 2
        _sample(paper, symbol, centered(x + _SAMPLE_IN / 2, y, _SAMPLE_IN, 0.11))
        lines = wrapped(symbol.value, frame.x1 - x - _SAMPLE_IN - 0.1)
        for count, words in enumerate(lines):
            paper.text(x + _SAMPLE_IN + 0.08, y - 0.04 - count * LINE_IN, words)
        used += len(lines) * LINE_IN + 0.025
    return used


def _sample(paper: PlanPaper, symbol: Symbol, frame: Frame) -> None:
    (x, y), ends = frame.middle, ((frame.x0, frame.middle[1]), (frame.x1, frame.middle[1]))
    boxes = {
        Symbol.ARRAY: ARRAY,
        Symbol.FIXED: FILLS[ObjectKind.FIXED],
        Symbol.UNLIKE: FILLS[ObjectKind.UNLIKE_ARRAY],
        Symbol.DESIGN: DESIGN,
        Symbol.RUNS: RUNS,
        Symbol.FAILED: FAILED,
    }
    lines = {
        Symbol.PARAPET: EDGES[ObjectKind.EDGE_WITH_PARAPET],
        Symbol.EDGE: EDGES[ObjectKind.EDGE_WITHOUT_PARAPET],
        Symbol.BARE: BARE,
    }
    if symbol in boxes:
        paper.box(frame, **boxes[symbol])
    if symbol in lines:
        paper.line(*ends, **lines[symbol])
    if symbol is Symbol.ARRAY:
        paper.arrow((x, frame.y1), (x, frame.y0 - 0.02), linewidth=0.8)
    if symbol is Symbol.GAP:
        gap_line(paper, *ends)
        paper.circle((x, y), 0.06, facecolor="white", edgecolor=INK, linewidth=0.6)
    if symbol is Symbol.FAILED:
        ng_box(paper, x, y)


def gap_line(paper: PlanPaper, a: tuple[float, float], b: tuple[float, float]) -> None:
    """Draw a dimension line with a tick at each end."""
    long = math.dist(a, b) or 1.0
    dx, dy = (0.05 * (b[0] - a[0]) / long, 0.05 * (b[1] - a[1]) / long)
    ends = [[(x - dy, y + dx), (x + dy, y - dx)] for x, y in (a, b)]
    paper.segments([[a, b], *ends], linewidth=1.0)


def ng_size() -> tuple[float, float]:
    """Return the size [in] of the mark of a clearance that is not satisfied."""
    return width_in("NG", "semibold") + 0.06, TYPE_PT / 72.0 + 0.03


def ng_box(paper: PlanPaper, x: float, y: float) -> None:
    """Draw the mark about a point: white on black."""
    paper.box(centered(x, y, *ng_size()), facecolor=INK, edgecolor="none", zorder=4)
    look = {"ha": "center", "weight": "semibold", "color": "white", "zorder": 5}
    paper.text(x, y - 0.038, "NG", **look)


def _notes(paper: PlanPaper, frame: Frame, notes: Sequence[str], used: float) -> None:
    for note in notes:
        for words in wrapped(note, frame.wide - 0.1):
            used += LINE_IN
            paper.text(frame.x0 + 0.05, frame.y1 - used, words)
        used += 0.06
