"""Design curves: statistics of the PRD over motions, and values read off the curves.

A PRD that is NaN is a run without a value (uplift, or sliding at the end of the record): it counts
as larger than any limit and is never left out. Runs nothing. Read `statistics` first.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.model import Floats

PERCENTILE = 84.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Statistics:
    """Statistics of the PRD over motions, each of the shape of the cases.

    Attributes
    ----------
    mean_m, p84_m, largest_m : array
        Mean, 84th percentile (linear between order statistics) and maximum [m]; NaN where it
        depends on a motion without a value.
    without_value : array of int
        Number of motions without a value.
    """

    mean_m: Floats
    p84_m: Floats
    largest_m: Floats
    without_value: NDArray[np.int64]


def statistics(prd_m: Floats) -> Statistics:
    """Return the statistics over motions.

    Parameters
    ----------
    prd_m : array, shape (..., motions)
        PRD of each case under each motion [m]; NaN for none.
    """
    lost = np.isnan(prd_m)
    ordered = np.sort(np.where(lost, np.inf, prd_m), axis=-1)
    place = (prd_m.shape[-1] - 1) * PERCENTILE / 100.0
    below = ordered[..., math.floor(place)]
    above = ordered[..., math.ceil(place)]
    with np.errstate(invalid="ignore"):
        p84 = below + (place - math.floor(place)) * (above - below)
    return Statistics(
        mean_m=prd_m.mean(axis=-1),
        p84_m=_finite(p84),
        largest_m=_finite(ordered[..., -1]),
        without_value=lost.sum(axis=-1),
    )


def _finite(values: Floats) -> Floats:
    return np.where(np.isfinite(values), values, np.nan)


def first_allowed(values: Floats, prd_m: Floats, allowed_m: float) -> float:
    """Return the value from which on, in the order given, the PRD does not exceed a limit.

    Of increasing friction coefficients it is the least that is enough, the reading of the paper's
    Fig. 12; of decreasing slopes the largest that is allowed. Interpolated between the runs; the
    first value if none exceeds the limit, NaN if the last does.

    Parameters
    ----------
    values, prd_m : array, shape (q,)
        Values in any unit, and their PRD [m].
    allowed_m : float
        Limit [m].
    """
    beyond = np.flatnonzero(~(prd_m <= allowed_m))
    if not beyond.size:
        return float(values[0])
    last = int(beyond[-1])
    if last + 1 == values.size:
        return math.nan
    if math.isnan(prd_m[last]):
        return float(values[last + 1])
    part = (prd_m[last] - allowed_m) / (prd_m[last] - prd_m[last + 1])
    return float(values[last] + part * (values[last + 1] - values[last]))
