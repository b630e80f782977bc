"""The sections of study.pdf, in order. Read `sections`, then `report.study.curves`."""

from __future__ import annotations

from report.document.sections import Section
from report.study.allowed import allowed
from report.study.array_page import fragility
from report.study.basis import basis, limits
from report.study.curves import curves
from report.study.formula import formula
from report.study.prescribed import compare
from report.study.prescribed_page import prescribed
from report.study.results import StudyResults
from report.study.words import headline


def sections(results: StudyResults) -> tuple[Section, ...]:
    """Return all sections except the cover and the contents."""
    allowed_m = results.plan.input.study.allowed_m
    first = Section(
        id="results",
        title="Results",
        template="study/results.html",
        content={"headline": headline(results)},
    )
    found = [first, basis(results)]
    for b in range(len(results.plan.motions.buildings)):
        found.append(curves(results, b))
        if allowed_m:
            found.append(allowed(results, b, allowed_m))
        found.append(formula(results, b))
        found += [prescribed(results, b, one) for one in compare(results, b)]
    found += [fragility(results, one) for one in results.arrays]
    return (*found, limits(results))
