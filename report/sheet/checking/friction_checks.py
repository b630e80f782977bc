"""Checks of the friction tests, and of the friction coefficients that go beyond them.

Each fault names the cell to change. Works on a draft, like `checks`.
"""

from __future__ import annotations

from collections.abc import Iterator

from report.sheet.checking.drafts import column, repeated
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, Where
from report.sheet.schema.friction import FrictionTestRow
from report.sheet.schema.scene import friction_law
from solver.friction_tests import Series, governing, series
from solver.model import Friction

MU_TOLERANCE = 0.005
"""Difference of coefficients that comes from rounding to two decimals."""


def friction_faults(draft: Draft, where: Where) -> Iterator[Finding]:
    """Yield runs given twice at a velocity, and friction coefficients larger than those tested."""
    yield from _repeated(draft, where)
    tested = _tested(draft)
    if not tested:
        return
    for index, array in enumerate(draft["arrays"]):
        law = _law(array)
        if law is not None:
            tests = governing(tested, array.get("mu_report") or "")
            yield from _beyond(index, law, tests, _first(draft, tests, where))


def _report(draft: Draft, row: DraftRow) -> str:
    return str(row.get("report") or draft["friction_tests"][0].get("report") or "")


def _repeated(draft: Draft, where: Where) -> Iterator[Finding]:
    given = (
        (place, (_report(draft, row).casefold(), row["surface"], row.get("velocity_mps"), number))
        for place, number in column(draft, ("friction_runs",), "number")
        if "surface" in (row := draft["friction_runs"][place.row])
    )
    for place, (_, surface, _, number), first in repeated(given):
        text = f"run is {number}, {surface}, already given at {where(first)}"
        yield Finding.error(place, text, "give another number")


def _tested(draft: Draft) -> tuple[Series, ...]:
    """Return the runs as series; none if any run could not be read."""
    rows, fields = draft["friction_runs"], FrictionTestRow.model_fields
    if any(field not in row for row in rows for field in fields):
        return ()
    report = _report(draft, {})
    return series(FrictionTestRow(**row).run(report) for row in rows)


def _law(array: DraftRow) -> Friction | None:
    """Return the friction law of an array, if it could be read and is consistent."""
    fields = ("mu", "mu_fast", "mu_rate_s_per_m", "mu_static")
    if not array.keys() >= {*fields, "mu_report"}:
        return None
    mu, fast, rate, static = (array[field] for field in fields)
    return friction_law(mu, fast, rate, static) if (fast is None) == (rate is None) else None


def _first(draft: Draft, tests: Series, where: Where) -> str:
    """Return the address of the first kinetic coefficient of a series."""
    for index, row in enumerate(draft["friction_runs"]):
        if (_report(draft, row), row["surface"]) == (tests.report, tests.surface):
            return where(Place("friction_runs", index, "mu"))
    return where(Place("friction_runs"))


def _beyond(index: int, law: Friction, tests: Series, at: str) -> Iterator[Finding]:
    by_velocity = law.mu_fast != law.mu_slow
    given, tested = tests.mean_of(law), tests.mean
    if given > tested + MU_TOLERANCE:
        says = f"averages {given:.3g} at the tested velocities" if by_velocity else f"is {given:g}"
        text = f"friction coefficient {says}; the tests give {tested:.3g} ({tests.surface}, mean"
        runs = f" of {len(tests.runs)} from {at})"
        wanted = "reduce it" if by_velocity else f"give {tested:.3g} or less"
        yield Finding.error(Place("arrays", index, "mu"), text + runs, wanted)
    if law.mu_static > law.mu_slow and law.mu_static > tests.static_mean + MU_TOLERANCE:
        most = f"{tests.static_mean:.3g}"
        text = f"static friction is {law.mu_static:g}; the tests give {most} ({tests.surface})"
        yield Finding.error(Place("arrays", index, "mu_static"), text, f"give {most} or less")
