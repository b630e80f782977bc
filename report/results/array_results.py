"""The rows of results.json on an array: its displacements, and the runs behind them."""

from __future__ import annotations

from report.assessment.design.arrays import DesignBasis
from report.assessment.design.routes import Route
from report.assessment.design.verdict import ItemVerdict
from report.results.result_base import Number, ResultModel, Words
from solver.model import Friction, Status
from solver.rules.provisions import Basis, PrescriptiveBasis


class Displacements(ResultModel):
    """The displacements of an array: by analysis, prescriptive and design."""

    computed_m: Number
    """Analysis displacement; null without one."""
    computed_basis: Basis
    """Statistic of the peaks of the motions used for the analysis displacement."""
    mean_prd_m: Number
    """Mean of the PRDs of the motions."""
    largest_prd_m: Number
    """Largest of the PRDs of the motions."""
    prd_variation: Number
    """Coefficient of variation of the PRDs of the motions; null for one motion."""
    prescriptive_m: float
    """Prescriptive displacement."""
    prescriptive_governs: PrescriptiveBasis
    """Basis of the prescriptive displacement: formula, minimum or SDC."""
    floor_m: float
    """Smallest design displacement from an analysis; 0 if peer review removes this floor."""
    design_m: Number
    """Design displacement; null if no permitted procedure gives one."""
    design_is_overridden: bool
    """Whether a number of the rule set behind it is overridden."""
    design_governs: DesignBasis
    """Basis of the design displacement."""
    design_permitted: bool
    """Whether the limits permit the procedure used."""


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
    """Largest shear / normal force with no slip; null with uplift, and without motions."""
    capacity: float
    """Shear / normal force at which the array begins to tip, b / (2 h)."""
    held_ratio: float
    """At rest: smaller of demand and static friction coefficient / capacity."""
    sliding_ratio: float
    """While it slides: kinetic friction coefficient / capacity; 0 without slip."""
    ok: bool
    """Whether the array never begins to tip."""


class UpliftResult(ResultModel):
    """Uplift of an array, for the run with the smallest normal force."""

    n_min_g: Number
    """Smallest normal force / weight; negative with uplift, null without motions."""
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
    """Cross-slope."""
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
    """Largest cross-slope displacement."""
    residual_across_m: Number
    """Cross-slope displacement at the end."""
    t_prd_s: Number
    """Time of the PRD."""
    n_stops: int
    """Number of times the array comes to rest."""
    n_min_g: Number
    """Smallest normal force / weight."""
    t_uplift_s: Number
    """Time of the first uplift; null without uplift."""
    end_speed_mps: Number
    """Sliding velocity at the end of the record."""
    peak_speed_mps: Number
    """Largest sliding velocity."""
    error_m: Number
    """Error bound of the PRD."""
    rung: int
    """Number of the model used, from 0, no slip, to 5, a row of linked blocks."""
    model: str
    """Model used, as text."""
    reason: Words
    """Reason why this model is adequate."""
    next_rung: int
    """Number of the more complete model, run to find its effect; of this one if there is none."""
    next_effect_m: Number
    """Effect of the more complete model on the PRD."""
    friction_demand: Number
    """Required friction coefficient: largest shear / normal force with no slip."""


class _ArrayHead(ResultModel):
    id: str
    verdict: ItemVerdict
    """Verdict on the array, including its clearances."""
    slope_rad: float
    """Roof slope."""
    mu: float
    """Friction coefficient at low velocity."""
    friction: Friction
    """Friction law as entered."""
    friction_as_run: Words
    """Friction coefficient as printed."""


class ArrayResult(Displacements, _ArrayHead):
    """An array: properties, displacements by motion and run, limits."""

    peaks: tuple[PeakResult, ...]
    """Largest displacements by motion."""
    peak_speed_mps: Number
    """Largest sliding velocity of all runs."""
    interconnection_n: float
    """Strength required of the connections within the array."""
    tipping: TippingResult
    """Tipping, for the run closest to it."""
    uplift: UpliftResult
    """Uplift, for the run with the smallest normal force."""
    analysis_factor: float
    """Factor on the mean or largest PRD in the analysis displacement."""
    takes_largest: bool
    """Whether the factor applies to the largest PRD instead of the mean."""
    route: Route
    """Procedure used for the design displacement."""
    runs: tuple[RunResult, ...]
    """All runs."""


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
    """Error bound of the PRDs."""
    n_stops: int
    """Number of times a block comes to rest."""


class LinkedResult(ResultModel):
    """An array as a row of linked blocks, compared with its design as one rigid block."""

    array: str
    """Id of the array."""
    mus: tuple[float, ...]
    """Friction coefficient of each block, from the upslope end."""
    stiffness_n_per_m: float
    """Stiffness of a link."""
    damping_ratio: float
    """Damping of a link / critical."""
    rigid_one_axis_m: Number
    """Analysis displacement as one block, in one axis."""
    linked_one_axis_m: Number
    """Analysis displacement as a row, in one axis."""
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
