"""Contents of the tables next to a printed roof plan: groups of equal arrays, and clearances.

Twelve arrays of one size, slope and displacement are one row, `A1 to A12`. Read `fitted_schedule`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import NamedTuple

from report.assessment.assessment import Assessment
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.support.plan_gaps import keep_clear, keep_clear_m, keep_clear_mark
from report.drawing.paper_items import width_in
from report.drawing.sheet import PlanSize
from report.project.model.shapes import Shape, around
from report.text.grouping import ids_by
from report.text.names import ranged
from report.text.unit_format import UnitFormat
from report.text.units import NO_BREAK, Quantity, measured, no_less, number

ROW_IN = 0.175  # of a table of the package
_IDS_IN, _FROM_IN, _TO_IN = 0.48, 0.22, 0.48  # width of words in columns of the tables
_AROUND_ARRAYS_IN, _AROUND_SCHEDULE_IN = 1.05, 0.62  # captions, headings, notes and margins
_BELOW_IN = 0.75  # by which columns may be taller than the plan: the legend and the caption


class AlikeArrays(NamedTuple):
    """Arrays of one size, slope and displacement; numbers in the preferred units."""

    ids: str
    size: str
    slope: str
    design: str
    keep: str


def alike_arrays(assessment: Assessment, fmt: UnitFormat) -> Sequence[AlikeArrays]:
    """Return the arrays of an assessment, equal ones together."""

    def key(array: ArrayAssessment) -> tuple[str, str, str, str]:
        design = fmt.first(array.permitted_m, mark=array.overridden.design, show=no_less)
        keep = keep_clear(keep_clear_m(assessment, array), fmt.us_first).partition(NO_BREAK)[0]
        keep += keep_clear_mark(assessment, array)
        slope = f"{number(math.degrees(array.array.slope_rad), 2)}°"
        return size_words(array.array.shape, fmt), slope, design, keep

    alike = ids_by(assessment.arrays, key)
    return [AlikeArrays(ranged(ids), *words) for words, ids in alike.items()]


def size_words(shape: Shape, fmt: UnitFormat) -> str:
    """Return width and depth of a shape, over all, without unit."""
    unit, box = fmt.units(Quantity.PLAN)[0], around([shape])
    sides = (box.x_to_m - box.x_from_m, box.y_to_m - box.y_from_m)
    return " × ".join(measured(side, unit).rstrip("0").rstrip(".") for side in sides)


class Schedule(NamedTuple):
    """Contents next to a plan: whether the table of arrays, and rows of the schedule by column."""

    has_arrays: bool
    rows: Sequence[int]

    def is_all(self, assessment: Assessment) -> bool:
        """Whether it is complete."""
        return self.has_arrays and sum(self.rows) == len(assessment.clearances)


def fitted_schedule(
    assessment: Assessment, arrays: Sequence[AlikeArrays], size: PlanSize
) -> Schedule:
    """Return the contents that fit next to a plan."""
    room = size.tall + _BELOW_IN
    arrays_tall = _AROUND_ARRAYS_IN
    arrays_tall += ROW_IN * sum(_lines(row.ids, _IDS_IN) for row in arrays)
    has_arrays = size.columns > 0 and arrays_tall <= room
    # The table of arrays stands above the first column of the schedule alone.
    if has_arrays:
        room -= arrays_tall
    tall = [
        ROW_IN * max(_lines(gap.clearance.array, _FROM_IN), _lines(gap.clearance.object, _TO_IN))
        for gap in assessment.clearances
    ]
    rows: list[int] = []
    for _ in range(size.columns):
        used = accumulate(tall[sum(rows) :], initial=_AROUND_SCHEDULE_IN)
        # Less one: the first of the heights is that of no row.
        rows.append(max(sum(height <= room for height in used) - 1, 0))
        room = size.tall + _BELOW_IN
    return Schedule(has_arrays, rows)


def _lines(words: str, wide: float) -> int:
    """Return the number of lines of a text in a cell of a table."""
    return math.ceil(width_in(words) / wide)
