"""What would satisfy a clearance or an array marked NG: friction, separation.

Searches with the runs of `report.assessment.trials`; `report.pages.remedies` prints the results.
Read `remedies`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from enum import StrEnum

from report.assessment.arrays import ArrayAssessment, Route
from report.assessment.clearances import ClearanceCheck
from report.assessment.project import THREADS, Assessment
from report.assessment.trials import (
    HUNDREDTH,
    Trials,
    above,
    displaced,
    hundredths,
    involved,
    is_final,
    search,
    single_array_check,
    trials_of,
)
from report.assessment.verdict import Verdict
from report.sheet.schema.scene import Clearance
from solver.friction_tests import MOST_MU
from solver.rules.provisions import Basis


class RemedyKind(StrEnum):
    """Quantity that would have to change."""

    FRICTION = "friction coefficient"
    SEPARATION = "provided separation"


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """One quantity that would satisfy a clearance, or give an array final values, by itself."""

    kind: RemedyKind
    clearance: int  # number of the clearance in the workbook, from 1; 0 for the runs of an array
    array: str  # array whose friction or displacement it is
    given: float  # value in the workbook
    # least coefficient or separation [m] that would do; NaN if none within the search would
    value: float
    resolution: float  # step of the search; 0 for a value that follows from the runs of the package
    # smallest and largest of the values at which all runs satisfied, without failure between
    verified: tuple[float, float]
    n_values: int  # number of values tried from one to the other
    basis: str  # what was varied and what with it; or why no value would do; a clause

    @property
    def exists(self) -> bool:
        """Whether a value would do."""
        return not math.isnan(self.value)


def remedies(assessment: Assessment) -> tuple[Remedy, ...]:
    """Return what would satisfy each clearance marked NG, and each array without final values."""
    with ThreadPoolExecutor(THREADS) as pool:
        return tuple(_all(assessment, pool))


def _all(given: Assessment, pool: Executor) -> Iterator[Remedy]:
    trials = trials_of(given, pool)
    for number, gap in enumerate(given.clearances, start=1):
        if gap.verdict is not Verdict.NG:
            continue
        here = [trials[array.id] for array in involved(given, gap.clearance)]
        short = [one for one in here if not _satisfies(one.array, given, gap.clearance)]
        yield from (_friction(one, number, gap.clearance) for one in short)
        yield _separation(given, number, gap)
    for array in given.arrays:
        if not is_final(array):
            yield _friction(trials[array.id], 0, None)


def _satisfies(array: ArrayAssessment, given: Assessment, row: Clearance) -> bool:
    return is_final(array) and single_array_check(given, given.project, array, row).ok


def _friction(trials: Trials, number: int, row: Clearance | None) -> Remedy:
    """Return the least friction coefficient with which an array satisfies."""
    array = trials.array.array
    start, end = hundredths(MOST_MU), above(array.mu)
    reason = _in_vain(trials, row)
    held: tuple[int, ...] = ()
    if not reason and end <= start:
        held = search(lambda mu: trials.satisfies(row, mu=mu), start, end)
    law = (
        "one coefficient at every velocity"
        if array.friction.is_constant
        else "the friction law scaled as a whole, the coefficient given being that at low velocity"
    )
    least = held[-1] / 100 if held else math.nan
    return Remedy(
        kind=RemedyKind.FRICTION,
        clearance=number,
        array=array.id,
        given=array.mu,
        value=least,
        resolution=HUNDREDTH,
        verified=(least, MOST_MU if held else math.nan),
        n_values=len(held),
        basis=law if held else reason or f"no coefficient up to {MOST_MU} is sufficient",
    )


def _in_vain(trials: Trials, row: Clearance | None) -> str:
    """Return why no friction can satisfy, if so: found without a run."""
    given, array = trials.given, trials.array
    if few := _too_few(array):
        return few
    is_prescriptive = array.route is Route.PRESCRIPTIVE
    least_m = array.prescriptive.value_m if is_prescriptive else array.floor_m
    if (
        row is None
        or single_array_check(given, given.project, displaced(array, 0.0, least_m), row).ok
    ):
        return ""
    if single_array_check(given, given.project, displaced(array, 0.0, 0.0), row).ok:
        least = "prescriptive displacement" if is_prescriptive else "floor"
        return f"the {least} alone requires more than is provided"
    return "the minimum separation of the rule set is more than is provided"


def _too_few(array: ArrayAssessment) -> str:
    few = array.analysis.basis is Basis.TOO_FEW
    return "there are too few motions for the requested statistic" if few else ""


def _separation(given: Assessment, number: int, gap: ClearanceCheck) -> Remedy:
    """Return the required separation, which the runs of the package give."""
    required = gap.required_m
    return Remedy(
        kind=RemedyKind.SEPARATION,
        clearance=number,
        array=gap.governing_array,
        given=gap.clearance.provided_m,
        value=required,
        resolution=0.0,
        verified=(required, required),
        n_values=0 if math.isnan(required) else 1,
        basis="there is no design displacement"
        if math.isnan(required)
        else "the required separation at the design displacement of this package",
    )
