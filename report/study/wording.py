"""Values of a study in words: displacements, probabilities, intensities and answers."""

from __future__ import annotations

import math

from report.study.study_results import StudyResults
from report.text.unit_format import UnitFormat
from report.text.units import digits_down, digits_up, no_less, with_unit


def both(results: StudyResults, value_m: float) -> str:
    """Return a displacement or a clearance in both systems of units, rounded up; `none` if none."""
    # A clearance is rounded up, too: what is found for one holds for a larger one.
    known_m = value_m if math.isfinite(value_m) else math.nan
    return UnitFormat(results.plan.input.study.units_first.is_us).both(known_m, show=no_less)


def chance(value: float, low: float, high: float) -> str:
    """Return a probability, rounded up to two digits, with its interval, rounded outward."""
    return (
        f"{digits_up(100 * value, 2)}% "
        f"({digits_down(100 * low, 2)}% to {digits_up(100 * high, 2)}%)"
    )


def level(results: StudyResults, value: float) -> str:
    """Return an intensity with its letters and unit."""
    measure = results.plan.input.study.intensity
    return with_unit(f"{measure.letters} = {value:g}", measure.unit)


def on_building(results: StudyResults, building: int, before: str = " on ") -> str:
    """Return " on NAME" in a study with several buildings, else nothing."""
    names = results.plan.motions.buildings
    return before + names[building] if len(names) > 1 else ""


def answer(value: float, end: float, mark: str, decimals: int) -> str:
    """Return an answer, marked where it is an end of the study; "none" for NaN."""
    if math.isnan(value):
        return "none"
    return f"{mark} {shown(end, decimals)}" if value == end else shown(value, decimals)


def shown(value: float, decimals: int) -> str:
    """Return an answer with its decimals; one of the study's own values with all of its digits."""
    text = f"{value:.{decimals}f}"
    # 0.333 of the study is not 0.33.
    return text if float(text) == value else f"{value:.12g}"
