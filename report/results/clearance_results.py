"""The rows of results.json on clearances, and on pairs on the plan that require one."""

from __future__ import annotations

from report.assessment.design.verdict import Verdict
from report.assessment.plan.neighbors import Cover, NearbyKind
from report.project.model.choices import Direction, DistanceBasis
from report.results.array_results import LowVelocityResult
from report.results.result_base import Number, ResultModel
from solver.rules.provisions import Neighbor


class ClearanceResult(ResultModel):
    """A clearance: required and provided separation."""

    array: str
    """Id of the array."""
    object: str
    """Id of the array or object on the other side."""
    direction: Direction
    """Direction of the clearance from the array; any if none is entered."""
    neighbor: Neighbor
    """Type of the adjacent item, which determines the separation factor."""
    governing_array: str
    """Array whose displacement governs."""
    design_m: Number
    """Design displacement of that array."""
    importance: float
    """Importance factor in the required separation."""
    factor: float
    """Separation factor of the rule set, with the importance factor."""
    minimum_m: float
    """Minimum of the required separation for any displacement; 0 if there is none."""
    required_m: Number
    """Required separation."""
    required_is_overridden: bool
    """Whether a number of the rule set behind it is overridden."""
    provided_m: float
    """Provided separation."""
    basis: DistanceBasis = DistanceBasis.ENTERED
    """Basis of the separation entered."""
    demand_capacity: Number
    """Required / provided separation."""
    verdict: Verdict
    """OK, NG, or none if the required separation is unknown."""


class LowVelocity(ResultModel):
    """Arrays with their low-velocity friction coefficients only, and their clearances."""

    arrays: tuple[LowVelocityResult, ...]
    """Arrays whose friction depends on velocity."""
    clearances: tuple[ClearanceResult, ...]
    """Clearances of these arrays."""


class GivenResult(ResultModel):
    """A clearance entered for an adjacent item."""

    clearance: str
    """Number of the clearance."""
    cell: str
    """Cell of the clearance in the workbook."""
    provided_m: float
    """Separation entered there."""


class NeighborResult(ResultModel):
    """An item on the plan near an array, and the clearances that cover or contradict it."""

    array: str
    """Id of the array."""
    other: str
    """Id of the array or object on the other side; text for an edge."""
    kind: NearbyKind
    """Type of item on the other side."""
    gap_m: float
    """Smallest distance in plan; negative if they overlap."""
    reach_m: Number
    """Distance within which a clearance is required."""
    is_missing: bool
    """Whether it is within this distance and has no clearance."""
    add_to: str
    """Cell for a missing row."""
    given: tuple[GivenResult, ...]
    """Clearances between the two."""
    contradictions: tuple[str, ...]
    """Cells of clearances that differ from the distance in plan."""
    cover: Cover
    """Whether the clearances agree with the plan; without any, whether the distance suffices."""
    what: str
    """Type of the object as text; for other items same as `kind`."""
