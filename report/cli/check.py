"""The command `roofslip check`: everything that is known of a project before any run.

Parses, calls, prints. Read `report.assessment.precheck`.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.cli.terminal import (
    AS_JSON,
    QUIET,
    SOURCE,
    Progress,
    document,
    input_errors,
    print_json,
    say,
)
from report.text.counts import command, numbered

if TYPE_CHECKING:
    from report.motions.prepare import Shaking
    from report.project.model.finding import Finding
    from report.project.read.workbook_data import Sheet


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@QUIET
@AS_JSON
def check(source: Path, quiet: bool, as_json: bool) -> None:
    """Check the input, and print what is known without a run; write nothing.

    An error stops the work. A warning may be intended: give its name, printed in brackets, and a
    reason on the sheet Acknowledged. A warning without a name is a limit that is not satisfied, a
    formula of the sheet that was typed over, or a source other than that in suite.json. A note
    needs no answer.
    """
    with (
        input_errors(source, as_json=as_json),
        Progress(3, quiet=quiet or as_json) as progress,
    ):
        sheet, shaking, findings = checked(source, progress)
    if as_json:
        print_json(_document(sheet, findings))
    elif not quiet:
        click.echo(_summary(sheet, shaking, findings))
        for line in lines(sheet, findings):
            say(line)
        click.echo(f"Next: {command('report', source)}")


def checked(
    source: Path, progress: Callable[[str], None] = lambda _: None
) -> tuple[Sheet, Shaking, tuple[Finding, ...]]:
    """Return a workbook with its motions, and every finding in the order of the template."""
    from report.project.read.read import read

    progress("reading the workbook")
    sheet = read(source)
    # An error in the workbook does not wait for what reads records.
    from report.assessment.precheck import findings, limits_before_runs, missing_clearances
    from report.motions.prepare import prepare
    from report.project.check.finding_lines import in_order
    from report.project.write.overwritten import formula_findings, overwritten
    from report.results.motions import other_sources
    from report.typeset.letters import check_letters

    # A letter that the font of the package lacks is an error of the input, found before any run.
    check_letters(sheet)
    progress("reading the records")
    shaking = prepare(sheet)
    progress("comparing with the limits")
    told = [
        *formula_findings(overwritten(sheet.book)),
        *limits_before_runs(sheet.project, shaking),
        *missing_clearances(sheet),
        *other_sources(sheet),
        *findings(sheet, shaking),
        *_without_motions(sheet, shaking),
        *_computed(sheet),
        # Only here the clock is read: a package of the same input is to be the same on any day.
        *_in_future(sheet, dt.date.today()),
    ]
    return sheet, shaking, in_order(told)


def _without_motions(sheet: Sheet, shaking: Shaking) -> Iterator[Finding]:
    """Yield what is made of a workbook without motions."""
    if shaking.motions:
        return
    from report.assessment.assess import assess
    from report.pages.saving import without_analysis
    from report.project.model.finding import note
    from report.project.model.place import Place

    # Without motions nothing is run, so that the assessment is at hand before the report.
    yield note(Place("motions"), without_analysis(assess(sheet, shaking)))


def _computed(sheet: Sheet) -> Iterator[Finding]:
    """Yield what blank cells of the site stand for, by which rule."""
    from report.project.model.finding import note
    from report.project.model.place import Place
    from report.project.workbook import SECTION

    site = SECTION["site"]
    blank = {row.address: row.value for row in sheet.echo if not row.typed}
    for name in (entry.name for entry in site.entries if entry.rule):
        place = Place("site", 0, name)
        value = blank.get(sheet.addresses[place], "")
        if "(computed" in value:
            yield note(place, f"{site.entry(name).spoken} is {value}")


def _in_future(sheet: Sheet, today: dt.date) -> Iterator[Finding]:
    """Yield that a package is dated after today."""
    from report.project.model.finding import note
    from report.project.model.place import Place

    date = sheet.project.project.date
    if date > today:
        text = f"date is {date}, after today, {today}; correct it if that is not intended"
        yield note(Place("project", 0, "date"), text)


def lines(sheet: Sheet, listed: Iterable[Finding]) -> Iterator[str]:
    """Yield findings as lines: level, cells, what was found, the names of warnings."""
    from report.project.check import finding_lines

    for finding in finding_lines.lines(listed, sheet.addresses):
        name = f" [{finding.id}]" if finding.id else ""
        answered = f" Acknowledged: {finding.reason}" if finding.reason else ""
        yield f"{finding.level}: {finding.cell}: {finding.text}{name}{answered}"


def _document(sheet: Sheet, findings: Iterable[Finding]) -> dict[str, Any]:
    from report.results.rows import finding_results

    data, rows = sheet.project, finding_results(findings, sheet.addresses)
    return document(sheet.path) | {
        "findings": [row.model_dump(mode="json") for row in rows],
        "arrays": len(data.arrays),
        "clearances": len(data.clearances),
        "motions": len(data.motions),
        "s_ds_g": data.site.s_ds,
        "rule_set": data.site.rule_set.value,
    }


def _summary(sheet: Sheet, shaking: Shaking, findings: Iterable[Finding]) -> str:
    from report.project.model.finding import Level

    data = sheet.project
    levels = [finding.level for finding in findings]
    counts = ", ".join(numbered(count, level) for level in Level if (count := levels.count(level)))
    return (
        f"{sheet.path}: {f'no errors, {counts}' if counts else 'no problems found'}. "
        f"{len(data.arrays)} arrays, {len(data.clearances)} clearances, "
        f"{len(shaking.motions)} motions, S_DS {data.site.s_ds:.3f} g, {data.site.rule_set}."
    )
