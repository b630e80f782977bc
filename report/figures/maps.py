"""Stability maps: failure and error of a method against two parameters; and sensitivity to mu."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter

from report.figures.base import ACCENT, INK, labeled, panels, style, svg_text
from report.figures.scales import decades, plain, ticks
from report.words.letters import lettered
from solver.model import Floats
from solver.verification.evidence import Conditioning, StabilityMap

MOST = 4  # maps per figure, so that it fits on a page
_BANDS = (
    (0.0, 0.1, "#ffffff", "less than 0.1 %"),
    (0.1, 1.0, "#dfe6ee", "0.1 to 1 %"),
    (1.0, 10.0, "#a9bccf", "1 to 10 %"),
    (10.0, math.inf, "#5f7890", "more than 10 %"),
)
_CONTOURS: tuple[tuple[int, Any, float], ...] = ((1, "-", 0.9), (10, (0, (4, 1.6)), 1.2))
_LIMIT: dict[str, Any] = {"color": INK, "linewidth": 1.6, "linestyle": (0, (5, 1.4, 1, 1.4))}
_FAILED: dict[str, Any] = {
    "facecolor": "white",
    "hatch": "xxxxx",
    "edgecolor": INK,
    "linewidth": 0.0,
}


def stability(maps: Sequence[StabilityMap], first: int = 1) -> str:
    """Return maps in two columns, numbered from `first`; failed cells are hatched."""
    rows = math.ceil(len(maps) / 2)
    with style():
        margins = {"left": 0.09, "right": 0.985, "above": 0.42, "below": 0.95}
        figure, grid = panels(rows, 2, 2.55 * rows + 0.6, **margins, wspace=0.28, hspace=0.52)
        for axes in grid.flat[len(maps) :]:
            axes.set_axis_off()
        for count, (axes, sweep) in enumerate(zip(grid.flat, maps, strict=False), start=first):
            _map(axes, sweep, count)
        figure.legend(handles=_key(maps), loc="lower center", ncols=4, handlelength=2.6)
        return svg_text(figure)


def _map(axes: Axes, sweep: StabilityMap, count: int) -> None:
    x, y = _edges(sweep.x, log=sweep.x_log), _edges(sweep.y)
    bands = ListedColormap([band[2] for band in _BANDS])
    norm = BoundaryNorm([0.0, 0.1, 1.0, 10.0, 1e300], bands.N)
    shown = np.ma.masked_where(sweep.failed, sweep.error_percent)
    axes.pcolormesh(x, y, shown, cmap=bands, norm=norm, linewidth=0.4, edgecolors="face")
    for row, column in np.argwhere(sweep.failed):
        axes.fill(
            [x[column], x[column + 1], x[column + 1], x[column]],
            [y[row], y[row], y[row + 1], y[row + 1]],
            **_FAILED,
        )
    _contours(axes, sweep)
    if sweep.limit.size:
        axes.plot(sweep.x, sweep.limit, **_LIMIT)
    if not math.isnan(sweep.x_mark):
        axes.axvline(sweep.x_mark, **_LIMIT)
    if sweep.x_log:
        axes.set_xscale("log")
        decades(axes.xaxis, maximum=7)
    axes.set_yscale("log")
    decades(axes.yaxis, maximum=7)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(y[0], y[-1])
    axes.set_xlabel(sweep.x_label)
    axes.set_ylabel(sweep.y_label)
    title = lettered(sweep.title).replace(": ", ":\n", 1)
    axes.set_title(f"({count}) {title}", loc="left", weight="semibold")


def _contours(axes: Axes, sweep: StabilityMap) -> None:
    levels = np.log10(np.maximum(sweep.error_percent, 1e-9))
    usable = levels[np.isfinite(levels)]
    for percent, line, width in _CONTOURS:
        level = math.log10(percent)
        if usable.size and usable.min() < level < usable.max():
            look: dict[str, Any] = {"linewidths": width, "linestyles": [line], "colors": INK}
            axes.contour(sweep.x, sweep.y, levels, [level], **look)


def _edges(centers: Floats, *, log: bool = True) -> Floats:
    """Return the edges of cells around their centers."""
    values = np.log(centers) if log else centers
    middle = (values[:-1] + values[1:]) / 2.0
    edges = np.concatenate([[2.0 * values[0] - middle[0]], middle, [2.0 * values[-1] - middle[-1]]])
    return np.asarray(np.exp(edges) if log else edges)


def _key(maps: Sequence[StabilityMap]) -> list[Any]:
    handles: list[Any] = [
        Patch(facecolor=color, edgecolor=INK, linewidth=0.4, label=text)
        for _, _, color, text in _BANDS
    ]
    handles.append(Patch(**_FAILED, label="failed"))
    handles += [
        Line2D([], [], color=INK, linewidth=width, linestyle=line, label=f"{percent} % contour")
        for percent, line, width in _CONTOURS
    ]
    if any(sweep.limit.size or not math.isnan(sweep.x_mark) for sweep in maps):
        handles.append(Line2D([], [], **_LIMIT, label="theoretical limit"))
    return handles


def conditioning(cases: Sequence[Conditioning]) -> str:
    """Return PRD over mu, and below it the change due to a small change of mu, a column each."""
    with style():
        margins = {"left": 0.12, "right": 0.985, "above": 0.208, "below": 0.416}
        between = {"wspace": 0.34, "hspace": 0.16}
        figure, grid = panels(2, len(cases), 2.6, **margins, **between, sharex="col")
        for (above, below), case in zip(grid.T, cases, strict=True):
            above.plot(case.mu, 1e3 * case.prd_m, color=ACCENT, linewidth=1.4)
            below.plot(case.mu, np.maximum(case.change_percent, 1e-14), color=INK, linewidth=0.9)
            above.set_yscale("symlog", linthresh=1.0)
            _spread(below, case.change_percent)
            ticks(above.yaxis, (0.0, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6))
            labeled(above, title=case.title)
            labeled(below, "Friction coefficient μ")
        grid[0, 0].set_ylabel("Exact PRD [mm]")
        grid[1, 0].set_ylabel("Change in PRD [%]")
        return svg_text(figure)


def _spread(axes: Axes, values: Floats) -> None:
    """Set a logarithmic scale if the values span decades, a linear scale otherwise."""
    seen = values[values > 0.0]
    if seen.size and seen.max() > 100.0 * seen.min():
        axes.set_yscale("log")
        decades(axes.yaxis, maximum=6)
    else:
        axes.set_ylim(0.0, None)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
