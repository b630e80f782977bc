"""Checks of the input that involve more than one cell; each fault names the cell to change.

Works on a draft, the rows of readable values, so that one invalid cell hides no other fault.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from report.sheet.checking.findings import column, repeated, suggestion
from report.sheet.checking.motion_checks import friction_faults, motion_faults
from report.sheet.checking.plan_checks import (
    MAX_SLOPE_DEG,
    REFERENCES,
    UNIQUE,
    missing,
    places_of,
    plan_faults,
    shapes_of,
    us_first,
)
from report.sheet.checking.site_checks import site_faults
from report.sheet.schema import factors, provision_name
from report.sheet.schema.choices import ModelChoice, SlopeUnit
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, Where
from report.sheet.schema.motions import coefficients
from report.sheet.schema.scene import slope_rad
from report.sheet.schema.shapes import Rectangle, Shape, gap_m
from report.text.counts import cut, foreign_letters, looks
from report.text.units import Quantity, pair
from solver.model import INCH_M
from solver.rules.rulesets import ALLOWED, OVERRIDABLE, RULE_SETS
from solver.suggestions import nearest

GAP_TOLERANCE = 0.01
# Below the inch at which a package states that a clearance contradicts the plan
# (`report.assessment.neighbors`): what passes here passes there.
GAP_TOLERANCES_M = (0.5 * INCH_M, 0.99 * INCH_M)


def gap_tolerance_m(gap_m: float) -> float:
    """Return how far a clearance may be from the gap of the plan [m]."""
    low, high = GAP_TOLERANCES_M
    return min(max(GAP_TOLERANCE * gap_m, low), high)


def faults(draft: Draft, where: Where) -> list[Finding]:
    """Return all inconsistencies of a draft, whose blank optional fields have their defaults."""
    checks = (
        _tables,
        missing,
        _unknown,
        _ids,
        site_faults,
        plan_faults,
        _arrays,
        friction_faults,
        _clearances,
        motion_faults,
        _links,
        _overrides,
        _smaller_events,
    )
    return [fault for check in checks for fault in check(draft, where)]


def _tables(draft: Draft, where: Where) -> Iterator[Finding]:
    if not draft["arrays"]:
        yield Finding.error(Place("arrays"), "no array is given", "fill in at least one row")


def _ids(draft: Draft, where: Where) -> Iterator[Finding]:
    # Arrays come first, so that a duplicate is reported at the object.
    for sections in UNIQUE:
        for place, value, first in repeated(column(draft, sections, "id"), looks):
            text, said = f"ID is '{value}', already used at {where(first)}", foreign_letters(value)
            yield Finding.error(place, text + (f"; {said}" if said else ""), "give a unique ID")


def _arrays(draft: Draft, where: Where) -> Iterator[Finding]:
    for index, row in enumerate(draft["arrays"]):
        yield from _slope(index, row)
        yield from _friction(index, row)


def _slope(index: int, row: DraftRow) -> Iterator[Finding]:
    value, unit = row.get("slope_value"), row.get("slope_unit")
    if value is None or unit is None or math.degrees(slope_rad(value, unit)) < MAX_SLOPE_DEG:
        return
    most = {SlopeUnit.DEGREES: "45", SlopeUnit.PERCENT: "100", SlopeUnit.IN_PER_12: "12"}[unit]
    wanted = f"give 0 to less than {most} {unit}"
    yield Finding.error(Place("arrays", index, "slope_value"), f"slope is {value:g} {unit}", wanted)


def _friction(index: int, row: DraftRow) -> Iterator[Finding]:
    """Yield inconsistencies of velocity-dependent friction, and models that neglect it."""
    if not row.keys() >= {"mu", "mu_fast", "mu_static", "model"}:
        return
    mu, static, model = row["mu"], row["mu_static"], row["model"]
    if static is not None and static < mu:
        text = f"static friction is {static:g}"
        wanted = f"give the friction coefficient, {mu:g}, or more"
        yield Finding.error(Place("arrays", index, "mu_static"), text, wanted)
    if _by_speed(row) and model is not ModelChoice.CHOOSE:
        text = f"model is '{model}', which neglects velocity-dependent and static friction"
        wanted = f"select '{ModelChoice.CHOOSE}', or leave high-velocity and static friction blank"
        yield Finding.error(Place("arrays", index, "model"), text, wanted)


def _by_speed(array: DraftRow) -> list[str]:
    """Return the fields that give an array more than one friction coefficient."""
    same = (None, array["mu"])
    return [name for name in ("mu_fast", "mu_static") if array.get(name) not in same]


def _clearances(draft: Draft, where: Where) -> Iterator[Finding]:
    fields = ("array", "object", "direction")
    rows = enumerate(draft["clearances"])
    named = ((Place("clearances", i, "array"), tuple(map(row.get, fields))) for i, row in rows)
    for place, (array, *_), first in repeated(cell for cell in named if None not in cell[1]):
        text = f"array is '{array}', with the same object and direction as at {where(first)}"
        yield Finding.error(place, text, "delete one")
    shapes = shapes_of(draft)
    for index, row in enumerate(draft["clearances"]):
        yield from _room(index, row, shapes, draft, where)


def _unknown(draft: Draft, where: Where) -> Iterator[Finding]:
    """Yield names of what is in no table; `plan_checks` has those of outlines."""
    for (section, field), tables in REFERENCES.items():
        if section == "outlines":
            continue
        ids = dict.fromkeys(value for _, value in column(draft, tables, "id"))
        sheets = " or ".join(table.capitalize() for table in tables)
        for place, value in column(draft, (section,), field):
            if value not in ids:
                text = f"{field} is '{value}', which is not in {sheets}"
                yield Finding.error(place, text, suggestion(value, ids))


def _room(
    index: int, row: DraftRow, shapes: Mapping[str, Shape], draft: Draft, where: Where
) -> Iterator[Finding]:
    array, other, provided = row.get("array"), row.get("object"), row.get("provided_m")
    if array is not None and array == other:
        text = f"object is '{other}', the array itself"
        wanted = "give an object or another array"
        yield Finding.error(Place("clearances", index, "object"), text, wanted)
        return
    a, b = (shapes.get(str(name)) for name in (array, other))
    if a is None or b is None or provided is None:
        return
    gap, place = gap_m(a, b), Place("clearances", index, "provided_m")
    if gap >= -1e-9 and provided <= gap + gap_tolerance_m(gap):
        return
    boxes = isinstance(a, Rectangle) and isinstance(b, Rectangle)
    noun = "rectangles" if boxes else "outlines"
    stated, most = (pair(max(m, 0.0), Quantity.SIZE, us_first(draft)) for m in (provided, gap))
    at, text = places_of(draft, (str(array), str(other)), where), f"provided clearance is {stated}"
    if gap < -1e-9:
        text += f", but {array} and {other} overlap in plan"
        yield Finding.error(place, text, f"correct their {noun} in {at}")
    else:
        text += f", but {array} and {other} are {most} apart in plan"
        yield Finding.error(place, text, f"reduce it, or correct the {noun} in {at}")


def _links(draft: Draft, where: Where) -> Iterator[Finding]:
    arrays = {name: place for place, name in column(draft, ("arrays",), "id")}
    named = list(column(draft, ("links",), "array"))
    for place, name, first in repeated(named):
        fault = f"array is '{name}', already given at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, name in named:
        array = draft["arrays"][arrays[name].row] if name in arrays else {}
        if "mu" in array and _by_speed(array):
            text = f"array is '{name}', which has high-velocity or static friction"
            wanted = "leave both blank on the sheet Arrays, or delete this row"
            yield Finding.error(place, text, wanted)
    for place, text in column(draft, ("links",), "friction"):
        home = arrays.get(draft["links"][place.row].get("array", ""))
        yield from _blocks(place, text, draft, where, home)


def _blocks(
    place: Place, text: str, draft: Draft, where: Where, home: Place | None
) -> Iterator[Finding]:
    """Yield errors in the coefficients of a row, and inconsistencies with its array."""
    mus = coefficients(text)
    if not mus:
        wanted = "give 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45"
        yield Finding.error(place, f"block friction is '{text}'", f"{wanted}, 0.50")
        return
    mu = draft["arrays"][home.row].get("mu") if home else None
    if home is not None and mu is not None and not min(mus) <= mu <= max(mus):
        side, at = "above" if mu < min(mus) else "below", where(home._replace(field="mu"))
        fault = f"block friction is '{text}', all {side} the {mu:g} at {at}"
        yield Finding.error(place, fault, "give a range that includes it, or change it")


def _smaller_events(draft: Draft, where: Where) -> Iterator[Finding]:
    for place, text in column(draft, ("options",), "smaller_events"):
        if text and not factors(text):
            wanted = "give up to 20 factors with decimal points, above 0.0 and up to 1.0"
            fault = f"smaller events is '{cut(text)}'"
            yield Finding.error(place, fault, f"{wanted}, such as 0.50, 0.25")


def _overrides(draft: Draft, where: Where) -> Iterator[Finding]:
    keys = list(column(draft, ("overrides",), "provision"))
    names = {key: provision_name(key) for key in OVERRIDABLE}
    rules = next((RULE_SETS[name] for _, name in column(draft, ("site",), "rule_set")), None)
    for place, key in keys:
        if key not in names:
            near = nearest(key, names.values())
            wanted = (
                f"did you mean '{near}'?" if near else "choose a name from the list of the cell"
            )
            yield Finding.error(place, f"provision is '{cut(key)}'", wanted)
        elif rules and key not in rules.values:
            fault = f"provision is '{names[key]}', which {rules.name} does not have"
            yield Finding.error(place, fault, "delete the row")
    for place, key, first in repeated(cell for cell in keys if cell[1] in names):
        fault = f"provision is '{names[key]}', already given at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, value in column(draft, ("overrides",), "value"):
        key = draft["overrides"][place.row].get("provision", "")
        allowed = ALLOWED.get(key)
        if allowed and not allowed.has(value):
            fault = f"value is {value:g} for the {OVERRIDABLE[key]}"
            yield Finding.error(place, fault, f"give {allowed.words}")
