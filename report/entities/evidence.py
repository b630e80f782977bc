"""The evidence as it is written and shown: neighbors, remedies, margins, directions, sums.

Computes nothing: see `report.assessment.evidence`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from report.assessment.neighbors import Cover, NearbyKind
from report.assessment.remedies import Remedy, RemedyKind
from report.assessment.uncertainty import Uncertainty
from report.assessment.verdict import Verdict
from report.entities.shown import (
    Column,
    Entity,
    Number,
    OfUnit,
    RangeOfUnit,
    Shown,
    at,
    length,
    words,
)
from report.sheet.schema.motions import BuildingInput
from report.text.units import no_less
from solver.model import Status
from solver.rules.provisions import AnalysisValue


def _cells(rows: Any) -> tuple[str, ...]:
    return tuple(getattr(row, "cell", row) for row in rows)


def _numbers(clearances: tuple[GivenResult, ...]) -> str:
    return f"No. {', '.join(row.clearance for row in clearances)}" if clearances else "—"


class RemedyResult(Entity):
    """A change that would satisfy a clearance or an array, under the keys of its unit."""

    quantity: RemedyKind
    """What would have to change."""
    clearance: str | None
    """Number of the clearance; null for the runs of an array."""
    array: str
    """Array whose friction or displacement it is."""
    exists: bool
    """Whether a value satisfies."""
    given: OfUnit
    """Value entered: friction coefficient."""
    given_m: OfUnit
    """Value entered: separation."""
    value: OfUnit
    """Least friction coefficient that satisfies."""
    value_m: OfUnit
    """Least separation that satisfies."""
    resolution: OfUnit
    """Step of the search."""
    resolution_m: OfUnit
    """Step of the search; 0 where the value follows from the runs."""
    verified: RangeOfUnit
    """Range in which every value tried satisfied."""
    verified_m: RangeOfUnit
    """Range in which every value tried satisfied."""
    n_values: int
    """Number of values tried in that range."""
    basis: str
    """What was varied, or why no value satisfies."""
    verdict: Verdict | None
    """On the project with it; null where no value satisfies."""
    governing: str | None
    """The same with the clearance that then governs, in words."""


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
    gap_m: Annotated[float, length("In plan", 0.8), Column("Distance in plan [in]")]
    """Least distance in plan; negative if they overlap."""
    reach_m: Annotated[
        Number, length("Twice displ.", 0.8, no_less), Column("Twice the design displacement [in]")
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


def remedy_result(item: Remedy, us_first: bool) -> RemedyResult:
    """Return a remedy."""
    names = ("given", "value", "resolution", "verified")
    unit = "" if item.kind is RemedyKind.FRICTION else "_m"
    return RemedyResult(
        quantity=item.kind,
        clearance=f"{item.clearance}" if item.clearance else None,
        array=item.array,
        exists=item.exists,
        **{f"{name}{unit}": getattr(item, name) for name in names},
        n_values=item.n_values,
        basis=item.basis,
        verdict=item.outcome.verdict if item.outcome else None,
        governing=item.outcome.words(us_first) if item.outcome else None,
    )


def uncertainty_result(item: Uncertainty) -> UncertaintyResult:
    """Return the margins, and the directions not run."""
    return UncertaintyResult.of(item, angles=AnglesResult.of(item))
