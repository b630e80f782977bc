"""Results by array, and the comparison with the prescriptive displacement."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from report.assessment.arrays import ArrayAssessment
from report.assessment.friction import mu_words
from report.assessment.run_warnings import run_warnings
from report.assessment.runs import MotionRun
from report.document.tables import Table, TableRow, Wide
from report.entities.columns import TableColumn
from report.pages.limits import analysis_faults, check_table
from report.pages.parts import PackageData, statistic
from report.sheet.schema import Direction
from report.words.units import number
from solver.model import Heading, Status

PEAK_ROWS = 16
"""The PRDs of usual suites stay on one page, with their mean and the design value."""

_WAYS = (Direction.DOWN, Direction.UP, Direction.ACROSS)
_SHORT = {
    Status.OK: "at rest",
    Status.SLIDING_AT_END: "sliding",
    Status.UPLIFT: "uplift",
    Status.DIVERGED: "no result",
    Status.STEP_LIMIT: "no result",
}


def below(package: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    arrays = enumerate(package.assessment.arrays, start=1)
    return tuple((f"results-{count}", f"Array {array.id}") for count, array in arrays)


def page(package: PackageData) -> Mapping[str, object]:
    """Return the results of every array, without the charts."""
    return {
        "meaning": "PRD is the largest distance in plan from the starting position, relative to "
        "the roof; down, up and across are the largest displacements downslope, upslope and "
        "cross-slope. Time is that of the PRD, N/(m g) the minimum of the governing run. The file "
        "results.xlsx has every run in both systems of units.",
        "arrays": [array_results(package, array) for array in package.assessment.arrays],
    }


def array_results(package: PackageData, array: ArrayAssessment) -> Mapping[str, object]:
    """Return the table of one array and the texts above and below it."""
    return {
        "table": _peaks(package, array),
        "facts": f"{_facts(array)} {_spread(array)}".rstrip(),
        "troubles": run_warnings([array], package.fmt.us_first),
    }


def _facts(assessed: ArrayAssessment) -> str:
    array = assessed.array
    return (
        f"Slope {number(math.degrees(array.slope_rad), 2)}° "
        f"({number(100.0 * math.tan(array.slope_rad), 1)} %), μ = {mu_words(array.friction)}, "
        f"{array.construction}."
    )


def _spread(array: ArrayAssessment) -> str:
    """Return the motions farthest from the mean; nothing where there is no mean."""
    if not array.analysis.mean_m > 0.0:
        return ""
    ordered = sorted(array.motions, key=lambda run: run.governing.prd_m)
    least, most = ordered[0], ordered[-1]
    return (
        f"Motion {most.motion.id} ({most.governing.heading.name}) governs with "
        f"{_over_mean(array, most)} times the mean PRD; the smallest is {least.motion.id} with "
        f"{_over_mean(array, least)} times. Coefficient of variation {number(array.variation, 2)}."
    )


def _over_mean(array: ArrayAssessment, run: MotionRun) -> str:
    mean = array.analysis.mean_m
    return number(run.governing.prd_m / mean, 2) if mean > 0.0 else "—"


def _peaks(package: PackageData, array: ArrayAssessment) -> Table:
    fmt, headings = package.fmt, _headings(array)
    first = fmt.units()[0].symbol
    return Table(
        caption=f"Array {array.id}: PRD of every motion in every run",
        columns=(
            TableColumn(head="Motion", align="left"),
            *(
                TableColumn(head=f"PRD of each run, {first}", unit=_short(heading), share=0.95)
                for heading in headings
            ),
            *fmt.columns("Governing PRD", share=1.08),
            *(TableColumn(head=f"Largest of all runs, {first}", unit=d.value) for d in _WAYS),
            *(TableColumn(head=f"Residual, {first}", unit=way) for way in ("down", "across")),
            TableColumn(head="Time", unit="s", share=0.85),
            TableColumn(head="N/(m g)", share=1.2),
            TableColumn(head="Status", align="left", share=1.05),
        ),
        rows=(
            *(_motion_row(package, array, run, headings) for run in array.motions),
            *_statistics(package, array, len(headings)),
        ),
        notes=(
            f"{_meaning(headings)}; bold: the governing run, to which the columns to the right "
            f"belong. Largest of all runs: {_use(array)}.",
            *_stand_in(package, array),
        ),
        kind="compact",
        whole_rows=PEAK_ROWS,
    )


def _use(array: ArrayAssessment) -> str:
    """Return whether clearances take the displacements by direction."""
    return "clearances are based on these" if array.by_direction else "for information"


def _stand_in(package: PackageData, array: ArrayAssessment) -> Sequence[str]:
    """Return that the PRD is used as the cross-slope displacement, where it is."""
    runs = [run for motion in array.motions for run in motion.runs]
    if all(run.has_across for run in runs):
        return ()
    part = package.part("model")
    return (f"For a run in one axis ({part}), its PRD is used as the cross-slope displacement.",)


def _headings(array: ArrayAssessment) -> tuple[Heading, ...]:
    """Return every run that any motion has, in order."""
    seen = {run.heading: None for motion in array.motions for run in motion.runs}
    return tuple(sorted(seen, key=lambda heading: (heading.swapped, -heading.sign)))


def _short(heading: Heading) -> str:
    return f"{'tr.' if heading.swapped else 'rec.'} {heading.name[-1]}"


def _meaning(headings: Sequence[Heading]) -> str:
    """Return the meaning of the run headings."""
    two = "; tr.: the transverse component" if any(h.swapped for h in headings) else ""
    return f"Rec.: the horizontal record along the slope{two}; −: reversed"


def _motion_row(
    package: PackageData, array: ArrayAssessment, run: MotionRun, headings: Sequence[Heading]
) -> TableRow:
    fmt, result = package.fmt, run.governing.result
    return TableRow(
        cells=(
            run.motion.id,
            *(_peak(package, run, heading) for heading in headings),
            *fmt.cells(run.governing.prd_m),
            *(fmt.cells(run.peak_m(direction))[0] for direction in _WAYS),
            *(fmt.cells(value)[0] for value in (result.residual_m, result.residual_across_m)),
            number(result.t_prd_s, 2),
            number(result.n_min_g, 2),
            _SHORT[result.status],
        ),
        kind=package.bar((array.id, run.motion.id) in package.changes.values),
    )


def _peak(package: PackageData, run: MotionRun, heading: Heading) -> str:
    """Return the PRD of one run in the first unit; blank where the motion has no such run."""
    for heading_run in run.runs:
        if heading_run.heading == heading:
            text = package.fmt.cells(heading_run.prd_m)[0]
            return Markup("<b>{}</b>").format(text) if heading_run is run.governing else text
    return ""


def _statistics(package: PackageData, array: ArrayAssessment, runs: int) -> Sequence[TableRow]:
    analysis, rules = array.analysis, package.assessment.rules
    factor = rules.values["analysis_factor"].clause + package.mark("analysis_factor")
    floor = rules.values["analysis_floor"].clause + package.mark("analysis_floor")
    ways = [array.directions[direction] for direction in _WAYS]
    toward = [array.design_toward_m(direction) for direction in _WAYS]
    lines: tuple[tuple[str, str, float, str, str, list[float]], ...] = (
        (
            "mean_prd_m",
            "Mean",
            analysis.mean_m,
            "",
            "of the motions",
            [way.mean_m for way in ways],
        ),
        (
            "largest_prd_m",
            "Largest",
            analysis.largest_m,
            "",
            "of the motions",
            [way.largest_m for way in ways],
        ),
        (
            "computed_m",
            f"Analysis: {statistic(analysis.basis)}, {factor}",
            analysis.value_m,
            array.mark(_analysis_m),
            "",
            [way.value_m for way in ways],
        ),
        (
            "floor_m",
            f"Floor: {_floor_words(package, floor)}",
            package.floor_m(array),
            package.floor_mark(array),
            "",
            [package.floor_m(array)] * len(ways),
        ),
        (
            "design_m",
            "Design",
            array.design_m,
            package.design_mark(array),
            f"governed by: {array.source}",
            toward,
        ),
    )
    marks = {"design_m": [array.toward_mark(direction) for direction in _WAYS]}
    return [
        TableRow(
            cells=(
                Wide(label, 1 + runs),
                *package.fmt.cells(value, mark=mark),
                *(
                    package.fmt.cells(excursion)[0] + toward
                    for excursion, toward in zip(
                        excursions, marks.get(key, [""] * len(ways)), strict=True
                    )
                ),
                Wide(words, 5),
            ),
            kind=package.bar((array.id, key) in package.changes.values, "total"),
        )
        for key, label, value, mark, words, excursions in lines
    ]


def _analysis_m(array: ArrayAssessment) -> float:
    return array.analysis.value_m


def _floor_words(package: PackageData, clause: str) -> str:
    if package.data.options.peer_reviewed:
        return "none; the analysis is peer reviewed"
    share = number(100.0 * package.assessment.rules["analysis_floor"], 0)
    return f"{share} % of prescriptive, {clause}"


def comparison(package: PackageData) -> Mapping[str, object]:
    """Return what the comparison with the prescriptive displacement needs beside the arrays."""
    arrays = package.assessment.arrays
    checks = [(f"Array {item.id}", check) for item in arrays for check in item.prescriptive_checks]
    return {
        "faults": {item.id: analysis_faults(package, item) for item in arrays},
        "routes": check_table(
            "Limits of the prescriptive route", package, checks, ("satisfied", "not satisfied")
        ),
    }
