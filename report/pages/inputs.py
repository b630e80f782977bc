"""Inputs: site parameters in the order of a permit sheet, arrays, objects."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from markupsafe import Markup

from report.assessment.runs import RUNGS
from report.pages import friction_tests
from report.pages.model import friction
from report.pages.parts import PackageData, Table, TableColumn, TableRow
from report.sheet.schema import Site
from report.typeset.equations import symbol
from report.words.units import Quantity, number

NOT_GIVEN = "not given"


def below(_: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    return (
        ("inputs-site", "Site and seismic parameters"),
        ("inputs-arrays", "Arrays and objects"),
        ("inputs-friction", "Friction as tested"),
    )


def inputs(package: PackageData) -> Mapping[str, object]:
    """Return the part on inputs."""
    return {
        "site": _site(package),
        "arrays": _arrays(package),
        "sizes": _sizes(package),
        "links": _links(package),
        "objects": _objects(package),
        "friction": friction_tests.page(package),
        "note": _s_ds_note(package.data.site),
    }


def _site(package: PackageData) -> Table:
    return Table(
        caption="Site and seismic parameters",
        columns=(
            TableColumn(head="Description", align="left", share=3.4),
            TableColumn(head="Symbol", align="left", share=0.8),
            TableColumn(head="Value", share=2.0),
            TableColumn(head="Reference", align="left", share=2.4),
            TableColumn(head="Source", align="left", share=1.0),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    words,
                    symbol(name) if name else "",
                    value,
                    reference,
                    "—" if value == NOT_GIVEN else origin,
                )
            )
            for words, name, value, reference, origin in _parameters(package)
        ),
    )


def _parameters(package: PackageData) -> Sequence[tuple[str, str, str, str, str]]:
    site, fmt = package.data.site, package.fmt
    s_ms = None if site.s_s_g is None or site.f_a is None else site.f_a * site.s_s_g
    s_m1 = None if site.s_1_g is None or site.f_v is None else site.f_v * site.s_1_g
    s_d1 = None if s_m1 is None else 2.0 / 3.0 * s_m1
    t_s = None if s_d1 is None else s_d1 / site.s_ds
    given, computed = "input", "computed"
    s_ds_origin = computed if site.s_ds_g is None else given
    site_class = NOT_GIVEN if site.site_class is None else site.site_class.value
    return (
        ("Rule set", "", package.assessment.rules.name, "adopted provisions", given),
        ("Risk category", "", site.risk_category.value, "ASCE 7 Table 1.5-1", given),
        ("Importance factor", "I_e", number(site.i_e, 2), "ASCE 7 Table 1.5-2", given),
        ("Stories above grade", "", str(site.stories), "", given),
        (
            "Height of the array above the base",
            "z",
            fmt.both(site.roof_height_m, Quantity.PLAN),
            "ASCE 7 13.3",
            given,
        ),
        (
            "Structure height",
            "h",
            fmt.both(site.structure_height_m, Quantity.PLAN),
            "ASCE 7 13.3",
            given,
        ),
        (
            "Relative height",
            "z/h",
            number(site.roof_height_m / site.structure_height_m, 3),
            "ASCE 7 13.3",
            computed,
        ),
        ("Mapped acceleration, 0.2 s", "S_S", _g(site.s_s_g), "ASCE 7 11.4", given),
        ("Mapped acceleration, 1 s", "S_1", _g(site.s_1_g), "ASCE 7 11.4", given),
        (
            "Long-period transition",
            "T_L",
            _seconds(package.data.target.t_l_s),
            "ASCE 7 11.4",
            given,
        ),
        ("Site class", "", site_class, "ASCE 7 Chapter 20", given),
        ("Site coefficient, 0.2 s", "F_a", _plain(site.f_a), "ASCE 7 11.4", given),
        ("Site coefficient, 1 s", "F_v", _plain(site.f_v), "ASCE 7 11.4", given),
        ("MCE acceleration, 0.2 s", "S_MS", _g(s_ms), "ASCE 7 Eq. 11.4-1", computed),
        ("MCE acceleration, 1 s", "S_M1", _g(s_m1), "ASCE 7 Eq. 11.4-2", computed),
        ("Design acceleration, 0.2 s", "S_DS", _g(site.s_ds), "ASCE 7 Eq. 11.4-3", s_ds_origin),
        ("Design acceleration, 1 s", "S_D1", _g(s_d1), "ASCE 7 Eq. 11.4-4", computed),
        (
            "Corner period",
            "T_S",
            _seconds(t_s),
            "ASCE 7 11.4",
            computed,
        ),
        ("Seismic design category", "SDC", site.sdc.value, "ASCE 7 11.6", given),
    )


def _g(value: float | None) -> str:
    return NOT_GIVEN if value is None else f"{number(value, 3)} g"


def _seconds(value: float | None) -> str:
    return NOT_GIVEN if value is None else f"{number(value, 3)} s"


def _plain(value: float | None) -> str:
    return NOT_GIVEN if value is None else number(value, 3)


def _s_ds_note(site: Site) -> str:
    if site.s_ds_g is None:
        return Markup(
            "{} is computed from {} and {} in full precision and rounded only for printing."
        ).format(symbol("S_DS"), symbol("S_S"), symbol("F_a"))
    if site.s_s_g is None or site.f_a is None:
        return Markup("{} is as given in the workbook.").format(symbol("S_DS"))
    other = 2.0 / 3.0 * site.f_a * site.s_s_g
    return Markup(
        "{} is as given in the workbook. The value from {} and {} is {} g; it is not used."
    ).format(symbol("S_DS"), symbol("S_S"), symbol("F_a"), number(other, 3))


def _arrays(package: PackageData) -> Table:
    return Table(
        caption="Arrays: slope and friction",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            TableColumn(head="Slope", unit="deg", share=0.7),
            TableColumn(head="Slope", unit="%", share=0.7),
            TableColumn(head="Downslope", unit="deg in plan", share=1.0),
            TableColumn(head="μ", share=0.7),
            TableColumn(head="Friction test report", align="left", share=2.6),
            TableColumn(head="Construction", align="left", share=2.2),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    array.id,
                    number(math.degrees(array.slope_rad), 2),
                    number(100.0 * math.tan(array.slope_rad), 1),
                    number(array.downslope_deg, 0),
                    number(array.mu, 3),
                    array.mu_report or NOT_GIVEN,
                    array.construction,
                )
            )
            for array in package.data.arrays
        ),
        notes=(
            "Downslope direction: counterclockwise from +x of the roof plan.",
            *_by_speed(package),
        ),
    )


def _by_speed(package: PackageData) -> Iterator[str]:
    """Yield which arrays have velocity-dependent friction or a requested model."""
    for array in package.data.arrays:
        if not array.friction.is_constant:
            yield f"Array {array.id}.{friction(array)}"
        if array.model in RUNGS:
            where = package.part("model")
            yield f"Array {array.id}. Requested model: {array.model.value} ({where})."


def _sizes(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Arrays: weight and size",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            *fmt.columns("Weight", Quantity.WEIGHT),
            *fmt.columns("Center of gravity", Quantity.SIZE),
            *fmt.columns("Support spacing", Quantity.SIZE),
            *fmt.columns("Plan x", Quantity.PLAN),
            *fmt.columns("Plan y", Quantity.PLAN),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    array.id,
                    *fmt.cells(array.weight_n, Quantity.WEIGHT),
                    *fmt.cells(array.cg_height_m, Quantity.SIZE),
                    *fmt.cells(array.support_spacing_m, Quantity.SIZE),
                    *fmt.cells(array.x_to_m - array.x_from_m, Quantity.PLAN),
                    *fmt.cells(array.y_to_m - array.y_from_m, Quantity.PLAN),
                )
            )
            for array in package.data.arrays
        ),
        notes=(
            "Center of gravity: height above the roof surface. Plan x and y: size of the array.",
        ),
    )


def _links(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Arrays to be compared with a row of linked blocks",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            TableColumn(head="Blocks", share=0.8),
            TableColumn(head="μ of the blocks, from the upslope end", align="left", share=4.2),
            *fmt.columns("Link stiffness", Quantity.STIFFNESS, share=1.1),
            TableColumn(head="Link damping", unit="of critical", share=1.3),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    row.array,
                    str(len(row.mus)),
                    ", ".join(number(mu, 3) for mu in row.mus),
                    *fmt.cells(row.stiffness_n_per_m, Quantity.STIFFNESS),
                    number(row.damping_ratio, 3),
                )
            )
            for row in package.data.links
        ),
        notes=(f"Blocks of equal weight, in a row along the slope ({package.part('model')}).",),
    )


def _objects(package: PackageData) -> Table:
    fmt = package.fmt
    return Table(
        caption="Objects and roof edges",
        columns=(
            TableColumn(head="Object", align="left", share=1.2),
            TableColumn(head="Kind", align="left", share=1.8),
            *fmt.columns("Height", Quantity.SIZE),
            *fmt.columns("x from", Quantity.PLAN),
            *fmt.columns("x to", Quantity.PLAN),
            *fmt.columns("y from", Quantity.PLAN),
            *fmt.columns("y to", Quantity.PLAN),
        ),
        rows=tuple(
            TableRow(
                cells=(
                    item.id,
                    item.kind.value,
                    *_optional(package, item.height_m, Quantity.SIZE),
                    *_optional(package, item.x_from_m, Quantity.PLAN),
                    *_optional(package, item.x_to_m, Quantity.PLAN),
                    *_optional(package, item.y_from_m, Quantity.PLAN),
                    *_optional(package, item.y_to_m, Quantity.PLAN),
                )
            )
            for item in package.data.objects
        ),
        kind="compact",
    )


def _optional(package: PackageData, value_m: float | None, quantity: Quantity) -> tuple[str, str]:
    return ("—", "—") if value_m is None else package.fmt.cells(value_m, quantity)
