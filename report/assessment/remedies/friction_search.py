"""Search for the lowest adequate friction of an array; each value is an assessed project.

Read `Trials`, then `search`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from report.assessment.assess import reassess
from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment, Displacement
from report.assessment.design.clearances import ClearanceCheck, check_clearance
from report.assessment.design.friction import with_mu
from report.project.model.roof import Clearance
from solver.model import Status

# Hundredths between the values of each pass of a search: coarse first, as each value takes runs.
STRIDES = (5, 1)


def above(value: float) -> int:
    """Return the first hundredth above a value."""
    # 0.29 in hundredths is 28.999999999999996: the first above it is 30.
    return math.floor(100.0 * value + 1e-6) + 1


def below(value: float) -> int:
    """Return the first hundredth below a value."""
    return math.ceil(100.0 * value - 1e-6) - 1


def search(satisfies: Callable[[int], bool], start: int, end: int) -> tuple[int, ...]:
    """Walk from one value toward another, and return those before the first failure, in order.

    Each pass continues from the last value of the previous one, in smaller steps: where 43 and more
    satisfy, a walk from 60 toward 40 returns 60, 55, 50, 45, 44, 43. No value tried between the
    start and the last one returned fails. Empty if the start fails.
    """
    if not satisfies(start):
        return ()
    way = 1 if end >= start else -1
    satisfied = [start]
    for step in STRIDES:
        while (following := satisfied[-1] + way * step) * way <= end * way and satisfies(following):
            satisfied.append(following)
    return tuple(satisfied)


class Trials:
    """One array under the motions of a project, with other friction, in hundredths."""

    def __init__(self, assessment: Assessment, array: ArrayAssessment) -> None:
        self.assessment = assessment
        self.array = array
        governing = {run.motion.id: [run.governing.orientation.name] for run in array.motions}
        self._of_governing = replace(
            assessment, runs=assessment.runs.knowing({array.id: governing})
        )
        # Several clearances of an array ask for the same ones.
        self._done: dict[tuple[int, bool], ArrayAssessment] = {}

    def satisfies(self, row: Clearance | None, *, mu: int) -> bool:
        """Whether all runs have final values and satisfy a clearance, if any."""
        # The governing orientations alone refute a value at a quarter of the runs.
        return self.may_satisfy(row, mu=mu) and not self.failure(row, mu=mu)

    def may_satisfy(self, row: Clearance | None, *, mu: int) -> bool:
        """Whether the governing orientation of each motion alone satisfies a clearance."""
        return not self.failure(row, mu=mu, every=False)

    def required_m(self, row: Clearance, *, mu: int) -> float:
        """Return the separation that the array requires with all runs [m]."""
        trial = self._tried(mu, every=True)
        return check_alone(self.assessment, trial.id, trial.displacement, row).required_m

    def failure(self, row: Clearance | None, *, mu: int, every: bool = True) -> str:
        """Return the item that fails with all runs, or with the governing ones; else nothing."""
        trial = self._tried(mu, every=every)
        if not is_final(trial):
            return "no final value"
        if self.array.satisfies_limits and not trial.satisfies_limits:
            limits = replace(trial.limits, route=self.array.route)  # not those of another route
            return next(check.title for check in limits.required if not check.ok)
        if row and not check_alone(self.assessment, trial.id, trial.displacement, row).ok:
            return "clearance"
        return ""

    def _tried(self, mu: int, *, every: bool) -> ArrayAssessment:
        """Return the array with all runs, or with the governing orientation of each motion only."""
        which = (mu, every)
        if which not in self._done:
            done = self.assessment if every else self._of_governing
            # Of the array alone: what is near it is compared in `check_alone`.
            # Of the array alone: what is near it is compared in `check_alone`.
            array = with_mu(self.array.array, mu / 100)
            trial = reassess(done, done.project.changed(arrays=(array,), clearances=()))
            (self._done[which],) = trial.arrays
        return self._done[which]


def trials_of(assessment: Assessment) -> Mapping[str, Trials]:
    """Return the trials of each array by its id."""
    return {array.id: Trials(assessment, array) for array in assessment.arrays}


def is_final(array: ArrayAssessment) -> bool:
    """Whether an array has a design value and every run, if any, ended at rest."""
    is_at_rest = all(run.result.status is Status.OK for run in array.runs)
    return is_at_rest and not math.isnan(array.design_m)


def check_alone(
    done: Assessment, name: str, displacement: Displacement, row: Clearance
) -> ClearanceCheck:
    """Return a clearance with one array sliding as specified and all others at rest."""
    slides = {
        item.id: displacement if item.id == name else replace(item.displacement, design_m=0.0)
        for item in involved(done, row)
    }
    return check_clearance(done.project, done.rules, slides, row)


def involved(assessment: Assessment, row: Clearance) -> Sequence[ArrayAssessment]:
    """Return the arrays on both sides of a clearance."""
    return [array for array in assessment.arrays if array.id in (row.array, row.object)]
