"""The command `roofslip report`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import AS_JSON, FAIL_ON_NG, QUIET, SOURCE


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
