"""The results of a study as tables: curves.csv, and study.xlsx with summaries.

Computes nothing but units. Read `curves_csv`, then `study_xlsx`.
"""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np

from report.pages.marks import UNVERIFIED
from report.project.read.years_file import SUPPORTING
from report.results.sheet_pages import text_workbook
from report.study.dispersions import NAMES, dispersions, exported, is_exportable, is_refused
from report.study.sentences import analysis, design, taken_over
from report.study.study_plan import ArrayPlan
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.text.csv_text import csv_text
from report.text.letter_case import capitalized
from report.text.unit_format import UnitFormat
from report.text.units import Unit, spaced
from solver.model import Floats
from solver.studies.curves import Fit

Row = Sequence[Any]


def curves_csv(results: StudyResults) -> bytes:
    """Return the curves, one row for each case of the grid; an empty field for no value."""
    plan, lost = results.plan, results.curves.without_value
    rows: list[Row] = [
        ("building", "slope_deg", "mu", f"intensity ({plan.input.study.intensity.value})",
         f"{plan.design_rule.name.replace(' ', '_')}_m", "mean_prd_m", "p84_prd_m",
         "largest_prd_m", "motions_without_value")
    ]  # fmt: skip
    for case, index in _cases(results):
        values = [float(lengths[index]) for lengths in results.displacements.values()]
        # All digits: somebody computes with them.
        cells = ["" if math.isnan(v) else repr(v) for v in values]
        rows.append((*case, *cells, int(lost[index])))
    return csv_text(rows).encode()


def _cases(results: StudyResults) -> Iterator[tuple[Row, tuple[int, ...]]]:
    """Yield building, slope, friction and intensity of each case, and its place in the curves."""
    plan, study_input = results.plan, results.plan.input
    axes = product(
        plan.motions.buildings, study_input.slopes_deg, study_input.mus, study_input.intensities
    )
    yield from zip(axes, np.ndindex(plan.shape), strict=True)


def length_unit(results: StudyResults) -> Unit:
    """Return the unit of displacements that is printed first."""
    return UnitFormat(results.plan.input.study.units_first.is_us).units()[0]


def who(results: StudyResults, plan: ArrayPlan) -> tuple[str, str]:
    """Return building and ID of an array."""
    return results.plan.motions.buildings[plan.building], plan.array.id


def study_xlsx(
    results: StudyResults, added: Iterable[tuple[str, Row, Iterable[Row]]] = ()
) -> bytes:
    """Return the summaries as a workbook; `added` are title, heading and rows of further sheets."""
    # Never a row for each run: a sheet of Excel has a million.
    buffer = io.BytesIO()
    unit, study_input = length_unit(results), results.plan.input
    book = text_workbook(buffer, study_input.study.date, study_input.study.title)
    head_format = book.add_format({"bold": True, "text_wrap": True, "bottom": 1})
    measure = study_input.study.intensity.value
    lengths = [f"{capitalized(name)} [{unit.symbol}]" for name in results.displacements]
    for title, head, rows in (
        ("Study", ("What", "Value"), _about(results)),
        (
            "Curves",
            ("Building", "Slope [deg]", "Friction", measure, *lengths, "Motions without a value"),
            _curves(results, unit),
        ),
        (
            "Least friction",
            ("Building", "Displacement", "Slope [deg]", measure, "Least friction"),
            _answers(results, study_input.slopes_deg, results.minimum_frictions),
        ),
        (
            "Largest slope",
            ("Building", "Displacement", "Friction", measure, "Largest slope [deg]"),
            _answers(results, study_input.mus, results.largest_slopes),
        ),
        ("Fragility", _FRAGILITY, _fragilities(results, unit)),
        ("Probabilities", _EXCEEDANCES, _exceedances(results, unit)),
        ("Formula", ("Building", "What", "Value"), _formula(results)),
        *added,
    ):
        sheet = book.add_worksheet(title)
        # &R: at the right of the header.
        sheet.set_header(f"&R{SUPPORTING}" if results.years else "")
        sheet.write_row(0, 0, head, head_format)
        for number, row in enumerate(rows, start=1):
            for column, value in enumerate(row):
                # A cell of Excel holds neither NaN nor infinity.
                is_none = isinstance(value, float) and not math.isfinite(value)
                text = spaced(value) if isinstance(value, str) else value
                sheet.write(number, column, "none" if is_none else text)
        # Below the table as well as in the header, which is seen in print alone.
        if results.years:
            sheet.write(sheet.dim_rowmax + 2, 0, SUPPORTING)
        sheet.set_column(0, len(head) - 1, 16)
        sheet.freeze_panes(1, 0)
    book.close()
    return buffer.getvalue()


def _about(results: StudyResults) -> Iterator[Row]:
    manifest = results.manifest
    yield "Title", results.plan.input.study.title
    yield "Runs", manifest["rows"]
    yield "Cases", manifest["cases"]["count"]
    for line in taken_over(results):
        yield "Runs taken over", line
    yield "Runs for the capacities", results.capacity_runs
    for title, count in manifest["models"].items():
        yield f"Runs with the model: {title}", count
    yield "Seed", manifest["about"]["seed"]
    yield "Identity of the manifest", manifest["identity"]
    yield from manifest["program"].items()
    yield "Agreement of a repetition", manifest["agreement"]
    yield "Design displacement", design(results.plan.design_rule)
    yield "Marks", UNVERIFIED


def _curves(results: StudyResults, unit: Unit) -> Iterator[Row]:
    lost = results.curves.without_value
    for case, index in _cases(results):
        lengths = (float(values[index]) / unit.si for values in results.displacements.values())
        yield *case, *lengths, int(lost[index])


def _answers(
    results: StudyResults, along: Sequence[float], answers: Callable[[int, str, float], Floats]
) -> Iterator[Row]:
    """Yield the answers for the allowed displacement, along an axis of the grid."""
    allowed_m, levels = results.plan.input.study.allowed_m, results.plan.input.intensities
    names = results.displacements if allowed_m else ()
    for (b, building), name in product(enumerate(results.plan.motions.buildings), names):
        values = answers(b, name, float(allowed_m or 0.0))
        for (value, level), answer in zip(product(along, levels), values.ravel(), strict=True):
            yield building, name, value, level, float(answer)


_FRAGILITY = (
    "Building", "Array", "Limit state", "Exceeded when", "Limit on PRD of a motion", "Unit",
    "Median theta", "theta, 5%", "theta, 95%", "Dispersion beta", "beta, 5%", "beta, 95%",
    "Lilliefors p of fit", "Censored capacities", "Motions below the limit again", "Censored runs",
    *(f"Beta, {name}" for name in NAMES), "Beta exported",
)  # fmt: skip


def _fragilities(results: StudyResults, unit: Unit) -> Iterator[Row]:
    for result in results.arrays:
        for state in result.states:
            f = state.fragility
            yield (
                *who(results, result.plan),
                state.name,
                state.words,
                state.limit_m / unit.si,
                unit.symbol,
                f.fitted.theta,
                *f.theta_range,
                f.fitted.beta,
                *f.beta_range,
                f.p_value,
                int(f.capacities.is_censored.sum()),
                int(f.capacities.falls.sum()),
                f.censored,
                *_dispersions(results, result, state),
            )


def _dispersions(results: StudyResults, result: ArrayStudyResult, state: LimitState) -> Row:
    """Return the dispersions of a limit state by name, and that exported; NaN for none."""
    if not (is_exportable(results) and state.fragility.fitted.is_known):
        return [math.nan] * (len(NAMES) + 1)
    total = math.nan if is_refused(results) else exported(results, result, state).beta
    # 0 is a part that is not included; NaN prints as none.
    return [*(part.beta or math.nan for part in dispersions(results, result, state)), total]


_EXCEEDANCES = (
    "Building", "Array", "Clearance", "Unit", "Probability of exceedance", "5%", "95%", "Runs",
    "Runs without a value",
)  # fmt: skip


def _exceedances(results: StudyResults, unit: Unit) -> Iterator[Row]:
    for result in results.arrays:
        for exceedance in result.exceedances:
            yield (
                *who(results, result.plan),
                result.plan.array.clearance_m / unit.si,
                unit.symbol,
                exceedance.value,
                exceedance.low,
                exceedance.high,
                exceedance.runs,
                exceedance.without_value,
            )


def _formula(results: StudyResults) -> Iterator[Row]:
    for building, fit in zip(results.plan.motions.buildings, results.fits, strict=True):
        if not isinstance(fit, Fit):
            yield building, "none", fit
            continue
        yield (
            building,
            "fitted, Δ_RHA",
            f"analysis displacement: {analysis(results.plan.design_rule)}, in m",
        )
        for number, value in enumerate(fit.coefficients):
            yield building, f"b{number}", value
        yield building, "p [g]", fit.ppa_g
        yield building, "standard deviation of ln(computed / formula)", fit.sigma_ln
        yield building, "least computed / formula", fit.minimum_ratio
        yield building, "greatest computed / formula", fit.maximum_ratio
        yield building, "cases", fit.cases
        for name, (low, high) in fit.domain.items():
            yield building, f"{name}, from", low
            yield building, f"{name}, to", high
