"""One array under all motions, held against the rule set: what it is designed for.

Computes no physics (`report.assessment.runs`) and reads no code rule itself
(`solver.rules.provisions`). Read `report.assessment.project` next.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from report.assessment.runs import RUNGS, MotionRun, nan_is_worst
from report.sheet.schema import Array, Direction, ProjectInput, Statistic
from solver.rules import provisions
from solver.rules.provisions import AnalysisValue, Basis, Check, Prescriptive, RuleSet
from solver.sliding import least_model
from solver.sliding.tipping import Supports, Tipping, tipping
from solver.sliding.uplift import Uplift, uplift

_BASES = {
    Statistic.RULE_SET: None,
    Statistic.MEAN_1_1: Basis.MEAN_FACTORED,
    Statistic.LARGEST_1_1: Basis.LARGEST_FACTORED,
    Statistic.MEAN: Basis.MEAN,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrayAssessment:
    """One array: its runs, the value from analysis, the prescriptive value, the design value.

    Attributes
    ----------
    floor_m : float
        Least design displacement without peer review [m]; 0 with it.
    design_m : float
        Design displacement [m]: the larger of the value from analysis and the floor. NaN where
        there is no value from analysis.
    directions : mapping
        The value from analysis of the excursions in each direction; `analysis` is that of any.
    chosen : mapping
        The same by the models that the scenes need; differs where a model is asked for.
    needed : tuple of MotionRun
        The runs behind it, in the order of `motions`.
    tipping, uplift : Tipping, Uplift
        Of the run that comes nearest to tipping, and of the one with the least normal force.
    checks : tuple of Check
        Limits that the array must keep for the analysis route.
    prescriptive_checks : tuple of Check
        Limits that it would have to keep to use the prescriptive value instead.
    """

    array: Array
    motions: tuple[MotionRun, ...]
    analysis: AnalysisValue
    directions: Mapping[Direction, AnalysisValue]
    chosen: Mapping[Direction, AnalysisValue]
    needed: tuple[MotionRun, ...]
    prescriptive: Prescriptive
    floor_m: float
    design_m: float
    tipping: Tipping
    uplift: Uplift
    checks: tuple[Check, ...]
    prescriptive_checks: tuple[Check, ...]
    interconnection_n: float

    @property
    def governs(self) -> str:
        """What the design displacement comes from."""
        if math.isnan(self.design_m):
            return "no value"
        return "floor" if self.floor_m > self.analysis.value_m else "analysis"

    def design_towards_m(self, direction: Direction) -> float:
        """Return the design displacement in a direction [m]: not below the floor either."""
        return self._floored(self.directions[direction])

    def chosen_towards_m(self, direction: Direction) -> float:
        """Return the same by the models that the scenes need [m]."""
        return self._floored(self.chosen[direction])

    def _floored(self, found: AnalysisValue) -> float:
        return math.nan if math.isnan(found.value_m) else max(found.value_m, self.floor_m)

    @property
    def is_model_asked_for(self) -> bool:
        """Whether the workbook asks for a model."""
        return self.array.model in RUNGS

    @property
    def is_model_enough(self) -> bool:
        """Whether the models that the scenes need would not ask for more room, any way."""
        pairs = ((self.chosen_towards_m(d), self.design_towards_m(d)) for d in Direction)
        return all(math.isnan(b) or a <= b + least_model.DEFAULT.bound_m(b) for a, b in pairs)

    @property
    def ratio(self) -> float:
        """Design displacement / prescriptive displacement."""
        return self.design_m / self.prescriptive.value_m

    @property
    def variation(self) -> float:
        """Standard deviation of the motions' PRDs over their mean; NaN for one motion."""
        peaks = [run.governing.result.prd_m for run in self.motions]
        mean = self.analysis.mean_m
        if len(peaks) < 2 or not mean > 0.0:
            return math.nan
        return math.sqrt(sum((p - mean) ** 2 for p in peaks) / (len(peaks) - 1)) / mean

    @property
    def worst(self) -> MotionRun:
        """The motion with the largest PRD."""
        return max(self.motions, key=lambda run: nan_is_worst(run.governing.result.prd_m))


def same_id(one: str, other: str) -> bool:
    """Whether two ids name the same thing; capitals do not tell things apart."""
    return one.casefold() == other.casefold()


def by_id(arrays: Sequence[ArrayAssessment], wanted: str) -> ArrayAssessment:
    """Return the array of an id."""
    return next(item for item in arrays if same_id(item.array.id, wanted))


def assess_array(
    data: ProjectInput,
    rules: RuleSet,
    array: Array,
    runs: tuple[MotionRun, ...],
    needed: tuple[MotionRun, ...],
) -> ArrayAssessment:
    """Return an array held against the rule set.

    Parameters
    ----------
    runs : tuple of MotionRun
        Of its own model, one for each motion.
    needed : tuple of MotionRun
        By the models that its scenes need; `runs` itself where no model is asked for.
    """
    site = data.site
    prescriptive = provisions.prescriptive_displacement(
        rules, s_ds_g=site.s_ds, sdc=site.sdc, importance=site.i_e
    )
    basis = _BASES[data.options.statistic]
    directions = _towards(rules, runs, basis)
    analysis = directions[Direction.ANY]
    floor = 0.0 if data.options.peer_reviewed else rules["analysis_floor"] * prescriptive.value_m
    no_value = math.isnan(analysis.value_m)
    scenes = [run.scene for motion in runs for run in motion.runs]
    supports = Supports(height_m=array.cg_height_m, spacing_m=array.support_spacing_m)
    return ArrayAssessment(
        array=array,
        motions=runs,
        analysis=analysis,
        directions=directions,
        chosen=directions if needed is runs else _towards(rules, needed, basis),
        needed=needed,
        prescriptive=prescriptive,
        floor_m=floor,
        design_m=math.nan if no_value else max(analysis.value_m, floor),
        tipping=max(
            (tipping(scene, supports) for scene in scenes), key=lambda t: (t.ratio, t.demand)
        ),
        uplift=min(map(uplift, scenes), key=lambda u: u.n_min_g),
        checks=(
            *provisions.array_checks(
                rules,
                cg_height_m=array.cg_height_m,
                support_spacing_m=array.support_spacing_m,
            ),
            *provisions.analysis_checks(rules, slope_rad=array.slope_rad, n_motions=len(runs)),
        ),
        prescriptive_checks=provisions.prescriptive_checks(
            rules, slope_rad=array.slope_rad, mu=array.least_mu
        ),
        # The lighter side of a section is at most half of the array.
        interconnection_n=provisions.interconnection_strength_n(
            rules, s_ds_g=site.s_ds, w1_n=array.weight_n / 2.0
        ),
    )


def _towards(
    rules: RuleSet, runs: Sequence[MotionRun], basis: Basis | None
) -> Mapping[Direction, AnalysisValue]:
    return {
        direction: provisions.analysis_value(rules, [run.peak_m(direction) for run in runs], basis)
        for direction in Direction
    }
