"""An array as it is written and shown: its displacements, its runs, its limits.

Computes nothing: see `report.assessment.arrays`. Read `ArrayResult`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, ClassVar

from pydantic import BeforeValidator

from report.assessment.arrays import ArrayAssessment, DesignBasis
from report.assessment.causes import unshown_cause
from report.assessment.envelopes import keep_clear, keep_clear_m, keep_clear_mark
from report.assessment.friction import mu_words
from report.assessment.neighbors import ComparedGap, PlanNeighbor
from report.assessment.project import Assessment, ChangeKind
from report.assessment.routes import SEAOC, Route, prescriptive_of
from report.assessment.verdict import NOT_GIVEN, ItemVerdict
from report.entities.motion import PeakResult, RunResult, peak_result, run_result
from report.entities.requirement import Marked
from report.entities.shown import (
    Column,
    Entity,
    Number,
    Shown,
    Told,
    at,
    centered,
    plain,
    printed,
    provided,
    required,
    unwritten,
    up_column,
    words,
)
from report.text.amounts import capacity, demand, shown_in_order
from report.text.units import Quantity, Show, measured, no_less
from solver.model import Friction
from solver.rules.provisions import Basis, PrescriptiveBasis

# Whether the design displacement follows from the largest peak, in the formulas of a sheet.
TAKES_LARGEST = f'{{design.statistic}}="{Basis.LARGEST_FACTORED.value}"'

_COMPUTED = (
    f'=IF({{statistic}}="{Basis.TOO_FEW.value}","none",{{analysis_factor}}'
    f'*IF({{statistic}}="{Basis.LARGEST_FACTORED.value}",{{largest_prd_m}},{{mean_prd_m}}))'
)
# PV1-2012: 60 in (S_DS - 0.4)^2, at least 6 in; ASCE 7-16 13.6.12: 5 ft I_e (S_DS - 0.4)^2, 24 in.
_PRESCRIPTIVE = "=MAX({factor_m}*{importance}*MAX({s_ds_g}-0.4,0)^2,{minimum_m})"
# In Excel MAX takes no text: without the question, no value would become the floor.
_DESIGN = '=IF(ISTEXT({computed_m}),"none",MAX({computed_m},{floor_m}))'
# PV1-2012 section 6: the larger of 0.133 S_DS W1 and 0.1 W1, with W1 half of the weight.
_STRENGTH = (
    "=MAX({inputs[interconnection_sds]}*{s_ds_g},{inputs[interconnection_min]})*{weight_n}/2"
)


def _weight(head: str, show: Show = measured) -> Shown:
    return Shown(head=head, quantity=Quantity.WEIGHT, show=show)


class Displacements(Entity):
    """The displacements of an array: by analysis, prescriptive and design."""

    computed_m: Annotated[
        Number,
        at("analysis.value_m"),
        required("Analysis"),
        up_column("Computed [in]", 1, _COMPUTED, is_always=True),
        Told(ChangeKind.ANALYSIS, "Array {row.id}", of_new=False),
    ]
    computed_basis: Annotated[Basis, at("analysis.basis")]
    """How the displacement by analysis follows from the peaks of the motions."""
    mean_prd_m: Annotated[
        Number,
        at("analysis.mean_m"),
        required("Mean"),
        up_column("Mean PRD [in]", 1, "=AVERAGE({peaks})"),
        Told(),
    ]
    largest_prd_m: Annotated[
        Number,
        at("analysis.largest_m"),
        required("Largest"),
        up_column("Largest PRD [in]", 1, "=MAX({peaks})"),
        Told(),
    ]
    prd_variation: Annotated[Number, at("variation")]
    """Coefficient of variation of the PRDs of the motions; null for one motion."""
    prescriptive_m: Annotated[
        float,
        at("prescriptive.value_m"),
        required("Prescriptive"),
        up_column("[in]", 1, _PRESCRIPTIVE),
        Told(),
    ]
    prescriptive_governs: Annotated[PrescriptiveBasis, at("prescriptive.governs")]
    """What gives the prescriptive displacement: formula, minimum or SDC."""
    floor_m: Annotated[
        float,
        required("Floor"),
        up_column("[in]", 1, "={floor_share}*{prescriptive_m}"),
        Told(),
    ]
    """Least design displacement after an analysis; 0 where peer review removes it."""
    design_m: Annotated[
        Number,
        required("Design"),
        up_column("[in]", 1, _DESIGN, is_always=True),
        up_column("[mm]", 0),
        Told(ChangeKind.DESIGN, "Array {row.id}"),
    ]
    """Design displacement; null where no permitted route gives one."""
    design_is_overridden: Annotated[bool, at("overridden.design"), BeforeValidator(bool)]
    """Whether a number of the rule set behind it is overridden."""
    design_governs: Annotated[DesignBasis, at("governs")]
    """What gives the design displacement."""
    design_permitted: Annotated[bool, at("is_permitted")]
    """Whether the limits permit the route by which it was obtained."""

    @property
    def is_refused(self) -> bool:
        """Whether there is a design displacement, by a route that is not permitted."""
        return not (math.isnan(self.design_m) or self.design_permitted)

    @unwritten(required("Floor"))
    def floor(self) -> float:
        """The floor [m]; NaN where peer review removes it."""
        return self.floor_m or math.nan

    @unwritten(plain("Analysis / prescr.", share=1.2))
    def computed_ratio(self) -> float:
        """Value from analysis / prescriptive displacement."""
        return self.computed_m / self.prescriptive_m

    @unwritten(plain("Design / prescr.", share=1.2))
    def design_ratio(self) -> float:
        """Design displacement / prescriptive displacement."""
        return self.design_m / self.prescriptive_m


class LowVelocityResult(Displacements):
    """An array with its low-velocity friction coefficient alone."""

    first: ClassVar[tuple[str, ...]] = ("id", "mu")

    id: Annotated[str, words("Array", 1.1), Column()]
    mu: Annotated[float, at("array.mu")]
    """Friction coefficient at low velocity."""


class TippingResult(Entity):
    """Tipping of an array, for the run nearest to it."""

    demand: Number
    """Largest shear over normal force without slip; null where the array lifts off, and without
    motions."""
    capacity: float
    """Shear over normal force at which it begins to tip, b / (2 h)."""
    held_ratio: Annotated[float, at("at_rest_ratio")]
    """At rest: lesser of demand and static friction coefficient / capacity."""
    sliding_ratio: float
    """While it slides: kinetic friction coefficient / capacity; 0 without slip."""
    ok: Annotated[bool, at("is_ok")]
    """Whether the array never begins to tip."""


class UpliftResult(Entity):
    """Uplift of an array, for the run with the smallest normal force."""

    n_min_g: Number
    """Least normal force / weight; negative with uplift, null without motions."""
    t_first_s: Number
    """Time when the normal force first falls below zero; null if it never does."""
    duration_s: float
    """Total time with a negative normal force."""
    times: int
    """Number of times that the normal force falls below zero."""


class ArrayRow(LowVelocityResult):
    """An array in a short table: its displacements, what governs them, its verdict."""

    verdict: Annotated[
        ItemVerdict,
        centered("Verdict", 1.65),
        Column(),
        Told(ChangeKind.VERDICT, "Array {row.id}", of_gone=True),
    ]
    """Verdict on the array, with the clearances beside it."""
    source: Annotated[str, words("Governs", 1.55)] = printed("")


class ArrayResult(ArrayRow):
    """An array: what it is, its displacements by motion and run, its limits."""

    first: ClassVar[tuple[str, ...]] = (
        "id",
        "verdict",
        "slope_rad",
        "mu",
        "friction",
        "friction_as_run",
    )

    slope_rad: Annotated[float, at("array.slope_rad")]
    """Roof slope."""
    friction: Annotated[Friction, at("array.friction")]
    """Friction law as entered."""
    friction_as_run: Annotated[str, Shown(head="μ")]
    """Friction coefficient in words, as printed."""
    peaks: tuple[PeakResult, ...]
    """Largest displacements by motion."""
    peak_speed_mps: Annotated[Number, at("fastest_mps")]
    """Largest sliding velocity of all runs."""
    interconnection_n: Annotated[
        float,
        _weight("Required", no_less),
        up_column("Interconnection required [lb]", 0, _STRENGTH),
    ]
    """Strength required of the connections within the array."""
    tipping: TippingResult
    """Tipping, for the run nearest to it."""
    uplift: UpliftResult
    """Uplift, for the run with the least normal force."""
    route: Route
    """Route by which the design displacement was obtained."""
    runs: tuple[RunResult, ...]
    """All runs."""
    governing_gap: Annotated[str, words("Clearance to", 1.4)] = printed("none given")
    largest_dc: Annotated[str, Shown(head="D/C", share=0.8)] = printed("—")
    gap_required_m: Annotated[Number, required("Required", 0.8)] = printed(math.nan)
    gap_provided_m: Annotated[Number, provided("Provided", 0.8)] = printed(math.nan)
    keep_clear: Annotated[str, Shown(head="Keep clear", share=0.9)] = printed("")
    weight_n: Annotated[
        float, at("array.weight_n"), _weight("Weight W"), Column("Weight [lb]", is_input=True)
    ] = printed(math.nan)
    given_n: Annotated[
        float | None,
        at("array.interconnection_n"),
        Column("Interconnection provided [lb]", is_input=True),
    ] = printed(None)
    seaoc_m: Annotated[float, required("PV1")] = printed(math.nan)
    model: Annotated[str, Shown(head="Model", share=0.7)] = printed("")
    residual_m: Annotated[float, required("Residual", 0.9)] = printed(math.nan)

    cause: str = printed("")
    """Of a verdict that the D/C beside it does not show."""

    @unwritten(plain("Slope", 2, "deg", 0.8))
    def slope_deg(self) -> float:
        """Roof slope [deg]."""
        return math.degrees(self.slope_rad)

    @unwritten(required("Design displ.", 0.9))
    def permitted_m(self) -> float:
        """The design displacement [m]; NaN where none is permitted."""
        return self.design_m if self.design_permitted else math.nan


def array_result(
    assessment: Assessment,
    item: ArrayAssessment,
    *,
    has_runs: bool = True,
    **marks: str,
) -> ArrayResult:
    """Return an array with its limits, and with its runs if asked for, marked."""
    motions = item.motions if has_runs else ()
    strength = math.nan if item.array.interconnection_n is None else item.array.interconnection_n
    shows = shown_in_order(capacity(strength), demand(item.interconnection_n))
    rounds = {"interconnection_n": shows[1]}
    gap = assessment.governing_gap(item.id)
    # Without a clearance the defaults hold: none given, and a dash for D/C.
    near: dict[str, object] = {}
    distance = keep_clear(keep_clear_m(assessment, item), assessment.project.us_first)
    marks["permitted_m"] = marks.get("design_m", "")
    if gap:
        near = {
            "governing_gap": gap_name(gap, item.id),
            "largest_dc": gap.ratio_words,
            "gap_required_m": gap.required_m,
            "gap_provided_m": gap.provided_m,
        }
        shows = shown_in_order(capacity(gap.provided_m), demand(gap.required_m))
        rounds |= zip(("gap_provided_m", "gap_required_m"), shows, strict=True)
        marks["gap_required_m"] = gap.mark
    return ArrayResult.of(
        item,
        **near,
        cause=unshown_cause(assessment, item),
        marks=marks,
        keep_clear=distance + keep_clear_mark(assessment, item),
        rounds=rounds,
        verdict=assessment.array_verdict(item),
        friction_as_run=mu_words(item.array.friction),
        model=models_used(item),
        seaoc_m=prescriptive_of(assessment.project, SEAOC).value_m,
        peaks=tuple(map(peak_result, motions)),
        runs=tuple(run_result(motion, run) for motion in motions for run in motion.runs),
    )


def models_used(item: ArrayAssessment) -> str:
    """Return the numbers of the models that the runs of an array use; nothing without runs."""
    models = sorted({int(run.solution.model) for run in item.runs})
    return " to ".join(map(str, dict.fromkeys((*models[:1], *models[-1:]))))


def gap_name(gap: ComparedGap, array_id: str) -> str:
    """Return what is across a gap from an array, and where no clearance is given that."""
    name = gap.across_from(array_id)
    return f"{name} ({NOT_GIVEN})" if isinstance(gap, PlanNeighbor) else name


def array_results(marked: Marked) -> Iterator[ArrayResult]:
    """Yield the arrays without their runs, with the marks of their numbers, and an NG's cause."""
    for item in marked.assessment.arrays:
        cause = unshown_cause(marked.assessment, item)
        is_said = cause and not marked.assessment.array_verdict(item).is_permitted
        yield array_result(
            marked.assessment,
            item,
            has_runs=False,
            interconnection_n=marked.mark("interconnection_sds"),
            prescriptive_m=marked.prescriptive_mark(item),
            computed_m=item.overridden.analysis,
            floor=marked.floor_mark(item),
            design_m=marked.design_mark(item),
            verdict=f" {cause}" if is_said else "",
            seaoc_m=marked.mark_of_seaoc,
        )


def short_rows(marked: Marked) -> Iterator[ArrayRow]:
    """Yield the arrays as rows of a short table, with the marks of their numbers."""
    for item in marked.assessment.arrays:
        marks = {
            "prescriptive_m": marked.prescriptive_mark(item),
            "design_m": marked.design_mark(item),
        }
        yield ArrayRow.of(item, verdict=marked.assessment.array_verdict(item), marks=marks)
