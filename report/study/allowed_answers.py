"""The section of a study on the lowest friction and the largest slope allowed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from report.document.columns import ColumnHead, text
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.study.page_parts import MOST_LINES, some
from report.study.study_results import FRICTION_DECIMALS, MEAN, SLOPE_DECIMALS, StudyResults
from report.study.wording import answer, on_building, shown
from solver.model import Floats


def allowed(results: StudyResults, building: int, allowed_m: float) -> Section:
    """Return the section on the requirements of an allowed displacement."""
    study_input = results.plan.input
    frictions = [shown(mu, FRICTION_DECIMALS) for mu in (study_input.mus[0], study_input.mus[-1])]
    slopes = [
        shown(s, SLOPE_DECIMALS) for s in (study_input.slopes_deg[0], study_input.slopes_deg[-1])
    ]
    needed = partial(answer, end=study_input.mus[0], mark="≤", decimals=FRICTION_DECIMALS)
    largest = partial(answer, end=study_input.slopes_deg[-1], mark="≥", decimals=SLOPE_DECIMALS)
    rule, floor_alone = results.plan.design_rule, []
    # The floor grows with S_DS and knows neither friction nor slope: from the first intensity at
    # which it is larger than allowed, none of them is enough.
    beyond = np.flatnonzero(rule.floor_m > allowed_m)
    if rule.has_value and beyond.size:
        floor_alone.append(study_input.intensities[beyond[0]])
    answers = []
    # Both: a design displacement is for a clearance, the mean is what other analyses are compared
    # with. With too few motions they are one.
    for name in dict.fromkeys((results.leading, MEAN)):
        mus = results.minimum_frictions(building, name, allowed_m)
        slopes_deg = results.largest_slopes(building, name, allowed_m)
        by_slope = _allowed_table(
            results, text("Slope", "deg"), study_input.slopes_deg, mus, needed
        )
        by_friction = _allowed_table(results, text("μ"), study_input.mus, slopes_deg, largest)
        answers.append((name, by_slope, by_friction))
    return section(
        "study/allowed",
        f"Lowest friction and steepest slope{on_building(results, building, ', building ')}",
        id=f"allowed-{building}",
        floor_alone=floor_alone,
        frictions=frictions,
        slopes=slopes,
        answers=answers,
    )


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
