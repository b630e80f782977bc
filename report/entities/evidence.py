"""The evidence as it is written and shown: neighbors, remedies, margins, directions, sums.

Computes nothing: see `report.assessment.evidence`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator

from report.assessment.neighbors import NearbyKind
from report.assessment.remedies import Remedy, RemedyKind
from report.assessment.uncertainty import Uncertainty
from report.entities.shown import Entity, Number, OfUnit, RangeOfUnit, at
from solver.model import Status

_UNITS = {RemedyKind.FRICTION: "", RemedyKind.SEPARATION: "_m", RemedyKind.S_DS: "_g"}


def _cells(rows: Any) -> tuple[str, ...]:
    return tuple(getattr(row, "cell", row) for row in rows)


class RemedyResult(Entity):
    """A change that would satisfy a clearance or an array, under the keys of its unit."""

    quantity: RemedyKind
    clearance: str | None
    array: str
    exists: bool
    given: OfUnit
    given_m: OfUnit
    given_g: OfUnit
    value: OfUnit
    value_m: OfUnit
    value_g: OfUnit
    resolution: OfUnit
    resolution_m: OfUnit
    resolution_g: OfUnit
    verified: RangeOfUnit
    verified_m: RangeOfUnit
    verified_g: RangeOfUnit
    n_values: int
    basis: str


class GivenResult(Entity):
    """A clearance given for a neighbor."""

    cell: str
    provided_m: Annotated[float, at("clearance.provided_m")]


class NeighborResult(Entity):
    """What the plan shows near an array, and the clearances that contradict it."""

    array: str
    other: str
    kind: NearbyKind
    gap_m: float
    reach_m: Number
    is_missing: bool
    add_to: Annotated[str, at("to_add")]
    given: tuple[GivenResult, ...]
    contradictions: Annotated[tuple[str, ...], BeforeValidator(_cells)]


class SurfaceResult(Entity):
    """The mean PRD of an array over friction and slope."""

    array: Annotated[str, at("array.id")]
    mus: tuple[float, ...]
    slopes_rad: tuple[float, ...]
    mean_prd_m: tuple[tuple[Number, ...], ...]
    n_unfinished: int
    n_runs: int


class MarginResult(Entity):
    """The margin of a clearance in friction."""

    clearance: Annotated[str, at("number"), BeforeValidator(str)]
    array: Annotated[str, at("array.id")]
    mu: Annotated[float, at("array.array.mu")]
    least_mu: Annotated[Number, at("minimum_mu")]
    lowest_mu_tried: Annotated[Number, at("lowest_tried")]
    is_beyond: bool
    required_m: Number


class TurnedResult(Entity):
    """A run with the horizontal components turned."""

    angle_deg: float
    prd_m: Annotated[Number, at("result.prd_m")]
    status: Annotated[Status, at("result.status")]


class AnglesResult(Entity):
    """Directions of shaking that are not run for the design."""

    motion: Annotated[str, at("motion.motion.id")]
    prd_m: Annotated[Number, at("motion.governing.result.prd_m")]
    turned: tuple[TurnedResult, ...]
    vertical_reversed_prd_m: Annotated[Number, at("reversed_m")]


class UncertaintyResult(Entity):
    """How sure the displacements are."""

    surface: SurfaceResult
    margins: tuple[MarginResult, ...]
    angles: AnglesResult


class CumulativeResult(Entity):
    """The sums of the PRDs of the design event and of smaller ones, by motion."""

    array: Annotated[str, at("array.id")]
    sums_m: Mapping[str, Number]
    mean_m: Number
    largest_m: Number


def remedy_result(item: Remedy) -> RemedyResult:
    """Return a remedy."""
    names = ("given", "value", "resolution", "verified")
    return RemedyResult(
        quantity=item.kind,
        clearance=f"{item.clearance}" if item.clearance else None,
        array=item.array,
        exists=item.exists,
        **{f"{name}{_UNITS[item.kind]}": getattr(item, name) for name in names},
        n_values=item.n_values,
        basis=item.basis,
    )


def uncertainty_result(item: Uncertainty) -> UncertaintyResult:
    """Return the grid over friction and slope, the margins, and the directions not run."""
    surface = item.surface
    return UncertaintyResult.of(
        item,
        surface=SurfaceResult.of(
            surface,
            mus=surface.mus.tolist(),
            slopes_rad=surface.slopes_rad.tolist(),
            mean_prd_m=surface.mean_m.tolist(),
        ),
        angles=AnglesResult.of(item),
    )
