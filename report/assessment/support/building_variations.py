"""The building as used and with other periods and damping."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from report.assessment.assessment import Assessment
from report.assessment.design.routes import statistic_basis
from report.motions.history import PreparedMotion, first_period_s, through_building
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction
from report.project.model.motion_input import BuildingInput, MotionInput
from report.runs import run_motion
from solver.building.structure import MOST_PERIOD_S
from solver.rules.provisions import AnalysisValue, analysis_value

PERIOD_FACTORS = (0.8, 1.2)


DAMPING_PERCENT = (2.0, 3.0, 5.0, 7.0)


Variations = Sequence[tuple[BuildingInput, AnalysisValue]]
"""The building as used and with other periods and damping, each with its value from analysis."""


def building_variations(assessment: Assessment) -> Variations:
    """Return the building as used, then each variation, with the governing array's value."""
    data, array, prepared = assessment.project, assessment.governing, assessment.shaking.prepared
    if not any(item.roof for item in prepared):
        return ()
    used = data.building.model_copy(update={"period_s": first_period_s(data)})
    variations = [(used, array.analysis)]
    for building in _others(used):
        other = data.model_copy(update={"building": building})
        rows = zip(data.motions, prepared, strict=True)
        peaks_m = assessment.runs.map(partial(_prd_m, array.array, other), rows)
        value = analysis_value(assessment.rules, peaks_m, statistic_basis(data))
        variations.append((building, value))
    return tuple(variations)


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


def _prd_m(array: Array, data: ProjectInput, motion: tuple[MotionInput, PreparedMotion]) -> float:
    row, prepared = motion
    return run_motion(array, through_building(data, row, prepared)).peak_m(Direction.ANY)
