"""Checks of the input that involve more than one cell; each fault names the cell to change.

Works on the values that could be read, so that one invalid cell hides no other fault.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from report.project.check import plan_checks
from report.project.check.findings import column, repeated, suggestion
from report.project.check.motion_checks import friction_faults, motion_faults
from report.project.check.plan_checks import MAX_SLOPE_DEG, places_of, us_first
from report.project.model import factors, provision_name
from report.project.model.choices import SlopeUnit
from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs
from report.project.model.motions import coefficients
from report.project.model.place import Place, Where
from report.project.model.scene import slope_rad
from report.project.model.shapes import Rectangle, Shape, gap_m
from report.project.model.site import (
    categories,
    category_lacks,
    edition_of_row,
    site_class_or_default,
    site_parameters,
)
from report.text.counts import cut, foreign_letters, looks
from report.text.units import Quantity, no_more, pair
from solver.model import INCH_M
from solver.rules import hazard
from solver.rules.hazard import LEAST_I_E, Edition, HazardBasis
from solver.rules.rulesets import ALLOWED, RULE_SETS
from solver.rules.site_coefficients import F_A, F_V, CoefficientTable, site_coefficient
from solver.suggestions import nearest

GAP_TOLERANCE = 0.01
# Below the inch at which a package states that a clearance contradicts the plan
# (`report.assessment.plan.neighbors`): what passes here passes there.
GAP_TOLERANCES_M = (0.5 * INCH_M, 0.99 * INCH_M)


def gap_tolerance_m(gap_m: float) -> float:
    """Return how far a clearance may be from the gap of the plan [m]."""
    low, high = GAP_TOLERANCES_M
    return min(max(GAP_TOLERANCE * gap_m, low), high)


def faults(inputs: Inputs, where: Where) -> list[Finding]:
    """Return all inconsistencies of inputs, whose blank optional fields have their defaults."""
    checks = (
        _tables,
        plan_checks.missing,
        _unknown,
        _ids,
        site_faults,
        plan_checks.plan_faults,
        _arrays,
        friction_faults,
        _clearances,
        motion_faults,
        _links,
        _overrides,
        _smaller_events,
    )
    return [fault for check in checks for fault in check(inputs, where)]


def _tables(inputs: Inputs, where: Where) -> Iterator[Finding]:
    if not inputs["arrays"]:
        yield Finding.error(Place("arrays"), "no array is given", "fill in at least one row")


def _ids(inputs: Inputs, where: Where) -> Iterator[Finding]:
    # Arrays come first, so that a duplicate is reported at the object.
    for sections in plan_checks.UNIQUE:
        for place, value, first in repeated(column(inputs, sections, "id"), looks):
            text, said = f"ID is '{value}', already used at {where(first)}", foreign_letters(value)
            yield Finding.error(place, text + (f"; {said}" if said else ""), "give a unique ID")


def _arrays(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for index, row in enumerate(inputs["arrays"]):
        yield from _slope(index, row)
        yield from _friction(index, row)


def _slope(index: int, row: InputRow) -> Iterator[Finding]:
    value, unit = row.get("slope_value"), row.get("slope_unit")
    if value is None or unit is None or math.degrees(slope_rad(value, unit)) < MAX_SLOPE_DEG:
        return
    # 45 degrees in each unit.
    most = {SlopeUnit.DEGREES: "45", SlopeUnit.PERCENT: "100", SlopeUnit.IN_PER_12: "12"}[unit]
    wanted = f"give 0 to less than {most} {unit}"
    yield Finding.error(Place("arrays", index, "slope_value"), f"slope is {value:g} {unit}", wanted)


def _friction(index: int, row: InputRow) -> Iterator[Finding]:
    # A cell that could not be read is absent, and has an error of its own.
    if not row.keys() >= {"mu", "mu_static"}:
        return
    mu, static = row["mu"], row["mu_static"]
    if static is not None and static < mu:
        text = f"static friction is {static:g}"
        wanted = f"give the friction coefficient, {mu:g}, or more"
        yield Finding.error(Place("arrays", index, "mu_static"), text, wanted)


def _by_speed(array: InputRow) -> list[str]:
    """Return the fields that give an array more than one friction coefficient."""
    same = (None, array["mu"])
    return [name for name in ("mu_fast", "mu_static") if array.get(name) not in same]


def _clearances(inputs: Inputs, where: Where) -> Iterator[Finding]:
    fields = ("array", "object", "direction")
    rows = enumerate(inputs["clearances"])
    named = ((Place("clearances", i, "array"), tuple(map(row.get, fields))) for i, row in rows)
    for place, (array, *_), first in repeated(cell for cell in named if None not in cell[1]):
        text = f"array is '{array}', with the same object and direction as at {where(first)}"
        yield Finding.error(place, text, "delete one")
    shapes = plan_checks.shapes_of(inputs)
    for index, row in enumerate(inputs["clearances"]):
        yield from _room(index, row, shapes, inputs, where)


def _unknown(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield names of what is in no table; `plan_checks` has those of outlines."""
    for (section, field), tables in plan_checks.REFERENCES.items():
        if section == "outlines":
            continue
        ids = dict.fromkeys(value for _, value in column(inputs, tables, "id"))
        sheets = " or ".join(table.capitalize() for table in tables)
        for place, value in column(inputs, (section,), field):
            if value not in ids:
                text = f"{field} is '{value}', which is not in {sheets}"
                yield Finding.error(place, text, suggestion(value, ids))


def _room(
    index: int, row: InputRow, shapes: Mapping[str, Shape], inputs: Inputs, where: Where
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
    # Shapes that touch are apart by rounding error, of either sign.
    if gap >= -1e-9 and provided <= gap + gap_tolerance_m(gap):
        return
    boxes = isinstance(a, Rectangle) and isinstance(b, Rectangle)
    noun = "rectangles" if boxes else "outlines"
    stated, most = (
        pair(max(m, 0.0), Quantity.SIZE, us_first(inputs), no_more) for m in (provided, gap)
    )
    at, text = (
        places_of(inputs, (str(array), str(other)), where),
        f"provided clearance is {stated}",
    )
    if gap < -1e-9:
        text += f", but {array} and {other} overlap in plan"
        yield Finding.error(place, text, f"correct their {noun} in {at}")
    else:
        text += f", but {array} and {other} are {most} apart in plan"
        yield Finding.error(place, text, f"reduce it, or correct the {noun} in {at}")


def _links(inputs: Inputs, where: Where) -> Iterator[Finding]:
    arrays = {name: place for place, name in column(inputs, ("arrays",), "id")}
    named = list(column(inputs, ("links",), "array"))
    for place, name, first in repeated(named):
        fault = f"array is '{name}', already given at {where(first)}"
        yield Finding.error(place, fault, "delete one")
    for place, name in named:
        # A name that is unknown has an error of its own.
        array = inputs["arrays"][arrays[name].row] if name in arrays else {}
        # A block of a row has one coefficient (`solver.sliding.row.BlockRow`).
        if "mu" in array and _by_speed(array):
            text = f"array is '{name}', which has high-velocity or static friction"
            wanted = "leave both blank on the sheet Arrays, or delete this row"
            yield Finding.error(place, text, wanted)
    for place, text in column(inputs, ("links",), "friction"):
        home = arrays.get(inputs["links"][place.row].get("array", ""))
        yield from _blocks(place, text, inputs, where, home)


def _blocks(
    place: Place, text: str, inputs: Inputs, where: Where, home: Place | None
) -> Iterator[Finding]:
    mus = coefficients(text)
    if not mus:
        wanted = "give 2 to 20 coefficients from 0 to 1.5 with decimal points, such as 0.40, 0.45"
        yield Finding.error(place, f"block friction is '{text}'", f"{wanted}, 0.50")
        return
    mu = inputs["arrays"][home.row].get("mu") if home else None
    if home is not None and mu is not None and not min(mus) <= mu <= max(mus):
        side, at = "above" if mu < min(mus) else "below", where(home._replace(field="mu"))
        fault = f"block friction is '{text}', all {side} the {mu:g} at {at}"
        yield Finding.error(place, fault, "give a range that includes it, or change it")


def _smaller_events(inputs: Inputs, where: Where) -> Iterator[Finding]:
    for place, text in column(inputs, ("options",), "smaller_events"):
        if text and not factors(text):
            wanted = "give up to 20 factors with decimal points, above 0.0 and up to 1.0"
            fault = f"smaller events is '{cut(text)}'"
            yield Finding.error(place, fault, f"{wanted}, such as 0.50, 0.25")


def _overrides(inputs: Inputs, where: Where) -> Iterator[Finding]:
    keys = list(column(inputs, ("overrides",), "provision"))
    names = {key: provision_name(key) for key in ALLOWED}
    # Where the rule set could not be read, no provision is missing from it.
    rules = next((RULE_SETS[name] for _, name in column(inputs, ("site",), "rule_set")), None)
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
    for place, value in column(inputs, ("overrides",), "value"):
        key = inputs["overrides"][place.row].get("provision", "")
        allowed = ALLOWED.get(key)
        if allowed and not allowed.has(value):
            fault = f"value is {value:g} for the {ALLOWED[key].meaning}"
            yield Finding.error(place, fault, f"give {allowed.words}")


# Difference allowed between a value and the same from other cells: it is typed as a permit sheet
# or a hazard tool prints it, rounded to two decimals or more.
AGREES_G = 0.0051
# Difference of a site coefficient from its table that is rounding: to two decimals.
ROUNDING_OF_COEFFICIENTS = 0.0051

_SDC = "seismic design category"
_Chain = tuple[tuple[str, str], ...]

# Names at the short period and at 1 s: mapped, coefficient, maximum considered, design.
_CHAINS = (
    (("s_s_g", "S_S"), ("f_a", "F_a"), ("s_ms_g", "S_MS"), ("s_ds_g", "S_DS")),
    (("s_1_g", "S_1"), ("f_v", "F_v"), ("s_m1_g", "S_M1"), ("s_d1_g", "S_D1")),
)


def site_faults(inputs: Inputs, where: Where) -> Iterator[Finding]:
    """Yield inconsistencies of the site."""
    for row in inputs["site"]:
        yield from _importance(row)
        edition = edition_of_row(row)
        if edition is None:
            continue
        yield from _edition(row, edition)
        yield from _missing_s_ds(row, edition)
        yield from _site_class(row, edition)
        for chain, table in zip(_CHAINS, (F_A, F_V), strict=True):
            yield from _agreement(row, edition, chain)
            yield from _below_table(row, edition, chain, table, where)
        yield from _sdc(row)


def _fault(field: str, fault: str, wanted: str) -> Finding:
    return Finding.error(Place("site", 0, field), fault, wanted)


def _importance(row: InputRow) -> Iterator[Finding]:
    risk_category, i_e = row.get("risk_category"), row.get("i_e")
    if risk_category is None or i_e is None or i_e >= LEAST_I_E[risk_category]:
        return
    wanted = f"give at least {LEAST_I_E[risk_category]:g} for risk category {risk_category}"
    yield _fault("i_e", f"importance factor I_e is {i_e:g}", wanted)


def _edition(row: InputRow, edition: Edition) -> Iterator[Finding]:
    rule_set = row["rule_set"]
    # PV1-2012 is no edition of ASCE 7: it goes with each of them.
    if rule_set in hazard.EDITIONS and rule_set != edition.name:
        text = f"edition of ASCE 7 is '{edition.name}', but the rule set is '{rule_set}'"
        yield _fault("edition_name", text, "leave it blank, or correct one")
    # From ASCE 7-22 on, S_MS and S_M1 are read off for a site class.
    if edition.has_site_coefficients:
        return
    for field, label, other in (("f_a", "F_a", "S_MS or S_DS"), ("f_v", "F_v", "S_M1 or S_D1")):
        if row.get(field) is not None:
            text = f"{label} is {row[field]:g}, but {edition.name} has no site coefficients"
            wanted = f"leave it blank and give {other} from a hazard tool"
            yield _fault(field, text, wanted)


def _missing_s_ds(row: InputRow, edition: Edition) -> Iterator[Finding]:
    parameters = site_parameters(row)
    if parameters is None or parameters.s_ds is not None:
        return
    has_coefficients = edition.has_site_coefficients
    missing = [n for n in ("s_s_g", "f_a") if row[n] is None] if has_coefficients else []
    field = missing[0] if len(missing) == 1 else "s_ds_g"
    label = {"s_ds_g": "S_DS", "s_s_g": "S_S", "f_a": "F_a"}[field]
    wanted = "give S_DS, S_MS, or both S_S and F_a" if has_coefficients else "give S_DS or S_MS"
    yield _fault(field, f"{label} is missing", wanted)


def _agreement(row: InputRow, edition: Edition, chain: _Chain) -> Iterator[Finding]:
    """Yield a value that differs from the same derived from other cells of its chain."""
    mapped, coefficient, maximum, _ = (row.get(name) for name, _ in chain)
    (_, mapped_label), (_, factor_label), (name, label), design = chain
    product = None
    if edition.has_site_coefficients and mapped is not None and coefficient is not None:
        product = coefficient * mapped
    factors = f"{factor_label} {mapped_label}"
    for (field, symbol), words, derived in (
        ((name, label), factors, product),
        (design, f"2/3 {label}", _design(maximum)),
        (design, f"2/3 {factors}", _design(product)),
    ):
        value = row.get(field)
        if value is not None and derived is not None and abs(value - derived) > AGREES_G:
            text = f"{symbol} is {value:g} g, but {words} is {derived:.4f} g"
            # One fault is enough: the next ones would follow from the same cell.
            yield _fault(field, text, "leave one of them blank, or correct it")
            return


def _design(maximum_g: float | None) -> float | None:
    return None if maximum_g is None else 2.0 / 3.0 * maximum_g


def _site_class(row: InputRow, edition: Edition) -> Iterator[Finding]:
    site_class = row.get("site_class")
    # BC, CD and DE came with ASCE 7-22.
    if edition.has_site_coefficients and site_class is not None and site_class not in F_A.rows:
        text = f"site class is '{site_class}', which {edition.name} does not have"
        yield _fault("site_class", text, f"give one of {', '.join(F_A.rows)}")


def _below_table(
    row: InputRow, edition: Edition, chain: _Chain, table: CoefficientTable, where: Where
) -> Iterator[Finding]:
    """Yield what is below that of the mapped value, the site class and the table of its edition."""
    # A given coefficient is compared with the table, and `_agreement` compares the rest with it.
    (mapped, symbol), (coefficient, factor), maximum, design = chain
    mapped_g, entered = row.get(mapped), row.get(coefficient)
    tabulated = _tabulated(row, edition, mapped_g, table)
    if mapped_g is None or coefficient not in row or math.isnan(tabulated):
        return
    of_class = f"for site class '{site_class_or_default(row['site_class'])}'"
    of_class += "" if row["site_class"] else ", assumed because none is given"
    if entered is not None:
        if entered < tabulated - ROUNDING_OF_COEFFICIENTS:
            wanted = f"give at least {tabulated:.4g} {of_class} and {symbol} of {mapped_g:g} g in"
            at = where(Place("site", 0, mapped))
            yield _or_study(coefficient, f"{factor} is {entered:g}", f"{wanted} {at}", table)
        return
    for (name, label), share, words in ((maximum, 1.0, ""), (design, 2.0 / 3.0, "2/3 ")):
        value, least = row.get(name), share * tabulated * mapped_g
        if value is not None and value < least - AGREES_G:
            wanted = f"give at least {math.ceil(1e3 * least) / 1e3:g} g, which is {words}{factor}"
            wanted += f" {symbol} with {factor} of {tabulated:.4g} {of_class}"
            yield _or_study(name, f"{label} is {value:g} g", wanted, table)


def _tabulated(
    row: InputRow, edition: Edition, mapped_g: float | None, table: CoefficientTable
) -> float:
    """Return the coefficient of a table; NaN for none, or where a site-specific one may be less."""
    # Where a table has none, a site-specific analysis is a requirement of the package.
    if edition.name != table.edition or mapped_g is None or "site_class" not in row:
        return math.nan
    site_class = site_class_or_default(row["site_class"])
    is_studied = row.get("hazard") in (None, HazardBasis.SITE_SPECIFIC)
    has_none = is_studied or site_class not in table.rows
    return math.nan if has_none else site_coefficient(table, site_class, mapped_g)


def _or_study(field: str, fault: str, wanted: str, table: CoefficientTable) -> Finding:
    out = f"or select the hazard basis '{HazardBasis.SITE_SPECIFIC}' and give its report"
    return _fault(field, fault, f"{wanted} ({table.clause}†), {out}")


def _sdc(row: InputRow) -> Iterator[Finding]:
    parameters, risk_category = site_parameters(row), row.get("risk_category")
    if "sdc" not in row or not parameters or parameters.s_ds is None or risk_category is None:
        return
    sdc, possible = row["sdc"], categories(row)
    if sdc is None:
        others = " and ".join(category_lacks(row))
        yield _fault("sdc", f"{_SDC} is missing", f"choose A, B, C, D, E or F, or give {others}")
        return
    # ASCE 7 11.6: the more severe of two tables; S_1 from 0.75 g on gives E, or F in category IV.
    reasons = (
        (f"S_DS = {parameters.s_ds:.3f} g", "ASCE 7 Table 11.6-1"),
        (f"S_D1 = {parameters.s_d1 or 0.0:.3f} g", "ASCE 7 Table 11.6-2"),
        (f"S_1 = {row['s_1_g'] or 0.0:g} g", "ASCE 7 section 11.6"),
    )
    least, (reason, clause) = max(zip(possible, reasons, strict=True), key=lambda by: by[0])
    if sdc < least:
        wanted = f"{reason} in risk category {risk_category} requires {least} or higher ({clause})"
        yield _fault("sdc", f"{_SDC} is '{sdc}'", wanted)
