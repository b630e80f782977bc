"""What `roofslip report` prints of an assessment: a line for each array, then what needs attention.

Finished lines; computes nothing. Read `summary`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from report.assessment.arrays import NOT_PERMITTED
from report.assessment.causes import causes, reasons, row_words
from report.assessment.overrides import MEANING
from report.assessment.precheck import findings
from report.assessment.savings import saving
from report.document.templates import sentence
from report.entities.array import ArrayResult, array_results
from report.entities.columns import UnitFormat
from report.entities.marks import Marked
from report.pages.remedies import best_words
from report.sheet.checking.findings import lines
from report.sheet.schema.fields import Level
from report.sheet.writing.legacy_notes import what_is_new
from report.typeset.pdf import TEMPLATES
from report.words.formats import aligned, finite
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.project import Assessment

_COLUMNS = ("array", "computed", "prescriptive", "design", "governing clearance to", "D/C", "")


@dataclass(frozen=True, slots=True)
class Concern:
    """Something that needs attention: its weight (NG, condition, warning) and what it is."""

    level: str
    text: str


def summary(assessment: Assessment) -> Iterator[str]:
    """Yield the table of the arrays, what needs attention, and the verdict."""
    marked = Marked(assessment=assessment, has_daggers=False)
    rows = [_COLUMNS, *(_row(marked.fmt, item) for item in array_results(marked))]
    if not assessment.has_motions:  # nothing is computed
        rows = [(id, *others) for id, _, *others in rows]
    yield from aligned(rows)
    if assessment.is_overridden:
        yield MEANING
    for line in attention(assessment):
        yield f"{line.level}: {line.text}"
    yield f"verdict: {assessment.verdict.value}"


def without_motions(assessment: Assessment) -> str:
    """Return what is made without motions, and what an analysis could save."""
    marked = Marked(assessment=assessment, has_daggers=False)
    return sentence(TEMPLATES, "without_motions", marked, saving(assessment))


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
        item.verdict + (f": {item.cause}" if item.cause else ""),
    )


def attention(assessment: Assessment, *, may_run: bool = True) -> Iterator[Concern]:
    """Yield what is not satisfied, what makes it NG first, and what would do, with runs or not."""
    for reason in reasons(assessment):
        yield Concern(Consequence.NG.value, reason)
    if best := best_words(assessment, may_run=may_run):
        yield Concern("remedy", best)
    for row, ids in assessment.alike_conditions:
        if row.verdict.is_permitted:
            yield Concern(row.consequence.value, row_words(row, ids))
    if not assessment.has_motions:
        yield Concern(Consequence.NOTE.value, without_motions(assessment))
    for row in assessment.notes:
        yield Concern(row.consequence.value, row_words(row, [row.subject]))
    for finding in what_is_new(assessment.sheet.book):
        yield Concern(finding.level.value, finding.text)
    found = findings(assessment.sheet, assessment.shaking)
    for line in lines(found, assessment.sheet.addresses):
        if line.finding.level is Level.WARNING:
            reason = line.finding.reason
            answer = f" Acknowledged: {reason}" if reason else ""
            yield Concern("warning", f"{line.cells}: {line.finding.text} [{line.names}]{answer}")
