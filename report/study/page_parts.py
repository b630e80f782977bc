"""What several sections of study.pdf share: which cases are shown, a chart, and lengths."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from report.study import figures
from report.study.results import StudyResults
from report.study.tables import length_unit
from report.words.counts import joined
from report.words.units import measured, no_less
from solver.model import Floats

MOST_LINES = 8
"""Lines of a chart."""
MOST_FRICTIONS = 4
"""Friction coefficients with pages of their own; a grid of more is drawn over friction."""
MOST_CUTS = 3
LOW_G = 0.8
"""Intensity [g] below which displacements are small and drawn on a logarithmic axis as well."""


def some(values: Sequence[float], maximum: int) -> list[int]:
    """Return indices of at most `maximum` values, evenly spaced, the last one included."""
    step = max(1, math.ceil(len(values) / maximum))
    return list(range((len(values) - 1) % step, len(values), step))


def friction_name(results: StudyResults, mu: float) -> str:
    """Return μ = 0.5 (EPDM)."""
    given = results.plan.input
    names = [mat.id for mat in given.mats if given.friction(mat.id).center == mu]
    return f"μ = {mu:g}" + (f" ({joined(names)})" if names else "")


def axis(results: StudyResults) -> str:
    """Return the name of the measure of intensity."""
    return results.plan.input.study.intensity.value


def by_intensity(results: StudyResults, values: Floats, m: int, **more: Any) -> str:
    """Return displacements at a friction coefficient over intensity, a line for each slope.

    Parameters
    ----------
    values : array, shape (slopes, frictions, intensities)
        Displacements [m].
    more : optional
        As `figures.curves` has it.
    """
    given = results.plan.input
    return figures.curves(
        np.array(given.intensities),
        [(f"{given.slopes_deg[s]:g}°", values[s, m]) for s in some(given.slopes_deg, MOST_LINES)],
        length_unit(results),
        along=axis(results),
        low=LOW_G if given.study.intensity.unit == "g" else -math.inf,
        **more,
    )


def length(results: StudyResults, value_m: float) -> str:
    """Return a length in the unit of the study, "none" for no value."""
    return "none" if math.isnan(value_m) else measured(value_m, length_unit(results))


def design_length(results: StudyResults, value_m: float) -> str:
    """Return a length that is designed for, rounded up; "none" for no value."""
    return "none" if math.isnan(value_m) else no_less(value_m, length_unit(results))
