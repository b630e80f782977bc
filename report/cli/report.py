"""The commands `roofslip new` and `roofslip report`.

Read `make` first: one line for each step from workbook to package.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import (
    AS_JSON,
    FAIL_ON_NG,
    NOT_OK,
    QUIET,
    SCHEMA_VERSION,
    Progress,
    input_errors,
    no_collections,
    plain,
)

if TYPE_CHECKING:
    from report.assessment.changes import Changes
    from report.assessment.project import Assessment

OUTPUTS = ("calc-package.pdf", "plan.dxf", "results.xlsx", "results.json")
SOURCE = click.Path(path_type=Path)

STEPS = 5
"""Steps that `make` reports."""

EXAMPLE_STEPS = 7
"""Motions of the example, each of which `new --example` reports."""


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
@click.option("--units", type=click.Choice(["US", "SI"]), default="US", show_default=True,
              help="Units of the input cells and primary units of the package.")  # fmt: skip
@click.option("--example", is_flag=True, help="Fill it in, with motions, to try a report.")
@click.option("--study", is_flag=True, help="Write the workbook of a study instead.")
def new(folder: Path, units: str, example: bool, study: bool) -> None:
    """Write a blank DIR/input.xlsx and the folder DIR/records/ for the motions."""
    if example and study:
        raise click.UsageError("give --example or --study, not both; projects/study is an example")
    with input_errors(folder), Progress(EXAMPLE_STEPS) as progress:
        path = _new_project(folder, units, progress, is_example=example, is_study=study)
    if example:
        click.echo(f"{path}: a warehouse with three arrays and seven motions, complete;")
        click.echo(f"to see its package, run: roofslip report {folder}")
        return
    click.echo(f"{path}: fill in the yellow cells, put the roof motions in {folder / 'records'},")
    click.echo(f"then run: roofslip {'study' if study else 'report'} {folder}")


def _new_project(
    folder: Path,
    units: str,
    progress: Callable[[str], None],
    *,
    is_example: bool,
    is_study: bool,
) -> Path:
    """Write a workbook and its records folder; never overwrite a workbook or a record."""
    from report.sheet.example import write_example
    from report.sheet.schema import UnitsFirst
    from report.sheet.template import write_template
    from report.study.template import write_study
    from solver.model import InputError

    path = folder / "input.xlsx"
    if os.path.lexists(path):  # a dangling link as well
        raise InputError(f"{path}: already exists; choose another folder, or move the file")
    try:
        records = folder / "records"
        if is_example and records.is_dir() and any(records.iterdir()):
            raise InputError(f"{records}: is not empty; choose another folder")
        records.mkdir(parents=True, exist_ok=True)
        if is_example:
            write_example(folder, UnitsFirst(units), progress)
        else:
            write = write_study if is_study else write_template
            write(path, units=UnitsFirst(units))
    except OSError as error:
        raise InputError(
            f"{path}: cannot be written ({error.strerror}); choose another folder"
        ) from error
    return path


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
@click.option("--since", type=SOURCE, metavar="RESULTS.JSON",
              help="Of a former revision: the package states what changed.")  # fmt: skip
@FAIL_ON_NG
@QUIET
@AS_JSON
def report(
    source: Path,
    out: Path | None,
    since: Path | None,
    fail_on_ng: bool,
    quiet: bool,
    as_json: bool,
) -> None:
    """Write calc-package.pdf, plan.dxf, results.xlsx and results.json, and print a summary."""
    from report.beside import beside

    with (
        input_errors(source, as_json=as_json),
        Progress(STEPS, quiet=quiet) as progress,
        no_collections(),
        beside() as second,
    ):
        made = make(source, out, since, progress, second)
    if as_json:
        click.echo(_json(*made))
    elif not quiet:
        _print(*made)
    if fail_on_ng and made[0].verdict != "OK":
        sys.exit(NOT_OK)


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
    from report.assessment.cost import cost
    from report.assessment.evidence import plotted, support
    from report.assessment.project import assess
    from report.drawing.dxf import write_dxf
    from report.drawing.plan import plan_drawing
    from report.motions.prepare import prepare
    from report.package.html import begin, pages
    from report.provenance.files import attachments, fingerprint, sources
    from report.results.compare import changes
    from report.results.json import results_json
    from report.results.publish import check_apart, check_writable, publish
    from report.results.since import read_former
    from report.results.tables import results_table
    from report.sheet.read import read
    from report.typeset.letters import check_letters
    from report.typeset.pdf import draw_ahead, lay_out, pictures

    progress("reading the workbook")
    former = [read_former(path) for path in (since,) if path]
    sheet = read(source)
    folder = out or sheet.path.parent / "out"
    check_letters(sheet)
    check_writable(folder)
    check_apart(OUTPUTS, folder, [sheet.path, *([since] if since else [])])
    shaking = prepare(sheet)
    found = sources(sheet, shaking, since)
    dear = cost(sheet.project, shaking)
    progress(f"running the motions ({dear or 'the first run compiles the solver'})")
    assessment = assess(sheet, shaking)
    changed = changes(former[0], assessment) if former else NO_FORMER
    begun = begin(assessment, changed, second)
    shown = plotted(assessment)
    begun = begun.plot(shown)
    evidence = support(assessment, shown)
    progress("writing the pages")
    html = pages(assessment, evidence, changed, begun)
    progress("laying out the package")
    drawn = second.submit(draw_ahead, pictures(html))
    results = second.submit(results_json, assessment, evidence)
    plan = second.submit(write_dxf, plan_drawing(assessment))
    table = second.submit(results_table, assessment, evidence.spectra)
    short = fingerprint(sheet, shaking)
    pdf = lay_out(html, drawn, lambda: attachments(found, results.result(), short))
    progress("writing the result tables")
    written = (pdf, plan.result(), table.result(), results.result())
    files = dict(zip(OUTPUTS, written, strict=True))
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


def _print(
    assessment: Assessment, folder: Path, files: Mapping[str, bytes], changed: Changes
) -> None:
    from report.cli.summary import summary

    for line in summary(assessment):
        click.echo(plain(line))
    if changed.is_asked_for:
        _print_changes(assessment, changed)
    click.echo("")
    for name in files:
        click.echo(folder / name)


def _json(
    assessment: Assessment, folder: Path, files: Mapping[str, bytes], changed: Changes
) -> str:
    from report.cli.summary import document

    about = {
        "schema_version": SCHEMA_VERSION,
        "workbook": str(assessment.sheet.path),
        "errors": [],
    }
    written = {"files": [str(folder / name) for name in files]}
    return json.dumps(about | document(assessment) | written, ensure_ascii=False)


def _print_changes(assessment: Assessment, changed: Changes) -> None:
    from report.pages.changes import counted
    from report.pages.registry import package_data

    where = package_data(assessment, changed).part("changes")
    click.echo(f"since revision {changed.revision}: {counted(changed)}; see {where} of the package")
