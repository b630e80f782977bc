"""Comparison of models: effect of each fuller model on the PRD; accuracy against run time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from report.figures.base import ACCENT, GRAY, INK, bare, boxed, framed, labeled, style, svg_text
from report.figures.scales import logarithmic, ticks
from report.words.letters import lettered
from solver.verification.model_evidence import BoundRatios, ModelChange

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
                own["PRD error [%]"].clip(LEAST_PERCENT),
                **look,
                markersize=3.6,
                markerfacecolor="white" if look["color"] == GRAY else look["color"],
                linewidth=1.2,
                label=lettered(name),
            )
        logarithmic(axes, 9, 8)
        _finish(axes, "Time per run [s]", "Error [% of the PRD]")
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
