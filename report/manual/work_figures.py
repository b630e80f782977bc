"""Accuracy against run time: medians over the analysis cases, in two axes and in one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import (
    ACCENT,
    ACROSS,
    DASHDOT,
    DASHED,
    DOTTED,
    GRAY,
    INK,
    T,
    labeled,
    logarithmic,
    panels,
    style,
    svg_text,
)
from solver.rivals.methods import METHODS
from solver.verification.workprecision import FIXED, OURS, SINGLE, TIME

_LONG = (0, (9, 2))
# Marker, line style, color, and color within the marker, in the order of the methods.
_STYLES = (
    ("*", "none", INK, INK),
    ("o", "-", ACCENT, "white"),
    ("s", DASHED, INK, "white"),
    ("^", DASHDOT, ACCENT, ACCENT),
    ("v", DOTTED, INK, INK),
    ("D", _LONG, GRAY, GRAY),
    ("<", "none", ACROSS, ACROSS),
    (">", "none", ACROSS, "white"),
    ("h", "none", ACCENT, ACCENT),
    ("p", "none", ACCENT, "white"),
    ("X", DASHED, GRAY, GRAY),
    ("P", "none", GRAY, GRAY),
)

# Keywords for a line with markers, by the name of the method.
LOOKS: Mapping[str, dict[str, Any]] = {
    method.name: {
        "label": method.label,
        **dict(zip(("marker", "linestyle", "color", "markerfacecolor"), style, strict=True)),
        "markeredgecolor": style[2],
        "markersize": 4.5,
        "markeredgewidth": 0.9,
        "linewidth": 1.1,
    }
    # Strict: a new method without a style of its own stops here, at import.
    for method, style in zip(METHODS.values(), _STYLES, strict=True)
}

_LARGE = {"markersize": 10}
_SINGLE = {"markerfacecolor": "white", "label": "exact, a single run"}

# The methods in two axes by their labels; those that are not in one axis have looks of their own.
_PLANE = {look["label"]: look for look in LOOKS.values()} | {
    OURS: LOOKS["exact"] | {"linestyle": "-", "label": OURS},
    FIXED: LOOKS["paper"] | {"marker": "d", "label": FIXED},
}


def medians(runs: pd.DataFrame, error: str, floor: float) -> pd.DataFrame:
    """Return the median times and error of each method and setting, and the largest error."""
    answered = runs.dropna(subset=[TIME, error])
    settings = answered.groupby(["method", "setting"], sort=False, dropna=False)
    medians_of = settings[[TIME, SINGLE, error]].median().assign(largest=settings[error].max())
    # Errors below the floor are set to it: rounding error limits them, and a log scale has no 0.
    return medians_of.assign(**{name: medians_of[name].clip(floor) for name in (error, "largest")})


def overview(
    runs: pd.DataFrame,
    plane: pd.DataFrame,
    floor: float,
    painted: Callable[[Figure], T] = svg_text,  # type: ignore[assignment]
) -> T:
    """Return the medians of every method: a panel for two axes, and one for one axis.

    `floor` is the error of the exact method [%], from its checks.
    """
    with style():
        margins = {"left": 0.085, "right": 0.99, "above": 0.221, "below": 2.35, "wspace": 0.08}
        figure, grid = panels(1, 2, 4.9, **margins, sharey=True)
        left, right = grid[0]
        _drawn(left, medians(plane, "residual error [%]", floor), _PLANE)
        points = medians(runs, "PRD error [%]", floor)
        _drawn(right, points, LOOKS)
        # The exact method has one setting: one point among lines.
        _, single, error, _ = points.loc["exact"].iloc[0]
        right.plot(single, error, **LOOKS["exact"] | _LARGE | _SINGLE)
        labeled(left, "Time per run [s]", "Error [%]", "Two axes, roof motions: position")
        labeled(right, "Time per run [s]", title="One axis: PRD")
        for axes in (left, right):
            logarithmic(axes, 9, 12)
        lines: dict[str, Any] = {}
        # The right panel has every method; those in two axes alone follow in the legend.
        for axes in (right, left):
            handles, labels = axes.get_legend_handles_labels()
            lines |= dict(zip(labels, handles, strict=True))
        title = "Compiled, except where interpreted; by steps: a call from Python at each step"
        figure.legend(
            lines.values(), lines.keys(), title=title, loc="lower center", ncols=3, handlelength=2.6
        )
        return painted(figure)


def _drawn(axes: Axes, points: pd.DataFrame, looks: Mapping[str, dict[str, Any]]) -> None:
    """Draw the median error of each method over its time, and from it a line to the largest."""
    for name in points.index.unique("method"):
        seconds, _, median, largest = points.loc[name].to_numpy().T
        axes.plot(seconds, median, **looks[name] | (_LARGE if name == "exact" else {}))
        axes.vlines(seconds, median, largest, color=looks[name]["color"], linewidth=0.4)
