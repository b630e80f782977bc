"""Sentences of a study, from its results. Read `headline`."""

from __future__ import annotations

import math

from report.study.results import StudyResults
from report.words.units import Quantity, pair

NO_NUMBER = "not determined"


def both(results: StudyResults, value_m: float) -> str:
    """Return a displacement in both systems of units; `none` for NaN."""
    if math.isnan(value_m):
        return "none"
    us_first = results.plan.input.study.units_first == "US"
    return pair(value_m, Quantity.DISPLACEMENT, us_first)


def headline(results: StudyResults) -> list[str]:
    """Return the main results, one line each."""
    given, manifest = results.plan.input, results.manifest
    count = len(results.plan.motions.motions[0])
    measure = given.study.intensity
    lines = [
        f"{manifest['rows']:,} runs of {manifest['cases']['count']:,} cases under {count} "
        f"motion{'s' if count > 1 else ''}"
    ]
    if given.study.allowed_m:
        lines += _allowed(results, given.study.allowed_m)
    for one in results.arrays:
        where = _where(results, one.plan.building)
        for state in one.states:
            f = state.fragility.fitted
            text = (
                f"median {measure.letters} {f.theta:.3g} {measure.unit}, beta {f.beta:.2f}"
                if f.is_known
                else NO_NUMBER
            )
            lines.append(f"{one.plan.array.id}{where}, {state.words}: {text}")
        for chance in one.chances:
            lines.append(
                f"{one.plan.array.id}{where}: chance that the clearance of "
                f"{both(results, one.plan.array.clearance_m)} is exceeded at {measure.letters} "
                f"{given.study.site_intensity:g} {measure.unit}: {percent(chance.value)} "
                f"({percent(chance.low)} to {percent(chance.high)})"
            )
    return lines


def percent(share: float) -> str:
    """Return a chance in percent with two digits."""
    return f"{100.0 * share:.2g} %"


def _where(results: StudyResults, building: int) -> str:
    names = results.plan.motions.buildings
    return f" on {names[building]}" if len(names) > 1 else ""


def _allowed(results: StudyResults, allowed_m: float) -> list[str]:
    given = results.plan.input
    middle = len(given.intensities) // 2
    level = given.intensities[middle]
    lines = []
    for b in range(len(results.plan.motions.buildings)):
        slopes = results.largest_slopes(b, "mean", allowed_m)[:, middle]
        for mu, slope in zip(given.mus, slopes, strict=True):
            limit = "none of the study" if math.isnan(slope) else f"{slope:.1f} deg"
            limit += " or more" if slope == given.slopes_deg[-1] else ""
            lines.append(
                f"mean PRD of at most {both(results, allowed_m)} at "
                f"{given.study.intensity.letters} "
                f"{level:g} {given.study.intensity.unit}, friction {mu:g}"
                f"{_where(results, b)}: largest slope {limit}"
            )
    return lines
