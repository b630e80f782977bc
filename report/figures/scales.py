"""Logarithmic scales with plain-text tick labels; the charts use no math text."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator

from report.words import letters
from solver.model import Floats


def power_of_ten(value: float) -> str:
    """Return `10⁻³` for 0.001, and 0.1, 1, 10 and 100 in full."""
    if value <= 0.0:
        return ""
    exponent = round(math.log10(value))
    return f"{10.0**exponent:g}" if -1 <= exponent <= 2 else letters.power_of_ten(exponent)


def plain(value: float) -> str:
    """Return `2.5 × 10⁻⁶` for a small number, and others in full."""
    if value == 0.0 or abs(value) >= 1e-3:
        return f"{value:g}".replace("-", "−")
    exponent = math.floor(math.log10(abs(value)))
    return f"{value / 10.0**exponent:.3g} × {letters.power_of_ten(exponent)}"


def decades(axis: Axis, maximum: int = 9) -> None:
    """Label powers of ten on a logarithmic axis, at most `maximum` of them."""
    axis.set_major_locator(LogLocator(numticks=maximum))
    axis.set_major_formatter(FuncFormatter(lambda value, _: power_of_ten(value)))
    axis.set_minor_locator(NullLocator())


def logarithmic(axes: Axes, across: int, up: int) -> None:
    """Make both axes logarithmic, each with at most so many powers of ten."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    decades(axes.xaxis, across)
    decades(axes.yaxis, up)


def periods(axes: Axes, periods_s: Floats) -> None:
    """Make the lower axis one of periods [s], logarithmic, as far as they reach."""
    axes.set_xscale("log")
    axes.set_xlim(periods_s.min(), periods_s.max())
    ticks(axes.xaxis, (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0))


def ticks(axis: Axis, values: Sequence[float]) -> None:
    """Label given values, those within the limits of the axis, and no others."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(FixedLocator([value for value in values if low <= value <= high]))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
    axis.set_minor_locator(NullLocator())
