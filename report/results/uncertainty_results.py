"""The rows of results.json on uncertain inputs and their effect."""

from __future__ import annotations

from collections.abc import Mapping

from report.results.result_base import Number, ResultModel
from solver.model import Status


class MarginResult(ResultModel):
    """The margin of a clearance in friction."""

    clearance: str
    """Number of the clearance."""
    array: str
    """Array whose friction is varied."""
    mu: float
    """Friction coefficient entered."""
    least_mu: Number
    """Lowest friction coefficient at which the clearance is satisfied."""
    lowest_mu_tried: Number
    """Friction coefficient at which the search ends."""
    is_beyond: bool
    """Whether the clearance is satisfied throughout."""
    required_m: Number
    """Required separation at the lowest friction coefficient."""


class TurnedResult(ResultModel):
    """A run with the horizontal components rotated."""

    angle_deg: float
    """Angle of the pair, counterclockwise; at 0 the record acts downslope."""
    prd_m: Number
    """PRD."""
    status: Status
    """Outcome."""


class AnglesResult(ResultModel):
    """Directions of shaking that are not run for the design."""

    motion: str
    """Governing motion."""
    prd_m: Number
    """PRD used for the design."""
    turned: tuple[TurnedResult, ...]
    """Runs with the pair rotated."""
    vertical_reversed_prd_m: Number
    """PRD with the vertical component reversed; null without one."""


class UncertaintyResult(ResultModel):
    """Margins and confidence of the displacements."""

    margins: tuple[MarginResult, ...]
    """Margin of each clearance in friction."""
    angles: AnglesResult
    """Other directions of the same shaking."""


class CumulativeResult(ResultModel):
    """The sums of the PRDs of the design event and of smaller ones, by motion."""

    array: str
    """Id of the array."""
    sums_m: Mapping[str, Number]
    """Sum of the PRDs by motion."""
    mean_m: Number
    """Mean of the sums."""
    largest_m: Number
    """Largest of the sums."""


class VariationResult(ResultModel):
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
    """Analysis displacement."""
