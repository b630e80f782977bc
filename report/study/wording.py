"""What the templates of a study may print, and their sentences for its tables and the screen.

Read `context`, then `headline`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from report.document.templates import said
from report.pages.marks import UNVERIFIED
from report.pages.symbols import with_symbols
from report.study.design_rule import I_E, SDC
from report.study.dispersions import NOT_DETERMINED, is_refused, is_warned
from report.study.manifest import OWN_KEY, TRUST_PARTS
from report.study.study_results import MEAN, SLOPE_DECIMALS, StudyResults
from report.text.unit_format import UnitFormat
from report.text.units import digits_down, digits_up, no_less, with_unit
from report.typeset.pdf import TEMPLATES
from solver.rules.provisions import SEPARATION_KEYS

# Each force on such a block is proportional to its mass; a study has no others.
MASS = "Mass has no effect: each array is one rigid block with Coulomb friction"
_SENTENCES = "study/sentences.html"


def context(results: StudyResults) -> dict[str, Any]:
    """Return what every template of a study may print."""
    rule, study_input = results.plan.design_rule, results.plan.input
    return {
        "r": results,
        "rule": rule,
        "given": study_input,
        "study": study_input.study,
        "both": partial(both, results),
        "chance": chance,
        "level": partial(level, results),
        "on": partial(on_building, results),
        "with_symbols": with_symbols,
        "max_slope": min("ibc_max_slope_deg", "analysis_max_slope_deg", key=rule.rules.__getitem__),
        "separations": sorted(SEPARATION_KEYS.values(), key=lambda key: rule.rules[key]),
        "is_refused": is_refused(results),
        "is_warned": is_warned(results),
        "I_E": I_E,
        "MEAN": MEAN,
        "NOT_DETERMINED": NOT_DETERMINED,
        "OWN_KEY": OWN_KEY,
        "SDC": SDC,
        "TRUST_PARTS": TRUST_PARTS,
        "UNVERIFIED": UNVERIFIED,
    }


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


def sentence(results: StudyResults, macro: str) -> str:
    """Return a sentence that the tables and exports share with the pages; empty for none."""
    return said(TEMPLATES, _SENTENCES, macro, context(results))


def taken_over(results: StudyResults) -> list[str]:
    """Return how many runs are from parts that were there, from when and on whose word."""
    return _lines("taken_over", context(results))


def headline(results: StudyResults) -> list[str]:
    """Return the main results, one line each."""
    levels = results.plan.input.intensities
    facts = {"middle": levels[len(levels) // 2], "steepest": list(_steepest(results))}
    return _lines("headline", context(results) | facts)


def _lines(macro: str, values: Mapping[str, Any]) -> list[str]:
    text = said(TEMPLATES, _SENTENCES, macro, values)
    return [line.strip() for line in text.splitlines() if line.strip()]


def _steepest(results: StudyResults) -> Iterator[tuple[str, float, list[str]]]:
    """Yield building, friction, and the largest slope for the allowed displacement by its name."""
    study_input, allowed_m = results.plan.input, results.plan.input.study.allowed_m
    names, middle = dict.fromkeys((results.leading, MEAN)), len(study_input.intensities) // 2
    if not allowed_m:
        return
    for building in range(len(results.plan.motions.buildings)):
        at_middle = [results.largest_slopes(building, name, allowed_m)[:, middle] for name in names]
        for mu, *slopes in zip(study_input.mus, *at_middle, strict=True):
            yield on_building(results, building), mu, [_slope(results, slope) for slope in slopes]


def _slope(results: StudyResults, slope: float) -> str:
    if math.isnan(slope):
        return "none in the study"
    return f"{answer(slope, results.plan.input.slopes_deg[-1], '≥', SLOPE_DECIMALS)}°"


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
