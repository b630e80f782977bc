"""The seismic parameters of the site in the order of a permit sheet, each with clause and source.

    Design spectral acceleration, short period   S_DS   1.566 g   computed: 2/3 S_MS = 2/3 × 2.349 g

Read `site_table`.
"""

from __future__ import annotations

from collections.abc import Iterator

from markupsafe import Markup

from report.document.tables import Table, headed
from report.motions.history import OWN, ac156
from report.pages.parts import PackageData
from report.project.model import ProjectInput
from report.project.model.choices import RiskCategory
from report.project.model.site_input import Site
from report.text.units import NO_BREAK, Quantity, number
from report.typeset.equations import symbol
from solver.rules import hazard
from solver.rules.hazard import ComponentForce, HazardBasis, approximate_period_s, component_force

_COLUMNS = (
    ("Description", 3.4), ("Symbol", 0.65), ("Value", 1.55, "right"), ("Source", 3.05),
    ("Reference", 2.05),
)  # fmt: skip
_NOT_ENTERED = "not entered"
_Row = tuple[str, Markup, str, str | Markup, str]


def site_table(package: PackageData) -> Table:
    """Return the parameters of the site."""
    return headed(*_COLUMNS, rows=_rows(package), kind="compact", whole_rows=0)


def _rows(package: PackageData) -> Iterator[_Row]:
    """Yield name, symbol, value, source and reference of each parameter."""
    yield from _building(package)
    yield from _hazard(package.data)
    yield from _category_and_force(package.data)
    if package.assessment.has_motions:
        yield from _ac156(package)
    site = package.data.site
    parts = [site.hazard_source or "source not entered"]
    if site.hazard is HazardBasis.SITE_SPECIFIC:
        parts.append(f"report {site.hazard_report or _NOT_ENTERED}")
    parts.append(str(site.hazard_date or "date not entered"))
    clause = site.edition.clause("site_specific")
    yield _row("Basis of the seismic parameters", "", site.hazard.value, clause, ", ".join(parts))


def _row(
    name: str, symbols: str, value: str, reference: str = "", source: str | Markup = "input"
) -> _Row:
    """Return a row; symbols are divided by a slash."""
    letters = Markup("/").join(map(symbol, symbols.split("/"))) if symbols else Markup("")
    return name, letters, value, "—" if value == _NOT_ENTERED else source, reference


def _given(value: float | None, decimals: int = 3, unit: str = "") -> str:
    return _NOT_ENTERED if value is None else number(value, decimals) + unit


def _g(value_g: float | None) -> str:
    return _given(value_g, unit=f"{NO_BREAK}g")


def _building(package: PackageData) -> Iterator[_Row]:
    """Yield the values of the building and the arrays: importance, component factors, heights."""
    site, fmt, clause = package.data.site, package.fmt, package.data.site.edition.clause
    factor, divisor = site.edition.force_factors
    importances = sorted({array.i_p for array in package.data.arrays})
    # Smallest and largest, once where they are the same.
    ends = dict.fromkeys((importances[0], importances[-1]))
    i_p = " to ".join(number(end, 2) for end in ends)
    if site.edition_name is None:
        yield _row("Edition of the seismic parameters", "", site.edition.name, "", "assumed")
    yield _row("Risk Category", "", site.risk_category.value, clause("risk_category"))
    yield _row("Importance factor", "I_e", number(site.i_e, 2), clause("importance"))
    yield _row("Component importance factor, arrays", "I_p", i_p, clause("component_importance"))
    factors = clause("component_factors")
    yield _row("Component amplification factor", factor, _given(site.force_factor, 2), factors)
    name = "Component strength factor"
    if site.edition.has_site_coefficients:
        name = "Component response modification factor"
    yield _row(name, divisor, _given(site.force_divisor, 2), factors)
    roof, height = (
        fmt.both(height_m, Quantity.PLAN)
        for height_m in (site.roof_height_m, site.structure_height_m)
    )
    yield _row("Height of the roof above the base", "z", roof, clause("force"))
    yield _row("Structure height", "h", height, clause("force"))
    relative = number(site.z_over_h, 3)
    yield _row("Relative height", "z/h", relative, clause("force"), "computed")
    yield _row("Stories above grade", "", str(site.stories))


def _hazard(data: ProjectInput) -> Iterator[_Row]:
    """Yield the accelerations of the site, and the periods of the spectrum and the building."""
    site, building, parameters, clause = (
        data.site,
        data.building,
        data.site.parameters,
        data.site.edition.clause,
    )
    short, long = "short period", f"1{NO_BREAK}s"
    seconds = f"{NO_BREAK}s"
    yield _row(
        "Mapped spectral acceleration, short period", "S_S", _g(site.s_s_g), clause("mapped")
    )
    yield _row(f"Mapped spectral acceleration, {long}", "S_1", _g(site.s_1_g), clause("mapped"))
    t_l = _given(data.target.t_l_s, unit=seconds)
    yield _row("Long-period transition period", "T_L", t_l, clause("t_l"))
    site_class = _NOT_ENTERED if site.site_class is None else site.site_class.value
    yield _row("Site Class", "", site_class, clause("site_class"))
    if site.edition.has_site_coefficients:
        yield _row("Site coefficient, short period", "F_a", _given(site.f_a), clause("s_ms"))
        yield _row(f"Site coefficient, {long}", "F_v", _given(site.f_v), clause("s_ms"))
    of_maximum = (
        (short, "S_MS", parameters.s_ms, site.s_ms_g, ("F_a", site.f_a), ("S_S", site.s_s_g),
         ("S_DS", site.s_ds_g)),
        (long, "S_M1", parameters.s_m1, site.s_m1_g, ("F_v", site.f_v), ("S_1", site.s_1_g),
         ("S_D1", site.s_d1_g)),
    )  # fmt: skip
    for period, name, value_g, given_g, coefficient, mapped, design in of_maximum:
        source = _maximum_source(site, given_g, coefficient, mapped, design)
        yield _row(
            f"MCE spectral acceleration, {period}", name, _g(value_g), clause("s_ms"), source
        )
    of_design = (
        (short, "S_DS", parameters.s_ds, site.s_ds_g, "S_MS", parameters.s_ms),
        (long, "S_D1", parameters.s_d1, site.s_d1_g, "S_M1", parameters.s_m1),
    )
    for period, name, value_g, given_g, maximum, maximum_g in of_design:
        source = _design_source(given_g, maximum, maximum_g)
        yield _row(
            f"Design spectral acceleration, {period}", name, _g(value_g), clause("s_ds"), source
        )
    if building.period_s is not None:
        period = _given(building.period_s, unit=seconds)
        yield _row("Period of the building, as entered", "T_1", period)
    else:
        structure = building.structure or "other"
        period_s = approximate_period_s(structure, site.structure_height_m)
        source = "computed" if building.structure else "assumed"
        system = "all other structural systems" if structure == "other" else structure
        name = f"Approximate period, {system}"
        yield _row(name, "T_a", _given(period_s, unit=seconds), clause("period"), source)
    yield _row(
        "End of the spectral plateau",
        "T_S",
        _given(parameters.t_s, unit=seconds),
        clause("t_l"),
        "computed",
    )


_Named = tuple[str, float | None]


def _maximum_source(
    site: Site, given_g: float | None, coefficient: _Named, mapped: _Named, design: _Named
) -> str | Markup:
    """Return the derivation of a maximum considered earthquake value, as in `Site.parameters`."""
    if given_g is not None:
        return "input"
    if site.edition.has_site_coefficients and mapped[1] and coefficient[1]:
        return Markup("computed: {} {} = {} × {}").format(
            symbol(coefficient[0]), symbol(mapped[0]), number(coefficient[1], 3), _g(mapped[1])
        )
    if design[1] is not None:
        return Markup("computed: 1.5 {} = 1.5 × {}").format(symbol(design[0]), _g(design[1]))
    return ""


def _design_source(given_g: float | None, maximum: str, maximum_g: float | None) -> str | Markup:
    """Return the derivation of a design value."""
    if given_g is not None:
        return "input"
    if maximum_g is not None:
        return Markup("computed: 2/3 {} = 2/3 × {}").format(symbol(maximum), _g(maximum_g))
    return ""


def _category_and_force(data: ProjectInput) -> Iterator[_Row]:
    """Yield the design category, computed and used, and the force on a component."""
    site, clause = data.site, data.site.edition.clause
    categories = hazard.design_categories(
        s_ds_g=site.s_ds,
        s_d1_g=site.s_d1,
        s_1_g=site.s_1_g,
        is_essential=site.risk_category is RiskCategory.IV,
    )
    by_short, by_long, near_fault = categories
    at_1_s = f"{by_long} (1{NO_BREAK}s)" if by_long else symbol("S_D1") + f" {_NOT_ENTERED}"
    if near_fault:
        by_s_1 = Markup("{} ({})").format(near_fault, symbol("S_1"))
    else:
        below = f"below {hazard.NEAR_FAULT_S_1_G:g}{NO_BREAK}g"
        by_s_1 = symbol("S_1") + f" {_NOT_ENTERED if site.s_1_g is None else below}"
    source = Markup("the most severe of {} (short period), {}, {}").format(by_short, at_1_s, by_s_1)
    # Letters, A the mildest; a category that is not known is an empty text, below all of them.
    category = max(categories) + site.sdc_mark
    yield _row("Seismic design category from these values", "", category, clause("sdc"), source)
    yield _row("Seismic design category used", "SDC", site.sdc_text, clause("sdc"))
    force = site_force(data)
    value, origin = _NOT_ENTERED, ""
    if force:
        value = number(force.value, 3)
        origin = (
            f"computed (lower limit {number(force.minimum, 3)}, upper limit "
            f"{number(force.maximum, 3)})"
        )
    yield _row("Seismic design force / weight", "F_p/W_p", value, clause("force"), origin)


def _ac156(package: PackageData) -> Iterator[_Row]:
    """Yield AC156 at the roof, of components without a project-specific spectrum."""
    site, targets = package.data.site, package.assessment.targets
    horizontal, vertical = ac156(package.data)
    amplification, s_ds = site.edition.amplification, symbol("S_DS")
    slope, reduction = f"{amplification.slope:g}", f"{amplification.reduction_at(site.z_over_h):g}"
    below = "" if reduction == "1" else f" / {reduction}"
    of_roof = Markup("{} (1 + {} {}/{}){}").format(s_ds, slope, symbol("z"), symbol("h"), below)
    amplified = f"{_g(site.s_ds)} × (1 + {slope} × {number(site.z_over_h, 3)}){below}"
    if targets.roof.name != OWN:
        # Of the four corners, 0.1, 1.3, 8.3 and 33.3 Hz: [1] begins the plateau, [3] is the rigid
        # end.
        title, sa_g = "AC156 horizontal spectrum at the roof", horizontal.sa_g
        flexible = Markup("computed: {} = {}, at most 1.6 {}").format(of_roof, amplified, s_ds)
        rigid = Markup("computed: 0.4 {}").format(of_roof)
        yield _row(f"{title}, flexible", "A_FLX", _g(sa_g[1]), "AC156", flexible)
        yield _row(f"{title}, rigid", "A_RIG", _g(sa_g[3]), "AC156", rigid)
    if targets.vertical.name != OWN:
        title, sa_g = "AC156 vertical spectrum", vertical.sa_g
        flexible = Markup("computed: 0.67 {}").format(s_ds)
        rigid = Markup("computed: 0.27 {}").format(s_ds)
        yield _row(f"{title}, flexible", "A_FLX,v", _g(sa_g[1]), "AC156", flexible)
        yield _row(f"{title}, rigid", "A_RIG,v", _g(sa_g[3]), "AC156", rigid)


def site_force(data: ProjectInput) -> ComponentForce | None:
    """Return F_p / W_p with the largest I_p of the arrays, if a_p and R_p are given.

    The height factor of ASCE 7-22 takes the period where the workbook states period or structure.
    """
    site, building = data.site, data.building
    if site.force_factor is None or site.force_divisor is None:
        return None
    period_s = building.period_s
    # ASCE 7-22 13.3.1.1: H_f takes T_a where the period is not known.
    if period_s is None and building.structure is not None:
        period_s = approximate_period_s(building.structure, site.structure_height_m)
    # ASCE 7-16 has one height factor, and no period in it.
    return component_force(
        site.edition,
        s_ds_g=site.s_ds,
        factor=site.force_factor,
        divisor=site.force_divisor,
        # One force for all: the largest is on the safe side for the others.
        i_p=max(array.i_p for array in data.arrays),
        z_over_h=site.z_over_h,
        period_s=period_s,
    )
