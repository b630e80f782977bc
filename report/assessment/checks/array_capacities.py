"""Strength, roof capacity, weight and slack that the workbook states of an array."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from report.assessment.checks.check import STRENGTH_ROW, Actor, Check, Sense, condition, dagger
from report.assessment.design.rule_set import rule_set_of
from report.assessment.design.words import NO_DESIGN, NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.place import Place
from report.text.amounts import capacity, demand, entered
from report.text.units import Quantity, measured
from solver.rules.limit import Consequence

_NOISE = 1e-9  # a weight in other units is no more than itself


def before_runs(data: ProjectInput, array: Array, required_n: float) -> Iterator[Check]:
    """Yield what is required of an array and needs no run; of its parts a strength [N]."""
    yield _interconnection(data, array, required_n)
    yield from _weight(data, array)


def _interconnection(data: ProjectInput, array: Array, required_n: float) -> Check:
    # PV1-2012 section 6: the larger of 0.133 S_DS W1 and 0.1 W1, W1 the lighter side.
    strength = rule_set_of(data).values["interconnection_sds"]
    return Check(
        id=STRENGTH_ROW,
        title="Interconnection strength",
        subject=array.id,
        arrays=(array.id,),
        **_provided(array.interconnection_n, required_n, Quantity.WEIGHT),
        clause=strength.clause + dagger(strength),
        actor=Actor.SUPPLIER,
        remedy="Show that the racking provides the required strength between its parts, and enter "
        "it on the Arrays worksheet.",
        places=_places(data, array, "interconnection_n"),
    )


def slack_check(array: Array, required_m: float, index: int) -> Check:
    """Return whether the wiring has slack for a displacement [m]; NaN before it is known."""
    return Check(
        id="electrical_slack",
        title="Electrical slack",
        subject=array.id,
        arrays=(array.id,),
        **_provided(array.slack_m, required_m, Quantity.SIZE),
        clause="design displacement",
        remedy="Provide wiring slack of at least the design displacement, and enter it on the "
        "Arrays worksheet.",
        places=(Place("arrays", index, "slack_m"),),
    )


def _provided(value: float | None, required: float, quantity: Quantity) -> Mapping[str, Any]:
    """Return what is found and required of a value that a workbook may give, and what follows."""
    has_limit = not math.isnan(required)
    return {
        "found": NOT_GIVEN if value is None else capacity(value, quantity),
        "limit": demand(required, quantity) if has_limit else NO_DESIGN,
        "sense": Sense.AT_LEAST if has_limit else Sense.STATED,
        "is_satisfied": value is not None and value >= required,
        "consequence": Consequence.CONDITION if value is None else Consequence.NG,
    }


def _weight(data: ProjectInput, array: Array) -> Iterator[Check]:
    """Yield the weight per plan area beside what the engineers of roof and wind state."""
    here_pa, capacity_pa, wind_pa = array.weight_pa, array.roof_capacity_pa, array.wind_weight_pa
    unit = Quantity.PRESSURE.us if data.us_first else Quantity.PRESSURE.si
    if capacity_pa is None:
        yield condition(
            id="roof_capacity",
            title="Weight per plan area",
            subject=array.id,
            arrays=(array.id,),
            found=f"roof capacity {NOT_GIVEN}",
            limit="the weight per plan area that the roof's engineer permits",
            clause="roof capacity, as entered",
            actor=Actor.ROOF,
            is_satisfied=False,
            remedy="Have the roof's engineer state the roof capacity, and enter it on the Arrays "
            "worksheet.",
            places=_places(data, array, "roof_capacity_pa"),
        )
    else:
        yield Check(
            id="roof_capacity",
            title="Weight per plan area",
            subject=array.id,
            arrays=(array.id,),
            found=entered(here_pa, Quantity.PRESSURE),
            limit=capacity(capacity_pa, Quantity.PRESSURE),
            sense=Sense.AT_MOST,
            clause="roof capacity, as entered",
            actor=Actor.ROOF,
            is_satisfied=here_pa <= capacity_pa * (1.0 + _NOISE),
            remedy="Reduce the weight, or have the roof's engineer state a larger capacity.",
            places=_places(data, array, "weight_n", "roof_capacity_pa"),
        )
    yield condition(
        id="wind_weight",
        title="Weight in wind design",
        subject=array.id,
        arrays=(array.id,),
        found=NOT_GIVEN if wind_pa is None else entered(wind_pa, Quantity.PRESSURE),
        limit=entered(here_pa, Quantity.PRESSURE),
        sense=Sense.EQUAL,
        is_capacity=False,
        clause="wind design, by others",
        actor=Actor.WIND,
        # To the digits that are printed.
        is_satisfied=wind_pa is not None and measured(wind_pa, unit) == measured(here_pa, unit),
        remedy="Have the engineer of the wind design state the weight with ballast, and use one "
        "weight in both.",
        places=_places(data, array, "weight_n", "wind_weight_pa"),
    )


def _places(data: ProjectInput, array: Array, *fields: str) -> tuple[Place, ...]:
    index = [row.id for row in data.arrays].index(array.id)
    return tuple(Place("arrays", index, field) for field in fields)
