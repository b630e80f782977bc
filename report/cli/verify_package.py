"""The command `roofslip verify-package`: a package held against its own input.

Takes the input out of the package into a folder of its own, runs `report` on it, and compares.
"""

from __future__ import annotations

import os
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import (
    AS_JSON,
    NOT_COMPARED,
    NOT_OK,
    QUIET,
    SOURCE,
    Progress,
    input_errors,
    no_collections,
    plain,
    print_json,
)
from report.making import OUTPUTS, STEPS, make
from report.words.command import as_typed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from report.proof.signatures import Signature
    from report.proof.verdict import Proof


COMPARING = 0.1
"""Usual time of the comparison, as a share of that of the package."""


@click.command("verify-package")
@click.argument("file", metavar="FILE.pdf", type=SOURCE)
@click.option("--records", type=SOURCE, metavar="FOLDER",
              help="Of the workbook, where the package only lists its records.")  # fmt: skip
@QUIET
@AS_JSON
def verify_package(file: Path, records: Path | None, quiet: bool, as_json: bool) -> None:
    """Compute a package again from the input inside it, and compare every sheet and number.

    Exit codes: 0 the same; 3 it differs, and where; 4 nothing differs, but drawings could not be
    compared or a signature not be checked, and why; 2 it cannot be read. A signature that was put
    on after the package was written is no difference.
    """
    with (
        input_errors(file, as_json=as_json),
        Progress((*STEPS, COMPARING), quiet=quiet) as progress,
        no_collections(),
        tempfile.TemporaryDirectory(prefix="roofslip-") as folder,
    ):
        proof = _proof(file, records, Path(folder), progress)
    if as_json:
        print_json(asdict(proof))
    elif not quiet:
        _print(proof)
    if proof.differences:
        sys.exit(NOT_OK)
    if not proof.is_complete:
        sys.exit(NOT_COMPARED)


def _proof(file: Path, records: Path | None, folder: Path, progress: Progress) -> Proof:
    from report.proof.package import open_package, take_out
    from report.proof.updates import appended
    from report.proof.verdict import Written, compared, failed
    from report.provenance.files import fingerprint
    from report.results.publish import STAMP, warn_if_mixed
    from solver.model import InputError

    package = open_package(file)
    if os.path.lexists(file.parent / STAMP):
        warn_if_mixed(file.parent, OUTPUTS)
    later = appended(package)
    workbook, former = take_out(package, folder / "input", records)
    try:
        assessment, _, files, _ = make(
            workbook, folder / "out", former[0] if former else None, progress
        )
    except InputError as error:
        return failed(error.problems, later)
    progress("comparing")
    named = package.manifest.roofslip_version
    short = fingerprint(assessment.sheet, assessment.shaking, named)
    return compared(package, Written(files["calc-package.pdf"]), later, short)


def _print(proof: Proof) -> None:
    if proof.versions:
        click.echo(plain(f"It names other versions than those here: {', '.join(proof.versions)}."))
    if proof.differences:
        click.echo("Differs from what the input in the package gives:")
        for text in proof.differences:
            click.echo(f"  {plain(text)}")
    elif proof.is_same:
        click.echo(f"Same: the input in the package gives this package, {proof.how}.")
    else:
        click.echo(f"Nothing differs in what could be compared: {proof.how}.")
    if proof.not_compared:
        click.echo(as_typed(plain(_redrawn(proof.not_compared))))
    for signature in proof.signed:
        click.echo(plain(_told(signature)))


def _redrawn(names: Sequence[str]) -> str:
    from report.proof.numbers import listed

    return (
        "Not compared, because they are not drawn as the software here draws them: "
        f"{', '.join(listed(names))}. The other versions may be the reason, or a change to the "
        "file: look at each sheet beside that of a package which `roofslip report` writes from the "
        "attached input, or verify with the versions named."
    )


def _told(signature: Signature) -> str:
    field = f"Signed since, in the field '{signature.field}'"
    if not signature.is_checked:
        return (
            f"{field}: the signature was not checked; that needs the extra 'sign', which "
            "./roofslip sign installs."
        )
    if signature.problem:
        return f"{field}: the signature is not valid."
    return (
        f"{field}, by '{signature.signer}': the signature fits the file. Who issued the "
        "certificate was not checked: a PDF reader does."
    )
