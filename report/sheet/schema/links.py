"""Rows of linked blocks, requested to check whether one rigid block is adequate for an array.

Read `report.sheet.schema` first; `report.assessment.links` runs them.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, model_validator

from report.sheet.schema.choices import Id, Positive, decimals
from report.sheet.schema.fields import Cell, Frozen
from report.words.units import G_MPS2, Quantity
from solver.friction_tests import MOST_MU

if TYPE_CHECKING:
    from solver.sliding.row import BlockRow

BLOCKS = (2, 20)
"""Fewest and most blocks of a row."""


def coefficients(text: str) -> tuple[float, ...]:
    """Return the numbers of a list such as `0.40, 0.45, 0.50`; empty if the text is not one."""
    mus = decimals(text)
    return mus if BLOCKS[0] <= len(mus) <= BLOCKS[1] and max(mus) <= MOST_MU else ()


class Links(Frozen):
    """An array as a row of linked blocks of equal weight along the slope."""

    array: Annotated[Id, Cell("Array", "A1")]
    """ID of the array. One row for each."""
    friction: Annotated[
        str, Field(min_length=1, max_length=200), Cell("Block friction", "0.40, 0.45, 0.50")
    ]
    """2 to 20 friction coefficients separated by commas, from the upslope block to the downslope
    block. Their range must include the array's coefficient."""
    stiffness_n_per_m: Annotated[Positive, Cell("Link stiffness", 5000.0, Quantity.STIFFNESS)]
    """Axial force per unit elongation or shortening of a link."""
    damping_ratio: Annotated[float, Field(ge=0, le=1), Cell("Link damping", 0.02)] = 0.0
    """Damping ratio of one block on one link. Blank: none."""

    @model_validator(mode="after")
    def _is_row(self) -> Links:
        if not self.mus:
            raise ValueError("give the friction coefficients of 2 to 20 blocks")
        return self

    @property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficient of each block, from the upslope end."""
        return coefficients(self.friction)

    def row(self, weight_n: float) -> BlockRow:
        """Return the row of an array of some weight [N]."""
        from solver.sliding.row import BlockRow  # loads the compiler, and a workbook needs none

        stiffness = self.stiffness_n_per_m * len(self.mus) * G_MPS2 / weight_n
        damping = 2.0 * self.damping_ratio * math.sqrt(stiffness)
        return BlockRow(mus=self.mus, stiffness_per_s2=stiffness, damping_per_s=damping)
