"""The simplified formula with its error and domain, beside the computed values."""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.study.blocks import Block, ManualSection
from report.pages.symbols import with_symbols
from report.study.page_parts import (
    MOST_CUTS,
    MOST_FRICTIONS,
    axis,
    design_length,
    length,
    on_building,
    some,
)
from report.study.results import StudyResults
from report.study.tables import length_unit
from report.study.words import analysis_words, both, provision
from report.words.units import digits_down, digits_up, number, round_down, round_up
from solver.studies.fit import DIGITS, Fit


def formula(results: StudyResults, building: int) -> ManualSection:
    """Return the section on the formula, or why there is none."""
    fit = results.fits[building]
    block = (
        Block(texts=_texts(results, fit), tables=(_beside(results, building, fit),))
        if isinstance(fit, Fit)
        else Block(texts=(f"None is given: {fit}.",))
    )
    return ManualSection(
        id=f"formula-{building}",
        title=f"Simplified formula{on_building(results, building)}",
        blocks=(block,),
    )


def _texts(results: StudyResults, fit: Fit) -> tuple[str, ...]:
    rule, measure = results.plan.design_rule, results.plan.input.study.intensity
    b = [f"{value:.{DIGITS}g}".replace("-", "−") for value in fit.coefficients]
    least = number(round_down(fit.least_ratio, 2), 2)
    greatest = number(round_up(fit.greatest_ratio, 2), 2)
    return (
        f"ln Δ_RHA = {b[0]} + ({b[1]}) ln(1 − r) + ({b[2]}) ln r + ({b[3]}) ln x + ({b[4]}) θ/μ, "
        f"with Δ_RHA in m, x = {measure.letters} in {measure.unit}, θ in rad, "
        f"r = tan(arctan μ − θ) / ({fit.ppa_g:.{DIGITS}g} x).",
        f"Δ_RHA is the value from analysis, {analysis_words(results)}. The design displacement is "
        + (
            f"the larger of Δ_RHA and {provision(rule.rules, 'analysis_floor')} times the "
            "prescriptive displacement."
            if rule.has_floor
            else "not less than its floor, which follows from the S_DS of each site."
        ),
        f"Fitted to {fit.cases} cases by least squares of the logarithm. The standard deviation of "
        f"ln(computed / formula) is {number(round_up(fit.sigma_ln, 2), 2)}; computed / formula is "
        f"between {least} and {greatest}: {greatest} times the formula is not exceeded in any of "
        "these cases.",
        f"It holds only in its domain: {', '.join(_domain(results, fit))}; fitted are values of "
        f"{both(results, fit.domain['prd_m'][0])} to {both(results, fit.domain['prd_m'][1])}.",
    )


def _domain(results: StudyResults, fit: Fit) -> Iterator[str]:
    """Yield the ranges, rounded inward."""
    measure = results.plan.input.study.intensity
    low, high = map(math.degrees, fit.domain["slope_rad"])
    yield f"slopes of {_inward(low, high, '°')}"
    yield f"μ of {_inward(*fit.domain['mu'])}"
    yield f"{measure.letters} of {_inward(*fit.domain['intensity'])} {measure.unit}"
    yield f"r of {_inward(*fit.domain['r'])}"


def _inward(low: float, high: float, unit: str = "") -> str:
    return f"{float(digits_up(low, 3)):g}{unit} to {float(digits_down(high, 3)):g}{unit}"


def _beside(results: StudyResults, building: int, fit: Fit) -> Table:
    given, unit, name = results.plan.input, length_unit(results), results.plan.design_rule.name
    return Table(
        caption="Computed values and the formula",
        columns=(
            TableColumn(head="μ"),
            TableColumn(head="Slope", unit="deg"),
            TableColumn(head=with_symbols(axis(results))),
            TableColumn(head="Mean PRD", unit=unit.symbol),
            TableColumn(head=f"{name[:1].upper()}{name[1:]}", unit=unit.symbol, share=1.4),
            TableColumn(head="The same by the formula", unit=unit.symbol, share=1.4),
            TableColumn(head=with_symbols("Δ_RHA / formula"), share=1.2),
        ),
        rows=tuple(
            _row(results, fit, (building, s, m, x))
            for m in some(given.mus, MOST_CUTS)
            for s in some(given.slopes_deg, MOST_CUTS)
            for x in some(given.intensities, MOST_FRICTIONS)
        ),
        kind="compact",
    )


def _row(results: StudyResults, fit: Fit, at: tuple[int, int, int, int]) -> TableRow:
    given, rule = results.plan.input, results.plan.design_rule
    _, s, m, x = at
    case = math.radians(given.slopes_deg[s]), given.mus[m], given.intensities[x]
    computed = float(results.analysis_m[at])
    inside = fit.covers(*case)
    fitted = fit.prd_m(*case) if inside else math.nan
    floor = float(rule.floor_m[x]) if rule.has_floor else 0.0
    return TableRow(
        cells=(
            f"{given.mus[m]:g}",
            f"{given.slopes_deg[s]:g}",
            f"{given.intensities[x]:g}",
            length(results, float(results.curves.mean_m[at])),
            design_length(results, float(results.design_m[at])),
            design_length(results, max(fitted, floor)) if inside else "outside",
            number(computed / fitted, 2) if inside and computed > 0.0 else "—",
        )
    )
