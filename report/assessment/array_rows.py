"""Requirements on one array: strength, weight, electrical slack, distances from the drawing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from report.assessment.verdict import NO_DESIGN, NOT_GIVEN, STRENGTH_ROW, Requirement, condition
from report.sheet.schema import ProjectInput
from report.sheet.schema.choices import ClearanceSource, DistanceBasis
from report.sheet.schema.fields import Place
from report.sheet.schema.scene import Array
from report.text.amounts import capacity, compared_pairs, demand, entered
from report.text.units import Quantity, measured, pair
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment

_NOISE = 1e-9  # a weight in other units is no more than itself


def array_rows(data: ProjectInput, assessed: ArrayAssessment) -> tuple[Requirement, ...]:
    """Return the requirements on an array."""
    known = rows_before_runs(data, assessed.array, assessed.interconnection_n)
    return *known, _slack(data, assessed)


def rows_before_runs(
    data: ProjectInput, array: Array, required_n: float
) -> tuple[Requirement, ...]:
    """Return the requirements on an array that no run is needed for, with the strength [N]."""
    # PV1-2012 section 6: the larger of 0.133 S_DS W1 and 0.1 W1, W1 the lighter side.
    strength = _interconnection(data, array, required_n)
    return strength, *_weight(data, array), *_drawing_distances(data, array)


def _drawing_distances(data: ProjectInput, array: Array) -> Iterator[Requirement]:
    """Yield the distances beside an array that are from the drawing, which no check compares."""
    drawn = [
        index
        for index, row in enumerate(data.clearances)
        if row.source is ClearanceSource.DRAWING and array.id in (row.array, row.object)
    ]
    if drawn:  # their numbers are below the table of clearances: so arrays share a condition
        by, date = data.project.drawing_confirmed_by, data.project.drawing_confirmed_date
        is_confirmed = data.basis_of(data.clearances[drawn[0]]) is DistanceBasis.CONFIRMED
        state = f"confirmed by {by}, {date}" if is_confirmed else "not confirmed"
        yield condition(
            id="drawing_distances",
            title="Clear distances from the drawing",
            subject=array.id,
            found=state,
            limit="measured, or confirmed by name and date",
            basis="roof plan",
            is_satisfied=is_confirmed,
            remedy="State measured on the sheet Clearances, or on the sheet Project who confirmed "
            "them and when.",
            places=tuple(Place("clearances", index, "source") for index in drawn),
        )


def _weight(data: ProjectInput, array: Array) -> Iterator[Requirement]:
    """Yield the weight per plan area beside what the engineers of roof and wind state."""
    here_pa, capacity_pa, wind_pa = array.weight_pa, array.roof_capacity_pa, array.wind_weight_pa
    units, here = (Quantity.PRESSURE, data.us_first), entered(here_pa)
    unit = Quantity.PRESSURE.us if data.us_first else Quantity.PRESSURE.si
    missing = partial(condition, subject=array.id, found=NOT_GIVEN, is_satisfied=False)
    if capacity_pa is None:
        yield missing(
            id="roof_capacity",
            title="Roof capacity",
            limit="the weight per plan area that the roof's engineer permits",
            basis="roof capacity",
            remedy="Have the roof's engineer state it, and enter it on the sheet Arrays.",
            places=_places(data, array, "roof_capacity_pa"),
        )
    else:
        is_over = here_pa > capacity_pa * (1.0 + _NOISE)
        weight, most = compared_pairs(here, capacity(capacity_pa), *units, is_at_least=False)
        yield Requirement(
            id="roof_capacity",
            title="Weight per plan area",
            cause="weight over the roof capacity",
            subject=array.id,
            found=weight,
            limit=f"≤ {most}",
            basis="roof capacity",
            is_satisfied=not is_over,
            consequence=Consequence.NG,
            remedy="Reduce the weight, or have the roof's engineer state a larger capacity.",
            places=_places(data, array, "weight_n", "roof_capacity_pa"),
        )
    if wind_pa is None:
        yield missing(
            id="wind_weight",
            title="Weight in wind design",
            limit="the weight per plan area with ballast that the wind design takes",
            basis="wind, by others",
            remedy="Have the engineer of the wind design state it, and enter it on the sheet "
            "Arrays.",
            places=_places(data, array, "wind_weight_pa"),
        )
    else:
        is_same = measured(wind_pa, unit) == measured(here_pa, unit)  # to the digits printed
        weight, wanted = (pair(value, *units) for value in (wind_pa, here_pa))
        if not is_same:
            weight, wanted = compared_pairs(
                entered(wind_pa), here, *units, is_at_least=wind_pa < here_pa
            )
        yield condition(
            id="wind_weight",
            title="Weight in wind design",
            cause="weight differs from the wind design",
            subject=array.id,
            found=weight,
            limit=f"= {wanted}",
            basis="wind, by others",
            is_satisfied=is_same,
            remedy="Use one weight with ballast in both: correct it, or the wind design.",
            places=_places(data, array, "weight_n", "wind_weight_pa"),
        )


def _interconnection(data: ProjectInput, array: Array, required_n: float) -> Requirement:
    state = NOT_GIVEN if array.interconnection_n is None else "too low"
    return Requirement(
        id=STRENGTH_ROW,
        title="Interconnection strength provided",
        cause=f"interconnection strength {state}",
        subject=array.id,
        **_provided(array.interconnection_n, required_n, Quantity.WEIGHT, data.us_first),
        basis=data.site.rule_set,
        remedy="Show that the racking provides the required strength between its parts.",
        places=_places(data, array, "interconnection_n"),
    )


def _places(data: ProjectInput, array: Array, *fields: str) -> tuple[Place, ...]:
    index = [each.id for each in data.arrays].index(array.id)
    return tuple(Place("arrays", index, field) for field in fields)


def _slack(data: ProjectInput, assessed: ArrayAssessment) -> Requirement:
    array = assessed.array
    return Requirement(
        id="electrical_slack",
        title="Electrical slack provided",
        cause=f"electrical slack {NOT_GIVEN if array.slack_m is None else 'too short'}",
        subject=array.id,
        **_provided(array.slack_m, assessed.permitted_m, Quantity.SIZE, data.us_first),
        basis="design displacement",
        remedy="Provide wiring slack of at least the design displacement.",
        places=_places(data, array, "slack_m"),
    )


def _provided(
    value: float | None, required: float, quantity: Quantity, us_first: bool
) -> Mapping[str, Any]:
    """Return what is found and required of a value that a workbook may give, and what follows."""
    provided = math.nan if value is None else value
    had, least = compared_pairs(capacity(provided), demand(required), quantity, us_first)
    return {
        "found": NOT_GIVEN if value is None else had,
        "limit": NO_DESIGN if math.isnan(required) else f"≥ {least}",
        "is_satisfied": provided >= required,
        "consequence": Consequence.CONDITION if value is None else Consequence.NG,
    }
