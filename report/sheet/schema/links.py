"""Rows of linked blocks: arrays of which the workbook asks whether one rigid block is enough.

Read `report.sheet.schema` first; `report.assessment.links` runs them.
"""

from __future__ import annotations

import math
import re
from typing import Annotated

from pydantic import Field, model_validator

from report.sheet.fields import Cell, Frozen
from report.sheet.schema.choices import Id, Positive
from report.words.units import G_MPS2, Quantity
from solver.sliding.row import BlockRow

BLOCKS = (2, 20)
"""Fewest and most blocks of a row."""

MOST_MU = 1.5
_COEFFICIENT = re.compile(r"[0-9]*\.[0-9]+")


def coefficients(text: str) -> tuple[float, ...]:
    """Return a list such as `0.40, 0.45, 0.50`; empty where the text is none.

    Each has a decimal point, so that a decimal comma never makes two of one.
    """
    parts = [part.strip() for part in text.split(",")]
    if not all(map(_COEFFICIENT.fullmatch, parts)):
        return ()
    found = tuple(map(float, parts))
    return found if BLOCKS[0] <= len(found) <= BLOCKS[1] and max(found) <= MOST_MU else ()


class Links(Frozen):
    """An array as a row of blocks of equal weight down the slope, a link between neighbours."""

    array: Annotated[Id, Cell("Array", "ID of the array. One line for each.", "A1")]
    friction: Annotated[
        str,
        Field(min_length=1, max_length=200),
        Cell(
            "Friction of blocks",
            "From the highest block down, 2 to 20 coefficients with commas between them, the "
            "array's own within their range.",
            "0.40, 0.45, 0.50",
        ),
    ]
    stiffness_n_per_m: Annotated[
        Positive,
        Cell(
            "Link stiffness",
            "Force along the slope for each unit by which a link gets longer or shorter.",
            5000.0,
            Quantity.STIFFNESS,
        ),
    ]
    damping_ratio: Annotated[
        Annotated[float, Field(ge=0, le=1)],
        Cell("Link damping", "Ratio of critical, of one block on one link. Blank: none.", 0.02),
    ] = 0.0

    @model_validator(mode="after")
    def _is_row(self) -> Links:
        if not self.mus:
            raise ValueError("give the friction coefficients of 2 to 20 blocks")
        return self

    @property
    def mus(self) -> tuple[float, ...]:
        """Friction coefficient of each block, from the highest down."""
        return coefficients(self.friction)

    def row(self, weight_n: float) -> BlockRow:
        """Return the row of an array of some weight [N]."""
        stiffness = self.stiffness_n_per_m * len(self.mus) * G_MPS2 / weight_n
        damping = 2.0 * self.damping_ratio * math.sqrt(stiffness)
        return BlockRow(mus=self.mus, stiffness_per_s2=stiffness, damping_per_s=damping)
