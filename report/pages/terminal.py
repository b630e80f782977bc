"""The summary of an assessment printed by `roofslip report`, and the same for JSON.

A line for each array, then what needs attention, then the verdict:

    array  analysis           prescriptive       design             governing clearance  D/C
    A1     18.6 in (472 mm)   81.6 in (2072 mm)  40.8 in (1036 mm)  RTU-1                0.85  OK
    A2     34.1 in (866 mm)   81.6 in (2072 mm)  40.8 in (1036 mm)  A1                   0.43  OK
    verdict: OK, largest D/C 0.85

Computes nothing. Read `summary`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from report.assessment.assessment import Assessment
from report.assessment.causes import causes, unshown_cause
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.rule_set import MEANING
from report.pages.array_tables import governing_name, ratio_words
from report.pages.attention import attention
from report.pages.marks import Marks
from report.text.aligned import aligned
from report.text.json_numbers import finite
from report.text.unit_format import UnitFormat
from report.text.units import spaced

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.arrays import ArrayAssessment


_COLUMNS = ("array", "analysis", "prescriptive", "design", "governing clearance", "D/C", "")


def summary(assessment: Assessment) -> Iterator[str]:
    """Yield the table of the arrays, what needs attention, and the verdict."""
    # A terminal has no note at its foot that would say what a dagger means.
    marks = Marks(assessment, has_daggers=False)
    rows = [_COLUMNS, *(_row(assessment, marks, item) for item in assessment.arrays)]
    # Without motions nothing is computed: a column of nones would look like a failure.
    if not assessment.has_motions:
        rows = [(id, *cells) for id, _, *cells in rows]
    yield from aligned(rows)
    if assessment.is_overridden:
        yield MEANING
    for level, text in attention(assessment):
        yield f"{level}: {text}"
    gap = assessment.governing_gap()
    largest = f", largest D/C {gap.ratio_words}" if gap and not math.isnan(gap.required_m) else ""
    yield f"verdict: {assessment.verdict.value}{largest}"


def document(assessment: Assessment) -> dict[str, Any]:
    """Return the same for JSON, with units in the keys and null for no value."""
    return {
        "verdict": assessment.verdict.value,
        "arrays": [_array(assessment, item) for item in assessment.arrays],
        "attention": [
            {"level": level, "text": spaced(text)} for level, text in attention(assessment)
        ],
    }


def _array(assessment: Assessment, item: ArrayAssessment) -> dict[str, Any]:
    gap = assessment.governing_gap(item.id)
    return {
        "id": item.id,
        # JSON has no NaN.
        "computed_m": finite(item.analysis.value_m),
        "prescriptive_m": item.prescriptive.value_m,
        "design_m": finite(item.design_m),
        "design_is_overridden": bool(item.overridden.design),
        "governing_clearance": gap.across_from(item.id) if gap else None,
        "demand_capacity": finite(gap.demand_capacity) if gap else None,
        "required_is_overridden": bool(gap and gap.mark),
        "verdict": assessment.array_verdict(item).value,
        "causes": [*map(spaced, causes(assessment, item))],
    }


def _row(done: Assessment, marks: Marks, item: ArrayAssessment) -> tuple[str, ...]:
    fmt, cause = UnitFormat(us_first=done.project.us_first), unshown_cause(done, item)
    refused = f", {NOT_PERMITTED}" if item.has_unpermitted_value else ""
    return (
        item.id,
        fmt.both_up(item.analysis.value_m, item.overridden.analysis),
        fmt.both_up(item.prescriptive.value_m, marks.prescriptive(item)),
        fmt.both_up(item.design_m, marks.design(item)) + refused,
        governing_name(done, item),
        ratio_words(done, item),
        done.array_verdict(item) + (f": {cause}" if cause else ""),
    )
