"""The runs of friction tests, and the friction of arrays held against them, in words.

Decides nothing: `report.assessment.checks.friction_evidence` does. Read `tested`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import chain

from report.assessment.design.words import NOT_GIVEN
from report.project.check.friction_faults import MU_TOLERANCE
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.text.counts import numbered
from report.text.grouping import grouped_by
from report.text.units import Quantity, measured, pair
from solver.friction_tests import Series, Surface, fit_law, governing, series
from solver.model import Friction

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
    """Return where the friction of an array comes from: the fit of test runs, or entered."""
    all_series = tested(data)
    if not all_series:
        return "entered; no friction test runs are entered"
    # The smaller mean governs, wet or dry (PV1-2012).
    tests = governing(all_series, array.mu_report)
    where = _where(tests, data.us_first)
    if _is_fit(array.friction, tests):
        return f"as tested: the fit of the {tests.surface} runs {where}"
    return f"entered, {_how_far(array.friction, tests)} the tests {where}"


def _is_fit(law: Friction, tests: Series) -> bool:
    """Whether a law is the fit of the runs, within the rounding of coefficients."""
    velocities = [run.velocity_mps for run in tests.runs]
    fit = fit_law(velocities, [run.mu for run in tests.runs]) if law.is_by_velocity else None
    # Too few velocities fit any law: then nothing is as tested.
    if fit is None or not fit.is_determined:
        return False
    pairs = [
        (law.mu_fast, fit.law.mu_fast),
        *((law.at(v), fit.law.at(v)) for v in (0.0, *velocities) if not math.isnan(v)),
    ]
    return all(abs(entered - fitted) <= MU_TOLERANCE for entered, fitted in pairs)


def _how_far(law: Friction, tests: Series) -> str:
    """Return how entered friction compares with the runs at each velocity, or on average."""
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
    """Return in words how many runs there are at each velocity."""
    counts = grouped_by(
        series.repeats, lambda each: (len(each.runs), math.isnan(each.velocity_mps))
    )
    return ", ".join(
        f"{numbered(count, 'run')} with velocity {NOT_GIVEN}"
        if is_unknown
        else f"{numbered(count, 'run')} at {'each of ' if len(alike) > 1 else ''}"
        f"{_velocities([each.velocity_mps for each in alike], us_first)}"
        for (count, is_unknown), alike in counts.items()
    )


def _velocities(values_mps: Sequence[float], us_first: bool) -> str:
    first, second = (
        f"{', '.join(measured(value, unit) for value in values_mps)} {unit.symbol}"
        for unit in (Quantity.VELOCITY.value if us_first else Quantity.VELOCITY.value[::-1])
    )
    return f"{first} ({second})"
