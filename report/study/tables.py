"""The results of a study as tables: curves.csv, and study.xlsx with summaries.

Computes nothing but units. Read `curves_csv`, then `study_xlsx`.
"""

from __future__ import annotations

import csv
import datetime as dt
import io
import math
from collections.abc import Iterator, Sequence
from typing import Any

import xlsxwriter

from report.entities.marks import UNVERIFIED
from report.study.dispersion import NAMES, dispersions, exported, is_exportable, refusal
from report.study.results import ArrayResult, LimitState, StudyResults
from report.study.words import analysis_words, design_words
from report.words.units import Quantity, Unit
from solver.studies.fit import Fit

Row = Sequence[Any]


def curves_csv(results: StudyResults) -> bytes:
    """Return the curves, one row for each case of the grid; an empty field for no value."""
    given, plan = results.plan.input, results.plan
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    measure = given.study.intensity
    writer.writerow(
        ["building", "slope_deg", "mu", f"intensity ({measure.value})",
         f"{plan.design_rule.name.replace(' ', '_')}_m", "mean_prd_m", "p84_prd_m",
         "largest_prd_m", "motions_without_value"]
    )  # fmt: skip
    lost = results.curves.without_value
    for b, building in enumerate(plan.motions.buildings):
        for s, slope in enumerate(given.slopes_deg):
            for m, mu in enumerate(given.mus):
                for x, level in enumerate(given.intensities):
                    at = b, s, m, x
                    values = [float(lengths[at]) for lengths in results.displacements.values()]
                    shown = ["" if math.isnan(v) else repr(v) for v in values]
                    writer.writerow([building, slope, mu, level, *shown, int(lost[at])])
    return text.getvalue().encode()


def length_unit(results: StudyResults) -> Unit:
    """Return the unit of displacements that is printed first."""
    quantity = Quantity.DISPLACEMENT
    return quantity.us if results.plan.input.study.units_first == "US" else quantity.si


def study_xlsx(results: StudyResults) -> bytes:
    """Return the summaries as a workbook: never a row for each run."""
    buffer = io.BytesIO()
    book = xlsxwriter.Workbook(buffer, {"in_memory": True, "nan_inf_to_errors": False})
    book.set_properties({"title": results.plan.input.study.title, "created": _midnight(results)})
    formats = {"head": book.add_format({"bold": True, "text_wrap": True, "bottom": 1})}
    unit = length_unit(results)
    for title, head, rows in (
        ("Study", ("What", "Value"), _about(results)),
        ("Curves", _curve_head(results, unit), _curves(results, unit)),
        ("Least friction", _least_head(results), _least(results)),
        ("Largest slope", _slope_head(results), _slopes(results)),
        ("Fragility", _FRAGILITY, _fragilities(results, unit)),
        ("Chances", _CHANCES, _chances(results, unit)),
        ("Formula", ("Building", "What", "Value"), _formula(results)),
    ):
        sheet = book.add_worksheet(title)
        sheet.write_row(0, 0, head, formats["head"])
        for number, row in enumerate(rows, start=1):
            for column, value in enumerate(row):
                is_none = isinstance(value, float) and not math.isfinite(value)
                sheet.write(number, column, "none" if is_none else value)
        sheet.set_column(0, len(head) - 1, 16)
        sheet.freeze_panes(1, 0)
    book.close()
    return buffer.getvalue()


def _midnight(results: StudyResults) -> Any:
    return dt.datetime.combine(results.plan.input.study.date, dt.time())


def _about(results: StudyResults) -> Iterator[Row]:
    manifest = results.manifest
    yield "Title", results.plan.input.study.title
    yield "Runs", manifest["rows"]
    yield "Cases", manifest["cases"]["count"]
    yield "Runs for the capacities", results.capacity_runs
    for title, count in manifest["models"].items():
        yield f"Runs with the model: {title}", count
    yield "Seed", manifest["about"]["seed"]
    yield "Identity of the manifest", manifest["identity"]
    yield from manifest["program"].items()
    yield "Agreement of a repetition", manifest["agreement"]
    yield "Design displacement", design_words(results)
    yield "Marks", UNVERIFIED


def _curve_head(results: StudyResults, unit: Unit) -> Row:
    measure = results.plan.input.study.intensity.value
    lengths = [f"{name[:1].upper()}{name[1:]} [{unit.symbol}]" for name in results.displacements]
    return ("Building", "Slope [deg]", "Friction", measure, *lengths, "Motions without a value")


def _curves(results: StudyResults, unit: Unit) -> Iterator[Row]:
    given, lost = results.plan.input, results.curves.without_value
    for b, building in enumerate(results.plan.motions.buildings):
        for s, slope in enumerate(given.slopes_deg):
            for m, mu in enumerate(given.mus):
                for x, level in enumerate(given.intensities):
                    at = b, s, m, x
                    lengths = (float(v[at]) / unit.si for v in results.displacements.values())
                    yield building, slope, mu, level, *lengths, int(lost[at])


def _least_head(results: StudyResults) -> Row:
    measure = results.plan.input.study.intensity.value
    return (
        "Building",
        "Displacement",
        "Slope [deg]",
        measure,
        "Least friction",
    )


def _least(results: StudyResults) -> Iterator[Row]:
    given = results.plan.input
    for b, building in enumerate(results.plan.motions.buildings):
        for name in results.displacements if given.study.allowed_m else ():
            values = results.least_frictions(b, name, float(given.study.allowed_m or 0.0))
            for s, slope in enumerate(given.slopes_deg):
                for x, level in enumerate(given.intensities):
                    yield building, name, slope, level, float(values[s, x])


def _slope_head(results: StudyResults) -> Row:
    measure = results.plan.input.study.intensity.value
    return (
        "Building",
        "Displacement",
        "Friction",
        measure,
        "Largest slope [deg]",
    )


def _slopes(results: StudyResults) -> Iterator[Row]:
    given = results.plan.input
    for b, building in enumerate(results.plan.motions.buildings):
        for name in results.displacements if given.study.allowed_m else ():
            values = results.largest_slopes(b, name, float(given.study.allowed_m or 0.0))
            for m, mu in enumerate(given.mus):
                for x, level in enumerate(given.intensities):
                    yield building, name, mu, level, float(values[m, x])


_FRAGILITY = (
    "Building", "Array", "Limit state", "Exceeded when", "Limit on PRD of a motion", "Unit",
    "Median theta", "theta, 5 %", "theta, 95 %", "Dispersion beta", "beta, 5 %", "beta, 95 %",
    "Lilliefors p of fit", "Censored capacities", "Motions below the limit again", "Censored runs",
    *(f"Beta, {name}" for name in NAMES), "Beta exported",
)  # fmt: skip


def _fragilities(results: StudyResults, unit: Unit) -> Iterator[Row]:
    for one in results.arrays:
        for state in one.states:
            f = state.fragility
            yield (
                results.plan.motions.buildings[one.plan.building],
                one.plan.array.id,
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
                *_dispersions(results, one, state),
            )


def _dispersions(results: StudyResults, one: ArrayResult, state: LimitState) -> Row:
    """Return the dispersions of a limit state by name, and that exported; NaN for none."""
    if not (is_exportable(results) and state.fragility.fitted.is_known):
        return [math.nan] * (len(NAMES) + 1)
    total = math.nan if refusal(results) else exported(results, one, state).beta
    return [*(part.beta or math.nan for part in dispersions(results, one, state)), total]


_CHANCES = (
    "Building", "Array", "Clearance", "Unit", "Chance of exceedance", "5 %", "95 %", "Runs",
    "Runs without a value",
)  # fmt: skip


def _chances(results: StudyResults, unit: Unit) -> Iterator[Row]:
    for one in results.arrays:
        for chance in one.chances:
            yield (
                results.plan.motions.buildings[one.plan.building],
                one.plan.array.id,
                one.plan.array.clearance_m / unit.si,
                unit.symbol,
                chance.value,
                chance.low,
                chance.high,
                chance.runs,
                chance.without_value,
            )


def _formula(results: StudyResults) -> Iterator[Row]:
    for building, fit in zip(results.plan.motions.buildings, results.fits, strict=True):
        if not isinstance(fit, Fit):
            yield building, "none", fit
            continue
        yield building, "fitted, Δ_RHA", f"value from analysis: {analysis_words(results)}, in m"
        for number, value in enumerate(fit.coefficients):
            yield building, f"b{number}", value
        yield building, "p [g]", fit.ppa_g
        yield building, "standard deviation of ln(computed / formula)", fit.sigma_ln
        yield building, "least computed / formula", fit.least_ratio
        yield building, "greatest computed / formula", fit.greatest_ratio
        yield building, "cases", fit.cases
        for name, (low, high) in fit.domain.items():
            yield building, f"{name}, from", low
            yield building, f"{name}, to", high
