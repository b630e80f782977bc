"""Adequacy of one rigid block for an array: comparison with a row of linked blocks.

Where one block slides 0.50 m and a block of the row 0.55 m, a value from analysis of 0.60 m is
estimated as 1.1 x 0.60 = 0.66 m with links.

Runs both in one axis with the vertical, where a workbook requests it; computes no physics
(`solver.sliding.row`, `solver.sliding.checked`). Read `LinkedArray` first, then `assess_linked`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from itertools import chain

from report.assessment.design.arrays import ArrayAssessment
from report.project.model.array import Array, Links
from report.runs import Runs
from report.text.units import nan_is_worst
from solver.model import Motion, Orientation, SlideResult, Status
from solver.rules import provisions
from solver.rules.provisions import AnalysisValue
from solver.rules.rulesets import RuleSet
from solver.sliding import model_selection, one_axis
from solver.sliding.row import BlockRow, RowResult, slide_row


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedRun:
    """One motion with one horizontal component along the slope: as a row, and as one block."""

    orientation: Orientation
    rigid: SlideResult  # one block with the friction coefficient of the array
    row: RowResult  # the linked blocks, each with its own coefficient

    @property
    def prd_m(self) -> float:
        """Largest PRD of the blocks [m]; NaN where there is none."""
        return max(self.row.prd_m)

    @property
    def block(self) -> int:
        """Number of the block with the largest PRD, from 1 at the upslope end."""
        return self.row.prd_m.index(self.prd_m) + 1

    @property
    def is_final(self) -> bool:
        """Whether both come to rest."""
        return self.row.status is Status.OK and self.rigid.status is Status.OK


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedMotion:
    """All runs of one motion; the largest PRDs are NaN if any run has none [m]."""

    motion: Motion
    runs: tuple[LinkedRun, ...]

    @property
    def rigid_m(self) -> float:
        """Largest PRD of the single block [m]."""
        return max((run.rigid.prd_m for run in self.runs), key=nan_is_worst)

    @property
    def linked_m(self) -> float:
        """Largest PRD of any block of the row [m]."""
        return max((run.prd_m for run in self.runs), key=nan_is_worst)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedArray:
    """An array as a row of linked blocks, with its design as one rigid block."""

    links: Links  # as entered in the workbook
    design: ArrayAssessment  # the array as designed
    row: BlockRow
    motions: tuple[LinkedMotion, ...]
    # of the single block and of the blocks with the largest PRD, by the statistic of the array;
    # both in one axis with the vertical
    rigid: AnalysisValue
    linked: AnalysisValue

    @property
    def runs(self) -> tuple[LinkedRun, ...]:
        """Every run under every motion."""
        return tuple(chain.from_iterable(motion.runs for motion in self.motions))

    @property
    def stretch_m(self) -> float:
        """Largest elongation of a link in any run [m]; NaN where a run has none."""
        return max((run.row.stretch_m for run in self.runs), key=nan_is_worst)

    @property
    def ratio(self) -> float:
        """Value with links / value of the single block; inf where that one alone does not slide."""
        rigid, linked = self.rigid.value_m, self.linked.value_m
        # Less than the tolerance that matters to the choice of model is no sliding of the blocks.
        if rigid == 0.0 and not math.isnan(linked):
            return math.inf if linked > model_selection.DEFAULT.bound_m(rigid) else 1.0
        return linked / rigid if rigid != 0.0 else math.nan

    @property
    def estimated_m(self) -> float:
        """Design displacement with links [m], an estimate; NaN without a value."""
        ratio, design = self.ratio, self.design
        if math.isnan(ratio) or math.isnan(design.design_m):
            return math.nan
        if math.isinf(ratio):  # also where the design uses 0
            return ratio
        # Links never reduce the value: both runs of the comparison are in one axis, and the design
        # may be in two.
        return max(max(1.0, ratio) * design.analysis.value_m, design.floor_m)

    @property
    def is_rigid_enough(self) -> bool:
        """Whether links require no larger displacement than a permitted design, all runs final."""
        return self.is_final and self.is_within and self.design.is_permitted

    @property
    def most_m(self) -> float:
        """Design displacement with the model tolerance [m], which the estimate may reach."""
        design_m = self.design.design_m
        return design_m + model_selection.DEFAULT.bound_m(design_m)

    @property
    def is_within(self) -> bool:
        """Whether the estimate exceeds the design by no more than the model tolerance."""
        return self.estimated_m <= self.most_m

    @property
    def is_final(self) -> bool:
        """Whether every block comes to rest in every run."""
        return all(run.is_final for run in self.runs)

    @property
    def farthest(self) -> LinkedRun:
        """The run with the largest PRD of a block, or one without a displacement."""
        return max(self.runs, key=lambda run: nan_is_worst(run.prd_m))

    @property
    def rigid_prd_m(self) -> float:
        """Largest PRD of the single block in any run [m]."""
        return max((motion.rigid_m for motion in self.motions), key=nan_is_worst)

    @property
    def block_n(self) -> float:
        """Weight of a block [N]."""
        return self.design.array.weight_n / len(self.row.mus)

    @property
    def link_force_n(self) -> float:
        """Largest force in a link in any run [N]."""
        return self.block_n * max((run.row.link_force for run in self.runs), key=nan_is_worst)


def assess_linked(runs: Runs, rules: RuleSet, links: Links, design: ArrayAssessment) -> LinkedArray:
    """Run an array under all its motions as a row of linked blocks and as one rigid block."""
    row = links.row(design.array.weight_n)
    run = partial(_run_motion, design.array, row)
    motions = tuple(runs.map(run, [run.motion for run in design.motions]))
    basis = design.analysis.basis
    return LinkedArray(
        links=links,
        design=design,
        row=row,
        motions=motions,
        rigid=provisions.analysis_value(rules, [motion.rigid_m for motion in motions], basis),
        linked=provisions.analysis_value(rules, [motion.linked_m for motion in motions], basis),
    )


def _run_motion(array: Array, row: BlockRow, motion: Motion) -> LinkedMotion:
    runs = []
    for orientation in motion.orientations:
        scene = motion.scene(orientation, slope_rad=array.slope_rad, friction=array.friction)
        rigid, linked = one_axis.run(scene), slide_row(scene, row)
        runs.append(LinkedRun(orientation=orientation, rigid=rigid, row=linked))
    return LinkedMotion(motion=motion, runs=tuple(runs))
