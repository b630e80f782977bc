"""Inputs, headings and orders of earlier workbooks, which can still be read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GoneInput:
    """An input of earlier workbooks that no longer exists; rejected if it has an effect.

    A blank cell or a default has no effect.
    """

    field: str  # with which its defined name ends
    label: str
    defaults: tuple[str, ...]  # lowercase
    remedy: str


# By section.
GONE: Mapping[str, tuple[GoneInput, ...]] = {
    "options": (
        GoneInput(
            field="directional",
            label="Displacement by direction",
            defaults=("no", "false"),
            remedy="select No: clearances use the full design displacement, because the rule sets"
            " do not distinguish directions",
        ),
    ),
    "arrays": (
        GoneInput(
            field="model",
            label="Model",
            defaults=("choose",),
            remedy="select 'choose': each run uses the simplest adequate model. In Python,"
            " solver.solve runs any model",
        ),
    ),
}

# Headings of formulas of earlier workbooks by section, lowercase and without unit.
FORMER_ANSWERS: Mapping[str, frozenset[str]] = {
    "arrays": frozenset({"kind of array", "slope in degrees", "weight per area"}),
    "clearances": frozenset(
        {"d/c, floor", "neighbor", "row of array", "row of other array", "row of object"}
    ),
    "outlines": frozenset({"twice the area"}),
}

# Earlier order of the first fields of a block, in which confirmations are hashed.
ORDERS: Mapping[str, Sequence[str]] = {
    "site": ("rule_set", "risk_category", "i_e", "s_s_g", "s_1_g", "site_class", "f_a", "f_v",
             "s_ds_g", "sdc", "stories", "structure_height_m", "roof_height_m", "edition_name",
             "s_ms_g", "s_m1_g", "s_d1_g"),
}  # fmt: skip
