"""The commands on a project: `roofslip new`, `check` and `report`.

Read `make` first: one line for each step from workbook to package.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import Progress, input_errors, no_collections

if TYPE_CHECKING:
    from report.assessment.arrays import ArrayAssessment
    from report.assessment.changes import Changes
    from report.assessment.project import Assessment

OUTPUTS = ("calc-package.pdf", "plan.dxf", "results.xlsx", "results.json")
SOURCE = click.Path(path_type=Path)


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
@click.option("--units", type=click.Choice(["US", "SI"]), default="US", show_default=True,
              help="Units of the input cells and primary units of the package.")  # fmt: skip
def new(folder: Path, units: str) -> None:
    """Write a blank DIR/input.xlsx and the folder DIR/records/ for the motions."""
    with input_errors(folder):
        path = _new_project(folder, units)
    click.echo(f"{path}: fill in the yellow cells, put the roof motions in {folder / 'records'},")
    click.echo(f"then run: roofslip report {folder}")


def _new_project(folder: Path, units: str) -> Path:
    """Write a blank workbook and an empty records folder; never overwrite a workbook."""
    from report.sheet.schema import UnitsFirst
    from report.sheet.template import write_template
    from solver.model import InputError

    path = folder / "input.xlsx"
    if os.path.lexists(path):  # a dangling link as well
        raise InputError(f"{path}: already exists; choose another folder, or move the file")
    try:
        (folder / "records").mkdir(parents=True, exist_ok=True)
        write_template(path, units=UnitsFirst(units))
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder"
        ) from error
    return path


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
def check(source: Path) -> None:
    """Read and validate the input without writing anything."""
    from report.motions.prepare import prepare
    from report.sheet.read import read
    from report.typeset.letters import check_letters

    with input_errors(source):
        sheet = read(source)
        check_letters(sheet)
        prepare(sheet)
    data = sheet.project
    click.echo(
        f"{sheet.path}: no problems found. {len(data.arrays)} arrays, {len(data.clearances)} "
        f"clearances, {len(data.motions)} motions, S_DS {data.site.s_ds:.3f} g, "
        f"{data.site.rule_set}."
    )


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
@click.option("--since", type=SOURCE, metavar="RESULTS.JSON",
              help="Of a former revision: the package states what changed.")  # fmt: skip
def report(source: Path, out: Path | None, since: Path | None) -> None:
    """Write calc-package.pdf, plan.dxf, results.xlsx and results.json, and print a summary."""
    from report.beside import beside

    with input_errors(source), Progress() as progress, no_collections(), beside() as second:
        assessment, folder, files, changed = make(source, out, since, progress, second)
    _print_summary(assessment)
    if changed.is_asked_for:
        _print_changes(assessment, changed)
    click.echo("")
    for name in files:
        click.echo(folder / name)


def make(
    source: Path,
    out: Path | None,
    since: Path | None,
    progress: Callable[[str], None],
    second: Executor,
) -> tuple[Assessment, Path, Mapping[str, bytes], Changes]:
    """Read a workbook, run its motions, and write the package and the tables.

    A second process (`report.beside`) draws and writes what it can meanwhile.
    """
    second.submit(load)
    from report.assessment.changes import NO_FORMER
    from report.assessment.evidence import support
    from report.assessment.project import assess
    from report.drawing.dxf import write_dxf
    from report.drawing.plan import plan_drawing
    from report.motions.prepare import prepare
    from report.package.html import begin, pages
    from report.results.compare import changes
    from report.results.publish import check_apart, publish
    from report.results.since import read_former
    from report.results.tables import tables
    from report.sheet.read import read
    from report.typeset.letters import check_letters
    from report.typeset.pdf import draw_ahead, lay_out, sources

    progress("reading the workbook")
    former = [read_former(path) for path in (since,) if path]
    sheet = read(source)
    folder = out or sheet.path.parent / "out"
    check_letters(sheet)
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else [])])
    shaking = prepare(sheet)
    progress("running the motions (the first run compiles the solver)")
    assessment = assess(sheet, shaking)
    changed = changes(former[0], assessment) if former else NO_FORMER
    begun = begin(assessment, changed, second)
    evidence = support(assessment)
    progress("writing the pages")
    html = pages(assessment, evidence, changed, begun, second)
    progress("laying out the package")
    drawn = second.submit(draw_ahead, sources(html))
    plan = second.submit(write_dxf, plan_drawing(assessment))
    listed = second.submit(tables, assessment, evidence)
    pdf = lay_out(html, drawn)
    progress("writing the result tables")
    files = {"calc-package.pdf": pdf, "plan.dxf": plan.result(), **listed.result()}
    publish(files, folder)
    return assessment, folder, files, changed


def load() -> None:
    """Import what draws and writes, while the other process reads and runs."""
    import report.drawing.dxf
    import report.figures.charts
    import report.package.html
    import report.results.xlsx  # noqa: F401
    from report.pages.pictures import load_charts
    from report.typeset.pdf import draw_ahead

    load_charts()
    draw_ahead([])


def _print_summary(assessment: Assessment) -> None:
    from report.pages.registry import package_data

    us_first = assessment.project.project.units_first == "US"
    columns = ("array", "computed", "prescriptive", "design", "governing clearance", "D/C", "")
    rows = [_summary_row(assessment, item, us_first) for item in assessment.arrays]
    widths = [max(map(len, column)) for column in zip(columns, *rows, strict=True)]
    for row in (columns, *rows):
        cells = (text.ljust(width) for text, width in zip(row, widths, strict=True))
        click.echo("  ".join(cells).rstrip())
    for warning in assessment.warnings:
        click.echo(f"warning: {warning}")
    see = f"see {package_data(assessment).part('model')} of the package"
    for item in assessment.arrays:
        if not item.tipping.is_ok:
            click.echo(f"warning: array {item.id} starts to tip; {see}")
    for name in (row.design.id for row in assessment.linked if not row.is_rigid_enough):
        text = f"one rigid block has not been shown to be adequate for array {name}"
        click.echo(f"warning: {text}; {see}")
    checks = [*assessment.building_checks, *(c for a in assessment.arrays for c in a.limits)]
    for failed in (c for c in checks if not c.ok):
        click.echo(f"warning: {failed.provision.clause} is not satisfied: {failed.title}")
    for missed in assessment.conditions:
        where = f"{missed.subject}, " if missed.subject else ""
        text = f"{where}{missed.title}: {missed.found}; {missed.limit} required"
        click.echo(f"{missed.consequence.value}: {text}")
    click.echo(f"verdict: {assessment.verdict.value}")


def _print_changes(assessment: Assessment, changed: Changes) -> None:
    from report.pages.changes import counted
    from report.pages.registry import package_data

    where = package_data(assessment, changed).part("changes")
    click.echo(f"since revision {changed.revision}: {counted(changed)}; see {where} of the package")


def _summary_row(assessment: Assessment, item: ArrayAssessment, us_first: bool) -> tuple[str, ...]:
    from report.words.units import Quantity, pair, ratio

    def shown(value_m: float) -> str:
        if value_m != value_m:
            return "none"
        return pair(value_m, Quantity.DISPLACEMENT, us_first)

    gap = assessment.governing_clearance(item.id)
    clearance = (f"to {gap.across_from(item.id)}", ratio(gap.demand_capacity)) if gap else ()
    return (
        item.id,
        shown(item.analysis.value_m),
        shown(item.prescriptive.value_m),
        shown(item.design_m),
        *(clearance or ("none given", "")),
        assessment.array_verdict(item).value,
    )
