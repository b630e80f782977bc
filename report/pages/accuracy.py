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
from report.assessment.design.friction import SHIFT, mu_words, with_mu
from report.assessment.support.evidence import Evidence
from report.assessment.support.further_runs import Cumulative
from report.assessment.support.shifted_friction import Accuracy
from report.assessment.support.uncertainty import Margin, Uncertainty
from report.document.columns import length, required, text, words
from report.document.tables import Column, Table, listed, merged
from report.pages.parts import PackageData
from report.runs import OrientedRun
from report.text.error_text import below_mm
from report.text.letter_case import lowered
from report.text.names import named, ranged
from report.text.unit_format import NO_VALUE, UnitFormat
from report.text.units import number
from solver.errors import DefectError
from solver.model import Status
from solver.rules.provisions import Neighbor
from solver.sliding.model_selection import Model


def page(package: PackageData, evidence: Evidence) -> Mapping[str, object]:
    """Return the errors, the effect of friction, the margins, and results outside the design."""
    accuracy, uncertainty, sums = evidence.accuracy, evidence.uncertainty, evidence.cumulative
    if uncertainty is None:
        raise DefectError("a package without motions has no page on margins")
    fmt, array = package.fmt, package.assessment.governing
    run, percent = array.worst.governing, f"{100.0 * SHIFT:.0f}%"
    factors = package.data.options.smaller_factors
    # Less friction can leave runs that slide at the end of the record: their peaks are no peaks.
    n_more = _unfinished(accuracy.at_reduced_friction) - _unfinished(accuracy.entered)
    return {
        "array": array.id,
        "motion": array.worst.motion.id,
        "orientation": run.orientation.name,
        "prd": fmt.both_up(run.prd_m),
        "error": _error(run),
        "percent": percent,
        "newly_short": [" to ".join(gap.between) for gap in accuracy.newly_short],
        "is_any_satisfied": any(gap.ok for gap in accuracy.entered.clearances),
        "n_more_unfinished": n_more,
        "newly_limited": [sentence(check, fmt.us_first) for check in accuracy.newly_limited],
        "friction": _friction_table(package, accuracy, percent),
        **_margins(package, uncertainty.margins),
        "used": fmt.both_up(uncertainty.used_m),
        "turned": _turned(uncertainty, fmt),
        "reversed": _reversed(uncertainty, fmt),
        "factors": ", ".join(number(factor, 2) for factor in factors),
        "factor": number(array.analysis.factor, 2) + package.marks.of("analysis_factor"),
        "sums": merged(_sum_table(package, sums)) if sums else None,
    }


def _error(run: OrientedRun) -> str:
    """Return the text on the numerical error of a run."""
    result, model = run.result, run.solution.model
    if result.status is Status.UPLIFT:
        return "the block lifts off the roof; no displacement and no error are reported"
    if math.isnan(run.prd_m):
        return f"no displacement and no error are reported: {result.status.sentence}"
    if model == Model.NO_SLIP:
        return "the array does not slip; the error is rounding error"
    if model >= Model.TWO_AXES:
        # Where friction never decreases with velocity, two nearby solutions do not move apart, and
        # a small error stays small. Otherwise it may grow, so that it is only estimated.
        basis = "a bound" if run.scene.friction.is_monotone else "an estimate from two tolerances"
        return (
            "motion in two axes is computed to a tolerance, and the error of this PRD is below "
            f"{below_mm(result.error_m)} ({basis})"
        )
    return (
        "in one axis the solution is exact, event by event, with at most one step per sampling "
        "interval; the error is rounding error"
    )


def _margins(package: PackageData, margins: Sequence[Margin]) -> Mapping[str, object]:
    """Return the smallest margin of a satisfied clearance, and the clearances without one."""
    # Margins of satisfied clearances only: one that is NG has none to lose.
    have = [margin for margin in margins if margin.gap.ok and not math.isnan(margin.minimum_mu)]
    without = {margin.number for margin in margins} - {margin.number for margin in have}
    unknown = {margin.number for margin in margins if not margin.gap.is_permitted}
    short = sorted(without - unknown)
    is_one = len(short) == 1
    return {
        "margins": merged(_margin_table(package, margins), "No.", "Array", once=True),
        "has_margins": len(margins) > 1,
        "smallest_margin": _smallest_words(have),
        "short": short and f"{_clearances(short)} {'is' if is_one else 'are'}",
        "it": "it" if is_one else "them",
        "unknown": unknown
        and f"{_clearances(sorted(unknown))} {'has' if len(unknown) == 1 else 'have'}",
        "is_alike": any(margin.gap.neighbor is Neighbor.LIKE for margin in margins),
    }


def _clearances(numbers: Sequence[int]) -> str:
    return named([str(number) for number in numbers], "Clearance")


def _smallest_words(margins: Sequence[Margin]) -> str:
    """Return the smallest of the margins in a sentence; nothing without any."""
    if not margins:
        return ""
    if all(margin.is_beyond for margin in margins):
        return "With half of the entered friction, all satisfied clearances remain satisfied."
    # The more of the friction is needed, the smaller the margin.
    smallest = max(margins, key=_share)
    law, percent_less = smallest.array.array.friction, 100.0 * (1.0 - _share(smallest))
    mu_text = f"μ of {smallest.array.id}"
    if percent_less:
        remains = (
            f"It is satisfied with {mu_text} reduced by {number(percent_less, 1)}%, from "
            f"{mu_words(law)} to {_least(smallest)}."
        )
    else:
        slow = " at low velocity" if law.is_by_velocity else ""
        # The search is in hundredths: its first step down fails.
        changed = f"{mu_text}, {mu_words(law)}, reduced by 0.01{slow}"
        remains = f"It is no longer satisfied with {changed}."
    return (
        f"The smallest friction margin is at clearance No. {smallest.number}, "
        f"{' to '.join(smallest.gap.between)}. {remains}"
    )


def _share(margin: Margin) -> float:
    mu = margin.array.array.mu
    # Without friction nothing is left to reduce.
    return margin.minimum_mu / mu if mu > 0.0 else 1.0


def _least(margin: Margin) -> str:
    return mu_words(with_mu(margin.array.array, margin.minimum_mu).friction)


def _margin_table(package: PackageData, margins: Sequence[Margin]) -> Table:
    def lowest(margin: Margin) -> str:
        if math.isnan(margin.minimum_mu):
            return "none"
        return f"≤ {_least(margin)}" if margin.is_beyond else _least(margin)

    columns = (
        (words("No.", 2.6), lambda margin: str(margin.number)),
        (words("Array", 2.6), lambda margin: margin.array.id),
        (text("μ", "entered", package.mu_share),
         lambda margin: mu_words(margin.array.array.friction)),
        (text("μ", "lowest", package.mu_share), lowest),
        (text("Change", "%", 0.6), lambda margin: number(100.0 * (_share(margin) - 1.0), 1)),
        (required("Required at this μ", 0.9),
         lambda margin: "—" if math.isnan(margin.minimum_mu) else margin.required_m),
        (length("Provided", 0.8), lambda margin: margin.gap.clearance.provided_m),
        (words("Limited by", 1.4), lambda margin: lowered(margin.limited_by)),
    )  # fmt: skip
    return listed(margins, columns, package.fmt, kind="compact")


def _sum_table(package: PackageData, sums: Sequence[Cumulative]) -> Table:
    """Return mean and largest sum of each array over the design event and smaller ones."""
    # Of every array: it follows from the number of motions, which they share.
    factor = package.assessment.governing.analysis.factor
    times = f"{number(factor, 2)} × "
    columns = (
        (words("Array"), lambda item: item.array.id),
        (required(f"{times}mean sum"), lambda item: factor * item.mean_m),
        (required(f"{times}largest sum"), lambda item: factor * item.largest_m),
        (required("Design displacement"), lambda item: item.array.design_m),
    )
    return listed(sums, columns, package.fmt, kind="compact")


def _turned(uncertainty: Uncertainty, fmt: UnitFormat) -> str:
    """Return the result of other angles of the horizontal pair, as a clause."""
    if not uncertainty.turned:
        return "the motion has one horizontal component, so its angle is not varied"
    worst, used_m = uncertainty.worst, uncertainty.used_m
    angle, prd_m = f"{number(worst.angle_deg, 1)}°", worst.result.prd_m
    give = f"rotating the horizontal pair to {len(uncertainty.turned)} more angles gives"
    if math.isnan(prd_m):
        return f"{give} no displacement at {angle}: {worst.result.status.sentence}"
    if not used_m > 0.0:
        return f"{give} PRDs up to {fmt.both_up(prd_m)}"
    smallest_m = min(run.result.prd_m for run in uncertainty.turned)
    return (
        f"{give} {number(smallest_m / used_m, 2)} to {number(prd_m / used_m, 2)} times this PRD "
        f"(largest at {angle})"
    )


def _reversed(uncertainty: Uncertainty, fmt: UnitFormat) -> str:
    """Return the result of a reversed vertical component, as a clause."""
    if not uncertainty.motion.motion.has_vertical:
        return "there is no vertical component to reverse"
    if math.isnan(uncertainty.reversed_m):
        return "reversing the vertical component gives no displacement"
    gives = f"reversing the vertical component gives {fmt.both_up(uncertainty.reversed_m)}"
    if not uncertainty.used_m > 0:
        return gives
    return f"{gives}, {number(uncertainty.reversed_m / uncertainty.used_m, 2)} times this PRD"


def _friction_table(package: PackageData, accuracy: Accuracy, percent: str) -> Table:
    """Return arrays that share their runs, by one of them: friction as given, less and more."""
    assessments = (
        accuracy.at_reduced_friction,
        accuracy.entered,
        accuracy.at_increased_friction,
    )
    heads = (f"{percent} less", "As entered", f"{percent} more")

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
                lambda group, k=k: package.marks.design(of(group, k)),
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
    # Up to 0.05 it prints as 0.0, which has no sign.
    return f"{'+' if share > 0.05 else ''}{number(share, 1)}%"


def _unfinished(assessment: Assessment) -> int:
    """Return the number of runs that slide at the end of their record."""
    count = 0
    for array in assessment.arrays:
        count += sum(run.result.status is Status.SLIDING_AT_END for run in array.runs)
    return count
