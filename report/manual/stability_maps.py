"""Stability maps: failure and error of a method against two parameters.

Recorded and computed roof motion: spectra, and the strongest part of the history.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from report.figures.base import (
    ACCENT,
    GRAY,
    INK,
    WIDTH_IN,
    decades,
    labeled,
    panels,
    periods,
    style,
    svg_text,
    ticks,
)
from report.text.units import G_MPS2
from solver.model import Floats
from solver.verification.evidence import RoofComparison, RoofPrediction, StabilityMap
from solver.verification.verification_motions import strongest

# Maps per figure, so that it fits on a page.
MOST = 4
_BANDS = (
    (0.0, 0.1, "#ffffff", "less than 0.1%"),
    (0.1, 1.0, "#dfe6ee", "0.1 to 1%"),
    (1.0, 10.0, "#a9bccf", "1 to 10%"),
    (10.0, math.inf, "#5f7890", "more than 10%"),
)
_LIMIT: dict[str, Any] = {"color": INK, "linewidth": 1.6, "linestyle": (0, (5, 1.4, 1, 1.4))}
_FAILED: dict[str, Any] = {
    "facecolor": "white",
    "hatch": "xxxxx",
    "edgecolor": INK,
    "linewidth": 0.0,
}


def stability(maps: Sequence[StabilityMap], first: int = 1) -> str:
    """Return maps in two columns, numbered from `first`; failed cells are hatched."""
    rows = math.ceil(len(maps) / 2)
    with style():
        margins = {"left": 0.09, "right": 0.985, "above": 0.42, "below": 0.95}
        figure, grid = panels(rows, 2, 2.55 * rows + 0.6, **margins, wspace=0.28, hspace=0.52)
        for axes in grid.flat[len(maps) :]:
            axes.set_axis_off()
        for count, (axes, sweep) in enumerate(zip(grid.flat, maps, strict=False), start=first):
            _map(axes, sweep, count)
        figure.legend(handles=_key(maps), loc="lower center", ncols=4, handlelength=2.6)
        return svg_text(figure)


def _map(axes: Axes, sweep: StabilityMap, count: int) -> None:
    x, y = _edges(sweep.x, log=sweep.x_log), _edges(sweep.y)
    bands = ListedColormap([band[2] for band in _BANDS])
    norm = BoundaryNorm([0.0, 0.1, 1.0, 10.0, 1e300], bands.N)
    # A failed cell has no color of its error, which would look like a result; its hatching follows.
    errors = np.ma.masked_where(sweep.failed, sweep.error_percent)
    # Edges in the color of the face: viewers of SVG and PDF show hairlines between bare cells.
    axes.pcolormesh(x, y, errors, cmap=bands, norm=norm, linewidth=0.4, edgecolors="face")
    for row, column in np.argwhere(sweep.failed):
        axes.fill(
            [x[column], x[column + 1], x[column + 1], x[column]],
            [y[row], y[row], y[row + 1], y[row + 1]],
            **_FAILED,
        )
    if sweep.limit.size:
        axes.plot(sweep.x, sweep.limit, **_LIMIT)
    if not math.isnan(sweep.x_mark):
        axes.axvline(sweep.x_mark, **_LIMIT)
    if sweep.x_log:
        axes.set_xscale("log")
        decades(axes.xaxis, maximum=7)
    axes.set_yscale("log")
    decades(axes.yaxis, maximum=7)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(y[0], y[-1])
    axes.set_xlabel(sweep.x_label)
    axes.set_ylabel(sweep.y_label)
    axes.set_title(f"({count}) {sweep.title}", loc="left", weight="semibold")


def _edges(centers: Floats, *, log: bool = True) -> Floats:
    """Return the edges of cells around their centers."""
    values = np.log(centers) if log else centers
    middle = (values[:-1] + values[1:]) / 2.0
    # Halfway between centers; the outer cells as wide as toward their neighbors.
    edges = np.concatenate([[2.0 * values[0] - middle[0]], middle, [2.0 * values[-1] - middle[-1]]])
    return np.asarray(np.exp(edges) if log else edges)


def _key(maps: Sequence[StabilityMap]) -> list[Any]:
    handles: list[Any] = [
        Patch(facecolor=color, edgecolor=INK, linewidth=0.4, label=text)
        for _, _, color, text in _BANDS
    ]
    handles.append(Patch(**_FAILED, label="failed"))
    if any(sweep.limit.size or not math.isnan(sweep.x_mark) for sweep in maps):
        handles.append(Line2D([], [], **_LIMIT, label="theoretical limit"))
    return handles


# Duration of the histories shown, around the strongest shaking [s].
SHOWN_S = 16.0

_DASHES: tuple[Any, ...] = ((0, (5, 1.5)), (0, (1, 1.2)), (0, (6, 1.5, 1, 1.5)))
_SPECTRUM_IN, _HISTORY_IN, _ABOVE_IN, _BELOW_IN = 2.2, 1.05, 0.22, 0.42


def comparison(roof: RoofComparison) -> str:
    """Return spectra of ground, roof and computed roofs; below, histories of a recorded roof."""
    panels = [(_spectra, _SPECTRUM_IN)]
    if roof.is_recorded:
        panels.append((_histories, _HISTORY_IN))
    height = sum(_ABOVE_IN + panel_in + _BELOW_IN for _, panel_in in panels)
    with style():
        figure = Figure(figsize=(WIDTH_IN, height))
        top = height
        # From the top down, in inches: a building that was not recorded has the spectra alone.
        for draw, panel_in in panels:
            top -= _ABOVE_IN + panel_in
            draw(figure.add_axes((0.085, top / height, 0.9, panel_in / height)), roof)
            top -= _BELOW_IN
        return svg_text(figure)


def computed(roof: RoofComparison) -> tuple[RoofPrediction, ...]:
    """Return the predictions by a building model."""
    # Without modes a prediction is the ground motion itself.
    return tuple(prediction for prediction in roof.predictions if prediction.n_modes > 0)


def _spectra(axes: Axes, roof: RoofComparison) -> None:
    label = "roof, recorded" if roof.is_recorded else "roof, integrated directly"
    for sa_mps2, look in (
        (roof.ground_sa_mps2, {"color": GRAY, "linewidth": 0.9, "label": "ground"}),
        (roof.roof_sa_mps2, {"color": INK, "linewidth": 1.8, "label": label}),
        *(
            (
                prediction.sa_mps2,
                {"color": ACCENT, "linewidth": 1.3, "linestyle": dash, "label": prediction.name},
            )
            for prediction, dash in zip(computed(roof), _DASHES, strict=False)
        ),
    ):
        axes.plot(roof.periods_s, sa_mps2 / G_MPS2, **look)
    axes.set_yscale("log")
    periods(axes, roof.periods_s)
    ticks(axes.yaxis, _LEVELS_G)
    labeled(axes, "Period T [s]", "Pseudo-acceleration [g]", "Response spectra, 5% damping")
    axes.legend(loc="lower left", handlelength=3.2)


_LEVELS_G = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)


def _histories(axes: Axes, roof: RoofComparison) -> None:
    first = roof.predictions[0]
    width = round(SHOWN_S / roof.dt_s)
    part = strongest(roof.roof_mps2**2, width)
    t = np.arange(roof.roof_mps2.size)[part] * roof.dt_s
    # More points a second than print can show make the file larger and no line clearer.
    every = max(1, round(0.02 / roof.dt_s))
    for a_mps2, color, line in ((roof.roof_mps2, INK, "-"), (first.a_mps2, ACCENT, _DASHES[0])):
        shown_g = a_mps2[part][::every] / G_MPS2
        axes.plot(t[::every], shown_g, color=color, linewidth=1.1, linestyle=line)
    axes.set_xlim(t[0], t[-1])
    title = f"Roof acceleration: recorded (solid) and {first.name} (dashed)"
    labeled(axes, "Time [s]", "Acceleration [g]", title)
