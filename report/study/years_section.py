"""The section on the rates and the lives of an array; their sheets of study.xlsx, and years.json.

Computes nothing but units and probabilities. Read `years`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Table, by_place, listed
from report.pages.symbols import with_symbols
from report.project.read.years_file import NEVER, SUPPORTING, Distance, StudyYears, YearsOfArray
from report.study import study_charts
from report.study import years as rates
from report.study.page_parts import axis, design_length
from report.study.sentences import about_array
from report.study.study_results import StudyResults
from report.study.study_tables import Row, length_unit, who
from report.study.wording import both, chance, level, on_building
from report.study.years import ArrayYears
from report.text.counts import numbered
from report.text.error_text import scientific
from report.text.names import slug
from report.text.units import digits_down, digits_up, number
from solver.model import INCH_M
from solver.studies import lives, predictive
from solver.studies.predictive import Predictive
from solver.studies.rates import LEAST_RATE, HazardCurve


def years(results: StudyResults, array_years: ArrayYears) -> Section:
    """Return the section on the rates and the lives of an array."""
    plan, study, predicted = array_years.plan, results.plan.input.study, array_years.predicted
    name = f"{plan.array.id}{on_building(results, plan.building, ', building ')}"
    (curve,), motion = results.plan.hazard, results.plan.motions.motions[0][0]
    hazard, life = results.plan.input.hazard, f"{rates.LIFE_YEARS:g} years"
    lost, slip = array_years.statistics[NEVER][0].without_value, array_years.slip
    unit, settled_m = length_unit(results), lives.SETTLED_M
    untested = f"μ = {array_years.mus[0]:g} without scatter, as no test is given"
    friction = f"mean μ of its tests {number(predicted[0].mean, 3)}" if predicted else untested
    return section(
        "study/years",
        f"Rates and {life} of {name}",
        id=f"years-{slug(name)}",
        supporting=SUPPORTING,
        about=about_array(results, plan.array, friction),
        hazard=hazard,
        record_beta=study.record_beta,
        record_source=study.record_source,
        end=with_symbols(level(results, curve.intensity[-1])),
        longest=digits_down(1 / curve.rate[-1], 3) if curve.is_ended else "",
        start=with_symbols(level(results, curve.intensity[0])),
        slip=_intensity(results, slip) if slip < curve.intensity[0] else "",
        motions=results.plan.design_rule.n_motions,
        orientations=len(motion.orientations),
        **_ends(results, array_years, curve),
        change=f"{digits_up(100 * array_years.change, 2)}%",
        settled_mm=f"{1000 * settled_m:g}",
        settled_in=digits_up(settled_m / INCH_M, 1),
        recurrences=_recurrences(results, array_years),
        is_ended=any(math.isinf(high_m) for *_, high_m in array_years.recurrences),
        clearance_rate="{} ({} to {})".format(*map(scientific, array_years.clearance_rates)),
        chances=", ".join(
            f"{chance(*values)} in {span:g} years" for span, values in array_years.chances.items()
        ),
        bins=_bins(results, array_years),
        life=life,
        lives=rates.LIVES,
        farther=both(results, hazard.recenter_m) if hazard.recenter_m else "",
        has_transverse=motion.has_transverse,
        statistics=_statistics(results, array_years),
        statistics_caption=f"Distance from the installed place in {life}",
        lost=f"{digits_up(100 * lost, 2)}%" if lost else "",
        friction=_friction(results, array_years, *predicted) if predicted else {},
        charts={
            "rates": study_charts.rates(array_years, curve, unit, axis(results)),
            "lives": study_charts.lives(array_years, unit),
        },
    )


def _intensity(results: StudyResults, value: float) -> str:
    return f"{digits_down(value, 3)} {results.plan.input.study.intensity.unit}"


def _ends(
    results: StudyResults, array_years: ArrayYears, curve: HazardCurve
) -> Mapping[str, str | int]:
    """Return how many intensities are run, up to which, and what is said of events beyond."""
    # Each motion is run up to its own uplift.
    ends = array_years.responses.levels.max(axis=1)
    lifts, top = ends.min() < 0.999 * curve.top, _intensity(results, float(ends.max()))
    beyond = f"together have a rate of {scientific(LEAST_RATE)} a year"
    if curve.is_ended or lifts:
        beyond = "lift the array off or are beyond the curve"
    return {
        "levels": array_years.responses.levels[0].size,
        "top": f"that which lifts the array off, at most {top}" if lifts else top,
        "beyond": beyond,
    }


_RUNS = (
    (words("Report", 2), lambda surface: surface.report or "not stated"),
    (words("Surface"), lambda surface: surface.surface),
    (text("Runs", share=0.7), lambda surface: len(surface.runs)),
    (text("Mean μ"), lambda surface: number(surface.mean, 3)),
)


def _friction(
    results: StudyResults, array_years: ArrayYears, predicted: Predictive
) -> Mapping[str, Any]:
    """Return the friction of a mat as measured, and what it means for the displacement."""
    mat = array_years.plan.array.mat
    surfaces, between = results.plan.input.surfaces(mat), ""
    if len(surfaces) > 1:
        between = f"; the means of the surfaces with one of {number(predicted.between, 4)}"
        if not math.isnan(predicted.p_value):
            between += f" (p of equal means {digits_up(predicted.p_value, 2)})"
    return {
        "runs": listed(surfaces, _RUNS, kind="compact"),
        "caption": f"Runs of mat {mat}",
        "predicted": predicted,
        "between": between,
        "least": number(predicted.quantiles[0], 3),
        "quantile": f"{100 * predictive.QUANTILES[0]:g}%",
        "most": number(predicted.quantiles[-1], 3),
        "prds": _by_friction(results, array_years),
        "verdict": _verdict(array_years),
    }


def _recurrences(results: StudyResults, array_years: ArrayYears) -> Table:
    """Return the PRD by mean recurrence interval, with its band."""
    rows = [
        (f"{span:g}", *(both(results, prd_m) for prd_m in prds_m))
        for span, *prds_m in array_years.recurrences
    ]
    prds = (text(head, share=1.6) for head in ("PRD", "16%", "84%"))
    return listed(rows, by_place(text("Mean recurrence", "years", 1.2), *prds), kind="compact")


def _bins(results: StudyResults, array_years: ArrayYears) -> Table:
    """Return the share of each range of intensity in the rate of the clearance."""
    measure = results.plan.input.study.intensity
    edges = [digits_down(edge, 3) for edge in array_years.edges]
    between = [f"{low} to {high}" for low, high in pairwise(edges[1:-1])]
    names = (f"below {edges[1]}", *between, f"{edges[-2]} and more")
    shares = [f"{number(100 * share, 1)}%" for share in array_years.shares]
    heads = text(with_symbols(measure.letters), measure.unit, 1.4), text("Share of the rate")
    return listed(zip(names, shares, strict=True), by_place(*heads), kind="compact")


def _statistics(results: StudyResults, array_years: ArrayYears) -> Table:
    """Return the largest and the last distance, by when the array is put back."""
    rows = []
    for name, pair in array_years.statistics.items():
        for which, distance in zip(("largest", "last"), pair, strict=True):
            distances = both(results, distance.mean_m), both(results, distance.p95_m)
            rows.append((name, which, *distances, f"{digits_up(100 * distance.beyond, 2)}%"))
    names = (words("Put back", 1.6), words("Distance", 0.8))
    heads = (text("Mean", share=1.4), text("95%", share=1.4), text("Beyond clearance", share=1.1))
    return listed(rows, by_place(*names, *heads), kind="compact")


def _by_friction(results: StudyResults, array_years: ArrayYears) -> Table:
    """Return the PRD of each friction coefficient by mean recurrence interval."""
    symbol = length_unit(results).symbol
    prds = (text(f"{span:g} years", symbol) for span in rates.RECURRENCES)
    heads = text("Probability that μ is less", "%", 1.2), text("μ", share=0.8), *prds
    of_mu = zip(predictive.QUANTILES, array_years.mus, array_years.prd_by_mu_m, strict=True)
    rows = (
        (f"{100 * share:g}", number(mu, 3), *(design_length(results, prd_m) for prd_m in row))
        for share, mu, row in of_mu
    )
    return listed(rows, by_place(*heads), kind="compact")


def _verdict(array_years: ArrayYears) -> str:
    """Return whether more runs with this mean and scatter would show the friction needed."""
    prd, runs = f"PRD of {rates.VERDICT_YEARS:g} years", "runs with this mean and scatter"
    required = digits_up(array_years.required_mu, 3)
    if array_years.more_runs == 0:
        within = "is within the clearance even with the lowest of these coefficients"
        return f"The {prd} {within}: more {runs} do not change that."
    start = f"With the lowest of these coefficients the {prd} exceeds the clearance"
    if not math.isinf(array_years.more_runs):
        runs_text = numbered(int(array_years.more_runs), "more run")
        result = f"would show the μ = {required} that is required"
        return f"{start}; {runs_text} with this mean and scatter {result}."
    if math.isinf(array_years.required_mu):
        larger = "it does so with the largest too, so that no number of"
        return f"{start}; {larger} {runs} changes that."
    return f"{start}; μ = {required} is required, which no number of {runs} shows."


def sheets(results: StudyResults) -> Iterator[tuple[str, Row, list[Row]]]:
    """Yield the sheets of study.xlsx: title, heading and rows."""
    unit, many = length_unit(results), results.years
    yield "Hazard", ("What", "Value", "Unit"), list(_hazard(results))
    quantiles = ("16%", "84%")
    hazard_rows: list[Row] = []
    value_rows: list[Row] = []
    for array_years in many:
        names = who(results, array_years.plan)
        for d_m, rate, band in zip(
            array_years.limits_m, array_years.rates, array_years.rates_band.T, strict=True
        ):
            hazard_rows.append((*names, d_m / unit.si, rate, *band))
        value_rows += [(*names, *row) for row in _values(results, array_years)]
    yield (
        "Displacement hazard",
        ("Building", "Array", f"PRD [{unit.symbol}]", "Annual rate", *quantiles),
        hazard_rows,
    )
    yield (
        "25 years",
        ("Building", "Array", "What", "Case", "Value", *quantiles, "Unit"),
        value_rows,
    )


def _hazard(results: StudyResults) -> Iterator[Row]:
    hazard, measure = results.plan.input.hazard, results.plan.input.study.intensity
    yield "Site", hazard.site
    yield "Source of the curve", hazard.source
    yield "Hazard model", hazard.edition
    yield "Vs30 of the curve", hazard.vs30_mps, "m/s, rock" if hazard.is_rock else "m/s"
    yield "Vs30 of the site", hazard.site_vs30_mps, "m/s"
    yield "Factor to the site", hazard.site_factor or 1.0, hazard.site_basis
    yield "Factor to the roof", hazard.roof_factor or 1.0, hazard.roof_basis
    for curve in results.plan.hazard:
        for x, rate in zip(curve.intensity, curve.rate, strict=True):
            yield f"Annual rate above {x / hazard.factor:g} {measure.unit}", float(rate), "1/year"


def _values(results: StudyResults, array_years: ArrayYears) -> Iterator[Row]:
    """Yield what, case, value, its quantiles and its unit."""
    unit, none = length_unit(results), ("", "")
    for span, *lengths_m in array_years.recurrences:
        yield "PRD", f"{span:g} years", *(d / unit.si for d in lengths_m), unit.symbol
    yield "Clearance exceeded", "annual rate", *array_years.clearance_rates, "1/year"
    for span, chances in array_years.chances.items():
        yield "Clearance exceeded", f"in {span:g} years", *chances, "probability"
    for low, high, share in array_years.bins:
        yield "Clearance exceeded", f"{low:.3g} to {high:.3g}", share, *none, "share of the rate"
    for name, distances in array_years.statistics.items():
        for which, distance in zip(("Largest", "Last"), distances, strict=True):
            case, lives = f"put back {name}", "share of lives"
            yield f"{which} distance, mean", case, distance.mean_m / unit.si, *none, unit.symbol
            yield f"{which} distance, 95%", case, distance.p95_m / unit.si, *none, unit.symbol
            yield f"{which} distance beyond clearance", case, distance.beyond, *none, lives
    for mu, of_mu in zip(array_years.mus, array_years.prd_by_mu_m, strict=True):
        for span, prd_m in zip(rates.RECURRENCES, of_mu, strict=True):
            yield f"PRD with μ = {mu:.4g}", f"{span:g} years", prd_m / unit.si, *none, unit.symbol
    for of_mat in array_years.predicted:
        yield "Friction, mean", f"{of_mat.runs} runs", of_mat.mean, *none, ""
        yield "Friction, scatter within surfaces", "s", of_mat.within, *none, ""
        yield "Friction, scatter between surfaces", "s", of_mat.between, *none, ""
        yield "Friction, Student t scale", f"{of_mat.freedom} degrees", of_mat.scale, *none, ""
        case = f"{rates.VERDICT_YEARS:g} years"
        yield "Friction, more runs", case, array_years.more_runs, *none, "runs"


def years_json(results: StudyResults) -> bytes:
    """Return years.json, which a package may show."""
    study, manifest = results.plan.input.study, results.manifest
    years = StudyYears(
        note=SUPPORTING,
        title=study.title,
        date=study.date.isoformat(),
        study=manifest["identity"],
        program=manifest["program"]["roofslip"],
        hazard=results.plan.input.hazard.model_dump(),
        life_years=rates.LIFE_YEARS,
        arrays=tuple(_of_array(results, array_years) for array_years in results.years),
    )
    return years.model_dump_json(indent=1).encode() + b"\n"


def _of_array(results: StudyResults, array_years: ArrayYears) -> YearsOfArray:
    building, array = who(results, array_years.plan)
    statistics = array_years.statistics
    return YearsOfArray(
        array=array,
        building=building,
        slope_deg=array_years.plan.array.slope_deg,
        mu=array_years.predicted[0].mean if array_years.predicted else array_years.plan.mu,
        clearance_m=array_years.plan.array.clearance_m,
        clearance_rate=float(array_years.clearance_rates[0]),
        prd_m={f"{span:g}": prd_m for span, prd_m, *_ in array_years.recurrences},
        largest={name: Distance.model_validate(pair[0]) for name, pair in statistics.items()},
        last={name: Distance.model_validate(pair[1]) for name, pair in statistics.items()},
    )
