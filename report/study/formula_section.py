"""The simplified formula of a study with its error and domain, beside the computed values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from report.document.columns import text
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.pages.symbols import with_symbols
from report.study.page_parts import MOST_CUTS, MOST_FRICTIONS, axis, design_length, length, some
from report.study.sentences import analysis, provision
from report.study.study_results import StudyResults
from report.study.study_tables import length_unit
from report.study.wording import both, on_building
from report.text.letter_case import capitalized
from report.text.units import (
    digits_down,
    digits_up,
    number,
    round_down,
    round_up,
)
from solver.studies.curves import DIGITS, Fit

_At = tuple[int, int, int, int]


def formula(results: StudyResults, building: int) -> Section:
    """Return the section on the formula, or why there is none."""
    fit = results.fits[building]
    content = _content(results, building, fit) if isinstance(fit, Fit) else {}
    return section(
        "study/formula",
        f"Simplified formula{on_building(results, building, ', building ')}",
        id=f"formula-{building}",
        lacking="" if isinstance(fit, Fit) else with_symbols(fit),
        **content,
    )


def _content(results: StudyResults, building: int, fit: Fit) -> Mapping[str, Any]:
    rule, measure = results.plan.design_rule, results.plan.input.study.intensity
    low_deg, high_deg = map(math.degrees, fit.domain["slope_rad"])
    smallest_m, largest_m = fit.domain["prd_m"]
    ppa_g = _digits(fit.ppa_g)
    return {
        "terms": _terms(fit.coefficients),
        "letters": with_symbols(measure.letters),
        "unit": measure.unit,
        "acceleration": "x" if ppa_g == "1" else f"({ppa_g} x)",
        "analysis": analysis(rule),
        "floor": provision(rule.rules, "analysis_floor") if rule.has_floor else "",
        "cases": fit.cases,
        "sigma": number(round_up(fit.sigma_ln, 2), 2),
        # Outward: every ratio is within what is printed; the domain below inward: all of it is
        # covered.
        "least": number(round_down(fit.minimum_ratio, 2), 2),
        "greatest": number(round_up(fit.maximum_ratio, 2), 2),
        "slopes": _inward(low_deg, high_deg, "°"),
        "domain": {name: _inward(*ends) for name, ends in fit.domain.items()},
        "smallest": both(results, smallest_m),
        "largest": both(results, largest_m),
        "beside": _beside(results, building, fit),
    }


def _terms(coefficients: Sequence[float]) -> str:
    """Return the right-hand side of the formula."""
    first, *factors = coefficients
    terms = [f"{'−' * (first < 0.0)}{_digits(abs(first))}"]
    for factor, variable in zip(factors, ("ln(1 − r)", "ln r", "ln x", "θ/μ"), strict=True):
        terms += ["−" if factor < 0.0 else "+", _digits(abs(factor)), variable]
    return " ".join(terms)


def _digits(value: float) -> str:
    return f"{value:.{DIGITS}g}"


def _inward(low: float, high: float, unit: str = "") -> str:
    return f"{float(digits_up(low, 3)):g}{unit} to {float(digits_down(high, 3)):g}{unit}"


def _beside(results: StudyResults, building: int, fit: Fit) -> Table:
    study_input, unit = results.plan.input, length_unit(results).symbol
    name = capitalized(results.plan.design_rule.name)
    mean_m, design_m = results.curves.mean_m, results.design_m
    by_formula = partial(_by_formula, results, fit)
    columns = (
        (text("μ"), lambda index: f"{study_input.mus[index[2]]:g}"),
        (text("Slope", "deg"), lambda index: f"{study_input.slopes_deg[index[1]]:g}"),
        (text(with_symbols(axis(results))), lambda index: f"{study_input.intensities[index[3]]:g}"),
        (text("Mean PRD", unit), lambda index: length(results, float(mean_m[index]))),
        (text(name, unit, 1.4), lambda index: design_length(results, float(design_m[index]))),
        (text("Value from the formula", unit, 1.4), lambda index: by_formula(index)[0]),
        (text(with_symbols("Δ_RHA / formula"), share=1.2), lambda index: by_formula(index)[1]),
    )
    intensities = some(study_input.intensities, MOST_FRICTIONS)
    cases = []
    for m in some(study_input.mus, MOST_CUTS):
        for s in some(study_input.slopes_deg, MOST_CUTS):
            cases += [(building, s, m, x) for x in intensities]
    return listed(cases, columns, kind="compact")


def _by_formula(results: StudyResults, fit: Fit, index: _At) -> tuple[str, str]:
    """Return the design displacement by the formula, and computed value / formula."""
    study_input, rule = results.plan.input, results.plan.design_rule
    _, s, m, x = index
    case = math.radians(study_input.slopes_deg[s]), study_input.mus[m], study_input.intensities[x]
    # Beyond the domain of the fit its error is not known.
    if not fit.covers(*case):
        return "outside", "—"
    computed, fitted = float(results.analysis_m[index]), fit.prd_m(*case)
    floor = float(rule.floor_m[x]) if rule.has_floor else 0.0
    ratio = number(computed / fitted, 2) if computed > 0.0 else "—"
    # The ratio is that of the values before the floor, which is what was fitted.
    return design_length(results, max(fitted, floor)), ratio
