"""Tables of the arrays: of the summary, the letters, the comparison, the schedule for the field.

Computes nothing. Each table is a list of columns over the arrays of the assessment.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from report.assessment.assessment import Assessment
from report.assessment.causes import unshown_cause
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.friction import mu_words
from report.assessment.design.routes import SEAOC, prescriptive_of
from report.assessment.design.separation import ComparedGap
from report.assessment.design.verdict import NOT_GIVEN
from report.assessment.plan.neighbors import PlanNeighbor
from report.assessment.support.plan_gaps import keep_clear, keep_clear_m, keep_clear_mark
from report.document.columns import centered, plain, provided, required, text, weight, words
from report.document.tables import Column, Table, listed, merged
from report.pages.parts import PackageData, bar
from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import Show, no_less, no_more
from solver.rules.provisions import SEPARATION_KEYS, Neighbor


def summary_table(package: PackageData) -> Table:
    """Return the arrays of the first sheet, in one system of units."""
    done = package.assessment
    mu_share = 1.2 * package.mu_share if done.has_motions else 2.0
    columns: list[Column] = [
        (words("Array", 1.1), lambda item: item.id),
        (plain("Slope", 2, "deg", 0.8), lambda item: math.degrees(item.array.slope_rad)),
        (text("μ", share=mu_share), lambda item: mu_words(item.array.friction)),
    ]
    if done.has_motions:
        columns += [
            (text("Model", share=0.7), models_used),
            (required("Analysis"), lambda item: item.analysis.value_m,
             lambda item: item.overridden.analysis),
        ]  # fmt: skip
    columns += [
        (required("Prescriptive"), lambda item: item.prescriptive.value_m,
         package.marks.prescriptive),
        *(() if done.has_motions else _seaoc(package)),
        (required("Design"), lambda item: item.design_m, package.marks.design),
        (words("Governs", 1.9 if done.has_motions else 1.55), lambda item: item.source),
        (text("D/C", share=0.8), lambda item: ratio_words(done, item)),
        # What gives a verdict is a row of its own below.
        (centered("Verdict", 1.3), done.array_verdict),
    ]  # fmt: skip
    return merged(_table(package, columns, systems=1))


def letter_table(package: PackageData) -> Table:
    """Return the arrays of the letter, each with its governing clearance if any is given."""
    done = package.assessment
    columns: list[Column] = [
        (words("Array", 0.7), lambda item: item.id),
        (text("μ", share=0.8), lambda item: mu_words(item.array.friction)),
        (required("Design displ.", 0.8), lambda item: item.design_m, package.marks.design),
        (words("Governed by", 1.3), lambda item: item.source),
    ]
    if done.clearances or done.missing_gaps:
        gaps = {item.id: _gap_cells(done.governing_gap(item.id)) for item in done.arrays}
        columns += [
            (words("Governing clearance", 1.3), lambda item: governing_name(done, item)),
            (required("Required", 0.8), lambda item: gaps[item.id][1],
             lambda item: gaps[item.id][2], lambda item: gaps[item.id][3][1]),
            (provided("Provided", 0.8), lambda item: gaps[item.id][0],
             lambda _: "", lambda item: gaps[item.id][3][0]),
            (text("D/C", share=0.6), lambda item: ratio_words(done, item)),
        ]  # fmt: skip
    columns += [
        (text("Keep clear", share=1.0), lambda item: _keep_clear(done, item)),
        (centered("Verdict", 1.3), done.array_verdict, lambda item: _cause(done, item)),
    ]
    return merged(_table(package, columns), "Array", "Governing clearance")


_SEPARATIONS = {
    "To a similar array": Neighbor.LIKE,
    "To an object or other array": Neighbor.FIXED,
    "To an edge with parapet": Neighbor.PARAPET,
    "To an edge without parapet": Neighbor.EDGE,
}


def permit_table(package: PackageData) -> Table:
    """Return the arrays of the permit letter with four separations, in one system of units."""
    done, marks = package.assessment, package.marks
    columns: list[Column] = [
        (words("Array", 0.9), lambda item: item.id),
        (plain("Slope", 2, "deg", 0.8), lambda item: math.degrees(item.array.slope_rad)),
        (text("μ"), lambda item: mu_words(item.array.friction)),
        (required("Δ", 0.8), lambda item: item.design_m, marks.design),
    ]
    for head, neighbor in _SEPARATIONS.items():
        separation_m = partial(keep_clear_m, done, neighbor=neighbor)
        mark = marks.of(SEPARATION_KEYS[neighbor])
        columns.append((required(head, 1.2), separation_m, lambda _, mark=mark: mark))
    columns.append((centered("Verdict", 1.2), done.array_verdict))
    return _table(package, columns, systems=1)


def comparison_table(package: PackageData) -> Table:
    """Return the displacements of each array by either procedure."""
    arrays = package.assessment.arrays
    columns: list[Column] = [
        (words("Array", 1.1), lambda item: item.id),
        (required("Prescriptive"), lambda item: item.prescriptive.value_m,
         package.marks.prescriptive),
        *_seaoc(package),
        (required("Mean"), lambda item: item.analysis.mean_m),
        (required("Analysis"), lambda item: item.analysis.value_m,
         lambda item: item.overridden.analysis),
    ]  # fmt: skip
    if any(item.floor_m for item in arrays):
        # Peer review removes it.
        columns.append(
            # 0 stands for no floor; NaN prints as none.
            (required("Floor"), lambda item: item.floor_m or math.nan, package.marks.floor)
        )
    columns += [
        (required("Design"), lambda item: item.design_m, package.marks.design),
        (plain("Analysis / prescr.", share=1.15),
         lambda item: item.analysis.value_m / item.prescriptive.value_m),
        (plain("Design / prescr.", share=1.05), lambda item: item.ratio),
        (words("Governs", 1.75), lambda item: item.source),
    ]  # fmt: skip
    return merged(_table(package, columns))


def schedule(package: PackageData) -> Table:
    """Return the schedule of arrays for the construction documents."""
    done = package.assessment
    columns: list[Column] = [
        (words("Array", 1.1), lambda item: item.id),
        (plain("Slope", 2, "deg", 0.8), lambda item: math.degrees(item.array.slope_rad)),
        (text("μ", share=1.2 * package.mu_share), lambda item: mu_words(item.array.friction)),
        (weight("Weight W"), lambda item: item.array.weight_n),
        # NaN, printed as none, unless its procedure is permitted: nothing else may be built by.
        (required("Design displ.", 0.9), lambda item: item.permitted_m, package.marks.design),
        (text("Keep clear", share=1.4), lambda item: _keep_clear(done, item)),
        (weight("Interconnection", show=no_less), lambda item: item.interconnection_n,
         lambda _: package.marks.of("interconnection_sds"), _strength_show),
    ]  # fmt: skip
    if done.has_motions:
        columns.append((required("Residual", 0.9), lambda item: item.residual_m))
    return merged(_table(package, columns))


def _table(package: PackageData, columns: list[Column], systems: int = 2) -> Table:
    changed = package.changes.arrays
    return listed(
        package.assessment.arrays,
        columns,
        replace(package.fmt, systems=systems),
        kind="compact",
        style=lambda item: bar(item.id in changed),
    )


def _seaoc(package: PackageData) -> tuple[Column, ...]:
    """Return the column of the displacement by SEAOC PV1, for information, if the rules differ."""
    done = package.assessment
    if done.rules.name.startswith("SEAOC"):
        return ()
    value_m, mark = prescriptive_of(done.project, SEAOC).value_m, package.marks.seaoc
    return ((required("PV1"), lambda _: value_m, lambda _: mark),)


def models_used(item: ArrayAssessment) -> str:
    """Return the numbers of the models that the runs of an array use; nothing without runs."""
    models = sorted({int(run.solution.model) for run in item.runs})
    # Once where the first and the last are the same.
    return " to ".join(map(str, dict.fromkeys((*models[:1], *models[-1:]))))


def governing_name(done: Assessment, item: ArrayAssessment) -> str:
    """Return the item across the governing gap of an array, or that no clearance is entered."""
    gap = done.governing_gap(item.id)
    if gap is None:
        return "none entered"
    name = gap.across_from(item.id)
    return f"{name} ({NOT_GIVEN})" if isinstance(gap, PlanNeighbor) else name


def ratio_words(done: Assessment, item: ArrayAssessment) -> str:
    """Return the largest D/C of an array, with its mark."""
    gap = done.governing_gap(item.id)
    return gap.ratio_words if gap else "—"


def _gap_cells(gap: ComparedGap | None) -> tuple[float, float, str, tuple[Show, Show]]:
    """Return the provided and required separation [m], the mark of the latter, and their format."""
    if gap is None:
        return math.nan, math.nan, "", (no_more, no_less)
    return gap.provided_m, gap.required_m, gap.mark, gap.shows


def _strength_show(item: ArrayAssessment) -> Show:
    given_n = item.array.interconnection_n
    strength_n = math.nan if given_n is None else given_n
    return shown_in_order(capacity(strength_n), demand(item.interconnection_n))[1]


def _keep_clear(done: Assessment, item: ArrayAssessment) -> str:
    distance = keep_clear(keep_clear_m(done, item), done.project.us_first)
    return distance + keep_clear_mark(done, item)


def _cause(done: Assessment, item: ArrayAssessment) -> str:
    """Return the cause of a verdict NG that is not visible from the numbers next to it."""
    cause = unshown_cause(done, item)
    return f" {cause}" if cause and not done.array_verdict(item).is_permitted else ""
