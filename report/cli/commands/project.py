"""The commands on a project: `roofslip new`, `check`, `report`, `watch`, `schema`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from report.cli.option_types import AS_JSON, FAIL_ON_NG, QUIET, SOURCE


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
@click.option("--units", type=click.Choice(["US", "SI"], case_sensitive=False), default="US",
              show_default=True,
              help="Units of the input cells and primary units of the package.")  # fmt: skip
@click.option("--example", is_flag=True, help="Write a complete example with motions.")
@click.option("--study", is_flag=True, help="Write a study workbook instead.")
def new(folder: Path, units: str, example: bool, study: bool) -> None:
    """Write a blank DIR/input.xlsx and the folder DIR/records/ for the motions."""
    if example and study:
        raise click.UsageError("use --example or --study, not both; projects/study is an example")
    from report.cli.new_project import new_project

    new_project(folder, units, is_example=example, is_study=study)


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@QUIET
@AS_JSON
def check(source: Path, **options: Any) -> None:
    """Check the input and the limits that need no run. Writes no files.

    Errors must be corrected. To accept a warning, enter its name (in brackets) and a reason on the
    Acknowledged worksheet. A warning without a name is a limit that is not satisfied, an
    overwritten formula, or a source that differs from suite.json. Notes need no action.
    """
    from report.cli.project_check import check_project

    check_project(source, **options)


@click.command()
@click.argument("sources", metavar="DIR|WORKBOOK...", nargs=-1, required=True, type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ next to the input.")
@click.option("--since", type=SOURCE, metavar="RESULTS.JSON",
              help="results.json of a previous revision, for a list of changes.")  # fmt: skip
@click.option("--no-page", is_flag=True, help="Do not write calc-package.html.")
@FAIL_ON_NG
@QUIET
@AS_JSON
def report(sources: tuple[Path, ...], no_page: bool, **options: Any) -> None:
    """Write calc-package.pdf, plan.dxf, results.xlsx and results.json, and print a summary.

    calc-package.html shows the package in any browser, without Roofslip.

    Records in the workbook, once for each confirmation date, which inputs were confirmed. If these
    inputs change later, the package has an open condition.

    With several projects, prints one table with a line for each; several workbooks in one folder
    are written to out/NAME/. An error in one project does not stop the others: the exit code is 2
    if any input has an error, and 1 after an internal error.
    """
    from report.cli.several_packages import report_projects

    report_projects(sources, has_page=not no_page, **options)


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ next to the input.")
@click.pass_obj
def watch(interrupts: Sequence[int], source: Path, out: Path | None) -> None:
    """Check and report on every save of the workbook or a record, until Ctrl+C.

    Prints what changed since the last report. Waits while the workbook is being saved or is locked.
    """
    from report.cli.file_watcher import watch_project

    watch_project(source, out, interrupts)


@click.command()
def schema() -> None:
    """Print the JSON schema of results.json."""
    from report.results.results_schema import schema as results_schema

    click.echo(json.dumps(results_schema(), indent=1))
