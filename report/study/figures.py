"""Charts of a study, each a function from results to an SVG.

Computes only the layout; legible in black and white. Read `curves` first.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import ACCENT, GREY, INK, WIDTH_IN, bare, style, svg_text
from report.study.results import LimitState
from report.words.units import Unit
from solver.model import Floats
from solver.studies.uncertainty import Bar

LINES: tuple[Any, ...] = ("-", (0, (4, 1.6)), (0, (5, 1.4, 1, 1.4)), (0, (1, 1.4)))
MARKERS = "os^DvXP*"


def curves(
    x: Floats,
    family: Sequence[tuple[str, Floats]],
    unit: Unit,
    *,
    along: str,
    limits: Sequence[tuple[str, Floats]] = (),
) -> str:
    """Return PRD [m] against an axis, a line for each member of a family, and reference lines."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.6))
        axes = figure.add_axes((0.085, 0.285, 0.9, 0.69))
        for count, (label, prd_m) in enumerate(family):
            axes.plot(
                x,
                prd_m / unit.si,
                linestyle=LINES[count % 4],
                marker=MARKERS[count % 8],
                markersize=3.2,
                linewidth=0.9,
                color=INK if count % 2 == 0 else ACCENT,
                label=label,
            )
        for label, prd_m in limits:
            axes.plot(x, prd_m / unit.si, color=GREY, linewidth=2.0, label=label)
        _finish(axes, x, along, f"PRD [{unit.symbol}]")
        return svg_text(figure)


def _finish(axes: Axes, x: Floats, along: str, up: str) -> None:
    axes.set_xlim(min(0.0, x[0]), x[-1])
    axes.set_ylim(0.0, None)
    axes.set_xlabel(along)
    axes.set_ylabel(up)
    axes.grid(True)
    axes.set_axisbelow(True)
    axes.legend(
        loc="upper center",
        bbox_to_anchor=(0.5, -0.16),
        ncols=5,
        handlelength=2.4,
        columnspacing=1.0,
    )
    bare(axes)


def contours(
    x: Floats, y: Floats, prd_m: Floats, unit: Unit, *, along: str, up: str, allowed_m: float
) -> str:
    """Return contours of PRD [m] on a sheet of its own, the allowed PRD thick.

    Parameters
    ----------
    prd_m : array, shape (y, x)
        NaN for none.
    allowed_m : float
        NaN for none.
    """
    with style():
        figure = Figure(figsize=(WIDTH_IN, 7.6))
        axes = figure.add_axes((0.085, 0.06, 0.9, 0.925))
        shown = prd_m / unit.si
        levels = [v for v in _levels(unit) if np.nanmin(shown) < v < np.nanmax(shown)]
        if levels:
            drawn = axes.contour(x, y, shown, levels, colors=INK, linewidths=0.8)
            axes.clabel(drawn, fmt=lambda value: f"{value:g} {unit.symbol}", inline_spacing=2)
        allowed = allowed_m / unit.si
        if np.nanmin(shown) < allowed < np.nanmax(shown):
            thick = axes.contour(x, y, shown, [allowed], colors=ACCENT, linewidths=2.2)
            axes.clabel(thick, fmt=lambda value: f"{value:g} {unit.symbol}", inline_spacing=2)
        axes.set_xlim(x[0], x[-1])
        axes.set_ylim(y[0], y[-1])
        axes.set_xlabel(along)
        axes.set_ylabel(up)
        axes.grid(True)
        axes.set_axisbelow(True)
        bare(axes)
        return svg_text(figure)


def _levels(unit: Unit) -> tuple[float, ...]:
    if unit.symbol == "in":
        return (1.0, 2.0, 4.0, 6.0, 12.0, 18.0, 24.0, 36.0, 48.0, 72.0, 96.0, 144.0, 240.0, 480.0)
    return (25.0, 50.0, 100.0, 200.0, 300.0, 500.0, 750.0, 1000.0, 1500.0, 2000.0, 3000.0, 5000.0)


def fragilities(states: Sequence[LimitState], along: str) -> str:
    """Return fitted fragilities with their data points and the confidence of the medians."""
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.1))
        axes = figure.add_axes((0.085, 0.29, 0.9, 0.68))
        levels = states[0].fragility.levels
        fine = np.linspace(levels[-1] / 300.0, levels[-1], 300)
        for count, state in enumerate(states):
            f = state.fragility
            color = INK if count % 2 == 0 else ACCENT
            with np.errstate(invalid="ignore"):
                share = np.where(f.counted > 0, f.exceeded / np.maximum(f.counted, 1), np.nan)
            axes.plot(
                f.levels, share, linestyle="", marker=MARKERS[count], markersize=4.5, color=color,
                markerfacecolor="white", label=f"{state.name}, {state.words}: data",
            )  # fmt: skip
            if f.fitted.is_known:
                axes.plot(
                    fine, f.fitted.at(fine), linestyle=LINES[count], color=color, linewidth=1.2,
                    label=f"{state.name}: lognormal",
                )  # fmt: skip
                axes.plot(
                    f.theta_range, (0.5, 0.5), color=color, linewidth=2.6, solid_capstyle="butt"
                )
        axes.set_xlim(0.0, levels[-1])
        axes.set_ylim(0.0, 1.02)
        axes.set_xlabel(along)
        axes.set_ylabel("Chance of exceedance")
        axes.grid(True)
        axes.set_axisbelow(True)
        axes.legend(
            loc="upper center",
            bbox_to_anchor=(0.5, -0.2),
            ncols=3,
            handlelength=2.0,
            columnspacing=0.8,
        )
        bare(axes)
        return svg_text(figure)


def tornado(bars: Sequence[Bar], center_m: float, unit: Unit) -> str:
    """Return the tornado chart: mean PRD with each variable at its 5 % and 95 % quantile."""
    with style():
        height = 0.75 + 0.36 * len(bars)
        figure = Figure(figsize=(WIDTH_IN, height))
        axes = figure.add_axes((0.2, 0.45 / height, 0.78, 1.0 - 0.6 / height))
        for row, bar in enumerate(bars):
            ends = np.array([bar.prd_low_m, bar.prd_high_m]) / unit.si
            if np.isnan(ends).any():
                axes.text(center_m / unit.si, row, "no value at an end", va="center")
                continue
            low, high = sorted(ends)
            axes.barh(
                [row], [high - low], 0.55, left=[low], facecolor="#b8c7d9", edgecolor=INK,
                linewidth=0.8,
            )  # fmt: skip
            for end, value in zip(ends, (bar.at_low, bar.at_high), strict=True):
                is_right = end == high
                axes.annotate(
                    f"{value:.3g}", (end, row), (3 if is_right else -3, 0),
                    textcoords="offset points", va="center", ha="left" if is_right else "right",
                )  # fmt: skip
        axes.axvline(center_m / unit.si, color=INK, linewidth=1.0)
        axes.set_yticks(range(len(bars)), [bar.name for bar in bars])
        axes.set_ylim(len(bars) - 0.45, -0.55)
        reached = [v for bar in bars for v in (bar.prd_low_m, bar.prd_high_m)]
        axes.set_xlim(0.0, 1.12 * float(np.nanmax([*reached, center_m])) / unit.si)
        axes.set_xlabel(f"Mean PRD [{unit.symbol}]")
        bare(axes)
        return svg_text(figure)
