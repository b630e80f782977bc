"""The command `roofslip report`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import AS_JSON, FAIL_ON_NG, QUIET, SOURCE


@click.command()
@click.argument("sources", metavar="DIR|WORKBOOK...", nargs=-1, required=True, type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/ beside the input.")
@click.option("--since", type=SOURCE, metavar="RESULTS.JSON",
              help="Of a former revision: the package states what changed.")  # fmt: skip
@click.option("--no-page", is_flag=True, help="Leave out calc-package.html.")
@FAIL_ON_NG
@QUIET
@AS_JSON
def report(sources: tuple[Path, ...], no_page: bool, **options: Any) -> None:
    """Write calc-package.pdf, plan.dxf, results.xlsx and results.json, and print a summary.

    Beside the package, calc-package.html shows it in any browser, without Roofslip.

    Beside the date of each confirmation, the workbook gets what it covered, once: where these
    inputs change later, the package has a condition.

    Of several projects each has a line in one table; several workbooks of one folder are written to
    out/NAME/. One with an error stops no other: the exit code is 2 if any input has an error, and 1
    after an internal error.
    """
    from report.cli.several_packages import report_projects

    report_projects(sources, has_page=not no_page, **options)
