"""The section of a study on its design curves: displacements against intensity and slope."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from markupsafe import Markup

from report.document.columns import text
from report.document.sections import Section, section
from report.document.tables import Table, listed
from report.pages.marks import UNVERIFIED
from report.pages.symbols import with_symbols
from report.project.model.choices import RecordedAt
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
from report.study.sentences import design_basis
from report.study.study_results import STATISTICS, StudyResults
from report.study.study_tables import length_unit
from report.study.wording import both, level, on_building
from report.text.letter_case import capitalized
from report.text.units import NO_BREAK
from solver.model import Floats


def curves(results: StudyResults, building: int) -> Section:
    """Return the section on a building."""
    study_input, sheets = results.plan.input, list(_sheets(results, building))
    values, mean = _drawn(results, building)
    slopes = some(study_input.slopes_deg, MOST_LINES)
    name, letters = capitalized(results.leading), study_input.study.intensity.letters
    is_low = study_input.study.intensity.unit == "g" and study_input.intensities[0] < LOW_G
    left = f" Left, up to {LOW_G}{NO_BREAK}g: on a logarithmic axis." if is_low else ""
    charts = {f"sheet-{sheet}": svg for sheet, svg, _ in sheets}
    captions = []
    for m in some(study_input.mus, MOST_FRICTIONS):
        friction = friction_name(results, study_input.mus[m])
        members = [mean[s, m] for s in slopes]
        charts[f"intensity-{m}"] = by_intensity(results, values, m, members=members)
        by_slope = f"{name} against {letters}, {friction}, by slope.{left}"
        captions.append((f"intensity-{m}", by_slope))
        # A single slope is no axis.
        if len(study_input.slopes_deg) > 1:
            charts[f"slope-{m}"] = _against_slope(results, building, m)
            by_letters = f"{friction}, by {letters}. Left: on a logarithmic axis."
            captions.append((f"slope-{m}", f"{name} against slope, {by_letters}"))
    middle = study_input.intensities[len(study_input.intensities) // 2]
    return section(
        "study/curves",
        f"Design curves{on_building(results, building, ', building ')}",
        id=f"curves-{building}",
        name=name,
        thin=_thin(results),
        captions=captions,
        sheets=[
            (f"sheet-{sheet}", f"Sheet: {sheet}", _sheet_caption(results, sheet, is_thick))
            for sheet, _, is_thick in sheets
        ],
        about=_about(results, building),
        displacements=_displacements(results, building),
        displacements_caption=with_symbols(f"Displacements at {level(results, middle)}"),
        charts=charts,
    )


def _thin(results: StudyResults) -> str:
    return "Thin and gray: mean PRD." if results.plan.design_rule.has_value else ""


def _sheet_caption(results: StudyResults, sheet: str, is_thick: bool) -> str:
    """Return of what a sheet has the contours, and which line is the allowed displacement."""
    rule, allowed_m = results.plan.design_rule, results.plan.input.study.allowed_m or math.nan
    if rule.has_value:
        contours = f"Contours of the {rule.name}, {sheet}, per {design_basis(rule)}. {UNVERIFIED}."
    else:
        contours = f"Contours of the mean PRD, {sheet}: too few motions for a {rule.name}."
    thick = f"Thick: {both(results, allowed_m)}." if is_thick else ""
    return " ".join(filter(None, (contours, _thin(results), thick)))


def _about(results: StudyResults, building: int) -> Sequence[tuple[str, str]]:
    """Return from what the sheets are computed."""
    study_input, motions = results.plan.input, results.plan.motions
    study, ids = study_input.study, ", ".join(motion.id for motion in motions.motions[0])
    by = f", by {study.prepared_by}" if study.prepared_by else ""
    through = f"taken from the ground through building {motions.buildings[building]}"
    given = "given at the roof" if study.recorded_at is RecordedAt.ROOF else through
    count, measure = results.plan.design_rule.n_motions, with_symbols(axis(results))
    mats = []
    for mat in study_input.mats:
        center, tested = study_input.friction(mat.id).center, f" (tested {mat.tested})"
        mats.append(f"{mat.id}: μ{NO_BREAK}={NO_BREAK}{center:g}{tested if mat.tested else ''}")
    mus = ", ".join(map(str, study_input.mus))
    return (
        ("Study, date", f"{study.title}, {study.date.isoformat()}{by}"),
        ("Motions", Markup("{}: {}; intensity {}").format(count, ids, measure)),
        ("z/h", f"not entered: the motions are {given}"),
        ("Friction", "; ".join(mats) or f"μ = {mus}, without tests"),
    )


def _drawn(results: StudyResults, building: int) -> tuple[Floats, Floats]:
    """Return the leading displacement and the mean next to it; NaN if the mean leads."""
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
