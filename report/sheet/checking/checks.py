"""Checks of the input that involve more than one cell; each fault names the cell to change.

Works on a draft, the rows of readable values, so that one invalid cell hides no other fault.
`schema` checks single cells; `locate_tables` and `archive` check sheets and files.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from report.sheet.checking.conditions import MAX_SLOPE_DEG, REFERENCES, UNIQUE, missing
from report.sheet.checking.friction_checks import friction_faults
from report.sheet.checking.motion_checks import motion_faults
from report.sheet.checking.plan_checks import places_of, plan_faults, shapes_of, us_first
from report.sheet.checking.site_checks import site_faults
from report.sheet.schema import (
    PROVISION_KEYS,
    ModelChoice,
    Rectangle,
    Shape,
    SlopeUnit,
    coefficients,
    factors,
    slope_rad,
)
from report.sheet.schema.fields import Draft, DraftRow, Finding, Place, Where
from report.sheet.schema.references import suggestion
from report.sheet.schema.shapes import gap_m
from report.words.letters import cut
from report.words.units import Quantity, pair
from solver.model import INCH_M
from solver.rules.rulesets import ALLOWED

GAP_TOLERANCE = 0.01
# Below the inch at which a package states that a clearance contradicts the plan
# (`report.assessment.neighbors`): what passes here passes there.
GAP_TOLERANCES_M = (0.5 * INCH_M, 0.99 * INCH_M)


def gap_tolerance_m(gap_m: float) -> float:
    """Return how far a clearance may be from the gap of the plan [m]."""
    low, high = GAP_TOLERANCES_M
    return min(max(GAP_TOLERANCE * gap_m, low), high)


def faults(draft: Draft, where: Where) -> list[Finding]:
    """Return all inconsistencies of a draft.

    Parameters
    ----------
    draft : mapping of section to rows
        A row lacks the fields that could not be read; a blank optional field is its default.
    where : callable
        Returns the address of a place, for faults that refer to a second cell.
    """
    checks = (
        _tables,
        _missing,
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
    for section, noun in (("arrays", "array"), ("motions", "motion")):
        if not draft[section]:
            yield Finding.error(Place(section), f"no {noun} is given", "fill in at least one row")


def _missing(draft: Draft, where: Where) -> Iterator[Finding]:
    yield from missing(draft)


def _ids(draft: Draft, where: Where) -> Iterator[Finding]:
    # Arrays come first, so that a duplicate is reported at the object.
    for sections in UNIQUE:
        seen: dict[str, Place] = {}
        for place, value in _column(draft, sections, "id"):
            first = seen.setdefault(value.casefold(), place)
            if first is not place:
                text = f"ID is '{value}', already used at {where(first)}"
                yield Finding.error(place, text, "give a unique ID")


def _column(draft: Draft, sections: Sequence[str], field: str) -> Iterator[tuple[Place, Any]]:
    for section in sections:
        for index, row in enumerate(draft[section]):
            if field in row:
                yield Place(section, index, field), row[field]


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
    fields = ("mu", "mu_fast", "mu_static", "model")
    if any(field not in row for field in fields):
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
    yield from _repeated(draft, where)
    shapes = shapes_of(draft)
    for index, row in enumerate(draft["clearances"]):
        yield from _room(index, row, shapes, draft, where)


def _unknown(draft: Draft, where: Where) -> Iterator[Finding]:
    """Yield names of what is in no table; `plan_checks` has those of outlines."""
    for (section, field), tables in REFERENCES.items():
        if section == "outlines":
            continue
        ids = {value: None for _, value in _column(draft, tables, "id")}
        sheets = " or ".join(table.capitalize() for table in tables)
        for place, value in _column(draft, (section,), field):
            if value not in ids:
                text = f"{field} is '{value}', which is not in {sheets}"
                yield Finding.error(place, text, suggestion(value, ids))


def _repeated(draft: Draft, where: Where) -> Iterator[Finding]:
    seen: dict[tuple[Any, ...], int] = {}
    for index, row in enumerate(draft["clearances"]):
        key = tuple(row.get(field) for field in ("array", "object", "direction"))
        if None in key:
            continue
        first = seen.setdefault(key, index)
        if first != index:
            at = where(Place("clearances", first, "array"))
            text = f"array is '{key[0]}', with the same object and direction as at {at}"
            yield Finding.error(Place("clearances", index, "array"), text, "delete one")


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
    boxes = isinstance(a, Rectangle) and isinstance(b, Rectangle)
    noun = "rectangles" if boxes else "outlines"
    gap, place = gap_m(a, b), Place("clearances", index, "provided_m")
    is_us = us_first(draft)
    given = pair(provided, Quantity.SIZE, is_us)
    at = places_of(draft, (str(array), str(other)), where)
    if gap < -1e-9:
        text = f"provided clearance is {given}, but {array} and {other} overlap in plan"
        yield Finding.error(place, text, f"correct their {noun} in {at}")
    elif provided > gap + gap_tolerance_m(gap):
        most = pair(max(gap, 0.0), Quantity.SIZE, is_us)
        text = f"provided clearance is {given}, but {array} and {other} are {most} apart in plan"
        yield Finding.error(place, text, f"reduce it, or correct the {noun} in {at}")


def _links(draft: Draft, where: Where) -> Iterator[Finding]:
    arrays = {name: place for place, name in _column(draft, ("arrays",), "id")}
    seen: dict[str, Place] = {}
    for place, name in _column(draft, ("links",), "array"):
        first = seen.setdefault(name, place)
        if first is not place:
            yield Finding.error(
                place, f"array is '{name}', already given at {where(first)}", "delete one"
            )
        if name in arrays:
            yield from _one_coefficient(place, name, draft["arrays"][arrays[name].row])
    for place, text in _column(draft, ("links",), "friction"):
        home = arrays.get(draft["links"][place.row].get("array", ""))
        yield from _blocks(place, text, draft, where, home)


def _one_coefficient(place: Place, name: str, array: DraftRow) -> Iterator[Finding]:
    if "mu" in array and _by_speed(array):
        text = f"array is '{name}', which has high-velocity or static friction"
        yield Finding.error(place, text, "leave both blank on the sheet Arrays, or delete this row")


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
        found = f"block friction is '{text}', all {side} the {mu:g} at {at}"
        yield Finding.error(place, found, "give a range that includes it, or change it")


def _smaller_events(draft: Draft, where: Where) -> Iterator[Finding]:
    for row in draft["options"]:
        text = row.get("smaller_events", "")
        if text and not factors(text):
            wanted = "give up to 20 factors with decimal points, above 0.0 and up to 1.0"
            yield Finding.error(
                Place("options", 0, "smaller_events"),
                f"smaller events is '{cut(text)}'",
                f"{wanted}, such as 0.50, 0.25",
            )


def _overrides(draft: Draft, where: Where) -> Iterator[Finding]:
    seen: dict[str, Place] = {}
    for place, key in _column(draft, ("overrides",), "provision"):
        first = seen.setdefault(key, place)
        if key not in PROVISION_KEYS:
            text = f"provision is '{key}'"
            yield Finding.error(place, text, f"choose one of {', '.join(PROVISION_KEYS)}")
        elif first is not place:
            yield Finding.error(
                place, f"provision is '{key}', already given at {where(first)}", "delete one"
            )
    for row, override in enumerate(draft["overrides"]):
        key, value = override.get("provision", ""), override.get("value")
        allowed = ALLOWED.get(key)
        if allowed and value is not None and not allowed.has(value):
            text = f"value is {value:g} for {key}"
            yield Finding.error(Place("overrides", row, "value"), text, f"give {allowed.words}")
