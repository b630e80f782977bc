"""What `roofslip report` prints of an assessment: a line for each array, then what needs attention.

Finished lines; computes nothing. Read `summary`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from report.assessment.arrays import NOT_PERMITTED
from report.assessment.causes import causes
from report.assessment.overrides import MEANING
from report.assessment.precheck import findings, limit_words
from report.assessment.verdict import Verdict
from report.entities.array import ArrayResult, array_results
from report.entities.columns import UnitFormat
from report.entities.marks import Marked
from report.pages.registry import package_data, parts
from report.sheet.checking.findings import lines
from report.sheet.schema.choices import ModelChoice
from report.sheet.schema.fields import Level
from report.sheet.writing.legacy_notes import what_is_new
from report.words.counts import lowered, ranged
from report.words.formats import aligned, finite
from report.words.units import Quantity, compared_pairs, ratio
from solver.model import Status

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.clearances import ClearanceCheck
    from report.assessment.project import Assessment

_COLUMNS = ("array", "computed", "prescriptive", "design", "governing clearance to", "D/C", "")

_WHAT_WOULD_DO = {
    Status.SLIDING_AT_END: "give a longer record, or Zero padding on the sheet Motions",
    Status.UPLIFT: "anchor the array, or replace the motion",
    Status.DIVERGED: f"select the model '{ModelChoice.CHOOSE}' on the sheet Arrays",
    Status.STEP_LIMIT: f"select the model '{ModelChoice.CHOOSE}' on the sheet Arrays",
}


@dataclass(frozen=True, slots=True)
class Concern:
    """Something that needs attention: its weight (NG, condition, warning) and what it is."""

    level: str
    text: str


def summary(assessment: Assessment) -> Iterator[str]:
    """Yield the table of the arrays, what needs attention, and the verdict."""
    marked = Marked(assessment=assessment, has_daggers=False)
    rows = [_COLUMNS, *(_row(marked.fmt, item) for item in array_results(marked))]
    yield from aligned(rows)
    if assessment.is_overridden:
        yield MEANING
    for line in attention(assessment):
        yield f"{line.level}: {line.text}"
    yield f"verdict: {assessment.verdict.value}"


def document(assessment: Assessment) -> dict[str, Any]:
    """Return the same for JSON, in SI units, with null for no value."""
    return {
        "verdict": assessment.verdict.value,
        "arrays": [_array(assessment, item) for item in assessment.arrays],
        "attention": [{"level": line.level, "text": line.text} for line in attention(assessment)],
    }


def _array(assessment: Assessment, item: ArrayAssessment) -> dict[str, Any]:
    gap = assessment.governing_gap(item.id)
    return {
        "id": item.id,
        "computed_m": finite(item.analysis.value_m),
        "prescriptive_m": item.prescriptive.value_m,
        "design_m": finite(item.design_m),
        "design_is_overridden": bool(item.design_mark),
        "governing_clearance": gap.across_from(item.id) if gap else None,
        "demand_capacity": finite(gap.demand_capacity) if gap else None,
        "required_is_overridden": bool(gap and gap.mark),
        "verdict": assessment.array_verdict(item).value,
        "causes": causes(assessment, item),
    }


def _row(fmt: UnitFormat, item: ArrayResult) -> tuple[str, ...]:
    refused = f", {NOT_PERMITTED}" if item.is_refused else ""
    return (
        item.id,
        *(item.both(name, fmt) for name in ("computed_m", "prescriptive_m")),
        item.both("design_m", fmt) + refused,
        item.governing_gap,
        item.largest_dc,
        item.verdict.word + (f": {item.cause}" if item.cause else ""),
    )


def attention(assessment: Assessment) -> Iterator[Concern]:
    """Yield what is not satisfied, each with array, value, limit, and what would do."""
    us_first = assessment.project.us_first
    for status, text in assessment.troubled_runs.items():
        yield Concern("NG", f"{lowered(text.rstrip('.'))}; {_WHAT_WOULD_DO[status]}")
    yield from _models(assessment)
    for check in (check for check in assessment.building_checks if not check.ok):
        yield Concern("NG", f"building, {limit_words(check, us_first)}")
    for item in assessment.arrays:
        for check in (check for check in item.limits if not check.ok):
            yield Concern("NG", f"array {item.id}, {limit_words(check, us_first)}")
    for gap in (gap for gap in assessment.clearances if gap.verdict is Verdict.NG):
        yield Concern("NG", _short(gap, us_first))
    for row, ids in assessment.alike_conditions:
        where = f"{ranged(ids)}, " if row.subject else ""
        text = f"{where}{lowered(row.title)}: {row.found}; required: {row.limit}. {row.remedy}"
        yield Concern(row.consequence.value, text)
    for finding in what_is_new(assessment.sheet.book):
        yield Concern(finding.level.value, finding.text)
    found = findings(assessment.sheet, assessment.shaking)
    for line in lines(found, assessment.sheet.addresses):
        if line.finding.level is Level.WARNING:
            reason = line.finding.reason
            answer = f" Acknowledged: {reason}" if reason else ""
            yield Concern("warning", f"{line.cells}: {line.finding.text} [{line.names}]{answer}")


def _models(assessment: Assessment) -> Iterator[Concern]:
    """Yield arrays that tip, and whose model is not adequate."""
    (title,) = (part.title for part in parts(package_data(assessment)) if part.id == "model")
    see = f"see '{title}' in the package"
    for item in assessment.arrays:
        if not item.tipping.is_ok:
            tipping = f"{ratio(item.tipping.ratio)} of the ratio at which it tips; 1.00 or less is"
            text = f"array {item.id} starts to tip: {tipping} required, with a lower center of"
            yield Concern("NG", f"{text} gravity or wider supports; {see}")
        if not item.is_model_enough:
            text = f"array {item.id}, requested model '{item.array.model}' is not adequate; select"
            yield Concern("NG", f"{text} '{ModelChoice.CHOOSE}' on the sheet Arrays; {see}")
    for name in (row.design.id for row in assessment.linked if not row.is_rigid_enough):
        text = f"one rigid block has not been shown to be adequate for array {name}"
        yield Concern("NG", f"{text}; {see}")


def _short(gap: ClearanceCheck, us_first: bool) -> str:
    """Return a clearance that is too small, with what would do."""
    row = gap.clearance
    required, provided = compared_pairs(gap.required_m, row.provided_m, Quantity.SIZE, us_first)
    name = f"clearance {row.array} to {row.object}: {provided} provided"
    if math.isnan(gap.required_m):
        return f"{name}; there is no design displacement of {gap.governing_array} to compare with"
    return f"{name}; {required}{gap.mark} required (D/C {gap.ratio_words})"
