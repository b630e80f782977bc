"""The friction tests of a project: their means, and the rows that a plan checker looks for.

Each row that is not satisfied is a condition, not NG. Read `solver.friction_tests` first.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from report.assessment.verdict import NOT_GIVEN, Requirement, condition, stated
from report.sheet.checking.friction_checks import MU_TOLERANCE
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.schema.scene import Array
from report.words.counts import grouped_by, numbered
from report.words.units import Quantity, measured, pair
from solver.friction_tests import Series, Surface, fit_law, governing, series
from solver.model import Friction

LEAST_RUNS = 3
"""Runs at one velocity in each condition, whose kinetic coefficients are averaged (PV1-2012)."""

_NOISE = 1e-9  # of a coefficient: a mean of equal values is not above them
STANDARD = re.compile(r"\bASTM[\s-]*G[\s-]*115\b", re.IGNORECASE)
"""What names the standard of friction tests."""


def tested(data: ProjectInput) -> tuple[Series, ...]:
    """Return the runs of a project by report and condition."""
    return series(row.run(data.friction_tests.report) for row in data.friction_runs)


def friction_rows(data: ProjectInput) -> tuple[Requirement, ...]:
    """Return the rows on the friction tests."""
    return _on_file(data), _standard(data), _wet_and_dry(data)


def _on_file(data: ProjectInput) -> Requirement:
    tests = data.friction_tests
    said = stated(
        "friction_tests",
        laboratory=("laboratory", tests.laboratory),
        report=("report number", tests.report),
        date=("date", tests.date),
    )
    attached = "; attached" if tests.report_file else ""
    return _row(
        title=f"Friction test report {'on file' if tests.report_file else 'stated'}",
        **{**said, "found": said["found"] + attached},
        limit="laboratory, report number, date",
        remedy="Obtain the friction test report and complete the sheet Friction tests.",
    )


def _standard(data: ProjectInput) -> Requirement:
    tests = data.friction_tests
    lacking = {
        "standard": not STANDARD.search(tests.standard),
        "accreditation": not tests.accreditation,
    }
    standard = f"standard {tests.standard or NOT_GIVEN}"
    accreditation = f"accreditation {tests.accreditation or NOT_GIVEN}"
    return _row(
        title="Tested to ASTM G115",
        found=f"{standard}; {accreditation}",
        limit="ASTM G115, accredited laboratory",
        is_satisfied=not any(lacking.values()),
        remedy="Obtain tests to ASTM G115 by an accredited laboratory, and state both on the sheet "
        "Friction tests.",
        places=tuple(
            Place("friction_tests", 0, field) for field, lacks in lacking.items() if lacks
        ),
    )


def _wet_and_dry(data: ProjectInput) -> Requirement:
    given = {(one.report, one.surface): one for one in tested(data)}
    reports = dict.fromkeys(report for report, _ in given)
    still = [index for index, row in enumerate(data.friction_runs) if row.velocity_mps is None]
    found = [
        (f"report {report or 'without a number'}: " if len(reports) > 1 else "")
        + ", ".join(_runs({s: given.get((report, s)) for s in Surface}, data.us_first))
        for report in reports
    ]
    return _row(
        title="Wet and dry, three runs at each velocity",
        found="; ".join(found) or "no runs",
        limit=f"{LEAST_RUNS} runs or more at each velocity, wet and dry",
        is_satisfied=bool(reports)
        and all((report, surface) in given for report in reports for surface in Surface)
        and all(map(has_enough_runs, given.values())),
        remedy="Obtain the runs that are missing, and enter them with velocities on the sheet "
        "Friction tests.",
        places=tuple(Place("friction_runs", index, "velocity_mps") for index in still)
        or (Place("friction_runs"),),
    )


def basis_words(data: ProjectInput, array: Array) -> str:
    """Return where the friction of an array comes from: the fit of test runs, or entered."""
    found = tested(data)
    if not found:
        return "entered; no runs of friction tests are given"
    tests = governing(found, array.mu_report)
    where = _where(tests, data.us_first)
    if _is_fit(array.friction, tests):
        return f"as tested: the fit of the {tests.surface} runs {where}"
    return f"entered, {_how_far(array.friction, tests)} the tests {where}"


def _is_fit(law: Friction, tests: Series) -> bool:
    """Whether a law is the fit of the runs, within the rounding of coefficients."""
    velocities = [run.velocity_mps for run in tests.runs]
    fit = fit_law(velocities, [run.mu for run in tests.runs]) if law.is_by_velocity else None
    if fit is None or not fit.is_determined:
        return False
    pairs = [
        (law.mu_fast, fit.law.mu_fast),
        *((law.at(v), fit.law.at(v)) for v in (0.0, *velocities) if not math.isnan(v)),
    ]
    return all(abs(entered - fitted) <= MU_TOLERANCE for entered, fitted in pairs)


def _how_far(law: Friction, tests: Series) -> str:
    """Return how entered friction compares with the runs at each velocity, or on average."""
    if all(one.mean_of(law) <= one.mean + _NOISE for one in tests.repeats):
        return "at or below"
    if tests.mean_of(law) <= tests.mean + _NOISE:
        return "on average at or below"
    return f"on average within {MU_TOLERANCE:g} of"


def _where(tests: Series, us_first: bool) -> str:
    """Return from which to which velocity runs were made."""
    velocities = [one.velocity_mps for one in tests.repeats]
    ends = [pair(v, Quantity.VELOCITY, us_first) for v in velocities if not math.isnan(v)]
    if not ends:
        return f"(velocities {NOT_GIVEN})"
    return f"at {ends[0]}" if len(ends) == 1 else f"from {ends[0]} to {ends[-1]}"


def has_enough_runs(one: Series) -> bool:
    """Whether there are enough runs at each velocity; runs without one are no repeats."""
    return not math.isnan(one.repeats[-1].velocity_mps) and all(
        len(repeats.runs) >= LEAST_RUNS for repeats in one.repeats
    )


def _runs(given: Mapping[Surface, Series | None], us_first: bool) -> Iterator[str]:
    """Yield the runs in each condition, those that are alike together."""
    words = {s: runs_by_velocity(one, us_first) if one else "0 runs" for s, one in given.items()}
    for said, alike in grouped_by(words, words.__getitem__).items():
        yield f"{' and '.join(alike)} {said}"


def runs_by_velocity(one: Series, us_first: bool) -> str:
    """Return in words how many runs there are at each velocity."""
    counts = grouped_by(one.repeats, lambda each: (len(each.runs), math.isnan(each.velocity_mps)))
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


_row = partial(condition, id="friction_tests", basis="friction tests")
