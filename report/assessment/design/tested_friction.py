"""The runs of friction tests, and the friction of arrays compared with them, as text.

Three wet runs of 0.45 in the mean and three dry ones of 0.60: the wet ones govern, and the friction
of an array is held against 0.45.

Decides nothing: `report.assessment.checks.friction_evidence` does. Read `tested`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING

from report.assessment.design.verdict import NOT_GIVEN
from report.project.check.array_faults import MU_TOLERANCE
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.text.counts import numbered
from report.text.grouping import grouped_by
from report.text.units import Quantity, Rounding, measured, pair, with_unit
from solver.friction_tests import Series, Surface, fit_law, governing, series
from solver.model import Friction

if TYPE_CHECKING:  # the class loads the kernels, which `check` does without: 0.4 s
    from report.assessment.design.arrays import ArrayAssessment

# PV1-2012: the kinetic average of three runs, of the worse of wet and dry.
LEAST_RUNS = 3
# Sliding velocity / largest velocity tested above which no test shows the friction: in no code.
MOST_BEYOND = 10.0

_NOISE = 1e-9  # of a coefficient: a mean of equal values is not above them
# What names the standard of friction tests: PV1-2012 asks for ASTM G115.
STANDARD = re.compile(r"\bASTM[\s-]*G[\s-]*115\b", re.IGNORECASE)


def tested(data: ProjectInput) -> tuple[Series, ...]:
    """Return the runs of a project by report and condition."""
    return series(row.run(data.friction_tests.report) for row in data.friction_runs)


def is_complete(data: ProjectInput, report: str) -> bool:
    """Whether the runs of a report are wet and dry, and three or more at each velocity."""
    parts = [tests for tests in tested(data) if tests.report == report]
    if {tests.surface for tests in parts} != set(Surface):
        return False
    repeats = chain.from_iterable(tests.repeats for tests in parts)
    # Runs without a velocity, which are the last, are no repeats of each other.
    return all(
        len(repeat.runs) >= LEAST_RUNS and not math.isnan(repeat.velocity_mps) for repeat in repeats
    )


def basis_words(data: ProjectInput, array: Array) -> str:
    """Return the source of the friction of an array: the fit of test runs, or entered."""
    all_series = tested(data)
    if not all_series:
        return "entered; no friction test runs are entered"
    # The smaller mean governs, wet or dry (PV1-2012).
    tests = governing(all_series, array.mu_report)
    where = _where(tests, data.us_first)
    if _is_fit(array.friction, tests):
        return f"as tested: the fit of the {tests.surface} runs {where}"
    return f"entered, {_how_far(array.friction, tests)} the tested values {where}"


def _is_fit(law: Friction, tests: Series) -> bool:
    """Whether a law is the fit of the runs, within the rounding of coefficients."""
    velocities = [run.velocity_mps for run in tests.runs]
    fit = fit_law(velocities, [run.mu for run in tests.runs]) if law.is_by_velocity else None
    # Too few velocities fit any law: then nothing is as tested.
    if fit is None or not fit.is_determined:
        return False
    # By coefficients, not by the rate: two rates may give the same coefficients wherever there are
    # runs.
    pairs = [
        (law.mu_fast, fit.law.mu_fast),
        *((law.at(v), fit.law.at(v)) for v in (0.0, *velocities) if not math.isnan(v)),
    ]
    return all(abs(entered - fitted) <= MU_TOLERANCE for entered, fitted in pairs)


def _how_far(law: Friction, tests: Series) -> str:
    """Return the comparison of entered friction with the runs at each velocity, or on average."""
    # What is above the tests on average is refused by the checks of the sheet.
    if all(repeat.mean_of(law) <= repeat.mean + _NOISE for repeat in tests.repeats):
        return "at or below"
    if tests.mean_of(law) <= tests.mean + _NOISE:
        return "on average at or below"
    return f"on average within {MU_TOLERANCE:g} of"


def _where(tests: Series, us_first: bool) -> str:
    velocities = [repeat.velocity_mps for repeat in tests.repeats]
    ends = [pair(v, Quantity.VELOCITY, us_first) for v in velocities if not math.isnan(v)]
    if not ends:
        return f"(velocities {NOT_GIVEN})"
    return f"at {ends[0]}" if len(ends) == 1 else f"from {ends[0]} to {ends[-1]}"


def runs_by_velocity(series: Series, us_first: bool) -> str:
    """Return the number of runs at each velocity as text."""
    counts = grouped_by(
        series.repeats, lambda repeat: (len(repeat.runs), math.isnan(repeat.velocity_mps))
    )
    return ", ".join(
        f"{numbered(count, 'run')} with velocity {NOT_GIVEN}"
        if is_unknown
        else f"{numbered(count, 'run')} at {'each of ' if len(alike) > 1 else ''}"
        f"{_velocities([repeat.velocity_mps for repeat in alike], us_first)}"
        for (count, is_unknown), alike in counts.items()
    )


def _velocities(values_mps: Sequence[float], us_first: bool) -> str:
    first, second = (
        with_unit(", ".join(measured(value, unit) for value in values_mps), unit.symbol)
        for unit in (Quantity.VELOCITY.value if us_first else Quantity.VELOCITY.value[::-1])
    )
    return f"{first} ({second})"


@dataclass(frozen=True, slots=True, kw_only=True)
class VelocityCheck:
    """The friction of an array above the tested velocities."""

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
        """Whether the array may slide too fast for the tests to show its friction."""
        # Not `>`: NaN, of a run without a velocity or of tests without one, is far.
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
        """Whether friction above the tested range is at most the smallest tested, within rounding.

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
    """Return the friction of an array above the tested velocities."""
    all_series = tested(data)
    tests = governing(all_series, assessed.array.mu_report) if all_series else None
    return VelocityCheck(
        friction=assessed.array.friction,
        fastest_mps=assessed.fastest_mps,
        tests=tests,
        is_complete=tests is not None and is_complete(data, tests.report),
    )
