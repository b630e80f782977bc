"""Charts of the package, each a function from computed results to an SVG.

Computes only the layout; legible in black and white (line style, marker and hatching carry the
meaning). Fonts and style are in `base`.

Friction as tested: runs by velocity, with the laws of the arrays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, cycle
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.routes import NOT_PERMITTED
from report.drawing.paper_items import TYPE_PT
from report.figures.base import ACCENT, ACROSS, GRAY, INK, LINES, framed, labeled, style, svg_text
from report.project.model.array import Array
from report.text.grouping import ids_by
from report.text.names import ranged
from report.text.typed_letters import cut
from report.text.unit_format import UnitFormat
from report.text.units import Quantity, Unit, number
from solver.friction_tests import FittedLaw, FrictionRun, Surface


def comparison(
    groups: Sequence[Sequence[ArrayAssessment]], us_first: bool, others_m: Mapping[str, float] = {}
) -> str:
    """Return prescriptive value, floor, PRDs, mean and design value by group of like arrays.

    `others_m` is the design displacement [m] of an array with another input.
    """
    first, second = UnitFormat(us_first).units()
    with style():
        names = [
            [cut(ranged(array.id for array in group), 32), *_refusals(group[0])] for group in groups
        ]
        row_in = max(0.31, 0.16 * max(map(len, names)))
        height = 1.1 + row_in * len(groups)
        # 0.06 in for each letter of the longest line.
        letters = max(map(len, chain.from_iterable(names)))
        figure, axes = framed(height, 0.2 + 0.06 * letters, 0.1, 0.48, 0.75)
        for row, group in enumerate(groups):
            # Arrays of a group share their runs, and so all that is drawn here but their names.
            _compare(axes, row, group[0], first)
            lengths = [others_m[array.id] / first.si for array in group if array.id in others_m]
            if lengths:
                axes.plot(lengths, [row] * len(lengths), **_OTHER, label=_LEGEND[-1])
        axes.set_yticks(range(len(groups)), map("\n".join, names))
        # Downward, as the arrays are listed.
        axes.set_ylim(len(groups) - 0.45, -0.55)
        # From zero: bars are compared by their lengths.
        axes.set_xlim(0, None)
        axes.set_xlabel(f"Horizontal displacement [{first.symbol}]")
        _second_scale(axes, first, second)
        marks, labels = axes.get_legend_handles_labels()
        # Each label once, in the order of a row: matplotlib lists bars last.
        drawn = dict(zip(labels, marks, strict=True))
        legend = {name: drawn[name] for name in _LEGEND if name in drawn}
        figure.legend(legend.values(), legend, loc="lower center", ncols=6, handlelength=2.0)
        return svg_text(figure)


_LEGEND = (
    "prescriptive",
    "floor",
    "PRD of each motion",
    "mean",
    "design",
    "design with another input",
)


def _second_scale(axes: Any, first: Unit, second: Unit) -> None:
    """Add the second unit at the top; the grid is that of the first."""
    ratio = first.si / second.si
    second_axis = axes.secondary_xaxis("top", functions=(lambda v: v * ratio, lambda v: v / ratio))
    second_axis.set_xlabel(f"[{second.symbol}]")
    axes.spines["right"].set_visible(False)
    axes.grid(True, axis="x")
    axes.set_axisbelow(True)


_BAR: Any = {"facecolor": "white", "edgecolor": INK, "linewidth": 0.8}
_FLOOR: Any = {"color": INK, "linestyle": (0, (3, 2)), "linewidth": 1.2}
_OTHER: Any = {"marker": "D", "markersize": 6, "color": INK, "fillstyle": "none", "linestyle": ""}
_PEAK: Any = {"color": ACCENT, "markersize": 4, "fillstyle": "none", "markeredgewidth": 0.8}


def _compare(axes: Axes, row: int, array: ArrayAssessment, unit: Unit) -> None:
    prescriptive = array.prescriptive.value_m / unit.si
    axes.barh([row], [prescriptive], 0.62, **_BAR | {"edgecolor": GRAY}, label="prescriptive")
    if array.floor_m > 0:
        floor = array.floor_m / unit.si
        axes.plot([floor, floor], [row - 0.4, row + 0.4], **_FLOOR, label="floor")
    peaks = np.array([run.governing.prd_m for run in array.motions]) / unit.si
    axes.plot(peaks, np.full(peaks.shape, row), "o", **_PEAK, label="PRD of each motion")
    mean = array.analysis.mean_m / unit.si
    # A line of NaN is a path without data, which the layout of the PDF refuses.
    if not math.isnan(mean):
        axes.plot([mean, mean], [row - 0.25, row + 0.25], color=ACCENT, linewidth=2.0, label="mean")
    design = array.permitted_m / unit.si
    if not math.isnan(design):
        axes.plot([design], [row], "D", markersize=6, color=INK, label="design")


def _refusals(array: ArrayAssessment) -> Iterator[str]:
    """Yield what an array has not, below its name, where it is of no other row and on no bar."""
    if not all(check.ok for check in array.limits.prescriptive_checks):
        yield f"prescriptive {NOT_PERMITTED}"
    if math.isnan(array.permitted_m):
        yield "no design displacement"


_TYPE: Any = dict.fromkeys(
    ("font.size", "axes.labelsize", "xtick.labelsize", "ytick.labelsize", "legend.fontsize"),
    TYPE_PT,
)
_MARKS: Mapping[Surface, dict[str, Any]] = {
    Surface.DRY: {"marker": "o", "markerfacecolor": "none", "markeredgecolor": ACROSS},
    Surface.WET: {"marker": "^", "markerfacecolor": ACCENT, "markeredgecolor": ACCENT},
}
_FITS: Mapping[Surface, dict[str, Any]] = {
    Surface.DRY: {"color": ACROSS, "linestyle": (0, (6, 1.5, 1, 1.5))},
    Surface.WET: {"color": ACCENT, "linestyle": (0, (3, 1.5))},
}
_POINTS = 200


def friction_by_velocity(
    runs: Sequence[FrictionRun],
    arrays: Sequence[Array],
    fits: Mapping[Surface, FittedLaw],
    us_first: bool,
) -> str:
    """Return the runs that report a velocity, the laws of the arrays, and fitted laws.

    At least one of `runs` has a velocity; `fits` are drawn as colored lines.
    """
    unit = UnitFormat(us_first).units(Quantity.VELOCITY)[0]
    timed = [run for run in runs if not math.isnan(run.velocity_mps)]
    # Runs at rest alone leave no range.
    v_max = 1.08 * max(run.velocity_mps for run in timed) or unit.si
    v = np.linspace(0.0, v_max, _POINTS)
    with style(), mpl.rc_context(_TYPE):
        figure, axes = framed(1.75, 0.62, 2.2, 0.1, 0.52)
        for surface, look in _MARKS.items():
            those = [run for run in timed if run.surface is surface]
            if those:
                axes.plot(
                    [run.velocity_mps / unit.si for run in those],
                    [run.mu for run in those],
                    linestyle="",
                    markersize=5,
                    label=f"{surface} runs",
                    zorder=3,
                    **look,
                )
        for surface, fit in fits.items():
            curve = [fit.law.at(velocity) for velocity in v]
            axes.plot(v / unit.si, curve, linewidth=1.0, label=f"fit, {surface}", **_FITS[surface])
        laws = ids_by(arrays, lambda array: array.friction)
        for (law, ids), line in zip(laws.items(), cycle(LINES)):
            curve = [law.at(velocity) for velocity in v]
            mu = number(law.mu_slow, 3) if law.mu_fast == law.mu_slow else "μ(v)"
            name = f"{cut(ranged(ids), 24)}: {mu}"
            axes.plot(v / unit.si, curve, color=INK, linewidth=1.6, linestyle=line, label=name)
        axes.set_xlim(0.0, v_max / unit.si)
        mus = [run.mu for run in timed]
        for law in laws:
            mus += [law.at(0.0), law.at(v_max)]
        # The scatter is to be seen, so not from the origin.
        pad = max(0.12 * (max(mus) - min(mus)), 0.02)
        axes.set_ylim(max(min(mus) - pad, 0.0), max(mus) + pad)
        labeled(axes, f"Sliding velocity [{unit.symbol}]", "Kinetic μ")
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=3.0)
        return svg_text(figure)
