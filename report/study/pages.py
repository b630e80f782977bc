"""The pages of study.pdf: sections with charts and tables, from the results.

Sentences are computed from the results. Read `sections` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.entities.marks import UNVERIFIED
from report.study.blocks import Block, Chart, ManualSection, slug
from report.pages.symbols import with_symbols
from report.study import figures
from report.study.answer_pages import allowed
from report.study.array_pages import fragility
from report.study.basis_pages import basis, limits
from report.study.formula_pages import formula
from report.study.page_parts import (
    MOST_CUTS,
    MOST_FRICTIONS,
    MOST_LINES,
    axis,
    chart,
    design_length,
    friction_name,
    length,
    level,
    on_building,
    some,
)
from report.study.prescribed import compare
from report.study.prescribed_pages import prescribed
from report.study.results import STATISTICS, StudyResults
from report.study.tables import length_unit
from report.study.words import both, design_basis, design_words, headline
from solver.model import Floats


def sections(results: StudyResults) -> tuple[ManualSection, ...]:
    """Return all sections except the cover and the contents."""
    buildings = range(len(results.plan.motions.buildings))
    found = [_summary(results), basis(results)]
    for b in buildings:
        found.append(_curves(results, b))
        if results.plan.input.study.allowed_m:
            found.append(allowed(results, b, results.plan.input.study.allowed_m))
        found.append(formula(results, b))
        found += [prescribed(results, b, one) for one in compare(results, b)]
    found += [fragility(results, one) for one in results.arrays]
    return (*found, limits(results))


def _summary(results: StudyResults) -> ManualSection:
    lines = [line[:1].upper() + line[1:] for line in headline(results)]
    texts = (f"{design_words(results)} {UNVERIFIED}.",)
    return ManualSection(
        id="results", title="Results", blocks=(Block(items=lines), Block(texts=texts))
    )


def _curves(results: StudyResults, building: int) -> ManualSection:
    return ManualSection(
        id=f"curves-{building}",
        title=f"Design curves{on_building(results, building)}",
        blocks=(
            Block(
                texts=(
                    f"{_name(results)} by case. {_thin(results)}The file curves.csv has every "
                    "case, with the 84th percentile and the largest PRD.",
                ),
                charts=tuple(_charts(results, building)),
            ),
            *_sheets(results, building),
            Block(
                title="Design displacement, mean, 84th percentile and largest PRD",
                tables=(_spread(results, building),),
            ),
        ),
    )


def _name(results: StudyResults) -> str:
    return f"{results.leading[:1].upper()}{results.leading[1:]}"


def _thin(results: StudyResults) -> str:
    return "Thin and gray: mean PRD. " if results.plan.design_rule.has_value else ""


def _beside(results: StudyResults, building: int) -> Floats:
    """Return the mean that is drawn beside the design displacement; NaN where that is drawn."""
    mean = results.curves.mean_m[building]
    return mean if results.plan.design_rule.has_value else np.full_like(mean, np.nan)


def _charts(results: StudyResults, building: int) -> Iterator[Chart]:
    """Yield the curves of each friction, against intensity and against slope."""
    given, unit = results.plan.input, length_unit(results)
    slopes, levels = np.array(given.slopes_deg), np.array(given.intensities)
    values = results.displacements[results.leading][building]
    mean = _beside(results, building)
    for m in some(given.mus, MOST_FRICTIONS):
        named = friction_name(results, given.mus[m])
        shown = some(given.slopes_deg, MOST_LINES)
        yield chart(
            f"intensity-{slug(named)}",
            figures.curves(
                levels,
                [(f"{slopes[s]:g}°", values[s, m]) for s in shown],
                unit,
                along=axis(results),
                beside=[mean[s, m] for s in shown],
            ),
            f"{_name(results)} against {given.study.intensity.letters}, {named}, by slope.",
        )
        if len(slopes) > 1:
            shown = some(given.intensities, MOST_LINES)
            yield chart(
                f"slope-{slug(named)}",
                figures.curves(
                    slopes,
                    [(level(results, levels[x]), values[:, m, x]) for x in shown],
                    unit,
                    along="Slope [deg]",
                    beside=[mean[:, m, x] for x in shown],
                ),
                f"{_name(results)} against slope, {named}, by {given.study.intensity.letters}.",
            )


def _sheets(results: StudyResults, building: int) -> Iterator[Block]:
    """Yield contour sheets, each on a page of its own."""
    given, unit = results.plan.input, length_unit(results)
    values = results.displacements[results.leading][building]
    mean = _beside(results, building)
    slopes, mus, levels = map(np.array, (given.slopes_deg, given.mus, given.intensities))
    allowed_m = given.study.allowed_m or math.nan
    if len(slopes) < 2:
        return
    cuts: list[tuple[Floats, Any, str, str]]
    if len(mus) > MOST_FRICTIONS:
        cuts = [
            (mus, np.s_[:, :, x], "Friction coefficient μ", level(results, levels[x]))
            for x in some(given.intensities, MOST_CUTS)
        ]
    else:
        cuts = [
            (levels, np.s_[:, m], axis(results), friction_name(results, mu))
            for m, mu in enumerate(mus)
        ]
    for x, cut, along, named in cuts:
        if len(x) < 2 or np.isnan(values[cut]).all():
            continue
        svg = figures.contours(
            x, slopes, values[cut], mean[cut], unit, along=along, allowed_m=allowed_m
        )
        is_thick = np.nanmin(values[cut]) < allowed_m < np.nanmax(values[cut])
        thick = f"Thick: {both(results, allowed_m)}." if is_thick else ""
        caption = f"{_of_sheet(results, named)} {_thin(results)}{thick}".strip()
        yield Block(title=f"Sheet: {named}", charts=(chart(f"sheet-{slug(named)}", svg, caption),))


def _of_sheet(results: StudyResults, named: str) -> str:
    """Return what a sheet shows, complete without the other pages."""
    rule = results.plan.design_rule
    if not rule.has_value:
        return f"Contours of the mean PRD, {named}: too few motions for a {rule.name}."
    return f"Contours of the {rule.name}, {named}, by {design_basis(results)}. {UNVERIFIED}."


def _spread(results: StudyResults, building: int) -> Table:
    given, unit = results.plan.input, length_unit(results)
    x = len(given.intensities) // 2
    return Table(
        caption=with_symbols(f"Displacements at {level(results, given.intensities[x])}"),
        columns=(
            TableColumn(head="μ"),
            TableColumn(head="Slope", unit="deg"),
            *(
                TableColumn(head=f"{name[:1].upper()}{name[1:]}", unit=unit.symbol, share=1.3)
                for name in results.displacements
            ),
            TableColumn(head="Motions without a value", share=1.5),
        ),
        rows=tuple(
            _spread_row(results, (building, s, m, x))
            for m in some(given.mus, MOST_FRICTIONS)
            for s in some(given.slopes_deg, MOST_LINES)
        ),
        notes=("The design displacement is rounded up.",),
        kind="compact",
    )


def _spread_row(results: StudyResults, at: tuple[int, int, int, int]) -> TableRow:
    given, (_, s, m, _) = results.plan.input, at
    beside = (length(results, float(results.displacements[name][at])) for name in STATISTICS)
    return TableRow(
        cells=(
            f"{given.mus[m]:g}",
            f"{given.slopes_deg[s]:g}",
            design_length(results, float(results.design_m[at])),
            *beside,
            str(int(results.curves.without_value[at])),
        )
    )
