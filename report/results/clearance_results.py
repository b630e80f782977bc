"""The rows of results.json on clearances, and on the pairs of the plan that need one."""

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
    """Id of the array or object across it."""
    direction: Direction
    """Direction of the clearance from the array; any where none is entered."""
    neighbor: Neighbor
    """Kind of neighbor, which gives the separation factor."""
    governing_array: str
    """Array whose displacement governs."""
    design_m: Number
    """Design displacement of that array."""
    importance: float
    """Importance factor in the required separation."""
    factor: float
    """Separation factor of the rule set, with the importance factor."""
    minimum_m: float
    """Required separation at least, whatever the displacement; 0 for none."""
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
    """OK, NG, or none where the required separation is not known."""


class LowVelocity(ResultModel):
    """Arrays with their low-velocity friction coefficients alone, and clearances beside them."""

    arrays: tuple[LowVelocityResult, ...]
    """Arrays whose friction depends on velocity."""
    clearances: tuple[ClearanceResult, ...]
    """Clearances beside them."""


class GivenResult(ResultModel):
    """A clearance given for a neighbor."""

    clearance: str
    """Number of the clearance."""
    cell: str
    """Cell of the clearance in the workbook."""
    provided_m: float
    """Separation entered there."""


class NeighborResult(ResultModel):
    """What the plan shows near an array, and the clearances that cover or contradict it."""

    array: str
    """Id of the array."""
    other: str
    """Id of the array or object across the gap; words for an edge."""
    kind: NearbyKind
    """What is across the gap."""
    gap_m: float
    """Least distance in plan; negative if they overlap."""
    reach_m: Number
    """Distance within which a clearance is needed."""
    is_missing: bool
    """Whether it is that near and has no clearance."""
    add_to: str
    """Cell to which a missing row is to be added."""
    given: tuple[GivenResult, ...]
    """Clearances between the two."""
    contradictions: tuple[str, ...]
    """Cells of clearances that differ from the distance in plan."""
    cover: Cover
    """Whether the clearances agree with the plan; without any, whether the distance suffices."""
    what: str
    """Kind of the object, in words; for others as `kind`."""
