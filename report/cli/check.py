"""The command `roofslip check`: everything that is known of a project before any run.

Parses, calls, prints. Read `report.assessment.foresight`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.cli.terminal import AS_JSON, QUIET, SCHEMA_VERSION, input_errors

if TYPE_CHECKING:
    from report.motions.prepare import Shaking
    from report.sheet.findings import Finding
    from report.sheet.read import Sheet


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=click.Path(path_type=Path))
@QUIET
@AS_JSON
def check(source: Path, quiet: bool, as_json: bool) -> None:
    """Check the input, and print what is known without a run; write nothing.

    An error stops the work. A warning may be intended: give its name, printed in brackets, and a
    reason on the sheet Acknowledged. A warning without a name is a limit that is not satisfied. A
    note needs no answer.
    """
    with input_errors(source, as_json=as_json):
        sheet, shaking, found = checked(source)
    if as_json:
        click.echo(json.dumps(_document(sheet, found), ensure_ascii=False))
    elif not quiet:
        click.echo(_summary(sheet, shaking, found))
        for line in lines(sheet, found):
            click.echo(line)


def checked(source: Path) -> tuple[Sheet, Shaking, tuple[Finding, ...]]:
    """Return a workbook with its motions, and every finding in the order of the template.

    Raises
    ------
    InputError
    """
    from report.assessment.foresight import findings, foreseen
    from report.motions.prepare import prepare
    from report.sheet.findings import in_order
    from report.sheet.read import read
    from report.typeset.letters import check_letters

    sheet = read(source)
    check_letters(sheet)
    shaking = prepare(sheet)
    return sheet, shaking, in_order([*foreseen(sheet, shaking), *findings(sheet, shaking)])


def lines(sheet: Sheet, found: Iterable[Finding]) -> Iterator[str]:
    """Yield each finding as a line: level, cell, what was found, the name of a warning."""
    from report.sheet.findings import located

    found = tuple(found)
    for finding, cell in zip(found, located(found, sheet.addresses), strict=True):
        name = f" [{finding.id}]" if finding.id else ""
        answered = f" Acknowledged: {finding.reason}" if finding.reason else ""
        yield f"{finding.level}: {cell}: {finding.text}{name}{answered}"


def as_data(sheet: Sheet, found: Iterable[Finding]) -> list[Mapping[str, str]]:
    """Return findings for JSON."""
    from report.sheet.findings import located

    found = tuple(found)
    return [
        {
            "level": finding.level.value,
            "id": finding.id,
            "cell": cell,
            "text": finding.text,
            "reason": finding.reason,
        }
        for finding, cell in zip(found, located(found, sheet.addresses), strict=True)
    ]


def _document(sheet: Sheet, found: Iterable[Finding]) -> Mapping[str, Any]:
    data = sheet.project
    return {
        "schema_version": SCHEMA_VERSION,
        "workbook": str(sheet.path),
        "errors": [],
        "findings": as_data(sheet, found),
        "arrays": len(data.arrays),
        "clearances": len(data.clearances),
        "motions": len(data.motions),
        "s_ds_g": data.site.s_ds,
        "rule_set": data.site.rule_set.value,
    }


def _summary(sheet: Sheet, shaking: Shaking, found: Iterable[Finding]) -> str:
    from report.sheet.findings import Level

    data = sheet.project
    levels = [finding.level for finding in found]
    counts = ", ".join(
        f"{count} {level}{'s' if count > 1 else ''}"
        for level in Level
        if (count := levels.count(level))
    )
    return (
        f"{sheet.path}: {f'no errors, {counts}' if counts else 'no problems found'}. "
        f"{len(data.arrays)} arrays, {len(data.clearances)} clearances, "
        f"{len(shaking.motions)} motions, S_DS {data.site.s_ds:.3f} g, {data.site.rule_set}."
    )
