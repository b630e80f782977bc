"""The section on the fragilities of an array, with its probabilities. Read `fragility`."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Column, Table, listed
from report.study import study_charts
from report.study.dispersions import (
    NAMES,
    Dispersion,
    dispersions,
    exported,
    is_exportable,
    is_refused,
)
from report.study.page_parts import axis
from report.study.study_plan import SLOPE
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.study.study_tables import length_unit
from report.study.wording import MASS, both, on_building
from report.text.names import joined, slug
from report.text.units import digits_down, digits_up, number, round_up
from solver.studies import capacity, uncertainty
from solver.studies import fragility as fits


def fragility(results: StudyResults, result: ArrayStudyResult) -> Section:
    """Return the section on an array: its fragilities, and the probabilities where asked for."""
    name = f"{result.plan.array.id}{on_building(results, result.plan.building, ', building ')}"
    fragilities = [state.fragility for state in result.states]
    known = [state for state in result.states if state.fragility.fitted.is_known]
    return section(
        "study/array",
        f"Fragility of {name}",
        id=f"array-{slug(name)}",
        one=result,
        array=result.plan.array,
        motions=fragilities[0].capacities.intensity.size,
        levels=fragilities[0].levels.size,
        censored=fragilities[0].censored,
        notes=list(_notes(result)),
        unknown=[state.name for state in result.states if not state.fragility.fitted.is_known],
        fragilities=_fragilities(results, result),
        is_untested=any(math.isnan(of_state.p_value) for of_state in fragilities),
        exported=_exported(results, result, known),
        is_centered=not math.isnan(result.center_m),
        quantiles=[f"{100 * share:g}%" for share in (uncertainty.LOW, uncertainty.HIGH)],
        confidence=f"{100 * fits.CONFIDENCE:g}%",
        REPEATS=fits.REPEATS,
        LILLIEFORS_REPEATS=fits.LILLIEFORS_REPEATS,
        goodness=f"{100 * (1 - fits.LEVEL):g}%",
        ACCURACY=capacity.ACCURACY,
        MASS=MASS,
        charts=dict(_charts(results, result)),
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


def _charts(results: StudyResults, result: ArrayStudyResult) -> Iterator[tuple[str, str]]:
    yield "fragility", study_charts.fragilities(result.states, axis(results))
    tested = [state for state in result.states if not math.isnan(state.fragility.p_value)]
    if tested:
        yield "goodness", study_charts.goodness(tested, axis(results))
    if result.bars and not math.isnan(result.center_m):
        yield "tornado", study_charts.tornado(result.bars, result.center_m, length_unit(results))


def _exported(
    results: StudyResults, result: ArrayStudyResult, states: Sequence[LimitState]
) -> Mapping[str, Any]:
    """Return the dispersions of the exported fragilities by name; empty if there are none."""
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
    return {
        "lacking": f". Not included: {joined(lacking)}" if lacking else "",
        "first_order": [NAMES[k] for k in known if NAMES[k] in ("friction", "slope")],
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
