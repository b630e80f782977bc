"""The schema of results.json: a plain model for each kind of row, units in the keys, NaN as null.

The docstring of a field is its description in the schema. Computes nothing: `report.results.rows`
makes the rows. Read `ClearanceResult`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, WithJsonSchema

from report.assessment.checks.check import Actor
from report.assessment.design.arrays import DesignBasis
from report.assessment.design.routes import Route
from report.assessment.design.verdict import ItemVerdict, Verdict
from report.assessment.plan.neighbors import Cover, NearbyKind
from report.assessment.remedies.remedy import RemedyKind
from report.project.model import ProjectInput
from report.project.model.choices import Direction, DistanceBasis, RecordedAt
from report.project.model.finding import Level
from solver.model import Friction, Status
from solver.records.measures import Measures
from solver.rules.limit import Consequence
from solver.rules.provisions import Basis, Neighbor, PrescriptiveBasis

# Raised where a key of results.json changes its name or meaning; 0.1 wrote none.
SCHEMA_VERSION = 3

Number = Annotated[
    float,
    BeforeValidator(lambda value: math.nan if value is None else value),
    WithJsonSchema({"type": ["number", "null"]}),
]
"""A number; NaN is none, which is null in JSON."""


class ResultModel(BaseModel):
    """A row of the results: complete and frozen."""

    model_config = ConfigDict(frozen=True)


class WorkbookResult(ResultModel):
    """The workbook that was assessed."""

    name: str
    """Name of the file."""
    sha256: str
    """SHA-256 of the file."""


class RecordResult(ResultModel):
    """A record as it was read."""

    motion: str
    component: str
    name: str
    format: str
    notes: tuple[str, ...]
    """What was read or assumed beyond the plain numbers."""
    sha256: str
    npts: int
    """Number of samples."""
    dt_s: float
    """Time step."""
    peak_g: float
    """Largest acceleration."""


class DocumentResult(ResultModel):
    """A document that the workbook attaches."""

    label: str
    """Label of its cell."""
    path: str
    """Path from the folder of the workbook."""
    size: int
    """Number of bytes."""
    sha256: str
    """SHA-256 of the file."""


class RoofResult(ResultModel):
    """A component of a ground motion, carried to the roof."""

    words: str
    """The building in words."""
    n_modes: int
    """Number of modes included."""
    next_mode_share: float
    """Contribution of the first neglected mode / peak at the roof."""
    left_out_share: float
    """Contribution of all neglected modes / peak at the roof."""
    ground_peak_mps2: float
    """Peak acceleration at the ground."""
    roof_peak_mps2: float
    """Peak acceleration at the roof."""
    pad_s: float
    """Free vibration after the end of the ground record."""


class LengthUnitResult(ResultModel):
    """A unit of length as it is printed."""

    symbol: str
    size_m: float
    """Its length."""
    decimals: int
    """Decimals that are printed."""


class PrintedResult(ResultModel):
    """How numbers are printed."""

    lengths: tuple[LengthUnitResult, ...]
    """Of displacements and separations, the preferred unit first."""
    ratio_decimals: int
    """Decimals of a ratio."""
    rounded_up: tuple[str, ...]
    """Keys of what is required, and of demands, which are rounded up."""
    rounded_down: tuple[str, ...]
    """Keys of what is provided, which are rounded down; all other keys to the nearest."""


class MotionResult(ResultModel):
    """A motion as it was run."""

    id: str
    recorded_at: RecordedAt
    """Where it was recorded: at the roof, or at the ground."""
    processing: str
    scaling: str
    scale: float
    """Factor on the record."""
    dt_s: float
    """Time step."""
    npts: int
    """Number of samples."""
    sha256: str
    """SHA-256 of its samples as run, without the scale: record, transverse and vertical component
    one after the other, in m/s² as 8-byte numbers, the lowest byte first."""
    components: Mapping[str, Measures]
    """Measures of each component."""
    building: Mapping[str, RoofResult]
    """How each component was carried to the roof; empty for roof motions."""


class FindingResult(ResultModel):
    """A warning or note on the input."""

    level: Level
    """Warning or note."""
    id: str
    """Name by which a warning is acknowledged; empty where none can be."""
    cell: str
    """Cell of the workbook."""
    text: str
    """What was found."""
    reason: str
    """Why a warning is acknowledged; empty if it is not."""


class CheckResult(ResultModel):
    """A check: everything that is required, satisfied or not."""

    id: str
    """Kind of check, such as `max_stories`, `clearance` or `peer_review`."""
    title: str
    """As printed."""
    subject: str
    """Array, motion or clearance, as printed; empty for the project."""
    arrays: tuple[str, ...]
    """Ids of the arrays whose verdict it is part of."""
    found: Number
    """Value found, in the unit; null where it is words, or no value."""
    limit: Number
    """Value required, in the unit; null where it is words."""
    unit: str
    """Unit of both; empty for a count or a ratio."""
    found_text: str
    """As printed, in both systems of units."""
    limit_text: str
    """As printed, with its sign."""
    note: str
    """Where or from what it was found."""
    clause: str
    """Section of the code with its mark, or whose practice it is."""
    is_satisfied: bool
    """Whether the project satisfies it."""
    consequence: Consequence
    """Where it is not satisfied."""
    verdict: ItemVerdict
    """Of this check alone."""
    ratio: Number
    """Demand / capacity; null for words, and where a required number is not entered."""
    actor: Actor
    """Who must act where it is not satisfied."""
    remedy: str
    """What they must do, as a sentence; empty where it is satisfied."""
    otherwise: str
    """What the project comes to if it is not met, as a sentence."""
    cells: tuple[str, ...]
    """Cells of the workbook."""


class Displacements(ResultModel):
    """The displacements of an array: by analysis, prescriptive and design."""

    computed_m: Number
    """Displacement by analysis; null without one."""
    computed_basis: Basis
    """How the displacement by analysis follows from the peaks of the motions."""
    mean_prd_m: Number
    """Mean of the PRDs of the motions."""
    largest_prd_m: Number
    """Largest of the PRDs of the motions."""
    prd_variation: Number
    """Coefficient of variation of the PRDs of the motions; null for one motion."""
    prescriptive_m: float
    """Prescriptive displacement."""
    prescriptive_governs: PrescriptiveBasis
    """What gives the prescriptive displacement: formula, minimum or SDC."""
    floor_m: float
    """Least design displacement after an analysis; 0 where peer review removes it."""
    design_m: Number
    """Design displacement; null where no permitted route gives one."""
    design_is_overridden: bool
    """Whether a number of the rule set behind it is overridden."""
    design_governs: DesignBasis
    """What gives the design displacement."""
    design_permitted: bool
    """Whether the limits permit the route by which it was obtained."""


class _LowVelocityHead(ResultModel):
    id: str
    mu: float
    """Friction coefficient at low velocity."""


# Of several bases the fields of the last come first.
class LowVelocityResult(Displacements, _LowVelocityHead):
    """An array with its low-velocity friction coefficient alone."""


class TippingResult(ResultModel):
    """Tipping of an array, for the run nearest to it."""

    demand: Number
    """Largest shear over normal force without slip; null where the array lifts off, and without
    motions."""
    capacity: float
    """Shear over normal force at which it begins to tip, b / (2 h)."""
    held_ratio: float
    """At rest: lesser of demand and static friction coefficient / capacity."""
    sliding_ratio: float
    """While it slides: kinetic friction coefficient / capacity; 0 without slip."""
    ok: bool
    """Whether the array never begins to tip."""


class UpliftResult(ResultModel):
    """Uplift of an array, for the run with the smallest normal force."""

    n_min_g: Number
    """Least normal force / weight; negative with uplift, null without motions."""
    t_first_s: Number
    """Time when the normal force first falls below zero; null if it never does."""
    duration_s: float
    """Total time with a negative normal force."""
    times: int
    """Number of times that the normal force falls below zero."""


class PeakResult(ResultModel):
    """The largest displacements of an array in all runs of a motion, by direction."""

    motion: str
    down_m: Number
    """Downslope."""
    up_m: Number
    """Upslope."""
    across_m: Number
    """Across the slope."""
    any_m: Number
    """In any direction."""


class RunResult(ResultModel):
    """An array under a motion with one component along the slope, in one polarity."""

    motion: str
    along: str
    """Component along the slope."""
    polarity: int
    """1 as recorded, -1 reversed."""
    scale: float
    """Factor on the record."""
    dt_s: float
    """Time step."""
    status: Status
    """Outcome."""
    prd_m: Number
    """Peak relative displacement in plan; null without a final value."""
    residual_m: Number
    """Displacement at the end, positive downslope."""
    down_m: Number
    """Largest displacement downslope."""
    up_m: Number
    """Largest displacement upslope."""
    across_m: Number
    """Largest displacement across the slope."""
    residual_across_m: Number
    """Displacement at the end, across the slope."""
    t_prd_s: Number
    """Time of the PRD."""
    n_stops: int
    """Number of times that it comes to rest."""
    n_min_g: Number
    """Least normal force / weight."""
    t_uplift_s: Number
    """Time of the first uplift; null without uplift."""
    end_speed_mps: Number
    """Sliding velocity at the end of the record."""
    peak_speed_mps: Number
    """Largest sliding velocity."""
    error_m: Number
    """Bound of the error of the PRD."""
    rung: int
    """Number of the model used, from 0, no slip, to 5, a row of linked blocks."""
    model: str
    """Model used, in words."""
    reason: str
    """Why this model is enough."""
    next_rung: int
    """Number of the next model, run to see its effect; that of this one if none is."""
    next_effect_m: Number
    """Effect of the next model on the PRD."""
    friction_demand: Number
    """Required friction coefficient: largest shear over normal force without slip."""


class _ArrayHead(ResultModel):
    id: str
    verdict: ItemVerdict
    """Verdict on the array, with the clearances beside it."""
    slope_rad: float
    """Roof slope."""
    mu: float
    """Friction coefficient at low velocity."""
    friction: Friction
    """Friction law as entered."""
    friction_as_run: str
    """Friction coefficient in words, as printed."""


class ArrayResult(Displacements, _ArrayHead):
    """An array: what it is, its displacements by motion and run, its limits."""

    peaks: tuple[PeakResult, ...]
    """Largest displacements by motion."""
    peak_speed_mps: Number
    """Largest sliding velocity of all runs."""
    interconnection_n: float
    """Strength required of the connections within the array."""
    tipping: TippingResult
    """Tipping, for the run nearest to it."""
    uplift: UpliftResult
    """Uplift, for the run with the least normal force."""
    analysis_factor: float
    """Factor on the mean or largest PRD in the displacement by analysis."""
    takes_largest: bool
    """Whether it is on the largest PRD, not on the mean."""
    route: Route
    """Route by which the design displacement was obtained."""
    runs: tuple[RunResult, ...]
    """All runs."""


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


class LinkedRunResult(ResultModel):
    """A run as a row of blocks, and as one block."""

    motion: str
    along: str
    """Component along the slope."""
    polarity: int
    """1 as recorded, -1 reversed."""
    status: Status
    """Outcome."""
    rigid_status: Status
    """Outcome as one block."""
    rigid_prd_m: Number
    """PRD as one block."""
    prd_m: tuple[Number, ...]
    """PRD of each block, from the upslope end."""
    residual_m: tuple[Number, ...]
    """Residual displacement of each block, from the upslope end."""
    stretch_m: Number
    """Largest elongation of a link."""
    link_force_n: Number
    """Largest force of a link."""
    error_m: Number
    """Bound of the error of the PRDs."""
    n_stops: int
    """Number of times that a block comes to rest."""


class LinkedResult(ResultModel):
    """An array as a row of linked blocks, beside its design as one rigid block."""

    array: str
    """Id of the array."""
    mus: tuple[float, ...]
    """Friction coefficient of each block, from the upslope end."""
    stiffness_n_per_m: float
    """Stiffness of a link."""
    damping_ratio: float
    """Damping of a link / critical."""
    rigid_one_axis_m: Number
    """Value from analysis as one block, in one axis."""
    linked_one_axis_m: Number
    """Value from analysis as a row, in one axis."""
    ratio: Number
    """Row / one block."""
    design_m: Number
    """Design displacement of the array as one rigid block."""
    estimated_m: Number
    """Design displacement with links, an estimate."""
    link_force_n: Number
    """Largest force of a link in any run."""
    rigid_is_enough: bool
    """Whether one rigid block is adequate."""
    runs: tuple[LinkedRunResult, ...]
    """All runs."""


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


class RemedyResult(ResultModel):
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


class MarginResult(ResultModel):
    """The margin of a clearance in friction."""

    clearance: str
    """Number of the clearance."""
    array: str
    """Array whose friction is varied."""
    mu: float
    """Friction coefficient entered."""
    least_mu: Number
    """Least friction coefficient at which the clearance is satisfied."""
    lowest_mu_tried: Number
    """Friction coefficient at which the search ends."""
    is_beyond: bool
    """Whether the clearance is satisfied throughout."""
    required_m: Number
    """Required separation at the least friction coefficient."""


class TurnedResult(ResultModel):
    """A run with the horizontal components turned."""

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
    """Runs with the pair turned."""
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
    """Value from analysis."""


class Results(ResultModel):
    """An assessment and its evidence: the whole of results.json."""

    schema_version: int
    """Raised where a key changes its name or meaning."""
    roofslip_version: str
    """Version that wrote the file."""
    workbook: WorkbookResult
    """The file that was assessed."""
    records: tuple[RecordResult, ...]
    """Records as read."""
    documents: tuple[DocumentResult, ...] = ()
    """Documents that the workbook attaches."""
    motions: tuple[MotionResult, ...]
    """Motions as run."""
    input: ProjectInput
    """Content of the workbook."""
    s_ds_g: float
    """S_DS used."""
    sdc_is_confirmed: bool
    """Whether the workbook states all that the seismic design category needs."""
    rule_set: str
    """Name of the rule set."""
    printed: PrintedResult
    """How numbers are printed."""
    verdict: Verdict
    """Verdict on the project."""
    warnings: tuple[str, ...]
    """Warnings of the runs, as sentences."""
    findings: tuple[FindingResult, ...]
    """Warnings and notes on the input."""
    checks: tuple[CheckResult, ...] = ()
    """Everything that is required, satisfied or not; version 0.3 wrote none."""
    arrays: tuple[ArrayResult, ...]
    """Arrays in the order of the workbook."""
    clearances: tuple[ClearanceResult, ...]
    """Clearances in the order of the workbook."""
    low_velocity: LowVelocity
    """The same with friction at low velocity alone."""
    linked: tuple[LinkedResult, ...]
    """Arrays as rows of linked blocks."""
    neighbors: tuple[NeighborResult, ...]
    """Pairs in plan that are near or have a clearance."""
    remedies: tuple[RemedyResult, ...]
    """Changes that would satisfy what is NG."""
    certainty: UncertaintyResult | None
    """Margins in friction, slope and direction; null without motions."""
    cumulative: tuple[CumulativeResult, ...]
    """Cumulative displacement; empty where it is not asked for."""
    building_variations: tuple[VariationResult, ...]
    """The governing array with the building as used, which is first, and with others; empty where
    no motion goes through the building."""


class Compared(ResultModel):
    """What a later revision is compared with: keys of `Results`."""

    roofslip_version: str
    records: tuple[RecordResult, ...]
    documents: tuple[DocumentResult, ...] = ()
    input: ProjectInput
    rule_set: str
    verdict: Verdict
    checks: tuple[CheckResult, ...] = ()
    arrays: tuple[ArrayResult, ...]
    clearances: tuple[ClearanceResult, ...]
