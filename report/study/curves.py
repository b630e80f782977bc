"""The design curves: displacements against intensity and slope, contour sheets, and a table."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.entities.shown import text
from report.study import figures
from report.study.page_parts import (
    LOW_G,
    MOST_CUTS,
    MOST_FRICTIONS,
    MOST_LINES,
    axis,
    by_intensity,
    design_length,
    friction_name,
    length,
    some,
)
from report.study.results import STATISTICS, StudyResults
from report.study.tables import length_unit
from report.study.words import level, on_building
from report.words.counts import capitalized
from solver.model import Floats


def curves(results: StudyResults, building: int) -> Section:
    """Return the section on a building."""
    given = results.plan.input
    shown = some(given.mus, MOST_FRICTIONS)
    sloped = shown if len(given.slopes_deg) > 1 else []
    sheets = list(_sheets(results, building))
    return section(
        "study/curves",
        f"Design curves{on_building(results, building, ', building ')}",
        id=f"curves-{building}",
        named={m: friction_name(results, given.mus[m]) for m in shown},
        sheets=[(name, is_thick) for name, _, is_thick in sheets],
        LOW_G=LOW_G,
        place=results.plan.motions.buildings[building],
        middle=given.intensities[len(given.intensities) // 2],
        displacements=_displacements(results, building),
        charts={
            **{f"intensity-{m}": _against_intensity(results, building, m) for m in shown},
            **{f"slope-{m}": _against_slope(results, building, m) for m in sloped},
            **{f"sheet-{name}": svg for name, svg, _ in sheets},
        },
    )


def _drawn(results: StudyResults, building: int) -> tuple[Floats, Floats]:
    """Return the leading displacement and the mean beside it; NaN where the mean leads."""
    values, mean = results.displacements[results.leading][building], results.curves.mean_m[building]
    return values, mean if results.plan.design_rule.has_value else np.full_like(mean, np.nan)


def _against_intensity(results: StudyResults, building: int, m: int) -> str:
    values, mean = _drawn(results, building)
    shown = some(results.plan.input.slopes_deg, MOST_LINES)
    return by_intensity(results, values, m, beside=[mean[s, m] for s in shown])


def _against_slope(results: StudyResults, building: int, m: int) -> str:
    given = results.plan.input
    shown = some(given.intensities, MOST_LINES)
    values, mean = _drawn(results, building)
    return figures.curves(
        np.array(given.slopes_deg),
        [(level(results, given.intensities[x]), values[:, m, x]) for x in shown],
        length_unit(results),
        along="Slope [deg]",
        low=given.slopes_deg[-1],
        beside=[mean[:, m, x] for x in shown],
    )


def _sheets(results: StudyResults, building: int) -> Iterator[tuple[str, str, bool]]:
    """Yield contour sheets: name, drawing, and whether it has the allowed displacement."""
    given = results.plan.input
    values, mean = _drawn(results, building)
    allowed_m = given.study.allowed_m or math.nan
    for x, cut, along, name in _cuts(results):
        if len(x) < 2 or len(given.slopes_deg) < 2 or np.isnan(values[cut]).all():
            continue  # one row or column has no contours
        svg = figures.contours(
            np.array(x),
            np.array(given.slopes_deg),
            values[cut],
            mean[cut],
            length_unit(results),
            along=along,
            allowed_m=allowed_m,
        )
        yield name, svg, bool(np.nanmin(values[cut]) < allowed_m < np.nanmax(values[cut]))


def _cuts(results: StudyResults) -> Iterator[tuple[tuple[float, ...], Any, str, str]]:
    """Yield the axis of each sheet, its cases, the name of the axis, and that of the sheet."""
    given = results.plan.input
    if len(given.mus) > MOST_FRICTIONS:
        for x in some(given.intensities, MOST_CUTS):
            name = level(results, given.intensities[x])
            yield given.mus, np.s_[:, :, x], "Friction coefficient μ", name
    else:
        for m, mu in enumerate(given.mus):
            yield given.intensities, np.s_[:, m], axis(results), friction_name(results, mu)


def _displacements(results: StudyResults, building: int) -> Table:
    """Return the displacements at the middle intensity."""
    given, lost = results.plan.input, results.curves.without_value
    unit, x = length_unit(results).symbol, len(given.intensities) // 2
    cells = dict.fromkeys(STATISTICS, length) | {results.plan.design_rule.name: design_length}
    columns = (
        (text("μ"), lambda at: f"{given.mus[at[2]]:g}"),
        (text("Slope", "deg"), lambda at: f"{given.slopes_deg[at[1]]:g}"),
        *(
            (
                text(capitalized(name), unit, 1.3),
                lambda at, name=name, of=of: cells[name](results, float(of[at])),
            )
            for name, of in results.displacements.items()
        ),
        (text("Motions without a value", share=1.5), lambda at: int(lost[at])),
    )
    cases = [
        (building, s, m, x)
        for m in some(given.mus, MOST_FRICTIONS)
        for s in some(given.slopes_deg, MOST_LINES)
    ]
    return listed(cases, columns, kind="compact")
