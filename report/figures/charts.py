"""Charts of the package, each a function from computed results to an SVG.

Computes only the layout; legible in black and white (line style, marker and hatching carry the
meaning). Fonts and style are in `base`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from report.assessment.arrays import ArrayAssessment
from report.assessment.clearances import ClearanceCheck
from report.assessment.spectra import Spectra
from report.figures.accelerations import accelerations
from report.figures.base import (
    ACCENT,
    FAMILY,
    GREY,
    INK,
    WIDTH_IN,
    Broken,
    bare,
    framed,
    load_fonts,
    style,
    svg_text,
    tick_text,
)
from report.figures.history import MAX_POINTS, envelope, histories
from report.figures.hodograph import hodographs
from report.figures.plan import is_wide, roof_plan
from report.figures.plan_sheet import LANDSCAPE, PORTRAIT, SMALL
from report.words.units import Quantity, Unit

__all__ = [
    "FAMILY",
    "LANDSCAPE",
    "MAX_POINTS",
    "PORTRAIT",
    "SMALL",
    "accelerations",
    "clearances",
    "comparison",
    "envelope",
    "histories",
    "hodographs",
    "is_wide",
    "load_fonts",
    "roof_plan",
    "spectra",
]


def spectra(parts: Sequence[Spectra]) -> str:
    """Return the spectra: motions thin, mean and target thick, one panel per component."""
    with style():
        height = 0.62 + _PANEL_IN[min(len(parts), 3)] * len(parts)
        figure = Figure(figsize=(WIDTH_IN, height))
        figure.subplots_adjust(
            left=0.07, right=0.99, top=1 - 0.22 / height, bottom=0.4 / height, hspace=0.2
        )
        panels = np.atleast_1d(figure.subplots(len(parts), 1, sharex=True))
        for axes, part in zip(panels, parts, strict=True):
            each = Broken()
            for row in part.sa_g:
                each.add(part.periods_s, row)
            axes.plot(each.x, each.y, color=GREY, linewidth=0.45, label="each motion")
            axes.plot(part.periods_s, part.mean_g, color=ACCENT, linewidth=1.8, label="mean")
            axes.plot(
                part.periods_s,
                part.target_g,
                color=INK,
                linewidth=1.8,
                linestyle=(0, (5, 1.5)),
                label="target",
            )
            _spectrum_axes(axes, part)
        panels[0].legend(loc="upper right")
        panels[-1].set_xlabel("Period T [s]")
        return svg_text(figure)


def _spectrum_axes(axes: Axes, part: Spectra) -> None:
    axes.set_xscale("log")
    axes.set_xlim(_PERIOD_TICKS[0], part.periods_s[-1])
    axes.set_ylim(0, None)
    axes.xaxis.set_major_locator(FixedLocator(_PERIOD_TICKS))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_ylabel("Pseudo-acc. [g]")
    goal = part.target.name or "none"
    axes.set_title(f"{part.title} (target: {goal})", loc="left", weight="semibold", pad=3)
    axes.grid(True)
    axes.axvline(1 / 1.3, color=INK, linewidth=0.6, linestyle=":")
    axes.text(1.04 / 1.3, 0.98, "1.3 Hz", transform=axes.get_xaxis_transform(), va="top")
    bare(axes)


_PANEL_IN = {
    1: 2.0,
    2: 1.9,
    3: 1.25,
}  # panel height by number of panels: all fit on the page of the text
_PERIOD_TICKS = (0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0)


def comparison(arrays: Sequence[ArrayAssessment], us_first: bool) -> str:
    """Return prescriptive value, floor, PRD of each motion, mean and design value by array."""
    first, second = Quantity.DISPLACEMENT.value if us_first else Quantity.DISPLACEMENT.value[::-1]
    with style():
        height = 1.3 + _row_in(len(arrays)) * len(arrays)
        names = [tick_text(array.id) for array in arrays]
        figure, axes = framed(height, _label_in(names), 0.1, 0.48, 0.75)
        for row, array in enumerate(arrays):
            _compare(axes, row, array, first, labeled=row == 0)
        axes.set_yticks(range(len(arrays)), names)
        axes.set_ylim(len(arrays) - 0.45, -0.55)
        axes.set_xlim(0, None)
        axes.set_xlabel(f"Horizontal displacement [{first.symbol}]")
        _second_scale(axes, first, second)
        axes.grid(True, axis="x")
        axes.set_axisbelow(True)
        marks, names = axes.get_legend_handles_labels()
        order = sorted(range(len(names)), key=lambda k: _LEGEND.index(names[k]))
        figure.legend(
            [marks[k] for k in order],
            [names[k] for k in order],
            loc="lower center",
            ncols=5,
            handlelength=2.2,
        )
        return svg_text(figure)


_LEGEND = ("prescriptive", "floor", "PRD of each motion", "mean", "design")


def _label_in(names: Sequence[str]) -> float:
    """Return the width of the tick labels [in]."""
    return 0.2 + 0.06 * max(map(len, names))


def _row_in(count: int) -> float:
    """Return the height of a row of a chart with `count` rows [in]."""
    return min(0.48, 5.4 / count)


def _second_scale(axes: Axes, first: Unit, second: Unit) -> None:
    ratio = first.si / second.si

    def forth(value: Any) -> Any:
        return value * ratio

    def back(value: Any) -> Any:
        return value / ratio

    other = axes.secondary_xaxis("top", functions=(forth, back))
    other.set_xlabel(f"[{second.symbol}]")
    axes.spines["right"].set_visible(False)


def _compare(axes: Axes, row: int, array: ArrayAssessment, unit: Unit, *, labeled: bool) -> None:
    def text(label: str) -> str:
        return label if labeled else "_"

    prescriptive = array.prescriptive.value_m / unit.si
    axes.barh(
        [row],
        [prescriptive],
        0.62,
        facecolor="white",
        edgecolor=GREY,
        linewidth=0.8,
        label=text("prescriptive"),
    )
    if array.floor_m > 0:
        floor = array.floor_m / unit.si
        axes.plot(
            [floor, floor],
            [row - 0.4, row + 0.4],
            color=INK,
            linestyle=(0, (3, 2)),
            linewidth=1.2,
            label=text("floor"),
        )
    peaks = np.array([run.governing.prd_m for run in array.motions]) / unit.si
    axes.plot(
        peaks,
        np.full(peaks.shape, float(row)),
        linestyle="",
        marker="o",
        markersize=4,
        markerfacecolor="none",
        markeredgecolor=ACCENT,
        markeredgewidth=0.8,
        label=text("PRD of each motion"),
    )
    mean = array.analysis.mean_m / unit.si
    axes.plot(
        [mean, mean], [row - 0.25, row + 0.25], color=ACCENT, linewidth=2.0, label=text("mean")
    )
    design = array.design_m / unit.si
    axes.plot(
        [design], [row], linestyle="", marker="D", markersize=6, color=INK, label=text("design")
    )
    if math.isnan(array.design_m):
        axes.text(prescriptive / 2, row, "none", ha="center", va="center")


def clearances(gaps: Sequence[ClearanceCheck], us_first: bool, start: int = 1) -> str:
    """Return required and provided separations as bars, numbered from `start`."""
    first, second = Quantity.DISPLACEMENT.value if us_first else Quantity.DISPLACEMENT.value[::-1]
    provided = [gap.clearance.provided_m / first.si for gap in gaps]
    required = [gap.required_m / first.si for gap in gaps]
    rows = np.arange(len(gaps), dtype=float)
    with style():
        names = [
            f"{count}  {tick_text(gap.clearance.array)} to {tick_text(gap.clearance.object)}"
            for count, gap in enumerate(gaps, start=start)
        ]
        figure, axes = framed(
            1.3 + min(_row_in(len(gaps)), 0.34) * len(gaps), _label_in(names), 0.1, 0.48, 0.75
        )
        axes.barh(
            rows - 0.18,
            provided,
            0.34,
            facecolor="white",
            edgecolor=INK,
            linewidth=0.8,
            label="provided",
        )
        axes.barh(
            rows + 0.18,
            np.nan_to_num(required),
            0.34,
            facecolor="#b8c7d9",
            edgecolor=INK,
            linewidth=0.8,
            hatch="///",
            label="required",
        )
        axes.set_yticks(rows, names)
        axes.set_ylim(len(gaps) - 0.45, -0.55)
        for row, gap in zip(rows, gaps, strict=True):
            text = "none: NG" if math.isnan(gap.required_m) else "OK" if gap.ok else "NG"
            reach = np.nanmax([provided[int(row)], required[int(row)]])
            axes.annotate(
                text,
                (reach, row),
                (5, 0),
                textcoords="offset points",
                va="center",
                weight="normal" if gap.ok else "semibold",
            )
        axes.set_xlabel(f"Separation [{first.symbol}]")
        axes.margins(x=0.12)
        axes.set_xlim(0, None)
        _second_scale(axes, first, second)
        axes.grid(True, axis="x")
        axes.set_axisbelow(True)
        figure.legend(loc="lower center", ncols=2)
        return svg_text(figure)
