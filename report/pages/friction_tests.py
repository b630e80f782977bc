"""Friction as tested: the report, its runs and means, and what is missing.

Nothing here is canned: every sentence follows from the Friction tests worksheet.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.checks.check import VELOCITY_ROW
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import by_id
from report.assessment.design.friction import mu_words
from report.assessment.design.tested_friction import (
    MOST_BEYOND,
    basis_words,
    tested,
    velocity_check,
)
from report.assessment.design.verdict import NOT_GIVEN, Verdict
from report.document.columns import ColumnHead, centered, text, words
from report.document.tables import Table, Wide, by_place, listed, merged, stamp
from report.pages.parts import PackageData
from report.project.check.array_faults import MU_TOLERANCE
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.friction_report import FrictionTests
from report.text.counts import numbered
from report.text.grouping import ids_by
from report.text.letter_case import capitalized
from report.text.names import named
from report.text.unit_format import UnitFormat
from report.text.units import NO_BREAK, Quantity, no_less, number
from solver.friction_tests import FittedLaw, Series, Surface, fit_law, governing

_STATED = (
    ("Laboratory", "laboratory"),
    ("Accreditation", "accreditation"),
    ("Standard", "standard"),
    ("Report number", "report"),
    ("Report date", "date"),
    ("Membrane", "membrane"),
    ("Support material", "support"),
)


def page(package: PackageData) -> Mapping[str, object]:
    """Return the text of the part on friction as tested, next to its chart."""
    data, assessment, fmt = package.data, package.assessment, package.fmt
    all_series, tests = tested(data), data.friction_tests
    reports = dict.fromkeys(series.report for series in all_series)
    fits, runs = list(_fits(package)), _runs(package)
    points = [
        _means([series for series in all_series if series.report == report], len(reports) > 1)
        for report in reports
    ]
    if all_series:
        points += _compared(package, all_series)
    points += [_fit_words(series, fit) for series, fit in fits]
    return {
        "report": "; ".join(
            f"{label}: {getattr(tests, field) or NOT_GIVEN}" for label, field in _STATED
        )
        if tests != FrictionTests()
        else "",
        "pressures": _pressures(package),
        "pairs_of_runs": [runs[k : k + 2] for k in range(0, len(runs), 2)],
        "n_drawn": _n_drawn(data),
        "has_fits": any(fit.is_determined for _, fit in fits),
        "points": points,
        "has_tests": bool(all_series),
        "velocities": merged(_velocities(package)) if assessment.has_motions else None,
        "tolerance": f"{MU_TOLERANCE:g}",
        "most_beyond": f"{MOST_BEYOND:g}",
        "at_low_velocity": [
            _at_low_velocity(item, by_id(assessment.arrays, item.id), fmt)
            for item in assessment.low_velocity.arrays
        ],
    }


def _pressures(package: PackageData) -> str:
    """Return the contact pressures of the tests and of the supports; nothing if none is known."""
    data, fmt = package.data, package.fmt
    tested_pa = data.friction_tests.contact_pressure_pa
    by_pressure = ids_by(data.arrays, lambda array: array.contact_pressure_pa)

    def words(pressure_pa: float | None) -> str:
        return fmt.both(pressure_pa, Quantity.PRESSURE) if pressure_pa else "not entered"

    if not (tested_pa or any(by_pressure)):
        return ""
    supports = (f"{named(ids, 'array')} {words(pa)}" for pa, ids in by_pressure.items())
    return f"{words(tested_pa)} in the tests; supports of {', '.join(supports)}"


def drawings(package: PackageData) -> Sequence[str]:
    """Return the runs over velocity, if any reports it and an array slides."""
    from report.figures.charts import friction_by_velocity

    data = package.data
    if not (package.assessment.has_motions and _n_drawn(data)):
        return ()
    runs = [run for series in tested(data) for run in series.runs]
    fits = {series.surface: fit for series, fit in _fits(package) if fit.is_determined}
    return (friction_by_velocity(runs, data.arrays, fits, package.fmt.us_first),)


def _n_drawn(data: ProjectInput) -> int:
    """Return the number of runs that report their velocity."""
    return sum(not math.isnan(run.velocity_mps) for series in tested(data) for run in series.runs)


def _runs(package: PackageData) -> Sequence[tuple[str, Table]]:
    """Return the runs of each series below its name, the mean last."""
    data = package.data
    all_series = tested(data)
    has_reports = len({series.report for series in all_series}) > 1
    columns = by_place(
        text("Run", share=0.7),
        ColumnHead(head="Velocity", quantity=Quantity.VELOCITY),
        text("Kinetic μ"),
        text("Static μ"),
    )
    return [
        (
            f"{series.report or 'Report without a number'}, {series.surface}"
            if has_reports
            else f"Friction tests, {series.surface}",
            listed(
                _run_rows(data, series),
                columns,
                package.fmt,
                kind="compact",
                style=lambda row: "total" if isinstance(row[0], Wide) else "",
            ),
        )
        for series in all_series
    ]


def _run_rows(data: ProjectInput, series: Series) -> Iterator[tuple[object, ...]]:
    """Yield the runs of a series, and their mean."""
    numbers = [
        row.number
        for row in data.friction_runs
        # A run without a report number is of the report that the sheet names.
        if (row.report or data.friction_tests.report, row.surface)
        == (series.report, series.surface)
    ]
    # By the row of the workbook, so that a run is found there.
    for count, run in zip(numbers, series.runs, strict=True):
        velocity = "—" if math.isnan(run.velocity_mps) else run.velocity_mps
        yield count, velocity, number(run.mu, 3), number(run.mu_static, 3)
    mean = Wide(f"Mean, {numbered(len(series.runs), 'run')}", 3)
    yield mean, "", number(series.mean, 3), number(series.static_mean, 3)


def _velocities(package: PackageData) -> Table:
    columns = by_place(
        words("Array", 0.6),
        text("μ", "as analyzed", package.mu_share),
        ColumnHead(
            head="Peak sliding velocity", quantity=Quantity.VELOCITY, share=0.8, show=no_less
        ),
        ColumnHead(head="Tested to", quantity=Quantity.VELOCITY, share=0.8),
        text("Max. μ above tested range", "largest", 0.9),
        text("Min. mean μ tested", "smallest", 0.9),
        centered("Verdict", 1.8),
    )
    assessment = package.assessment
    verdicts = {row.subject: row.verdict for row in assessment.checks if row.id == VELOCITY_ROW}
    rows = [_velocity(package.data, item, verdicts) for item in assessment.arrays]
    return listed(rows, columns, package.fmt, kind="compact")


def _velocity(
    data: ProjectInput, item: ArrayAssessment, verdicts: Mapping[str, Verdict]
) -> tuple[object, ...]:
    check = velocity_check(data, item)
    about = item.id, mu_words(item.array.friction), item.fastest_mps
    verdict = stamp(verdicts[item.id])
    if check.tests is None:
        return *about, "no runs", "—", "—", verdict
    tested_mps = "not entered" if math.isnan(check.tested_mps) else check.tested_mps
    return *about, tested_mps, check.beyond_words, check.minimum_words, verdict


def _means(all_series: Sequence[Series], has_others: bool) -> str:
    """Return the means of the series of a report, and which governs, in a sentence."""
    smallest = min(all_series, key=lambda series: series.mean)
    means = ", ".join(
        f"{number(series.mean, 3)} {series.surface} ({numbered(len(series.runs), 'run')})"
        for series in all_series
    )
    if len(all_series) > 1:
        governs = f"the smaller, {number(smallest.mean, 3)} {smallest.surface}, governs"
    else:
        lacking = next(surface for surface in Surface if surface is not smallest.surface)
        governs = f"no {lacking} runs are entered"
    kinetic = (
        f"Report {smallest.report or 'without a number'}: kinetic" if has_others else "Kinetic"
    )
    return f"{kinetic} mean {means}; {governs}."


def _compared(package: PackageData, series: Sequence[Series]) -> Iterator[str]:
    """Yield how the friction of the arrays compares with the tests, alike arrays together."""

    def comparison_of(array: Array) -> str:
        tests = governing(series, array.mu_report)
        # As printed: a difference that the page does not show is none.
        used, mean = round(tests.mean_of(array.friction), 3), round(tests.mean, 3)
        # Again, as 0.45 - 0.44 is 0.010000000000000009 in binary.
        above = round(used - mean, 3)
        is_by_velocity = array.friction.is_by_velocity
        mu = "mean of μ(v) at the tested velocities" if is_by_velocity else "μ ="
        differs, rounding = "equal to", ""
        if above:
            differs = f"{number(abs(above), 3)} {'above' if above > 0.0 else 'below'}"
        if above > 0.0:
            rounding = ", within rounding to two decimals"
        return (
            f"{mu} {number(used, 3)}, {differs} the tested mean {number(mean, 3)} "
            f"({tests.surface}){rounding}; {basis_words(package.data, array)}."
        )

    for comparison, ids in ids_by(package.data.arrays, comparison_of).items():
        yield f"{named(ids, 'Array')}: {comparison}"


def _fit_words(series: Series, fit: FittedLaw) -> str:
    """Return the law fitted to the runs of a series, and how far they scatter about it."""
    runs = [run for run in series.runs if not math.isnan(run.velocity_mps)]
    velocities = {run.velocity_mps for run in runs}
    start = f"{capitalized(series.surface)}, {len(velocities)} velocities:"
    if not fit.is_determined:
        return f"{start} the runs do not determine a velocity-dependent coefficient."
    mean = math.fsum(run.mu for run in runs) / len(runs)
    # Divided by n, as `FittedLaw.rms`: the two are compared.
    scatter = math.sqrt(math.fsum((run.mu - mean) ** 2 for run in runs) / len(runs))
    law = fit.law
    return (
        f"{start} fit μ = {number(law.mu_slow, 3)} at low and {number(law.mu_fast, 3)} at high "
        f"velocity, rate {number(law.rate_s_per_m, 1)}{NO_BREAK}s/m; rms residual "
        f"{number(fit.rms, 4)} ({number(scatter, 4)} with a single coefficient)."
    )


def _at_low_velocity(item: ArrayAssessment, as_run: ArrayAssessment, fmt: UnitFormat) -> str:
    """Return the result for an array with its low-velocity friction at every velocity."""
    alone, with_law = fmt.both_up(item.design_m), fmt.both_up(as_run.design_m)
    refused = " (not permitted)" if item.has_unpermitted_value else ""
    instead = ", unchanged" if alone == with_law else f" instead of {with_law}"
    return (
        f"With μ = {mu_words(item.array.friction)} at all velocities (all motions rerun), the "
        f"design displacement of {item.id} is {alone}{refused}{instead}."
    )


def _fits(package: PackageData) -> Iterator[tuple[Series, FittedLaw]]:
    """Yield the laws fitted to the runs of the governing report, by condition."""
    all_series = tested(package.data)
    reports = dict.fromkeys(series.report for series in all_series)
    # Of several reports each array names its own, so that no fit is of all of them.
    if len(reports) != 1:
        return
    for series in all_series:
        fit = fit_law([run.velocity_mps for run in series.runs], [run.mu for run in series.runs])
        if fit is not None:
            yield series, fit
