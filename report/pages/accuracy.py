"""Numerical error on the governing run, and sensitivity to the friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from report.assessment.arrays import ArrayAssessment, DesignBasis, by_id
from report.assessment.evidence import Evidence
from report.assessment.friction import SHIFT, mu_words
from report.assessment.project import Assessment
from report.assessment.sensitivity import Accuracy, Rivals
from report.document.tables import Column, Table, by_place, listed
from report.entities.columns import NO_VALUE
from report.entities.shown import length, required, text, words
from report.pages.parts import PackageData
from report.words.counts import ranged
from report.words.letters import lettered
from report.words.units import number
from solver.model import Status
from solver.rivals.methods import METHODS
from solver.sliding.least_model import Model

_PERCENT = f"{100.0 * SHIFT:.0f} %"


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the page needs beside its chart."""
    accuracy = evidence.accuracy
    rivals, arrays = accuracy.rivals, tuple(_by_array(accuracy))
    return {
        "found": accuracy,
        "percent": _PERCENT,
        "two_axes": Model.TWO_AXES,
        "most_ms": _decade_ms(rivals.seconds),
        "methods": _methods(package, rivals),
        "arrays": arrays,
        "friction": _friction_table(package, arrays),
        "change": _change,
        "n_more_unfinished": _unfinished(accuracy.at_reduced_friction)
        - _unfinished(accuracy.given),
    }


def _decade_ms(seconds: float) -> float:
    """Return a power of ten well above a time [ms], at least 10, for reproducible text."""
    return 10.0 ** max(math.ceil(math.log10(seconds * 1e4)), 1)


def _methods(package: PackageData, rivals: Rivals) -> Table:
    exact = (METHODS["exact"].title, "none", rivals.exact.prd_m, "rounding error")
    others = [
        (
            lettered(run.method.title),
            _parameters(run.parameters),
            run.result.prd_m,
            "failed" if run.failed else number(100.0 * run.error, 3),
        )
        for run in rivals.runs
        if run.is_default
    ]
    columns = by_place(
        words("Method", 3.0),
        words("Parameters", 2.4),
        length("PRD", 0.9),
        text("Error in PRD", "%", 1.1),
    )
    return listed(
        (exact, *others),
        columns,
        package.fmt,
        kind="compact",
        style=lambda row: "total" if row is exact else "",
    )


def _parameters(values: Mapping[str, float]) -> str:
    """Return parameters of a method in words."""
    texts = {
        "substeps": "{:g} sub-steps",
        "stiffness_per_m": "stiffness {:g} /m",
        "velocity_mps": "v0 = {:g} m/s",
        "tolerance": "tolerance {:g}",
    }
    return ", ".join(texts[key].format(value) for key, value in values.items()) or "none"


@dataclass(frozen=True, slots=True)
class _Varied:
    """Arrays that share their runs, by one of them: its friction as given, less and more.

    Without a design displacement as given where no route is permitted.
    """

    ids: Sequence[str]
    given: ArrayAssessment
    at_reduced_friction: ArrayAssessment
    at_increased_friction: ArrayAssessment

    @property
    def is_on_floor(self) -> bool:
        """Whether the floor always governs."""
        arrays = (self.given, self.at_reduced_friction, self.at_increased_friction)
        return all(array.governs is DesignBasis.FLOOR for array in arrays)


def _by_array(accuracy: Accuracy) -> Iterator[_Varied]:
    assessments = (accuracy.given, accuracy.at_reduced_friction, accuracy.at_increased_friction)
    for group in accuracy.given.alike:
        arrays = (by_id(assessment.arrays, group[0].id) for assessment in assessments)
        varied = (replace(array, design_m=array.permitted_m) for array in arrays)
        yield _Varied([array.id for array in group], *varied)


def _friction_table(package: PackageData, arrays: Sequence[_Varied]) -> Table:
    columns = (
        (words("Array", 1.2), lambda row: ranged(row.ids)),
        (text("μ", share=1.1), lambda row: mu_words(row.given.array.friction)),
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
