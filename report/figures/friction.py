"""Friction as tested: runs and means by velocity, with the laws of the arrays."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from report.drawing.widths import TYPE_PT, width_in
from report.entities.columns import UnitFormat
from report.figures.base import (
    ACCENT,
    ACROSS,
    GRAY,
    INK,
    WIDTH_IN,
    framed,
    labeled,
    style,
    svg_text,
)
from report.figures.levels import dot_name
from report.sheet.schema.scene import Array
from report.words.counts import ids_by
from report.words.units import Quantity, Unit, number
from solver.friction_tests import FittedLaw, FrictionRun, Surface
from solver.model import Friction

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
_LEADER_IN = 0.15
_LABEL_GAP = 0.14  # least distance of two labels, as a share of the height


def friction_by_velocity(
    runs: Sequence[FrictionRun],
    arrays: Sequence[Array],
    fits: Mapping[Surface, FittedLaw],
    us_first: bool,
) -> str:
    """Return the runs that report a velocity, the laws of the arrays, and fitted laws.

    Parameters
    ----------
    runs : sequence of FrictionRun
        At least one with a velocity.
    fits : mapping of Surface to FittedLaw
        Drawn as dashed lines.
    """
    unit = UnitFormat(us_first).units(Quantity.VELOCITY)[0]
    shown = [run for run in runs if not math.isnan(run.velocity_mps)]
    most = 1.08 * max(run.velocity_mps for run in shown) or unit.si
    v = np.linspace(0.0, most, _POINTS)
    with style(), mpl.rc_context(_TYPE):
        laws = _laws(arrays)
        labels_in = max(width_in(_law_words(law, names)) for law, names in laws.items())
        figure, axes = framed(1.75, 0.62, labels_in + _LEADER_IN + 0.08, 0.3, 0.52)
        for surface, look in _MARKS.items():
            those = [run for run in shown if run.surface is surface]
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
            curve = [fit.law.at(one) for one in v]
            axes.plot(v / unit.si, curve, linewidth=1.0, label=f"fit, {surface}", **_FITS[surface])
        for law in laws:
            curve = [law.at(one) for one in v]
            axes.plot(v / unit.si, curve, color=INK, linewidth=1.6)
        axes.set_xlim(0.0, most / unit.si)
        _mu_axis(axes, [run.mu for run in shown], [law.at(s) for law in laws for s in (0.0, most)])
        _label_laws(axes, laws, most)
        _finish(axes, unit)
        return svg_text(figure)


def _laws(arrays: Sequence[Array]) -> Mapping[Friction, str]:
    """Return each law with the arrays that use it."""
    groups = ids_by(arrays, lambda array: array.friction)
    return {law: dot_name(ids) for law, ids in groups.items()}


def _mu_axis(axes: Axes, runs: Sequence[float], laws: Sequence[float]) -> None:
    """Show all values with their scatter, not the origin."""
    low, high = min(*runs, *laws), max(*runs, *laws)
    pad = max(0.12 * (high - low), 0.02)
    axes.set_ylim(max(low - pad, 0.0), high + pad)


def _label_laws(axes: Axes, laws: Mapping[Friction, str], maximum: float) -> None:
    """Label each law at its end, moving labels apart upward."""
    low, high = axes.get_ylim()
    wide_in = axes.get_position().width * WIDTH_IN
    last = -math.inf
    for law in sorted(laws, key=lambda one: one.at(maximum)):
        end = (law.at(maximum) - low) / (high - low)
        last = max(end, last + _LABEL_GAP)
        axes.annotate(
            _law_words(law, laws[law]),
            (1.0, end),
            (1.0 + _LEADER_IN / wide_in, last),
            xycoords="axes fraction",
            textcoords="axes fraction",
            va="center",
            arrowprops={"arrowstyle": "-", "linewidth": 0.5, "color": GRAY, "shrinkB": 0},
        )


def _law_words(law: Friction, names: str) -> str:
    mu = number(law.mu_slow, 3) if law.mu_fast == law.mu_slow else "μ(v)"
    return f"{names}: {mu}"


def _finish(axes: Axes, unit: Unit) -> None:
    labeled(axes, f"Sliding velocity [{unit.symbol}]", "Kinetic friction coefficient μ")
    axes.legend(
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, handlelength=3.0, borderaxespad=0.0
    )
