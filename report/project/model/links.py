"""An array as a row of linked blocks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from report.project.model.choices import Id, Positive, decimals
from report.project.model.frozen import Frozen
from report.text.units import G_MPS2
from solver.friction_tests import MOST_MU

if TYPE_CHECKING:
    from solver.sliding.row import BlockRow


# Fewest and most blocks of a row.
BLOCKS = (2, 20)


def coefficients(text: str) -> tuple[float, ...]:
    """Return the numbers of a list such as `0.40, 0.45, 0.50`; empty if the text is not one."""
    mus = decimals(text)
    return mus if BLOCKS[0] <= len(mus) <= BLOCKS[1] and max(mus) <= MOST_MU else ()


class Links(Frozen):
    """An array as a row of linked blocks of equal weight along the slope."""

    array: Id
    friction: Annotated[str, Field(min_length=1, max_length=200)]
    stiffness_n_per_m: Positive
    damping_ratio: Annotated[float, Field(ge=0, le=1)] = 0.0

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
