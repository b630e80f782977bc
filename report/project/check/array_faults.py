"""Faults of arrays: slope, friction that the tests do not show, rows of linked blocks."""

from __future__ import annotations

from collections.abc import Iterator

from report.project.model.array import coefficients, friction_law
from report.project.model.finding import Finding
from report.project.model.friction_report import FrictionTestRow
from report.project.model.input_rows import InputRow, Inputs, Place, Where, column, repeated
from solver.friction_tests import Series, governing, series
from solver.model import Friction

# Difference of coefficients that comes from rounding to two decimals.
MU_TOLERANCE = 0.005


def friction_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield runs given twice at a velocity, and friction coefficients larger than those tested."""
    yield from _repeated(inputs, where)
    tested = _tested(inputs)
    if not tested:
        return
    for index, array in enumerate(inputs["arrays"]):
        law = _law(array)
        if law is not None:
            # An array may name the reports of its own membrane; else the worst of all of them
            # counts.
            tests = governing(tested, array.get("mu_report") or "")
            yield from _beyond(index, law, tests, _first(inputs, tests, where))


def _report(inputs: Inputs, row: InputRow) -> str:
    return str(row.get("report") or inputs["friction_tests"][0].get("report") or "")


def _repeated(inputs: Inputs, where: Where) -> Iterator[Finding]:
    runs = []
    for place, number in column(inputs, ("friction_runs",), "number"):
        row = inputs["friction_runs"][place.row]
        if "surface" in row:
            report = _report(inputs, row).casefold()
            runs.append((place, (report, row["surface"], row.get("velocity_mps"), number)))
    for place, (_, surface, _, number), first in repeated(runs):
        text = f"run is {number}, {surface}, already entered at {where(first)}"
        yield Finding.error(place, text, "enter another number")


def _tested(inputs: Inputs) -> tuple[Series, ...]:
    """Return the runs as series; none if any run could not be read."""
    rows, fields = inputs["friction_runs"], FrictionTestRow.model_fields
    # A run that is missing would change every mean.
    if not all(row.keys() >= fields.keys() for row in rows):
        return ()
    report = _report(inputs, {})
    return series(FrictionTestRow.model_construct(**row).run(report) for row in rows)


def _law(array: InputRow) -> Friction | None:
    """Return the friction law of an array, if it could be read and is consistent."""
    fields = ("mu", "mu_fast", "mu_rate_s_per_m", "mu_static")
    if not array.keys() >= {*fields, "mu_report"}:
        return None
    mu, fast, rate, static = (array[field] for field in fields)
    # One without the other is an error of its own.
    return friction_law(mu, fast, rate, static) if (fast is None) == (rate is None) else None


def _first(inputs: Inputs, tests: Series, where: Where) -> str:
    """Return the address of the first kinetic coefficient of a series."""
    for index, row in enumerate(inputs["friction_runs"]):
        if (_report(inputs, row), row["surface"]) == (tests.report, tests.surface):
            return where(Place("friction_runs", index, "mu"))
    return where(Place("friction_runs"))


def _beyond(index: int, law: Friction, tests: Series, address: str) -> Iterator[Finding]:
    by_velocity = law.mu_fast != law.mu_slow
    mean, tested = tests.mean_of(law), tests.mean
    # PV1-2012: the average of the kinetic coefficients, of the worse of wet and dry.
    if mean > tested + MU_TOLERANCE:
        # A law is compared by its mean over the velocities tested, as the tests are: it may be
        # above some of them and below others.
        says = f"averages {mean:.3g} at the tested velocities" if by_velocity else f"is {mean:g}"
        text = f"friction coefficient {says}; the tested mean is {tested:.3g} ({tests.surface},"
        runs = f" {len(tests.runs)} runs from {address})"
        remedy = "reduce it" if by_velocity else f"enter {tested:.3g} or less"
        yield Finding.error(Place("arrays", index, "mu"), text + runs, remedy)
    # Where none is entered it is the sliding coefficient, which is compared above.
    if law.mu_static > law.mu_slow and law.mu_static > tests.static_mean + MU_TOLERANCE:
        static = f"{tests.static_mean:.3g}"
        text = (
            f"static friction is {law.mu_static:g}; the tested value is {static} ({tests.surface})"
        )
        yield Finding.error(Place("arrays", index, "mu_static"), text, f"enter {static} or less")


def link_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield rows of linked blocks that are given twice, or contradict their array."""
    arrays = {name: place for place, name in column(inputs, ("arrays",), "id")}
    named = list(column(inputs, ("links",), "array"))
    for place, name, first in repeated(named):
        fault = f"array is '{name}', already entered at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, name in named:
        # A name that is unknown has an error of its own.
        array = inputs["arrays"][arrays[name].row] if name in arrays else {}
        # A block of a row has one coefficient (`solver.sliding.row.BlockRow`).
        same = (None, array.get("mu"))
        has_others = any(array.get(field) not in same for field in ("mu_fast", "mu_static"))
        if "mu" in array and has_others:
            text = f"array is '{name}', which has high-velocity or static friction"
            remedy = "leave both blank on the Arrays worksheet, or delete this row"
            yield Finding.error(place, text, remedy)
    for place, text in column(inputs, ("links",), "friction"):
        home = arrays.get(inputs["links"][place.row].get("array", ""))
        yield from _blocks(place, text, inputs, where, home)


def _blocks(
    place: Place, text: str, inputs: Inputs, where: Where, home: Place | None
) -> Iterator[Finding]:
    mus = coefficients(text)
    if not mus:
        remedy = "enter 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45"
        yield Finding.error(place, f"block friction is '{text}'", f"{remedy}, 0.50")
        return
    mu = inputs["arrays"][home.row].get("mu") if home else None
    # The rigid block that the row is compared with has the coefficient of the array: beyond all
    # its blocks it would be another array.
    if home is not None and mu is not None and not min(mus) <= mu <= max(mus):
        side, address = "above" if mu < min(mus) else "below", where(home._replace(field="mu"))
        fault = f"block friction is '{text}', all values {side} the {mu:g} at {address}"
        yield Finding.error(place, fault, "enter a range that includes it, or change it")
