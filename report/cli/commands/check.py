"""The command `roofslip check`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import AS_JSON, QUIET, SOURCE


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
