"""The governing array with other periods and other damping of the building.

Runs the solver and collects numbers; `report.pages.building` prints them. Read
`building_variations`.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial

from report.assessment.arrays import ArrayAssessment, assess_array
from report.assessment.project import THREADS, Assessment
from report.assessment.runs import MotionRun, run_motion
from report.motions.history import first_period_s, through_building
from report.sheet.schema import BuildingInput, ProjectInput, RecordedAt
from solver.building.structure import MOST_PERIOD_S

PERIOD_FACTORS = (0.8, 1.2)
DAMPING_PERCENT = (2.0, 3.0, 5.0, 7.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class BuildingVariation:
    """The governing array under all motions, ground motions through one building."""

    array: str
    period_s: float  # first period in the direction of the record [s]
    damping_percent: float
    mean_prd_m: float  # mean PRD [m]; NaN where a run has no final displacement
    largest_prd_m: float  # likewise
    design_m: float  # design displacement [m]


def building_variations(given: Assessment) -> tuple[BuildingVariation, ...]:
    """Return the building as used, then with one change at a time; none without ground motions.

    All periods change by one factor, and the damping of all modes.
    """
    data, array = given.project, given.governing
    if all(row.recorded_at is RecordedAt.ROOF for row in data.motions):
        return ()
    found = [_variation(data, array)]
    with ThreadPoolExecutor(THREADS) as pool:
        for building in filter(data.building.__ne__, _others(data)):
            other = data.model_copy(update={"building": building})
            runs = tuple(pool.map(partial(_run, given, other), range(len(data.motions))))
            qualify = given.acceptance.qualifies
            varied = assess_array(
                other, given.rules, array.array, runs, runs, motions_qualify=qualify
            )
            found.append(_variation(other, varied))
    return tuple(found)


def _others(data: ProjectInput) -> Iterator[BuildingInput]:
    """Yield the building with each change, within the periods that a building may have."""
    used = data.building
    given_s = {"period_2_s": used.period_2_s, "transverse_s": used.transverse_s}
    periods_s = {name: period_s for name, period_s in given_s.items() if period_s is not None}
    periods_s["period_s"] = first_period_s(data)
    for factor in PERIOD_FACTORS:
        within = min(factor, MOST_PERIOD_S / max(periods_s.values()))
        yield used.model_copy(update={name: within * s for name, s in periods_s.items()})
    for percent in DAMPING_PERCENT:
        yield used.model_copy(update={"damping_percent": percent})


def _run(given: Assessment, other: ProjectInput, index: int) -> MotionRun:
    """Run the governing array under a motion; one recorded at the roof is as in the design."""
    row = other.motions[index]
    if row.recorded_at is RecordedAt.ROOF:
        return given.governing.motions[index]
    motion = through_building(other, row, given.shaking.prepared[index])
    return run_motion(given.governing.array, motion)


def _variation(data: ProjectInput, found: ArrayAssessment) -> BuildingVariation:
    return BuildingVariation(
        array=found.id,
        period_s=first_period_s(data),
        damping_percent=data.building.damping_percent,
        mean_prd_m=found.analysis.mean_m,
        largest_prd_m=found.analysis.largest_m,
        design_m=found.design_m,
    )
