"""What several sections of study.pdf share: which cases are shown, a chart, and lengths.

And the two sections around them: how a study was run, and its limits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from report.document.sections import Section, section
from report.study import study_charts
from report.study.capacity_runs import FREQ_HZ
from report.study.study_results import StudyResults
from report.study.study_tables import length_unit
from report.text.names import joined
from report.text.units import (
    measured,
    no_less,
)
from report.text.validation import VALIDATION
from solver.model import Floats

# Lines of a chart.
MOST_LINES = 8
# Friction coefficients with pages of their own; a grid of more is drawn over friction.
MOST_FRICTIONS = 4
MOST_CUTS = 3
# Intensity [g] below which displacements are small and drawn on a logarithmic axis as well.
LOW_G = 0.8


def some(values: Sequence[float], maximum: int) -> list[int]:
    """Return indices of at most `maximum` values, evenly spaced, the last one included."""
    # Counted from the end: the last value, often the one that governs, is always among them.
    step = max(1, math.ceil(len(values) / maximum))
    return list(range((len(values) - 1) % step, len(values), step))


def friction_name(results: StudyResults, mu: float) -> str:
    """Return μ = 0.5 (EPDM)."""
    study_input = results.plan.input
    names = [mat.id for mat in study_input.mats if study_input.friction(mat.id).center == mu]
    return f"μ = {mu:g}" + (f" ({joined(names)})" if names else "")


def axis(results: StudyResults) -> str:
    """Return the name of the measure of intensity."""
    return results.plan.input.study.intensity.heading


def by_intensity(results: StudyResults, values: Floats, m: int, **options: Any) -> str:
    """Return displacements at a friction coefficient over intensity, a line for each slope.

    They have the shape (slopes, frictions, intensities) [m]; `options` as in `study_charts.curves`.
    """
    study_input = results.plan.input
    return study_charts.curves(
        np.array(study_input.intensities),
        [
            (f"{study_input.slopes_deg[s]:g}°", values[s, m])
            for s in some(study_input.slopes_deg, MOST_LINES)
        ],
        length_unit(results),
        along=axis(results),
        # A velocity has no such limit.
        low=LOW_G if study_input.study.intensity.unit == "g" else -math.inf,
        **options,
    )


def length(results: StudyResults, value_m: float) -> str:
    """Return a length in the unit of the study, "none" for no value."""
    return "none" if math.isnan(value_m) else measured(value_m, length_unit(results))


def design_length(results: StudyResults, value_m: float) -> str:
    """Return a length that is designed for, rounded up; "none" for no value."""
    return no_less(value_m, length_unit(results)) if math.isfinite(value_m) else "none"


def basis(results: StudyResults) -> Section:
    """Return the section on how the study was run."""
    without, motions = results.curves.without_value, results.plan.motions.motions[0]
    return section(
        "study/basis",
        "Basis",
        first=motions[0],
        lost=int(without.sum()),
        pairs=without.size * len(motions),
    )


def limits(results: StudyResults) -> Section:
    """Return the section on what the study does not say."""
    return section(
        "study/limits",
        "Limits",
        has_probabilities=any(result.exceedances for result in results.arrays),
        FREQ_HZ=FREQ_HZ,
        validation=VALIDATION,
    )
