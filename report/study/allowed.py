"""The least friction and the largest slope for the allowed displacement."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.entities.shown import Shown, text
from report.study.page_parts import MOST_LINES, some
from report.study.results import FRICTION_DECIMALS, MEAN, SLOPE_DECIMALS, StudyResults
from report.study.words import answer, on_building, shown
from solver.model import Floats


def allowed(results: StudyResults, building: int, allowed_m: float) -> Section:
    """Return the section on what an allowed displacement asks for."""
    given = results.plan.input
    frictions = [shown(mu, FRICTION_DECIMALS) for mu in (given.mus[0], given.mus[-1])]
    slopes = [shown(s, SLOPE_DECIMALS) for s in (given.slopes_deg[0], given.slopes_deg[-1])]
    least = partial(answer, end=given.mus[0], mark="≤", decimals=FRICTION_DECIMALS)
    largest = partial(answer, end=given.slopes_deg[-1], mark="≥", decimals=SLOPE_DECIMALS)
    return section(
        "study/allowed",
        f"Least friction and largest slope{on_building(results, building, ', building ')}",
        id=f"allowed-{building}",
        floor_alone=list(_floor_alone(results, allowed_m)),
        frictions=frictions,
        slopes=slopes,
        answers=[
            (
                name,
                _table(results, text("Slope", "deg"), given.slopes_deg, mus, least),
                _table(results, text("μ"), given.mus, slopes_deg, largest),
            )
            for name in dict.fromkeys((results.leading, MEAN))
            for mus in [results.minimum_frictions(building, name, allowed_m)]
            for slopes_deg in [results.largest_slopes(building, name, allowed_m)]
        ],
    )


def _floor_alone(results: StudyResults, allowed_m: float) -> Iterator[float]:
    """Yield from which intensity on no friction and no slope is enough, because of the floor."""
    rule = results.plan.design_rule
    beyond = np.flatnonzero(rule.floor_m > allowed_m)
    if rule.has_value and beyond.size:
        yield results.plan.input.intensities[beyond[0]]


def _table(
    results: StudyResults,
    head: Shown,
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
