"""The friction of an array beyond the velocities tested."""

from __future__ import annotations

import math
from dataclasses import dataclass

from report.assessment.design.arrays import ArrayAssessment
from report.assessment.design.tested_friction import MOST_BEYOND, is_complete, tested
from report.project.check.friction_faults import MU_TOLERANCE
from report.project.model import ProjectInput
from report.text.units import Rounding
from solver.friction_tests import Series, governing
from solver.model import Friction


@dataclass(frozen=True, slots=True, kw_only=True)
class VelocityCheck:
    """The friction of an array beyond the velocities tested."""

    friction: Friction
    # largest sliding velocity of all runs of the array [m/s]; NaN where a run gives none
    fastest_mps: float
    tests: Series | None  # the runs of friction tests that govern for the array, if any
    is_complete: bool  # whether their report has all runs that are required

    @property
    def tested_mps(self) -> float:
        """Largest velocity tested [m/s]; NaN where no test reports one."""
        return self.tests.velocity_mps if self.tests else math.nan

    @property
    def minimum_mu(self) -> float:
        """Smallest friction tested; NaN without tests."""
        return self.tests.minimum_mu if self.tests else math.nan

    @property
    def is_beyond(self) -> bool:
        """Whether the array may slide faster than tested, or no test reports its velocity."""
        # A run without a velocity, NaN, is beyond; an array that never slides is not.
        return not self.fastest_mps <= (0.0 if math.isnan(self.tested_mps) else self.tested_mps)

    @property
    def is_far(self) -> bool:
        """Whether the array may slide so fast that the tests do not show its friction."""
        return not self.fastest_mps <= MOST_BEYOND * self.tested_mps

    @property
    def mu_beyond(self) -> float:
        """Largest friction used beyond the velocities tested; NaN where none is."""
        law, ends = self.friction, (self.tested_mps, self.fastest_mps)
        if not self.is_beyond:
            return math.nan
        if any(map(math.isnan, ends)):
            return max(law.mu_slow, law.mu_fast)
        return max(map(law.at, ends))

    @property
    def is_satisfied(self) -> bool:
        """Whether friction beyond the tests is at most the smallest tested, within rounding.

        The tests must be complete and not far from it: fewer runs are never better.
        """
        is_low = self.mu_beyond <= self.minimum_mu + MU_TOLERANCE
        return not self.is_beyond or (is_low and self.is_complete and not self.is_far)

    @property
    def beyond_words(self) -> str:
        """Largest friction used beyond the velocities tested, for print."""
        return Rounding.UP.text(self.mu_beyond, 3)

    @property
    def minimum_words(self) -> str:
        """Smallest friction tested, for print."""
        return Rounding.DOWN.text(self.minimum_mu, 3)


def velocity_check(data: ProjectInput, assessed: ArrayAssessment) -> VelocityCheck:
    """Return the friction of an array beyond the velocities tested."""
    all_series = tested(data)
    tests = governing(all_series, assessed.array.mu_report) if all_series else None
    return VelocityCheck(
        friction=assessed.array.friction,
        fastest_mps=assessed.fastest_mps,
        tests=tests,
        is_complete=tests is not None and is_complete(data, tests.report),
    )
