"""What would satisfy each clearance and array marked NG, in sentences."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from report.assessment.friction import mu_words
from report.assessment.project import Assessment
from report.assessment.remedies import Remedy, RemedyKind, best_remedy
from report.assessment.trials import with_mu
from report.document.templates import sentence
from report.pages.parts import PackageData
from report.pages.site import attachment
from report.typeset.pdf import TEMPLATES
from report.words.counts import grouped_by
from report.words.units import Quantity, beside, no_less, pair


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
    found = _printed(package.assessment, remedies)
    # Of a clearance all arrays together; what is of none, each array by itself.
    groups = grouped_by(found, lambda one: one.remedy.clearance or one.remedy.array)
    return {
        "groups": [_group(package, group) for group in groups.values()],
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
    given, value, us_first = remedy.given, remedy.value, assessment.project.us_first
    if remedy.kind is RemedyKind.FRICTION:
        array = next(array for array in assessment.project.arrays if array.id == remedy.array)
        mus = (given, value) if remedy.exists else (given, given)
        texts = [mu_words(with_mu(array, mu).friction) for mu in mus]
    else:
        # As the clearances print them.
        had = no_less if remedy.kind is RemedyKind.REVIEW else beside(value, given)
        shows = ((given, had), (value, no_less))
        texts = [pair(length_m, Quantity.SIZE, us_first, show) for length_m, show in shows]
    return PrintedRemedy(
        remedy=remedy,
        given=texts[0],
        value=texts[1] if remedy.exists else "",
        outcome=remedy.outcome.words(us_first) if remedy.outcome else "",
    )


def _group(package: PackageData, group: Sequence[PrintedRemedy]) -> Mapping[str, object]:
    """Return the ways to satisfy a clearance, or to give an array final values, each by itself."""
    first = group[0].remedy
    frictions = [one for one in group if one.remedy.kind is RemedyKind.FRICTION]
    others = [[one] for one in group if one.remedy.kind is not RemedyKind.FRICTION]
    return {
        "number": first.clearance,
        "gap": package.assessment.clearances[first.clearance - 1] if first.clearance else None,
        "array": first.array,
        "is_review": first.kind is RemedyKind.REVIEW,
        "ways": [way for way in (frictions, *others) if way and all(one.outcome for one in way)],
        "in_vain": sorted(
            {(one.remedy.kind.value, one.remedy.basis) for one in group if not one.value}
        ),
    }
