"""The command `roofslip verify-package`: a package held against its own input.

Takes the input out of the package into a folder of its own, runs `report` on it, and compares.
"""

from __future__ import annotations

import sys
import tempfile
from concurrent.futures import Executor
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.report import SOURCE
from report.cli.terminal import (
    AS_JSON,
    NOT_OK,
    QUIET,
    Progress,
    input_errors,
    no_collections,
    plain,
)
from report.making import STEPS, make

if TYPE_CHECKING:
    from report.proof.verdict import Proof


@click.command("verify-package")
@click.argument("file", metavar="FILE.pdf", type=SOURCE)
@click.option("--records", type=SOURCE, metavar="FOLDER",
              help="Of the workbook, where the package only lists its records.")  # fmt: skip
@QUIET
@AS_JSON
def verify_package(file: Path, records: Path | None, quiet: bool, as_json: bool) -> None:
    """Compute a package again from the input inside it, and compare every sheet and number.

    Exit codes: 0 the same; 3 it differs, and where; 2 it cannot be read. What was signed after the
    package was written does not count.
    """
    from report.beside import beside

    with (
        input_errors(file, as_json=as_json),
        Progress(STEPS + 1, quiet=quiet) as progress,
        no_collections(),
        beside() as second,
        tempfile.TemporaryDirectory(prefix="roofslip-") as folder,
    ):
        proof = _proof(file, records, Path(folder), progress, second)
    if as_json:
        from report.proof.verdict import as_json as written

        click.echo(written(proof))
    elif not quiet:
        _print(proof)
    if not proof.is_same:
        sys.exit(NOT_OK)


def _proof(
    file: Path, records: Path | None, folder: Path, progress: Progress, second: Executor
) -> Proof:
    from report.proof.package import open_package, take_out
    from report.proof.updates import appended
    from report.proof.verdict import compared, failed
    from solver.model import InputError

    package = open_package(file)
    later = appended(package)
    workbook, former = take_out(package, folder / "input", records)
    try:
        _, _, files, _ = make(
            workbook, folder / "out", former[0] if former else None, progress, second
        )
    except InputError as error:
        return failed(error.problems, later)
    progress("comparing")
    return compared(package, files["calc-package.pdf"], later)


def _print(proof: Proof) -> None:
    if proof.versions:
        click.echo(plain(f"Made by another version: {', '.join(proof.versions)}."))
    if proof.is_same:
        click.echo(f"Same: the input in the package gives this package, {proof.how}.")
    else:
        click.echo("Differs from what the input in the package gives:")
        for text in proof.differences:
            click.echo(f"  {plain(text)}")
    for name in proof.signed:
        click.echo(plain(f"Signed since: {name}. A PDF reader checks the certificate."))
