"""Paths of an array in plan, one panel per motion, all at one scale.

Downslope is down the page, so that a path reads as seen from above by a person who faces downslope
from the top of the page. Read `hodographs`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from report.assessment.runs import MotionRun
from report.entities.columns import UnitFormat
from report.figures.base import GRAY, INK, WIDTH_IN, canvas, style, svg_text
from report.words.units import round_below
from solver.model import Floats, SlideHistory

COLUMNS = 7
TALL_IN = 0.9  # of the paths of a row, at most
TITLE_IN, FOOT_IN, APART_IN = 0.2, 0.3, 0.1
STEP_IN = 0.008  # between points of a path: what print resolves


def hodographs(
    motions: Sequence[MotionRun],
    followed: Sequence[SlideHistory],
    us_first: bool,
    printed: Callable[[str], str] = str,
) -> str:
    """Return the path in plan of the governing run of each motion, PRD marked, with a scale bar.

    `followed` are the histories of these runs; `printed` gives the names as they are printed.
    """
    paths = [path_of(history) for history in followed]
    panel = PanelScale.around(paths)
    columns = min(COLUMNS, len(paths))
    rows = math.ceil(len(paths) / columns)
    tall = rows * (panel.tall_in + TITLE_IN) + FOOT_IN
    with style():
        figure, axes = canvas(tall, (0.0, WIDTH_IN), (0.0, tall))
        for index, (run, path) in enumerate(zip(motions, paths, strict=True)):
            left = index % columns * panel.wide_in
            top = tall - index // columns * (panel.tall_in + TITLE_IN)
            name = printed(run.motion.id)
            axes.text(left, top - 0.03, name, va="top", weight="semibold")
            _draw(axes, panel, path, (left, top - TITLE_IN))
        _arrow(axes)
        _scale_bar(axes, panel.m_per_in, us_first)
        return svg_text(figure)


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """A path in plan [m]: to the right and up the page from the start; empty without a value."""

    x_m: Floats
    y_m: Floats
    peak: tuple[float, float]


def path_of(history: SlideHistory) -> Path:
    """Return the path of a run; in one axis a straight line."""
    if math.isnan(history.result.prd_m):
        return Path(x_m=np.zeros(0), y_m=np.zeros(0), peak=(0.0, 0.0))
    # Cross-slope displacement is positive to the left when facing downslope, which is down here.
    x = history.across_m if history.across_m.size else np.zeros(len(history.u_m))
    y = -history.u_m
    at = int(np.argmax(np.hypot(x, y)))
    return Path(x_m=x, y_m=y, peak=(float(x[at]), float(y[at])))


@dataclass(frozen=True, slots=True, kw_only=True)
class PanelScale:
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
        m_per_in = max(float(np.ptp(x)) / room, float(np.ptp(y)) / (TALL_IN - APART_IN), 1e-3)
        return cls(
            wide_in=wide_in,
            tall_in=float(np.ptp(y)) / m_per_in + APART_IN,
            m_per_in=m_per_in,
            start=(
                APART_IN / 2 - float(x.min()) / m_per_in,
                -APART_IN / 2 - float(y.max()) / m_per_in,
            ),
        )


def _draw(axes: Axes, panel: PanelScale, path: Path, corner: tuple[float, float]) -> None:
    x0, y0 = corner[0] + panel.start[0], corner[1] + panel.start[1]
    if not path.x_m.size:
        axes.text(x0, y0, "none", va="top")
        return
    x, y = thinned(path.x_m / panel.m_per_in, path.y_m / panel.m_per_in)
    axes.plot(x0 + x, y0 + y, color=INK, linewidth=0.6, clip_on=False)
    axes.plot(x0, y0, marker="+", markersize=8, markeredgewidth=1.0, color=INK, clip_on=False)
    peak_x, peak_y = (value / panel.m_per_in for value in path.peak)
    axes.plot(x0 + peak_x, y0 + peak_y, marker="o", markersize=3.6, color=INK, clip_on=False)


def thinned(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Return the points of a path `STEP_IN` apart along it, with its first and last."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    _, first = np.unique(np.floor(along / STEP_IN), return_index=True)
    kept = np.unique([0, *first, len(x) - 1])
    return x[kept], y[kept]


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
