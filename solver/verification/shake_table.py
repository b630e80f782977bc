"""Computed slip compared with shake-table tests, by an acceptance that is fixed beforehand.

Runs the model that a package would use. Read `compare`, then `ShakeTable.is_accepted`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from solver.model import Floats, Status
from solver.sliding.checked import solve
from solver.sliding.least_model import Model
from solver.verification.table_tests import Data, TableTest

MEDIAN = (0.9, 1.1)
"""Accepted range of the median ratio of computed to measured PRD."""

RATIOS, SHARE = (0.75, 1.33), 0.8
"""Range in which at least this share of the ratios lies."""

LEAST_TESTS = 5
"""Ratios below which nothing is accepted: of fewer, no share but all of them is 80 %."""

LEAST_M = 1e-3
"""A test with less measured PRD has no ratio [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TableRun:
    """A test and what is computed for it."""

    test: TableTest
    model: Model  # the model that was used
    status: Status
    # magnitudes [m]; NaN without a result
    prd_m: float
    residual_m: float

    @property
    def has_ratio(self) -> bool:
        """Whether enough slip was measured for a ratio."""
        return self.test.prd_m >= LEAST_M

    @property
    def ratio(self) -> float:
        """Computed over measured PRD; NaN without a result or measured slip."""
        return self.prd_m / self.test.prd_m if self.has_ratio else math.nan


@dataclass(frozen=True, slots=True, kw_only=True)
class ShakeTable:
    """The runs of all tests, or of some of them."""

    runs: tuple[TableRun, ...]

    @property
    def ratios(self) -> Floats:
        """Ratios of the tests with measured slip; NaN where the run has no result."""
        return np.array([run.ratio for run in self.runs if run.has_ratio])

    @property
    def median(self) -> float:
        """Median ratio; NaN if there is none, or a run has no result."""
        return float(np.median(self.ratios)) if self.ratios.size else math.nan

    @property
    def share_within(self) -> float:
        """Share of the ratios in `RATIOS`; a run without a result is not within."""
        low, high = RATIOS
        within = (self.ratios >= low) & (self.ratios <= high)
        return float(within.mean()) if within.size else 0.0

    @property
    def is_accepted(self) -> bool:
        """Whether there are enough tests, and median and share are as required."""
        low, high = MEDIAN
        is_enough = self.ratios.size >= LEAST_TESTS
        return is_enough and low <= self.median <= high and self.share_within >= SHARE

    @property
    def is_measured(self) -> bool:
        """Whether every slip was measured."""
        return all(run.test.data is Data.MEASURED for run in self.runs)

    @property
    def validates(self) -> bool:
        """Whether the tests validate the solution: measured, and accepted."""
        return self.is_measured and self.is_accepted

    def of(self, belongs: Callable[[TableTest], bool]) -> ShakeTable:
        """Return the runs of some of the tests."""
        return ShakeTable(runs=tuple(run for run in self.runs if belongs(run.test)))


SHIPPED: tuple[ShakeTable, ...] = ()
"""Tests that come with the program, none as yet: the manual and every package state their status.
"""


def compare(tests: Sequence[TableTest]) -> ShakeTable:
    """Run every test with the simplest adequate model, in the polarity of the table."""
    return ShakeTable(runs=tuple(map(_run, tests)))


def _run(test: TableTest) -> TableRun:
    solution = solve(test.scene)
    result = solution.result
    return TableRun(
        test=test,
        model=solution.model,
        status=result.status,
        prd_m=result.prd_m,
        residual_m=math.hypot(result.residual_m, result.residual_across_m),
    )
