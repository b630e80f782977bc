"""The least friction and the largest slope for the allowed displacement."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.study.blocks import Block, ManualSection
from report.pages.symbols import with_symbols
from report.study.page_parts import MOST_LINES, axis, level, on_building, some
from report.study.results import (
    FRICTION_DECIMALS,
    MEAN,
    SLOPE_DECIMALS,
    StudyResults,
)
from report.study.words import both, provision, shown


def allowed(results: StudyResults, building: int, allowed_m: float) -> ManualSection:
    """Return the section on what an allowed displacement asks for."""
    names = dict.fromkeys((results.leading, MEAN))
    return ManualSection(
        id=f"allowed-{building}",
        title=f"Least friction and largest slope{on_building(results, building)}",
        blocks=(
            Block(
                texts=(
                    f"For a {results.leading} of at most {both(results, allowed_m)}, interpolated "
                    "between the cases, friction rounded up and slopes rounded down. The tables "
                    f"for the {MEAN} are for comparison, not for design. study.xlsx has the same "
                    "for the 84th percentile and the largest PRD.",
                    *_floor_alone(results, allowed_m),
                    _slope_limits(results),
                )
            ),
            *(block for name in names for block in _answers(results, building, name, allowed_m)),
        ),
    )


def _floor_alone(results: StudyResults, allowed_m: float) -> Iterator[str]:
    """Yield from which intensity on no friction and no slope is enough, because of the floor."""
    rule = results.plan.design_rule
    beyond = np.flatnonzero(rule.floor_m > allowed_m)
    if rule.has_value and beyond.size:
        first = results.plan.input.intensities[beyond[0]]
        yield (
            f"At {level(results, first)} and more the floor alone exceeds it: no friction and no "
            "slope is then enough without peer review."
        )


def _slope_limits(results: StudyResults) -> str:
    """Return the limits of the rule set, which the answers do not know."""
    rules = results.plan.design_rule.rules
    ibc = rules.values["ibc_max_slope_deg"].clause
    return (
        f"The slopes are those of the displacement alone. {rules.name} permits the value from "
        f"analysis on slopes up to {provision(rules, 'analysis_max_slope_deg', '°')}; {ibc} "
        f"permits ballasted systems up to {provision(rules, 'ibc_max_slope_deg', '°')}."
    )


def _answers(results: StudyResults, building: int, name: str, allowed_m: float) -> Iterator[Block]:
    given = results.plan.input
    if len(given.mus) > 1:
        yield Block(tables=(_frictions(results, building, name, allowed_m),))
    if len(given.slopes_deg) > 1:
        yield Block(tables=(_slopes(results, building, name, allowed_m),))


def _frictions(results: StudyResults, building: int, name: str, allowed_m: float) -> Table:
    given = results.plan.input
    values = results.least_frictions(building, name, allowed_m)
    first, last = (shown(mu, FRICTION_DECIMALS) for mu in (given.mus[0], given.mus[-1]))
    columns = _columns(results)
    return Table(
        caption=with_symbols(
            f"Least friction coefficient, {name}, by slope (rows) and {axis(results)} (columns)"
        ),
        columns=(TableColumn(head="Slope", unit="deg"), *columns.values()),
        rows=tuple(
            TableRow(
                cells=(
                    f"{slope:g}",
                    *(_friction(values[s, x], given.mus[0], first) for x in columns),
                )
            )
            for s, slope in enumerate(given.slopes_deg)
        ),
        notes=(
            f"From this coefficient on, no friction of the study has a larger {name}. ≤ {first}: "
            f"the smallest of the study is enough; none: the largest, {last}, is not.",
        ),
        kind="compact",
    )


def _slopes(results: StudyResults, building: int, name: str, allowed_m: float) -> Table:
    given = results.plan.input
    values = results.largest_slopes(building, name, allowed_m)
    top = given.slopes_deg[-1]
    first, last = (shown(slope, SLOPE_DECIMALS) for slope in (given.slopes_deg[0], top))
    columns = _columns(results)
    return Table(
        caption=with_symbols(
            f"Largest slope [deg], {name}, by friction (rows) and {axis(results)} (columns)"
        ),
        columns=(TableColumn(head="μ"), *columns.values()),
        rows=tuple(
            TableRow(cells=(f"{mu:g}", *(_steepest(values[m, x], top, last) for x in columns)))
            for m, mu in enumerate(given.mus)
        ),
        notes=(
            f"Up to this slope, no slope of the study has a larger {name}. ≥ {last}: the "
            f"largest of the study is allowed; none: the smallest, {first}, is not.",
        ),
        kind="compact",
    )


def _columns(results: StudyResults) -> dict[int, TableColumn]:
    """Return the columns of intensities that are shown, by their number."""
    levels = results.plan.input.intensities
    return {x: TableColumn(head=f"{levels[x]:g}") for x in some(levels, MOST_LINES + 2)}


def _friction(value: float, smallest: float, first: str) -> str:
    if math.isnan(value):
        return "none"
    return f"≤ {first}" if value == smallest else shown(value, FRICTION_DECIMALS)


def _steepest(value: float, largest: float, last: str) -> str:
    if math.isnan(value):
        return "none"
    return f"≥ {last}" if value == largest else shown(value, SLOPE_DECIMALS)
