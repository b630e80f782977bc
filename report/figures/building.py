"""Recorded and computed roof motion: spectra, and the strongest part of the history."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from report.figures.base import ACCENT, GRAY, INK, WIDTH_IN, labeled, style, svg_text
from report.figures.scales import periods, ticks
from report.words.units import G_MPS2
from solver.verification.evidence import RoofComparison, RoofPrediction
from solver.verification.scenes import strongest

SHOWN_S = 16.0
"""Duration of the histories shown, around the strongest shaking [s]."""

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
        for draw, panel_in in panels:
            top -= _ABOVE_IN + panel_in
            draw(figure.add_axes((0.085, top / height, 0.9, panel_in / height)), roof)
            top -= _BELOW_IN
        return svg_text(figure)


def computed(roof: RoofComparison) -> tuple[RoofPrediction, ...]:
    """Return the predictions by a building model: all except the ground motion itself."""
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
    labeled(axes, "Period T [s]", "Pseudo-acceleration [g]", "Response spectra, 5 % damping")
    axes.legend(loc="lower left", handlelength=3.2)


_LEVELS_G = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)


def _histories(axes: Axes, roof: RoofComparison) -> None:
    first = roof.predictions[0]
    width = round(SHOWN_S / roof.dt_s)
    part = strongest(roof.roof_mps2**2, width)
    t = np.arange(roof.roof_mps2.size)[part] * roof.dt_s
    # More points a second than print can show make the file larger and no line clearer.
    every = max(1, round(0.02 / roof.dt_s))
    for a_mps2, color, line in (
        (roof.roof_mps2, INK, "-"),
        (first.a_mps2, ACCENT, _DASHES[0]),
    ):
        shown_g = a_mps2[part][::every] / G_MPS2
        axes.plot(t[::every], shown_g, color=color, linewidth=1.1, linestyle=line)
    axes.set_xlim(t[0], t[-1])
    title = f"Roof acceleration: recorded (solid) and {first.name} (dashed)"
    labeled(axes, "Time [s]", "Acceleration [g]", title)
