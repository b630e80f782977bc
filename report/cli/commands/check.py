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
    """Check the input, and print what is known without a run; write nothing.

    An error stops the work. A warning may be intended: give its name, printed in brackets, and a
    reason on the sheet Acknowledged. A warning without a name is a limit that is not satisfied, a
    formula of the sheet that was typed over, or a source other than that in suite.json. A note
    needs no answer.
    """
    from report.cli.project_check import check_project

    check_project(source, **options)
