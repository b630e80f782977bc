"""The command `roofslip verify`: the verification manual."""

from __future__ import annotations

from pathlib import Path

import click

from report.cli.options import SOURCE, Existing


@click.command()
@click.option("--out", type=SOURCE, help="Folder for the outputs; default: out.")
@click.option(
    "--quick", is_flag=True, help="Run a shorter verification (fewer records, cases and settings)."
)
@click.option("--records", type=Existing(file_okay=False), help="Folder of recorded motions. Files "
              "with three components are run with every model; roof_575_market (ground and floor "
              "records of 575 Market Street) is compared with the building model.")  # fmt: skip
def verify(out: Path | None, quick: bool, records: Path | None) -> None:
    """Check the solver and the comparison methods; write verification.pdf, its table and charts.

    The exit code is 1 if a check fails; the outputs are written in any case.
    """
    from report.cli.solver_verification import verify_solver

    verify_solver(out, quick=quick, records=records)
