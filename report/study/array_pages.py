"""The fragility of an array, and the chance that its clearance is exceeded."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.study.blocks import Block, Chart, ManualSection, joined, slug
from report.pages.symbols import with_symbols
from report.study import figures
from report.study.dispersion import MASS, Dispersion, dispersions, exported, is_exportable, refusal
from report.study.exports import has_chances
from report.study.page_parts import axis, chart, level, on_building
from report.study.plan import SLOPE
from report.study.results import ArrayResult, StudyResults
from report.study.schema import NoValue, Sampling
from report.study.tables import length_unit
from report.study.words import NO_NUMBER, both, chance_words
from report.words.units import digits_down, digits_up, number, round_up
from solver.studies.capacity import ACCURACY
from solver.studies.fragility import CONFIDENCE, LEVEL, LILLIEFORS_REPEATS, REPEATS
from solver.studies.uncertainty import HIGH, LOW, Chance


def fragility(results: StudyResults, one: ArrayResult) -> ManualSection:
    """Return the section on an array: its fragilities, and the chances where asked for."""
    name = f"{one.plan.array.id}{on_building(results, one.plan.building)}"
    picture = chart(
        f"fragility-{slug(name)}",
        figures.fragilities(one.states, axis(results)),
        "Fractions of the motions, lognormal fits, and the confidence interval of each median "
        "(bars near 0.5).",
    )
    block = Block(
        texts=[*_procedure(results, one), *_unknown(results, one)],
        charts=(picture, *_goodness(results, one, name)),
        tables=(_states(results, one), *_exported(results, one)),
    )
    return ManualSection(
        id=f"array-{slug(name)}",
        title=f"Fragility of {name}",
        blocks=(block, *_chances(results, one, name)),
    )


def _goodness(results: StudyResults, one: ArrayResult, name: str) -> Iterator[Chart]:
    """Yield the chart of the goodness of fit, if a state has one."""
    states = [state for state in one.states if not math.isnan(state.fragility.p_value)]
    if states:
        yield chart(
            f"goodness-{slug(name)}",
            figures.goodness(states, axis(results)),
            "Goodness of fit: the ranks of the capacities, their lognormal, and the band that the "
            f"ranks leave in {100 * LEVEL:g}\u00a0% of lognormal samples.",
        )


def _procedure(results: StudyResults, one: ArrayResult) -> tuple[str, ...]:
    plan, counts = one.plan, one.states[0].fragility
    no_value = results.plan.input.study.no_value
    lost = "an exceedance" if no_value is NoValue.EXCEEDANCE else f"censored; {counts.censored} are"
    return (
        f"Array {plan.array.id}: mat {plan.array.mat}, μ = {plan.mu:g}, slope "
        f"{plan.array.slope_deg:g}°, clearance {both(results, plan.array.clearance_m)}"
        f"{f' to {plan.array.reaches}' if plan.array.reaches else ''}.",
        "Incremental dynamic analysis of the PRD, not of the design displacement: "
        f"the capacity of each of {counts.capacities.intensity.size} motions, the lowest "
        f"intensity at which its PRD exceeds the limit, by bisection to {ACCURACY:g} of it, and "
        "for slip from the required friction coefficient. The lognormal has their geometric mean, "
        "and their standard deviation of the logarithm with n − 1 as in FEMA P-58; where a capacity"
        f" is censored, both are of maximum likelihood. {100 * CONFIDENCE:g}\u00a0% confidence: "
        "Student t for the median and chi-square for β, and where a capacity is censored by "
        f"likelihood ratio and standard error with {REPEATS:,} samples. The data points are "
        f"fractions at {counts.levels.size} intensities. A run without a value is {lost}.",
        *_of_capacities(one),
    )


def _of_capacities(one: ArrayResult) -> Iterator[str]:
    """Yield what a lognormal of capacities does not show: censored ones, and curves that fall."""
    for state in one.states:
        found = state.fragility.capacities
        count = found.intensity.size
        if found.is_censored.any():
            lost = int(found.is_censored.sum())
            yield f"{state.name}: {lost} of {count} capacities are censored."
        if found.falls.any():
            yield (
                f"{state.name}: for {int(found.falls.sum())} of {count} motions the PRD is below "
                "the limit again at a greater intensity; the first crossing counts."
            )


def _unknown(results: StudyResults, one: ArrayResult) -> Iterator[str]:
    names = [state.name for state in one.states if not state.fragility.fitted.is_known]
    if names:
        yield (
            f"{joined(names)}: {NO_NUMBER}. A lognormal needs two different capacities above 0 up "
            "to the greatest intensity."
        )
    if is_exportable(results) and not has_chances(one):
        yield "The array is not in fragility.xml: a limit state has no lognormal and censored runs."


def _states(results: StudyResults, one: ArrayResult) -> Table:
    interval = f"{50 * (1 - CONFIDENCE):g} to {50 * (1 + CONFIDENCE):g} %"
    return Table(
        caption=with_symbols(f"Fragilities, median {axis(results)}"),
        columns=(
            TableColumn(head="State", align="left", share=0.7),
            TableColumn(head="Exceeded when", align="left", share=2.4),
            TableColumn(head="PRD above", share=1.7),
            TableColumn(head="Median"),
            TableColumn(head=interval, share=1.5),
            TableColumn(head="β"),
            TableColumn(head=f"{interval} of β", share=1.5),
            TableColumn(head="p of fit"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    state.name,
                    state.words,
                    both(results, state.limit_m) if state.limit_m else "0",
                    *_three(state.fragility.fitted.theta, state.fragility.theta_range, digits_down),
                    *_three(state.fragility.fitted.beta, state.fragility.beta_range, digits_up),
                    "—" if math.isnan(p) else digits_down(p, 2),
                )
            )
            for state in one.states
            for p in [state.fragility.p_value]
        ),
        notes=(
            f"p of fit: by Lilliefors, with {LILLIEFORS_REPEATS:,} samples. A small p speaks "
            "against a lognormal."
            + (
                " —: a capacity is censored, or there are fewer than four."
                if any(math.isnan(state.fragility.p_value) for state in one.states)
                else ""
            ),
        ),
    )


def _exported(results: StudyResults, one: ArrayResult) -> Iterator[Table]:
    """Yield the dispersions of the exported fragilities by name, if there are any."""
    states = [state for state in one.states if state.fragility.fitted.is_known]
    by_name = list(zip(*(dispersions(results, one, state) for state in states), strict=True))
    if not by_name or not is_exportable(results):
        return
    given = [parts for parts in by_name if any(part.beta for part in parts)]
    lacking = [f"{parts[0].name} ({parts[0].source})" for parts in by_name if parts not in given]
    totals = [exported(results, one, state).beta for state in states]
    yield Table(
        caption="Dispersions of the capacity by name; β of an exported fragility is the square root"
        " of the sum of their squares" + (f". Not included: {joined(lacking)}" if lacking else ""),
        columns=(
            TableColumn(head="State", align="left", share=0.7),
            *(TableColumn(head=_head(parts), share=1.7) for parts in given),
            TableColumn(head="β exported"),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    state.name,
                    *(_beta(p.beta) if p.beta else p.source for p in row),
                    "not exported" if refusal(results) else _beta(total),
                )
            )
            for state, row, total in zip(states, zip(*given, strict=True), totals, strict=True)
        ),
        notes=(*_first_order(one, by_name), f"{MASS}."),
    )


def _beta(value: float) -> str:
    return number(round_up(value, 3), 3)


def _head(parts: Sequence[Dispersion]) -> str:
    """Return the heading of a dispersion: its name, and its source in the states that have it."""
    part = next(part for part in parts if part.beta)
    return f"{part.name.capitalize()}: {part.source}"


def _first_order(one: ArrayResult, by_name: Sequence[Sequence[Dispersion]]) -> Iterator[str]:
    """Yield how the dispersions of friction and slope are found, if there are any."""
    *_, friction, slope = by_name
    names = [parts[0].name for parts in (friction, slope) if any(part.beta for part in parts)]
    if names:
        yield (
            f"{joined(names).capitalize()}: by first-order second moment, half the difference of "
            "the logarithms of the median capacities at one standard deviation above and below "
            "(where one is not determined, the difference of the other from the median)."
        )
    if SLOPE in one.plan.shifts and one.plan.shifts[SLOPE][0][1] == 0.0:
        yield "The slope below is 0: the roof is the same whichever way it tilts."


def _three(
    value: float, interval: tuple[float, float], show: Callable[[float, int], str]
) -> tuple[str, str]:
    """Return a value rounded to the safe side, and its interval, rounded outward."""
    if math.isnan(value):
        return "none", "none"
    low, high = interval
    return show(value, 3), f"{digits_down(low, 3)} to {digits_up(high, 3)}"


def _chances(results: StudyResults, one: ArrayResult, name: str) -> Iterator[Block]:
    title = "Chance that the clearance is exceeded"
    for chance in one.chances:
        texts = [_chance(results, one, chance), *_what_matters(one)]
        charts = tuple(_tornado(results, one, name))
        yield Block(title=title, texts=texts, charts=charts)


def _chance(results: StudyResults, one: ArrayResult, chance: Chance) -> str:
    study = results.plan.input.study
    how = (
        f"a Latin hypercube of {study.samples} samples of friction, slope and intensity"
        if study.sampling is Sampling.LATIN_HYPERCUBE
        else "all combinations of the tested friction coefficients and the slope at its "
        "tolerances and middle"
    )
    return (
        f"At {level(results, float(study.site_intensity or math.nan))} the clearance of "
        f"{both(results, one.plan.array.clearance_m)} is exceeded with a chance of "
        f"{chance_words(chance)}; the interval has {100 * CONFIDENCE:g}\u00a0% confidence, by "
        f"bootstrap over the {len(results.plan.motions.motions[0])} motions: {how}, each under "
        f"every motion, {chance.runs:,} pairs. {_without(chance.without_value)}"
    )


def _what_matters(one: ArrayResult) -> Iterator[str]:
    if one.bars and math.isnan(one.center_m):
        yield "A motion has no final PRD with all variables at their medians: no effect is shown."
    elif one.bars:
        yield (
            "Effect of one variable at a time on the mean PRD, from its "
            f"{100 * LOW:g} % to its {100 * HIGH:g} % quantile: {one.bars[0].name} matters most."
        )


def _tornado(results: StudyResults, one: ArrayResult, name: str) -> Iterator[Chart]:
    if one.bars and not math.isnan(one.center_m):
        yield chart(
            f"tornado-{slug(name)}",
            figures.tornado(one.bars, one.center_m, length_unit(results)),
            "Mean PRD with each variable alone at its quantiles (numbers at the ends); line: all "
            "at their medians.",
        )


def _without(count: int) -> str:
    if not count:
        return "Each has a final PRD."
    return f"{count:,} have no final PRD and count as exceedances."
