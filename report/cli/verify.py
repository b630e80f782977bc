"""The command `roofslip verify`: the verification manual."""

from __future__ import annotations

import datetime as dt
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.colors import colored
from report.cli.terminal import SOURCE, Progress, input_errors, no_collections
from report.cli.values import Existing

if TYPE_CHECKING:
    from solver.verification.evidence import Verification
    from solver.verification.shake_table import ShakeTable

STEPS = (18, 2, 3, 9, 11, 5, 0.1, 5, 0.1, 0.5, 0.1, 7, 33, 2)
"""Usual shares of the time of the steps that a verification reports, as with --quick."""

_FOLDER = Existing(file_okay=False)
_USUAL = "out"


@click.command()
@click.option("--out", type=SOURCE, help="Folder for the outputs; default: out.")
@click.option("--quick", is_flag=True, help="Run fewer records, cases and settings; takes seconds.")
@click.option("--records", type=_FOLDER, help="Folder of recorded motions. Files with three "
              "components are run with every model; roof_575_market (ground and floor records of "
              "575 Market Street) is compared with the building model.")  # fmt: skip
@click.option("--table", type=_FOLDER, help="Folder of shake-table tests: tests.csv and the "
              "table accelerations. Measured slip is compared with the computed one.")  # fmt: skip
def verify(out: Path | None, quick: bool, records: Path | None, table: Path | None) -> None:
    """Check the solver and the comparison methods; write verification.pdf, its table and charts.

    The exit code is 1 if a check fails, or if the tests of a shake table are not accepted; the
    outputs are written in any case.
    """
    from report.results.publish import output_folder, publish

    source = table or records or out or Path(_USUAL)
    with input_errors(source), Progress(STEPS) as progress, no_collections():
        out = output_folder(out, Path(), _USUAL)
        verification, files = _verification(quick, records, table, progress)
        progress("writing the files")
        publish(files, out)
    failed = [row for row in verification.checks if not row.passed]
    passed = len(verification.checks) - len(failed)
    verdict = "FAIL" if failed else "PASS"
    click.echo(colored(f"{verdict}: {passed} of {len(verification.checks)} checks passed"))
    for row in failed:
        click.echo(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.computed:.10g} {row.unit}, error {row.error:.1e} exceeds "
            f"{row.tolerance:.1e}"
        )
    for tests in verification.tables:
        click.echo(_judgment(tests))
    for name in files:
        click.echo(out / name)
    is_refuted = not all(tests.is_accepted for tests in verification.tables)
    if failed or is_refuted or not verification.checks:
        sys.exit(1)


def _verification(
    quick: bool, records: Path | None, table: Path | None, progress: Callable[[str], None]
) -> tuple[Verification, Mapping[str, bytes]]:
    """Return the verification, and every output as finished bytes by file name."""
    from report.manual.render import files
    from solver.verification.building import recorded_buildings
    from solver.verification.run import verify
    from solver.verification.table_tests import table_tests
    from solver.verification.triples import recorded_triples

    tests = table_tests(table) if table else ()
    buildings = recorded_buildings(records) if records else ()
    motions = recorded_triples(records) if records else ()
    verification = verify(
        quick=quick, progress=progress, buildings=buildings, motions=motions, tests=tests
    )
    return verification, files(verification, dt.date.today(), progress)


def _judgment(tests: ShakeTable) -> str:
    from report.manual.shake_table import result

    return f"shake table: {len(tests.runs)} tests, median ratio {tests.median:.3f}. {result(tests)}"
