"""The fragility of an array, and the probability that its clearance is exceeded."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.document.tables import Column, listed
from report.document.templates import Section, section
from report.entities.shown import text, words
from report.study import figures
from report.study.exports import has_probabilities
from report.study.page_parts import axis
from report.study.plan import SLOPE
from report.study.results import ArrayStudyResult, LimitState, StudyResults
from report.study.tables import length_unit
from report.study.wording import (
    MASS,
    NAMES,
    Dispersion,
    dispersions,
    exported,
    is_exportable,
    is_refused,
    on_building,
)
from report.text.formats import slug
from report.text.units import number, round_up
from solver.studies import capacity, uncertainty
from solver.studies import fragility as fits


def fragility(results: StudyResults, result: ArrayStudyResult) -> Section:
    """Return the section on an array: its fragilities, and the probabilities where asked for."""
    name = f"{result.plan.array.id}{on_building(results, result.plan.building, ', building ')}"
    known = [state for state in result.states if state.fragility.fitted.is_known]
    return section(
        "study/array",
        f"Fragility of {name}",
        id=f"array-{slug(name)}",
        one=result,
        is_left_out=is_exportable(results) and not has_probabilities(result),
        exported=_exported(results, result, known),
        MASS=MASS,
        capacity=capacity,
        fits=fits,
        uncertainty=uncertainty,
        charts=dict(_charts(results, result)),
    )


def _charts(results: StudyResults, result: ArrayStudyResult) -> Iterator[tuple[str, str]]:
    yield "fragility", figures.fragilities(result.states, axis(results))
    tested = [state for state in result.states if not math.isnan(state.fragility.p_value)]
    if tested:
        yield "goodness", figures.goodness(tested, axis(results))
    if result.bars and not math.isnan(result.center_m):
        yield "tornado", figures.tornado(result.bars, result.center_m, length_unit(results))


def _exported(
    results: StudyResults, result: ArrayStudyResult, states: Sequence[LimitState]
) -> Mapping[str, Any]:
    """Return the dispersions of the exported fragilities by name; empty if there are none."""
    by_state = {state.name: dispersions(results, result, state) for state in states}
    if not by_state or not is_exportable(results):
        return {}
    by_name = list(zip(*by_state.values(), strict=True))
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
    return {
        "lacking": [
            f"{name} ({parts[0].source})"
            for k, (name, parts) in enumerate(zip(NAMES, by_name, strict=True))
            if k not in known
        ],
        "first_order": [NAMES[k] for k in known if NAMES[k] in ("friction", "slope")],
        "is_level_below": below == 0.0,
        "table": listed(states, columns),
    }


def _part(
    parts: Sequence[Dispersion], at: int, by_state: Mapping[str, Sequence[Dispersion]]
) -> Column:
    """Return the column of a dispersion: its name, and its source in the states that have it."""
    source = next(part.source for part in parts if part.beta)
    head = text(f"{NAMES[at].capitalize()}: {source}", share=1.7)
    return (
        head,
        lambda state: _beta(by_state[state.name][at].beta) or by_state[state.name][at].source,
    )


def _beta(beta: float) -> str:
    return number(round_up(beta, 3), 3) if beta else ""
