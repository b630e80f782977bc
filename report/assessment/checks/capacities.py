"""Strength, slack and weight of an array, and added weight on the existing building.

The existing-building code has a rule of 5% for gravity and one of 10% for lateral loads. Neither
section was compared with its text: hence †.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from report.assessment.checks.check import STRENGTH_ROW, Actor, Check, Sense, condition, dagger
from report.assessment.design.rule_set import rule_set_of
from report.assessment.design.verdict import NO_DESIGN, NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import BuildingCode
from report.project.model.input_rows import Place
from report.text.amounts import capacity, demand, entered
from report.text.letter_case import lowered
from report.text.units import Quantity, measured, pair
from solver.rules.limit import Consequence

_NOISE = 1e-9  # a weight in other units is no more than itself


def before_runs(data: ProjectInput, array: Array, required_n: float) -> Iterator[Check]:
    """Yield the requirements on an array that need no run, with the strength of its parts [N]."""
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
        remedy="Document that the racking provides the required strength between its parts, and "
        "enter this strength on the Arrays worksheet.",
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
    """Return the value found, the value required and the consequence for an optional input."""
    has_limit = not math.isnan(required)
    return {
        "found": NOT_GIVEN if value is None else capacity(value, quantity),
        "limit": demand(required, quantity) if has_limit else NO_DESIGN,
        "sense": Sense.AT_LEAST if has_limit else Sense.STATED,
        # False for NaN: nothing is enough for a displacement that is not known.
        "is_satisfied": value is not None and value >= required,
        # What is not entered may be there, and is to be shown; what is too small is NG.
        "consequence": Consequence.CONDITION if value is None else Consequence.NG,
    }


def _weight(data: ProjectInput, array: Array) -> Iterator[Check]:
    """Yield the weight per plan area compared with the values of the roof and wind engineers."""
    here_pa, capacity_pa, wind_pa = array.weight_pa, array.roof_capacity_pa, array.wind_weight_pa
    unit = Quantity.PRESSURE.us if data.us_first else Quantity.PRESSURE.si
    if capacity_pa is None:
        yield condition(
            id="roof_capacity",
            title="Weight per plan area",
            subject=array.id,
            arrays=(array.id,),
            found=f"allowable load {NOT_GIVEN}",
            limit="allowable roof load",
            clause="allowable load, as entered",
            actor=Actor.ROOF,
            is_satisfied=False,
            remedy="Obtain the allowable roof load from the engineer of the roof, and enter it"
            " on the Arrays "
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
            clause="allowable load, as entered",
            actor=Actor.ROOF,
            is_satisfied=here_pa <= capacity_pa * (1.0 + _NOISE),
            remedy="Reduce the weight, or obtain a larger allowable load from the engineer of"
            " the roof.",
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
        remedy="Obtain the weight with ballast from the engineer of the wind design, and use"
        " the same "
        "weight in both designs.",
        places=_places(data, array, "weight_n", "wind_weight_pa"),
    )


def _places(data: ProjectInput, array: Array, *fields: str) -> tuple[Place, ...]:
    index = [row.id for row in data.arrays].index(array.id)
    return tuple(Place("arrays", index, field) for field in fields)


_REMEDY = (
    "Obtain an evaluation of the existing building with the added weight from its engineer, and"
    " enter"
    " it on the Site worksheet."
)


def of_existing_roof(data: ProjectInput) -> Iterator[Check]:
    """Yield the added weight as a fraction of the roof's own loads, and missing inputs."""
    site, heaviest = data.site, max(data.arrays, key=lambda array: array.weight_pa)
    added_n = math.fsum(array.weight_n for array in data.arrays)
    evaluated = f"evaluated: {site.roof_evaluation}" if site.roof_evaluation else ""
    code = "CEBC" if site.building_code is BuildingCode.CBC else "IEBC"
    year = f", {site.building_code_year}" if site.building_code else ""
    lacking: dict[str, str] = {}
    for field, load, added, roof_value, quantity, subject, most_percent, section in (
        # 503.3 is of an element of the roof, which the heaviest array loads most; 503.4 is of the
        # building, which carries all of them.
        ("roof_load_pa", "design load of the roof", heaviest.weight_pa, site.roof_load_pa,
         Quantity.PRESSURE, heaviest.id, 5.0, "503.3"),
        ("seismic_weight_n", "seismic weight of the building", added_n, site.seismic_weight_n,
         Quantity.WEIGHT, "all arrays", 10.0, "503.4"),
    ):  # fmt: skip
        if roof_value is None:
            lacking[field] = load
            continue
        percent = 100.0 * added / roof_value
        first, second = (pair(value, quantity, data.us_first) for value in (added, roof_value))
        is_met = percent <= most_percent * (1.0 + _NOISE)
        yield condition(
            id=field,
            title=f"Weight added / {load}",
            found=demand(percent, Quantity.PERCENT),
            note=f"{subject}: {first} of {second}"
            + ("" if is_met or not evaluated else f"; {evaluated}"),
            limit=capacity(most_percent, Quantity.PERCENT, mark=", or an evaluation"),
            sense=Sense.AT_MOST,
            clause=f"{code} {section}{year}†",
            is_satisfied=is_met or bool(evaluated),
            remedy=_REMEDY,
            places=(Place("site", 0, field), Place("site", 0, "roof_evaluation")),
        )
    if lacking:
        yield condition(
            id="existing_roof",
            title="Existing building with the added weight",
            found=evaluated or f"not checked: {' and '.join(lacking.values())} {NOT_GIVEN}",
            limit="loads for the 5% and 10% rules, or an evaluation",
            clause=f"{code} 503.3, 503.4{year}†",
            is_satisfied=bool(evaluated),
            remedy=f"Enter its loads on the Site worksheet, or {lowered(_REMEDY)}",
            places=(*(Place("site", 0, field) for field in lacking),
                    Place("site", 0, "roof_evaluation")),
        )  # fmt: skip
