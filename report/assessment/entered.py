"""A project with a change, as an engineer would enter it: refused as by `check`, or assessed.

Read `entered`.
"""

from __future__ import annotations

from typing import Any

from report.assessment.project import Assessment, assess
from report.sheet.checking.checks import faults
from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.fields import Draft, Finding


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
