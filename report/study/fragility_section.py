"""The section on the fragilities of an array, with its probabilities. Read `fragility`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, listed
from report.pages.symbols import with_symbols
from report.study import study_charts
from report.study.dispersions import (
    NAMES,
    NOT_DETERMINED,
    Dispersion,
    dispersions,
    exported,
    is_exportable,
    is_refused,
)
from report.study.page_parts import axis
from report.study.sentences import MASS, about_array, about_intensity
from report.study.study_input import NoValue, Sampling
from report.study.study_plan import SLOPE
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.study.study_tables import length_unit
from report.study.wording import both, chance, level, on_building
from report.text.letter_case import capitalized
from report.text.names import joined, slug
from report.text.units import digits_down, digits_up, number, round_up
from solver.studies import capacity, uncertainty
from solver.studies import fragility as fits


def fragility(results: StudyResults, result: ArrayStudyResult) -> Section:
    """Return the section on an array: its fragilities, and the probabilities where asked for."""
    array, study = result.plan.array, results.plan.input.study
    name = f"{array.id}{on_building(results, result.plan.building, ', building ')}"
    fragilities, bars = [state.fragility for state in result.states], result.bars
    exceeded = result.exceedances[0] if result.exceedances else None
    is_exceedance = study.no_value is NoValue.EXCEEDANCE
    censored = f"censored; {fragilities[0].censored} are"
    tested = [state for state in result.states if not math.isnan(state.fragility.p_value)]
    return section(
        "study/array",
        f"Fragility of {name}",
        id=f"array-{slug(name)}",
        about=about_array(results, array, f"μ = {result.plan.mu:g}"),
        motions=results.plan.design_rule.n_motions,
        accuracy=capacity.ACCURACY,
        confidence=f"{100 * fits.CONFIDENCE:g}%",
        repeats=fits.REPEATS,
        levels=fragilities[0].levels.size,
        without_value="an exceedance" if is_exceedance else censored,
        notes=list(_notes(result)),
        goodness=_GOODNESS if tested else "",
        fragilities=_fragilities(results, result),
        fragilities_caption=with_symbols(f"Fragilities, median {axis(results)}"),
        fit_repeats=fits.LILLIEFORS_REPEATS,
        is_untested=len(tested) < len(fragilities),
        exported=_exported(results, result),
        mass=MASS,
        clearance=both(results, array.clearance_m),
        samples=study.samples if study.sampling is Sampling.LATIN_HYPERCUBE else 0,
        at=with_symbols(level(results, study.site_intensity or 0.0) + about_intensity(study)),
        exceedance=exceeded,
        chance=chance(exceeded.value, exceeded.low, exceeded.high) if exceeded else "",
        has_bars=bool(bars),
        largest_effect=bars[0].name if bars and not math.isnan(result.center_m) else "",
        low=f"{100 * uncertainty.LOW:g}%",
        high=f"{100 * uncertainty.HIGH:g}%",
        charts=dict(_charts(results, result, tested)),
    )


_GOODNESS = (
    "Goodness of fit: ranked capacities, the lognormal distribution fitted to them, and the band "
    f"that contains the ranks of {100 * (1 - fits.LEVEL):g}% of lognormal samples."
)


def _notes(result: ArrayStudyResult) -> Iterator[str]:
    """Yield what is said of censored capacities, and of those beyond which the PRD falls again."""
    for state in result.states:
        capacities = state.fragility.capacities
        censored, falls = capacities.is_censored.sum(), capacities.falls.sum()
        count = capacities.intensity.size
        if censored:
            yield f"{state.name}: {censored} of {count} capacities are censored."
        if falls:
            yield (
                f"{state.name}: for {falls} of {count} motions the PRD is below the limit again "
                "at a greater intensity; the first crossing counts."
            )
    unknown = [state.name for state in result.states if not state.fragility.fitted.is_known]
    if unknown:
        required = "two different capacities above 0 and up to the highest intensity"
        yield f"{joined(unknown)}: {NOT_DETERMINED}. A lognormal fit requires {required}."


def _fragilities(results: StudyResults, result: ArrayStudyResult) -> Table:
    """Return the lognormals of the limit states, with their intervals rounded outward."""
    low, high = 50 * (1 - fits.CONFIDENCE), 50 * (1 + fits.CONFIDENCE)
    interval = f"{low:g} to {high:g}%"
    columns = (
        (words("State", 0.7), lambda state: state.name),
        (words("Exceeded when", 2.4), lambda state: state.words),
        (
            text("PRD above", share=1.7),
            lambda state: both(results, state.limit_m) if state.limit_m else "0",
        ),
        (text("Median"), lambda state: _known(state.fragility.fitted.theta, digits_down)),
        (text(interval, share=1.5), lambda state: _outward(*state.fragility.theta_range)),
        (text("β"), lambda state: _known(state.fragility.fitted.beta, digits_up)),
        (text(f"{interval} of β", share=1.5), lambda state: _outward(*state.fragility.beta_range)),
        (text("p of fit"), lambda state: digits_down(state.fragility.p_value, 2)),
    )
    return listed(result.states, columns)


def _known(value: float, digits: Callable[[float, int], str]) -> str:
    return "none" if math.isnan(value) else digits(value, 3)


def _outward(low: float, high: float) -> str:
    return "none" if math.isnan(low) else f"{digits_down(low, 3)} to {digits_up(high, 3)}"


def _charts(
    results: StudyResults, result: ArrayStudyResult, tested: Sequence[LimitState]
) -> Iterator[tuple[str, str]]:
    yield "fragility", study_charts.fragilities(result.states, axis(results))
    if tested:
        yield "goodness", study_charts.goodness(tested, axis(results))
    if result.bars and not math.isnan(result.center_m):
        yield "tornado", study_charts.tornado(result.bars, result.center_m, length_unit(results))


def _exported(results: StudyResults, result: ArrayStudyResult) -> Mapping[str, Any]:
    """Return the dispersions of the exported fragilities by name; empty if there are none."""
    states = [state for state in result.states if state.fragility.fitted.is_known]
    by_state = {state.name: dispersions(results, result, state) for state in states}
    if not by_state or not is_exportable(results):
        return {}
    by_name = list(zip(*by_state.values(), strict=True))
    # A dispersion that no state has gets a sentence in place of a column.
    known = [k for k, parts in enumerate(by_name) if any(part.beta for part in parts)]
    below = result.plan.shifts[SLOPE][0][1] if SLOPE in result.plan.shifts else math.nan
    columns = (
        (words("State", 0.7), lambda state: state.name),
        *(_part(by_name[k], k, by_state) for k in known),
        (
            text("β exported"),
            lambda state: (
                "not exported"
                if is_refused(results)
                else _beta(exported(results, result, state).beta)
            ),
        ),
    )
    lacking = [
        f"{name} ({parts[0].source})"
        for k, (name, parts) in enumerate(zip(NAMES, by_name, strict=True))
        if k not in known
    ]
    caption = (
        "Dispersions of the capacity by name; β of an exported fragility is the square root of the "
        "sum of their squares"
    )
    first_order = [NAMES[k] for k in known if NAMES[k] in ("friction", "slope")]
    return {
        "caption": f"{caption}. Not included: {joined(lacking)}" if lacking else caption,
        "first_order": capitalized(joined(first_order)) if first_order else "",
        "is_level_below": below == 0.0,
        "table": listed(states, columns),
    }


def _part(
    parts: Sequence[Dispersion], k: int, by_state: Mapping[str, Sequence[Dispersion]]
) -> Column:
    """Return the column of a dispersion: its name, and its source in the states that have it."""
    source = next(part.source for part in parts if part.beta)
    head = text(f"{NAMES[k].capitalize()}: {source}", share=1.7)
    return (
        head,
        lambda state: _beta(by_state[state.name][k].beta) or by_state[state.name][k].source,
    )


def _beta(beta: float) -> str:
    return number(round_up(beta, 3), 3) if beta else ""
