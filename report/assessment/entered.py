"""A project with a change, as an engineer would enter it: refused as by `check`, or assessed.

Read `entered`, then `Outcome`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from report.assessment.causes import reasons
from report.assessment.neighbors import ComparedGap
from report.assessment.project import Assessment, assess
from report.assessment.verdict import Verdict
from report.sheet.checking.checks import faults
from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.fields import Draft, Finding
from report.words.units import Quantity, beside, no_less


def refused(given: ProjectInput, changed: ProjectInput) -> list[Finding]:
    """Return what `check` refuses of a changed input and not of the one given."""
    before = _faults(given)
    return [fault for fault in _faults(changed) if fault not in before]


def changed(given: ProjectInput, **sections: Any) -> ProjectInput:
    """Return an input with other sections."""
    return ProjectInput(**(dict(given) | sections))


def entered(given: Assessment, project: ProjectInput) -> Assessment | None:
    """Assess a changed input under the same motions; None where `check` would refuse it."""
    if refused(given.project, project):
        return None
    return assess(given.sheet, given.shaking, given, project)


def _faults(data: ProjectInput) -> list[Finding]:
    draft: Draft = {
        part.key: [dict(row) for row in (rows if part.is_table else (rows,))]
        for part in SECTIONS
        for rows in (getattr(data, part.key),)
    }
    return faults(draft, lambda place: place.section)


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What a change of the input gives: the verdict on the project and its governing clearance."""

    verdict: Verdict
    gap: ComparedGap | None
    reason: str  # of an NG that the governing clearance does not show

    def words(self, us_first: bool) -> str:
        """Return it in a few words, such as `NG, A3 to RTU-2 60.4 > 60.0 in`."""
        words = self.verdict.value
        if self.reason:
            return f"{words}, {self.reason}"
        if self.gap is None:
            return words
        required_m, had_m = self.gap.required_m, self.gap.provided_m
        unit = Quantity.SIZE.value[0 if us_first else 1]
        required, had = no_less(required_m, unit), beside(required_m, had_m)(had_m, unit)
        names, sign = " to ".join(self.gap.between), "≤" if required_m <= had_m else ">"
        return f"{words}, {names} {required}{self.gap.mark} {sign} {had} {unit.symbol}"


def outcome(assessment: Assessment | None) -> Outcome | None:
    """Return what an assessment comes to, if there is one."""
    if assessment is None:
        return None
    gap = assessment.governing_gap()
    is_shown = gap is not None and gap.demand_capacity > 1.0
    reason = "" if is_shown else next(reasons(assessment), "").rstrip(".")
    return Outcome(verdict=assessment.verdict, gap=gap, reason=reason)
