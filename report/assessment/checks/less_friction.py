"""What is permitted as entered, and not with less friction."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from report.assessment.checks.check import Check, condition
from report.assessment.design.friction import SHIFT
from report.text.units import number
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment


def of_less(done: Assessment) -> Iterator[Check]:
    """Yield the routes and clearances that are permitted as given, and not with less friction."""
    reduced = done.at_reduced_friction
    if reduced is None:
        return
    friction = f"{number(100.0 * SHIFT, 0)} % less friction"
    row = partial(condition, is_satisfied=False, clause="sensitivity", is_capacity=False)
    changed = [*_routes(done, reduced, friction, row), *_clearances(done, reduced, friction, row)]
    yield from changed or [
        row(
            id="less_friction",
            title=f"Procedures and clearances with {friction}",
            found="permitted and satisfied as entered",
            limit="permitted and satisfied",
            is_satisfied=True,
        )
    ]


def _routes(
    done: Assessment, reduced_assessment: Assessment, friction: str, row: partial[Check]
) -> Iterator[Check]:
    for array, reduced in zip(done.arrays, reduced_assessment.arrays, strict=True):
        if array.is_permitted and not reduced.is_permitted:
            # No code asks for this margin, and no cell could show it: only a larger coefficient.
            yield row(
                id="less_friction",
                consequence=Consequence.NOTE,
                title=f"The {array.route} procedure with {friction}",
                subject=array.id,
                found=f"not permitted with μ = {number(reduced.array.minimum_mu, 3)}",
                limit="permitted",
                remedy=f"The procedure is permitted as entered but not with {friction}.",
            )


def _clearances(
    done: Assessment, reduced_assessment: Assessment, friction: str, row: partial[Check]
) -> Iterator[Check]:
    for gap, short in zip(done.clearances, reduced_assessment.clearances, strict=True):
        if gap.verdict.is_permitted and not short.verdict.is_permitted:
            clearance = gap.clearance
            yield row(
                id="clearance_less_friction",
                title=f"Clearance with {friction}",
                subject=f"{clearance.array} to {clearance.object}",
                arrays=(clearance.array,),
                found="not satisfied",
                limit="satisfied",
                remedy="Confirm the friction coefficient, or provide more clearance.",
            )
