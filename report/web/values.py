"""Converts values of sliders and choices into entries of the workbook.

A value is nothing but other contents of cells, so that the workbook written from it is assessed
alike; no physics and no rule. Read `typed` first, then `report.web.controls`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from report.project.model.array import coefficients, slope_rad
from report.project.model.choices import Scaling, SlopeUnit
from report.project.model.input_rows import Place
from report.project.model.shapes import SIDES, Rectangle, Shape, gap_m
from report.project.read.what_if import Typed, size_of_unit
from report.project.read.workbook_data import Sheet
from solver.model import INCH_M
from solver.rules.hazard import EDITIONS

Values = Mapping[str, float | str]
"""By id, as `friction`, or `friction@A1` for one array alone; one that is not there is as typed."""

MUS = ("mu", "mu_fast", "mu_static")
SHORT_PERIOD = ("s_s_g", "s_ms_g", "s_ds_g")
"""From mapped to design values: each follows from the one before."""

UNITS_FIRST = Place("project", 0, "units_first")

_MU_DIGITS, _SLOPE_DIGITS, _PLAN_DIGITS = 4, 4, 6


def typed(sheet: Sheet, scales: Mapping[str, float], values: Values) -> dict[Place, Typed]:
    """Return the cell entries for the values of sliders and choices.

    `scales` is the factor on the records of each motion, as the workbook has it.
    """
    factors = {name: float(values.get(name, 1.0)) for name in ("intensity", "s_ds")}
    if sheet.project.motions and values.get("together", "yes") == "yes":
        factors["s_ds"] = factors["intensity"]
    changed: dict[Place, Typed] = dict(_friction(sheet, values)) | dict(_slope(sheet, values))
    if factors["s_ds"] != 1.0:
        changed |= dict(_s_ds(sheet, factors["s_ds"]))
    if factors["intensity"] != 1.0 or factors["s_ds"] != 1.0:
        changed |= dict(_intensity(sheet, scales, factors["intensity"]))
    changed |= dict(_trim(sheet, values))
    first = sheet.inputs["project"][0]["units_first"]
    if (units := values.get("units", first)) != first:
        changed[UNITS_FIRST] = units
    return changed | dict(_polarity(sheet, values)) | dict(_rule_set(sheet, values))


def _given(sheet: Sheet, section: str, fields: tuple[str, ...]) -> Iterator[tuple[Place, float]]:
    """Yield the numbers that are given in a section."""
    for index, row in enumerate(sheet.inputs[section]):
        for field in fields:
            if row.get(field) is not None:
                yield Place(section, index, field), row[field]


def _value_of(values: Values, control: str, target: object, none: float) -> float:
    """Return the value of a control for an array or a clearance: its own, or that of all."""
    return float(values.get(f"{control}@{target}", values.get(control, none)))


def _friction(sheet: Sheet, values: Values) -> Iterator[tuple[Place, Typed]]:
    """Multiply the coefficients: a law by velocity as a whole, and those of linked blocks."""
    rows = sheet.inputs["arrays"]
    for place, mu in _given(sheet, "arrays", MUS):
        factor = _value_of(values, "friction", rows[place.row]["id"], 1.0)
        if factor != 1.0:
            yield place, round(mu * factor, _MU_DIGITS)
    for index, row in enumerate(sheet.inputs["links"]):
        factor = _value_of(values, "friction", row["array"], 1.0)
        if factor != 1.0:
            mus = (round(mu * factor, _MU_DIGITS) for mu in coefficients(row["friction"]))
            yield Place("links", index, "friction"), ", ".join(map(str, mus))


def _slope(sheet: Sheet, values: Values) -> Iterator[tuple[Place, Typed]]:
    for index, row in enumerate(sheet.inputs["arrays"]):
        unit, turn_deg = row["slope_unit"], _value_of(values, "slope", row["id"], 0.0)
        if not turn_deg:
            continue
        # As in the cell no slope is less than 0.
        angle = max(slope_rad(row["slope_value"], unit) + math.radians(turn_deg), 0.0)
        per_one = {SlopeUnit.PERCENT: 100.0, SlopeUnit.IN_PER_12: 12.0}
        is_angle = unit is SlopeUnit.DEGREES
        value = math.degrees(angle) if is_angle else per_one[unit] * math.tan(angle)
        yield Place("arrays", index, "slope_value"), round(value, _SLOPE_DIGITS)


def _s_ds(sheet: Sheet, factor: float) -> Iterator[tuple[Place, Typed]]:
    """Multiply S_DS, and S_MS if given, without S_S: another S_S has another site coefficient."""
    mapped, maximum, design = SHORT_PERIOD
    for place, _ in _given(sheet, "site", (mapped,)):
        yield place, None
    for place, value in _given(sheet, "site", (maximum,)):
        yield place, _rounded(value * factor)
    yield Place("site", 0, design), _rounded(sheet.project.site.s_ds * factor)


def _intensity(
    sheet: Sheet, scales: Mapping[str, float], factor: float
) -> Iterator[tuple[Place, Typed]]:
    """Multiply the factor of each motion; one scaled to a target keeps its factor as a number."""
    for index, row in enumerate(sheet.inputs["motions"]):
        scaling, value = row["scaling"], row["scale_value"]
        if scaling is Scaling.PPA:
            yield Place("motions", index, "scale_value"), _rounded(value * factor)
            continue
        scale = scales[row["id"]]
        # Else it would be scaled to its target again, whatever the sliders say.
        if scaling is Scaling.TARGET or factor != 1.0:
            yield Place("motions", index, "scaling"), Scaling.FACTOR.value
            yield Place("motions", index, "scale_value"), _rounded(scale * factor)


def _trim(sheet: Sheet, values: Values) -> Iterator[tuple[Place, Typed]]:
    """Move the sides of every rectangular array inward, and let the clearances follow the plan.

    A clearance by itself is changed beside that: its number is its row.
    """
    project = sheet.project
    unit_m = INCH_M if project.us_first else 0.001
    trim_m = float(values.get("clearance", 0.0)) * unit_m
    rows = range(1, len(project.clearances) + 1)
    own_m = {row: float(values.get(f"clearance@{row}", 0.0)) * unit_m for row in rows}
    before: dict[str, Shape] = {row.id: row.placed for row in project.objects if row.placed}
    before |= {array.id: array.shape for array in project.arrays}
    after = dict(before)
    for index, array in enumerate(project.arrays if trim_m else ()):
        # Others have no cell for each side.
        if not isinstance(array.placed, Rectangle):
            continue
        x0, x1, y0, y1 = (getattr(array, side) for side in SIDES)
        places = [Place("arrays", index, side) for side in SIDES]
        moved = (x0 + trim_m, x1 - trim_m, y0 + trim_m, y1 - trim_m)
        cells = [_in_cell(sheet, *pair) for pair in zip(places, moved, strict=True)]
        yield from zip(places, cells, strict=True)
        after[array.id] = Rectangle(*moved)
    for index, row in enumerate(project.clearances):
        names = (row.array, row.object)
        if all(name in before for name in names):
            more = gap_m(*(after[n] for n in names)) - gap_m(*(before[n] for n in names))
        else:
            # What has no location on the plan is moved away from by one side.
            more = trim_m * any(after[n] is not before[n] for n in names if n in before)
        more += own_m[index + 1]
        place = Place("clearances", index, "provided_m")
        if trim_m or more:
            yield place, _in_cell(sheet, place, max(row.provided_m + more, 0.0))


def _in_cell(sheet: Sheet, place: Place, value: float) -> float:
    return round(value / size_of_unit(sheet, place), _PLAN_DIGITS)


def _polarity(sheet: Sheet, values: Values) -> Iterator[tuple[Place, Typed]]:
    asked = str(values.get("polarity", ""))
    for index, row in enumerate(sheet.inputs["motions"]):
        if asked not in ("", row["polarity"]):
            yield Place("motions", index, "polarity"), asked


def _rule_set(sheet: Sheet, values: Values) -> Iterator[tuple[Place, Typed]]:
    """Change the rule set, and leave blank an edition that would contradict it."""
    site = sheet.inputs["site"][0]
    asked = values.get("rule_set", site["rule_set"])
    if asked == site["rule_set"]:
        return
    yield Place("site", 0, "rule_set"), str(asked)
    edition = site["edition_name"]
    # `check` refuses two editions that differ; PV1-2012 goes with any.
    if edition is not None and asked in EDITIONS and edition != asked:
        yield Place("site", 0, "edition_name"), None


def _rounded(value: float) -> float:
    return float(f"{value:.6g}")
