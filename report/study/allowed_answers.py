"""The section of a study on the lowest friction and the largest slope allowed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from report.document.columns import ColumnHead, text
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.pages.symbols import with_symbols
from report.study.page_parts import MOST_LINES, axis, some
from report.study.sentences import provision, steepest_permitted
from report.study.study_results import FRICTION_DECIMALS, MEAN, SLOPE_DECIMALS, StudyResults
from report.study.wording import answer, both, level, on_building, shown
from solver.model import Floats


def allowed(results: StudyResults, building: int, allowed_m: float) -> Section:
    """Return the section on the requirements of an allowed displacement."""
    study_input, rules = results.plan.input, results.plan.design_rule.rules
    mus, slopes_deg = study_input.mus, study_input.slopes_deg
    needed = partial(answer, end=mus[0], mark="≤", decimals=FRICTION_DECIMALS)
    largest = partial(answer, end=slopes_deg[-1], mark="≥", decimals=SLOPE_DECIMALS)
    letters, answers = f"{axis(results)} (columns)", []
    # Both: a design displacement is for a clearance, the mean is what other analyses are compared
    # with. With too few motions they are one.
    for name in dict.fromkeys((results.leading, MEAN)):
        by_slope = results.minimum_frictions(building, name, allowed_m)
        by_friction = results.largest_slopes(building, name, allowed_m)
        frictions = _allowed_table(results, text("Slope", "deg"), slopes_deg, by_slope, needed)
        slopes = _allowed_table(results, text("μ"), mus, by_friction, largest)
        friction = f"Lowest friction coefficient, {name}, by slope (rows) and {letters}"
        slope = f"Largest slope [deg], {name}, by friction (rows) and {letters}"
        answers.append((name, frictions, with_symbols(friction), slopes, with_symbols(slope)))
    return section(
        "study/allowed",
        f"Lowest friction and steepest slope{on_building(results, building, ', building ')}",
        id=f"allowed-{building}",
        leading=results.leading,
        allowed=both(results, allowed_m),
        mean=MEAN,
        floor_alone=_floor_alone(results, allowed_m),
        rules=rules.name,
        analysis_slope=provision(rules, "analysis_max_slope_deg", "°"),
        ibc=rules.values["ibc_max_slope_deg"].clause,
        ibc_slope=provision(rules, "ibc_max_slope_deg", "°"),
        steepest=steepest_permitted(rules),
        answers=answers,
        frictions=_ends(mus, FRICTION_DECIMALS),
        slopes=_ends(slopes_deg, SLOPE_DECIMALS),
    )


def _ends(values: Sequence[float], decimals: int) -> Sequence[str]:
    """Return the least and the greatest value of an axis; none of a single one."""
    return [shown(end, decimals) for end in (values[0], values[-1])] if len(values) > 1 else []


def _floor_alone(results: StudyResults, allowed_m: float) -> str:
    """Return the first intensity at which the floor is larger than allowed; empty for none."""
    rule = results.plan.design_rule
    # The floor grows with S_DS and knows neither friction nor slope: from there on, none of them is
    # enough.
    beyond = np.flatnonzero(rule.floor_m > allowed_m)
    if not (rule.has_value and beyond.size):
        return ""
    return with_symbols(level(results, results.plan.input.intensities[beyond[0]]))


def _allowed_table(
    results: StudyResults,
    head: ColumnHead,
    along: Sequence[float],
    answers: Floats,
    words: Callable[[float], str],
) -> Table:
    """Return answers by row, a column for each intensity that is shown."""
    levels = results.plan.input.intensities
    columns = [
        (text(f"{levels[x]:g}"), lambda row, x=x: words(row[1][x]))
        for x in some(levels, MOST_LINES + 2)
    ]
    rows = zip(along, answers, strict=True)
    return listed(rows, [(head, lambda row: f"{row[0]:g}"), *columns], kind="compact")
