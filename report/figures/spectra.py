"""Response spectra: each component on logarithmic axes, and as ratio to its target.

Computes only the layout; legible in gray (line style and width carry the meaning).

A generated suite and its target: the spectra of every component, and their ratios.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from report.assessment.spectra import Spectra
from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    PALE,
    WIDTH_IN,
    Broken,
    bare,
    labeled,
    panels,
    periods,
    png_bytes,
    style,
    svg_text,
    ticks,
)
from solver.model import Floats
from solver.synthesis.matching import SpectrumFit

_ROW_IN, _TITLE_IN, _FOOT_IN, _TOP_IN = 0.6, 0.26, 0.5, 0.24
_LEFT_IN, _FIRST_IN, _APART_IN, _RIGHT_IN = 0.46, 1.6, 0.52, 0.1
_FEW_S, _MANY_S = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0), (0.03, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
_LEVELS = tuple(step * 10.0**power for power in range(-4, 2) for step in (1, 2, 5))
_FACTOR = 3.0  # a ratio beyond it is drawn on a logarithmic axis
LEAST_G = 1e-4
"""Ordinate below which nothing is drawn [g]."""

_CORNER_S = 1 / 1.3
"""Longest period that the acceptance of AC156 covers."""

_DASHES = (0, (5, 1.5))
_THIN = 2  # the narrow panel shows every second period: the wide one has all of them


def spectra(parts: Sequence[Spectra]) -> str:
    """Return a row per component: spectra over period, and their ratio to the target.

    The motions are a band from the smallest to the largest: lines as close as these cannot be told
    apart. The mean is thick, the target dashed. A component without a target has no ratio.
    """
    height = _TOP_IN + (_ROW_IN + _TITLE_IN) * len(parts) + _FOOT_IN
    ratio_in = WIDTH_IN - _LEFT_IN - _FIRST_IN - _APART_IN - _RIGHT_IN
    with style():
        figure = Figure(figsize=(WIDTH_IN, height))

        def panel(left_in: float, wide_in: float, row: int) -> Axes:
            low_in = height - _TOP_IN - (row + 1) * (_ROW_IN + _TITLE_IN)
            box = (left_in / WIDTH_IN, low_in / height, wide_in / WIDTH_IN, _ROW_IN / height)
            return figure.add_axes(box)

        for row, part in enumerate(parts):
            axes = panel(_LEFT_IN, _FIRST_IN, row)
            _ordinates(axes, part)
            _finish(axes, part, _FEW_S, is_last=row == len(parts) - 1)
            if part.target.name:
                axes = panel(_LEFT_IN + _FIRST_IN + _APART_IN, ratio_in, row)
                _ratios(axes, part)
                _finish(axes, part, _MANY_S, is_last=row == len(parts) - 1)
        lines = figure.axes[0].get_legend_handles_labels()
        figure.legend(*lines, loc="upper right", ncols=3, borderaxespad=0.1)
        return svg_text(figure)


def _ordinates(axes: Axes, part: Spectra) -> None:
    seen = np.concatenate([part.sa_g.ravel(), part.target_g])
    seen = seen[np.isfinite(seen) & (seen > LEAST_G)]
    low, high = (0.85 * seen.min(), 1.3 * seen.max()) if seen.size else (0.1, 1.0)
    axes.set_ylim(low, high)
    axes.set_yscale("log", nonpositive="mask")
    _band(axes, part.periods_s[::_THIN], part.sa_g[:, ::_THIN])
    axes.plot(
        part.periods_s, part.target_g, color=INK, linewidth=1.4, linestyle=_DASHES, label="target"
    )
    _label(axes.yaxis, _LEVELS if high < 30.0 * low else _LEVELS[::3])
    axes.set_title(f"{part.title} [g]", loc="left", weight="semibold", pad=3)


def _label(axis: Axis, values: Sequence[float]) -> None:
    # Not `scales.ticks`: small ordinates are printed in full here.
    axis.set_major_locator(FixedLocator(values))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())


def _ratios(axes: Axes, part: Spectra) -> None:
    ratios = part.sa_g / part.target_g
    _band(axes, part.periods_s, ratios)
    axes.axhline(1.0, color=INK, linewidth=1.4, linestyle=_DASHES)
    low, high = np.nanmin(ratios), np.nanmax(ratios)
    if high > _FACTOR:
        axes.set_ylim(0.85 * min(low, 1.0), 1.2 * high)
        axes.set_yscale("log")
        _label(axes.yaxis, _LEVELS[:: 1 if high < 20.0 else 3 if high < 1e3 else 6])
    else:
        axes.set_ylim(min(low, 1.0) - 0.04, max(high, 1.0) + 0.04)
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    axes.set_title(f"{part.title} / target, {part.target.name}", loc="left", weight="semibold",
                   pad=3)  # fmt: skip
    if not part.is_ground:
        axes.axvline(_CORNER_S, color=INK, linewidth=0.6, linestyle=":")
        axes.text(_CORNER_S, 1.03, "1.3 Hz", transform=axes.get_xaxis_transform(), ha="left")


def _band(axes: Axes, periods_s: Floats, rows: Floats) -> None:
    """Draw the extent of the motions, and their mean."""
    ends = rows.min(axis=0), rows.max(axis=0)
    look: Any = {"facecolor": PALE, "edgecolor": GRAY, "linewidth": 0.5}
    axes.fill_between(periods_s, *ends, **look, label="smallest to largest motion")
    axes.plot(periods_s, rows.mean(axis=0), color=ACCENT, linewidth=1.8, label="mean")


def _finish(axes: Axes, part: Spectra, ticks: Sequence[float], *, is_last: bool) -> None:
    axes.set_xscale("log")
    axes.set_xlim(ticks[0], part.periods_s[-1])
    _label(axes.xaxis, ticks)
    if is_last:
        axes.set_xlabel("Period T [s]")
    else:
        axes.tick_params(labelbottom=False)
    axes.grid(True)
    bare(axes)


_PANEL_IN, _GAP_IN, _ABOVE_IN, _BOTTOM_IN = 1.55, 0.5, 0.5, 0.46
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
        height = _ABOVE_IN + _BOTTOM_IN + rows * (_PANEL_IN + _GAP_IN) - _GAP_IN
        margins = {"left": 0.075, "right": 0.985, "above": _ABOVE_IN, "below": _BOTTOM_IN}
        between = {"hspace": _GAP_IN / _PANEL_IN, "wspace": 0.16}
        figure, grid = panels(rows, 2, height, **margins, **between)
        for (left, right), panel in zip(grid, components, strict=True):
            _spectra(left, panel)
            _component_ratios(right, panel)
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


def _component_ratios(axes: Axes, panel: Panel) -> None:
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
