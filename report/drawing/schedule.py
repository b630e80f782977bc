"""What the tables beside a printed plan have, and how much of them its columns have room for.

Their words are in the template of the page. Read `Schedule` first.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import NamedTuple

from report.assessment.arrays import ArrayAssessment
from report.assessment.envelopes import keep_clear, keep_clear_m, keep_clear_mark
from report.assessment.project import Assessment
from report.drawing.sheet import COLUMN_IN, PlanSize
from report.drawing.widths import width_in
from report.entities.columns import UnitFormat
from report.sheet.schema.shapes import Shape, around
from report.words.counts import ids_by, ranged
from report.words.units import Quantity, measured, no_less, number

ROW_IN = 0.175  # of a table of the package
_IDS_IN, _FROM_IN, _TO_IN = 0.48, 0.22, 0.48  # width of words in columns of the tables
_AROUND_ARRAYS_IN, _AROUND_SCHEDULE_IN = 1.05, 0.62  # captions, headings, notes and margins
_KEY_ROW_IN, _KEY_COLUMN_IN, _AROUND_KEY_IN = 0.15, 2.7, 0.25  # of the key to names
_BELOW_IN = 0.75  # by which columns may be taller than the plan: the legend and the caption


class AlikeArrays(NamedTuple):
    """Arrays of one size, slope and displacement; numbers in the preferred units."""

    ids: str
    size: str
    slope: str
    design: str
    keep: str


def alike_arrays(assessment: Assessment, fmt: UnitFormat) -> Sequence[AlikeArrays]:
    """Return the arrays of an assessment, those alike together."""

    def key(array: ArrayAssessment) -> tuple[str, str, str, str]:
        design = fmt.first(array.permitted_m, mark=array.design_mark, show=no_less)
        keep = keep_clear(keep_clear_m(assessment, array), fmt.us_first).partition(" ")[0]
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
    """What is beside a plan: whether the table of arrays, and rows of the schedule by column.

    On a plan without columns, nothing is: the tables follow it.
    """

    has_arrays: bool
    rows: Sequence[int]

    def is_all(self, assessment: Assessment) -> bool:
        """Whether it is all that there is."""
        return self.has_arrays and sum(self.rows) == len(assessment.clearances)


def key_tall(assessment: Assessment, size: PlanSize) -> float:
    """Return the height of the key to the names below a plan on a large sheet [in]."""
    data = assessment.project
    ids = [*(row.id for row in data.arrays), *(row.id for row in data.objects)]
    keys = data.names.keys.keys() & ids
    columns = math.floor((size.wide + size.columns * COLUMN_IN) / _KEY_COLUMN_IN)
    return _AROUND_KEY_IN + _KEY_ROW_IN * math.ceil(len(keys) / columns) if keys else 0.0


def beside(assessment: Assessment, arrays: Sequence[AlikeArrays], size: PlanSize) -> Schedule:
    """Return what has room beside a plan."""
    room = size.tall + _BELOW_IN
    printed = assessment.project.names
    arrays_tall = _AROUND_ARRAYS_IN
    arrays_tall += ROW_IN * sum(_lines(printed(row.ids), _IDS_IN) for row in arrays)
    has_arrays = size.columns > 0 and arrays_tall <= room
    if has_arrays:
        room -= arrays_tall
    tall = [
        ROW_IN
        * max(
            _lines(printed(gap.clearance.array), _FROM_IN),
            _lines(printed(gap.clearance.object), _TO_IN),
        )
        for gap in assessment.clearances
    ]
    rows: list[int] = []
    for _ in range(size.columns):
        used = accumulate(tall[sum(rows) :], initial=_AROUND_SCHEDULE_IN)
        rows.append(max(sum(height <= room for height in used) - 1, 0))
        room = size.tall + _BELOW_IN
    return Schedule(has_arrays, rows)


def _lines(words: str, wide: float) -> int:
    """Return how many lines words take in a cell of a table."""
    return math.ceil(width_in(words) / wide)
