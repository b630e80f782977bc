"""Inputs: site parameters in the order of a permit sheet, arrays, objects."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

from report.assessment.friction import mu_words
from report.assessment.runs import RUNGS
from report.assessment.verdict import NOT_GIVEN
from report.document.tables import Table, TableRow
from report.entities.columns import TableColumn
from report.pages import friction_tests
from report.pages.model import friction
from report.pages.parts import PackageData
from report.pages.site import s_ds_note, site_table
from report.sheet.schema import Array, Polygon, RoofObject, Shape
from report.words.units import Quantity, number
from solver.rules.rulesets import LowProfileLength


def below(_: PackageData) -> tuple[tuple[str, str], ...]:
    """Return the parts below, in order."""
    return (
        ("inputs-site", "Site and seismic parameters"),
        ("inputs-arrays", "Arrays and objects"),
        ("inputs-friction", "Friction tests"),
    )


def inputs(package: PackageData) -> Mapping[str, object]:
    """Return the part on inputs."""
    return {
        "site": site_table(package),
        "arrays": _arrays(package),
        "sizes": _sizes(package),
        "links": _links(package),
        "objects": _objects(package),
        "friction": friction_tests.page(package),
        "note": s_ds_note(package.data.site),
    }


def _arrays(package: PackageData) -> Table:
    return Table(
        caption="Arrays: slope and friction",
        columns=(
            TableColumn(head="Array", align="left", share=0.9),
            TableColumn(head="Slope", unit="deg", share=0.7),
            TableColumn(head="Slope", unit="%", share=0.7),
            TableColumn(head="Downslope", unit="deg in plan", share=1.0),
            TableColumn(head="μ", share=1.1),
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
                    mu_words(array.friction),
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
            yield f"Array {array.id}.{friction(package, array)}"
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
                    *fmt.cells(plan.x_to_m - plan.x_from_m, Quantity.PLAN),
                    *fmt.cells(plan.y_to_m - plan.y_from_m, Quantity.PLAN),
                )
            )
            for array, plan in ((array, array.shape.bounds) for array in package.data.arrays)
        ),
        notes=(
            "Center of gravity: height above the roof surface. Plan x and y: size of the array.",
            _low_profile(package),
            *_outlined(package.data.arrays),
        ),
    )


def _low_profile(package: PackageData) -> str:
    """Return the length whose share limits the height of the center of gravity."""
    rules, fmt = package.assessment.rules, package.fmt
    takes_base = rules.low_profile_length is LowProfileLength.BASE

    def length(array: Array) -> str:
        if not takes_base:
            return f"{array.id} {fmt.both(array.support_spacing_m, Quantity.SIZE)}"
        stand_in = " (support spacing; no base given)" if array.base_m is None else ""
        return f"{array.id} {fmt.both(array.base_dimension_m, Quantity.SIZE)}{stand_in}"

    share = f"{rules['low_profile_ratio']:g}{package.mark('low_profile_ratio')}"
    most = fmt.both(rules.length_m("low_profile_in"), Quantity.SIZE)
    return (
        f"Center of gravity at most {most}{package.mark('low_profile_in')} above the roof and at "
        f"most {share} times the {rules.low_profile_length.value}: "
        f"{', '.join(map(length, package.data.arrays))}."
    )


def _outlined(rows: Sequence[Array | RoofObject]) -> Iterator[str]:
    """Yield which rows are drawn by an outline, of which a table gives the rectangle around it."""
    drawn = [
        f"{row.id} ({len(row.placed.points)} vertices)"
        for row in rows
        if isinstance(row.placed, Polygon)
    ]
    if drawn:
        yield f"By an outline, of which the rectangle around it is given: {', '.join(drawn)}."


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
                    *chain(*(_optional(package, at, Quantity.PLAN) for at in _sides(item.placed))),
                )
            )
            for item in package.data.objects
        ),
        kind="compact",
        notes=tuple(_outlined(package.data.objects)),
    )


def _sides(shape: Shape | None) -> tuple[float | None, ...]:
    """Return x from, x to, y from and y to of the rectangle around a shape."""
    if shape is None:
        return (None,) * 4
    box = shape.bounds
    return box.x_from_m, box.x_to_m, box.y_from_m, box.y_to_m


def _optional(package: PackageData, value_m: float | None, quantity: Quantity) -> tuple[str, str]:
    return ("—", "—") if value_m is None else package.fmt.cells(value_m, quantity)
