"""Friction as tested: the report, its runs and means, and what is missing.

Nothing here is canned: every sentence follows from the sheet Friction tests.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from report.assessment.checks.check import VELOCITY_ROW
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import by_id
from report.assessment.design.friction import mu_words
from report.assessment.design.tested_friction import MOST_BEYOND, tested
from report.assessment.design.velocity_check import velocity_check
from report.assessment.design.verdict import Verdict
from report.assessment.design.words import NOT_GIVEN
from report.document.columns import ColumnHead, centered, text, words
from report.document.tables import Table, Wide, by_place, listed, stamp
from report.pages.parts import PackageData
from report.project.check.friction_faults import MU_TOLERANCE
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.friction_report import FrictionTests
from report.text.counts import ids_by, numbered
from report.text.units import Quantity, no_less, number
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
    """Return what the part on friction as tested needs beside its chart."""
    data, assessment = package.data, package.assessment
    all_series, tests = tested(data), data.friction_tests
    return {
        "is_reported": tests != FrictionTests(),
        "report": [(label, getattr(tests, field) or NOT_GIVEN) for label, field in _STATED],
        "tested_pa": tests.contact_pressure_pa,
        "pressures": _pressures(data),
        "runs": _runs(package),
        "n_drawn": _n_drawn(data),
        "reports": [
            _means([series for series in all_series if series.report == report])
            for report in dict.fromkeys(series.report for series in all_series)
        ],
        "compared": _compared(package, all_series) if all_series else {},
        "fits": [(series, fit, _scatter(series)) for series, fit in _fits(package)],
        "velocities": _velocities(package) if assessment.has_motions else None,
        "tolerance": MU_TOLERANCE,
        "most_beyond": MOST_BEYOND,
        "alone": [
            (item, by_id(assessment.arrays, item.id).design_m)
            for item in assessment.low_velocity.arrays
        ],
    }


def _pressures(data: ProjectInput) -> Mapping[float | None, Sequence[str]]:
    """Return the arrays by the contact pressure of their supports [Pa]; empty if none is known."""
    pressures = ids_by(data.arrays, lambda array: array.contact_pressure_pa)
    is_given = data.friction_tests.contact_pressure_pa or any(pressures)
    return pressures if is_given else {}


def drawings(package: PackageData) -> Sequence[str]:
    """Return the runs over velocity, where any reports it and an array slides at one."""
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


def _means(all_series: Sequence[Series]) -> Mapping[str, object]:
    """Return the series of a report, the smallest mean, and the condition without runs."""
    least = min(all_series, key=lambda series: series.mean)
    other = next(surface for surface in Surface if surface is not least.surface)
    return {"series": all_series, "least": least, "other": other}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Compared:
    """The friction of an array and the tested mean, as printed."""

    is_by_velocity: bool
    used: float
    tested: float
    surface: Surface
    basis: str

    @property
    def above(self) -> float:
        """How far the friction is above the tested mean."""
        return round(self.used - self.tested, 3)


def _compared(package: PackageData, series: Sequence[Series]) -> Mapping[_Compared, Sequence[str]]:
    """Return how the friction of the arrays compares with the tests, alike arrays together."""

    def compared(array: Array) -> _Compared:
        test_series = governing(series, array.mu_report)
        return _Compared(
            is_by_velocity=array.friction.is_by_velocity,
            # As printed: a difference that the page does not show is none.
            used=round(test_series.mean_of(array.friction), 3),
            tested=round(test_series.mean, 3),
            surface=test_series.surface,
            basis=package.friction_basis(array),
        )

    return ids_by(package.data.arrays, compared)


def _fits(package: PackageData) -> Iterator[tuple[Series, FittedLaw]]:
    """Yield the laws fitted to the runs of the governing report, by condition."""
    all_series = tested(package.data)
    reports = dict.fromkeys(series.report for series in all_series)
    if len(reports) != 1:
        return
    for series in all_series:
        fit = fit_law([run.velocity_mps for run in series.runs], [run.mu for run in series.runs])
        if fit is not None:
            yield series, fit


def _scatter(series: Series) -> tuple[int, float]:
    """Return the number of velocities of a series, and the scatter about one coefficient."""
    runs = [run for run in series.runs if not math.isnan(run.velocity_mps)]
    mean = math.fsum(run.mu for run in runs) / len(runs)
    scatter = math.sqrt(math.fsum((run.mu - mean) ** 2 for run in runs) / len(runs))
    return len({run.velocity_mps for run in runs}), scatter
