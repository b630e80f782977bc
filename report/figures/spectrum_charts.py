"""Response spectra: each component on logarithmic axes, and as ratio to its target.

Computes only the layout; legible in gray (line style and width carry the meaning).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from report.assessment.support.response_spectra import Spectra
from report.figures.base import ACCENT, GRAY, INK, PALE, WIDTH_IN, T, bare, style, svg_text
from solver.model import Floats

_ROW_IN, _TITLE_IN, _FOOT_IN, _TOP_IN = 0.6, 0.26, 0.5, 0.24
_LEFT_IN, _FIRST_IN, _APART_IN, _RIGHT_IN = 0.46, 1.6, 0.52, 0.1
_FEW_S, _MANY_S = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0), (0.03, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
_LEVELS = tuple(step * 10.0**power for power, step in product(range(-4, 2), (1, 2, 5)))
# A ratio beyond it is drawn on a logarithmic axis.
_FACTOR = 3.0
# Ordinate below which nothing is drawn [g].
LEAST_G = 1e-4

# Longest period that the acceptance of AC156 covers.
_CORNER_S = 1 / 1.3

_DASHES = (0, (5, 1.5))
# The narrow panel shows every second period: the wide one has all of them.
_THIN = 2


def spectra(
    parts: Sequence[Spectra],
    painted: Callable[[Figure], T] = svg_text,  # type: ignore[assignment]
) -> T:
    """Return a row per component: spectra over period, and their ratio to the target.

    The mean is thick, the target dashed. A component without a target has no ratio.
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
        # One legend: all panels have the same lines.
        lines = figure.axes[0].get_legend_handles_labels()
        figure.legend(*lines, loc="upper right", ncols=3, borderaxespad=0.1)
        return painted(figure)


def _ordinates(axes: Axes, part: Spectra) -> None:
    seen = np.concatenate([part.sa_g.ravel(), part.target_g])
    seen = seen[np.isfinite(seen) & (seen > LEAST_G)]
    low, high = (0.85 * seen.min(), 1.3 * seen.max()) if seen.size else (0.1, 1.0)
    axes.set_ylim(low, high)
    # Ordinates may be 0 at long periods, which the logarithm does not have.
    axes.set_yscale("log", nonpositive="mask")
    _band(axes, part.periods_s[::_THIN], part.sa_g[:, ::_THIN])
    axes.plot(
        part.periods_s, part.target_g, color=INK, linewidth=1.4, linestyle=_DASHES, label="target"
    )
    # Every third of 1, 2, 5, 10 and so on is a power of ten.
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
    # NaN where the target is not given.
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
    # A band from the smallest to the largest: lines as close as these cannot be told apart.
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
