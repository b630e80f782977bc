"""All faults of an input that involve more than one cell; each names the cell to change.

Works on the readable values, so that one invalid cell hides no other fault.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping

from report.project.check.array_faults import friction_faults, link_faults
from report.project.check.motion_faults import motion_faults
from report.project.check.plan_faults import clearance_faults, plan_faults
from report.project.check.site_faults import site_faults
from report.project.model.array import WEIGHT_PARTS, slope_rad
from report.project.model.choices import ObjectKind, PackageEdition, RecordedAt, Scaling, SlopeUnit
from report.project.model.finding import Finding
from report.project.model.input_rows import (
    InputRow,
    Inputs,
    Place,
    Where,
    column,
    repeated,
    suggestion,
)
from report.project.model.options import factors
from report.project.model.overrides import provision_name
from report.project.model.shapes import SIDES
from report.project.workbook import SECTION
from report.text.typed_letters import cut, foreign_letters, looks
from solver.rules.rulesets import ALLOWED, RULE_SETS
from solver.suggestions import nearest

# Tables whose ids differ from each other, without regard to capitals.
UNIQUE = (("arrays", "objects"), ("motions",))


# Fields that name a row of other tables; an outline may be that of the roof.
REFERENCES: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("clearances", "array"): ("arrays",),
    ("clearances", "object"): ("objects", "arrays"),
    ("links", "array"): ("arrays",),
    ("outlines", "name"): ("arrays", "objects"),
}


def faults(inputs: Inputs, where: Where) -> list[Finding]:
    """Return all inconsistencies of inputs, whose blank optional fields have their defaults."""
    checks = (
        _tables,
        missing,
        _unknown,
        _ids,
        site_faults,
        plan_faults,
        _arrays,
        friction_faults,
        clearance_faults,
        motion_faults,
        link_faults,
        _overrides,
        _smaller_events,
        _letter_edition,
    )
    findings: list[Finding] = []
    for check in checks:
        findings += check(inputs, where)
    return findings


def _tables(inputs: Inputs, where: Where) -> Iterator[Finding]:
    if not inputs["arrays"]:
        yield Finding.error(Place("arrays"), "no array is entered", "fill in at least one row")


def _ids(inputs: Inputs, where: Where) -> Iterator[Finding]:
    # Arrays come first, so that a duplicate is reported at the object.
    for sections in UNIQUE:
        # By how they look: RTU-1 with a Cyrillic letter is no second unit, but a slip that no eye
        # can find.
        for place, value, first in repeated(column(inputs, sections, "id"), looks):
            text, foreign = (
                f"ID is '{value}', already used at {where(first)}",
                foreign_letters(value),
            )
            yield Finding.error(
                place, text + (f"; {foreign}" if foreign else ""), "enter a unique ID"
            )


def _arrays(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for index, row in enumerate(inputs["arrays"]):
        yield from _slope(index, row)
        yield from _friction(index, row)


def _slope(index: int, row: InputRow) -> Iterator[Finding]:
    value, unit = row.get("slope_value"), row.get("slope_unit")
    if value is None or unit is None or math.degrees(slope_rad(value, unit)) < MAX_SLOPE_DEG:
        return
    # 45 degrees in each unit.
    limit = {SlopeUnit.DEGREES: "45", SlopeUnit.PERCENT: "100", SlopeUnit.IN_PER_12: "12"}[unit]
    remedy = f"enter 0 to less than {limit} {unit}"
    yield Finding.error(Place("arrays", index, "slope_value"), f"slope is {value:g} {unit}", remedy)


def _friction(index: int, row: InputRow) -> Iterator[Finding]:
    # A cell that could not be read is absent, and has an error of its own.
    if not row.keys() >= {"mu", "mu_static"}:
        return
    mu, static = row["mu"], row["mu_static"]
    if static is not None and static < mu:
        text = f"static friction is {static:g}"
        remedy = f"enter the friction coefficient, {mu:g}, or more"
        yield Finding.error(Place("arrays", index, "mu_static"), text, remedy)


def _unknown(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield names that are in no table; `plan_faults` checks those of outlines."""
    for (section, field), tables in REFERENCES.items():
        if section == "outlines":
            continue
        ids = dict.fromkeys(value for _, value in column(inputs, tables, "id"))
        sheets = " or ".join(table.capitalize() for table in tables)
        for place, value in column(inputs, (section,), field):
            if value not in ids:
                text = f"{field} is '{value}', which is not in {sheets}"
                yield Finding.error(place, text, suggestion(value, ids))


def _smaller_events(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for place, text in column(inputs, ("options",), "smaller_events"):
        if text and not factors(text):
            remedy = "enter up to 20 factors with decimal points, above 0.0 and up to 1.0"
            fault = f"smaller events is '{cut(text)}'"
            yield Finding.error(place, fault, f"{remedy}, such as 0.50, 0.25")


def _letter_edition(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield inputs that do not fit on the two sheets of the letter edition."""
    n_arrays = len(inputs["arrays"])
    rejections = {
        f"permits at most six arrays; {n_arrays} are entered": n_arrays > 6,
        "does not permit an analysis, but motions are listed": inputs["motions"],
        "does not permit overrides": inputs["overrides"],
    }
    remedy = "choose plan check or complete, or delete what the letter cannot contain"
    for place, edition in column(inputs, ("options",), "package_edition"):
        for fault, is_found in rejections.items():
            if edition == PackageEdition.LETTER and is_found:
                yield Finding.error(place, f"edition is letter, which {fault}", remedy)


def _overrides(inputs: Inputs, where: Where) -> Iterator[Finding]:
    keys = list(column(inputs, ("overrides",), "provision"))
    names = {key: provision_name(key) for key in ALLOWED}
    # Where the rule set could not be read, no provision is missing from it.
    rules = next((RULE_SETS[name] for _, name in column(inputs, ("site",), "rule_set")), None)
    for place, key in keys:
        if key not in names:
            near = nearest(key, names.values())
            remedy = (
                f"did you mean '{near}'?" if near else "choose a name from the list of the cell"
            )
            yield Finding.error(place, f"provision is '{cut(key)}'", remedy)
        elif rules and key not in rules.values:
            fault = f"provision is '{names[key]}', which is not in {rules.name}"
            yield Finding.error(place, fault, "delete the row")
    for place, key, first in repeated(cell for cell in keys if cell[1] in names):
        fault = f"provision is '{names[key]}', already entered at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, value in column(inputs, ("overrides",), "value"):
        key = inputs["overrides"][place.row].get("provision", "")
        allowed = ALLOWED.get(key)
        if allowed and not allowed.has(value):
            fault = f"value is {value:g} for the {ALLOWED[key].meaning}"
            yield Finding.error(place, fault, f"enter {allowed.words}")


# Slope of an array from which it is refused.
MAX_SLOPE_DEG = 45.0


# Whether a condition holds for a row as read; not where a cell could not be read.
Condition = Callable[[InputRow, Inputs], bool]


def _filled(*fields: str) -> Condition:
    return lambda row, _: any(row.get(field) not in (None, "") for field in fields)


def _chosen(field: str, *choices: str) -> Condition:
    return lambda row, _: row.get(field) in choices


def _has_no_outline(row: InputRow, inputs: Inputs) -> bool:
    return "id" in row and all(vertex.get("name") != row["id"] for vertex in inputs["outlines"])


_OR_NONE = "enter all four sides of the rectangle, or none"
_OR_OUTLINE = "enter all four sides of the rectangle, or an outline on the Outlines worksheet"
_LAW = "enter high-velocity friction and friction rate, or neither"
_CODE = "enter building code and year, or neither"
_BOTH = "enter latitude and longitude, or neither"
_CONFIRMED = "enter who confirmed the drawing distances and when, or neither"
_ALL_FIVE = "enter all five cells of the confirmation, or none"
_CONFIRMATION = ("by", "date", "rule_set", "edition", "code")

# Optional cells that are required where others say so: when, and what would do.
REQUIRED: Mapping[tuple[str, str], tuple[Condition, str]] = {
    ("site", "building_code"): (_filled("building_code_year"), _CODE),
    ("site", "building_code_year"): (_filled("building_code"), _CODE),
    ("site", "latitude_deg"): (_filled("longitude_deg"), _BOTH),
    ("site", "longitude_deg"): (_filled("latitude_deg"), _BOTH),
    ("project", "drawing_confirmed_by"): (_filled("drawing_confirmed_date"), _CONFIRMED),
    ("project", "drawing_confirmed_date"): (_filled("drawing_confirmed_by"), _CONFIRMED),
    **{("confirmation", field): (_filled(*_CONFIRMATION), _ALL_FIVE) for field in _CONFIRMATION},
    **{("roof", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    **{("arrays", side): (_has_no_outline, _OR_OUTLINE) for side in SIDES},
    **{("objects", side): (_filled(*SIDES), _OR_NONE) for side in SIDES},
    ("objects", "height_m"): (
        _chosen("kind", ObjectKind.EDGE_WITH_PARAPET), "enter the parapet's height above the roof"),
    ("arrays", "weight_n"): (
        # A part that could not be read is absent: then nothing is said of the weight.
        lambda row, _: row.keys() >= {*WEIGHT_PARTS} and None in map(row.get, WEIGHT_PARTS),
        "enter it, or modules, module weight and ballast weight"),
    ("arrays", "mu_fast"): (_filled("mu_rate_s_per_m"), _LAW),
    ("arrays", "mu_rate_s_per_m"): (_filled("mu_fast"), _LAW),
    ("motions", "scale_value"): (
        _chosen("scaling", Scaling.FACTOR, Scaling.PPA), "enter the factor, or the PPA in g"),
    ("building", "period_s"): (
        lambda row, inputs: row.get("structure", "") is None
        and any(motion.get("recorded_at") is RecordedAt.GROUND for motion in inputs["motions"]),
        "enter it, or a structure type, because a ground motion is listed"),
}  # fmt: skip


def missing(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield blank cells that are required by others."""
    for (section, field), (is_required, remedy) in REQUIRED.items():
        for index, row in enumerate(inputs[section]):
            # What could not be read is not blank, and has an error of its own.
            is_blank = field in row and row[field] in (None, "")
            if is_blank and is_required(row, inputs):
                fault = f"{SECTION[section].entry(field).spoken} is missing"
                yield Finding.error(Place(section, index, field), fault, remedy)
