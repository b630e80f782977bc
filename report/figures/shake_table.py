"""Computed against measured slip of shake-table tests."""

from __future__ import annotations

from report.figures.base import ACCENT, INK, PALE, framed, labeled, style, svg_text
from report.figures.scales import ticks
from solver.verification.shake_table import RATIOS, ShakeTable

_TICKS = tuple(digit * 10.0**power for power in range(-1, 6) for digit in (1, 2, 5))


def computed_against_measured(table: ShakeTable) -> str:
    """Return a dot for each test with both values, and the range in which 80 % shall lie [mm]."""
    runs = [run for run in table.runs if run.ratio > 0.0]
    measured = [1e3 * run.test.prd_m for run in runs]
    computed = [1e3 * run.prd_m for run in runs]
    low, high = 0.7 * min(measured + computed), 1.4 * max(measured + computed)
    with style():
        figure, axes = framed(2.25, 2.45, 2.45, 0.1, 0.45)
        least, most = RATIOS
        axes.fill_between([low, high], [least * low, least * high], [most * low, most * high],
                          color=PALE, linewidth=0.0)  # fmt: skip
        axes.plot([low, high], [low, high], color=INK, linewidth=0.8)
        axes.plot(measured, computed, linestyle="", marker="o", markersize=4.0, color=ACCENT)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(low, high)
        axes.set_ylim(low, high)
        for axis in (axes.xaxis, axes.yaxis):
            ticks(axis, _TICKS)
        labeled(axes, "PRD, stated [mm]", "PRD, computed [mm]")
        return svg_text(figure)
