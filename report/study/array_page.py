"""The sections on an array: its fragilities and probabilities, and its rates and lives.

And of the latter the sheets of study.xlsx, and years.json. Computes nothing but units and
probabilities. Read `fragility`, then `years`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.document.columns import text, words
from report.document.sections import Section, section
from report.document.tables import Column, listed
from report.project.read.years_file import SUPPORTING, Distance, StudyYears, YearsOfArray
from report.study import study_charts
from report.study import years as rates
from report.study.dispersions import (
    NAMES,
    Dispersion,
    dispersions,
    exported,
    is_exportable,
    is_refused,
)
from report.study.page_parts import axis, design_length
from report.study.study_plan import SLOPE
from report.study.study_results import ArrayStudyResult, LimitState, StudyResults
from report.study.study_tables import Row, length_unit, who
from report.study.wording import MASS, on_building
from report.study.years import ArrayYears
from report.text.names import slug
from report.text.units import number, round_up
from solver.studies import capacity, lives, predictive, uncertainty
from solver.studies import fragility as fits
from solver.studies.rates import LEAST_RATE


def fragility(results: StudyResults, result: ArrayStudyResult) -> Section:
    """Return the section on an array: its fragilities, and the probabilities where asked for."""
    name = f"{result.plan.array.id}{on_building(results, result.plan.building, ', building ')}"
    known = [state for state in result.states if state.fragility.fitted.is_known]
    return section(
        "study/array",
        f"Fragility of {name}",
        id=f"array-{slug(name)}",
        one=result,
        exported=_exported(results, result, known),
        MASS=MASS,
        capacity=capacity,
        fits=fits,
        uncertainty=uncertainty,
        charts=dict(_charts(results, result)),
    )


def _charts(results: StudyResults, result: ArrayStudyResult) -> Iterator[tuple[str, str]]:
    yield "fragility", study_charts.fragilities(result.states, axis(results))
    tested = [state for state in result.states if not math.isnan(state.fragility.p_value)]
    if tested:
        yield "goodness", study_charts.goodness(tested, axis(results))
    if result.bars and not math.isnan(result.center_m):
        yield "tornado", study_charts.tornado(result.bars, result.center_m, length_unit(results))


def _exported(
    results: StudyResults, result: ArrayStudyResult, states: Sequence[LimitState]
) -> Mapping[str, Any]:
    """Return the dispersions of the exported fragilities by name; empty if there are none."""
    by_state = {state.name: dispersions(results, result, state) for state in states}
    if not by_state or not is_exportable(results):
        return {}
    by_name = list(zip(*by_state.values(), strict=True))
    # A dispersion that no state has gets a sentence in place of a column.
    known = [k for k, parts in enumerate(by_name) if any(part.beta for part in parts)]
    below = result.plan.shifts[SLOPE][0][1] if SLOPE in result.plan.shifts else math.nan
    columns = (
        (words("State", 0.7), lambda state: state.name),
        *(_part(by_name[k], k, by_state) for k in known),
        (
            text("β exported"),
            lambda state: (
                "not exported"
                if is_refused(results)
                else _beta(exported(results, result, state).beta)
            ),
        ),
    )
    return {
        "lacking": [
            f"{name} ({parts[0].source})"
            for k, (name, parts) in enumerate(zip(NAMES, by_name, strict=True))
            if k not in known
        ],
        "first_order": [NAMES[k] for k in known if NAMES[k] in ("friction", "slope")],
        "is_level_below": below == 0.0,
        "table": listed(states, columns),
    }


def _part(
    parts: Sequence[Dispersion], k: int, by_state: Mapping[str, Sequence[Dispersion]]
) -> Column:
    """Return the column of a dispersion: its name, and its source in the states that have it."""
    source = next(part.source for part in parts if part.beta)
    head = text(f"{NAMES[k].capitalize()}: {source}", share=1.7)
    return (
        head,
        lambda state: _beta(by_state[state.name][k].beta) or by_state[state.name][k].source,
    )


def _beta(beta: float) -> str:
    return number(round_up(beta, 3), 3) if beta else ""


def years(results: StudyResults, array_years: ArrayYears) -> Section:
    """Return the section on the rates and the lives of an array."""
    plan = array_years.plan
    name = f"{plan.array.id}{on_building(results, plan.building, ', building ')}"
    (curve,), unit = results.plan.hazard, length_unit(results)
    # Each motion is run up to its own uplift.
    ends = array_years.responses.levels.max(axis=1)
    return section(
        "study/years",
        f"Rates and {rates.LIFE_YEARS:g} years of {name}",
        id=f"years-{slug(name)}",
        one=array_years,
        array=array_years.plan.array,
        hazard=results.plan.input.hazard,
        curve=curve,
        lifts=ends.min() < 0.999 * curve.top,
        top=float(ends.max()),
        of_friction=[
            (mu, [design_length(results, prd_m) for prd_m in row])
            for mu, row in zip(array_years.mus, array_years.prd_by_mu_m, strict=True)
        ],
        recurrence_heads=[
            (f"{span:g} years", 1, "right", unit.symbol) for span in rates.RECURRENCES
        ],
        first_motion=results.plan.motions.motions[0][0],
        SUPPORTING=SUPPORTING,
        surfaces=results.plan.input.surfaces(array_years.plan.array.mat),
        LEAST_RATE=LEAST_RATE,
        lives=lives,
        predictive=predictive,
        rates=rates,
        charts={
            "rates": study_charts.rates(array_years, curve, unit, axis(results)),
            "lives": study_charts.lives(array_years, unit),
        },
    )


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
