"""The simplified formula with its error and domain, beside the computed values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.entities.shown import text
from report.pages.symbols import with_symbols
from report.study.page_parts import (
    MOST_CUTS,
    MOST_FRICTIONS,
    axis,
    design_length,
    length,
    some,
)
from report.study.results import StudyResults
from report.study.tables import length_unit
from report.study.words import on_building
from report.words.counts import capitalized
from report.words.units import digits_down, digits_up, number, round_down, round_up
from solver.studies.fit import DIGITS, Fit

_At = tuple[int, int, int, int]


def formula(results: StudyResults, building: int) -> Section:
    """Return the section on the formula, or why there is none."""
    fit = results.fits[building]
    return section(
        "study/formula",
        f"Simplified formula{on_building(results, building, ', building ')}",
        id=f"formula-{building}",
        **(_content(results, building, fit) if isinstance(fit, Fit) else {"lacking": fit}),
    )


def _content(results: StudyResults, building: int, fit: Fit) -> Mapping[str, Any]:
    low_deg, high_deg = map(math.degrees, fit.domain["slope_rad"])
    return {
        "lacking": "",
        "fit": fit,
        "b": [_digits(value).replace("-", "−") for value in fit.coefficients],
        "ppa_g": _digits(fit.ppa_g),
        "sigma": number(round_up(fit.sigma_ln, 2), 2),
        "least": number(round_down(fit.minimum_ratio, 2), 2),
        "greatest": number(round_up(fit.maximum_ratio, 2), 2),
        "slopes": _inward(low_deg, high_deg, "°"),
        "domain": {name: _inward(*ends) for name, ends in fit.domain.items()},
        "beside": _beside(results, building, fit),
    }


def _digits(value: float) -> str:
    return f"{value:.{DIGITS}g}"


def _inward(low: float, high: float, unit: str = "") -> str:
    return f"{float(digits_up(low, 3)):g}{unit} to {float(digits_down(high, 3)):g}{unit}"


def _beside(results: StudyResults, building: int, fit: Fit) -> Table:
    given, unit = results.plan.input, length_unit(results).symbol
    name = capitalized(results.plan.design_rule.name)
    mean_m, design_m = results.curves.mean_m, results.design_m
    by_formula = partial(_by_formula, results, fit)
    columns = (
        (text("μ"), lambda at: f"{given.mus[at[2]]:g}"),
        (text("Slope", "deg"), lambda at: f"{given.slopes_deg[at[1]]:g}"),
        (text(with_symbols(axis(results))), lambda at: f"{given.intensities[at[3]]:g}"),
        (text("Mean PRD", unit), lambda at: length(results, float(mean_m[at]))),
        (text(name, unit, 1.4), lambda at: design_length(results, float(design_m[at]))),
        (text("The same by the formula", unit, 1.4), lambda at: by_formula(at)[0]),
        (text(with_symbols("Δ_RHA / formula"), share=1.2), lambda at: by_formula(at)[1]),
    )
    cases = [
        (building, s, m, x)
        for m in some(given.mus, MOST_CUTS)
        for s in some(given.slopes_deg, MOST_CUTS)
        for x in some(given.intensities, MOST_FRICTIONS)
    ]
    return listed(cases, columns, kind="compact")


def _by_formula(results: StudyResults, fit: Fit, at: _At) -> tuple[str, str]:
    """Return the design displacement by the formula, and computed value / formula."""
    given, rule = results.plan.input, results.plan.design_rule
    _, s, m, x = at
    case = math.radians(given.slopes_deg[s]), given.mus[m], given.intensities[x]
    if not fit.covers(*case):
        return "outside", "—"
    computed, fitted = float(results.analysis_m[at]), fit.prd_m(*case)
    floor = float(rule.floor_m[x]) if rule.has_floor else 0.0
    ratio = number(computed / fitted, 2) if computed > 0.0 else "—"
    return design_length(results, max(fitted, floor)), ratio
