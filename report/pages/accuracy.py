"""Numerical error of the governing run, and sensitivity to the friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from report.assessment.arrays import ArrayAssessment, by_id
from report.assessment.evidence import Evidence
from report.assessment.friction import SHIFT, mu_words
from report.assessment.project import Assessment
from report.assessment.sensitivity import Accuracy
from report.document.tables import Column, Table, listed
from report.entities.columns import NO_VALUE
from report.entities.shown import required, text, words
from report.pages import uncertainty
from report.pages.parts import PackageData
from report.words.counts import ranged
from report.words.units import number
from solver.model import Status
from solver.sliding.least_model import Model

_PERCENT = f"{100.0 * SHIFT:.0f} %"


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the page needs beside the package."""
    accuracy = evidence.accuracy
    return {
        "found": accuracy,
        "margins": uncertainty.margins(package, evidence),
        "percent": _PERCENT,
        "no_slip": Model.NO_SLIP,
        "two_axes": Model.TWO_AXES,
        "friction": _friction_table(package, tuple(_by_array(accuracy))),
        "n_more_unfinished": _unfinished(accuracy.at_reduced_friction)
        - _unfinished(accuracy.given),
    }


@dataclass(frozen=True, slots=True)
class _Varied:
    """Arrays that share their runs, by one of them: its friction as given, less and more.

    Without a design displacement as given where no route is permitted.
    """

    ids: Sequence[str]
    given: ArrayAssessment
    at_reduced_friction: ArrayAssessment
    at_increased_friction: ArrayAssessment


def _by_array(accuracy: Accuracy) -> Iterator[_Varied]:
    assessments = (accuracy.given, accuracy.at_reduced_friction, accuracy.at_increased_friction)
    for group in accuracy.given.alike:
        arrays = (by_id(assessment.arrays, group[0].id) for assessment in assessments)
        varied = (replace(array, design_m=array.permitted_m) for array in arrays)
        yield _Varied([array.id for array in group], *varied)


def _friction_table(package: PackageData, arrays: Sequence[_Varied]) -> Table:
    columns = (
        (words("Array", 1.2), lambda row: ranged(row.ids)),
        (text("μ", share=package.mu_share), lambda row: mu_words(row.given.array.friction)),
        _design(package, f"{_PERCENT} less", lambda row: row.at_reduced_friction),
        _design(package, "As given", lambda row: row.given),
        _design(package, f"{_PERCENT} more", lambda row: row.at_increased_friction),
        (
            text("Change", f"{_PERCENT} less"),
            lambda row: _change(row.at_reduced_friction.design_m, row.given.design_m),
        ),
        (
            text("Change", f"{_PERCENT} more"),
            lambda row: _change(row.at_increased_friction.design_m, row.given.design_m),
        ),
    )
    return listed(arrays, columns, package.fmt, kind="compact")


def _design(package: PackageData, head: str, which: Callable[[_Varied], ArrayAssessment]) -> Column:
    return (
        required(head),
        lambda row: which(row).design_m,
        lambda row: package.design_mark(which(row)),
    )


def _change(value: float, given: float) -> str:
    if math.isnan(value) or not given > 0.0:
        return NO_VALUE if math.isnan(value) or math.isnan(given) else "—"
    share = 100.0 * (value / given - 1.0)
    return f"{'+' if share > 0.05 else ''}{number(share, 1)} %"


def _unfinished(assessment: Assessment) -> int:
    runs = (run for a in assessment.arrays for motion in a.motions for run in motion.runs)
    return sum(run.result.status is Status.SLIDING_AT_END for run in runs)
