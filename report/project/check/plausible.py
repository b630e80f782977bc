"""Warnings on values that are permitted but improbable, or outside their typical range.

Reads no record: `report.motions.prepare` does. Read `implausible`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import cache

from report.project.check.plan_faults import gap_tolerance_m
from report.project.check.plan_shapes import far_off
from report.project.check.site_faults import ROUNDING_OF_COEFFICIENTS
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction, ObjectKind, SlopeUnit
from report.project.model.finding import Finding, Level, note, warning
from report.project.model.friction_report import FrictionTestRow
from report.project.model.input_rows import Place
from report.project.model.motion_input import MotionInput
from report.project.model.roof import Clearance, RoofObject
from report.project.model.shapes import Shape, closest, gap_m
from report.project.model.site_input import Site
from report.project.model.values import Frozen
from report.project.workbook import SECTIONS
from report.project.workbook.entries import Entry, SheetSection
from report.text.counts import counted, numbered
from report.text.units import LENGTHS, NO_BREAK, PRESSURES, Quantity, no_more, pair, with_unit
from solver.rules.rulesets import ALLOWED, usual
from solver.rules.site_coefficients import F_A, F_V, site_coefficient

# Usual weight of a ballasted array on its plan area [Pa]: modules alone weigh 2 to 3 psf.
LEAST_PRESSURE_PA, MOST_PRESSURE_PA = 1.0 * PRESSURES["psf"], 30.0 * PRESSURES["psf"]

# Difference of the weight from that of its parts / that of its parts which is rounding.
SAME_WEIGHT = 0.01

# Slope [%] below which it is more probably a fraction: roofs with less than 1/8 % are not built.
MOST_FRACTION = 0.12

# Largest angle between the direction of a clearance and the gap of the plan [deg]: a corner may
# lie at 45 deg.
MOST_ASKEW_DEG = 60.0

# Number of clearances at the ratio of two units from which they are one warning.
LEAST_ALIKE = 3

_UNITS = {"in": "inches", "ft": "feet", "mm": "mm", "cm": "cm", "m": "meters"}

_FROM_DOWNSLOPE_DEG: Mapping[Direction, tuple[float, ...]] = {
    Direction.DOWN: (0.0,),
    Direction.UP: (180.0,),
    Direction.ACROSS: (90.0, 270.0),
}


def implausible(data: ProjectInput) -> Iterator[Finding]:
    """Yield a warning for each value that is permitted but improbable, one per cell."""
    short = _short_of_plan(data)
    findings = [*_contradictory(data), *_provided(data, short)]
    warned = {finding.place for finding in findings if finding.level is Level.WARNING}
    # A length in a wrong unit is outside its usual range as well.
    warned |= {Place("clearances", index, "provided_m") for index in short}
    yield from findings
    yield from (finding for finding in unusual(data) if finding.place not in warned)


def _contradictory(data: ProjectInput) -> Iterator[Finding]:
    us_first = data.us_first
    yield from _dates(data)
    yield from _height(data, us_first)
    yield from _site_coefficients(data.site)
    for index, array in enumerate(data.arrays):
        yield from _slope(index, array)
        yield from _weight(index, array, us_first)
        yield from _friction(index, array)
    yield from _overrides(data)
    yield from _far(data)
    arrays = {array.id: array for array in data.arrays}
    for index, neighbor in _objects_in_plan(data):
        row = data.clearances[index]
        yield from _direction(index, row, arrays[row.array], neighbor)


def _far(data: ProjectInput) -> Iterator[Finding]:
    places = {array.id: Place("arrays", k, "id") for k, array in enumerate(data.arrays)}
    places |= {item.id: Place("objects", k, "id") for k, item in enumerate(data.objects)}
    for name, text in far_off(data.shapes, data.roof.placed, data.us_first):
        yield warning(f"far {name}", places[name], text)


def _objects_in_plan(data: ProjectInput) -> Iterator[tuple[int, Shape]]:
    """Yield the row of each clearance to what is placed in plan, and its shape."""
    shapes = data.shapes
    for index, row in enumerate(data.clearances):
        if row.object in shapes:
            yield index, shapes[row.object]


def _short_of_plan(data: ProjectInput) -> dict[int, float]:
    """Return the gap in plan [m] of each clearance that is less, by row; more is an error."""
    shapes, short = {array.id: array.shape for array in data.arrays}, {}
    for index, neighbor in _objects_in_plan(data):
        row = data.clearances[index]
        gap = gap_m(shapes[row.array], neighbor)
        if row.provided_m < gap - gap_tolerance_m(gap):
            short[index] = gap
    return short


def _dates(data: ProjectInput) -> Iterator[Finding]:
    issue = data.project
    revisions = [row.revision for row in data.revisions]
    if issue.revision.casefold() not in (name.casefold() for name in revisions):
        text = f"revision is '{issue.revision}', which is not in the revision block; add its row"
        text += ", or correct it"
        yield warning(f"revision {issue.revision}", Place("project", 0, "revision"), text)
    confirmed = issue.drawing_confirmed_date
    for section, field, noun, dated in (
        ("project", "drawing_confirmed_date", "date of confirmed drawing distances", confirmed),
        ("site", "hazard_date", "date of hazard", data.site.hazard_date),
        ("friction_tests", "date", "date of the test report", data.friction_tests.date),
        ("options", "peer_date", "date of review", data.options.peer_date),
    ):
        if dated is not None and dated > issue.date:
            text = f"{noun} is {dated}, later than the package, {issue.date}; correct one of them"
            yield warning(noun, Place(section, 0, field), text)


def _height(data: ProjectInput, us_first: bool) -> Iterator[Finding]:
    z, h = data.site.roof_height_m, data.site.structure_height_m
    if z > h:
        height, height_limit = (pair(value, Quantity.PLAN, us_first) for value in (z, h))
        text = f"roof height z is {height}, above the structure height h of {height_limit};"
        yield warning("height z", Place("site", 0, "roof_height_m"), f"{text} correct one of them")


def _site_coefficients(site: Site) -> Iterator[Finding]:
    # Less than the table is an error, except with a site-specific analysis (`checks`).
    for table, field, coefficient, mapped, mapped_g in (
        (F_A, "f_a", site.f_a, "S_S", site.s_s_g),
        (F_V, "f_v", site.f_v, "S_1", site.s_1_g),
    ):
        has_row = site.edition.name == table.edition and site.site_class in table.rows
        if not has_row or coefficient is None or mapped_g is None:
            continue
        tabulated = site_coefficient(table, str(site.site_class), mapped_g)
        if math.isnan(tabulated) or abs(coefficient - tabulated) <= ROUNDING_OF_COEFFICIENTS:
            continue
        text = (
            f"{table.symbol} is {coefficient:g}, {'less' if coefficient < tabulated else 'more'} "
            f"than {tabulated:.4g} in {table.clause} for site class {site.site_class} and {mapped}"
            f" {mapped_g:g}{NO_BREAK}g"
        )
        yield note(Place("site", 0, field), text)


def _slope(index: int, array: Array) -> Iterator[Finding]:
    # A slope of 2 % that is pasted as a number is 0.02.
    if array.slope_unit is SlopeUnit.PERCENT and 0.0 < array.slope_value < MOST_FRACTION:
        value, percent = array.slope_value, 100.0 * array.slope_value
        text = (
            f"slope is {value:g} percent; did you mean {percent:g}%? Correct it, or acknowledge it"
        )
        yield warning(f"slope {array.id}", Place("arrays", index, "slope_value"), text)


def _weight(index: int, array: Array, us_first: bool) -> Iterator[Finding]:
    place = Place("arrays", index, "weight_n")
    pressure, parts_n = array.weight_n / array.shape.area_m2, array.parts_n
    if parts_n is not None and abs(array.weight_n - parts_n) > SAME_WEIGHT * parts_n:
        weight, of_parts = (
            pair(value, Quantity.WEIGHT, us_first) for value in (array.weight_n, parts_n)
        )
        text = (
            f"weight is {weight}, but {numbered(array.modules or 0, 'module')} and the"
            " ballast weigh"
        )
        text += f" {of_parts}, a difference of more than {SAME_WEIGHT:.0%}; correct one of them"
        yield warning(f"weight of modules {array.id}", place, text)
    if LEAST_PRESSURE_PA <= pressure <= MOST_PRESSURE_PA:
        return
    weight = pair(array.weight_n, Quantity.WEIGHT, us_first)
    per_area, low, high = (
        pair(value, Quantity.PRESSURE, us_first)
        for value in (pressure, LEAST_PRESSURE_PA, MOST_PRESSURE_PA)
    )
    text = (
        f"weight is {weight}, {per_area} on the plan area; {low} to {high} is typical: correct the"
    )
    yield warning(f"weight {array.id}", place, f"{text} weight, its unit, or the plan")


def _friction(index: int, array: Array) -> Iterator[Finding]:
    steepness = math.tan(array.slope_rad)
    if array.minimum_mu > steepness:
        return
    text = (
        f"friction coefficient is {array.minimum_mu:g}, not more than the tangent of the slope,"
        f" {steepness:.3f}: the array slides under its own weight; correct one of them"
    )
    yield warning(f"friction {array.id}", Place("arrays", index, "mu"), text)


def _overrides(data: ProjectInput) -> Iterator[Finding]:
    for index, row in enumerate(data.overrides):
        expected = usual(row.provision)
        if not expected.has(row.value):
            text = (
                f"value is {row.value:g} for the {ALLOWED[row.provision].meaning};"
                f" {expected.span} is typical: correct the value or its unit"
            )
            yield warning(f"override {row.provision}", Place("overrides", index, "value"), text)


def _direction(index: int, row: Clearance, array: Array, neighbor: Shape) -> Iterator[Finding]:
    # Shapes that touch have no direction between them.
    if row.direction is Direction.ANY or gap_m(array.shape, neighbor) <= 0.0:
        return
    (x0, y0), (x1, y1) = closest(array.shape, neighbor)
    turned_deg = math.degrees(math.atan2(y1 - y0, x1 - x0)) - array.downslope_deg
    lies = min(_FROM_DOWNSLOPE_DEG, key=lambda direction: _askew_deg(turned_deg, direction))
    if _askew_deg(turned_deg, row.direction) > MOST_ASKEW_DEG:
        text = (
            f"direction is '{row.direction}', but {row.object} is {lies} of {row.array} on the"
            " plan; correct the direction, the plan, or the downslope direction"
        )
        yield warning(f"direction {spoken(row)}", Place("clearances", index, "direction"), text)


def _askew_deg(turned_deg: float, direction: Direction) -> float:
    """Return the angle between a direction and an angle from downslope [deg], 0 to 180."""
    turns = ((turned_deg - nominal) % 360.0 for nominal in _FROM_DOWNSLOPE_DEG[direction])
    return min(min(turn, 360.0 - turn) for turn in turns)


def _provided(data: ProjectInput, short: Mapping[int, float]) -> Iterator[Finding]:
    """Yield clearances below the gap of the plan [m], by row; those in one wrong unit together."""
    us_first = data.us_first
    by_unit: dict[tuple[float, str], list[int]] = {}
    for index, gap in short.items():
        by_unit.setdefault(_mistaken(data.clearances[index].provided_m, gap), []).append(index)
    for (ratio, unit), rows in by_unit.items():
        place = Place("clearances", rows[0], "provided_m")
        if unit and len(rows) >= LEAST_ALIKE:
            text = (
                f"{counted(len(rows), 'clearance')} are 1/{ratio:.4g} of the distances on"
                f" the plan; are they in {unit}?"
            )
            text += (
                f" The first is {spoken(data.clearances[rows[0]])}; correct the clearances"
                " or the plan"
            )
            yield warning(f"clearances in {unit}", place, text)
            continue
        for index in rows:
            row, place = data.clearances[index], Place("clearances", index, "provided_m")
            stated, plan = (
                pair(m, Quantity.SIZE, us_first, no_more) for m in (row.provided_m, short[index])
            )
            text = f"provided clearance is {stated}, but {row.array} and {row.object} are {plan}"
            text += " apart on the plan; correct the clearance or the plan"
            yield warning(f"clearance {spoken(row)}", place, text)


def _mistaken(provided_m: float, gap: float) -> tuple[float, str]:
    """Return the factor by which a clearance is too small, and its likely unit; 1 if none."""
    # As where feet are typed into a column of inches; what is too large is an error.
    for unit, size in LENGTHS.items():
        for read in LENGTHS.values():
            if size > read and abs(provided_m * size / read - gap) <= gap_tolerance_m(gap):
                return size / read, _UNITS[unit]
    return 1.0, ""


# Difference from a limit / limit that is rounding error of a conversion of units.
ROUNDING = 1e-9


@cache
def _ranged(section: SheetSection) -> Sequence[tuple[Entry, float, float]]:
    """Return the fields of a section with a typical range, and its ends."""
    return [
        (entry, entry.expected.low * (1.0 - ROUNDING), entry.expected.high * (1.0 + ROUNDING))
        for entry in section.entries
        if entry.usual is not None
    ]


def unusual(data: ProjectInput) -> Iterator[Finding]:
    """Yield a warning for each number outside its typical range."""
    is_us = data.us_first
    for section in SECTIONS:
        rows = getattr(data, section.key)
        for index, row in enumerate(rows if section.is_table else (rows,)):
            # An edge without parapet has height 0, which is no object too low.
            is_bare = getattr(row, "kind", None) is ObjectKind.EDGE_WITHOUT_PARAPET
            for entry, low, high in _ranged(section):
                value = getattr(row, entry.name)
                is_none = value == 0.0 and (is_bare or entry.zero)
                if value is None or low <= value <= high or is_none:
                    continue
                yield _warning(section, index, entry, row, is_us)


def _warning(section: SheetSection, index: int, entry: Entry, row: Frozen, is_us: bool) -> Finding:
    unit = entry.unit_in(is_us=is_us)
    symbol, si = (unit.symbol, unit.si) if unit else (str(entry.unit), 1.0)
    value, span = f"{getattr(row, entry.name) / si:.4g}", entry.expected.words(si)
    text = f"{entry.spoken} is {with_unit(value, symbol)}; {with_unit(span, symbol)}"
    # The sheet Acknowledged answers a warning by this name: reasons of former workbooks depend on
    # it.
    name = " ".join(f"usual {entry.spoken} {_named(row)}".split())
    place = Place(section.key, index, entry.name)
    return warning(name, place, f"{text} is typical: correct the value or its unit")


def _named(row: Frozen) -> str:
    """Return the identifier of a row of a table; nothing for single cells."""
    match row:
        case Array() | RoofObject() | MotionInput():
            return row.id
        case Clearance():
            return spoken(row)
        case FrictionTestRow():
            return f"{row.report or ''} {row.surface} {row.number}"
    return ""


def spoken(row: Clearance) -> str:
    """Return a clearance as text."""
    where = "" if row.direction is Direction.ANY else f" {row.direction}"
    return f"{row.array} to {row.object}{where}"
