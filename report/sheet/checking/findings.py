"""Warnings on the input, which an engineer may answer with a reason, and notes.

Owns ids and acknowledgments. Read `report.sheet.checking.plausible` next.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from report.sheet.checking.drafts import suggestion
from report.sheet.checking.grouped import listed
from report.sheet.schema import SECTIONS, ProjectInput
from report.sheet.schema.fields import Finding, Level, Place


def warning(name: str, place: Place, text: str) -> Finding:
    """Return a warning that may be acknowledged."""
    return Finding(level=Level.WARNING, id=name, place=place, text=text)


def limit(text: str, place: Place, *others: Place) -> Finding:
    """Return a warning that cannot be acknowledged, with the cells to look at."""
    return Finding(level=Level.WARNING, place=place, others=others, text=text)


def note(place: Place, text: str) -> Finding:
    """Return a note."""
    return Finding(level=Level.NOTE, place=place, text=text)


def acknowledged(data: ProjectInput, findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template, each with the reason that the sheet gives.

    An acknowledgment of no warning is a note.
    """
    found = tuple(findings)
    reasons = {_key(row.warning): row.reason for row in data.acknowledged}
    answered = [replace(f, reason=reasons.get(_key(f.id), "") if f.id else "") for f in found]
    return in_order([*answered, *_idle(data, found)])


def in_order(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings in the order of the template."""
    return tuple(sorted(findings, key=lambda one: (_ORDER[one.place.section], one.place.row)))


def located(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[str]:
    """Yield the address of each finding: its cells, or else its table or sheet."""
    for finding in findings:
        place = finding.place
        table = addresses.get(Place(place.section), _SHEETS[place.section])
        cells = (addresses.get(each, table) for each in (place, *finding.others))
        yield finding.cell or listed(cells, _MOST_CELLS)


@dataclass(frozen=True, slots=True, kw_only=True)
class FindingGroup:
    """Findings that differ only in their cells and ids, printed as one."""

    finding: Finding  # the first of them
    cells: str  # the first few addresses, with the count of the others
    names: str  # the same of their ids; empty if there are none


def lines(findings: Iterable[Finding], addresses: Mapping[Place, str]) -> Iterator[FindingGroup]:
    """Yield findings with their cells, in order; equal ones once, at the place of the first."""
    found = tuple(findings)
    alike: dict[tuple[str, ...], list[tuple[Finding, str]]] = {}
    for finding, cell in zip(found, located(found, addresses), strict=True):
        has_id = "id" if finding.id else ""
        key = (finding.level, finding.place.section, finding.text, finding.reason, has_id)
        alike.setdefault(key, []).append((finding, cell))
    for group in alike.values():
        cells, names = listed(cell for _, cell in group), listed(one.id for one, _ in group)
        yield FindingGroup(finding=group[0][0], cells=cells, names=names)


_MOST_CELLS = 4  # of one finding
_SHEETS = {section.key: section.sheet for section in SECTIONS}
_ORDER = {section.key: count for count, section in enumerate(SECTIONS)}


def _key(name: str) -> str:
    return " ".join(name.split()).casefold()


def _idle(data: ProjectInput, found: Iterable[Finding]) -> Iterator[Finding]:
    given = [finding.id for finding in found if finding.id]
    known = {_key(name) for name in given}
    for index, row in enumerate(data.acknowledged):
        if _key(row.warning) not in known:
            text = f"warning is '{row.warning}', which is not given; "
            text += suggestion(row.warning, given) if given else "delete the row"
            yield note(Place("acknowledged", index, "warning"), text)
