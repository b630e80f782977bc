"""Accuracy against run time: medians and envelopes over the analysis cases."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from report.figures.base import GRAY, INK, PALE, Broken, labeled, panels, style, svg_text
from report.figures.methods import LOOKS
from report.figures.scales import logarithmic
from solver.model import Floats
from solver.verification.evidence import WorkPoint, by_setting

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
    drawn = []
    for name, groups in by_setting(points).items():
        answered = (_answered(group, measure, floor) for group in groups)
        runs = [group for group in answered if group.size]
        if runs:
            drawn.append(_curve(name, runs))
    return tuple(drawn)


def _answered(points: Sequence[WorkPoint], measure: str, floor: float) -> Floats:
    rows = [(point.seconds, getattr(point, measure)) for point in points]
    return np.array([(s, max(error, floor)) for s, error in rows if not math.isnan(s + error)])


def _curve(name: str, runs: Sequence[Floats]) -> WorkCurve:
    return WorkCurve(
        method=name,
        seconds=np.array([np.median(group[:, 0]) for group in runs]),
        low=np.array([group[:, 1].min() for group in runs]),
        median=np.array([np.median(group[:, 1]) for group in runs]),
        high=np.array([group[:, 1].max() for group in runs]),
        each=np.concatenate(runs),
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
        margins = {"left": 0.085, "right": 0.99, "above": 0.221, "below": 1.02, "wspace": 0.08}
        figure, grid = panels(1, 2, 3.4, **margins, sharey=True)
        for axes, (measure, name) in zip(grid.flat, PANELS, strict=True):
            for curve in curves(points, f"{measure}_{unit}", floor):
                look = LOOKS[curve.method]
                size = {"markersize": 10} if curve.method == "exact" else {}
                axes.plot(curve.seconds, curve.median, **look | size)
                if curve.method == "exact":
                    _name_floor(axes, curve)
            labeled(axes, "Time per run [s]", title=f"Error in {name}")
            logarithmic(axes, 9, 12)
        grid[0, 0].set_ylabel(f"Median error over analysis cases [{UNITS[unit]}]")
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(
            handles, labels, loc="lower center", ncols=4, handlelength=2.6, columnspacing=0.9
        )
        return svg_text(figure)


def _name_floor(axes: Axes, curve: WorkCurve) -> None:
    axes.annotate(
        "exact: rounding error",
        (curve.seconds[0], curve.median[0]),
        (9, 0),
        textcoords="offset points",
        va="center",
    )


def by_method(points: Sequence[WorkPoint], measure: str, floor: float) -> str:
    """Return a panel for each rival: a dot per run, the median as a line, the range as a band.

    The medians of the other methods are drawn in light gray behind each panel.
    """
    rivals = [point for point in points if point.method != "exact"]
    shown = curves(rivals, f"{measure}_percent", floor)
    rows = math.ceil(len(shown) / 4)
    margins = {"left": 0.085, "right": 0.99, "above": 0.2, "below": 0.42}
    between = {"wspace": 0.1, "hspace": 0.22}
    with style():
        figure, grid = panels(
            rows, 4, 1.75 * rows + 0.45, **margins, **between, sharex=True, sharey=True
        )
        for axes in grid.flat[len(shown) :]:
            axes.set_axis_off()
        for axes, curve in zip(grid.flat, shown, strict=False):
            _panel(axes, curve, shown)
        for axes in grid[:, 0]:
            axes.set_ylabel("Error [%]")
        for axes in grid.flat[max(len(shown) - 4, 0) : len(shown)]:
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
    axes.plot(curve.seconds, curve.median, **look | {"markersize": 3.8}, zorder=3)
    if curve.seconds.size == 1:
        axes.vlines(curve.seconds, curve.low, curve.high, color=INK, linewidth=0.8, zorder=2.5)
    labeled(axes)
    axes.set_title(look["label"], loc="left")
    logarithmic(axes, 5, 6)
