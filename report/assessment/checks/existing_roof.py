"""The existing building that takes the arrays: the weight added beside its own loads.

The existing-building code has a rule of 5 % for gravity and one of 10 % for lateral loads. Neither
section was compared with its text: hence †. Read `of_existing_roof`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from report.assessment.checks.check import Check, Sense, condition
from report.assessment.design.words import NOT_GIVEN
from report.project.model import ProjectInput
from report.project.model.choices import BuildingCode
from report.project.model.place import Place
from report.text.amounts import capacity, demand
from report.text.letter_case import lowered
from report.text.units import Quantity, pair

_NOISE = 1e-9  # a weight in other units is no more than itself
_REMEDY = (
    "Have the engineer of the existing building evaluate it with the added weight, and enter"
    " this evaluation on the Site worksheet."
)


def of_existing_roof(data: ProjectInput) -> Iterator[Check]:
    """Yield the weight added as a share of the roof's own loads, and what is not entered."""
    site, heaviest = data.site, max(data.arrays, key=lambda array: array.weight_pa)
    added_n = math.fsum(array.weight_n for array in data.arrays)
    evaluated = f"evaluated: {site.roof_evaluation}" if site.roof_evaluation else ""
    code = "CEBC" if site.building_code is BuildingCode.CBC else "IEBC"
    year = f", {site.building_code_year}" if site.building_code else ""
    lacking: dict[str, str] = {}
    for field, load, added, roof_value, quantity, subject, most_percent, section in (
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
            title="Existing building with the weight added",
            found=evaluated or f"not checked: {', '.join(lacking.values())} {NOT_GIVEN}",
            limit="its loads, for the 5% and 10% rules, or an evaluation",
            clause=f"{code} 503.3, 503.4{year}†",
            is_satisfied=bool(evaluated),
            remedy=f"Enter its loads on the Site worksheet, or {lowered(_REMEDY)}",
            places=(*(Place("site", 0, field) for field in lacking),
                    Place("site", 0, "roof_evaluation")),
        )  # fmt: skip
