"""What a plan checker asks about the seismic parameters: code, source, SDC, site class, 11.4.8.

Each row that is not satisfied is a condition, not NG; values below their table are errors
(`report.sheet.checking.checks`). Read `hazard_rows`, `friction_rows`, `fire_lane_rows`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from report.assessment.verdict import NOT_GIVEN, STAYS, Requirement, condition, stated
from report.sheet.checking.motion_checks import MU_TOLERANCE
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.schema.project import Site
from report.sheet.schema.scene import SIDES, Array
from report.sheet.schema.shapes import around, gap_m
from report.text.amounts import capacity, compared_pairs, entered
from report.text.counts import capitalized, grouped_by, numbered, ranged
from report.text.units import Quantity, measured, no_less, pair
from solver.friction_tests import Series, Surface, fit_law, governing, series
from solver.model import Friction
from solver.rules.hazard import LEAST_F_A_BY_DEFAULT, REFERENCED, HazardBasis
from solver.rules.site_coefficients import BY_DEFAULT, LEAST_S_1_OF_D_G, site_specific_reason

_FIELDS = {
    symbol: Place("site", 0, field)
    for symbol, field in (("S_S", "s_s_g"), ("S_1", "s_1_g"), ("S_D1", "s_d1_g"))
}


def hazard_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return the rows on the seismic parameters of the site."""
    site = data.site
    return (*_code(data), _source(site), _category(site), *_site_class(site), *_site_specific(site))


_ATTACH = "attach the jurisdiction's letter of acceptance on the sheet Site"


def _code(data: ProjectInput) -> Iterator[Requirement]:
    """Yield what is not by the edition of ASCE 7 that the building code references."""
    site, mark = data.site, "" if data.confirmed else "†"
    # By chapter 35 of the IBC and the CBC, the list of referenced standards.
    code, edition = site.code_text, REFERENCED.get(site.code_text)
    letter = site.acceptance_letter and f"; {site.acceptance_letter}, attached"
    row = partial(condition, basis=f"{code}, chapter 35{mark}", is_satisfied=bool(letter))
    # Nothing is guessed for a code that is not in the list.
    if code and not edition:
        yield row(
            id="code_edition",
            title="Edition of ASCE 7 that the building code references",
            found=f"not known to this program for the {code}{letter}",
            limit="known, or acceptance in writing",
            remedy="Confirm which it is, and that the rule set and the seismic parameters are by "
            f"it, and {_ATTACH}. Known for: {', '.join(REFERENCED)}.",
            places=(Place("site", 0, "building_code_year"),),
        )
    for field, what, used, instead in (
        ("rule_set", "", site.rule_set, "select the rule set"),
        ("edition_name", "the seismic parameters of ", site.edition.name, "enter those of"),
    ):
        if edition and used != edition:
            yield row(
                id=field,
                title=f"Acceptance of {what}{used} by the jurisdiction",
                found=f"{used}{letter}",
                limit=f"{edition} of the {code}{mark}, or acceptance in writing",
                remedy=f"{capitalized(_ATTACH)}, or {instead} {edition}.",
                places=(Place("site", 0, field),),
            )


def _source(site: Site) -> Requirement:
    source, date = ("source", site.hazard_source), ("date", site.hazard_date)
    # A number typed from a tool cannot be traced; its printout can.
    file = site.hazard_printout and f"{site.hazard_printout}, attached"
    if site.hazard is not HazardBasis.SITE_SPECIFIC:
        return condition(
            id="hazard_source",
            title="Source, date and printout of the seismic parameters",
            **stated(
                "site", hazard_source=source, hazard_date=date, hazard_printout=("printout", file)
            ),
            limit="source, date and printout",
            basis="seismic parameters",
            remedy="State source and date on the sheet Site, and attach the printout of the tool.",
        )
    number = ("report number", site.hazard_report)
    return condition(
        id="hazard_source",
        title="Report on the site-specific hazard analysis",
        **stated(
            "site",
            hazard_source=source,
            hazard_report=number,
            hazard_date=date,
            hazard_printout=("report attached", file),
        ),
        limit="source, report number, date and the report attached",
        basis=site.edition.clause("site_specific"),
        remedy="Obtain the report, attach it, and state its author, number and date on the sheet "
        "Site.",
    )


def _category(site: Site) -> Requirement:
    # ASCE 7 11.6: the more severe of two tables, by S_DS and S_D1; S_1 from 0.75 g gives E or F.
    lacking = site.sdc_lacks
    needs_s_d1 = site.s_d1 is not None or "S_D1" in lacking
    missing = " and ".join(lacking)
    stated = f"{missing} {NOT_GIVEN}: SDC {site.sdc} is not confirmed"
    if not lacking:
        stated = f"S_1 = {site.s_1_g:.3f} g"
        stated += "" if site.s_d1 is None else f", S_D1 = {site.s_d1:.3f} g"
    return condition(
        id="sdc",
        title="Basis of the seismic design category",
        found=stated,
        limit="S_DS, S_1 and S_D1" if needs_s_d1 else "S_DS and S_1",
        basis=site.edition.clause("sdc"),
        is_satisfied=not lacking,
        remedy=f"The SDC also depends on {missing}: enter {'both' if len(lacking) > 1 else 'it'}.",
        places=tuple(_FIELDS[symbol] for symbol in lacking),
    )


def _site_class(site: Site) -> Iterator[Requirement]:
    # A site-specific analysis has the soil in it: nothing is taken by default.
    if site.assumed_class != BY_DEFAULT or site.hazard is HazardBasis.SITE_SPECIFIC:
        return
    holds = (
        f"F_a is then at least {LEAST_F_A_BY_DEFAULT:g} ({site.edition.clause('s_ms')}), and S_1 of"
        f" {LEAST_S_1_OF_D_G:g} g or more needs a site-specific hazard analysis or the exception"
        f" ({site.edition.clause('site_specific')}): determine the site class."
    )
    yield condition(
        id="site_class",
        title="Site class",
        found=f"{NOT_GIVEN}: D by default" if site.site_class is None else "D by default",
        limit="determined for the site",
        basis=site.edition.clause("site_class"),
        is_satisfied=False,
        # From ASCE 7-22 on, S_MS and S_M1 are read off for a site class: there are no F_a and F_v.
        remedy=holds
        if site.edition.has_site_coefficients
        else "The values of a hazard tool depend on the site class: determine it.",
        places=(Place("site", 0, "site_class"),),
    )


def _site_specific(site: Site) -> Iterator[Requirement]:
    reason, missing = site_specific_reason(
        site.edition, site_class=site.assumed_class, s_s_g=site.s_s_g, s_1_g=site.s_1_g
    )
    if not reason:
        return
    yield condition(
        id="site_specific_hazard",
        title=f"Hazard analysis for {reason}",
        found=site.hazard.value,
        limit="site-specific analysis or exception"
        + (", if the missing value requires it" if missing else ""),
        basis=site.edition.clause("site_specific"),
        is_satisfied=site.hazard is not HazardBasis.MAPPED,
        remedy="Give the mapped value that is missing, obtain a site-specific hazard analysis, or "
        "state the exception that applies."
        if missing
        else "S_DS and S_D1 are mapped values: obtain a site-specific hazard analysis, or state "
        "the exception that applies.",
        places=tuple(_FIELDS[symbol] for symbol in missing) or (Place("site", 0, "hazard"),),
    )


# PV1-2012: the kinetic average of three runs, of the worse of wet and dry.
LEAST_RUNS = 3

_NOISE = 1e-9  # of a coefficient: a mean of equal values is not above them
# What names the standard of friction tests: PV1-2012 asks for ASTM G115.
STANDARD = re.compile(r"\bASTM[\s-]*G[\s-]*115\b", re.IGNORECASE)


def tested(data: ProjectInput) -> tuple[Series, ...]:
    """Return the runs of a project by report and condition."""
    return series(row.run(data.friction_tests.report) for row in data.friction_runs)


def friction_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return the rows on the friction tests."""
    return _on_file(data), _standard(data), _wet_and_dry(data)


def _on_file(data: ProjectInput) -> Requirement:
    tests = data.friction_tests
    said = stated(
        "friction_tests",
        laboratory=("laboratory", tests.laboratory),
        report=("report number", tests.report),
        date=("date", tests.date),
    )
    attached = "; attached" if tests.report_file else ""
    return _row(
        title=f"Friction test report {'on file' if tests.report_file else 'stated'}",
        **{**said, "found": said["found"] + attached},
        limit="laboratory, report number, date",
        remedy="Obtain the friction test report and complete the sheet Friction tests.",
    )


def _standard(data: ProjectInput) -> Requirement:
    tests = data.friction_tests
    lacking = {
        "standard": not STANDARD.search(tests.standard),
        "accreditation": not tests.accreditation,
    }
    standard = f"standard {tests.standard or NOT_GIVEN}"
    accreditation = f"accreditation {tests.accreditation or NOT_GIVEN}"
    return _row(
        title="Tested to ASTM G115",
        found=f"{standard}; {accreditation}",
        limit="ASTM G115, accredited laboratory",
        is_satisfied=not any(lacking.values()),
        remedy="Obtain tests to ASTM G115 by an accredited laboratory, and state both on the sheet "
        "Friction tests.",
        places=tuple(
            Place("friction_tests", 0, field) for field, lacks in lacking.items() if lacks
        ),
    )


def is_complete(data: ProjectInput, report: str) -> bool:
    """Whether the runs of a report are wet and dry, and three or more at each velocity."""
    parts = [tests for tests in tested(data) if tests.report == report]
    return {tests.surface for tests in parts} == set(Surface) and all(
        # Runs without a velocity, which are the last, are no repeats of each other.
        len(repeats.runs) >= LEAST_RUNS and not math.isnan(repeats.velocity_mps)
        for tests in parts
        for repeats in tests.repeats
    )


def _wet_and_dry(data: ProjectInput) -> Requirement:
    by_surface = {(series.report, series.surface): series for series in tested(data)}
    reports = dict.fromkeys(report for report, _ in by_surface)
    still = [index for index, row in enumerate(data.friction_runs) if row.velocity_mps is None]
    rows = [
        (f"report {report or 'without a number'}: " if len(reports) > 1 else "")
        + ", ".join(_runs({s: by_surface.get((report, s)) for s in Surface}, data.us_first))
        for report in reports
    ]
    return _row(
        title="Wet and dry, three runs at each velocity",
        found="; ".join(rows) or "no runs",
        limit=f"{LEAST_RUNS} runs or more at each velocity, wet and dry",
        is_satisfied=bool(reports) and all(is_complete(data, report) for report in reports),
        remedy="Obtain the runs that are missing, and enter them with velocities on the sheet "
        "Friction tests.",
        places=tuple(Place("friction_runs", index, "velocity_mps") for index in still)
        or (Place("friction_runs"),),
    )


def basis_words(data: ProjectInput, array: Array) -> str:
    """Return where the friction of an array comes from: the fit of test runs, or entered."""
    all_series = tested(data)
    if not all_series:
        return "entered; no runs of friction tests are given"
    # The smaller mean governs, wet or dry (PV1-2012).
    tests = governing(all_series, array.mu_report)
    where = _where(tests, data.us_first)
    if _is_fit(array.friction, tests):
        return f"as tested: the fit of the {tests.surface} runs {where}"
    return f"entered, {_how_far(array.friction, tests)} the tests {where}"


def _is_fit(law: Friction, tests: Series) -> bool:
    """Whether a law is the fit of the runs, within the rounding of coefficients."""
    velocities = [run.velocity_mps for run in tests.runs]
    fit = fit_law(velocities, [run.mu for run in tests.runs]) if law.is_by_velocity else None
    # Too few velocities fit any law: then nothing is as tested.
    if fit is None or not fit.is_determined:
        return False
    pairs = [
        (law.mu_fast, fit.law.mu_fast),
        *((law.at(v), fit.law.at(v)) for v in (0.0, *velocities) if not math.isnan(v)),
    ]
    return all(abs(entered - fitted) <= MU_TOLERANCE for entered, fitted in pairs)


def _how_far(law: Friction, tests: Series) -> str:
    """Return how entered friction compares with the runs at each velocity, or on average."""
    # What is above the tests on average is refused by the checks of the sheet.
    if all(repeat.mean_of(law) <= repeat.mean + _NOISE for repeat in tests.repeats):
        return "at or below"
    if tests.mean_of(law) <= tests.mean + _NOISE:
        return "on average at or below"
    return f"on average within {MU_TOLERANCE:g} of"


def _where(tests: Series, us_first: bool) -> str:
    velocities = [repeat.velocity_mps for repeat in tests.repeats]
    ends = [pair(v, Quantity.VELOCITY, us_first) for v in velocities if not math.isnan(v)]
    if not ends:
        return f"(velocities {NOT_GIVEN})"
    return f"at {ends[0]}" if len(ends) == 1 else f"from {ends[0]} to {ends[-1]}"


def _runs(by_surface: Mapping[Surface, Series | None], us_first: bool) -> Iterator[str]:
    """Yield the runs in each condition, those that are alike together."""
    words = {
        s: runs_by_velocity(series, us_first) if series else "0 runs"
        for s, series in by_surface.items()
    }
    for said, alike in grouped_by(words, words.__getitem__).items():
        yield f"{' and '.join(alike)} {said}"


def runs_by_velocity(series: Series, us_first: bool) -> str:
    """Return in words how many runs there are at each velocity."""
    counts = grouped_by(
        series.repeats, lambda each: (len(each.runs), math.isnan(each.velocity_mps))
    )
    return ", ".join(
        f"{numbered(count, 'run')} with velocity {NOT_GIVEN}"
        if is_unknown
        else f"{numbered(count, 'run')} at {'each of ' if len(alike) > 1 else ''}"
        f"{_velocities([each.velocity_mps for each in alike], us_first)}"
        for (count, is_unknown), alike in counts.items()
    )


def _velocities(values_mps: Sequence[float], us_first: bool) -> str:
    first, second = (
        f"{', '.join(measured(value, unit) for value in values_mps)} {unit.symbol}"
        for unit in (Quantity.VELOCITY.value if us_first else Quantity.VELOCITY.value[::-1])
    )
    return f"{first} ({second})"


_row = partial(condition, id="friction_tests", basis="friction tests")


# Largest plan dimension of arrays between fire lanes [m]: 150 ft, which local codes amend: hence †.
FIRE_LANE_M = 150 * 0.3048

_MOST_M = FIRE_LANE_M * (1.0 + 1e-9)  # 150 ft given in meters is no more than 150 ft
_ROUNDING_M = 1e-3  # a lane of 4 ft is typed as 1.22 m
_STATE = "State on the sheet Site the section of the fire code."
_DIVIDE = f"Divide the arrays by a fire lane, or obtain the fire department's approval. {STAYS}"


def fire_lane_rows(data: ProjectInput) -> Iterator[Requirement]:
    """Yield for each array the plan dimension of all that no fire lane separates from it."""
    # The section is an input: local fire codes amend the limit and its number.
    lane_m, section = data.site.fire_lane_m, data.site.fire_code_section
    at = {array.id: row for row, array in enumerate(data.arrays)}
    groups = [
        (group, max(plan.x_to_m - plan.x_from_m, plan.y_to_m - plan.y_from_m))
        for group in _undivided(data.arrays, lane_m)
        for plan in (around(array.shape for array in group),)
    ]
    largest_m = max((m for _, m in groups if m <= _MOST_M), default=0.0)
    units = Quantity.PLAN, data.us_first
    lane = pair(lane_m, *units, no_less)
    for group, dimension_m in groups:
        fits = dimension_m <= _MOST_M
        # Of arrays that only lack the section the same is said: they share a condition.
        shown_m = largest_m if fits and not section else dimension_m
        distance, limit = compared_pairs(
            entered(shown_m), capacity(FIRE_LANE_M), *units, is_at_least=False
        )
        if fits and not section:
            distance = f"at most {distance}"
        elif len(group) > 1:
            distance = f"{ranged(array.id for array in group)} together: {distance}"
        for array in group:
            yield condition(
                id="fire_lanes",
                title=f"Largest plan dimension between fire lanes of {lane}",
                cause="fire code section not given" if fits else "too wide between fire lanes",
                subject=array.id,
                found=distance if section else f"{distance}; section {NOT_GIVEN}",
                limit=f"≤ {limit}",
                basis=f"{section or f'fire code, section {NOT_GIVEN}'}†",
                is_satisfied=fits and bool(section),
                remedy=_DIVIDE if section else _STATE if fits else f"{_STATE} {_DIVIDE}",
                places=tuple(Place("arrays", at[array.id], side) for side in SIDES)
                if section
                else (Place("site", 0, "fire_code_section"),),
            )


def _undivided(arrays: Sequence[Array], lane_m: float) -> Sequence[Sequence[Array]]:
    """Return arrays in groups: each is nearer than a lane to another one of its group."""
    groups: list[list[Array]] = []
    for array in arrays:
        # One array may join groups that were apart until it came.
        apart: list[list[Array]] = []
        joined = [array]
        for group in groups:
            # Between shapes, not their boxes: a ring may surround an array without being near it.
            if any(gap_m(array.shape, other.shape) < lane_m - _ROUNDING_M for other in group):
                joined += group
            else:
                apart.append(group)
        groups = [*apart, joined]
    return groups
