"""Histories of the displacement relative to the roof, one panel per motion.

Paths of an array in plan, one panel per motion, all at the same scale.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from report.drawing.paper_items import width_in
from report.figures.base import (
    ACCENT,
    ACROSS,
    GRAY,
    INK,
    PALE,
    WIDTH_IN,
    Broken,
    canvas,
    style,
    svg_text,
)
from report.runs import MotionRun
from report.text.names import LONGEST, name_lines
from report.text.typed_letters import cut
from report.text.unit_format import UnitFormat
from report.text.units import Unit, no_less, number, round_below
from solver.model import Floats, SlideHistory

# In a history: a panel is 150 pt wide.
MAX_POINTS = 150
ROW_IN = 0.76
# Of the titles: from line to line, and for a letter in bold.
LINE_IN, LETTER_IN = 0.13, 0.075
# Of the width of a panel: the times of two panels stand apart, and so do a PRD and the next title.
TRACE, TITLE = 0.88, 0.94
MOST_LEVELS = 4
DASHES = (0, (3.0, 1.2))


class RunPanel(NamedTuple):
    """A motion in its governing run, with its history and the name of an array or nothing."""

    array: str
    motion: MotionRun
    history: SlideHistory


def histories(panels: Sequence[RunPanel], us_first: bool) -> str:
    """Return the relative displacement in the governing run of each panel, PRD marked."""
    # All panels share one pair of axes, with offsets: one for each would take ten times as long.
    grid = _Grid(panels, UnitFormat(us_first).units()[0])
    titles = _titles(grid, panels, us_first)
    grid.above = LINE_IN / ROW_IN * (max(len(lines) for lines, _ in titles) - 1)
    with style():
        # Room for the labels of the levels at the left, and of the times below the last row.
        tall = grid.rows * (1.0 + grid.above)
        across, up = (-0.1 * grid.columns, grid.columns), (-tall - 0.3, 0.0)
        figure, axes = canvas(ROW_IN * tall + 0.3, across, up)
        _rules(axes, grid, len(panels))
        _traces(axes, grid)
        for index, (lines, prd) in enumerate(titles):
            top = grid.y(index, grid.high) + 0.07
            for count, line in enumerate(reversed(lines)):
                height = top + count * LINE_IN / ROW_IN
                axes.text(grid.x(index, 0.0), height, line, weight="semibold")
            axes.text(index % grid.columns + TITLE, top, prd, ha="right")
        return svg_text(figure)


class _Grid:
    """Position and scale of the panels of a figure."""

    def __init__(self, panels: Sequence[RunPanel], unit: Unit) -> None:
        self.followed = [
            None if math.isnan(panel.history.result.prd_m) else panel.history for panel in panels
        ]
        self.unit = unit
        # Rows are filled: four panels are two by two.
        self.columns = 2 if len(panels) in (1, 2, 4) else 3
        self.rows = math.ceil(len(panels) / self.columns)
        self.last = len(panels) - self.columns  # panels from here on are in the bottom row
        lines = [np.zeros(1)]
        for history in filter(None, self.followed):
            lines += [history.u_m, history.across_m]
        reached = np.concatenate(lines) / unit.si
        # Where nothing slips there would be no range.
        self.ticks = _levels(float(reached.min()), float(reached.max()) or 1.0)
        self.low, self.high = self.ticks[0], self.ticks[-1]
        # One time axis for all panels: a short motion ends before its panel does.
        self.seconds = max(panel.motion.seconds for panel in panels)
        self.above = 0.0  # height of all lines of a title but one, in rows

    def x(self, index: int, t_s: Any) -> Any:
        """Return the position of times, a number or an array."""
        return index % self.columns + TRACE * t_s / self.seconds

    def y(self, index: int, value: Any) -> Any:
        """Return the position of displacements in the unit of the grid, a number or an array."""
        share = (value - self.low) / (self.high - self.low)
        return -(index // self.columns + 1) * (1.0 + self.above) + 0.05 + 0.72 * share


def _levels(low: float, high: float) -> list[float]:
    """Return round levels around a range, few enough for their labels."""
    # tick_values may go beyond the range: how many levels it gives is seen only afterward.
    for count in (4, 3, 2, 1):
        levels = [float(t) for t in MaxNLocator(count).tick_values(low, high)]
        if len(levels) <= MOST_LEVELS:
            break
    return levels


def _rules(axes: Axes, grid: _Grid, count: int) -> None:
    """Draw the levels and ticks of all panels, each kind as one line with gaps."""
    levels, zeros, ticks = Broken(), Broken(), Broken()
    for index in range(count):
        left, right = grid.x(index, 0.0), grid.x(index, grid.seconds)
        for value in grid.ticks:
            level = grid.y(index, value)
            (levels if value else zeros).add([left, right], [level, level])
            if index % grid.columns == 0:
                label = number(value, 0 if abs(grid.ticks[1] - grid.ticks[0]) >= 1 else 1)
                label += f" {grid.unit.symbol}" if value == grid.high else ""
                axes.text(left - 0.012, level, label, ha="right", va="center")
        # The last row need not be full: the panel above the gap has the times.
        if index >= grid.last:
            _times(axes, grid, index, ticks)
    for line, color in ((levels, PALE), (zeros, GRAY), (ticks, INK)):
        axes.plot(line.x, line.y, color=color, linewidth=0.5, clip_on=False)


def _times(axes: Axes, grid: _Grid, index: int, ticks: Broken) -> None:
    level = grid.y(index, grid.low)
    for t in MaxNLocator(5).tick_values(0.0, grid.seconds):
        if 0.0 <= t <= grid.seconds:
            x = grid.x(index, float(t))
            ticks.add([x, x], [level, level - 0.025])
            text = f"{t:g} s" if t else "0"
            axes.text(x, level - 0.05, text, ha="center", va="top")


def _traces(axes: Axes, grid: _Grid) -> None:
    """Draw all downslope histories, all cross-slope ones, and all peaks, each as one line."""
    down, across, peaks = Broken(), Broken(), Broken()
    for index, history in enumerate(grid.followed):
        if history is None:
            middle = grid.y(index, (grid.low + grid.high) / 2)
            axes.text(grid.x(index, grid.seconds / 2), middle, "none", ha="center", va="center")
            continue
        for line, values in ((across, history.across_m), (down, history.u_m)):
            if values.size:
                t, u = envelope(history.t_s, values / grid.unit.si)
                line.add(grid.x(index, t), grid.y(index, u))
        t_prd = history.result.t_prd_s
        peak = np.interp(t_prd, history.t_s, history.u_m / grid.unit.si)
        peaks.add([grid.x(index, t_prd)], [grid.y(index, peak)])
    axes.plot(across.x, across.y, color=ACROSS, linewidth=0.9, linestyle=DASHES, clip_on=False)
    axes.plot(down.x, down.y, color=ACCENT, linewidth=0.9, clip_on=False)
    axes.plot(peaks.x, peaks.y, linestyle="", marker="o", markersize=3.2, color=INK, clip_on=False)


def _titles(
    grid: _Grid, panels: Sequence[RunPanel], us_first: bool
) -> Sequence[tuple[Sequence[str], str]]:
    """Return the lines of the title of each panel, and its PRD."""
    show, room_in = UnitFormat(us_first), (TITLE - 0.03) * WIDTH_IN / (1.1 * grid.columns)
    names = [_name(panel) for panel in panels]
    peaks = [panel.motion.governing.prd_m for panel in panels]
    prds = [show.both(prd_m, show=no_less) for prd_m in peaks]

    def fits(text: str, prd: str) -> bool:
        return width_in(text, is_bold=True) + width_in(prd) < room_in

    # The second unit of the PRDs gives way to the names, in all panels alike.
    if not all(map(fits, map("".join, names), prds)):
        prds = [show.short(prd_m, show=no_less) for prd_m in peaks]
    titles = []
    for (array, run), prd in zip(names, prds, strict=True):
        # Then the names of the arrays: motion, orientation and PRD are printed in full.
        room = (n for n in range(len(array), 3, -1) if fits(cut(array, n) + run, prd))
        lines = [cut(array, next(room, 4)) + run]
        if not fits(lines[0], prd):
            letters = int((room_in - width_in(prd)) / LETTER_IN)
            lines = name_lines(cut(array, LONGEST) + run, letters)
        titles.append((lines, prd))
    return titles


def _name(panel: RunPanel) -> tuple[str, str]:
    """Return the array of a panel, if it names one, and its motion with the orientation."""
    motion, way = panel.motion.motion, panel.motion.governing.orientation.name
    # With its component where the motion has two.
    run = f"{motion.id} {way if motion.has_transverse else way[-1]}"
    return (panel.array, f": {run}") if panel.array else ("", run)


def envelope(t: Floats, u: Floats, maximum: int = MAX_POINTS) -> tuple[Floats, Floats]:
    """Return at most `maximum` points: minimum and maximum of each segment, in order."""
    # Every n-th point would miss peaks, PRD among them.
    if len(u) <= maximum:
        return t, u
    edges = np.linspace(0, len(u), maximum // 2, dtype=int)[:-1]
    parts = [*edges.tolist(), len(u)]
    indices: list[int] = [0]
    for start, stop in pairwise(parts):
        piece = u[start:stop]
        # Sorted by time: drawn the other way round, minimum and maximum would make a sawtooth.
        indices += sorted({start + int(piece.argmin()), start + int(piece.argmax())})
    indices.append(len(u) - 1)
    index = np.unique(indices)
    return t[index], u[index]


COLUMNS = 7
# Of the paths of a row, at most.
TALL_IN = 0.9
PANEL_TITLE_IN, FOOT_IN, APART_IN = 0.2, 0.3, 0.1
# Between points of a path: what print resolves.
STEP_IN = 0.008


def hodographs(
    motions: Sequence[MotionRun], followed: Sequence[SlideHistory], us_first: bool
) -> str:
    """Return the path in plan of the governing run of each motion, PRD marked, with a scale bar.

    `followed` are the histories of these runs.
    """
    paths = [path_of(history) for history in followed]
    panel = PanelScale.around(paths)
    columns = min(COLUMNS, len(paths))
    rows = math.ceil(len(paths) / columns)
    titles = [name_lines(run.motion.id, int(panel.wide_in / LETTER_IN)) for run in motions]
    title_in = PANEL_TITLE_IN + LINE_IN * (max(map(len, titles)) - 1)
    tall = rows * (panel.tall_in + title_in) + FOOT_IN
    with style():
        figure, axes = canvas(tall, (0.0, WIDTH_IN), (0.0, tall))
        for index, (lines, path) in enumerate(zip(titles, paths, strict=True)):
            left = index % columns * panel.wide_in
            top = tall - index // columns * (panel.tall_in + title_in)
            for count, line in enumerate(lines):
                height = top - 0.03 - LINE_IN * count
                axes.text(left, height, line, va="top", weight="semibold")
            _draw(axes, panel, path, (left, top - title_in))
        _arrow(axes)
        _scale_bar(axes, panel.m_per_in, us_first)
        return svg_text(figure)


class Path(NamedTuple):
    """A path in plan [m]: to the right and up the page from the start; empty without a value."""

    x_m: Floats
    y_m: Floats


def path_of(history: SlideHistory) -> Path:
    """Return the path of a run; in one axis a straight line."""
    # A run without a final value is not drawn to where it broke off.
    if math.isnan(history.result.prd_m):
        return Path(np.zeros(0), np.zeros(0))
    # Cross-slope displacement is positive to the left when facing downslope, which is down here.
    across = history.across_m if history.across_m.size else np.zeros(len(history.u_m))
    return Path(across, -history.u_m)


class PanelScale(NamedTuple):
    """Size and scale common to all panels; `start` is the origin from the upper left corner."""

    wide_in: float
    tall_in: float
    m_per_in: float
    start: tuple[float, float]

    @classmethod
    def around(cls, paths: Sequence[Path]) -> PanelScale:
        """Return the panel that holds every path at the largest scale."""
        x = np.concatenate([[0.0], *(path.x_m for path in paths)])
        y = np.concatenate([[0.0], *(path.y_m for path in paths)])
        wide_in = WIDTH_IN / min(COLUMNS, len(paths))
        room = min(wide_in, 2.0 * TALL_IN) - APART_IN
        # One scale for x and y, and for all panels; at least 1 mm to the inch, for paths without
        # slip.
        m_per_in = max(float(np.ptp(x)) / room, float(np.ptp(y)) / (TALL_IN - APART_IN), 1e-3)
        start = APART_IN / 2 - float(x.min()) / m_per_in, -APART_IN / 2 - float(y.max()) / m_per_in
        return cls(wide_in, float(np.ptp(y)) / m_per_in + APART_IN, m_per_in, start)


def _draw(axes: Axes, panel: PanelScale, path: Path, corner: tuple[float, float]) -> None:
    x0, y0 = corner[0] + panel.start[0], corner[1] + panel.start[1]
    if not path.x_m.size:
        axes.text(x0, y0, "none", va="top")
        return
    look: Any = {"color": INK, "clip_on": False}
    x, y = path.x_m / panel.m_per_in, path.y_m / panel.m_per_in
    # From all points: the thinned path need not have the peak.
    peak = int(np.argmax(np.hypot(path.x_m, path.y_m)))
    x_few, y_few = thinned(x, y)
    axes.plot(x0 + x_few, y0 + y_few, linewidth=0.6, **look)
    axes.plot(x0, y0, marker="+", markersize=8, markeredgewidth=1.0, **look)
    axes.plot(x0 + x[peak], y0 + y[peak], marker="o", markersize=3.6, **look)


def thinned(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Return the points of a path `STEP_IN` apart along it, with its first and last."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    _, first = np.unique(np.floor(along / STEP_IN), return_index=True)
    indices = np.unique([0, *first, len(x) - 1])
    return x[indices], y[indices]


def _arrow(axes: Axes) -> None:
    """Draw the downslope direction at the lower left."""
    look = {"arrowstyle": "-|>", "color": INK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (APART_IN, 0.02), (APART_IN, 0.24), arrowprops=look)
    axes.text(2 * APART_IN, 0.1, "downslope", va="center")


def _scale_bar(axes: Axes, m_per_in: float, us_first: bool) -> None:
    """Draw a bar of a round length at the lower right."""
    unit = UnitFormat(us_first).units()[0]
    length = round_below(1.2 * m_per_in / unit.si)
    wide = length * unit.si / m_per_in
    right = WIDTH_IN - 0.9
    axes.plot([right - wide, right], [0.1, 0.1], color=INK, linewidth=2.0, solid_capstyle="butt")
    axes.text(right + 0.06, 0.1, f"{length:g} {unit.symbol}", va="center")
    axes.axhline(FOOT_IN - 0.03, color=GRAY, linewidth=0.4)
