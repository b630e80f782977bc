"""The friction of arrays: in words, as it was run; and inputs with other friction.

Runs nothing. `report.assessment.checks.friction` compares it with tests.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from report.assessment.arrays import ArrayAssessment
from report.assessment.checks.arrays import slack_check
from report.assessment.checks.check import words
from report.assessment.checks.plan import clearance_check
from report.assessment.clearances import ClearanceCheck, with_displacements
from report.assessment.routes import NOT_PERMITTED
from report.assessment.tested import MOST_BEYOND, is_complete, tested
from report.assessment.verdict import Verdict
from report.project.check.motion_checks import MU_TOLERANCE
from report.project.model import ProjectInput
from report.project.model.scene import Array
from report.text.counts import ids_by, ranged
from report.text.units import Quantity, Rounding, no_less, number, pair
from solver.friction_tests import Series, governing
from solver.model import Friction

if TYPE_CHECKING:
    from report.assessment.project import Assessment


def coefficient(mu: float) -> str:
    """Return a friction coefficient with two decimals, or three where it has them."""
    return number(mu, 2 if math.isclose(mu, round(mu, 2), abs_tol=1e-9) else 3)


def mu_words(law: Friction) -> str:
    """Return friction as it was run, from low to high velocity: `0.40 to 0.50, by velocity`."""
    sliding = coefficient(law.mu_slow)
    if law.is_by_velocity:
        sliding += f" to {coefficient(law.mu_fast)}, by velocity"
    rest = "" if law.mu_static == law.mu_slow else f", {coefficient(law.mu_static)} at rest"
    return f"{sliding}{rest}"


def mus_words(arrays: Sequence[Array]) -> str:
    """Return the friction of arrays, those of one friction together: `A1, A2: 0.50; A3: 0.45`."""
    groups = ids_by(arrays, lambda array: mu_words(array.friction))
    return "; ".join(f"{ranged(ids)}: {words}" for words, ids in groups.items())


def with_friction(data: ProjectInput, factor: float) -> ProjectInput:
    """Return the input with every friction coefficient of its arrays multiplied by a factor."""
    changed = [array_with_friction(array, factor) for array in data.arrays]
    return data.model_copy(update={"arrays": type(data.arrays)(changed)})


def array_with_friction(array: Array, factor: float) -> Array:
    """Return an array with all of its friction coefficients multiplied by a factor."""
    names = ("mu", "mu_fast", "mu_static")
    values = {name: getattr(array, name) for name in names}
    return array.model_copy(
        update={name: mu * factor for name, mu in values.items() if mu is not None}
    )


def with_low_velocity(data: ProjectInput) -> ProjectInput:
    """Return the input with the low-velocity coefficient of every array alone; itself if it is."""
    if not any(array.friction.is_by_velocity for array in data.arrays):
        return data
    arrays = [at_low_velocity(a) if a.friction.is_by_velocity else a for a in data.arrays]
    return data.model_copy(update={"arrays": type(data.arrays)(arrays)})


def at_low_velocity(array: Array) -> Array:
    """Return an array with its low-velocity coefficient alone, at rest and at every velocity."""
    names = ("mu_fast", "mu_rate_s_per_m", "mu_static")
    return array.model_copy(update=dict.fromkeys(names))


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


@dataclass(frozen=True, slots=True, kw_only=True)
class InputCase:
    """An array with another input."""

    array: ArrayAssessment  # with its design displacement then
    changed: str  # the other input, in words
    gaps: Sequence[ClearanceCheck]  # the clearances that involve the array, then

    @property
    def short(self) -> Sequence[ClearanceCheck]:
        """The clearances that would be NG."""
        return [gap for gap in self.gaps if gap.verdict is Verdict.NG]

    def words(self, us_first: bool) -> str:
        """Return it as a sentence."""
        return f"{self.array.id} with {self.changed}: {', '.join(self._outcome(us_first))}."

    def _outcome(self, us_first: bool) -> Iterator[str]:
        design_m = self.array.design_m
        yield (
            "no design displacement"
            if math.isnan(design_m)
            else f"design displacement {pair(design_m, Quantity.DISPLACEMENT, us_first, no_less)}"
        )
        if self.array.has_unpermitted_value:
            yield NOT_PERMITTED
        failed = [clearance_check(gap) for gap in self.short]
        if self.array.lacks_slack:
            failed.append(slack_check(self.array.array, self.array.design_m, 0))
        if failed:
            yield f"NG: {', '.join(words(check, self.array.id) for check in failed)}"
        elif self.gaps and all(gap.ok for gap in self.gaps):
            yield "all its clearances OK" if len(self.gaps) > 1 else "its clearance OK"


@dataclass(frozen=True, slots=True, kw_only=True)
class LowVelocityAssessment:
    """The arrays whose friction depends on velocity, with the low-velocity coefficient alone."""

    arrays: tuple[ArrayAssessment, ...]  # empty where no friction depends on velocity
    # the clearances of these arrays, by their number in the workbook, from 1
    clearances: Mapping[int, ClearanceCheck]

    def of(self, array_id: str) -> ArrayAssessment | None:
        """Return an array; None where its friction does not depend on velocity."""
        return next((item for item in self.arrays if item.id == array_id), None)

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return [gap for gap in self.clearances.values() if gap.involves(array_id)]

    def case_of(self, array_id: str) -> InputCase | None:
        """Return an array as a case; None where its friction does not depend on velocity."""
        alone = self.of(array_id)
        if alone is None:
            return None
        changed = f"μ = {coefficient(alone.array.mu)} at every velocity"
        return InputCase(array=alone, changed=changed, gaps=self.gaps_of(array_id))


NOT_BY_VELOCITY = LowVelocityAssessment(arrays=(), clearances={})


def low_velocity(done: Assessment, slow: Assessment) -> LowVelocityAssessment:
    """Return what an assessment of `with_low_velocity` has of the arrays that it changes."""
    ids = {array.id for array in done.project.arrays if array.friction.is_by_velocity}
    return LowVelocityAssessment(
        arrays=tuple(item for item in slow.arrays if item.id in ids),
        # Arrays stay unlike that are so as given.
        clearances={
            count: with_displacements(done, slow.displacements, gap)
            for count, gap in enumerate(done.clearances, start=1)
            if not ids.isdisjoint(gap.between)
        },
    )
