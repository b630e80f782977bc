"""Whether one rigid block is enough for an array: held against a row of linked blocks.

Runs both in one axis with the vertical, where a workbook asks for it; computes no physics
(`solver.sliding.row`, `solver.sliding.checked`). Read `LinkedArray` first, then `assess_linked`.
"""

from __future__ import annotations

import math
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

from report.assessment.arrays import ArrayAssessment
from report.assessment.runs import nan_is_worst
from report.sheet.schema import Array, Direction, Links
from solver.model import Heading, Motion, SlideResult, Status
from solver.rules import provisions
from solver.rules.provisions import AnalysisValue, RuleSet
from solver.sliding import least_model, one_axis
from solver.sliding.row import BlockRow, RowResult, slide_row


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedRun:
    """One motion with one horizontal component along the slope: as a row, and as one block.

    Attributes
    ----------
    rigid : SlideResult
        Of one block with the array's own friction coefficient.
    row : RowResult
        Of the blocks, each with its own.
    """

    heading: Heading
    rigid: SlideResult
    row: RowResult

    @property
    def prd_m(self) -> float:
        """PRD of the block that goes farthest [m]; NaN where there is none."""
        return max(self.row.prd_m)

    @property
    def block(self) -> int:
        """Number of the block that goes farthest, from 1, the highest."""
        return self.row.prd_m.index(self.prd_m) + 1

    @property
    def is_final(self) -> bool:
        """Whether both are followed until they rest."""
        return self.row.status is Status.OK and self.rigid.status is Status.OK


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedMotion:
    """All runs of one motion; the largest PRDs are NaN where a run has none [m]."""

    motion: Motion
    runs: tuple[LinkedRun, ...]

    @property
    def rigid_m(self) -> float:
        """Largest PRD of the one block [m]."""
        return max((run.rigid.prd_m for run in self.runs), key=nan_is_worst)

    @property
    def linked_m(self) -> float:
        """Largest PRD of any block of the row [m]."""
        return max((run.prd_m for run in self.runs), key=nan_is_worst)


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkedArray:
    """An array as a row of linked blocks, beside what it is designed for as one rigid block.

    Attributes
    ----------
    links : Links
        As asked for.
    found : ArrayAssessment
        The array as it is designed.
    row : BlockRow
    motions : tuple of LinkedMotion
    rigid, linked : AnalysisValue
        Of the one block and of the blocks that go farthest, by the statistic of the array; both
        in one axis with the vertical.
    """

    links: Links
    found: ArrayAssessment
    row: BlockRow
    motions: tuple[LinkedMotion, ...]
    rigid: AnalysisValue
    linked: AnalysisValue

    @property
    def ratio(self) -> float:
        """Value with links / value of the one block.

        Where that one does not slide: inf, or 1 where the blocks slide by less than any model minds
        (`least_model.Settings.bound_m`).
        """
        rigid, linked = self.rigid.value_m, self.linked.value_m
        if rigid == 0.0 and not math.isnan(linked):
            return math.inf if linked > least_model.DEFAULT.bound_m(rigid) else 1.0
        return linked / rigid if rigid != 0.0 else math.nan

    @property
    def value_m(self) -> float:
        """The value from analysis that links raise [m].

        Where a model is asked for and the one that the motions need gives more, that is it: a floor
        may hide what the model leaves out, and need not hide it together with links.
        """
        return max(self.found.analysis.value_m, self.found.chosen[Direction.ANY].value_m)

    @property
    def estimated_m(self) -> float:
        """Design displacement with links [m], an estimate; NaN without a value.

        The value from analysis grows by the ratio, where that is above 1; not below the floor.
        """
        ratio, design = self.ratio, self.found
        if math.isnan(ratio) or math.isnan(design.design_m):
            return math.nan
        if math.isinf(ratio):  # also where the design uses 0
            return ratio
        return max(max(1.0, ratio) * self.value_m, design.floor_m)

    @property
    def is_rigid_enough(self) -> bool:
        """Whether links ask for no more room than the design has, by runs that are all final."""
        return self.is_final and self.is_within

    @property
    def is_within(self) -> bool:
        """Whether the estimate is above the design by no more than any model minds."""
        design = self.found.design_m
        return self.estimated_m <= design + least_model.DEFAULT.bound_m(design)

    @property
    def is_final(self) -> bool:
        """Whether every run is followed until all of it rests."""
        return all(run.is_final for motion in self.motions for run in motion.runs)

    @property
    def farthest(self) -> LinkedRun:
        """The run in which a block goes farthest; one without a displacement over all."""
        runs = [run for motion in self.motions for run in motion.runs]
        return max(runs, key=lambda run: nan_is_worst(run.prd_m))

    @property
    def rigid_prd_m(self) -> float:
        """Largest PRD of the one block in any run [m]."""
        return max((motion.rigid_m for motion in self.motions), key=nan_is_worst)

    @property
    def block_n(self) -> float:
        """Weight of a block [N]."""
        return self.found.array.weight_n / len(self.row.mus)

    @property
    def link_force_n(self) -> float:
        """Largest force in a link in any run [N]."""
        forces = (run.row.link_force for motion in self.motions for run in motion.runs)
        return self.block_n * max(forces, key=nan_is_worst)


def assess_linked(
    pool: Executor, rules: RuleSet, links: Links, found: ArrayAssessment
) -> LinkedArray:
    """Run an array as a row of linked blocks under all its motions, and as one block beside it."""
    row = links.row(found.array.weight_n)
    motions = tuple(
        pool.map(partial(_run_motion, found.array, row), [run.motion for run in found.motions])
    )
    basis = found.analysis.basis
    return LinkedArray(
        links=links,
        found=found,
        row=row,
        motions=motions,
        rigid=provisions.analysis_value(rules, [one.rigid_m for one in motions], basis),
        linked=provisions.analysis_value(rules, [one.linked_m for one in motions], basis),
    )


def _run_motion(array: Array, row: BlockRow, motion: Motion) -> LinkedMotion:
    runs = tuple(_run(array, row, motion, heading) for heading in motion.headings)
    return LinkedMotion(motion=motion, runs=runs)


def _run(array: Array, row: BlockRow, motion: Motion, heading: Heading) -> LinkedRun:
    scene = motion.scene(heading, slope_rad=array.slope_rad, friction=array.friction)
    return LinkedRun(heading=heading, rigid=one_axis.run(scene), row=slide_row(scene, row))
