"""Accuracy against run time: medians over the analysis cases.

Comparison of models: effect of each fuller model on the PRD; accuracy against run time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from typing import Any, TypeVar

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    LOOKS,
    bare,
    boxed,
    framed,
    labeled,
    logarithmic,
    panels,
    style,
    svg_text,
    ticks,
)
from report.text.counts import lettered
from solver.verification.evidence import BoundRatios, ModelChange, PeerPoint
from solver.verification.peers import ONE_AXIS

T = TypeVar("T")

MEASURES = ("PRD", "residual")


def medians(runs: pd.DataFrame, error: str, floor: float) -> pd.DataFrame:
    """Return the median time and error of each method and setting that gave a result.

    Errors below the floor are set to it: rounding error limits them, and a log scale has no 0.
    """
    seconds = "time per run [s]"
    answered = runs.dropna(subset=[seconds, error])
    found = answered.groupby(["method", "setting"], sort=False, dropna=False)[[seconds, error]]
    return found.median().assign(**{error: lambda each: each[error].clip(floor)})


def overview(
    runs: pd.DataFrame,
    floor: float,
    peers: Iterable[PeerPoint] = (),
    painted: Callable[[Figure], T] = svg_text,  # type: ignore[assignment]
) -> T:
    """Return the medians of every method: one panel for PRD and one for the residual.

    Parameters
    ----------
    floor : float
        Error of the exact method [%], from its checks.
    peers : iterable of PeerPoint
        Other programs on the same runs, which know the PRD alone.
    painted : callable
        Makes the picture of the figure.
    """
    with style():
        margins = {"left": 0.085, "right": 0.99, "above": 0.221, "below": 1.9, "wspace": 0.08}
        figure, grid = panels(1, 2, 4.3, **margins, sharey=True)
        for axes, measure in zip(grid.flat, MEASURES, strict=True):
            found = medians(runs, f"{measure} error [%]", floor)
            for name in found.index.unique("method"):
                own = found.loc[name]
                size = {"markersize": 10} if name == "exact" else {}
                axes.plot(*own.to_numpy().T, **LOOKS[name] | size)
                if name == "exact":
                    axes.annotate(
                        "exact: rounding error",
                        own.iloc[0],
                        (9, 0),
                        textcoords="offset points",
                        va="center",
                    )
            labeled(axes, "Time per run [s]", title=f"Error in {measure}")
            logarithmic(axes, 9, 12)
        _peers(grid[0, 0], peers, floor)
        grid[0, 0].set_ylabel("Median error over analysis cases [%]")
        lines = grid[0, 0].get_legend_handles_labels()
        title = "Compiled, except where interpreted; by steps: a call from Python at each step"
        figure.legend(*lines, title=title, loc="lower center", ncols=3, handlelength=2.6)
        return painted(figure)


def _peers(axes: Axes, peers: Iterable[PeerPoint], floor: float) -> None:
    """Draw the medians of each program, with its model of friction, over its runs in one axis."""
    points = pd.DataFrame([asdict(peer) for peer in peers if peer.model == ONE_AXIS])
    if points.empty:
        return
    answered = points.dropna(subset=["seconds", "prd_error_percent"])
    for marker, (name, own) in zip("1+x2", answered.groupby("peer", sort=False), strict=False):
        medians = own[["seconds", "prd_error_percent"]].median()
        axes.plot(
            medians["seconds"], max(medians["prd_error_percent"], floor), linestyle="",
            marker=marker, markersize=9, color=INK, label=name,
        )  # fmt: skip


_RATIOS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
_DOT = "#9a9a9a"
_SPREAD = 0.31
"""Vertical spread of the dots of a row, to each side of its center line."""


def changes(studied: Sequence[ModelChange]) -> str:
    """Return a row for each change: a dot for each run, a bar for 10 to 90 %, a median mark."""
    height = 0.5 + 0.31 * len(studied)
    with style():
        figure, axes = framed(height, 1.95, 0.15, 0.08, 0.42)
        axes.axvline(1.0, color=INK, linewidth=0.8, zorder=1)
        for row, change in enumerate(studied):
            _row(axes, row, change)
        axes.set_xscale("log")
        axes.set_ylim(len(studied) - 0.5, -0.5)
        axes.set_yticks(range(len(studied)), [change.name for change in studied])
        axes.tick_params(axis="y", length=0)
        ticks(axes.xaxis, _RATIOS)
        axes.set_xlabel("PRD of the fuller model / PRD of the simpler model")
        axes.grid(True, axis="x")
        axes.set_axisbelow(True)
        bare(axes)
        axes.spines["left"].set_visible(False)
        return svg_text(figure)


def _row(axes: Any, row: int, change: ModelChange) -> None:
    if not change.ratios.size:
        return
    # Golden-ratio offsets: the same in every run, and equal values do not overlap.
    turn = 0.5 * (1.0 + math.sqrt(5.0))
    aside = _SPREAD * (2.0 * np.mod(turn * np.arange(change.ratios.size), 1.0) - 1.0)
    axes.plot(change.ratios, row + aside, linestyle="", marker=".", markersize=1.8, color=_DOT)
    axes.plot([change.at(10.0), change.at(90.0)], [row, row], color=ACCENT, linewidth=2.0)
    axes.plot([change.median] * 2, [row - 0.36, row + 0.36], color=ACCENT, linewidth=2.0)


_LOOKS: tuple[dict[str, Any], ...] = (
    {"color": ACCENT, "linestyle": "-", "marker": "o"},
    {"color": INK, "linestyle": "-", "marker": "s"},
    {"color": INK, "linestyle": (0, (1, 1.2)), "marker": "s"},
    {"color": GRAY, "linestyle": "-", "marker": "^"},
    {"color": GRAY, "linestyle": (0, (5, 1.5)), "marker": "^"},
    {"color": GRAY, "linestyle": (0, (6, 1.5, 1, 1.5)), "marker": "D"},
    {"color": GRAY, "linestyle": (0, (1, 1.2)), "marker": "v"},
    {"color": GRAY, "linestyle": (0, (3, 1, 1, 1, 1, 1)), "marker": "x"},
)

LEAST_PERCENT, LEAST_RATIO = 1e-12, 1e-6
"""Smallest error and ratio drawn; smaller ones are drawn there."""


def work(runs: pd.DataFrame) -> str:
    """Return a line for each method, from coarse to fine; failed runs are not drawn."""
    answered = runs.dropna(subset="time per run [s]")
    with style():
        figure, axes = boxed(2.4, (0.085, 0.17, 0.5, 0.79))
        for name, look in zip(runs["method"].unique(), _LOOKS, strict=False):
            own = answered[answered["method"] == name]
            axes.plot(
                own["time per run [s]"],
                own["residual error [%]"].clip(LEAST_PERCENT),
                **look,
                markersize=3.6,
                markerfacecolor="white" if look["color"] == GRAY else look["color"],
                linewidth=1.2,
                label=lettered(name),
            )
        logarithmic(axes, 9, 8)
        _finish(axes, "Time per run [s]", "Position error [% of the PRD]")
        return svg_text(figure)


def _finish(axes: Axes, x: str, y: str) -> None:
    labeled(axes, x, y)
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), handlelength=3.2)


def bounds(groups: Sequence[BoundRatios]) -> str:
    """Return, for each kind, the share of the pairs whose ratio to the bound exceeds a value."""
    with style():
        figure, axes = boxed(2.5, (0.085, 0.165, 0.58, 0.8))
        axes.axvline(1.0, color=INK, linewidth=0.8)
        axes.text(1.15, 0.9, "bound", color=INK)
        for group, look in zip(groups, _LOOKS, strict=False):
            above = 1.0 - np.arange(group.ratios.size) / max(group.ratios.size, 1)
            ratios, label = np.maximum(group.ratios, LEAST_RATIO), group.kind.replace("mu", "μ")
            axes.plot(ratios, above, **look | {"marker": ""}, linewidth=1.2, label=label)
        logarithmic(axes, 8, 9)
        x = "Difference of the two runs of a pair / sum of their bounds"
        _finish(axes, x, "Share of pairs exceeding")
        axes.set_xlim(LEAST_RATIO, 10.0)
        return svg_text(figure)
