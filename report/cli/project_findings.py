"""Every finding on a project that is known before any run. Read `findings_before_runs`."""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import click

from report.assessment.precheck import findings, limits_before_runs, missing_clearances
from report.cli.console import print_json, say
from report.cli.input_errors import document
from report.motions.prepare import Shaking, prepare
from report.project.check.finding_lines import in_order
from report.project.check.finding_lines import lines as finding_lines
from report.project.model.finding import Finding, Level, note
from report.project.model.input_rows import Place
from report.project.read.workbook_data import Sheet
from report.project.workbook import SECTION
from report.project.write.overwritten import formula_findings, overwritten
from report.results.added_motions import other_sources
from report.text.command_line import command
from report.text.counts import numbered
from report.typeset.letters import check_letters


def findings_before_runs(
    sheet: Sheet, progress: Callable[[str], None] = lambda _: None
) -> tuple[Shaking, tuple[Finding, ...]]:
    """Return the motions of a workbook, and every finding in the order of the template."""
    # A letter that the font of the package lacks is an error of the input, found before any run.
    check_letters(sheet)
    progress("reading the records")
    motions = prepare(sheet)
    progress("comparing with the limits")
    all_findings = [
        *formula_findings(overwritten(sheet.book)),
        *limits_before_runs(sheet.project, motions),
        *missing_clearances(sheet),
        *other_sources(sheet),
        *findings(sheet.source, sheet.project, motions),
    ]
    if not motions.motions:
        # Only here: with motions, nothing is assessed, and a check takes 0.4 s less without these.
        from report.assessment.assess import assess
        from report.pages.saving import without_analysis

        # Nothing is run, so that the assessment is at hand before the report.
        all_findings.append(note(Place("motions"), without_analysis(assess(sheet, motions))))
    all_findings += _computed(sheet)
    # Only here the clock is read: a package of the same input is to be the same on any day.
    date, today = sheet.project.project.date, dt.date.today()
    if date > today:
        text = f"date is {date}, after today, {today}; correct it if this is not intended"
        all_findings.append(note(Place("project", 0, "date"), text))
    return motions, in_order(all_findings)


def _computed(sheet: Sheet) -> Iterator[Finding]:
    """Yield the values that replace blank cells of the site, and their rule."""
    site = SECTION["site"]
    blank = {row.address: row.value for row in sheet.echo if not row.typed}
    for entry in site.entries:
        if not entry.rule:
            continue
        place = Place("site", 0, entry.name)
        value = blank.get(sheet.addresses[place], "")
        if "(computed" in value:
            yield note(place, f"{entry.spoken} is {value}")


def print_findings(
    source: Path,
    sheet: Sheet,
    motions: Shaking,
    all_findings: Sequence[Finding],
    *,
    as_json: bool,
) -> None:
    """Print a summary and each finding, or all as JSON."""
    if as_json:
        print_json(_document(sheet, all_findings))
        return
    click.echo(_summary(sheet, motions, all_findings))
    for line in lines(sheet, all_findings):
        say(line)
    click.echo(f"Next: {command('report', source)}")


def lines(sheet: Sheet, all_findings: Iterable[Finding]) -> Iterator[str]:
    """Yield findings as lines: level, cells, what was found, the names of warnings."""
    for finding in finding_lines(all_findings, sheet.addresses):
        name = f" [{finding.id}]" if finding.id else ""
        answer = f" Acknowledged: {finding.reason}" if finding.reason else ""
        yield f"{finding.level}: {finding.cell}: {finding.text}{name}{answer}"


def _document(sheet: Sheet, all_findings: Iterable[Finding]) -> dict[str, Any]:
    # Only here: the models of the results take 0.25 s, and of a check JSON alone needs them.
    from report.results.rows import finding_results

    project = sheet.project
    rows = finding_results(all_findings, sheet.addresses)
    return document(sheet.path) | {
        "findings": [row.model_dump(mode="json") for row in rows],
        "arrays": len(project.arrays),
        "clearances": len(project.clearances),
        "motions": len(project.motions),
        "s_ds_g": project.site.s_ds,
        "rule_set": project.site.rule_set.value,
    }


def _summary(sheet: Sheet, motions: Shaking, all_findings: Iterable[Finding]) -> str:
    project = sheet.project
    levels = [finding.level for finding in all_findings]
    counts = [numbered(levels.count(level), level) for level in Level if level in levels]
    errors = f"no errors, {', '.join(counts)}" if counts else "no errors"
    return (
        f"{sheet.path}: {errors}. "
        f"{len(project.arrays)} arrays, {len(project.clearances)} clearances, "
        f"{len(motions.motions)} motions, S_DS {project.site.s_ds:.3f} g, {project.site.rule_set}."
    )
