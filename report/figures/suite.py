"""A generated suite and its target: the spectra of every component, and their ratios.

Computes only the layout; the picture is a stand-alone file. Read `report.figures.base` first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    PALE,
    Broken,
    labeled,
    panels,
    png_bytes,
    style,
)
from report.figures.scales import periods, ticks
from solver.synthesis.target import SpectrumFit

_PANEL_IN, _GAP_IN, _TOP_IN, _BOTTOM_IN = 1.55, 0.5, 0.5, 0.46
_TICKS_G = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
_RATIO_RANGE = (0.8, 1.4)


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One component of all motions.

    Attributes
    ----------
    fits : tuple of SpectrumFit
        One per motion, all at the same frequencies.
    band_hz, limits : tuple of float
        Frequency band and limits of the ratios.
    """

    title: str
    fits: tuple[SpectrumFit, ...]
    band_hz: tuple[float, float]
    limits: tuple[float, float]


def suite_png(components: Sequence[Panel]) -> bytes:
    """Return a picture with a row for each component: spectra left, ratios right."""
    with style():
        rows = len(components)
        height = _TOP_IN + _BOTTOM_IN + rows * (_PANEL_IN + _GAP_IN) - _GAP_IN
        margins = {"left": 0.075, "right": 0.985, "above": _TOP_IN, "below": _BOTTOM_IN}
        between = {"hspace": _GAP_IN / _PANEL_IN, "wspace": 0.16}
        figure, grid = panels(rows, 2, height, **margins, **between)
        for (left, right), panel in zip(grid, components, strict=True):
            _spectra(left, panel)
            _ratios(right, panel)
        for axes in grid[-1]:
            axes.set_xlabel("Period T [s]")
        marks, names = grid[0][0].get_legend_handles_labels()
        more = grid[0][1].get_legend_handles_labels()
        figure.legend(marks + more[0], names + more[1], loc="upper center", ncols=5, borderpad=0.2)
        return png_bytes(figure)


def _spectra(axes: Axes, panel: Panel) -> None:
    t_s = 1.0 / panel.fits[0].freq_hz
    each = Broken()
    for fit in panel.fits:
        each.add(t_s, fit.achieved_g)
    axes.plot(each.x, each.y, color=GRAY, linewidth=0.45, label="each motion")
    mean = np.mean([fit.achieved_g for fit in panel.fits], axis=0)
    axes.plot(t_s, mean, color=ACCENT, linewidth=1.6, label="mean")
    axes.plot(
        t_s,
        panel.fits[0].target_g,
        color=INK,
        linewidth=1.2,
        linestyle=(0, (5, 1.5)),
        label="target",
    )
    axes.set_yscale("log")
    ticks(axes.yaxis, _TICKS_G)
    periods(axes, t_s)
    labeled(axes, y="Pseudo-acceleration [g]", title=panel.title)


def _ratios(axes: Axes, panel: Panel) -> None:
    t_s = 1.0 / panel.fits[0].freq_hz
    fast, slow = 1.0 / panel.band_hz[1], 1.0 / panel.band_hz[0]
    axes.axhline(1.0, color=INK, linewidth=0.8, linestyle=(0, (5, 1.5)))
    each = Broken()
    for fit in panel.fits:
        each.add(t_s, np.clip(fit.ratio, *_RATIO_RANGE))
    axes.plot(each.x, each.y, color=GRAY, linewidth=0.45)
    mean = np.mean([fit.ratio for fit in panel.fits], axis=0)
    axes.plot(t_s, np.clip(mean, *_RATIO_RANGE), color=ACCENT, linewidth=1.6)
    least, greatest = panel.limits
    limits = f"limits {least:.2f} and {greatest:.2f}"
    axes.hlines(panel.limits, fast, slow, color=INK, linewidth=1.0, label=limits)
    beyond = f"outside {panel.band_hz[0]:g} to {panel.band_hz[1]:g} Hz"
    axes.axvspan(slow, t_s[0], color=PALE, alpha=0.5, linewidth=0, label=beyond)
    axes.axvspan(t_s[-1], fast, color=PALE, alpha=0.5, linewidth=0)
    axes.set_ylim(*_RATIO_RANGE)
    periods(axes, t_s)
    labeled(axes, y="Achieved / target")
