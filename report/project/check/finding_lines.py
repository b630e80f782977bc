"""Findings and errors as lines: in the order of the workbook, equal ones together, with reasons."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from report.project.model import ProjectInput
from report.project.model.choices import FORMER_CHOICES
from report.project.model.finding import Finding, note
from report.project.model.input_rows import Place, suggestion
from report.project.workbook import SECTIONS
from solver.errors import Problem


def in_order(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template."""
    return tuple(
        sorted(findings, key=lambda finding: (_ORDER[finding.place.section], finding.place.row))
    )


def located(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[str]:
    """Yield the address of each finding: its cells, or else its table or sheet."""
    for finding in findings:
        place = finding.place
        table = addresses.get(Place(place.section), _SHEETS[place.section])
        cells = (addresses.get(cell_place, table) for cell_place in (place, *finding.others))
        yield finding.cell or listed(cells, _MOST_CELLS)


def lines(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[Finding]:
    """Yield findings in order; equal ones once, with the first few of their cells and ids."""
    all_findings = tuple(findings)
    alike: dict[tuple[str, ...], list[tuple[Finding, str]]] = {}
    for finding, cell in zip(all_findings, located(all_findings, addresses), strict=True):
        has_id = "id" if finding.id else ""
        key = (finding.level, finding.place.section, finding.text, finding.reason, has_id)
        alike.setdefault(key, []).append((finding, cell))
    for group in alike.values():
        cells, names = listed(cell for _, cell in group), listed(finding.id for finding, _ in group)
        yield replace(group[0][0], cell=cells, id=names)


_MOST_CELLS = 4  # of one finding
_SHEETS = {section.key: section.sheet for section in SECTIONS}
_ORDER = {section.key: count for count, section in enumerate(SECTIONS)}


# Cells and ids named of equal errors and findings.
MOST_LISTED = 3


def grouped(problems: Iterable[Problem]) -> Iterable[Sequence[Problem]]:
    """Return problems in order; equal ones of a sheet together, where the first is."""
    alike: dict[tuple[str, str, int], list[Problem]] = {}
    for number, problem in enumerate(problems):
        sheet, has_cell, _ = problem.where.rpartition("!")
        # Without a cell nothing but its own line tells a problem: none is left out.
        alike.setdefault((sheet, problem.text, 0 if has_cell else number), []).append(problem)
    return alike.values()


def line_of(equal: Sequence[Problem]) -> str:
    """Return equal problems as one line, with their cells."""
    return str(replace(equal[0], where=listed(problem.where for problem in equal)))


def listed(names: Iterable[str], limit: int = MOST_LISTED) -> str:
    """Return the first few of the names, with the count of the others."""
    unique = list(dict.fromkeys(names))
    n_more = len(unique) - limit
    return ", ".join(unique[:limit]) + (f" and {n_more:,} more" if n_more > 0 else "")


def acknowledged(data: ProjectInput, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template, each with the reason in the workbook."""
    all_findings = tuple(findings)
    reasons = {_key(row.warning): row.reason for row in data.acknowledged}
    answered = [
        replace(f, reason=reasons.get(_key(f.id), "") if f.id else "") for f in all_findings
    ]
    # An acknowledgment of no warning is a note.
    return in_order([*answered, *_idle(data, all_findings)])


def _key(name: str) -> str:
    *words, last = name.casefold().split()
    # The direction of a clearance, also by its word in earlier workbooks.
    return " ".join([*words, FORMER_CHOICES.get(last, last)])


def _idle(data: ProjectInput, findings: Iterable[Finding]) -> Iterator[Finding]:
    ids = [finding.id for finding in findings if finding.id]
    known = {_key(name) for name in ids}
    for index, row in enumerate(data.acknowledged):
        if _key(row.warning) not in known:
            text = f"warning is '{row.warning}', which is not among the warnings; "
            text += suggestion(row.warning, ids) if ids else "delete the row"
            yield note(Place("acknowledged", index, "warning"), text)
