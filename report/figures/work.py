"""Accuracy against run time: medians and envelopes over the analysis cases."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd
from matplotlib.axes import Axes

from report.figures.base import GRAY, INK, PALE, Broken, labeled, panels, style, svg_text
from report.figures.methods import LOOKS
from report.figures.scales import logarithmic

MEASURES = ("PRD", "residual")


def drawn(runs: pd.DataFrame, error: str, floor: float) -> dict[str, pd.DataFrame]:
    """Return method, setting, seconds and error of the runs of each method: NaN of a failed run.

    Errors below the floor are set to it: rounding error limits them, and a log scale has no 0.
    """
    seconds, errors = runs["time per run [s]"], runs[error]
    shown = runs[["method", "setting"]].assign(
        seconds=seconds.where(errors.notna()), error=errors.where(seconds.notna()).clip(floor)
    )
    return {str(name): own for name, own in shown.groupby("method", sort=False)}


def curve(runs: pd.DataFrame) -> pd.DataFrame:
    """Return median time, and range and median of the error, for each setting that gave a result.

    In the order of the runs of a method, from coarse to fine.
    """
    by_setting = runs.groupby("setting", sort=False, dropna=False)
    found = by_setting.agg(
        seconds=("seconds", "median"),
        low=("error", "min"),
        middle=("error", "median"),
        high=("error", "max"),
    )
    return found.dropna()


def overview(runs: pd.DataFrame, unit: str, floor: float) -> str:
    """Return the medians of every method: one panel for PRD and one for the residual.

    Parameters
    ----------
    unit : str
        `%` or `m`.
    floor : float
        Error of the exact method in that unit, from its checks.
    """
    with style():
        margins = {"left": 0.085, "right": 0.99, "above": 0.221, "below": 1.02, "wspace": 0.08}
        figure, grid = panels(1, 2, 3.4, **margins, sharey=True)
        for axes, measure in zip(grid.flat, MEASURES, strict=True):
            for name, own in drawn(runs, f"{measure} error [{unit}]", floor).items():
                medians = curve(own)
                size = {"markersize": 10} if name == "exact" else {}
                axes.plot(medians["seconds"], medians["middle"], **LOOKS[name] | size)
                if name == "exact":
                    axes.annotate(
                        "exact: rounding error",
                        (medians["seconds"].iloc[0], medians["middle"].iloc[0]),
                        (9, 0),
                        textcoords="offset points",
                        va="center",
                    )
            labeled(axes, "Time per run [s]", title=f"Error in {measure}")
            logarithmic(axes, 9, 12)
        grid[0, 0].set_ylabel(f"Median error over analysis cases [{unit}]")
        lines = grid[0, 0].get_legend_handles_labels()
        figure.legend(*lines, loc="lower center", ncols=4, handlelength=2.6, columnspacing=0.9)
        return svg_text(figure)


def by_method(runs: pd.DataFrame, measure: str, floor: float) -> str:
    """Return a panel for each rival: a dot per run, the median as a line, the range as a band.

    The medians of the other methods are drawn in light gray behind each panel.
    """
    found = drawn(runs[runs["method"] != "exact"], f"{measure} error [%]", floor)
    medians = {name: own_curve for name, own in found.items() if len(own_curve := curve(own))}
    others = Broken()
    for other in medians.values():
        others.add(other["seconds"], other["middle"])
    rows = math.ceil(len(medians) / 4)
    margins = {"left": 0.085, "right": 0.99, "above": 0.2, "below": 0.42}
    between = {"wspace": 0.1, "hspace": 0.22}
    with style():
        figure, grid = panels(
            rows, 4, 1.75 * rows + 0.45, **margins, **between, sharex=True, sharey=True
        )
        for axes in grid.flat[len(medians) :]:
            axes.set_axis_off()
        for axes, (name, own_curve) in zip(grid.flat, medians.items(), strict=False):
            axes.plot(others.x, others.y, color=PALE, linewidth=1.0, zorder=1)
            _panel(axes, name, found[name], own_curve)
        for axes in grid[:, 0]:
            axes.set_ylabel("Error [%]")
        for axes in grid.flat[max(len(medians) - 4, 0) : len(medians)]:
            axes.set_xlabel("Time per run [s]")
            axes.tick_params(labelbottom=True)
        return svg_text(figure)


def _panel(axes: Axes, name: str, runs: pd.DataFrame, medians: pd.DataFrame) -> None:
    dots: dict[str, Any] = {"linestyle": "", "marker": ".", "markersize": 2.2, "color": GRAY}
    axes.plot(runs["seconds"], runs["error"], **dots, zorder=2)
    seconds, low, high = medians["seconds"], medians["low"], medians["high"]
    axes.fill_between(seconds, low, high, facecolor="#c9d5e3", edgecolor="none", zorder=1.5)
    axes.plot(seconds, medians["middle"], **LOOKS[name] | {"markersize": 3.8}, zorder=3)
    if len(medians) == 1:
        axes.vlines(seconds, low, high, color=INK, linewidth=0.8, zorder=2.5)
    labeled(axes)
    axes.set_title(LOOKS[name]["label"], loc="left")
    logarithmic(axes, 5, 6)
