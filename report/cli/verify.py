"""The command `roofslip verify`: the verification manual."""

from __future__ import annotations

import datetime as dt
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import Progress, input_errors, no_collections

if TYPE_CHECKING:
    from solver.verification.evidence import Verification

STEPS = 14
"""Steps that a verification reports."""

_FOLDER = click.Path(path_type=Path)


@click.command()
@click.option("--out", type=_FOLDER, default=Path("out"), show_default=True,
              help="Folder for the outputs.")  # fmt: skip
@click.option("--quick", is_flag=True, help="Run fewer records, cases and settings; takes seconds.")
@click.option("--records", type=_FOLDER, help="Folder of recorded motions. Files with three "
              "components are run with every model; roof_575_market (ground and floor records of "
              "575 Market Street) is compared with the building model.")  # fmt: skip
def verify(out: Path, quick: bool, records: Path | None) -> None:
    """Check the solver and the comparison methods; write verification.pdf, its table and charts.

    The exit code is 1 if a check fails; the outputs are written in any case.
    """
    from report.results.publish import check_writable, publish

    with input_errors(records or out), Progress(STEPS) as progress, no_collections():
        check_writable(out)
        verification, files = _verification(quick, records, progress)
        progress("writing the files")
        publish(files, out)
    failed = [row for row in verification.checks if not row.passed]
    passed = len(verification.checks) - len(failed)
    click.echo(
        f"{'FAIL' if failed else 'PASS'}: {passed} of {len(verification.checks)} checks passed"
    )
    for row in failed:
        click.echo(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.computed:.10g} {row.unit}, error {row.error:.1e} exceeds "
            f"{row.tolerance:.1e}"
        )
    for name in files:
        click.echo(out / name)
    if failed or not verification.checks:
        sys.exit(1)


def _verification(
    quick: bool, records: Path | None, progress: Callable[[str], None]
) -> tuple[Verification, Mapping[str, bytes]]:
    """Return the verification, and every output as finished bytes by file name."""
    from report.manual.render import files
    from solver.verification.run import recorded_buildings, recorded_triples, verify

    buildings = recorded_buildings(records) if records else ()
    motions = recorded_triples(records) if records else ()
    verification = verify((), quick=quick, progress=progress, buildings=buildings, motions=motions)
    return verification, files(verification, dt.date.today(), progress)
