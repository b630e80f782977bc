"""The command `roofslip new`."""

from __future__ import annotations

from pathlib import Path

import click

from report.cli.options import SOURCE


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
        raise click.UsageError("give --example or --study, not both; projects/study is an example")
    from report.cli.new_project import new_project

    new_project(folder, units, is_example=example, is_study=study)
