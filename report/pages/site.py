"""Site and seismic parameters in the order of a permit sheet, each with its clause and origin.

Derived values are those of `Site.parameters`, unrounded; printing alone rounds. Read `site_table`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from markupsafe import Markup

from report.assessment.verdict import NOT_GIVEN
from report.document.tables import Table, listed
from report.entities.shown import text, words
from report.pages.parts import PackageData
from report.sheet.schema import RiskCategory, Site
from report.typeset.equations import symbol
from report.words.units import Quantity, number
from solver.building.periods import approximate_period_s
from solver.rules import hazard
from solver.rules.hazard import ComponentForce, HazardBasis, component_force

GIVEN, COMPUTED, ASSUMED = "input", "computed", "assumed"


@dataclass(frozen=True, slots=True)
class Parameter:
    """A row of the table: description, symbol, value, clause, and where the value comes from."""

    words: str
    symbol: str
    value: str
    clause: str
    origin: str = GIVEN


def site_table(package: PackageData) -> Table:
    """Return the seismic parameters of the site."""
    columns = (
        (words("Description", 3.55), lambda row: row.words),
        (words("Symbol", 0.7), lambda row: _symbols(row.symbol)),
        (text("Value", share=2.0), lambda row: row.value),
        (words("Reference", 2.55), lambda row: row.clause),
        (words("Source", 0.9), lambda row: "—" if row.value == NOT_GIVEN else row.origin),
    )
    return listed(site_parameters(package), columns, package.fmt, kind="compact")


def _symbols(text: str) -> Markup:
    """Return a symbol, or a ratio of two; nothing for an empty text."""
    return Markup("/").join(symbol(part) for part in text.split("/")) if text else Markup("")


def site_parameters(package: PackageData) -> tuple[Parameter, ...]:
    """Return the rows of the table, in the order of a permit sheet."""
    return (
        *_building(package),
        *_ground(package),
        *_periods(package),
        *_categories(package.data.site),
        *_force(package),
        *_hazard(package.data.site),
    )


def _building(package: PackageData) -> Iterator[Parameter]:
    site, fmt = package.data.site, package.fmt
    clause = site.edition.clause
    factor, divisor = site.edition.force_factors
    force, factors = clause("force"), clause("component_factors")
    i_p = clause("component_importance")
    yield Parameter("Rule set", "", package.assessment.rules.name, "adopted provisions")
    yield Parameter("Edition of the seismic parameters", "", site.edition.name, "", _edition(site))
    yield Parameter("Risk category", "", site.risk_category.value, clause("risk_category"))
    yield Parameter("Importance factor", "I_e", number(site.i_e, 2), clause("importance"))
    yield Parameter("Component importance factor of the arrays", "I_p", _i_p(package), i_p)
    yield Parameter("Component amplification", factor, _plain(site.force_factor, 2), factors)
    yield Parameter("Component response", divisor, _plain(site.force_divisor, 2), factors)
    yield Parameter(
        "Height of the supporting roof above the base",
        "z",
        fmt.both(site.roof_height_m, Quantity.PLAN),
        force,
    )
    yield Parameter(
        "Structure height", "h", fmt.both(site.structure_height_m, Quantity.PLAN), force
    )
    yield Parameter("Relative height", "z/h", number(site.z_over_h, 3), force, COMPUTED)
    yield Parameter("Stories above grade", "", str(site.stories), "")


def _edition(site: Site) -> str:
    return ASSUMED if site.edition_name is None else GIVEN


def _i_p(package: PackageData) -> str:
    """Return I_p, or its range over the arrays."""
    factors = sorted({array.i_p for array in package.data.arrays})
    return " to ".join(number(value, 2) for value in dict.fromkeys((factors[0], factors[-1])))


def _ground(package: PackageData) -> Iterator[Parameter]:
    site = package.data.site
    clause, values = site.edition.clause, site.parameters
    site_class = NOT_GIVEN if site.site_class is None else site.site_class.value
    yield Parameter("Mapped acceleration, 0.2 s", "S_S", _g(site.s_s_g), clause("mapped"))
    yield Parameter("Mapped acceleration, 1 s", "S_1", _g(site.s_1_g), clause("mapped"))
    yield Parameter(
        "Long-period transition", "T_L", _seconds(package.data.target.t_l_s), clause("t_l")
    )
    yield Parameter("Site class", "", site_class, clause("site_class"))
    if site.edition.has_site_coefficients:
        yield Parameter("Site coefficient, 0.2 s", "F_a", _plain(site.f_a, 3), clause("s_ms"))
        yield Parameter("Site coefficient, 1 s", "F_v", _plain(site.f_v, 3), clause("s_ms"))
    for name, sign, value, given, topic in (
        ("MCE acceleration, 0.2 s", "S_MS", values.s_ms, site.s_ms_g, "s_ms"),
        ("MCE acceleration, 1 s", "S_M1", values.s_m1, site.s_m1_g, "s_ms"),
        ("Design acceleration, 0.2 s", "S_DS", values.s_ds, site.s_ds_g, "s_ds"),
        ("Design acceleration, 1 s", "S_D1", values.s_d1, site.s_d1_g, "s_ds"),
    ):
        origin = COMPUTED if given is None else GIVEN
        yield Parameter(name, sign, _g(value), clause(topic), origin)


def _periods(package: PackageData) -> Iterator[Parameter]:
    site, building = package.data.site, package.data.building
    if building.period_s is not None:
        name = "Period of the building, as given"
        yield Parameter(name, "T_1", _seconds(building.period_s), "")
    else:
        system = building.structure or "other"
        period = approximate_period_s(system, site.structure_height_m)
        origin = ASSUMED if building.structure is None else COMPUTED
        name = f"Approximate period, structure type {system}"
        yield Parameter(name, "T_a", _seconds(period), site.edition.clause("period"), origin)
    clause = site.edition.clause("t_l")
    yield Parameter("Corner period", "T_S", _seconds(site.parameters.t_s), clause, COMPUTED)


def _categories(site: Site) -> Iterator[Parameter]:
    clause, is_essential = site.edition.clause, site.risk_category is RiskCategory.IV
    short = hazard.sdc_short(site.s_ds, is_essential=is_essential)
    yield Parameter("SDC by short period", "", short, clause("sdc_short"), COMPUTED)
    at_1s = NOT_GIVEN if site.s_d1 is None else hazard.sdc_1s(site.s_d1, is_essential=is_essential)
    yield Parameter("SDC by 1 s period", "", at_1s, clause("sdc_1s"), COMPUTED)
    yield Parameter(
        Markup("SDC by {}").format(symbol("S_1")),
        "",
        _near_fault(site, is_essential),
        clause("sdc"),
        COMPUTED,
    )
    controlling = hazard.controlling_sdc(
        s_ds_g=site.s_ds, s_d1_g=site.s_d1, s_1_g=site.s_1_g, is_essential=is_essential
    )
    shown = controlling + site.sdc_mark
    yield Parameter("Controlling SDC of these", "", shown, clause("sdc"), COMPUTED)
    yield Parameter("Seismic design category used", "SDC", site.sdc_text, clause("sdc"))


def _near_fault(site: Site, is_essential: bool) -> str:
    if site.s_1_g is None:
        return NOT_GIVEN
    category = hazard.sdc_near_fault(site.s_1_g, is_essential=is_essential)
    return category or f"none, below {hazard.NEAR_FAULT_S_1_G:g} g"


def _force(package: PackageData) -> Iterator[Parameter]:
    force = site_force(package)
    clause = package.data.site.edition.clause("force")
    if force is None:
        yield Parameter("Component force / weight", "F_p/W_p", NOT_GIVEN, clause)
        return
    yield Parameter("Component force / weight", "F_p/W_p", number(force.value, 3), clause, COMPUTED)
    for bound, value in (("at most", force.largest), ("at least", force.least)):
        name = f"Component force / weight, {bound}"
        yield Parameter(name, "F_p/W_p", number(value, 3), clause, COMPUTED)


def site_force(package: PackageData) -> ComponentForce | None:
    """Return F_p / W_p with the largest I_p of the arrays, if a_p and R_p are given.

    The height factor of ASCE 7-22 takes the period where the workbook states period or structure.
    """
    site, building = package.data.site, package.data.building
    if site.force_factor is None or site.force_divisor is None:
        return None
    period_s = building.period_s
    if period_s is None and building.structure is not None:
        period_s = approximate_period_s(building.structure, site.structure_height_m)
    return component_force(
        site.edition,
        s_ds_g=site.s_ds,
        factor=site.force_factor,
        divisor=site.force_divisor,
        i_p=max(array.i_p for array in package.data.arrays),
        z_over_h=site.z_over_h,
        period_s=period_s,
    )


def _hazard(site: Site) -> Iterator[Parameter]:
    date = NOT_GIVEN if site.hazard_date is None else site.hazard_date.isoformat()
    yield Parameter("Hazard basis", "", site.hazard.value, site.edition.clause("site_specific"))
    yield Parameter("Hazard source", "", site.hazard_source or NOT_GIVEN, "")
    if site.hazard is HazardBasis.SITE_SPECIFIC:
        yield Parameter("Hazard report number", "", site.hazard_report or NOT_GIVEN, "")
    yield Parameter("Date of the hazard values", "", date, "")


def unused_s_ds(site: Site) -> Mapping[str, object]:
    """Return the symbols from which S_DS follows, and its value from them if another is given."""
    origin, s_ms = _origin(site), site.parameters.s_ms
    is_unused = site.s_ds_g is not None and s_ms is not None and origin
    return {"origin": origin, "value_g": 2.0 / 3.0 * s_ms if is_unused and s_ms else None}


def _origin(site: Site) -> tuple[str, ...]:
    """Return the symbols of the given values from which S_DS follows; none if there are none."""
    if site.s_ms_g is not None:
        return ("S_MS",)
    if site.edition.has_site_coefficients and site.s_s_g is not None and site.f_a is not None:
        return ("S_S", "F_a")
    return ()


def _g(value: float | None) -> str:
    return NOT_GIVEN if value is None else f"{number(value, 3)} g"


def _seconds(value: float | None) -> str:
    return NOT_GIVEN if value is None else f"{number(value, 3)} s"


def _plain(value: float | None, decimals: int) -> str:
    return NOT_GIVEN if value is None else number(value, decimals)
