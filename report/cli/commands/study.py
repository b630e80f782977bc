"""The command `roofslip study`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.option_types import QUIET, SOURCE


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/study/ next to the input.")
@click.option("--dry-run", is_flag=True, help="Print runs, batches and disk space; run nothing.")
@click.option("--scheduler", metavar="tcp://HOST:PORT", default="",
              help="Run on an existing Dask cluster instead of this machine.")  # fmt: skip
@click.option("--allow-matched", is_flag=True,
              help="Export fragilities of motions matched to one spectrum, with a warning in"
              " fragility.csv.")  # fmt: skip
@click.option("--trust-parts", is_flag=True,
              help="Also reuse batches not signed with your key (from another user or machine);"
              " the results state how many.")  # fmt: skip
@QUIET
def study(source: Path, out: Path | None, **options: Any) -> None:
    """Run a study workbook: write study.pdf, curves.csv, study.xlsx, fragilities and every run.

    An interrupted study resumes where it stopped. `roofslip new DIR --study` writes a blank
    workbook.
    """
    from report.cli.input_errors import input_errors
    from report.study.optional_packages import NEEDED, optional_package

    # Before anything is imported that needs them.
    with input_errors(source):
        for name in NEEDED:
            optional_package(name)

    from report.cli.study_run import run

    run(source, out, **options)
