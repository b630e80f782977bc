"""The prescriptive displacement beside the value from analysis, and where it is permitted."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.study.blocks import Block, Chart, ManualSection, slug
from report.pages.symbols import with_symbols
from report.study import figures
from report.study.page_parts import (
    MOST_FRICTIONS,
    MOST_LINES,
    axis,
    chart,
    friction_name,
    on_building,
    some,
)
from report.study.prescribed import Prescribed
from report.study.results import StudyResults
from report.study.tables import length_unit
from report.study.words import analysis_words, prescriptive, provision
from report.words.units import number, round_down
from solver.model import Floats
from solver.rules.provisions import required_mu


def prescribed(results: StudyResults, building: int, found: Prescribed) -> ManualSection:
    """Return the section on the prescriptive displacement."""
    charts = [_chart(results, building, m) for m in some(results.plan.input.mus, MOST_FRICTIONS)]
    return ManualSection(
        id=f"prescribed-{building}",
        title=f"Beside the prescriptive displacement{on_building(results, building)}",
        blocks=(
            Block(texts=_texts(results, found), charts=charts, tables=(_table(results, found),)),
        ),
    )


def _texts(results: StudyResults, found: Prescribed) -> tuple[str, str]:
    rules = results.plan.design_rule.rules
    count, unsafe = found.ratio.size, int(found.unsafe.sum())
    return (
        f"The prescriptive displacement {prescriptive(results)} is compared with the value from "
        f"analysis, {analysis_words(results)}, without the floor. It is enough in "
        f"{count - unsafe:,} of {count:,} cases and too small in {unsafe:,}. A margin is "
        "prescriptive / computed: below 1 the prescriptive displacement is too small. It does not "
        "depend on slope or friction; the computed one does.",
        f"{rules.name} permits the prescriptive displacement on slopes up to "
        f"{provision(rules, 'prescriptive_max_slope_deg', '°')} with μ of "
        f"{provision(rules, 'prescriptive_min_mu')} or more{_rising(results)}."
        + (f" {_of_unsafe(results, found)}" if unsafe else ""),
    )


def _rising(results: StudyResults) -> str:
    rules = results.plan.design_rule.rules
    steepest = required_mu(rules, math.radians(rules["prescriptive_max_slope_deg"]))
    rises = steepest > rules["prescriptive_min_mu"]
    return f", {steepest:.3f} at that slope" if rises else ""


def _of_unsafe(results: StudyResults, found: Prescribed) -> str:
    """Return in how many of the cases in which it is too small it is permitted."""
    unsafe, outside = int(found.unsafe.sum()), int(found.unsafe_not_permitted.sum())
    text = (
        f"Of the {unsafe:,} cases in which it is too small, it is permitted in "
        f"{_count(unsafe - outside, unsafe)} and not permitted in {_count(outside, unsafe)}"
    )
    if not outside:
        return f"{text}."
    return f"{text}: {_extent(results, found.unsafe_not_permitted)}."


def _count(part: int, whole: int) -> str:
    return "none" if not part else f"all {whole:,}" if part == whole else f"{part:,}"


def _extent(results: StudyResults, cases: NDArray[np.bool_]) -> str:
    """Return the slopes and the friction coefficients of cases."""
    given = results.plan.input
    slopes = [given.slopes_deg[s] for s in np.flatnonzero(cases.any(axis=(1, 2)))]
    mus = [given.mus[m] for m in np.flatnonzero(cases.any(axis=(0, 2)))]
    return f"slopes of {_span(slopes, '°')}, μ of {_span(mus)}"


def _span(values: list[float], unit: str = "") -> str:
    return f"{values[0]:g}{unit}" + (f" to {values[-1]:g}{unit}" if len(values) > 1 else "")


def _chart(results: StudyResults, building: int, m: int) -> Chart:
    given, rule = results.plan.input, results.plan.design_rule
    name = friction_name(results, given.mus[m])
    svg = figures.curves(
        np.array(given.intensities),
        [
            (f"{given.slopes_deg[s]:g}°", results.analysis_m[building, s, m])
            for s in some(given.slopes_deg, MOST_LINES)
        ],
        length_unit(results),
        along=axis(results),
        limits=((rule.rules.name, rule.prescriptive_m),),
    )
    return chart(
        f"prescribed-{slug(name)}",
        svg,
        f"Value from analysis, {name}, by slope, and the prescriptive displacement of "
        f"{rule.rules.name} {prescriptive(results)} (thick).",
    )


def _table(results: StudyResults, found: Prescribed) -> Table:
    given, levels = results.plan.input, np.array(results.plan.input.intensities)
    return Table(
        caption="Where the prescriptive displacement of "
        f"{results.plan.design_rule.rules.name} is enough",
        columns=(
            TableColumn(head="Friction", align="left", share=1.6),
            TableColumn(head="Slope", unit="deg"),
            TableColumn(head="Permitted", align="center"),
            TableColumn(head="Enough up to", unit=with_symbols(axis(results)), share=1.4),
            TableColumn(head="Least margin", share=1.1),
            TableColumn(head="at", unit=with_symbols(axis(results)), share=1.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    friction_name(results, mu),
                    f"{slope:g}",
                    "yes" if found.permitted[s, m] else "no",
                    *_margins(found.ratio[s, m], levels),
                )
            )
            for m, mu in enumerate(given.mus)
            for s, slope in enumerate(given.slopes_deg)
        ),
        kind="compact",
    )


def _margins(ratio: Floats, levels: Floats) -> tuple[str, str, str]:
    """Return the intensity up to which the prescriptive value is enough, and the least margin."""
    unsafe = np.flatnonzero(~(ratio <= 1.0))
    if not unsafe.size:
        reach = f"{levels[-1]:.12g}, all"
    else:
        reach = "none" if unsafe[0] == 0 else f"{levels[unsafe[0] - 1]:.12g}"
    worst = int(np.argmax(np.where(np.isnan(ratio), np.inf, ratio)))
    if np.isnan(ratio[worst]):
        return reach, "none", f"{levels[worst]:g}"
    margin = math.inf if ratio[worst] == 0.0 else 1.0 / float(ratio[worst])
    least = "∞" if math.isinf(margin) else number(round_down(margin, 2), 2)
    return reach, least, f"{levels[worst]:g}"
