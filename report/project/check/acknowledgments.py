"""Warnings that the Acknowledged worksheet answers with a reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from report.project.check.finding_lines import in_order
from report.project.check.input_columns import suggestion
from report.project.model import ProjectInput
from report.project.model.finding import Finding, note
from report.project.model.place import Place


def acknowledged(data: ProjectInput, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template, each with the reason that the sheet gives."""
    all_findings = tuple(findings)
    reasons = {_key(row.warning): row.reason for row in data.acknowledged}
    answered = [
        replace(f, reason=reasons.get(_key(f.id), "") if f.id else "") for f in all_findings
    ]
    # An acknowledgment of no warning is a note.
    return in_order([*answered, *_idle(data, all_findings)])


def _key(name: str) -> str:
    return " ".join(name.split()).casefold()


def _idle(data: ProjectInput, findings: Iterable[Finding]) -> Iterator[Finding]:
    ids = [finding.id for finding in findings if finding.id]
    known = {_key(name) for name in ids}
    for index, row in enumerate(data.acknowledged):
        if _key(row.warning) not in known:
            text = f"warning is '{row.warning}', which is not entered; "
            text += suggestion(row.warning, ids) if ids else "delete the row"
            yield note(Place("acknowledged", index, "warning"), text)
