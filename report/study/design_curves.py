"""The design curves: displacements against intensity and slope, contour sheets, and a table.

The least friction and the largest slope for the allowed displacement.

The prescriptive displacement beside the value from analysis: where it is enough and permitted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from report.document.columns import ColumnHead, centered, text, words
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.pages.symbols import with_symbols
from report.study import study_charts
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
from report.study.study_results import (
    FRICTION_DECIMALS,
    MEAN,
    SLOPE_DECIMALS,
    STATISTICS,
    StudyResults,
)
from report.study.study_tables import length_unit
from report.study.wording import answer, level, on_building, shown
from report.text.letter_case import capitalized
from report.text.units import number, round_down
from solver.model import Floats
from solver.rules.provisions import prescriptive_checks, required_mu


def curves(results: StudyResults, building: int) -> Section:
    """Return the section on a building."""
    study_input = results.plan.input
    drawn_mus = some(study_input.mus, MOST_FRICTIONS)
    # A single slope is no axis.
    sloped = drawn_mus if len(study_input.slopes_deg) > 1 else []
    sheets, slopes = list(_sheets(results, building)), some(study_input.slopes_deg, MOST_LINES)
    values, mean = _drawn(results, building)
    return section(
        "study/curves",
        f"Design curves{on_building(results, building, ', building ')}",
        id=f"curves-{building}",
        named={m: friction_name(results, study_input.mus[m]) for m in drawn_mus},
        sheets=[(name, is_thick) for name, _, is_thick in sheets],
        LOW_G=LOW_G,
        place=results.plan.motions.buildings[building],
        middle=study_input.intensities[len(study_input.intensities) // 2],
        displacements=_displacements(results, building),
        charts={
            **{
                f"intensity-{m}": by_intensity(
                    results, values, m, members=[mean[s, m] for s in slopes]
                )
                for m in drawn_mus
            },
            **{f"slope-{m}": _against_slope(results, building, m) for m in sloped},
            **{f"sheet-{name}": svg for name, svg, _ in sheets},
        },
    )


def _drawn(results: StudyResults, building: int) -> tuple[Floats, Floats]:
    """Return the leading displacement and the mean beside it; NaN where the mean leads."""
    values, mean = results.displacements[results.leading][building], results.curves.mean_m[building]
    return values, mean if results.plan.design_rule.has_value else np.full_like(mean, np.nan)


def _against_slope(results: StudyResults, building: int, m: int) -> str:
    study_input = results.plan.input
    drawn_levels = some(study_input.intensities, MOST_LINES)
    values, mean = _drawn(results, building)
    return study_charts.curves(
        np.array(study_input.slopes_deg),
        [(level(results, study_input.intensities[x]), values[:, m, x]) for x in drawn_levels],
        length_unit(results),
        along="Slope [deg]",
        low=study_input.slopes_deg[-1],
        members=[mean[:, m, x] for x in drawn_levels],
    )


def _sheets(results: StudyResults, building: int) -> Iterator[tuple[str, str, bool]]:
    """Yield contour sheets: name, drawing, and whether it has the allowed displacement."""
    study_input = results.plan.input
    values, mean = _drawn(results, building)
    allowed_m = study_input.study.allowed_m or math.nan
    for x, cut, along, name in _cuts(results):
        if len(x) < 2 or len(study_input.slopes_deg) < 2 or np.isnan(values[cut]).all():
            # One row or column has no contours.
            continue
        svg = study_charts.contours(
            np.array(x),
            np.array(study_input.slopes_deg),
            values[cut],
            mean[cut],
            length_unit(results),
            along=along,
            allowed_m=allowed_m,
        )
        yield name, svg, bool(np.nanmin(values[cut]) < allowed_m < np.nanmax(values[cut]))


def _cuts(results: StudyResults) -> Iterator[tuple[tuple[float, ...], Any, str, str]]:
    """Yield the axis of each sheet, its cases, the name of the axis, and that of the sheet."""
    study_input = results.plan.input
    # Of many coefficients friction is an axis; of a few each has its own sheet over intensity.
    if len(study_input.mus) > MOST_FRICTIONS:
        for x in some(study_input.intensities, MOST_CUTS):
            name = level(results, study_input.intensities[x])
            yield study_input.mus, np.s_[:, :, x], "Friction coefficient μ", name
    else:
        for m, mu in enumerate(study_input.mus):
            yield study_input.intensities, np.s_[:, m], axis(results), friction_name(results, mu)


def _displacements(results: StudyResults, building: int) -> Table:
    """Return the displacements at the middle intensity."""
    study_input, lost = results.plan.input, results.curves.without_value
    unit, x = length_unit(results).symbol, len(study_input.intensities) // 2
    cells = dict.fromkeys(STATISTICS, length) | {results.plan.design_rule.name: design_length}
    columns = (
        (text("μ"), lambda case: f"{study_input.mus[case[2]]:g}"),
        (text("Slope", "deg"), lambda case: f"{study_input.slopes_deg[case[1]]:g}"),
        *(
            (
                text(capitalized(name), unit, 1.3),
                lambda case, name=name, lengths=lengths: cells[name](results, float(lengths[case])),
            )
            for name, lengths in results.displacements.items()
        ),
        (text("Motions without a value", share=1.5), lambda case: int(lost[case])),
    )
    cases = []
    for m in some(study_input.mus, MOST_FRICTIONS):
        cases += [(building, s, m, x) for s in some(study_input.slopes_deg, MOST_LINES)]
    return listed(cases, columns, kind="compact")


def allowed(results: StudyResults, building: int, allowed_m: float) -> Section:
    """Return the section on what an allowed displacement asks for."""
    study_input = results.plan.input
    frictions = [shown(mu, FRICTION_DECIMALS) for mu in (study_input.mus[0], study_input.mus[-1])]
    slopes = [
        shown(s, SLOPE_DECIMALS) for s in (study_input.slopes_deg[0], study_input.slopes_deg[-1])
    ]
    needed = partial(answer, end=study_input.mus[0], mark="≤", decimals=FRICTION_DECIMALS)
    largest = partial(answer, end=study_input.slopes_deg[-1], mark="≥", decimals=SLOPE_DECIMALS)
    answers = []
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
        f"Least friction and largest slope{on_building(results, building, ', building ')}",
        id=f"allowed-{building}",
        floor_alone=list(_floor_alone(results, allowed_m)),
        frictions=frictions,
        slopes=slopes,
        answers=answers,
    )


def _floor_alone(results: StudyResults, allowed_m: float) -> Iterator[float]:
    """Yield from which intensity on no friction and no slope is enough, because of the floor."""
    rule = results.plan.design_rule
    # The floor grows with S_DS and knows neither friction nor slope.
    beyond = np.flatnonzero(rule.floor_m > allowed_m)
    if rule.has_value and beyond.size:
        yield results.plan.input.intensities[beyond[0]]


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


@dataclass(frozen=True, slots=True, kw_only=True)
class Prescribed:
    """Value from analysis / prescriptive displacement, by slope, friction and intensity."""

    ratio: Floats  # shape (slopes, frictions, intensities); NaN for no value
    permitted: NDArray[np.bool_]  # by the rule set, shape (slopes, frictions)

    @property
    def unsafe(self) -> NDArray[np.bool_]:
        """Where the prescriptive displacement is too small; no value counts as such."""
        # Not > 1: NaN, a run without a value, is to count as too small.
        return np.asarray(~(self.ratio <= 1.0))

    @property
    def unsafe_not_permitted(self) -> NDArray[np.bool_]:
        """Where it is too small and the rule set does not permit it."""
        return self.unsafe & ~self.permitted[..., None]


def compare(results: StudyResults, building: int) -> tuple[Prescribed, ...]:
    """Return the comparison; empty without a value from analysis or S_DS."""
    study_input, rule = results.plan.input, results.plan.design_rule
    if not (rule.has_value and rule.has_floor):
        return ()
    permitted = [
        [
            all(
                check.ok
                for check in prescriptive_checks(rule.rules, slope_rad=math.radians(slope), mu=mu)
            )
            for mu in study_input.mus
        ]
        for slope in study_input.slopes_deg
    ]
    ratio = results.analysis_m[building] / rule.prescriptive_m
    return (Prescribed(ratio=ratio, permitted=np.array(permitted)),)


def prescribed(results: StudyResults, building: int, prescribed: Prescribed) -> Section:
    """Return the section on the prescriptive displacement."""
    study_input, rules = results.plan.input, results.plan.design_rule.rules
    limits = ((rules.name, results.plan.design_rule.prescriptive_m),)
    names = {
        m: friction_name(results, study_input.mus[m]) for m in some(study_input.mus, MOST_FRICTIONS)
    }
    slopes, mus = _extent(results, prescribed.unsafe_not_permitted)
    return section(
        "study/prescribed",
        "Beside the prescriptive displacement" + on_building(results, building, ", building "),
        id=f"prescribed-{building}",
        found=prescribed,
        slopes=slopes,
        mus=mus,
        steepest_mu=required_mu(rules, math.radians(rules["prescriptive_max_slope_deg"])),
        names=names,
        margins=_prescribed_table(results, prescribed),
        charts={
            f"prescribed-{m}": by_intensity(results, results.analysis_m[building], m, limits=limits)
            for m in names
        },
    )


def _extent(results: StudyResults, cases: NDArray[np.bool_]) -> tuple[list[float], list[float]]:
    """Return the slopes and the friction coefficients of cases."""
    study_input = results.plan.input
    return (
        [study_input.slopes_deg[s] for s in np.flatnonzero(cases.any(axis=(1, 2)))],
        [study_input.mus[m] for m in np.flatnonzero(cases.any(axis=(0, 2)))],
    )


def _prescribed_table(results: StudyResults, prescribed: Prescribed) -> Table:
    study_input, measure = results.plan.input, with_symbols(axis(results))

    def margins(case: tuple[int, int]) -> tuple[str, str, str]:
        return _margins(prescribed.ratio[case], study_input.intensities)

    columns = (
        (words("Friction", 1.6), lambda case: friction_name(results, study_input.mus[case[1]])),
        (text("Slope", "deg"), lambda case: f"{study_input.slopes_deg[case[0]]:g}"),
        (centered("Permitted"), lambda case: "yes" if prescribed.permitted[case] else "no"),
        (text("Enough up to", measure, 1.4), lambda case: margins(case)[0]),
        (text("Least margin", share=1.1), lambda case: margins(case)[1]),
        (text("at", measure, 1.2), lambda case: margins(case)[2]),
    )
    cases = []
    for m in range(len(study_input.mus)):
        cases += [(s, m) for s in range(len(study_input.slopes_deg))]
    return listed(cases, columns, kind="compact")


def _margins(ratio: Floats, levels: Sequence[float]) -> tuple[str, str, str]:
    """Return the intensity up to which the prescriptive value is enough, and the least margin."""
    unsafe = np.flatnonzero(~(ratio <= 1.0))
    if not unsafe.size:
        reach = f"{levels[-1]:.12g}, all"
    else:
        reach = "none" if unsafe[0] == 0 else f"{levels[unsafe[0] - 1]:.12g}"
    # No value is the worst: it may be of any size.
    worst = int(np.argmax(np.where(np.isnan(ratio), np.inf, ratio)))
    if np.isnan(ratio[worst]):
        return reach, "none", f"{levels[worst]:g}"
    margin = math.inf if ratio[worst] == 0.0 else 1.0 / float(ratio[worst])
    return reach, number(round_down(margin, 2), 2), f"{levels[worst]:g}"
