"""The command `roofslip verify-package`: a package made again from its own input, and compared."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import (
    AS_JSON,
    DIFFERS,
    NOT_COMPARED,
    QUIET,
    SOURCE,
    Progress,
    input_errors,
    no_collections,
    plain,
    print_json,
    say,
)
from report.making import OUTPUTS, STEPS, make

if TYPE_CHECKING:
    from report.proof.verdict import Proof

COMPARING = 0.1
"""Usual time of the comparison, as a share of that of the package."""

_SAID = {
    "same": "Same: the input in the package gives this package, to the byte.",
    "not compared in full": "Not compared in full; nothing differs in what was compared:",
    "differs": "Differs from what the input in the package gives:",
}


@click.command("verify-package")
@click.argument("file", metavar="FILE.pdf", type=SOURCE)
@click.option("--records", type=SOURCE, metavar="FOLDER",
              help="Of the workbook, where the package only lists its records.")  # fmt: skip
@click.option("--out", type=SOURCE,
              help="Where the package made again is written if drawings were not compared; "
              "default: FILE-again.pdf beside it.")  # fmt: skip
@QUIET
@AS_JSON
def verify_package(
    file: Path, records: Path | None, out: Path | None, quiet: bool, as_json: bool
) -> None:
    """Make a package again from the input inside it, and compare the bytes.

    Exit codes: 0 the same; 4 not compared in full, as where another processor, system or version
    made it: numbers and words agree, drawings were not compared, and the package made again is
    written; 1 it differs, and where first; 2 it cannot be made again with what is given. Signatures
    that were put on after the package was written are no difference.
    """
    from report.proof.package import read_package
    from solver.files import write_whole
    from solver.model import InputError

    again = out or file.with_name(f"{file.stem}-again.pdf")
    with input_errors(file, as_json=as_json), _ended_by_signals():
        data = read_package(file)
        if os.path.lexists(again):  # a dangling link as well
            raise InputError(f"{again}: already exists; give another --out, or move the file")
        with Progress((*STEPS, COMPARING), quiet=quiet) as progress, no_collections():
            proof, made = _proof(file, data, records, progress)
        if proof.is_to_be_read:
            write_whole(again, made)
    written = str(again) if proof.is_to_be_read else ""
    if as_json:
        print_json(asdict(proof) | {"made_again": written})
    elif not quiet:
        _print(proof, written)
    if code := {"differs": DIFFERS, "not compared in full": NOT_COMPARED}.get(proof.answer):
        sys.exit(code)


@contextmanager
def _ended_by_signals() -> Iterator[None]:
    """Have SIGTERM end the command as Ctrl+C does, so that its files are removed."""
    former = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, former)


def _proof(
    file: Path, data: bytes, records: Path | None, progress: Progress
) -> tuple[Proof, bytes]:
    """Return the outcome, and the package made again if it was."""
    from report.proof.package import RecordsMissingError, opened, take_out
    from report.proof.verdict import Agreement, Proof, compared, failed
    from report.results.publish import STAMP, warn_if_mixed
    from solver.model import InputError

    if os.path.lexists(file.parent / STAMP):
        warn_if_mixed(file.parent, OUTPUTS)
    try:
        package = opened(data)
        with tempfile.TemporaryDirectory(prefix="roofslip-") as folder:
            workbook, former = take_out(package, Path(folder, "input"), records)
            try:
                made = made_again(workbook, Path(folder, "out"), former, progress)
            except InputError as error:
                return failed(package, error.problems), b""
        progress("comparing")
        return compared(package, opened(made)), made
    except RecordsMissingError:
        raise
    except InputError as error:
        return Proof(answer=Agreement.DIFFERS, reasons=tuple(error.problems)), b""


def made_again(workbook: Path, out: Path, former: list[Path], progress: Progress) -> bytes:
    """Return the package of a workbook."""
    _, _, files, _ = make(workbook, out, former[0] if former else None, progress)
    return files["calc-package.pdf"]


def _print(proof: Proof, written: str) -> None:
    click.echo(_SAID[proof.answer])
    for reason in proof.reasons:
        say(f"  {reason}")
    if written:
        click.echo(plain(f"The package made again: {written}"))
    for one in proof.signed:
        click.echo(
            plain(
                f"Signed since, in the field '{one.field}', by '{one.signer}'. Who issued the "
                "certificate was not checked: a PDF reader does."
            )
        )
