"""What `roofslip report` prints of an assessment: a line for each array, then what needs attention.

Finished lines; computes nothing. Read `summary`.

What would satisfy each clearance and array marked NG, in sentences.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from report.assessment.causes import causes, reasons, row_words
from report.assessment.evidence import saving
from report.assessment.friction import mu_words
from report.assessment.precheck import findings
from report.assessment.project import Assessment
from report.assessment.remedies import Remedy, RemedyKind, best_remedy
from report.assessment.routes import NOT_PERMITTED
from report.assessment.trials import with_mu
from report.assessment.verdict import MEANING
from report.document.templates import sentence
from report.entities.array import ArrayResult, array_results
from report.entities.requirement import Marked
from report.entities.shown import UnitFormat
from report.pages.inputs import attachment
from report.pages.parts import PackageData
from report.sheet.checking.findings import lines
from report.sheet.schema.fields import Level
from report.text.amounts import capacity, compared_pairs, demand
from report.text.counts import grouped_by
from report.text.formats import aligned, finite
from report.text.units import Quantity, no_less, pair
from report.typeset.pdf import TEMPLATES
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.project import Assessment


@dataclass(frozen=True, slots=True, kw_only=True)
class PrintedRemedy:
    """A remedy for print: the value given, the one that would do, and what comes of it; if any."""

    remedy: Remedy
    given: str
    value: str
    outcome: str


def answers(package: PackageData, remedies: Sequence[Remedy]) -> Mapping[str, object]:
    """Return what would do, in groups, with what was varied; empty if nothing is NG."""
    if package.assessment.verdict.is_permitted:
        return {}
    printed = _printed(package.assessment, remedies)
    # Of a clearance all arrays together; what is of none, each array by itself.
    ways = grouped_by(printed, lambda answer: answer.remedy.clearance or answer.remedy.array)
    each = [_group(package, group) for group in ways.values()]
    # Clearances that nothing satisfies, for the same reasons, together.
    groups = grouped_by(
        each, lambda of: tuple(of["in_vain"]) if of["gap"] and not of["ways"] else id(of)
    )
    return {
        "groups": list(groups.values()),
        "told": sum(bool(of["number"]) for of in each),
        "bases": dict.fromkeys(
            (remedy.kind.value, remedy.basis)
            for remedy in remedies
            if remedy.exists and remedy.kind is RemedyKind.FRICTION
        ),
        "attachment": attachment(package.assessment),
    }


def best_words(assessment: Assessment, *, may_run: bool = True) -> str:
    """Return the best remedy of what is NG in a sentence, and what comes of it; empty if none."""
    way = _printed(assessment, best_remedy(assessment, may_run=may_run))
    return sentence(TEMPLATES, "remedy", way) if way else attachment(assessment)


def _printed(assessment: Assessment, remedies: Sequence[Remedy]) -> list[PrintedRemedy]:
    return [_answer(assessment, remedy) for remedy in remedies]


def _answer(assessment: Assessment, remedy: Remedy) -> PrintedRemedy:
    entered, value, us_first = remedy.given, remedy.value, assessment.project.us_first
    if remedy.kind is RemedyKind.FRICTION:
        array = next(array for array in assessment.project.arrays if array.id == remedy.array)
        # Where no coefficient does there is no value to print.
        mus = (entered, value) if remedy.exists else (entered, entered)
        texts = [mu_words(with_mu(array, mu).friction) for mu in mus]
    else:
        # As the clearances print them; two design displacements are compared with nothing.
        units = Quantity.SIZE, us_first
        texts = [pair(length_m, *units, no_less) for length_m in (entered, value)]
        if remedy.kind is RemedyKind.SEPARATION:
            texts = [*compared_pairs(capacity(entered), demand(value), *units)]
    return PrintedRemedy(
        remedy=remedy,
        given=texts[0],
        value=texts[1] if remedy.exists else "",
        outcome=remedy.outcome.words(us_first) if remedy.outcome else "",
    )


def _group(package: PackageData, group: Sequence[PrintedRemedy]) -> Mapping[str, Any]:
    """Return the ways to satisfy a clearance, or to give an array final values, each by itself."""
    first = group[0].remedy
    frictions = [answer for answer in group if answer.remedy.kind is RemedyKind.FRICTION]
    others = [[answer] for answer in group if answer.remedy.kind is not RemedyKind.FRICTION]
    return {
        "number": first.clearance,
        "gap": package.assessment.clearances[first.clearance - 1] if first.clearance else None,
        "array": first.array,
        "is_review": first.kind is RemedyKind.REVIEW,
        # The arrays beside a clearance that each need more friction satisfy it only together: they
        # are one way, and none where one of them has no value.
        "ways": [
            way for way in (frictions, *others) if way and all(answer.outcome for answer in way)
        ],
        "in_vain": sorted(
            {
                (answer.remedy.kind.value, answer.remedy.basis)
                for answer in group
                if not answer.value
            }
        ),
    }


_COLUMNS = ("array", "computed", "prescriptive", "design", "governing clearance to", "D/C", "")


@dataclass(frozen=True, slots=True)
class Concern:
    """Something that needs attention: its weight (NG, condition, warning) and what it is."""

    level: str
    text: str


def summary(assessment: Assessment) -> Iterator[str]:
    """Yield the table of the arrays, what needs attention, and the verdict."""
    # A terminal has no note at its foot that would say what a dagger means.
    marked = Marked(assessment=assessment, has_daggers=False)
    rows = [_COLUMNS, *(_row(marked.fmt, item) for item in array_results(marked))]
    # Without motions nothing is computed: a column of nones would look like a failure.
    if not assessment.has_motions:
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
    """Return the same for JSON, with units in the keys and null for no value."""
    return {
        "verdict": assessment.verdict.value,
        "arrays": [_array(assessment, item) for item in assessment.arrays],
        "attention": [{"level": line.level, "text": line.text} for line in attention(assessment)],
    }


def _array(assessment: Assessment, item: ArrayAssessment) -> dict[str, Any]:
    gap = assessment.governing_gap(item.id)
    return {
        "id": item.id,
        # JSON has no NaN.
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
    # The verdict with a remedy depends on less friction as well.
    is_whole = assessment.at_reduced_friction is not None
    if is_whole and (best := best_words(assessment, may_run=may_run)):
        yield Concern("remedy", best)
    for row, ids in assessment.alike_conditions:
        # The others are among the reasons above.
        if row.verdict.is_permitted:
            yield Concern(row.consequence.value, row_words(row, ids))
    if not assessment.has_motions:
        yield Concern(Consequence.NOTE.value, without_motions(assessment))
    for row in assessment.notes:
        yield Concern(row.consequence.value, row_words(row, [row.subject]))
    listed = findings(assessment.sheet, assessment.shaking)
    for line in lines(listed, assessment.sheet.addresses):
        if line.finding.level is Level.WARNING:
            reason = line.finding.reason
            answer = f" Acknowledged: {reason}" if reason else ""
            yield Concern("warning", f"{line.cells}: {line.finding.text} [{line.names}]{answer}")
