"""The evidence as it is written and shown: neighbors, remedies, margins, sums, rows of blocks.

Computes nothing: see `report.assessment.evidence` and, of linked blocks, `report.assessment.links`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from operator import attrgetter
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from report.assessment.causes import came_to
from report.assessment.links import LinkedArray
from report.assessment.neighbors import Cover, NearbyKind
from report.assessment.remedies import Remedies, RemedyKind
from report.assessment.uncertainty import Uncertainty
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
    plain,
    printed,
    provided,
    required,
    text,
    unwritten,
    up_column,
    words,
)
from report.project.model.motions import BuildingInput
from report.text.counts import joined
from report.text.units import Quantity, Rounding, number
from solver.model import INCH_M, Status
from solver.rules.provisions import AnalysisValue


def _cells(rows: Any) -> tuple[str, ...]:
    # Read back from results.json they are cells already.
    return tuple(getattr(row, "cell", row) for row in rows)


def _numbers(clearances: tuple[GivenResult, ...]) -> str:
    return f"No. {', '.join(row.clearance for row in clearances)}" if clearances else "—"


class RemedyResult(Entity):
    """A change that satisfies checks which are NG, or changes that are enough together."""

    quantities: tuple[RemedyKind, ...]
    """What would have to change."""
    checks: tuple[str, ...]
    """What it satisfies, as printed."""
    change: str
    """In words."""
    verdict: Verdict
    """On the project with it."""
    governing: str
    """The same with the checks that then govern, in words."""


class GivenResult(Entity):
    """A clearance given for a neighbor."""

    clearance: Annotated[str, at("number"), BeforeValidator(str)]
    """Number of the clearance."""
    cell: str
    """Cell of the clearance in the workbook."""
    provided_m: Annotated[float, at("clearance.provided_m")]
    """Separation entered there."""


class NeighborResult(Entity):
    """What the plan shows near an array, and the clearances that cover or contradict it."""

    across: ClassVar[str] = "array other what gap_m reach_m given cover"

    array: Annotated[str, words("Array", 0.7), Column()]
    """Id of the array."""
    other: Annotated[str, words("Neighbor", 1.3), Column()]
    """Id of the array or object across the gap; words for an edge."""
    kind: NearbyKind
    """What is across the gap."""
    gap_m: Annotated[
        float, provided("In plan", 0.8), Column("Distance in plan [in]", 1, rounding=Rounding.DOWN)
    ]
    """Least distance in plan; negative if they overlap."""
    reach_m: Annotated[
        Number,
        required("Twice displ.", 0.8),
        up_column("Twice the design displacement [in]", 1),
    ]
    """Distance within which a clearance is needed."""
    is_missing: bool
    """Whether it is that near and has no clearance."""
    add_to: Annotated[str, at("to_add")]
    """Cell to which a missing row is to be added."""
    given: Annotated[
        tuple[GivenResult, ...],
        Shown(head="Clearance", text=_numbers, align="left", share=0.9),
        Column(value=_numbers),
    ]
    """Clearances between the two."""
    contradictions: Annotated[tuple[str, ...], BeforeValidator(_cells)]
    """Cells of clearances that differ from the distance in plan."""
    cover: Annotated[Cover, words("Remark", 2.8), Column()]
    """Whether the clearances agree with the plan; without any, whether the distance suffices."""
    what: Annotated[str, words("Kind", 1.8), Column()]
    """Kind of the object, in words; for others as `kind`."""


class MarginResult(Entity):
    """The margin of a clearance in friction."""

    clearance: Annotated[str, at("number"), BeforeValidator(str)]
    """Number of the clearance."""
    array: Annotated[str, at("array.id")]
    """Array whose friction is varied."""
    mu: Annotated[float, at("array.array.mu")]
    """Friction coefficient entered."""
    least_mu: Annotated[Number, at("minimum_mu")]
    """Least friction coefficient at which the clearance is satisfied."""
    lowest_mu_tried: Annotated[Number, at("lowest_tried")]
    """Friction coefficient at which the search ends."""
    is_beyond: bool
    """Whether the clearance is satisfied throughout."""
    required_m: Number
    """Required separation at the least friction coefficient."""


class TurnedResult(Entity):
    """A run with the horizontal components turned."""

    angle_deg: float
    """Angle of the pair, counterclockwise; at 0 the record acts downslope."""
    prd_m: Annotated[Number, at("result.prd_m")]
    """PRD."""
    status: Annotated[Status, at("result.status")]
    """Outcome."""


class AnglesResult(Entity):
    """Directions of shaking that are not run for the design."""

    motion: Annotated[str, at("motion.motion.id")]
    """Governing motion."""
    prd_m: Annotated[Number, at("motion.governing.result.prd_m")]
    """PRD used for the design."""
    turned: tuple[TurnedResult, ...]
    """Runs with the pair turned."""
    vertical_reversed_prd_m: Annotated[Number, at("reversed_m")]
    """PRD with the vertical component reversed; null without one."""


class UncertaintyResult(Entity):
    """Margins and confidence of the displacements."""

    margins: tuple[MarginResult, ...]
    """Margin of each clearance in friction."""
    angles: AnglesResult
    """Other directions of the same shaking."""


class CumulativeResult(Entity):
    """The sums of the PRDs of the design event and of smaller ones, by motion."""

    array: Annotated[str, at("array.id")]
    """Id of the array."""
    sums_m: Mapping[str, Number]
    """Sum of the PRDs by motion."""
    mean_m: Number
    """Mean of the sums."""
    largest_m: Number
    """Largest of the sums."""


class VariationResult(Entity):
    """The governing array with a period and a damping of the building."""

    period_s: float
    """First period."""
    damping_percent: float
    """Damping, in percent of critical."""
    mean_m: Number
    """Mean PRD."""
    largest_m: Number
    """Largest PRD."""
    value_m: Number
    """Value from analysis."""


def variation_result(building: BuildingInput, value: AnalysisValue) -> VariationResult:
    """Return a variation of the building."""
    return VariationResult.of(building, **asdict(value))


def remedy_results(found: Remedies) -> Iterator[RemedyResult]:
    """Yield the remedies of each check, then the changes that are enough together, if several."""
    own = [((remedy,), remedy.done) for remedy in found.own]
    for remedies, done in [*own, (found.together[len(found.together) == 1 :], found.done)]:
        if remedies and done:
            yield RemedyResult(
                quantities=tuple(remedy.kind for remedy in remedies),
                checks=tuple(
                    f"{check.title}, {check.subject}"
                    for remedy in remedies
                    for check in remedy.checks
                ),
                change=joined([remedy.words for remedy in remedies]),
                verdict=done.verdict,
                governing=came_to(done),
            )


def uncertainty_result(item: Uncertainty) -> UncertaintyResult:
    """Return the margins, and the directions not run."""
    return UncertaintyResult.of(item, angles=AnglesResult.of(item))


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
    # The design displacement is multiplied by it: rounded down it would print too small. Less a
    # millionth of the last digit, which is rounding error.
    return number(math.ceil(value * 1e3 - 1e-6) / 1e3 if math.isfinite(value) else value, 3)


_RIGID = f"={{factor}}*IF({TAKES_LARGEST},{{rigid_largest_m}},{{rigid_mean_m}})"
_ROW = f"={{factor}}*IF({TAKES_LARGEST},{{row_largest_m}},{{row_mean_m}})"
# Links never lower a design displacement: a ratio below 1 counts as 1.
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
        Number,
        at("rigid.value_m"),
        required("Rigid, one axis"),
        up_column("Rigid [in]", 1, _RIGID),
    ]
    linked_one_axis_m: Annotated[
        Number, at("linked.value_m"), required("Row, one axis"), up_column("Row [in]", 1, _ROW)
    ]
    ratio: Annotated[
        Number,
        Shown(head="Ratio r", text=ratio_up, share=0.9),
        up_column("Ratio", 3, "={linked_one_axis_m}/{rigid_one_axis_m}"),
    ]
    design_m: Annotated[
        Number,
        at("design.design_m"),
        up_column("Design used [in]", 1, "={design.design_m}"),
    ]
    """Design displacement of the array as one rigid block."""
    estimated_m: Annotated[
        Number,
        required("Design, with links"),
        up_column("Design with links [in]", 1, _DESIGN),
    ]
    link_force_n: Annotated[Number, Shown(head="Link force", quantity=Quantity.WEIGHT, share=0.9)]
    rigid_is_enough: Annotated[bool, at("is_rigid_enough")]
    """Whether one rigid block is adequate."""
    runs: tuple[LinkedRunResult, ...]
    """All runs."""
    permitted_m: Annotated[Number, at("design.permitted_m"), required("Design, used")] = printed(
        math.nan
    )
    rigid_prd_m: Annotated[Number, required("PRD, rigid", 0.8)] = printed(math.nan)
    prd_m: Annotated[Number, at("farthest.prd_m"), required("PRD, row", 0.8)] = printed(math.nan)
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
    # A row without a final value has no farthest block.
    block = math.nan if math.isnan(item.farthest.prd_m) else item.farthest.block
    return LinkedResult.of(item, runs=runs, block=block)
