"""Numerical error of the governing run, and sensitivity to the friction coefficient.

Margins and confidence: clearances, directions, smaller events.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from report.assessment.assessment import Assessment
from report.assessment.checks.sentence import sentence
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import by_id
from report.assessment.design.friction_words import mu_words
from report.assessment.design.other_friction import SHIFT, with_mu
from report.assessment.support.evidence import Evidence
from report.assessment.support.margins import Margin
from report.assessment.support.shifted_friction import Accuracy
from report.assessment.support.smaller_events import Cumulative
from report.document.columns import length, required, text, words
from report.document.tables import Column, Table, listed
from report.pages.parts import PackageData
from report.text.counts import lowered, ranged
from report.text.unit_format import NO_VALUE
from report.text.units import number
from solver.model import DefectError, Status
from solver.rules.provisions import Neighbor
from solver.sliding.least_model import Model


def margins(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return margins in friction, other directions, and sums over smaller events."""
    uncertainty, sums = evidence.uncertainty, evidence.cumulative
    if uncertainty is None:
        raise DefectError("a package without motions has no page on margins")
    return {
        "found": uncertainty,
        "margin": _smallest(uncertainty.margins),
        "margins": _margin_table(package, uncertainty.margins),
        "sums": _sum_table(package, sums) if sums else None,
    }


def _smallest(margins: Sequence[Margin]) -> Mapping[str, object]:
    """Return the smallest margin of a satisfied clearance, and the clearances without one."""
    # Margins of satisfied clearances only: one that is NG has none to lose.
    have = [margin for margin in margins if margin.gap.ok and not math.isnan(margin.minimum_mu)]
    without = {margin.number for margin in margins} - {margin.number for margin in have}
    unknown = {margin.number for margin in margins if not margin.gap.is_permitted}
    smallest = max(have, key=_share, default=None)
    return {
        "smallest": smallest,
        "percent_less": 100.0 * (1.0 - _share(smallest)) if smallest else 0.0,
        "least": _least(smallest) if smallest else "",
        "is_beyond": all(margin.is_beyond for margin in have),
        "short": sorted(without - unknown),
        "unknown": sorted(unknown),
        "alike": any(margin.gap.neighbor is Neighbor.LIKE for margin in margins),
    }


def _share(margin: Margin) -> float:
    mu = margin.array.array.mu
    # Without friction nothing is left to reduce.
    return margin.minimum_mu / mu if mu > 0.0 else 1.0


def _least(margin: Margin) -> str:
    return mu_words(with_mu(margin.array.array, margin.minimum_mu).friction)


def _margin_table(package: PackageData, margins: Sequence[Margin]) -> Table:
    def least(margin: Margin) -> str:
        if math.isnan(margin.minimum_mu):
            return "none"
        return f"≤ {_least(margin)}" if margin.is_beyond else _least(margin)

    columns = (
        (words("No.", 0.8), lambda margin: str(margin.number)),
        (words("Array", 0.8), lambda margin: margin.array.id),
        (text("μ", "given", package.mu_share),
         lambda margin: mu_words(margin.array.array.friction)),
        (text("μ", "least", package.mu_share), least),
        (text("Change", "%", 0.9), lambda margin: number(100.0 * (_share(margin) - 1.0), 1)),
        (required("Required there", 0.9),
         lambda margin: "—" if math.isnan(margin.minimum_mu) else margin.required_m),
        (length("Provided", 0.9), lambda margin: margin.gap.clearance.provided_m),
        (words("Limited by", 1.6), lambda margin: lowered(margin.limited_by)),
    )  # fmt: skip
    return listed(margins, columns, package.fmt, kind="compact")


def _sum_table(package: PackageData, sums: Sequence[Cumulative]) -> Table:
    """Return mean and largest sum of each array over the design event and smaller ones."""
    # Of every array: it follows from the number of motions, which they share.
    factor = package.governing.analysis.factor
    times = f"{number(factor, 2)} × "
    columns = (
        (words("Array"), lambda item: item.array.id),
        (required(f"{times}mean sum"), lambda item: factor * item.mean_m),
        (required(f"{times}largest sum"), lambda item: factor * item.largest_m),
        (required("Design displacement"), lambda item: item.array.design_m),
    )
    return listed(sums, columns, package.fmt, kind="compact")


_PERCENT = f"{100.0 * SHIFT:.0f} %"


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return what the page needs beside the package."""
    accuracy = evidence.accuracy
    return {
        "found": accuracy,
        "margins": margins(package, evidence),
        "limited": [sentence(check, package.fmt.us_first) for check in accuracy.newly_limited],
        "percent": _PERCENT,
        "no_slip": Model.NO_SLIP,
        "two_axes": Model.TWO_AXES,
        "friction": _friction_table(package, accuracy),
        # Less friction can leave runs that slide at the end of the record: their peaks are no
        # peaks.
        "n_more_unfinished": _unfinished(accuracy.at_reduced_friction)
        - _unfinished(accuracy.entered),
    }


def _friction_table(package: PackageData, accuracy: Accuracy) -> Table:
    """Return arrays that share their runs, by one of them: friction as given, less and more."""
    assessments = (
        accuracy.at_reduced_friction,
        accuracy.entered,
        accuracy.at_increased_friction,
    )
    heads = (f"{_PERCENT} less", "As given", f"{_PERCENT} more")

    def of(group: Sequence[ArrayAssessment], place: int) -> ArrayAssessment:
        # Without a design displacement as given where no route is permitted.
        array = by_id(assessments[place].arrays, group[0].id)
        return replace(array, design_m=array.permitted_m)

    columns: Sequence[Column] = (
        (words("Array", 1.2), lambda group: ranged(array.id for array in group)),
        (text("μ", share=package.mu_share), lambda group: mu_words(group[0].array.friction)),
        *(
            (
                required(head),
                lambda group, k=k: of(group, k).design_m,
                lambda group, k=k: package.design_mark(of(group, k)),
            )
            for k, head in enumerate(heads)
        ),
        *(
            (
                text("Change", heads[k]),
                lambda group, k=k: _change(of(group, k).design_m, of(group, 1).design_m),
            )
            for k in (0, 2)
        ),
    )
    return listed(accuracy.entered.alike, columns, package.fmt, kind="compact")


def _change(value: float, base: float) -> str:
    if math.isnan(value) or not base > 0.0:
        return NO_VALUE if math.isnan(value) or math.isnan(base) else "—"
    share = 100.0 * (value / base - 1.0)
    return f"{'+' if share > 0.05 else ''}{number(share, 1)} %"


def _unfinished(assessment: Assessment) -> int:
    runs = (run for a in assessment.arrays for motion in a.motions for run in motion.runs)
    return sum(run.result.status is Status.SLIDING_AT_END for run in runs)
