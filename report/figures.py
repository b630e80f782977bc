"""Charts of the package, each a function from what was computed to the text of an SVG.

Computes nothing but where ink goes; reads well in black and white (line style, marker and
hatching carry the meaning). Two runs give the same bytes. Read `report.package` next.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib import font_manager
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from matplotlib.patches import Rectangle as Box
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

from report.assess import ArrayAssessment, ClearanceCheck, MotionRun
from report.schema import ObjectKind, ProjectInput, Rectangle
from report.spectra import Spectra
from report.units import Quantity, Unit, number, pair
from solver.model import Floats

WIDTH_IN = 6.7
INK, GREY, PALE, ACCENT = "#1a1a1a", "#707070", "#d9d9d9", "#1f4e79"
FAMILY = "Source Sans 3"
MAX_POINTS = 320  # in a history; a panel is 150 points of paper wide

_STYLE: Any = {
    "font.family": FAMILY,
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.unicode_minus": True,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "grid.color": PALE,
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "none",  # text stays text: the pages load the same fonts
    "svg.hashsalt": "roofslip",
    "path.simplify": True,
    "text.parse_math": False,  # a dollar sign in a name is a dollar sign
}


def load_fonts(folder: Path) -> None:
    """Make the shipped fonts known to the charts."""
    known = {entry.fname for entry in font_manager.fontManager.ttflist}
    for path in sorted(folder.glob("SourceSans3-*.ttf")):
        if str(path) not in known:
            font_manager.fontManager.addfont(str(path))


@contextmanager
def style() -> Iterator[None]:
    """Draw in the package's style, whatever the machine's settings are."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_STYLE)
        yield


def _svg(figure: Figure) -> str:
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    text = out.getvalue()
    return text[text.index("<svg") :]


def _framed(height: float, left: float, right: float, top: float, bottom: float) -> Any:
    """Return a figure and its axes with margins in inches: measuring them takes half the time."""
    figure = Figure(figsize=(WIDTH_IN, height))
    box = (
        left / WIDTH_IN,
        bottom / height,
        1.0 - (left + right) / WIDTH_IN,
        1.0 - (top + bottom) / height,
    )
    return figure, figure.add_axes(box)


def _bare(axes: Axes) -> None:
    axes.spines[["top", "right"]].set_visible(False)


def _ticks(unit: Unit) -> FuncFormatter:
    return FuncFormatter(lambda value, _: number(value, 0 if abs(value) >= 10 else 1).rstrip())


def roof_plan(data: ProjectInput, us_first: bool) -> str:
    """Arrays, objects and edges to scale, with the gaps that are checked and the slope's fall."""
    unit = Quantity.PLAN.us if us_first else Quantity.PLAN.si
    shapes: dict[str, Rectangle | None] = {item.id: item.rectangle for item in data.objects}
    shapes |= {item.id: item.rectangle for item in data.arrays}
    drawn = [shape for shape in shapes.values() if shape is not None]
    x0, x1 = min(r.x_from_m for r in drawn), max(r.x_to_m for r in drawn)
    y0, y1 = min(r.y_from_m for r in drawn), max(r.y_to_m for r in drawn)
    span = max(x1 - x0, y1 - y0)
    height = min(max((WIDTH_IN - 0.6) * (y1 - y0) / max(x1 - x0, 1e-9), 2.0), 6.0)
    with style():
        figure, axes = _framed(height + 0.55, 0.5, 0.1, 0.1, 0.45)
        _objects(axes, data, span)
        for array in data.arrays:
            _array(axes, array.id, array.rectangle, array.downslope_deg, array.slope_rad)
        _gaps(axes, data, shapes, span)
        _plan_axes(axes, unit, (x0, x1, y0, y1), span)
        return _svg(figure)


def _plan_axes(axes: Axes, unit: Unit, box: tuple[float, float, float, float], span: float) -> None:
    x0, x1, y0, y1 = box
    pad = 0.03 * span
    axes.set_xlim(x0 - pad, x1 + pad)
    axes.set_ylim(y0 - pad, y1 + pad)
    axes.set_aspect("equal")
    _bare(axes)
    for axis, name in ((axes.xaxis, "x"), (axes.yaxis, "y")):
        ticks = MaxNLocator(8).tick_values(*(v / unit.si for v in axis.get_view_interval()))
        low, high = axis.get_view_interval()
        kept = [t for t in ticks if low <= t * unit.si <= high]
        axis.set_major_locator(FixedLocator([t * unit.si for t in kept]))
        axis.set_major_formatter(FuncFormatter(lambda v, _: number(v / unit.si, 0)))
        axis.set_label_text(f"{name} [{unit.symbol}]")


_FILLS: Mapping[ObjectKind, dict[str, Any]] = {
    ObjectKind.FIXED: {"facecolor": PALE, "hatch": "//"},
    ObjectKind.UNLIKE_ARRAY: {"facecolor": "white", "hatch": "\\\\"},
    ObjectKind.EDGE_WITH_PARAPET: {"facecolor": GREY},
    ObjectKind.EDGE_WITHOUT_PARAPET: {"facecolor": "white", "linestyle": "--"},
}


def _objects(axes: Axes, data: ProjectInput, span: float) -> None:
    for item in data.objects:
        shape = item.rectangle
        if shape is None:
            continue
        axes.add_patch(_box(shape, linewidth=0.7, edgecolor=INK, **_FILLS[item.kind]))
        wide, tall = shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m
        x, y = (shape.x_from_m + shape.x_to_m) / 2, (shape.y_from_m + shape.y_to_m) / 2
        upright = tall > 3 * wide
        room = (tall if upright else wide) / span
        if room < 0.012 * len(item.id) + 0.04:  # no room within: below it
            axes.text(
                x,
                shape.y_from_m - 0.008 * span,
                _tick_text(item.id),
                ha="center",
                va="top",
                fontsize=7,
            )
            continue
        axes.text(
            # Off the middle of an edge, where clearances are measured.
            x if tall > wide or room < 0.6 else shape.x_from_m + 0.2 * wide,
            y if wide > tall or room < 0.6 else shape.y_from_m + 0.2 * tall,
            _tick_text(item.id),
            ha="center",
            va="center",
            fontsize=7,
            rotation=90 if upright else 0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )


def _box(shape: Rectangle, **look: Any) -> Box:
    wide, tall = shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m
    return Box((shape.x_from_m, shape.y_from_m), wide, tall, **look)


def _array(axes: Axes, name: str, shape: Rectangle, downslope_deg: float, slope: float) -> None:
    axes.add_patch(_box(shape, facecolor="#e8eef5", edgecolor=ACCENT, linewidth=1.2))
    x, y = (shape.x_from_m + shape.x_to_m) / 2, (shape.y_from_m + shape.y_to_m) / 2
    reach = 0.22 * min(shape.x_to_m - shape.x_from_m, shape.y_to_m - shape.y_from_m)
    dx, dy = (reach * f(math.radians(downslope_deg)) for f in (math.cos, math.sin))
    axes.text(x - 1.2 * dx, y - 1.2 * dy, name, ha="center", va="center", weight="semibold")
    axes.add_patch(
        FancyArrowPatch(
            (x - 0.4 * dx, y - 0.4 * dy),
            (x + 1.6 * dx, y + 1.6 * dy),
            arrowstyle="-|>",
            mutation_scale=8,
            color=INK,
            linewidth=1.0,
        )
    )
    axes.annotate(
        f"{number(math.degrees(slope), 2)}°",
        (x + 0.6 * dx, y + 0.6 * dy),
        (4 * abs(math.sin(math.radians(downslope_deg))), 4),
        textcoords="offset points",
        fontsize=7,
    )


def _gaps(
    axes: Axes, data: ProjectInput, shapes: Mapping[str, Rectangle | None], span: float
) -> None:
    known = {name.casefold(): shape for name, shape in shapes.items()}
    for count, row in enumerate(data.clearances, start=1):
        near, far = known.get(row.array.casefold()), known.get(row.object.casefold())
        if near is None or far is None:
            continue
        (xa, ya), (xb, yb) = _closest(near, far)
        aside = 0.02 * span
        across = abs(xb - xa) >= abs(yb - ya)
        axes.annotate(
            "",
            (xa, ya),
            (xb, yb),
            arrowprops={
                "arrowstyle": "|-|,widthA=0.25,widthB=0.25",
                "shrinkA": 0,
                "shrinkB": 0,
                "linewidth": 0.8,
                "color": INK,
            },
        )
        axes.text(
            (xa + xb) / 2 + (0.0 if across else aside),
            (ya + yb) / 2 + (aside if across else 0.0),
            str(count),
            fontsize=6.5,
            ha="center",
            va="center",
            bbox={
                "boxstyle": "circle,pad=0.18",
                "facecolor": "white",
                "edgecolor": INK,
                "linewidth": 0.6,
            },
        )


def _closest(a: Rectangle, b: Rectangle) -> tuple[tuple[float, float], tuple[float, float]]:
    xa, xb = _nearest((a.x_from_m, a.x_to_m), (b.x_from_m, b.x_to_m))
    ya, yb = _nearest((a.y_from_m, a.y_to_m), (b.y_from_m, b.y_to_m))
    return (xa, ya), (xb, yb)


def _nearest(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return where two ranges come closest; the middle of what they share where they overlap."""
    if a[1] <= b[0]:
        return a[1], b[0]
    if b[1] <= a[0]:
        return a[0], b[1]
    middle = (max(a[0], b[0]) + min(a[1], b[1])) / 2
    return middle, middle


def spectra(found: Sequence[Spectra]) -> str:
    """Return the spectra of each motion thin, mean and target thick, a panel a component."""
    with style():
        height = 2.3 * len(found)
        figure = Figure(figsize=(WIDTH_IN, height))
        figure.subplots_adjust(
            left=0.065, right=0.99, top=1 - 0.22 / height, bottom=0.42 / height, hspace=0.42
        )
        for axes, part in zip(np.atleast_1d(figure.subplots(len(found), 1)), found, strict=True):
            each = _Broken()
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
                label="AC156 target",
            )
            _spectrum_axes(axes, part)
        return _svg(figure)


def _spectrum_axes(axes: Axes, part: Spectra) -> None:
    axes.set_xscale("log")
    axes.set_xlim(part.periods_s[0], part.periods_s[-1])
    axes.set_ylim(0, None)
    axes.xaxis.set_major_locator(
        FixedLocator([t for t in _PERIOD_TICKS if part.periods_s[0] <= t <= part.periods_s[-1]])
    )
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("Period T [s]")
    axes.set_ylabel("Pseudo-acceleration [g]")
    axes.set_title(part.title, loc="left", weight="semibold")
    axes.grid(True)
    axes.axvline(1 / 1.3, color=INK, linewidth=0.6, linestyle=":")
    axes.text(
        1.04 / 1.3, 0.98, "1.3 Hz", transform=axes.get_xaxis_transform(), va="top", fontsize=7
    )
    _bare(axes)
    axes.legend(loc="upper right")


_PERIOD_TICKS = (0.03, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0)


def histories(motions: Sequence[MotionRun], us_first: bool) -> str:
    """Return the relative displacement under each motion, its governing polarity, PRD marked.

    All panels share one pair of axes, moved apart: a pair for each would take ten times as long.
    """
    grid = _Grid(motions, Quantity.DISPLACEMENT.us if us_first else Quantity.DISPLACEMENT.si)
    with style():
        figure = Figure(figsize=(WIDTH_IN, 0.92 * grid.rows + 0.3))
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_axis_off()
        axes.set_xlim(-0.08 * grid.columns, grid.columns)
        axes.set_ylim(-grid.rows - 0.3, 0.0)
        _rules(axes, grid, len(motions))
        _traces(axes, grid, motions)
        for index, run in enumerate(motions):
            _titles(axes, grid, index, run, us_first)
        return _svg(figure)


class _Grid:
    """Where the panels of a figure lie, and what their scales are."""

    def __init__(self, motions: Sequence[MotionRun], unit: Unit) -> None:
        results = [run.governing.result for run in motions]
        self.unit = unit
        self.columns = 2 if len(motions) <= 4 else 3
        self.rows = math.ceil(len(motions) / self.columns)
        self.last = len(motions) - self.columns  # panels from here on have none below them
        high = np.nanmax([0.0, *(r.down_m for r in results)]) / unit.si
        low = -np.nanmax([0.0, *(r.up_m for r in results)]) / unit.si
        self.ticks = [float(t) for t in MaxNLocator(4).tick_values(low, high or 1.0)]
        self.low, self.high = self.ticks[0], self.ticks[-1]
        longest = max(float(run.governing.history.t_s[-1]) for run in motions)
        self.seconds = longest

    def x(self, index: int, t_s: Any) -> Any:
        """Return where times lie, as given: one or an array."""
        return index % self.columns + 0.94 * t_s / self.seconds

    def y(self, index: int, value: Any) -> Any:
        """Return where displacements in the grid's unit lie, as given: one or an array."""
        share = (value - self.low) / (self.high - self.low)
        return -(index // self.columns) - 0.95 + 0.72 * share


def _rules(axes: Axes, grid: _Grid, count: int) -> None:
    """Draw the levels and the ticks of all panels, each kind as one broken line."""
    levels, zeros, ticks = _Broken(), _Broken(), _Broken()
    for index in range(count):
        left, right = grid.x(index, 0.0), grid.x(index, grid.seconds)
        for value in grid.ticks:
            level = grid.y(index, value)
            (levels if value else zeros).add([left, right], [level, level])
            if index % grid.columns == 0:
                label = number(value, 0 if abs(grid.ticks[1] - grid.ticks[0]) >= 1 else 1)
                axes.text(left - 0.012, level, label, ha="right", va="center", fontsize=7)
        if index >= grid.last:
            _times(axes, grid, index, ticks)
    for line, color in ((levels, PALE), (zeros, GREY), (ticks, INK)):
        axes.plot(line.x, line.y, color=color, linewidth=0.5, clip_on=False)
    axes.text(grid.x(0, 0.0) - 0.012, -0.13, f"u [{grid.unit.symbol}]", ha="right", fontsize=7.5)


class _Broken:
    """A line in pieces: one path instead of many."""

    def __init__(self) -> None:
        self.x: list[float] = []
        self.y: list[float] = []

    def add(self, x: Iterable[float], y: Iterable[float]) -> None:
        """Add a piece."""
        self.x += [*x, math.nan]
        self.y += [*y, math.nan]


def _times(axes: Axes, grid: _Grid, index: int, ticks: _Broken) -> None:
    level = grid.y(index, grid.low)
    for t in MaxNLocator(5).tick_values(0.0, grid.seconds):
        if 0.0 <= t <= grid.seconds:
            at = grid.x(index, float(t))
            ticks.add([at, at], [level, level - 0.025])
            text = f"{t:g} s" if t else "0"
            # The last label keeps clear of the next panel's first.
            side = "right" if t > 0.9 * grid.seconds else "center"
            axes.text(at, level - 0.05, text, ha=side, va="top", fontsize=7)


def _traces(axes: Axes, grid: _Grid, motions: Sequence[MotionRun]) -> None:
    """Draw all histories as one broken line, and all peaks."""
    line, peaks = _Broken(), _Broken()
    for index, run in enumerate(motions):
        history, result = run.governing.history, run.governing.result
        if math.isnan(result.prd_m):
            middle = grid.y(index, (grid.low + grid.high) / 2)
            axes.text(grid.x(index, grid.seconds / 2), middle, "no value", ha="center", va="center")
            continue
        t, u = envelope(history.t_s, history.u_m / grid.unit.si)
        line.add(grid.x(index, t), grid.y(index, u))
        peak = (result.down_m if result.down_m >= result.up_m else -result.up_m) / grid.unit.si
        peaks.add([grid.x(index, result.t_prd_s)], [grid.y(index, peak)])
    axes.plot(line.x, line.y, color=ACCENT, linewidth=0.9, clip_on=False)
    axes.plot(peaks.x, peaks.y, linestyle="", marker="o", markersize=3.2, color=INK, clip_on=False)


def _titles(axes: Axes, grid: _Grid, index: int, run: MotionRun, us_first: bool) -> None:
    polarity = "+" if run.governing.sign > 0 else "−"
    top = grid.y(index, grid.high) + 0.045
    name = f"{_tick_text(run.motion.id)} {polarity}"
    axes.text(grid.x(index, 0.0), top, name, weight="semibold")
    axes.text(grid.x(index, grid.seconds), top, _prd_text(run, us_first), ha="right")


def _prd_text(run: MotionRun, us_first: bool) -> str:
    prd_m = run.governing.result.prd_m
    if math.isnan(prd_m):
        return "PRD: no value"
    return f"PRD {pair(prd_m, Quantity.DISPLACEMENT, us_first)}"


def envelope(t: Floats, u: Floats, most: int = MAX_POINTS) -> tuple[Floats, Floats]:
    """Return at most `most` points: least and largest of each stretch, in their order."""
    if len(u) <= most:
        return t, u
    edges = np.linspace(0, len(u), most // 2, dtype=int)[:-1]
    parts = [*edges.tolist(), len(u)]
    kept: list[int] = [0]
    for start, stop in pairwise(parts):
        piece = u[start:stop]
        kept += sorted({start + int(piece.argmin()), start + int(piece.argmax())})
    kept.append(len(u) - 1)
    index = np.unique(kept)
    return t[index], u[index]


def comparison(arrays: Sequence[ArrayAssessment], us_first: bool) -> str:
    """Return prescriptive value, floor, each motion's PRD, mean and design value by array."""
    first, second = Quantity.DISPLACEMENT.value if us_first else Quantity.DISPLACEMENT.value[::-1]
    with style():
        height = 1.3 + _row_in(len(arrays)) * len(arrays)
        names = [_tick_text(one.array.id) for one in arrays]
        figure, axes = _framed(height, _label_in(names), 0.1, 0.48, 0.75)
        for row, found in enumerate(arrays):
            _compare(axes, row, found, first, labelled=row == 0)
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
        return _svg(figure)


_LEGEND = ("prescriptive", "floor", "PRD of each motion", "mean", "design")


def _tick_text(name: str) -> str:
    return name if len(name) <= 14 else f"{name[:13]}…"


def _label_in(names: Sequence[str]) -> float:
    """Return the room that tick labels need [in]."""
    return 0.2 + 0.06 * max(map(len, names))


def _row_in(count: int) -> float:
    """Return the height of a row of a chart with so many [in]."""
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


def _compare(axes: Axes, row: int, found: ArrayAssessment, unit: Unit, *, labelled: bool) -> None:
    def text(label: str) -> str:
        return label if labelled else "_"

    prescriptive = found.prescriptive.value_m / unit.si
    axes.barh(
        [row],
        [prescriptive],
        0.62,
        facecolor="white",
        edgecolor=GREY,
        linewidth=0.8,
        label=text("prescriptive"),
    )
    if found.floor_m > 0:
        floor = found.floor_m / unit.si
        axes.plot(
            [floor, floor],
            [row - 0.4, row + 0.4],
            color=INK,
            linestyle=(0, (3, 2)),
            linewidth=1.2,
            label=text("floor"),
        )
    peaks = np.array([run.governing.result.prd_m for run in found.motions]) / unit.si
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
    mean = found.analysis.mean_m / unit.si
    axes.plot(
        [mean, mean], [row - 0.25, row + 0.25], color=ACCENT, linewidth=2.0, label=text("mean")
    )
    design = found.design_m / unit.si
    axes.plot(
        [design], [row], linestyle="", marker="D", markersize=6, color=INK, label=text("design")
    )
    if math.isnan(found.design_m):
        axes.text(prescriptive / 2, row, "no value", ha="center", va="center")


def clearances(gaps: Sequence[ClearanceCheck], us_first: bool, start: int = 1) -> str:
    """Return required against provided separations as bars, numbered from `start`."""
    first, second = Quantity.DISPLACEMENT.value if us_first else Quantity.DISPLACEMENT.value[::-1]
    provided = [gap.clearance.provided_m / first.si for gap in gaps]
    required = [gap.required_m / first.si for gap in gaps]
    rows = np.arange(len(gaps), dtype=float)
    with style():
        names = [
            f"{count}  {_tick_text(gap.clearance.array)} to {_tick_text(gap.clearance.object)}"
            for count, gap in enumerate(gaps, start=start)
        ]
        figure, axes = _framed(
            1.3 + _row_in(len(gaps)) * len(gaps), _label_in(names), 0.1, 0.48, 0.75
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
            text = "no value: NG" if math.isnan(gap.required_m) else "OK" if gap.ok else "NG"
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
        return _svg(figure)
