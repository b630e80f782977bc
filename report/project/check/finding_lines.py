"""Findings in the order of the workbook, with addresses; equal ones of several cells are one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from report.project.check.problem_lines import listed
from report.project.model.finding import Finding
from report.project.model.place import Place
from report.project.workbook import SECTIONS


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
