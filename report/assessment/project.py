"""Runs every array under every motion and checks the result against the rule set.

Orders the work and collects the results; computes no physics (`solver.sliding.checked`) and reads
no code rule itself (`solver.rules.provisions`). Read `report.assessment.arrays`,
`report.assessment.clearances`, `report.assessment.links` first.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

from report.assessment.arrays import ArrayAssessment, assess_array, by_id
from report.assessment.clearances import ClearanceCheck, check_clearance
from report.assessment.links import LinkedArray, assess_linked
from report.assessment.runs import MotionRun, nan_is_worst, run_motion
from report.motions.prepare import Shaking
from report.motions.targets import Targets, ac156, targets
from report.sheet.read import Sheet
from report.sheet.schema import Array, Model, ProjectInput
from solver.model import Motion, SlideResult, Status
from solver.rules import provisions
from solver.rules.provisions import Check, RuleSet
from solver.rules.spectra import RequiredSpectrum

THREADS = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Assessment:
    """Everything that was computed for a project.

    Attributes
    ----------
    sheet : Sheet
    shaking : Shaking
    project : ProjectInput
        As assessed: that of the sheet, except for runs with changed friction.
    horizontal_target, vertical_target : RequiredSpectrum
        AC156 at the roof.
    targets : Targets
        Target spectra of the motions: AC156 or project-specific.
    linked : tuple of LinkedArray
        The arrays for which the workbook requests a check of the rigid-block model.
    """

    sheet: Sheet
    shaking: Shaking
    project: ProjectInput
    rules: RuleSet
    horizontal_target: RequiredSpectrum
    vertical_target: RequiredSpectrum
    targets: Targets
    building_checks: tuple[Check, ...]
    arrays: tuple[ArrayAssessment, ...]
    clearances: tuple[ClearanceCheck, ...]
    linked: tuple[LinkedArray, ...]
    solver_seconds: float

    @property
    def governing(self) -> ArrayAssessment:
        """The array with the largest design displacement, or one without a value."""
        return max(self.arrays, key=lambda array: nan_is_worst(array.design_m))

    @property
    def ok(self) -> bool:
        """Whether all limits and clearances are satisfied and each array has a final value."""
        building_ok = all(check.ok for check in self.building_checks)
        arrays_ok = all(map(self.array_ok, self.arrays))
        return building_ok and arrays_ok and all(gap.ok for gap in self.clearances)

    def array_ok(self, array: ArrayAssessment) -> bool:
        """Whether an array has final values and satisfies its limits and clearances."""
        return (
            not math.isnan(array.design_m)
            and array.is_model_enough
            and array.tipping.is_ok
            and all(linked.is_rigid_enough for linked in self.linked_of(array))
            and all(check.ok for check in array.checks)
            and all(gap.ok for gap in self.gaps_of(array.id))
            and all(run.result.status is Status.OK for m in array.motions for run in m.runs)
        )

    def linked_of(self, array: ArrayAssessment) -> Sequence[LinkedArray]:
        """Return an array as a row of linked blocks, where the workbook requests it."""
        return [linked for linked in self.linked if linked.design.id == array.id]

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return [
            gap
            for gap in self.clearances
            if gap.clearance.array == array_id or gap.clearance.object == array_id
        ]

    @property
    def warnings(self) -> tuple[str, ...]:
        """Runs whose displacement is missing or not final, in words."""
        return tuple(text for array in self.arrays for text in run_warnings(array))

    def governing_clearance(self, array_id: str) -> ClearanceCheck | None:
        """Return the clearance of an array, from either side, with the largest D/C, if any."""
        of_array = self.gaps_of(array_id)
        return max(of_array, key=lambda c: nan_is_worst(c.demand_capacity), default=None)


def run_warnings(array: ArrayAssessment) -> tuple[str, ...]:
    """Return in words the runs of an array whose displacement is missing or not final."""
    return tuple(
        f"Array {array.id}, motion {motion.motion.id}, "
        f"{', '.join(run.heading.name for run in runs)}: "
        f"{_trouble([run.result for run in runs])}."
        for motion in array.motions
        for status in Status
        if status is not Status.OK
        and (runs := [run for run in motion.runs if run.result.status is status])
    )


def _trouble(results: Sequence[SlideResult]) -> str:
    """Return the outcome of runs without a final displacement, in words."""
    status = results[0].status
    if status is Status.UPLIFT:
        return f"{status.sentence} (at {min(result.t_uplift_s for result in results):.3f} s)"
    if status is not Status.SLIDING_AT_END:
        return status.sentence
    fastest = max(abs(result.end_speed_mps) for result in results)
    return f"{status.sentence} (at {fastest:.3f} m/s)"


def assess(sheet: Sheet, shaking: Shaking) -> Assessment:
    """Run every array under every motion and check every limit and clearance.

    Raises
    ------
    InputError
        For an override of a provision that the rule set does not have.
    """
    return _assess(sheet, shaking, sheet.project, check_models=True)


def reassess(given: Assessment, project: ProjectInput) -> Assessment:
    """Assess another input under the same motions, with its own models only."""
    return _assess(given.sheet, given.shaking, project, check_models=False)


def _assess(
    sheet: Sheet, shaking: Shaking, data: ProjectInput, *, check_models: bool
) -> Assessment:
    """Assess an input.

    Parameters
    ----------
    check_models : bool
        Whether requested models are compared with the adequate ones, and one rigid block with a
        row of linked blocks.
    """
    site = data.site
    rules = provisions.RULE_SETS[site.rule_set].overridden(
        {row.provision: (row.value, row.reason) for row in data.overrides}
    )
    started = time.perf_counter()
    # Runs in two axes and of rows release the GIL: two proceed in parallel.
    with ThreadPoolExecutor(THREADS) as pool:
        runs = [_runs(pool, array, shaking.motions, check_models) for array in data.arrays]
        seconds = time.perf_counter() - started
        arrays = tuple(
            assess_array(data, rules, array, *pair)
            for array, pair in zip(data.arrays, runs, strict=True)
        )
        links = data.links if check_models else ()
        linked = tuple(assess_linked(pool, rules, row, by_id(arrays, row.array)) for row in links)
    return Assessment(
        sheet=sheet,
        shaking=shaking,
        project=data,
        rules=rules,
        horizontal_target=ac156(data)[0],
        vertical_target=ac156(data)[1],
        targets=targets(data),
        building_checks=provisions.building_checks(
            rules,
            risk_category=list(type(site.risk_category)).index(site.risk_category) + 1,
            stories=site.stories,
        ),
        arrays=arrays,
        clearances=tuple(check_clearance(data, rules, arrays, row) for row in data.clearances),
        linked=linked,
        solver_seconds=seconds,
    )


def _runs(
    pool: Executor, array: Array, motions: Sequence[Motion], check_models: bool
) -> tuple[tuple[MotionRun, ...], ...]:
    """Return the runs of an array, and those with the adequate models."""
    runs = tuple(pool.map(partial(run_motion, array), motions))
    if array.model is Model.CHOOSE or not check_models:
        return runs, runs
    return runs, tuple(pool.map(partial(run_motion, array, model=Model.CHOOSE), motions))
