"""The distance between fire lanes: arrays closer than the width of a lane are one.

The dimension and the width are practice; the section is an input. Read `fire_lane_rows`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from report.assessment.verdict import NOT_GIVEN, STAYS, Requirement, condition
from report.sheet.schema import ProjectInput
from report.sheet.schema.fields import Place
from report.sheet.schema.scene import SIDES, Array
from report.sheet.schema.shapes import around, gap_m
from report.words.counts import ranged
from report.words.units import Quantity, compared_pairs, pair

FIRE_LANE_M = 150 * 0.3048
"""Largest plan dimension of arrays between fire lanes [m]."""

_MOST_M = FIRE_LANE_M * (1.0 + 1e-9)  # 150 ft given in meters is no more than 150 ft
_ROUNDING_M = 1e-3  # a lane of 4 ft is typed as 1.22 m
_STATE = "State on the sheet Site the section of the fire code."
_DIVIDE = f"Divide the arrays by a fire lane, or obtain the fire department's approval. {STAYS}"


def fire_lane_rows(data: ProjectInput) -> Iterator[Requirement]:
    """Yield for each array the plan dimension of all that no fire lane separates from it."""
    lane_m, section = data.site.fire_lane_m, data.site.fire_code_section
    at = {array.id: row for row, array in enumerate(data.arrays)}
    groups = [(group, _dimension_m(group)) for group in _undivided(data.arrays, lane_m)]
    largest_m = max((m for _, m in groups if m <= _MOST_M), default=0.0)
    units = Quantity.PLAN, data.us_first
    lane = pair(lane_m, *units)
    for group, dimension_m in groups:
        fits = dimension_m <= _MOST_M
        # Of arrays that only lack the section the same is said: they share a condition.
        shown_m = largest_m if fits and not section else dimension_m
        found, limit = compared_pairs(shown_m, FIRE_LANE_M, *units, up=not fits)
        if fits and not section:
            found = f"at most {found}"
        elif len(group) > 1:
            found = f"{ranged(array.id for array in group)} together: {found}"
        for array in group:
            yield condition(
                id="fire_lanes",
                title=f"Largest plan dimension between fire lanes of {lane}",
                cause="fire code section not given" if fits else "too wide between fire lanes",
                subject=array.id,
                found=found if section else f"{found}; section {NOT_GIVEN}",
                limit=f"≤ {limit}",
                basis=f"{section or f'fire code, section {NOT_GIVEN}'}†",
                is_satisfied=fits and bool(section),
                remedy=_DIVIDE if section else _STATE if fits else f"{_STATE} {_DIVIDE}",
                places=tuple(Place("arrays", at[array.id], side) for side in SIDES)
                if section
                else (Place("site", 0, "fire_code_section"),),
            )


def _dimension_m(group: Sequence[Array]) -> float:
    plan = around(array.shape for array in group)
    return max(plan.x_to_m - plan.x_from_m, plan.y_to_m - plan.y_from_m)


def _undivided(arrays: Sequence[Array], lane_m: float) -> Sequence[Sequence[Array]]:
    """Return arrays in groups: each is nearer than a lane to another one of its group."""
    groups: list[list[Array]] = []
    for array in arrays:
        apart: list[list[Array]] = []
        joined = [array]
        for group in groups:
            if any(gap_m(array.shape, one.shape) < lane_m - _ROUNDING_M for one in group):
                joined += group
            else:
                apart.append(group)
        groups = [*apart, joined]
    return groups
