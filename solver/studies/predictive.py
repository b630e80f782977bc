"""The friction coefficient of an untested roof, predicted from test runs.

Runs of 0.40, 0.42 and 0.44 on one surface have a mean of 0.42 and a scatter of 0.02; the next run
is 0.376 or more in nine of ten cases, by Student's t with two degrees of freedom.

Reads no files; `solver.friction_tests` groups the runs. Read `Predictive`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import fdtrc, stdtrit

from solver.errors import InputError
from solver.friction_tests import Series

# Of the predictive distribution, the middles of five equal probabilities.
QUANTILES = (0.1, 0.3, 0.5, 0.7, 0.9)

# More runs than anybody makes.
MOST_RUNS = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class Predictive:
    """Predictive distribution of the friction coefficient, Student t.

    For one more run on the surface with the least mean: mean, and scatter s sqrt(1 + 1/n) with the
    scatter and the degrees of freedom of all surfaces (Gelman et al. 2013, Bayesian Data Analysis,
    3rd ed., section 3.2, with the noninformative prior).
    """

    mean: float  # of the runs on that surface
    runs: int
    freedom: int  # of all runs, less one for each surface
    within: float  # standard deviation of runs on one surface
    between: float  # of the means of the surfaces without what the runs alone scatter; 0 for one
    p_value: float  # of equal means (F test); NaN for one surface or without any scatter

    @property
    def scale(self) -> float:
        """Scale of the distribution."""
        return self.within * math.sqrt(1.0 + 1.0 / self.runs)

    def quantile(self, chance: float) -> float:
        """Return the coefficient that is not exceeded with a probability between 0 and 1."""
        return self.mean + self.scale * float(stdtrit(self.freedom, chance))

    @property
    def quantiles(self) -> tuple[float, ...]:
        """Equally likely coefficients at `QUANTILES`."""
        return tuple(map(self.quantile, QUANTILES))

    def more_runs(self, required_mu: float) -> float:
        """Return how many more runs make the lowest of `QUANTILES` a required coefficient.

        With the same mean and scatter, on the same surface: 0 if it is one already, inf if
        `MOST_RUNS` are too few.
        """
        for further in range(MOST_RUNS + 1):
            then = replace(self, runs=self.runs + further, freedom=self.freedom + further)
            if then.quantile(QUANTILES[0]) >= required_mu:
                return further
        return math.inf


def predictive(surfaces: Sequence[Series]) -> Predictive:
    """Return the predictive distribution from runs by surface.

    Raises `InputError` if they have fewer than two degrees of freedom, or reach 0 at the lowest of
    `QUANTILES`.
    """
    groups = [np.array([run.mu for run in surface.runs]) for surface in surfaces]
    sizes = np.array([group.size for group in groups])
    total, count = int(sizes.sum()), len(groups)
    freedom = total - count
    if freedom < 2:
        raise InputError(f"{total} friction runs on {count} surfaces; use two more than surfaces")
    squares = sum(float(((group - group.mean()) ** 2).sum()) for group in groups)
    between, p_value = 0.0, math.nan
    if count > 1:
        every = np.concatenate(groups)
        # Sum of squares of the surface means: that of all runs minus that within surfaces.
        among = float(((every - every.mean()) ** 2).sum()) - squares
        # Random effects of a one-way layout of unequal sizes by the method of moments (Searle,
        # Casella and McCulloch 1992, Variance Components, chapter 3).
        size = (total - float((sizes**2).sum()) / total) / (count - 1)
        excess = among / (count - 1) - squares / freedom
        between = math.sqrt(max(0.0, excess / size))
        if squares > 0.0:
            ratio = among / (count - 1) / (squares / freedom)
            p_value = float(fdtrc(count - 1, freedom, ratio))
    # The surface of the least mean: nobody knows which of them a roof is like.
    lowest = min(groups, key=lambda group: float(group.mean()))
    distribution = Predictive(
        mean=float(lowest.mean()),
        runs=lowest.size,
        freedom=freedom,
        within=math.sqrt(squares / freedom),
        between=between,
        p_value=p_value,
    )
    if distribution.quantiles[0] <= 0.0:
        raise InputError("the friction runs scatter so much that the coefficient may be 0")
    return distribution
