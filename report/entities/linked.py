"""An array as a row of linked blocks, as it is written and shown.

Computes nothing: see `report.assessment.links`. Read `LinkedResult`.
"""

from __future__ import annotations

import math
from operator import attrgetter
from typing import Annotated

from report.assessment.links import LinkedArray
from report.assessment.verdict import Verdict
from report.entities.array import TAKES_LARGEST
from report.entities.motion import OrientedResult
from report.entities.shown import (
    NO_VALUE,
    Column,
    Entity,
    Number,
    Shown,
    at,
    centered,
    length,
    plain,
    printed,
    required,
    text,
    unwritten,
    words,
)
from report.text.units import Quantity, number
from solver.model import INCH_M, Status


def _listed(places_m: tuple[float, ...]) -> str:
    if any(map(math.isnan, places_m)):
        return NO_VALUE
    return ", ".join(f"{place / INCH_M:.2f}" for place in places_m)


class LinkedRunResult(OrientedResult):
    """A run as a row of blocks, and as one block."""

    status: Annotated[Status, at("row.status"), Column("Outcome", value=attrgetter("sentence"))]
    rigid_status: Annotated[Status, at("rigid.status")]
    """Outcome as one block."""
    rigid_prd_m: Annotated[Number, at("rigid.prd_m"), Column("PRD, rigid [in]")]
    prd_m: Annotated[
        tuple[Number, ...],
        at("row.prd_m"),
        Column("PRD of blocks, from the upslope end [in]", value=_listed),
    ]
    residual_m: Annotated[tuple[Number, ...], at("row.residual_m")]
    """Residual displacement of each block, from the upslope end."""
    stretch_m: Annotated[Number, at("row.stretch_m"), Column("Largest link elongation [in]")]
    link_force_n: Annotated[Number, Column("Largest link force [lb]")]
    error_m: Annotated[Number, at("row.error_m"), Column("Error bound [in]")]
    n_stops: Annotated[int, at("row.n_stops"), Column("Stops")]


def ratio_up(value: float) -> str:
    """Return a ratio, rounded up."""
    if math.isnan(value):
        return NO_VALUE
    return number(math.ceil(value * 1e3 - 1e-6) / 1e3 if math.isfinite(value) else value, 3)


_RIGID = f"={{factor}}*IF({TAKES_LARGEST},{{rigid_largest_m}},{{rigid_mean_m}})"
_ROW = f"={{factor}}*IF({TAKES_LARGEST},{{row_largest_m}},{{row_mean_m}})"
_DESIGN = "=MAX(MAX(1,{ratio})*{computed_m},{floor_m})"


class LinkedResult(Entity):
    """An array as a row of linked blocks, beside its design as one rigid block."""

    array: Annotated[str, at("design.id"), words("Array", 0.9), Column()]
    mus: Annotated[tuple[float, ...], at("row.mus")]
    """Friction coefficient of each block, from the upslope end."""
    stiffness_n_per_m: Annotated[
        float,
        at("links.stiffness_n_per_m"),
        Shown(head="Link stiffness", quantity=Quantity.STIFFNESS),
    ]
    damping_ratio: Annotated[
        float, at("links.damping_ratio"), plain("Damping", 3, unit="of critical", share=1.2)
    ]
    rigid_one_axis_m: Annotated[
        Number, at("rigid.value_m"), length("Rigid, one axis"), Column("Rigid [in]", 3, _RIGID)
    ]
    linked_one_axis_m: Annotated[
        Number, at("linked.value_m"), length("Row, one axis"), Column("Row [in]", 3, _ROW)
    ]
    ratio: Annotated[
        Number,
        Shown(head="Ratio r", text=ratio_up, share=0.9),
        Column("Ratio", 3, "={linked_one_axis_m}/{rigid_one_axis_m}"),
    ]
    design_m: Annotated[
        Number, at("design.design_m"), Column("Design used [in]", 3, "={design.design_m}")
    ]
    """Design displacement of the array as one rigid block."""
    estimated_m: Annotated[
        Number, required("Design, with links"), Column("Design with links [in]", 3, _DESIGN)
    ]
    link_force_n: Annotated[Number, Shown(head="Link force", quantity=Quantity.WEIGHT, share=0.9)]
    rigid_is_enough: Annotated[bool, at("is_rigid_enough")]
    """Whether one rigid block is adequate."""
    runs: tuple[LinkedRunResult, ...]
    """All runs."""
    permitted_m: Annotated[Number, at("design.permitted_m"), required("Design, used")] = printed(
        math.nan
    )
    rigid_prd_m: Annotated[Number, length("PRD, rigid", 0.8)] = printed(math.nan)
    prd_m: Annotated[Number, at("farthest.prd_m"), length("PRD, row", 0.8)] = printed(math.nan)
    block: Annotated[Number, plain("Block", 0, share=0.8)] = printed(math.nan)

    @unwritten(text("Blocks", share=0.9))
    def n_blocks(self) -> int:
        """Number of blocks."""
        return len(self.mus)

    @unwritten(text("μ", share=1.5))
    def mu_range(self) -> str:
        """The smallest and the largest friction coefficient of the blocks."""
        return " to ".join(number(mu, 3) for mu in sorted({min(self.mus), max(self.mus)}))

    @unwritten(centered("Verdict"))
    def verdict(self) -> Verdict:
        """Whether one rigid block is adequate."""
        return Verdict.OK if self.rigid_is_enough else Verdict.NG


def linked_result(item: LinkedArray) -> LinkedResult:
    """Return an array as a row of linked blocks."""
    runs = tuple(
        LinkedRunResult.of(
            run, motion=motion.motion.id, link_force_n=run.row.link_force * item.block_n
        )
        for motion in item.motions
        for run in motion.runs
    )
    block = math.nan if math.isnan(item.farthest.prd_m) else item.farthest.block
    return LinkedResult.of(item, runs=runs, block=block)
