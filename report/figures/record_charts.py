"""Accelerations of the motions as run: a row per motion, a column per component, one scale.

Computes only the layout. Read `report.figures.base` first.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes

from report.drawing.paper_items import width_in
from report.figures.base import GRAY, INK, WIDTH_IN, Broken, canvas, style, svg_text
from report.figures.history_charts import envelope
from report.text.names import name_lines
from report.text.units import G_MPS2, round_below
from solver.model import Floats, Motion

_ROW_IN, _TOP_IN, _FOOT_IN = 0.21, 0.22, 0.3
# In a history; with fewer the peaks stand apart as if the motion were slow.
_ROW_POINTS = 360
# Width of the names of the motions, in columns, at least.
_LABELS = 0.14
# A bar at most, of the largest peak and of the longest motion; at least 0.32 of them.
_BAR = 0.8
_COLUMNS = ("Record", "Transverse", "Vertical")


def accelerations(motions: Sequence[Motion]) -> str:
    """Return the scaled accelerations of the motions over time, all at the same scale."""
    # All panels share one pair of axes, with offsets: one for each would take ten times as long.
    scaled = [[m.scaled(a) / G_MPS2 for a in (m.ax_mps2, m.ay_mps2, m.az_mps2)] for m in motions]
    peaks = [float(np.abs(a_g).max()) for a_g in chain.from_iterable(scaled) if a_g.size]
    # Motions of zeros have no range.
    reach = max(peaks) or 1.0
    seconds = max(m.dt_s * (len(m.ax_mps2) - 1) for m in motions)
    height = _ROW_IN * len(motions) + _TOP_IN + _FOOT_IN
    with style():
        # A row is 1 high, downward from 0; foot and top are in inches.
        rows = (-len(motions) - _FOOT_IN / _ROW_IN, _TOP_IN / _ROW_IN)
        names = [name_lines(motion.id) for motion in motions]
        widest_in = max(map(width_in, chain.from_iterable(names)))
        labels = max(_LABELS, len(_COLUMNS) * widest_in / (WIDTH_IN - widest_in))
        figure, axes = canvas(height, (-labels, len(_COLUMNS)), rows)
        _lines(axes, motions, scaled, reach, seconds)
        for row, lines in enumerate(names):
            axes.text(-labels, -row - 0.5, "\n".join(lines), va="center", linespacing=0.95)
        _words(axes, scaled)
        _scales(axes, len(motions), reach, seconds)
        return svg_text(figure)


def _lines(
    axes: Axes,
    motions: Sequence[Motion],
    scaled: Sequence[Sequence[Floats]],
    reach: float,
    seconds: float,
) -> None:
    """Draw all histories as one line with gaps, and the zeros as another."""
    histories, zeros = Broken(), Broken()
    for row, (motion, components) in enumerate(zip(motions, scaled, strict=True)):
        for column, a_g in enumerate(components):
            if a_g.size:
                t_s = motion.dt_s * np.arange(a_g.size, dtype=np.float64)
                times, values = envelope(t_s, a_g, _ROW_POINTS)
                # 0.94 of a column, and 0.46 of a row to either side: the largest peak stays in its
                # own panel.
                histories.add(column + 0.94 * times / seconds, -row - 0.5 + 0.46 * values / reach)
                zeros.add([column, column + 0.94], [-row - 0.5] * 2)
    axes.plot(zeros.x, zeros.y, color=GRAY, linewidth=0.4)
    axes.plot(histories.x, histories.y, color=INK, linewidth=0.4)


def _words(axes: Axes, scaled: Sequence[Sequence[Floats]]) -> None:
    for column, title in enumerate(_COLUMNS):
        axes.text(column, 0.1, title, weight="semibold", va="bottom")
    for row, components in enumerate(scaled):
        for column, a_g in enumerate(components):
            if not a_g.size:
                axes.text(column + 0.47, -row - 0.5, "none", va="center", ha="center")


def _scales(axes: Axes, rows: int, reach: float, seconds: float) -> None:
    """Draw bars of round lengths below the panels: of the accelerations and of the times."""
    level, span_s = round_below(_BAR * reach), round_below(_BAR * seconds)
    low, wide = -rows - 0.1, 0.94 * span_s / seconds
    axes.plot([0.0, 0.0], [low, low - 0.46 * level / reach], color=INK, linewidth=1.0)
    axes.text(0.02, low, f"{level:g} g", va="top")
    axes.plot([1.0, 1.0 + wide], [low, low], color=INK, linewidth=1.0)
    axes.text(1.0 + 0.5 * wide, low - 0.06, f"{span_s:g} s", va="top", ha="center")
