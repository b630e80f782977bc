"""The command `roofslip verify`: the verification manual."""

from __future__ import annotations

import datetime as dt
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import Progress, input_errors

if TYPE_CHECKING:
    from solver.verification.evidence import Verification

_FOLDER = click.Path(path_type=Path)


@click.command()
@click.option("--out", type=_FOLDER, default=Path("out"), show_default=True,
              help="Folder for the outputs.")  # fmt: skip
@click.option("--quick", is_flag=True, help="Fewer records, scenes and settings: seconds.")
@click.option("--records", type=_FOLDER, help="Folder of real records: files of three components "
              "run in every model; roof_575_market in it, ground and floors of 575 Market Street, "
              "is held against the way from ground to roof.")  # fmt: skip
def verify(out: Path, quick: bool, records: Path | None) -> None:
    """Check the solver and every rival, and write verification.pdf with its table and charts.

    Exits 1 where a check fails, with the outputs written.
    """
    from report.results.publish import publish

    with input_errors(records or out), Progress() as progress:
        found, files = _verification(quick, records, progress)
        progress("putting the files in place")
        publish(files, out)
    failed = [row for row in found.checks if not row.passed]
    passed = len(found.checks) - len(failed)
    click.echo(f"{'FAIL' if failed else 'PASS'}: {passed} of {len(found.checks)} checks passed")
    for row in failed:
        click.echo(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.found:.10g} {row.unit}, error {row.error:.1e} over {row.tolerance:.1e}"
        )
    for name in files:
        click.echo(out / name)
    if failed or not found.checks:
        sys.exit(1)


def _verification(
    quick: bool, records: Path | None, progress: Callable[[str], None]
) -> tuple[Verification, Mapping[str, bytes]]:
    """Return what was found, and every output as finished bytes by file name."""
    from report.manual.render import files
    from solver.verification.run import recorded_buildings, recorded_triples, verify

    buildings = recorded_buildings(records) if records else ()
    motions = recorded_triples(records) if records else ()
    found = verify((), quick=quick, progress=progress, buildings=buildings, motions=motions)
    return found, files(found, dt.date.today(), progress)
