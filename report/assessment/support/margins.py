"""How far the friction of an array may fall before a clearance is not satisfied.

From μ = 0.50 on, 0.45, 0.40 … are tried in the governing orientations until the clearance fails,
then hundredths; the last value that all runs confirm is the margin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.clearances import ClearanceCheck
from report.assessment.remedies.friction_search import (
    Trials,
    below,
    check_alone,
    involved,
    is_final,
    search,
    trials_of,
)

# Fraction of the given friction coefficient down to which the margins are searched.
LOWEST_SHARE = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Margin:
    """How far the friction of one array may fall before a clearance is not satisfied."""

    number: int  # of the clearance in the workbook, from 1
    gap: ClearanceCheck
    array: ArrayAssessment
    # smallest coefficient at which all runs satisfy; NaN if the one given does not
    minimum_mu: float
    required_m: float  # required separation at it, for this array alone [m]
    limited_by: str  # what is not satisfied with 0.01 less, or that the search ends there
    lowest_tried: float  # where the search ends

    @property
    def is_beyond(self) -> bool:
        """Whether the search ended before the clearance failed."""
        return self.minimum_mu == self.lowest_tried


def margins(assessment: Assessment) -> Iterator[Margin]:
    """Yield for each clearance a margin of each array that it involves."""
    trials = trials_of(assessment)
    for number, gap in enumerate(assessment.clearances, start=1):
        for array in involved(assessment, gap.clearance):
            yield _margin(trials[array.id], number, gap)


def _margin(trials: Trials, number: int, gap: ClearanceCheck) -> Margin:
    """Walk down in the governing orientations; from the last value that all runs confirm in all."""
    row, array = gap.clearance, trials.array
    as_given = check_alone(trials.assessment, array.id, array.displacement, row)
    minimum_mu, required, limited_by, mu = math.nan, math.nan, "—", array.array.mu
    lowest = math.ceil(100.0 * LOWEST_SHARE * mu - 1e-6)
    if as_given.ok and is_final(array):
        minimum_mu, required, limited_by = mu, as_given.required_m, "search"
        start = below(mu)
        satisfied = (
            search(lambda k: trials.may_satisfy(row, mu=k), start, lowest)
            if start >= lowest > 0
            else ()
        )
        # The governing orientations refute at a quarter of the runs; only all of them confirm.
        confirmed = next((k for k in reversed(satisfied) if trials.satisfies(row, mu=k)), 0)
        while confirmed > lowest and trials.satisfies(row, mu=confirmed - 1):
            confirmed -= 1
        if confirmed:
            minimum_mu, required = confirmed / 100, trials.required_m(row, mu=confirmed)
        if lowest < (following := confirmed or start + 1):
            limited_by = trials.failure(row, mu=following - 1)
    return Margin(
        number=number,
        gap=gap,
        array=array,
        minimum_mu=minimum_mu,
        required_m=required,
        limited_by=limited_by,
        lowest_tried=lowest / 100,
    )
