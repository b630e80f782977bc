"""Records as read: acceleration over time, one panel per channel, and their spectra.

Computes only the layout. Read `report.figures.base` first.

Accelerations of the motions as run: a row per motion, a column per component, one scale.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from report.drawing.items import width_in
from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    WIDTH_IN,
    Broken,
    T,
    canvas,
    labeled,
    periods,
    style,
    svg_text,
)
from report.figures.history import envelope
from report.text.counts import name_lines
from report.text.formats import shortened
from report.text.units import G_MPS2, round_below
from solver.model import Floats, Motion
from solver.records.record import Record

# Maximum number of channels in one picture.
MOST = 12
_POINTS = 3000
_PANEL_IN, _TITLE_IN, _SPECTRUM_IN = 0.72, 0.24, 2.5
_BOTTOM_IN, _GAP_IN, _LEGEND_IN = 0.42, 0.72, 0.19
_LEFT, _RIGHT = 0.085, 0.985
_LEGEND_COLUMNS = 3
_COLORS = (ACCENT, INK, GRAY)
_DASHES: tuple[object, ...] = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (6, 1.5, 1, 1.5)))


def records_picture(
    records: Sequence[Record],
    periods_s: Floats,
    sa_g: Floats,
    painted: Callable[[Figure], T] = svg_text,  # type: ignore[assignment]
) -> T:
    """Return the picture of up to `MOST` records.

    `sa_g` has one row of ordinates for each record, at `periods_s`.
    """
    with style():
        # The picture is a file by itself: where it is opened, the font of the pages is missing.
        mpl.rcParams["svg.fonttype"] = "path"
        return painted(_figure(records, periods_s, sa_g))


def _figure(records: Sequence[Record], periods_s: Floats, sa_g: Floats) -> Figure:
    """Lay out from the bottom: legend, spectra, and one panel per record with its title."""
    count = len(records)
    legend_in = 0.14 + _LEGEND_IN * -(-count // _LEGEND_COLUMNS) if count > 1 else 0.0
    low_in = legend_in + _BOTTOM_IN
    panels_in = low_in + _SPECTRUM_IN + _GAP_IN
    height = panels_in + count * (_PANEL_IN + _TITLE_IN)
    figure = Figure(figsize=(WIDTH_IN, height))

    def axes_at(bottom_in: float, high_in: float) -> Axes:
        box = (_LEFT, bottom_in / height, _RIGHT - _LEFT, high_in / height)
        return figure.add_axes(box)

    places = [panels_in + k * (_PANEL_IN + _TITLE_IN) for k in reversed(range(count))]
    _histories([axes_at(bottom_in, _PANEL_IN) for bottom_in in places], records)
    axes = axes_at(low_in, _SPECTRUM_IN)
    _spectra(axes, records, periods_s, sa_g)
    if count > 1:
        columns = min(count, _LEGEND_COLUMNS)
        figure.legend(loc="lower center", ncols=columns, handlelength=3.2)
    return figure


def _histories(panels: Sequence[Axes], records: Sequence[Record]) -> None:
    """Draw all records with the same time and acceleration scales."""
    reach = max(float(np.abs(record.a_mps2).max()) for record in records) / G_MPS2 or 1.0
    longest = max((len(record.a_mps2) - 1) * record.dt_s for record in records)
    for axes, record in zip(panels, records, strict=True):
        _history(axes, record)
        axes.set_xlim(0.0, longest)
        axes.set_ylim(-1.12 * reach, 1.12 * reach)
        axes.yaxis.set_major_locator(MaxNLocator(4, symmetric=True))
        if axes is not panels[-1]:
            axes.tick_params(bottom=False, labelbottom=False)
            axes.spines["bottom"].set_visible(False)
    panels[-1].set_xlabel("Time [s]")


def _history(axes: Axes, record: Record) -> None:
    a_g = record.a_mps2 / G_MPS2
    t = record.dt_s * np.arange(len(a_g), dtype=np.float64)
    axes.plot(*envelope(t, a_g, _POINTS), color=ACCENT, linewidth=0.5)
    top = int(np.abs(a_g).argmax())
    axes.plot([t[top]], [a_g[top]], linestyle="", marker="o", markersize=3.0, color=INK)
    axes.set_title(shortened(record.name, 70), loc="left", weight="semibold", pad=2.0)
    peak = f"PGA {abs(a_g[top]):.3g} g at {t[top]:.2f} s"
    axes.set_title(peak, loc="right", pad=2.0)
    labeled(axes, y="a [g]")


def _spectra(axes: Axes, records: Sequence[Record], periods_s: Floats, sa_g: Floats) -> None:
    for place, (record, row) in enumerate(zip(records, sa_g, strict=True)):
        color = _COLORS[place % len(_COLORS)]
        dash = _DASHES[place % len(_DASHES)]
        axes.plot(
            periods_s,
            row,
            color=color,
            linestyle=dash,
            linewidth=1.2,
            label=shortened(record.name, 30),
        )
    axes.set_ylim(0.0, None)
    periods(axes, periods_s)
    title = f"Response {'spectrum' if len(records) == 1 else 'spectra'}, 5 % damping"
    labeled(axes, "Period T [s]", "Pseudo-acceleration [g]", title)


_ROW_IN, _TOP_IN, _FOOT_IN = 0.21, 0.22, 0.3
# In a history; with fewer the peaks stand apart as if the motion were slow.
_ROW_POINTS = 360
# Width of the names of the motions, in columns, at least.
_LABELS = 0.14
# A bar at most, of the largest peak and of the longest motion; at least 0.32 of them.
_BAR = 0.8
_COLUMNS = ("Record", "Transverse", "Vertical")


def accelerations(motions: Sequence[Motion]) -> str:
    """Return the scaled accelerations of the motions over time, all at one scale."""
    # All panels share one pair of axes, with offsets: one for each would take ten times as long.
    scaled = [[m.scaled(a) / G_MPS2 for a in (m.ax_mps2, m.ay_mps2, m.az_mps2)] for m in motions]
    reach = max(float(np.abs(a_g).max()) for row in scaled for a_g in row if a_g.size) or 1.0
    seconds = max(m.dt_s * (len(m.ax_mps2) - 1) for m in motions)
    height = _ROW_IN * len(motions) + _TOP_IN + _FOOT_IN
    with style():
        rows = (-len(motions) - _FOOT_IN / _ROW_IN, _TOP_IN / _ROW_IN)
        names = [name_lines(motion.id) for motion in motions]
        widest_in = max(width_in(line) for lines in names for line in lines)
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
