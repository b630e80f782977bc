"""Friction as tested: the report, its runs and means, and what is missing.

Nothing here is canned: every sentence follows from the sheet Friction tests.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from report.assessment.arrays import NOT_PERMITTED, ArrayAssessment, by_id
from report.assessment.friction import mu_words
from report.assessment.friction_rows import (
    LEAST_RUNS,
    basis_words,
    friction_rows,
    has_enough_runs,
    runs_by_velocity,
    runs_text,
    tested,
)
from report.assessment.friction_velocity import VELOCITY_ROW, velocity_check
from report.assessment.verdict import NOT_GIVEN
from report.document.blocks import Picture
from report.document.tables import Table, TableRow, Wide, stamp
from report.entities.clearance import clearance_results
from report.entities.columns import TableColumn
from report.pages.parts import PackageData
from report.sheet.friction_checks import MU_TOLERANCE
from report.sheet.schema import Array, FrictionTests, ProjectInput
from report.words.units import Quantity, number
from solver.friction_tests import (
    FittedLaw,
    Series,
    Surface,
    fit_law,
    governing,
)

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
    """Return the part on friction as tested."""
    return {
        "is_reported": package.data.friction_tests != FrictionTests(),
        "report": _report(package.data.friction_tests),
        "runs": _runs(package),
        "sentences": tuple(_sentences(package)),
        "velocities": _velocities(package),
        "alone": _alone(package),
        "alone_gaps": tuple(clearance_results(package, package.assessment.low_velocity.clearances)),
    }


def picture(package: PackageData) -> Sequence[Picture]:
    """Return the runs over velocity, where any run reports its velocity."""
    from report.figures.friction import friction_by_velocity

    data = package.data
    runs = [run for one in tested(data) for run in one.runs]
    shown = [run for run in runs if not math.isnan(run.velocity_mps)]
    if not shown:
        return ()
    fits = {one.surface: fit for one, fit in _fits(package) if fit.is_determined}
    fitted = " Dashed: laws fitted to the runs." if fits else ""
    return (
        Picture(
            svg=friction_by_velocity(runs, data.arrays, fits, package.fmt.us_first),
            caption=f"Kinetic friction of {runs_text(len(shown))} against sliding velocity. Solid"
            f" lines: friction of the arrays in this package.{fitted}",
            alt="Kinetic friction coefficient against sliding velocity",
        ),
    )


def _report(tests: FrictionTests) -> Table:
    values = {label: getattr(tests, field) for label, field in _STATED}
    return Table(
        caption="Friction tests: the report",
        columns=(
            TableColumn(head="Item", align="left", share=1.0),
            TableColumn(head="As given", align="left", share=3.0),
        ),
        rows=tuple(
            TableRow(cells=(label, str(value) if value else NOT_GIVEN))
            for label, value in values.items()
        ),
    )


def _runs(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Friction tests: runs",
        columns=(
            TableColumn(head="Report", align="left", share=1.6),
            TableColumn(head="Surface", align="left", share=1.0),
            TableColumn(head="Run", share=0.6),
            *fmt.columns("Velocity", Quantity.VELOCITY),
            TableColumn(head="Kinetic μ"),
            TableColumn(head="Static μ"),
        ),
        rows=tuple(row for one in tested(package.data) for row in _series_rows(package, one)),
        kind="compact",
    )


def _series_rows(package: PackageData, one: Series) -> Iterator[TableRow]:
    numbers = [
        row.number
        for row in package.data.friction_runs
        if (row.report or package.data.friction_tests.report, row.surface)
        == (one.report, one.surface)
    ]
    for count, run in zip(numbers, one.runs, strict=True):
        unknown = math.isnan(run.velocity_mps)
        velocity = ("—", "—") if unknown else package.fmt.cells(run.velocity_mps, Quantity.VELOCITY)
        yield TableRow(
            cells=(
                one.report or "—",
                one.surface.value,
                str(count),
                *velocity,
                number(run.mu, 3),
                number(run.mu_static, 3),
            )
        )
    yield TableRow(
        cells=(
            Wide(f"Mean, {one.surface}, {runs_text(len(one.runs))}", 5),
            number(one.mean, 3),
            number(one.static_mean, 3),
        ),
        kind="total",
    )


def _velocities(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Friction at the sliding velocities of all runs",
        columns=(
            TableColumn(head="Array", align="left", share=0.6),
            TableColumn(head="μ", unit="as run", share=1.5),
            *fmt.columns("Largest velocity", Quantity.VELOCITY, share=0.8),
            *fmt.columns("Tested to", Quantity.VELOCITY, share=0.8),
            TableColumn(head="μ beyond", unit="largest", share=0.9),
            TableColumn(head="μ tested", unit="smallest", share=0.9),
            TableColumn(head="Verdict", align="center", share=1.8),
        ),
        rows=tuple(_velocity_row(package, item) for item in package.assessment.arrays),
        notes=(
            "Beyond: at sliding velocities above those tested. Smallest tested: of the means at"
            " each velocity, of the series that governs for the array; μ beyond may be"
            f" {MU_TOLERANCE:g} larger, for rounding.",
        ),
        kind="compact",
    )


def _velocity_row(package: PackageData, item: ArrayAssessment) -> TableRow:
    fmt, check = package.fmt, velocity_check(package.data, item)
    tested_mps = math.nan if check is None else check.tests.velocity_mps
    unknown = ("not given", "not given") if check else ("no runs", "no runs")
    return TableRow(
        cells=(
            item.id,
            mu_words(item.array.friction),
            *fmt.cells(item.fastest_mps, Quantity.VELOCITY),
            *(unknown if math.isnan(tested_mps) else fmt.cells(tested_mps, Quantity.VELOCITY)),
            *(
                (number(check.mu_beyond, 3), number(check.tests.least_mu, 3), stamp(check.verdict))
                if check
                else ("—", "—", "not compared")
            ),
        )
    )


def _alone(package: PackageData) -> Sequence[str]:
    """Return the design displacements with the low-velocity coefficient alone."""
    fmt, given = package.fmt, package.assessment
    return [
        f"Array {item.id} with μ = {mu_words(item.array.friction)} at every velocity, all motions"
        f" rerun: design displacement {fmt.both(item.design_m)}"
        f"{f' ({NOT_PERMITTED})' if item.has_unpermitted_value else ''} instead of"
        f" {fmt.both(by_id(given.arrays, item.id).design_m)}."
        for item in given.low_velocity.arrays
    ]


def _sentences(package: PackageData) -> Iterator[str]:
    found = tested(package.data)
    tests = package.data.friction_tests
    missing = [label.lower() for label, field in _STATED if not getattr(tests, field)]
    if missing:
        yield f"Not given: {', '.join(missing)}."
    if not found:
        yield (
            "The workbook gives no runs of friction tests: the friction coefficients of the arrays"
            " are as entered and are not compared with tests."
        )
    for report in dict.fromkeys(one.report for one in found):
        yield from _means(package, [one for one in found if one.report == report], report)
    if found:
        yield from _compared(package.data, found)
    for one, fit in _fits(package):
        yield _fit(one, fit)
    beyond = (row for row in package.assessment.rows if row.id == VELOCITY_ROW)
    rows = (*friction_rows(package.data), *beyond)
    unsatisfied = dict.fromkeys(row.title for row in rows if not row.is_satisfied)
    if unsatisfied:
        yield f"Conditions: not satisfied are {', '.join(f'“{title}”' for title in unsatisfied)}."


def _means(package: PackageData, found: Sequence[Series], report: str) -> Iterator[str]:
    several = len(tested(package.data)) > len(found)
    place = f"Report {report or 'without a number'}: kinetic" if several else "Kinetic"
    least = min(found, key=lambda one: one.mean)
    means = ", ".join(
        f"{number(one.mean, 3)} {one.surface} ({runs_text(len(one.runs))})" for one in found
    )
    if len(found) > 1:
        smaller = f"{number(least.mean, 3)} {least.surface}"
        yield f"{place} mean {means}; the smaller, {smaller}, governs."
    else:
        other = next(surface for surface in Surface if surface is not least.surface)
        yield f"{place} mean {means}; no {other} runs are given."
    few: dict[str, list[str]] = {}
    for one in found:
        if not has_enough_runs(one):
            few.setdefault(runs_by_velocity(one, package.fmt.us_first), []).append(one.surface)
    for runs, surfaces in few.items():
        those = " and ".join(surfaces).capitalize()
        yield f"{those}: {runs}; {LEAST_RUNS} at each velocity are required."


def _compared(data: ProjectInput, found: Sequence[Series]) -> Iterator[str]:
    """Yield how the friction of each array compares with the tests, alike arrays together."""
    ids: dict[str, list[str]] = {}
    for array in data.arrays:
        ids.setdefault(_array(data, array, found), []).append(array.id)
    for text, names in ids.items():
        yield f"Array{'s' if len(names) > 1 else ''} {', '.join(names)}: {text}"


def _array(data: ProjectInput, array: Array, found: Sequence[Series]) -> str:
    one = governing(found, array.mu_report)
    used = one.mean_of(array.friction)
    what = (
        f"mean of μ(v) at the tested velocities {number(used, 3)}"
        if array.friction.is_by_velocity
        else (f"μ = {number(used, 3)}")
    )
    gap = round(round(used, 3) - round(one.mean, 3), 3)
    compared = (
        "equal to" if gap == 0.0 else f"{number(abs(gap), 3)} {'below' if gap < 0.0 else 'above'}"
    )
    more = ", within the rounding of two decimals" if gap > 0.0 else ""
    return (
        f"{what}, {compared} the tested mean {number(one.mean, 3)}"
        f" ({one.surface}){more}; {basis_words(data, array)}."
    )


def _fits(package: PackageData) -> Iterator[tuple[Series, FittedLaw]]:
    """Yield the laws fitted to the runs of the governing report, by condition."""
    found = tested(package.data)
    reports = dict.fromkeys(one.report for one in found)
    if len(reports) != 1:
        return
    for one in found:
        fit = fit_law([run.velocity_mps for run in one.runs], [run.mu for run in one.runs])
        if fit is not None:
            yield one, fit


def _fit(one: Series, fit: FittedLaw) -> str:
    velocities = {run.velocity_mps for run in one.runs if not math.isnan(run.velocity_mps)}
    place = f"{one.surface.value.capitalize()}, {len(velocities)} velocities"
    if not fit.is_determined:
        return f"{place}: the runs do not determine a velocity-dependent law."
    used = [run.mu for run in one.runs if not math.isnan(run.velocity_mps)]
    mean = math.fsum(used) / len(used)
    scatter = math.sqrt(math.fsum((mu - mean) ** 2 for mu in used) / len(used))
    law = fit.law
    return (
        f"{place}: least squares gives {number(law.mu_slow, 3)} at low velocity,"
        f" {number(law.mu_fast, 3)} at high velocity and a rate of {number(law.rate_s_per_m, 1)}"
        f" s/m. Root mean square residual {number(fit.rms, 4)}, with one coefficient instead"
        f" {number(scatter, 4)}."
    )
