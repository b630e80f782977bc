"""What `roofslip report` prints of an assessment: a line for each array, then what needs attention.

Finished lines; computes nothing. Read `summary`.

What would satisfy each clearance and array marked NG, in sentences.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from report.assessment.assessment import Assessment
from report.assessment.causes import causes, unshown_cause
from report.assessment.checks.alike import alike, subjects
from report.assessment.checks.sentence import sentence
from report.assessment.design.routes import NOT_PERMITTED
from report.assessment.design.rule_set import MEANING
from report.assessment.design.verdict import Verdict
from report.assessment.precheck import findings
from report.assessment.remedies.remedies import MOST, Remedies, remedies
from report.assessment.support.saving import saving
from report.document.templates import sentence as of_template
from report.pages.array_tables import governing_name, ratio_words
from report.pages.marks import Marked
from report.project.check.finding_lines import lines
from report.project.model.finding import Level
from report.text.counts import capitalized, grouped_by
from report.text.formats import aligned, finite
from report.text.units import no_less
from report.typeset.pdf import TEMPLATES
from solver.rules.limit import Consequence

if TYPE_CHECKING:
    from report.assessment.assessment import Assessment
    from report.assessment.design.arrays import ArrayAssessment


def remedy_lines(assessment: Assessment, found: Remedies) -> Iterator[str]:
    """Yield the set of changes that is enough, then what would satisfy each check that is NG."""
    if len(found.together) > 1:
        yield found.sentence
    for checks, own in grouped_by(found.own, lambda remedy: remedy.checks).items():
        titles = grouped_by(checks, lambda check: check.title)
        names = (", ".join(filter(None, (title, subjects(of)))) for title, of in titles.items())
        yield f"{'; '.join(names)}: {' '.join(each.sentence for each in own)}"
    failed = sum(check.verdict is Verdict.NG for check in assessment.checks)
    if found.own and failed > MOST:
        yield f"Searched for the {MOST} with the largest ratio of {failed} that are NG."
    if found.own and not found.together:
        yield "No set of these changes is enough."
    if assessment.has_motions and (lacks := without_analysis(assessment)):
        yield f"{capitalized(lacks)}"


_COLUMNS = ("array", "computed", "prescriptive", "design", "governing clearance to", "D/C", "")


def summary(assessment: Assessment) -> Iterator[str]:
    """Yield the table of the arrays, what needs attention, and the verdict."""
    # A terminal has no note at its foot that would say what a dagger means.
    marked = Marked(assessment=assessment, has_daggers=False)
    rows = [_COLUMNS, *(_row(marked, item) for item in assessment.arrays)]
    # Without motions nothing is computed: a column of nones would look like a failure.
    if not assessment.has_motions:
        rows = [(id, *others) for id, _, *others in rows]
    yield from aligned(rows)
    if assessment.is_overridden:
        yield MEANING
    for level, text in attention(assessment):
        yield f"{level}: {text}"
    gap = assessment.governing_gap()
    largest = f", largest D/C {gap.ratio_words}" if gap and not math.isnan(gap.required_m) else ""
    yield f"verdict: {assessment.verdict.value}{largest}"


def without_analysis(assessment: Assessment) -> str:
    """Return what arrays take for lack of motions, and what an analysis could save; or nothing."""
    found = saving(assessment)
    if assessment.has_motions and not found.ids:
        return ""
    marked = Marked(assessment=assessment, has_daggers=False)
    return of_template(TEMPLATES, "without_analysis", found, package=marked)


def document(assessment: Assessment) -> dict[str, Any]:
    """Return the same for JSON, with units in the keys and null for no value."""
    return {
        "verdict": assessment.verdict.value,
        "arrays": [_array(assessment, item) for item in assessment.arrays],
        "attention": [{"level": level, "text": text} for level, text in attention(assessment)],
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
        "causes": causes(assessment, item),
    }


def _row(marked: Marked, item: ArrayAssessment) -> tuple[str, ...]:
    done, cause = marked.assessment, unshown_cause(marked.assessment, item)
    prescriptive_m = item.prescriptive.value_m
    both = partial(marked.fmt.both, show=no_less)
    refused = f", {NOT_PERMITTED}" if item.has_unpermitted_value else ""
    return (
        item.id,
        both(item.analysis.value_m, mark=item.overridden.analysis),
        both(prescriptive_m, mark=marked.prescriptive_mark(item)),
        both(item.design_m, mark=marked.design_mark(item)) + refused,
        governing_name(done, item),
        ratio_words(done, item),
        done.array_verdict(item) + (f": {cause}" if cause else ""),
    )


def attention(assessment: Assessment, *, may_run: bool = True) -> Iterator[tuple[str, str]]:
    """Yield what is not satisfied, NG first, and what would do, with runs or not; each its level.

    Levels are NG, remedy, condition, note and warning.
    """
    us_first, is_best_due = assessment.project.us_first, assessment.at_reduced_friction is not None
    failed = [check for check in assessment.open if not check.verdict.is_permitted]
    for check in failed:
        yield Consequence.NG.value, sentence(check, us_first)
    # The verdict with a remedy depends on less friction as well.
    if is_best_due and (found := remedies(assessment, may_run=may_run)).together:
        yield "remedy", found.sentence
    for check in assessment.open[len(failed) :]:
        yield check.consequence.value, sentence(check, us_first)
    if lacks := without_analysis(assessment):
        yield Consequence.NOTE.value, lacks
    for check in alike(assessment.notes):
        yield Consequence.NOTE.value, sentence(check, us_first)
    listed = findings(assessment.sheet, assessment.shaking)
    for line in lines(listed, assessment.sheet.addresses):
        if line.level is Level.WARNING:
            answer = f" Acknowledged: {line.reason}" if line.reason else ""
            yield "warning", f"{line.cell}: {line.text} [{line.id}]{answer}"
