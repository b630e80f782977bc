"""An assessed project as one record: arrays, clearances, requirements, and what they come to.

Runs nothing: `report.assessment.assess` does. Runs without a final displacement are its warnings.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from report.assessment.arrays import ArrayAssessment
from report.assessment.checks.check import Check
from report.assessment.checks.every import every
from report.assessment.clearances import ClearanceCheck
from report.assessment.friction import LowVelocityAssessment
from report.assessment.links import LinkedArray
from report.assessment.neighbors import ComparedGap, PlanNeighbor
from report.assessment.runs import OrientedRun, scene_key
from report.assessment.verdict import (
    BY_CONSEQUENCE,
    MOTIONS_ID,
    Requirement,
    Verdict,
    as_one,
    nan_is_worst,
    worst,
)
from report.motions.history import Targets
from report.motions.prepare import Shaking
from report.sheet.reading.read import Sheet
from report.sheet.schema import ProjectInput
from report.text.counts import grouped_by
from report.text.units import Quantity, no_less, pair
from solver.model import Status
from solver.records.acceptance import Acceptance
from solver.rules.limit import Limit
from solver.rules.provisions import RuleSet

_MOST_NAMED = 4  # motions in a sentence; more are counted, and the results have each


_WHAT_WOULD_DO = {
    Status.SLIDING_AT_END: "give a longer record, or Zero padding on the sheet Motions",
    Status.UPLIFT: "replace the motion",
    Status.DIVERGED: "replace the motion",
    Status.STEP_LIMIT: "replace the motion",
}


@dataclass(frozen=True, slots=True)
class RunWarning:
    """Runs without a final displacement, as a sentence, and what would do."""

    text: str
    would_do: str


def run_warnings(arrays: Sequence[ArrayAssessment], us_first: bool) -> tuple[RunWarning, ...]:
    """Return the runs without a final displacement, a sentence for each outcome and its remedy."""
    troubled = [
        (array.id, motion.motion.id, run)
        for array in arrays
        for motion in array.motions
        for run in motion.runs
        if run.result.status is not Status.OK
    ]
    by_status = grouped_by(troubled, lambda each: (each[2].result.status, _would_do(each[2])))
    return tuple(
        RunWarning(f"{_place(same)}: {_outcome(status, [each[2] for each in same], us_first)}.", do)
        for (status, do), same in sorted(
            by_status.items(), key=lambda item: list(Status).index(item[0][0])
        )
    )


def _would_do(run: OrientedRun) -> str:
    status, scene = run.result.status, run.scene
    if status is Status.SLIDING_AT_END and scene.friction.mu_slow <= math.tan(scene.slope_rad):
        return (
            "the friction coefficient is not above tan θ of the roof slope, so that no record is "
            "long enough: provide more friction"
        )
    return _WHAT_WOULD_DO[status]


def _place(runs: Sequence[tuple[str, str, OrientedRun]]) -> str:
    """Return the arrays and motions of runs that are given with the ids of theirs."""
    arrays = tuple(dict.fromkeys(array for array, _, _ in runs))
    motions = tuple(dict.fromkeys(motion for _, motion, _ in runs))
    of = f"{'Array' if len(arrays) == 1 else 'Arrays'} {', '.join(arrays)}"
    if len(motions) > _MOST_NAMED:
        return f"{of}, {len(runs)} runs of {len(motions)} motions"
    of += f", {'motion' if len(motions) == 1 else 'motions'} {', '.join(motions)}"
    if len(arrays) == len(motions) == 1:
        return f"{of}, {', '.join(run.orientation.name for _, _, run in runs)}"
    return f"{of}, {len(runs)} runs"


def _outcome(status: Status, runs: Sequence[OrientedRun], us_first: bool) -> str:
    results = [run.result for run in runs]
    if status is Status.UPLIFT:
        return f"{status.sentence} (at {min(result.t_uplift_s for result in results):.3f} s)"
    if status is not Status.SLIDING_AT_END:
        return status.sentence
    fastest = max(abs(result.end_speed_mps) for result in results)
    return f"{status.sentence} (at {pair(fastest, Quantity.VELOCITY, us_first, no_less)})"


THREADS = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Assessment:
    """Everything that was computed for a project."""

    sheet: Sheet  # the workbook as data
    shaking: Shaking  # the motions at the roof
    project: ProjectInput  # as assessed: that of the sheet, except with changed friction
    rules: RuleSet
    targets: Targets  # target spectra of the motions: AC156 or project-specific
    building_checks: tuple[Limit, ...]
    arrays: tuple[ArrayAssessment, ...]
    clearances: tuple[ClearanceCheck, ...]
    linked: tuple[LinkedArray, ...]  # whose rigid-block model the workbook asks to be checked
    # what the plan shows beside each array, with its clearances; none in `at_reduced_friction`
    pairs: tuple[PlanNeighbor, ...]
    acceptance: Acceptance  # limits on the motions as run, at the roof
    rows: tuple[Requirement, ...]  # of the project, its motions and arrays, beside the limits
    at_reduced_friction: Assessment | None  # the same with less friction; None in that one itself
    # arrays with their low-velocity coefficient alone; without any in `at_reduced_friction`, and in
    # what `reassess` and `anticipate` give
    low_velocity: LowVelocityAssessment
    # everything that is required, satisfied or not: the verdicts are the worst of it
    checks: tuple[Check, ...] = field(init=False, compare=False)
    # What many ask for, once; not when it is asked for first: nothing may change while it is sent.
    _rows_by_subject: Mapping[str, Sequence[Requirement]] = field(init=False, compare=False)
    _gaps_by_array: Mapping[str, Sequence[ClearanceCheck]] = field(init=False, compare=False)
    _verdicts: Mapping[str, Verdict] = field(init=False, compare=False)  # by array
    # what the plan shows near each array, or what a clearance is given to
    neighbors: tuple[PlanNeighbor, ...] = field(init=False, compare=False)
    # those without a clearance that are not known to be sufficient
    missing_gaps: tuple[PlanNeighbor, ...] = field(init=False, compare=False)

    def __post_init__(self) -> None:
        rows = [gap.clearance for gap in self.clearances]
        ids = {row.array: None for row in rows} | {row.object: None for row in rows}
        gaps = {each: [gap for gap in self.clearances if gap.involves(each)] for each in ids}
        object.__setattr__(self, "_gaps_by_array", gaps)
        rows_by_subject = grouped_by(self.rows, lambda row: row.subject)
        object.__setattr__(self, "_rows_by_subject", rows_by_subject)
        verdicts = {item.id: self._array_verdict(item) for item in self.arrays}
        object.__setattr__(self, "_verdicts", verdicts)
        neighbors = tuple(pair for pair in self.pairs if pair.is_listed)
        object.__setattr__(self, "neighbors", neighbors)
        missing = tuple(near for near in neighbors if near.is_short)
        object.__setattr__(self, "missing_gaps", missing)
        object.__setattr__(self, "checks", every(self))

    def __repr__(self) -> str:
        counts = f"{len(self.arrays)} arrays, {len(self.clearances)} clearances"
        return f"Assessment: {self.verdict.value}; {counts}, {len(self.conditions)} conditions"

    @property
    def has_motions(self) -> bool:
        """Whether there is an analysis; without one, every array takes the prescriptive route."""
        return bool(self.shaking.motions)

    @property
    def governing(self) -> ArrayAssessment:
        """The array with the largest design displacement, or one without a value."""
        return max(self.arrays, key=lambda array: nan_is_worst(array.design_m))

    @property
    def alike(self) -> Sequence[Sequence[ArrayAssessment]]:
        """The arrays in groups that share their runs, in order."""
        return tuple(grouped_by(self.arrays, lambda item: scene_key(item.array)).values())

    @property
    def verdict(self) -> Verdict:
        """Verdict on the project: the worst of its limits, arrays, clearances and rows."""
        verdict = worst(
            [
                *(self.limit_verdict(check) for check in self.building_checks),
                *self._verdicts.values(),
                *(gap.verdict for gap in self.clearances),
                *(row.verdict for row in self.rows),
            ]
        )
        return Verdict.CONDITIONS if verdict is Verdict.CONDITION else verdict

    def array_verdict(self, item: ArrayAssessment) -> Verdict:
        """Return the verdict on an array: its values, limits, rows and clearances."""
        return self._verdicts[item.id]

    def _array_verdict(self, item: ArrayAssessment) -> Verdict:
        gaps = self.gaps_of(item.id)
        # Beside a clearance without a verdict it is NG.
        has_verdicts = not math.isnan(item.design_m) and all(gap.is_permitted for gap in gaps)
        is_ok = has_verdicts and self.is_rigid_enough(item) and self.is_sound(item)
        return worst(
            [
                Verdict.OK if is_ok else Verdict.NG,
                *(gap.verdict for gap in gaps),
                *(row.verdict for row in self.rows_of(item.array.id)),
            ]
        )

    def limit_verdict(self, limit: Limit) -> Verdict:
        """Return the verdict on a limit: of one that is a requirement too, the verdict on that."""
        rows = (row for row in self.rows if row.id == MOTIONS_ID and row.title == limit.title)
        missed = next((row.verdict for row in rows), BY_CONSEQUENCE[limit.consequence])
        return Verdict.OK if limit.ok else missed

    def is_sound(self, item: ArrayAssessment) -> bool:
        """Whether an array satisfies its limits, and its runs are final."""
        return (
            item.tipping.is_ok
            and item.satisfies_limits
            and all(run.result.status is Status.OK for run in item.runs)
        )

    @property
    def conditions(self) -> tuple[Requirement, ...]:
        """The rows that are not satisfied and not only a note."""
        return tuple(
            row for row in self.rows if not row.is_satisfied and row.verdict is not Verdict.NOTE
        )

    @property
    def notes(self) -> tuple[Requirement, ...]:
        """The rows on the analysis that are not satisfied, where nothing follows from it."""
        return tuple(row for row in self.rows if row.verdict is Verdict.NOTE)

    @property
    def alike_conditions(self) -> Sequence[tuple[Requirement, Sequence[str]]]:
        """The same, each with the ids of all arrays or motions that it asks the same of."""
        groups = grouped_by(self.conditions, lambda row: row.asked)
        return [(as_one(rows), [row.subject for row in rows]) for rows in groups.values()]

    @property
    def is_overridden(self) -> bool:
        """Whether an override or a departure changes a design displacement or a separation."""
        return any(
            (
                *(item.design_mark for item in self.arrays),
                *(gap.mark for gap in self.clearances),
                *(gap.mark for gap in self.missing_gaps),
            )
        )

    def rows_of(self, subject: str) -> Sequence[Requirement]:
        """Return the rows about an array or a motion."""
        return self._rows_by_subject.get(subject, ())

    def is_rigid_enough(self, item: ArrayAssessment) -> bool:
        """Whether one rigid block is adequate for an array, where the workbook asks."""
        return all(row.is_rigid_enough for row in self.linked if row.design.id == item.id)

    def gaps_of(self, array_id: str) -> Sequence[ClearanceCheck]:
        """Return the clearances that involve an array, on either side."""
        return self._gaps_by_array.get(array_id, ())

    @property
    def warnings(self) -> tuple[RunWarning, ...]:
        """Runs whose displacement is missing or not final, in words."""
        return run_warnings(self.arrays, self.project.us_first)

    def governing_gap(self, array_id: str = "") -> ComparedGap | None:
        """Return the gap with the largest D/C, if any; of an array that from either side."""
        # Pairs that the plan shows to be short and no clearance covers are gaps as well.
        gaps: Sequence[ComparedGap] = (*self.clearances, *self.missing_gaps)
        concerned = [gap for gap in gaps if not array_id or gap.involves(array_id)]
        return max(concerned, key=lambda gap: nan_is_worst(gap.demand_capacity), default=None)


class ChangeKind(StrEnum):
    """What changed, in the order of the page."""

    RULES = "rule set"
    SOFTWARE = "software"
    INPUT = "input"
    RECORD = "record"
    DOCUMENT = "document"
    ANALYSIS = "displacement by analysis"
    DESIGN = "design displacement"
    CLEARANCE = "clearance"
    REQUIREMENT = "requirement"
    VERDICT = "verdict"


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One change."""

    kind: ChangeKind
    title: str  # what changed, with the array, motion or clearance that it belongs to
    # as printed
    before: str
    now: str
    cell: str = ""  # address in the workbook; empty for what has no cell


@dataclass(frozen=True, slots=True, kw_only=True)
class Changes:
    """Everything that changed since a former revision."""

    # of the former package
    revision: str = ""
    date: str = ""
    items: tuple[Change, ...] = ()
    arrays: frozenset[str] = frozenset()  # ids of arrays with another result
    # array and key of results.json, or array and motion, whose number changed
    values: frozenset[tuple[str, str]] = frozenset()
    clearances: frozenset[int] = frozenset()  # numbers of the clearances that changed, from 1

    @property
    def is_asked_for(self) -> bool:
        """Whether a former revision was named."""
        return bool(self.revision)

    @property
    def cells(self) -> frozenset[str]:
        """Addresses of the input cells that changed."""
        return frozenset(item.cell for item in self.items if item.cell)

    def count(self, kind: ChangeKind) -> int:
        """Return the number of changes of a kind."""
        return sum(item.kind is kind for item in self.items)


# Of a package that is compared with none.
NO_FORMER = Changes()
