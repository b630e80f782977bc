"""Faults of the site: values that contradict each other, a table or an edition of ASCE 7."""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.project.model.finding import Finding
from report.project.model.input_rows import InputRow, Inputs, Place, Where
from report.project.model.site_input import (
    categories,
    category_lacks,
    edition_of_row,
    site_class_or_default,
    site_parameters,
)
from solver.rules import hazard
from solver.rules.hazard import LEAST_I_E, Edition, HazardBasis
from solver.rules.site_coefficients import F_A, F_V, CoefficientTable, site_coefficient
from solver.spaces import NO_BREAK

# Difference allowed between a value and the same from other cells: it is typed as a permit sheet
# or a hazard tool prints it, rounded to two decimals or more.
AGREES_G = 0.0051
# Difference of a site coefficient from its table that is rounding: to two decimals.
ROUNDING_OF_COEFFICIENTS = 0.0051

_ENTER_S_DS = "enter S_DS, S_MS, or both S_S and F_a"
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
        if edition is not None:
            yield from _edition(row, edition)
        yield from _missing_s_ds(row, edition)
        if edition is not None:
            yield from _site_class(row, edition)
            for chain, table in zip(_CHAINS, (F_A, F_V), strict=True):
                yield from _agreement(row, edition, chain)
                yield from _below_table(row, edition, chain, table, where)
        yield from _sdc(row)


def _fault(field: str, fault: str, remedy: str) -> Finding:
    return Finding.error(Place("site", 0, field), fault, remedy)


def _importance(row: InputRow) -> Iterator[Finding]:
    risk_category, i_e = row.get("risk_category"), row.get("i_e")
    if risk_category is None or i_e is None or i_e >= LEAST_I_E[risk_category]:
        return
    remedy = f"enter at least {LEAST_I_E[risk_category]:g} for risk category {risk_category}"
    yield _fault("i_e", f"importance factor I_e is {i_e:g}", remedy)


def _edition(row: InputRow, edition: Edition) -> Iterator[Finding]:
    rule_set = row["rule_set"]
    # PV1-2012 is no edition of ASCE 7: it goes with each of them.
    if rule_set in hazard.EDITIONS and rule_set != edition.name:
        text = f"edition of ASCE 7 is '{edition.name}', but the rule set is '{rule_set}'"
        yield _fault("edition_name", text, "leave it blank, or correct one")
    # From ASCE 7-22 on, S_MS and S_M1 are read off for a site class.
    if edition.has_site_coefficients:
        return
    for field, label, instead in (("f_a", "F_a", "S_MS or S_DS"), ("f_v", "F_v", "S_M1 or S_D1")):
        if row.get(field) is not None:
            text = f"{label} is {row[field]:g}, but {edition.name} has no site coefficients"
            remedy = f"leave it blank and enter {instead} from a hazard tool"
            yield _fault(field, text, remedy)


def _missing_s_ds(row: InputRow, edition: Edition | None) -> Iterator[Finding]:
    if any(name not in row for name, _ in _CHAINS[0]):
        return
    if edition is None:  # what S_DS follows from is not known before it
        if all(row[name] is None for name, _ in _CHAINS[0]):
            yield _fault("s_ds_g", "S_DS is missing", _ENTER_S_DS)
        return
    parameters = site_parameters(row)
    if parameters is None or parameters.s_ds is not None:
        return
    has_coefficients = edition.has_site_coefficients
    missing = [n for n in ("s_s_g", "f_a") if row[n] is None] if has_coefficients else []
    field = missing[0] if len(missing) == 1 else "s_ds_g"
    label = {"s_ds_g": "S_DS", "s_s_g": "S_S", "f_a": "F_a"}[field]
    remedy = _ENTER_S_DS if has_coefficients else "enter S_DS or S_MS"
    yield _fault(field, f"{label} is missing", remedy)


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
            text = f"{symbol} is {value:g}{NO_BREAK}g, but {words} is {derived:.4f}{NO_BREAK}g"
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
        yield _fault("site_class", text, f"enter one of {', '.join(F_A.rows)}")


def _below_table(
    row: InputRow, edition: Edition, chain: _Chain, table: CoefficientTable, where: Where
) -> Iterator[Finding]:
    """Yield values below those of the mapped value, the site class and the table of its edition."""
    # A given coefficient is compared with the table, and `_agreement` compares the rest with it.
    (mapped, symbol), (coefficient, factor), maximum, design = chain
    mapped_g, entered = row.get(mapped), row.get(coefficient)
    tabulated = _tabulated(row, edition, mapped_g, table)
    if mapped_g is None or coefficient not in row or math.isnan(tabulated):
        return
    of_class = f"for site class '{site_class_or_default(row['site_class'])}'"
    of_class += "" if row["site_class"] else ", assumed because none is entered"
    if entered is not None:
        if entered < tabulated - ROUNDING_OF_COEFFICIENTS:
            remedy = f"enter at least {tabulated:.4g} {of_class} and {symbol} of {mapped_g:g} g in"
            address = where(Place("site", 0, mapped))
            yield _or_study(coefficient, f"{factor} is {entered:g}", f"{remedy} {address}", table)
        return
    for (name, label), share, words in ((maximum, 1.0, ""), (design, 2.0 / 3.0, "2/3 ")):
        value, least_g = row.get(name), share * tabulated * mapped_g
        if value is not None and value < least_g - AGREES_G:
            # Rounded up: what is advised must pass as it is printed.
            remedy = (
                f"enter at least {math.ceil(1e3 * least_g) / 1e3:g} g, which is {words}{factor}"
            )
            remedy += f" {symbol} with {factor} of {tabulated:.4g} {of_class}"
            yield _or_study(name, f"{label} is {value:g} g", remedy, table)


def _tabulated(
    row: InputRow, edition: Edition, mapped_g: float | None, table: CoefficientTable
) -> float:
    """Return the coefficient of a table; NaN for none, or where a site-specific one may be less."""
    # Where a table has none, a site-specific analysis is a requirement of the package.
    if edition.name != table.edition or mapped_g is None or "site_class" not in row:
        return math.nan
    site_class = site_class_or_default(row["site_class"])
    # An unreadable basis may be a site-specific one: no error is given that the next one would
    # take back.
    is_studied = row.get("hazard") in (None, HazardBasis.SITE_SPECIFIC)
    has_none = is_studied or site_class not in table.rows
    return math.nan if has_none else site_coefficient(table, site_class, mapped_g)


def _or_study(field: str, fault: str, remedy: str, table: CoefficientTable) -> Finding:
    basis = f"'{HazardBasis.SITE_SPECIFIC}' as basis of seismic parameters"
    out = f"or select {basis} and enter its report"
    return _fault(field, fault, f"{remedy} ({table.clause}†), {out}")


def _sdc(row: InputRow) -> Iterator[Finding]:
    if any(name not in row for name in ("sdc", "s_1_g", "s_d1_g")):
        return
    parameters, risk_category = site_parameters(row), row.get("risk_category")
    is_known = parameters and parameters.s_ds is not None and risk_category is not None
    sdc, possible = row["sdc"], categories(row)
    # Without S_1 no category follows, whatever S_DS will be.
    if sdc is None and (is_known or row["s_1_g"] is None):
        missing = " and ".join(category_lacks(row))
        yield _fault("sdc", f"{_SDC} is missing", f"choose A, B, C, D, E or F, or enter {missing}")
    if sdc is None or not parameters or not is_known:
        return
    # ASCE 7 11.6: the more severe of two tables; S_1 from 0.75 g on gives E, or F in category IV.
    reasons = (
        (f"S_DS = {parameters.s_ds:.3f} g", "ASCE 7 Table 11.6-1"),
        (f"S_D1 = {parameters.s_d1 or 0.0:.3f} g", "ASCE 7 Table 11.6-2"),
        (f"S_1 = {row['s_1_g'] or 0.0:g} g", "ASCE 7 Section 11.6"),
    )
    # Letters compare as categories do; the empty text of an unknown one is below A.
    required, (reason, clause) = max(zip(possible, reasons, strict=True), key=lambda by: by[0])
    if sdc < required:
        remedy = (
            f"{reason} in risk category {risk_category} requires {required} or higher ({clause})"
        )
        yield _fault("sdc", f"{_SDC} is '{sdc}'", remedy)
