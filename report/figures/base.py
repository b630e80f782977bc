"""Shared by all charts: fonts, style, sizes, and SVG output.

Two runs give the same bytes, independent of the machine's fonts and settings.
Read `report.figures` next.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import matplotlib as mpl
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.typeset.pdf import TEMPLATES
from solver.model import Floats

WIDTH_IN = 7.0
INK, GRAY, PALE, ACCENT = "#1a1a1a", "#707070", "#d9d9d9", "#1f4e79"
ACROSS = "#c8651b"  # distinct from ACCENT with color blindness and in gray
FAMILY = "Source Sans 3"
DASHED, DOTTED, DASHDOT = (0, (4, 1.6)), (0, (1, 1.4)), (0, (5, 1.4, 1, 1.4))
LINES: tuple[Any, ...] = ("-", DASHED, DASHDOT, DOTTED)
MARKERS = "os^DvXP*"

Range = tuple[float, float]

# Coordinates in points: the renderer spends time on decimals that print cannot show.
_DIGITS = re.compile(r"(?<=[\d-])(\.\d\d)\d{4}(?=[\s\"])")
_STYLE: Any = {
    "font.family": FAMILY,
    "font.size": 8.5,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.unicode_minus": True,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "grid.color": PALE,
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "none",  # text remains text: the pages load the same fonts
    "svg.hashsalt": "roofslip",
    "path.simplify": True,
    "text.parse_math": False,  # a dollar sign in a name is printed as such
}


@cache
def load_fonts() -> None:
    """Register the shipped fonts with the charts, once in a process."""
    for path in sorted((TEMPLATES / "fonts").glob("SourceSans3-*.ttf")):
        font_manager.fontManager.addfont(str(path))


@contextmanager
def style() -> Iterator[None]:
    """Draw in the style of the package, independent of the machine's settings."""
    load_fonts()
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_STYLE)
        yield


def svg_text(figure: Figure) -> str:
    """Return a figure as the text of an SVG, without date or creator."""
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    text = out.getvalue()
    return _DIGITS.sub(r"\1", text[text.index("<svg") :])


def png_bytes(figure: Figure) -> bytes:
    """Return a figure as a PNG that names no software."""
    out = io.BytesIO()
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
    """Draw a line for each member of a family; line and marker tell them apart without color."""
    for count, (label, y) in enumerate(family):
        axes.plot(
            x, y, linestyle=LINES[count % 4], marker=MARKERS[count % 8], markersize=4.0,
            markerfacecolor="white", markeredgewidth=0.8, linewidth=0.9,
            color=INK if count % 2 == 0 else ACCENT, label=label, **look,
        )  # fmt: skip


def legend_below(axes: Axes, down: float, columns: int, **look: Any) -> None:
    """Add a legend below the axes, down by a share of their height."""
    look = {"handlelength": 2.4, "columnspacing": 1.0} | look
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -down), ncols=columns, **look)


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

    Parameters
    ----------
    left, right : float
        Sides of the grid, as shares of the width.
    above, below : float
        Margins [in].
    wspace, hspace : float
        Between the panels, in shares of a panel.
    shared
        Axes that panels share, as in `Figure.subplots`.
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
        self.x += [*x, math.nan]
        self.y += [*y, math.nan]
