"""The pages of study.pdf: sections with charts and tables, from the results.

Sentences are computed from the results. Read `sections` first.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from report.manual.blocks import Block, Chart, ManualSection, joined, slug
from report.pages.parts import Table, TableColumn, TableRow
from report.pages.symbols import with_symbols
from report.study import figures
from report.study.array_pages import fragility
from report.study.basis_pages import basis, limits
from report.study.page_parts import axis, chart, length, level, on_building
from report.study.prescribed import SDC, Prescribed, compare
from report.study.results import STATISTICS, StudyResults
from report.study.tables import length_unit
from report.study.words import both, headline
from solver.model import Floats
from solver.studies.fit import Fit

MOST_LINES = 8
"""Lines of a chart."""
MOST_FRICTIONS = 4
"""Friction coefficients with pages of their own; a grid of more is drawn over friction."""
MOST_CUTS = 3


def sections(results: StudyResults) -> tuple[ManualSection, ...]:
    """Return all sections except the cover and the contents."""
    buildings = range(len(results.plan.motions.buildings))
    found = [_summary(results), basis(results)]
    for b in buildings:
        found.append(_curves(results, b))
        if results.plan.input.study.allowed_m:
            found.append(_allowed(results, b, results.plan.input.study.allowed_m))
        found.append(_formula(results, b))
        found += [_prescribed(results, b, one) for one in compare(results, b)]
    found += [fragility(results, one) for one in results.arrays]
    return (*found, limits(results))


def _mats(results: StudyResults, mu: float) -> str:
    """Return μ = 0.5 (EPDM)."""
    given = results.plan.input
    names = [mat.id for mat in given.mats if given.friction(mat.id).center == mu]
    return f"μ = {mu:g}" + (f" ({joined(names)})" if names else "")


def _summary(results: StudyResults) -> ManualSection:
    return ManualSection(
        id="results",
        title="Results",
        blocks=(Block(items=[line[:1].upper() + line[1:] for line in headline(results)]),),
    )


def _some(values: Sequence[float], most: int) -> list[int]:
    """Return indices of at most `most` values, evenly spaced, the last one included."""
    step = max(1, math.ceil(len(values) / most))
    return list(range((len(values) - 1) % step, len(values), step))


def _curves(results: StudyResults, building: int) -> ManualSection:
    given, unit = results.plan.input, length_unit(results)
    mean = results.curves.mean_m[building]
    slopes, levels = np.array(given.slopes_deg), np.array(given.intensities)
    charts: list[Chart] = []
    for m in _some(given.mus, MOST_FRICTIONS):
        named = _mats(results, given.mus[m])
        charts.append(
            chart(
                f"intensity-{slug(named)}",
                figures.curves(
                    levels,
                    [(f"{slopes[s]:g}°", mean[s, m]) for s in _some(given.slopes_deg, MOST_LINES)],
                    unit,
                    along=axis(results),
                ),
                f"Mean PRD against {given.study.intensity.letters}, {named}, by slope.",
            )
        )
        if len(slopes) > 1:
            charts.append(
                chart(
                    f"slope-{slug(named)}",
                    figures.curves(
                        slopes,
                        [
                            (level(results, levels[x]), mean[:, m, x])
                            for x in _some(given.intensities, MOST_LINES)
                        ],
                        unit,
                        along="Slope [deg]",
                    ),
                    f"Mean PRD against slope, {named}, by {given.study.intensity.letters}.",
                )
            )
    return ManualSection(
        id=f"curves-{building}",
        title=f"Design curves{on_building(results, building)}",
        blocks=(
            Block(
                texts=(
                    "Mean of the PRD over the motions. The file curves.csv has the mean, the 84th "
                    "percentile and the largest of every case.",
                ),
                charts=charts,
            ),
            *_sheets(results, building),
            Block(title="Mean, 84th percentile and largest", tables=(_spread(results, building),)),
        ),
    )


def _sheets(results: StudyResults, building: int) -> Iterator[Block]:
    """Yield contour sheets, each on a page of its own."""
    given, unit = results.plan.input, length_unit(results)
    mean = results.curves.mean_m[building]
    slopes, mus, levels = map(np.array, (given.slopes_deg, given.mus, given.intensities))
    allowed = given.study.allowed_m or math.nan
    if len(slopes) < 2:
        return
    thick = f" Thick: {both(results, allowed)}." if given.study.allowed_m else ""
    if len(mus) > MOST_FRICTIONS:
        cuts = [
            (mus, mean[:, :, x], "Friction coefficient μ", level(results, levels[x]))
            for x in _some(given.intensities, MOST_CUTS)
        ]
    else:
        cuts = [(levels, mean[:, m], axis(results), _mats(results, mu)) for m, mu in enumerate(mus)]
    for x, prd, along, named in cuts:
        if len(x) < 2 or np.isnan(prd).all():
            continue
        svg = figures.contours(
            x, slopes, prd, unit, along=along, up="Slope [deg]", allowed_m=allowed
        )
        yield Block(
            title=f"Sheet: {named}",
            charts=(
                chart(f"sheet-{slug(named)}", svg, f"Contours of the mean PRD, {named}.{thick}"),
            ),
        )


def _spread(results: StudyResults, building: int) -> Table:
    given, unit = results.plan.input, length_unit(results)
    x = _middle(results)
    rows = []
    for m in _some(given.mus, MOST_FRICTIONS):
        for s in _some(given.slopes_deg, MOST_LINES):
            values = [results.statistic(name)[building, s, m, x] for name in STATISTICS]
            rows.append(
                TableRow(
                    cells=(
                        f"{given.mus[m]:g}",
                        f"{given.slopes_deg[s]:g}",
                        *(length(results, float(value)) for value in values),
                        str(int(results.curves.without_value[building, s, m, x])),
                    )
                )
            )
    return Table(
        caption=f"PRD at {level(results, given.intensities[x])}",
        columns=(
            TableColumn(head="μ"),
            TableColumn(head="Slope", unit="deg"),
            *(TableColumn(head=name.capitalize(), unit=unit.symbol) for name in STATISTICS),
            TableColumn(head="Motions without a value", share=1.5),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _middle(results: StudyResults) -> int:
    return len(results.plan.input.intensities) // 2


def _allowed(results: StudyResults, building: int, allowed_m: float) -> ManualSection:
    given = results.plan.input
    shown = _some(given.intensities, MOST_LINES + 2)
    frictions = results.least_frictions(building, "mean", allowed_m)
    slopes = results.largest_slopes(building, "mean", allowed_m)
    heads = [TableColumn(head=f"{given.intensities[x]:g}") for x in shown]
    blocks = []
    if len(given.mus) > 1:
        table = Table(
            caption=f"Least friction coefficient, by slope (rows) and {axis(results)} (columns)",
            columns=(TableColumn(head="Slope", unit="deg"), *heads),
            rows=tuple(
                TableRow(
                    cells=(f"{slope:g}", *(_read(frictions[s, x], given.mus[0], 2) for x in shown))
                )
                for s, slope in enumerate(given.slopes_deg)
            ),
            notes=(
                f"From this coefficient on, no friction of the study has a larger mean PRD. ≤ "
                f"{given.mus[0]:g}: the smallest of the study is enough; none: the largest, "
                f"{given.mus[-1]:g}, is not.",
            ),
            kind="compact",
        )
        blocks.append(Block(tables=(table,)))
    if len(given.slopes_deg) > 1:
        top = given.slopes_deg[-1]
        table = Table(
            caption=f"Largest slope [deg], by friction (rows) and {axis(results)} (columns)",
            columns=(TableColumn(head="μ"), *heads),
            rows=tuple(
                TableRow(cells=(f"{mu:g}", *(_steepest(slopes[m, x], top) for x in shown)))
                for m, mu in enumerate(given.mus)
            ),
            notes=(
                f"Up to this slope, no slope of the study has a larger mean PRD. ≥ {top:g}: the "
                f"largest of the study is allowed; none: the smallest, {given.slopes_deg[0]:g}, is "
                "not.",
            ),
            kind="compact",
        )
        blocks.append(Block(tables=(table,)))
    return ManualSection(
        id=f"allowed-{building}",
        title=f"Least friction and largest slope{on_building(results, building)}",
        blocks=(
            Block(
                texts=(
                    f"For a mean PRD of at most {both(results, allowed_m)}, interpolated between "
                    "the"
                    " cases. study.xlsx has the same for the 84th percentile and the largest PRD.",
                )
            ),
            *blocks,
        ),
    )


def _read(value: float, first: float, decimals: int) -> str:
    if math.isnan(value):
        return "none"
    return f"≤ {first:g}" if value == first else f"{value:.{decimals}f}"


def _steepest(value: float, last: float) -> str:
    if math.isnan(value):
        return "none"
    return f"≥ {last:g}" if value == last else f"{value:.1f}"


def _formula(results: StudyResults, building: int) -> ManualSection:
    fit = results.fits[building]
    title = f"Simplified formula{on_building(results, building)}"
    if not isinstance(fit, Fit):
        return ManualSection(
            id=f"formula-{building}",
            title=title,
            blocks=(Block(texts=(f"None is given: {fit}.",)),),
        )
    measure = results.plan.input.study.intensity
    b = [f"{value:.4g}".replace("-", "−") for value in fit.coefficients]
    low, high = fit.domain["slope_rad"]
    texts = (
        f"ln PRD = {b[0]} + ({b[1]}) ln(1 − r) + ({b[2]}) ln r + ({b[3]}) ln x + ({b[4]}) θ/μ, "
        "with "
        f"the PRD in m, x = {measure.letters} in {measure.unit}, θ in rad, "
        f"r = tan(arctan μ − θ) / ({fit.ppa_g:.4g} x).",
        f"Fitted to the mean PRD of {fit.cases} cases by least squares of the logarithm. The "
        f"standard deviation of ln(exact / fitted) is {fit.sigma_ln:.2f}; exact / fitted is "
        "between "
        f"{fit.least_ratio:.2f} and {fit.greatest_ratio:.2f}.",
        f"It holds only in its domain: slopes of {math.degrees(low):.3g}° to "
        f"{math.degrees(high):.3g}°, μ of {fit.domain['mu'][0]:.3g} to {fit.domain['mu'][1]:.3g}, "
        f"{measure.letters} of {fit.domain['intensity'][0]:.3g} to "
        f"{fit.domain['intensity'][1]:.3g} {measure.unit}, r of {fit.domain['r'][0]:.3g} to "
        f"{fit.domain['r'][1]:.3g}; fitted are PRD of {both(results, fit.domain['prd_m'][0])} to "
        f"{both(results, fit.domain['prd_m'][1])}.",
    )
    return ManualSection(
        id=f"formula-{building}",
        title=title,
        blocks=(Block(texts=texts, tables=(_beside(results, building, fit),)),),
    )


def _beside(results: StudyResults, building: int, fit: Fit) -> Table:
    given, unit = results.plan.input, length_unit(results)
    mean = results.curves.mean_m[building]
    rows = []
    for m in _some(given.mus, MOST_CUTS):
        for s in _some(given.slopes_deg, MOST_CUTS):
            for x in _some(given.intensities, MOST_FRICTIONS):
                case = math.radians(given.slopes_deg[s]), given.mus[m], given.intensities[x]
                exact = float(mean[s, m, x])
                inside = fit.covers(*case)
                fitted = fit.prd_m(*case) if inside else math.nan
                known = inside and exact > 0.0
                rows.append(
                    TableRow(
                        cells=(
                            f"{given.mus[m]:g}",
                            f"{given.slopes_deg[s]:g}",
                            f"{given.intensities[x]:g}",
                            length(results, exact),
                            length(results, fitted) if inside else "outside",
                            f"{exact / fitted:.2f}" if known else "—",
                        )
                    )
                )
    return Table(
        caption="Exact mean PRD and the formula",
        columns=(
            TableColumn(head="μ"),
            TableColumn(head="Slope", unit="deg"),
            TableColumn(head=with_symbols(axis(results))),
            TableColumn(head="Exact", unit=unit.symbol),
            TableColumn(head="Formula", unit=unit.symbol),
            TableColumn(head="Exact / formula"),
        ),
        rows=tuple(rows),
        kind="compact",
    )


def _prescribed(results: StudyResults, building: int, found: Prescribed) -> ManualSection:
    given, unit = results.plan.input, length_unit(results)
    levels = np.array(given.intensities)
    charts = []
    for m in _some(given.mus, MOST_FRICTIONS):
        factor = found.rules.values["analysis_factor"].value
        family = [
            (f"{given.slopes_deg[s]:g}°", factor * results.curves.mean_m[building, s, m])
            for s in _some(given.slopes_deg, MOST_LINES)
        ]
        name = _mats(results, given.mus[m])
        charts.append(
            chart(
                f"prescribed-{slug(name)}",
                figures.curves(
                    levels,
                    family,
                    unit,
                    along=axis(results),
                    limits=((found.rules.name, found.value_m),),
                ),
                f"{factor:g} times the mean PRD, {name}, by slope, and the prescriptive "
                f"displacement of {found.rules.name}, SDC {SDC}, I_e = 1 (thick).",
            )
        )
    rows = tuple(
        TableRow(cells=(_mats(results, mu), f"{slope:g}", *_safety(found.ratio[s, m], levels)))
        for m, mu in enumerate(given.mus)
        for s, slope in enumerate(given.slopes_deg)
    )
    unsafe = int((~(found.ratio <= 1.0)).sum())
    texts = (
        f"The prescriptive displacement exceeds {found.rules.values['analysis_factor'].value:g} "
        f"times the mean PRD in {found.ratio.size - unsafe:,} of {found.ratio.size:,} cases and is "
        f"too small in {unsafe:,}. A margin is prescriptive / computed: below 1 the prescriptive "
        "displacement is too small. It does not depend on slope or friction; the computed one "
        "does.",
    )
    table = Table(
        caption=f"Where the prescriptive displacement of {found.rules.name} is enough",
        columns=(
            TableColumn(head="Friction", align="left", share=1.6),
            TableColumn(head="Slope", unit="deg"),
            TableColumn(head="Safe up to", unit=with_symbols(axis(results)), share=1.4),
            TableColumn(head="Least margin", share=1.1),
            TableColumn(head="at", unit=with_symbols(axis(results)), share=1.2),
        ),
        rows=rows,
        kind="compact",
    )
    return ManualSection(
        id=f"prescribed-{building}",
        title=f"Beside the prescriptive displacement{on_building(results, building)}",
        blocks=(Block(texts=texts, charts=charts, tables=(table,)),),
    )


def _safety(ratio: Floats, levels: Floats) -> tuple[str, str, str]:
    """Return the intensity up to which the prescriptive value is enough, and the least margin."""
    unsafe = np.flatnonzero(~(ratio <= 1.0))
    if not unsafe.size:
        reach = f"{levels[-1]:g}, all"
    else:
        reach = "none" if unsafe[0] == 0 else f"{levels[unsafe[0] - 1]:g}"
    worst = int(np.argmax(np.where(np.isnan(ratio), np.inf, ratio)))
    if np.isnan(ratio[worst]):
        return reach, "none", f"{levels[worst]:g}"
    margin = math.inf if ratio[worst] == 0.0 else 1.0 / float(ratio[worst])
    return reach, "∞" if math.isinf(margin) else f"{margin:.2f}", f"{levels[worst]:g}"
