"""Contours of the mean PRD over friction and slope, with the arrays as dots.

Computes only the layout; legible in gray: black lines with their values on them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter

from report.assessment.arrays import ArrayAssessment
from report.assessment.uncertainty import ResponseSurface
from report.drawing.widths import tick_text
from report.entities.columns import UnitFormat
from report.figures.base import GRAY, INK, bare, framed, style, svg_text
from report.figures.levels import LEAST_M, dot_name, dots, drawn_levels, is_decade
from solver.model import Floats

TYPE_PT = 9.0  # at smaller sizes the renderer clips the first letter of a label


def contours(surface: ResponseSurface, arrays: Sequence[ArrayAssessment], us_first: bool) -> str:
    """Return the contours in the primary unit, with a dot for each array of that friction law."""
    unit = UnitFormat(us_first).units()[0]
    degrees = np.degrees(surface.slopes_rad)
    mean = np.maximum(surface.mean_m, LEAST_M) / unit.si
    with style():
        figure, axes = framed(2.3, 0.5, 0.1, 0.14, 0.5)
        grid_mu, grid_deg = np.meshgrid(surface.mus, degrees)
        lost = np.isnan(mean)
        axes.plot(grid_mu[~lost], grid_deg[~lost], "+", color=GRAY, markersize=3.5)
        axes.plot(grid_mu[lost], grid_deg[lost], "x", color=INK, markersize=6)
        _lines(axes, surface, mean, unit.si)
        for (mu, slope), names in dots(surface, arrays).items():
            axes.plot([mu], [slope], "o", color=INK, markersize=7, zorder=5)
            _name(axes, mu, slope, names)
        axes.set_xlabel("Friction coefficient μ at low velocity", fontsize=TYPE_PT)
        axes.set_ylabel("Slope [deg]", fontsize=TYPE_PT)
        axes.tick_params(labelsize=TYPE_PT)
        _edges(axes.set_xlim, surface.mus, 0.03)
        _edges(axes.set_ylim, degrees, 0.09)
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.2f}"))
        bare(axes)
        return svg_text(figure)


def _edges(limit: Callable[[float, float], object], values: Floats, share: float) -> None:
    """Leave room for the labels of the outermost contours."""
    room = share * (values[-1] - values[0])
    limit(values[0] - room, values[-1] + room)


def _lines(axes: Axes, surface: ResponseSurface, mean: Floats, unit_m: float) -> None:
    drawn = drawn_levels(surface, unit_m)
    if not drawn:
        return
    # Contours of the logarithm: displacements grow by factors over friction and slope.
    lines = axes.contour(
        surface.mus,
        np.degrees(surface.slopes_rad),
        np.log10(mean),
        [math.log10(level) for level in drawn],
        colors=INK,
        linewidths=[1.4 if is_decade(level) else 0.8 for level in drawn],
        linestyles="solid",
    )
    names = {math.log10(level): f"{level:g}" for level in drawn}
    for label in axes.clabel(lines, fmt=names, fontsize=TYPE_PT, inline_spacing=3):
        label.set(zorder=4, bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.3})


def _name(axes: Axes, mu: float, degrees: float, names: Sequence[str]) -> None:
    axes.annotate(
        dot_name(list(map(tick_text, names))),
        (mu, degrees),
        (7, 5),
        textcoords="offset points",
        fontsize=TYPE_PT,
        weight="semibold",
        zorder=6,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
    )
