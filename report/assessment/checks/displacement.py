"""Requirements on the displacement of an array: a value, runs that end, no tipping."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from report.assessment.checks.capacities import slack_check
from report.assessment.checks.check import THIS_PROGRAM, Check, Sense
from report.assessment.design.routes import Route, lacking_motions, statistic_basis
from report.text.amounts import Amount, capacity, demand
from report.text.letter_case import lowered
from report.text.names import ranged
from report.text.units import NO_BREAK, Quantity, no_less, pair
from solver.model import Status
from solver.rules.provisions import review_lifts_slope
from solver.rules.rulesets import RuleSet

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.arrays import ArrayAssessment
    from report.assessment.design.linked_blocks import LinkedArray
    from report.runs import OrientedRun


MORE_MOTIONS = "Complete or replace the motions."


def of_array(done: Assessment, item: ArrayAssessment) -> Iterator[Check]:
    """Yield whether an array has a design displacement, comes to rest and stays flat."""
    yield _design(done, item)
    if item.runs:
        yield from run_checks(item, done.project.us_first)
    yield _tipping(item)
    index = [other_array.id for other_array in done.arrays].index(item.id)
    yield slack_check(item.array, item.permitted_m, index)


def _design(done: Assessment, item: ArrayAssessment) -> Check:
    remedy = _way_out(done, item)
    if item.lacks_motions:
        basis, count = statistic_basis(done.project), len(done.shaking.motions)
        return no_design(done.rules, [item.id], lacking_motions(done.rules, basis, count), remedy)
    none = no_design(done.rules, [item.id], f"by the {item.route} procedure", remedy)
    if math.isnan(item.design_m):
        return none
    design = demand(item.design_m, Quantity.DISPLACEMENT, item.overridden.design)
    return replace(none, found=design, note=item.source, is_satisfied=item.is_permitted)


def no_design(rules: RuleSet, arrays: Sequence[str], why: str, remedy: str) -> Check:
    """Return the check that arrays have no design displacement, with the reason."""
    return Check(
        id="design",
        title="Design displacement",
        subject=ranged(arrays),
        arrays=tuple(arrays),
        found="none",
        note=why,
        limit="a displacement from a permitted procedure",
        clause=rules.name,
        is_satisfied=False,
        remedy=remedy,
    )


def _way_out(done: Assessment, item: ArrayAssessment) -> str:
    """Return how to obtain a permitted displacement: motions, if the project has none."""
    if done.has_motions:
        # Runs that do not come to rest, and slopes, have checks of their own.
        is_of_motions = item.lacks_motions or not done.acceptance.qualifies
        is_analyzed = item.route is Route.ANALYSIS
        return MORE_MOTIONS if is_analyzed and is_of_motions else ""
    is_lifted = review_lifts_slope(done.rules, done.project.site.sdc)
    if not (item.limits.may_be_analyzed or is_lifted):
        return ""
    review = "" if item.limits.may_be_analyzed else " with peer review"
    return f"Enter motions on the Motions worksheet, for an analysis{review}."


_WOULD_DO = {
    Status.SLIDING_AT_END: "Enter a longer record, or Zero padding on the Motions worksheet.",
    Status.UPLIFT: "Replace the motion.",
    Status.DIVERGED: "Replace the motion.",
    Status.STEP_LIMIT: "Replace the motion.",
}


def _would_do(run: OrientedRun) -> str:
    status, scene = run.result.status, run.scene
    # At μ = tan θ friction just balances gravity along the slope: a block that slides after the
    # motion never slows down, and zero padding does not help.
    if status is Status.SLIDING_AT_END and scene.friction.mu_slow <= math.tan(scene.slope_rad):
        return (
            "Provide more friction: the friction coefficient is not above "
            "tan θ of the roof slope, so that no record is long enough."
        )
    return _WOULD_DO.get(status, "")


def run_checks(item: ArrayAssessment, us_first: bool) -> Iterator[Check]:
    """Yield whether every run of an array comes to rest, one check for each outcome."""
    outcomes: dict[tuple[Status, str], list[OrientedRun]] = {}
    motions: dict[tuple[Status, str], list[str]] = {}
    for motion in item.motions:
        for run in motion.runs:
            key = run.result.status, _would_do(run)
            outcomes.setdefault(key, []).append(run)
            motions.setdefault(key, []).append(motion.motion.id)
    failed = {key: runs for key, runs in outcomes.items() if key[0] is not Status.OK}
    # Once a run fails, those that come to rest need no check of their own.
    for (status, remedy), runs in (failed or outcomes).items():
        outcome = _outcome(status, runs, us_first)
        yield Check(
            id="runs",
            title="Runs that come to rest",
            subject=item.id,
            arrays=(item.id,),
            found=f"{len(runs)} of {len(item.runs)} runs: {outcome}" if failed else "all",
            note=ranged(motions[status, remedy]) if failed else "",
            limit="all",
            clause=THIS_PROGRAM,
            is_satisfied=not failed,
            remedy=remedy,
        )


def _outcome(status: Status, runs: list[OrientedRun], us_first: bool) -> str:
    # Up to its colon a sentence says what happened, and after it what follows.
    words = lowered(status.sentence.split(":")[0])
    if status is Status.UPLIFT:
        return f"{words}, from {min(run.result.t_uplift_s for run in runs):.3f}{NO_BREAK}s on"
    if status is Status.SLIDING_AT_END:
        fastest = max(abs(run.result.end_speed_mps) for run in runs)
        return f"{words}, at {pair(fastest, Quantity.VELOCITY, us_first, no_less)}"
    return words


def _tipping(item: ArrayAssessment) -> Check:
    # Moments about the lower edge of a base b wide: V at the height c against N at b/2.
    return Check(
        id="tipping",
        title="V/N divided by the tipping limit b/(2c)",
        subject=item.id,
        arrays=(item.id,),
        found=demand(item.tipping.ratio),
        note=item.tipping.governs,
        limit=capacity(1.0),
        sense=Sense.AT_MOST,
        clause="rigid-body statics",
        is_satisfied=item.tipping.is_ok,
        remedy="Lower the center of gravity, or increase the support spacing.",
    )


def of_links(linked: LinkedArray) -> Check:
    """Return whether one rigid block is adequate for an array, if the workbook requests it."""
    design, estimated_m = linked.design, linked.estimated_m
    found_value: Amount | str = demand(estimated_m, Quantity.DISPLACEMENT)
    note = "one rigid block does not slide in one axis" if math.isinf(estimated_m) else ""
    if not linked.is_final:
        found_value = "not every block comes to rest"
        lost = (motion for motion in linked.motions if not all(run.is_final for run in motion.runs))
        note = ranged(motion.motion.id for motion in lost)
    elif math.isnan(estimated_m):
        found_value = "none"
    has_limit = not math.isnan(linked.most_m)
    limit = capacity(linked.most_m, Quantity.DISPLACEMENT)
    return Check(
        id="links",
        title="Design displacement as a row of linked blocks",
        subject=design.id,
        arrays=(design.id,),
        found=found_value,
        note=note,
        limit=limit if has_limit else "that of one rigid block",
        sense=Sense.AT_MOST if has_limit else Sense.STATED,
        clause=THIS_PROGRAM,
        # That the design is permitted is a check of its own.
        is_satisfied=linked.is_final and linked.is_within,
        remedy="Provide stiffer links between the parts of the array.",
    )
