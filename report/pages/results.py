"""Results by array: every run of every motion, the statistics, and the design displacement."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain
from operator import attrgetter, methodcaller

from markupsafe import Markup

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.friction import mu_words
from report.assessment.support.evidence import Evidence
from report.document.columns import ColumnHead, required, text, words
from report.document.tables import Column, Table, TableRow, Wide, listed
from report.pages.histories import axes
from report.pages.parts import PackageData, bar, statistic
from report.project.model.choices import Direction
from report.runs import MotionRun
from report.text.names import named
from report.text.unit_format import UnitFormat
from report.text.units import no_less, number
from solver.model import Orientation, Status

_Alike = Sequence[ArrayAssessment]
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
    groups = ([item.id for item in group] for group in package.assessment.alike)
    return tuple((f"results-{n}", named(ids, "Array")) for n, ids in enumerate(groups, start=1))


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the results of every group of arrays that share their runs, without the charts."""
    done = package.assessment
    return {
        "has_transverse": any(motion.has_transverse for motion in done.shaking.motions),
        "groups": [_results(package, group) for group in done.alike],
        "axes": axes(chain.from_iterable(evidence.histories)),
    }


def _results(package: PackageData, group: _Alike) -> Mapping[str, object]:
    array, runs = group[0], group[0].runs
    # Every one that any motion is run in: motions may differ in their components and polarities.
    orientations = sorted(
        {run.orientation for run in runs}, key=lambda way: (way.is_transverse, -way.polarity)
    )
    slope_rad = array.array.slope_rad
    return {
        "slope": f"{number(math.degrees(slope_rad), 2)}° "
        f"({number(100.0 * math.tan(slope_rad), 1)}%)",
        "mu": mu_words(array.array.friction),
        # Arrays share their runs by what a run takes; of what they are built the runs know nothing.
        "constructions": "; ".join(dict.fromkeys(item.array.construction for item in group)),
        "spread": _spread(array),
        "peaks": _peaks(package, group, orientations),
        "is_prd_across": not all(run.has_across for run in runs),
        "troubles": package.sentences("runs", [item.id for item in group]),
    }


def _spread(array: ArrayAssessment) -> str:
    """Return the spread of the motions of an array about their mean; nothing if unknown."""
    mean_m = array.analysis.mean_m
    if not mean_m > 0.0:
        return ""
    in_order = sorted(array.motions, key=lambda motion: motion.governing.prd_m)
    smallest, largest = in_order[0], in_order[-1]
    orientation = largest.governing.orientation.name
    ratios = [number(run.governing.prd_m / mean_m, 2) for run in (smallest, largest)]
    return (
        f"{largest.motion.id} ({orientation}) has the largest PRD, {ratios[1]} times the mean; "
        f"{smallest.motion.id} has the smallest, {ratios[0]} times. Coefficient of variation "
        f"{number(array.variation, 2)}."
    )


def _peaks(package: PackageData, group: _Alike, orientations: Sequence[Orientation]) -> Table:
    """Return the runs of every motion, and below them the statistics and the design value."""
    fmt, changed = package.fmt, package.changes.values
    unit = fmt.units()[0].symbol

    def in_first(head: str, below: str) -> ColumnHead:
        """Return the format of a length in the preferred system only."""
        return ColumnHead(head=f"{head}, {unit}", unit=below, text=partial(fmt.first, show=no_less))

    columns: list[Column] = [
        (words("Motion"), attrgetter("motion.id")),
        *(
            (
                text(f"PRD of each run, {unit}", _short(orientation), 0.95),
                partial(_peak, fmt, orientation),
            )
            for orientation in orientations
        ),
        (required("Governing PRD", 1.08), attrgetter("governing.prd_m")),
        *((in_first("Largest of all runs", d.value), methodcaller("peak_m", d)) for d in _WAYS),
        (in_first("Residual", "downslope"), attrgetter("governing.result.residual_m")),
        (in_first("Residual", "cross-slope"), attrgetter("governing.result.residual_across_m")),
        (text("Time", "s", 0.85), lambda run: number(run.governing.result.t_prd_s, 2)),
        (text("N/W", share=1.2), lambda run: number(run.governing.result.n_min_g, 2)),
        (words("Status", 1.05), lambda run: _SHORT[run.governing.result.status]),
    ]
    table = listed(
        group[0].motions,
        columns,
        fmt,
        kind="compact",
        style=lambda run: bar(any((item.id, run.motion.id) in changed for item in group)),
    )
    return replace(table, rows=(*table.rows, *_statistics(package, group, len(orientations))))


def _short(orientation: Orientation) -> str:
    return f"{'tr.' if orientation.is_transverse else 'rec.'} {orientation.name[-1]}"


def _peak(fmt: UnitFormat, orientation: Orientation, motion: MotionRun) -> str:
    """Return the PRD of one run in the first unit; blank where the motion has no such run."""
    for run in motion.runs:
        if run.orientation == orientation:
            peak = fmt.first(run.prd_m, show=no_less)
            return Markup("<b>{}</b>").format(peak) if run is motion.governing else peak
    return ""


def _statistics(package: PackageData, group: _Alike, runs: int) -> Iterator[TableRow]:
    array, fmt = group[0], package.fmt
    analysis, head = array.analysis, required("")
    factor = f"{statistic(analysis.basis)}, {package.marks.clause('analysis_factor')}"
    floor_m = array.floor_m or math.nan  # peer review removes it
    floor = "none; the analysis is peer reviewed"
    if not package.data.is_peer_reviewed:
        share = number(100.0 * package.assessment.rules["analysis_floor"], 0)
        floor = f"{share}% of prescriptive, {package.marks.clause('analysis_floor')}"
    # The keys are those of results.json, by which changes are known.
    rows: Sequence[tuple[str, str, float, str, str]] = (
        ("mean_prd_m", "Mean", analysis.mean_m, "", "of the motions"),
        ("largest_prd_m", "Largest", analysis.largest_m, "", "of the motions"),
        ("computed_m", f"Analysis: {factor}", analysis.value_m, array.overridden.analysis, ""),
        ("floor_m", f"Floor: {floor}", floor_m, package.marks.floor(array), ""),
        (
            "design_m",
            "Design",
            array.design_m,
            package.marks.design(array),
            f"governed by: {array.source}",
        ),
    )
    for key, label, value_m, mark, about in rows:
        is_changed = any((item.id, key) in package.changes.values for item in group)
        yield TableRow(
            cells=(
                Wide(label, 1 + runs),
                *head.cells(value_m, fmt.none, head.units(fmt), mark),
                # After the directions come two residuals, the time, N/W and the status.
                Wide(about, len(_WAYS) + 5),
            ),
            kind=bar(is_changed, "total"),
        )
