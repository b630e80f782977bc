"""Shared by all charts: fonts, style, sizes, and SVG output.

Two runs give the same bytes, independent of the machine's fonts and settings.
Read `report.figures` next.

"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import matplotlib as mpl
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator

from report.text import error_text
from report.typeset.pdf import TEMPLATES
from solver.model import Floats

WIDTH_IN = 7.0
INK, GRAY, PALE, ACCENT = "#1a1a1a", "#707070", "#d9d9d9", "#1f4e79"
# Distinct from ACCENT with color blindness and in gray.
ACROSS = "#c8651b"
DASHED, DOTTED, DASHDOT = (0, (4, 1.6)), (0, (1, 1.4)), (0, (5, 1.4, 1, 1.4))
LINES: tuple[Any, ...] = ("-", DASHED, DASHDOT, DOTTED)
MARKERS = "os^DvXP*"

Range = tuple[float, float]
T = TypeVar("T")  # what a figure is painted to

# Coordinates in points: the renderer spends time on decimals that print cannot show.
_DIGITS = re.compile(r"(?<=[\d-])(\.\d\d)\d{4}(?=[\s\"])")
# The look of an element, and what matplotlib gives to all.
_DECLARED = re.compile(r'\bstyle="([^"]*)"')
_RULE = '<style type="text/css">*{stroke-linejoin: round; stroke-linecap: butt}</style>'
_OF_ALL = '<svg stroke-linejoin="round" stroke-linecap="butt"'
_STYLE = Path(__file__).with_name("package.mplstyle")


@cache
def load_fonts() -> None:
    """Register the shipped fonts with the charts, once in a process."""
    # The fonts of the pages: a machine need not have them, and charts are lettered as the text is.
    for path in sorted((TEMPLATES / "fonts").glob("SourceSans3-*.ttf")):
        font_manager.fontManager.addfont(str(path))


@contextmanager
def style() -> Iterator[None]:
    """Draw in the style of the package, independent of the machine's settings."""
    load_fonts()
    with mpl.rc_context(fname=_STYLE):
        yield


def svg_text(figure: Figure) -> str:
    """Return a figure as the text of an SVG, without date or creator."""
    out = io.StringIO()
    # Without date and creator two runs give the same bytes.
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    text = out.getvalue()
    # From <svg> on: the XML declaration and the DOCTYPE before it are errors within HTML.
    text = _DIGITS.sub(r"\1", text[text.index("<svg") :])
    # The renderer parses a style as CSS, and reads an attribute: a sixth of the time of a chart.
    return _DECLARED.sub(_attributes, text.replace(_RULE, "").replace("<svg", _OF_ALL, 1))


def _attributes(declared: re.Match[str]) -> str:
    pairs = (declaration.split(": ", 1) for declaration in declared[1].split("; "))
    return " ".join(f'{name}="{value}"' for name, value in pairs)


def png_bytes(figure: Figure) -> bytes:
    """Return a figure as a PNG that names no software."""
    out = io.BytesIO()
    # The name of matplotlib has its version, by which the bytes would differ.
    figure.savefig(out, format="png", dpi=200, metadata={"Software": None})
    return out.getvalue()


def boxed(height: float, box: tuple[float, float, float, float]) -> tuple[Figure, Axes]:
    """Return a figure and its axes: left, bottom, width and height, in shares of the figure."""
    figure = Figure(figsize=(WIDTH_IN, height))
    return figure, figure.add_axes(box)


def framed(height: float, left: float, right: float, top: float, bottom: float) -> Any:
    """Return a figure and its axes with margins [in]; automatic layout takes as long as drawing."""
    wide, tall = 1.0 - (left + right) / WIDTH_IN, 1.0 - (top + bottom) / height
    return boxed(height, (left / WIDTH_IN, bottom / height, wide, tall))


def canvas(height: float, x: Range, y: Range, width: float = WIDTH_IN) -> tuple[Figure, Axes]:
    """Return a figure, and axes with these limits over all of it that are not drawn."""
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    return figure, axes


def bare(axes: Axes) -> None:
    """Hide the top and right spines."""
    axes.spines[["top", "right"]].set_visible(False)


def labeled(axes: Axes, x: str = "", y: str = "", title: str = "") -> None:
    """Name a panel and its axes; the grid lies behind what is drawn."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if title:
        axes.set_title(title, loc="left", weight="semibold")
    axes.grid(True)
    axes.set_axisbelow(True)
    bare(axes)


def draw_family(axes: Axes, x: Floats, family: Iterable[tuple[str, Floats]], **look: Any) -> None:
    """Draw a line for each member of a family."""
    for count, (label, y) in enumerate(family):
        axes.plot(x, y, **member_look(count), label=label, **look)


def member_look(count: int) -> dict[str, Any]:
    """Return how a member of a family is drawn: line and marker tell it apart without color."""
    return {
        "linestyle": LINES[count % 4], "marker": MARKERS[count % 8], "markersize": 4.0,
        "markerfacecolor": "white", "markeredgewidth": 0.8, "linewidth": 0.9,
        "color": INK if count % 2 == 0 else ACCENT,
    }  # fmt: skip


def legend_below(axes: Axes, columns: int, **look: Any) -> None:
    """Add a legend below the axes and their labels."""
    look = {"handlelength": 2.4, "columnspacing": 1.0} | look
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), ncols=columns, **look)


def panels(
    rows: int,
    columns: int,
    height: float,
    *,
    left: float,
    right: float,
    above: float,
    below: float,
    wspace: float = 0.0,
    hspace: float = 0.0,
    **shared: Any,
) -> Any:
    """Return a figure and its grid of panels.

    `left` and `right` are shares of the width, `above` and `below` inches, `wspace` and `hspace`
    shares of a panel.
    """
    figure = Figure(figsize=(WIDTH_IN, height))
    top, bottom = 1.0 - above / height, below / height
    figure.subplots_adjust(left, bottom, right, top, wspace, hspace)
    return figure, figure.subplots(rows, columns, squeeze=False, **shared)


class Broken:
    """A line with gaps: one path instead of many."""

    def __init__(self) -> None:
        self.x: list[float] = []
        self.y: list[float] = []

    def add(self, x: Iterable[float], y: Iterable[float]) -> None:
        """Append a segment."""
        # matplotlib lifts its pen at NaN.
        self.x += [*x, math.nan]
        self.y += [*y, math.nan]


def power_of_ten(value: float) -> str:
    """Return `10⁻³` for 0.001, and 0.1, 1, 10 and 100 in full."""
    if value <= 0.0:
        return ""
    exponent = round(math.log10(value))
    return f"{10.0**exponent:g}" if -1 <= exponent <= 2 else error_text.power_of_ten(exponent)


def plain(value: float) -> str:
    """Return `2.5 × 10⁻⁶` for a small number, and others in full."""
    if value == 0.0 or abs(value) >= 1e-3:
        return f"{value:g}".replace("-", "−")
    exponent = math.floor(math.log10(abs(value)))
    return f"{value / 10.0**exponent:.3g} × {error_text.power_of_ten(exponent)}"


def decades(axis: Axis, maximum: int = 9) -> None:
    """Label powers of ten on a logarithmic axis, at most `maximum` of them."""
    axis.set_major_locator(LogLocator(numticks=maximum))
    # Plain text: the labels of matplotlib are math text, which the style does not parse.
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
