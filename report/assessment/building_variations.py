"""The governing array with other periods and other damping of the building, one at a time.

Runs the solver and collects numbers; `report.pages.building` prints them.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial

from report.assessment.arrays import statistic_basis
from report.assessment.project import THREADS, Assessment
from report.assessment.runs import run_motion
from report.motions.history import PreparedMotion, first_period_s, through_building
from report.sheet.schema import ProjectInput
from report.sheet.schema.building import BuildingInput
from report.sheet.schema.choices import Direction
from report.sheet.schema.motions import MotionInput
from report.sheet.schema.scene import Array
from solver.building.structure import MOST_PERIOD_S
from solver.rules.provisions import AnalysisValue, analysis_value

PERIOD_FACTORS = (0.8, 1.2)
DAMPING_PERCENT = (2.0, 3.0, 5.0, 7.0)


def building_variations(given: Assessment) -> tuple[tuple[BuildingInput, AnalysisValue], ...]:
    """Return the building as used, then each variation, with the governing array's value from
    analysis; nothing where no motion goes through the building."""
    data, array, prepared = given.project, given.governing, given.shaking.prepared
    if not any(item.roof for item in prepared):
        return ()
    used = data.building.model_copy(update={"period_s": first_period_s(data)})
    found = [(used, array.analysis)]
    with ThreadPoolExecutor(THREADS) as pool:
        for building in _others(used):
            other = data.model_copy(update={"building": building})
            peaks_m = list(pool.map(partial(_prd_m, array.array, other), data.motions, prepared))
            value = analysis_value(given.rules, peaks_m, statistic_basis(data))
            found.append((building, value))
    return tuple(found)


def _others(used: BuildingInput) -> Iterator[BuildingInput]:
    periods_s = used.model_dump(
        include={"period_s", "period_2_s", "transverse_s"}, exclude_none=True
    )
    for factor in PERIOD_FACTORS:
        scaled = {name: min(factor * s, MOST_PERIOD_S) for name, s in periods_s.items()}
        yield used.model_copy(update=scaled)
    for percent in DAMPING_PERCENT:
        if percent != used.damping_percent:
            yield used.model_copy(update={"damping_percent": percent})


def _prd_m(array: Array, data: ProjectInput, row: MotionInput, prepared: PreparedMotion) -> float:
    return run_motion(array, through_building(data, row, prepared)).peak_m(Direction.ANY)
