"""Accuracy against run time: medians and envelopes over the analysis cases."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import GRAY, INK, PALE, WIDTH_IN, Broken, bare, style, svg_text
from report.figures.methods import LOOKS
from report.figures.scales import decades
from solver.model import Floats
from solver.verification.evidence import WorkPoint

PANELS = (("prd_error", "PRD"), ("residual_error", "residual"))
UNITS = {"percent": "%", "m": "m"}


@dataclass(frozen=True, slots=True, kw_only=True)
class WorkCurve:
    """One method from coarse to fine: median time [s], and error over the scenes.

    `each` has one row per run: time, error.
    """

    method: str
    seconds: Floats
    low: Floats
    median: Floats
    high: Floats
    each: Floats


def curves(points: Sequence[WorkPoint], measure: str, floor: float) -> tuple[WorkCurve, ...]:
    """Return a curve for each method, in the order of the points; failed runs are omitted.

    Errors below the floor are set to it: rounding error limits them, and a log scale has no 0.
    """
    names = dict.fromkeys(point.method for point in points)
    drawn = (
        _curve(name, [p for p in points if p.method == name], measure, floor) for name in names
    )
    return tuple(curve for curve in drawn if curve.median.size)


def _curve(name: str, points: Sequence[WorkPoint], measure: str, floor: float) -> WorkCurve:
    rows = [
        (p.setting, p.seconds, max(getattr(p, measure), floor))
        for p in points
        if not math.isnan(p.seconds) and not math.isnan(getattr(p, measure))
    ]
    settings = list(dict.fromkeys(p.setting for p in points if not math.isnan(p.setting)))
    by_setting = [[row for row in rows if row[0] == value] for value in settings] or [rows]
    groups = [np.array(group)[:, 1:] for group in by_setting if group]
    if not groups:
        empty = np.empty(0)
        return WorkCurve(
            method=name, seconds=empty, low=empty, median=empty, high=empty, each=empty
        )
    return WorkCurve(
        method=name,
        seconds=np.array([np.median(group[:, 0]) for group in groups]),
        low=np.array([group[:, 1].min() for group in groups]),
        median=np.array([np.median(group[:, 1]) for group in groups]),
        high=np.array([group[:, 1].max() for group in groups]),
        each=np.concatenate(groups),
    )


def overview(points: Sequence[WorkPoint], unit: str, floor: float) -> str:
    """Return the medians of every method: one panel for PRD and one for the residual.

    Parameters
    ----------
    unit : str
        `percent` or `m`.
    floor : float
        Error of the exact method in that unit, from its checks.
    """
    with style():
        figure = Figure(figsize=(WIDTH_IN, 3.4))
        figure.subplots_adjust(left=0.085, right=0.99, top=0.935, bottom=0.3, wspace=0.08)
        panels = figure.subplots(1, 2, sharey=True)
        for axes, (measure, name) in zip(panels, PANELS, strict=True):
            for curve in curves(points, f"{measure}_{unit}", floor):
                look = LOOKS[curve.method]
                size = {"markersize": 10} if curve.method == "exact" else {}
                axes.plot(curve.seconds, curve.median, **look.all | size)
                if curve.method == "exact":
                    _name_floor(axes, curve)
            _log_axes(axes)
            axes.set_title(f"Error in {name}", loc="left", weight="semibold")
            axes.set_xlabel("Time per run [s]")
        panels[0].set_ylabel(f"Median error over analysis cases [{UNITS[unit]}]")
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower center", ncols=4, handlelength=3.2)
        return svg_text(figure)


def _name_floor(axes: Axes, curve: WorkCurve) -> None:
    axes.annotate(
        "exact: rounding error",
        (curve.seconds[0], curve.median[0]),
        (9, 0),
        textcoords="offset points",
        va="center",
    )


def _log_axes(axes: Axes) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    decades(axes.xaxis)
    decades(axes.yaxis, maximum=12)
    axes.grid(True)
    axes.set_axisbelow(True)
    bare(axes)


def by_method(points: Sequence[WorkPoint], measure: str, floor: float) -> str:
    """Return a panel for each rival: a dot per run, the median as a line, the range as a band.

    The medians of the other methods are drawn in light gray behind each panel.
    """
    rivals = [point for point in points if point.method != "exact"]
    shown = curves(rivals, f"{measure}_percent", floor)
    rows = math.ceil(len(shown) / 4)
    with style():
        height = 1.75 * rows + 0.45
        figure = Figure(figsize=(WIDTH_IN, height))
        figure.subplots_adjust(
            left=0.085,
            right=0.99,
            top=1 - 0.2 / height,
            bottom=0.42 / height,
            wspace=0.1,
            hspace=0.22,
        )
        grid = figure.subplots(rows, 4, sharex=True, sharey=True, squeeze=False)
        for axes in grid.flat[len(shown) :]:
            axes.set_axis_off()
        for axes, curve in zip(grid.flat, shown, strict=False):
            _panel(axes, curve, shown)
        for axes in grid[:, 0]:
            axes.set_ylabel("Error [%]")
        for index in range(len(shown)):
            if index + 4 >= len(shown):
                axes = grid.flat[index]
                axes.set_xlabel("Time per run [s]")
                axes.tick_params(labelbottom=True)
        return svg_text(figure)


def _panel(axes: Axes, curve: WorkCurve, shown: Sequence[WorkCurve]) -> None:
    others = Broken()
    for other in shown:
        others.add(other.seconds, other.median)
    axes.plot(others.x, others.y, color=PALE, linewidth=1.0, zorder=1)
    axes.plot(
        curve.each[:, 0],
        curve.each[:, 1],
        linestyle="",
        marker=".",
        markersize=2.2,
        color=GRAY,
        zorder=2,
    )
    axes.fill_between(
        curve.seconds, curve.low, curve.high, facecolor="#c9d5e3", edgecolor="none", zorder=1.5
    )
    look = LOOKS[curve.method]
    axes.plot(curve.seconds, curve.median, **look.all | {"markersize": 3.8}, zorder=3)
    if curve.seconds.size == 1:
        axes.vlines(curve.seconds, curve.low, curve.high, color=INK, linewidth=0.8, zorder=2.5)
    _log_axes(axes)
    decades(axes.xaxis, maximum=5)
    decades(axes.yaxis, maximum=6)
    axes.set_title(look.label, loc="left")
