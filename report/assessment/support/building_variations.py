"""The building as used and with other periods and damping."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from report.assessment.assessment import Assessment
from report.assessment.design.clearances import with_displacements
from report.assessment.design.routes import Route, statistic_basis
from report.assessment.low_velocity import InputCase
from report.motions.history import PreparedMotion, first_period_s, through_building
from report.project.model import ProjectInput
from report.project.model.array import Array
from report.project.model.choices import Direction
from report.project.model.motion_input import BuildingInput, MotionInput
from report.runs import run_motion
from report.text.units import nan_is_worst, number
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


def _prd_m(array: Array, data: ProjectInput, of: tuple[MotionInput, PreparedMotion]) -> float:
    row, prepared = of
    return run_motion(array, through_building(data, row, prepared)).peak_m(Direction.ANY)


def building_case(assessment: Assessment, variations: Variations) -> InputCase | None:
    """Return the governing array with the period or damping that lets it slide farthest, if any."""
    array = assessment.governing
    # Such a design displacement does not follow from one value of the analysis.
    if not variations or array.route is not Route.ANALYSIS:
        return None
    (used, _), *others = variations
    building, value = max(others, key=lambda pair: nan_is_worst(pair[1].value_m))
    design_m = math.nan if math.isnan(value.value_m) else max(value.value_m, array.floor_m)
    if not nan_is_worst(design_m) > array.design_m:
        return None
    is_damping = building.damping_percent != used.damping_percent
    changed = (
        f"{number(building.damping_percent, 1)} % damping of the building"
        if is_damping
        else f"{number(building.period_s or math.nan, 2)} s as the period of the building"
    )
    farther = replace(array, analysis=value, design_m=design_m)
    slides = {array.id: farther.displacement}
    given = assessment.gaps_of(array.id)
    gaps = [with_displacements(assessment, slides, gap) for gap in given]
    return InputCase(array=farther, changed=changed, gaps=gaps)
