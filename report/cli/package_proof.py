"""Regenerates a package from its embedded input and compares the bytes; signs a package."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, replace
from getpass import GetPassWarning
from pathlib import Path

import click

from report.cli.console import DIFFERS, NOT_COMPARED, print_json, say
from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.making import make
from report.proof.opened_package import RecordsMissingError, opened, read_package, take_out
from report.proof.package_comparison import Agreement, Proof, compared, failed
from report.proof.signatures import signed
from report.provenance.known_errors import touching
from report.results.publish import OUTPUTS, STAMP, warn_if_mixed
from report.steps import STEPS
from solver.errors import InputError
from solver.file_checks import check_plain, read_file
from solver.file_writing import write_whole

COMPARING = 0.1
"""Usual time of the comparison, as a share of that of the package."""

_ANSWERS = {
    "same": "Same: the embedded input reproduces this package byte for byte.",
    "not compared in full": "Not compared in full; no differences in what was compared:",
    "differs": "Differs from the package that its embedded input produces:",
}


def prove(
    file: Path, *, records: Path | None, out: Path | None, quiet: bool, as_json: bool
) -> None:
    """Print whether the embedded input reproduces a package, and exit with the matching code."""
    # Where only drawings differ, as from another processor, a person compares the two by eye.
    again = out or file.with_name(f"{file.stem}-again.pdf")
    with input_errors(file, as_json=as_json), _ended_by_signals():
        data = read_package(file)
        # Before the work, and a dangling link as well.
        if os.path.lexists(again):
            raise InputError(f"{again}: already exists; use another --out, or move the file")
        with Progress((*STEPS, COMPARING), quiet=quiet) as progress:
            proof, made = _proof(file, data, records, progress)
        if proof.is_to_be_read:
            write_whole(again, made)
    written = str(again) if proof.is_to_be_read else ""
    if as_json:
        print_json(asdict(proof) | {"made_again": written})
    elif not quiet:
        _print(proof, written)
    code = {"differs": DIFFERS, "not compared in full": NOT_COMPARED}.get(proof.answer)
    if code:
        sys.exit(code)


@contextmanager
def _ended_by_signals() -> Iterator[None]:
    """Let SIGTERM end the command like Ctrl+C, so that its files are removed."""
    handler = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, handler)


def _proof(
    file: Path, data: bytes, records: Path | None, progress: Progress
) -> tuple[Proof, bytes]:
    """Return the outcome, and the regenerated package if there is one."""
    if os.path.lexists(file.parent / STAMP):
        warn_if_mixed(file.parent, OUTPUTS)
    try:
        package = opened(data)
        errors = tuple(touching(package.manifest.roofslip_version, package.results))
        with tempfile.TemporaryDirectory(prefix="roofslip-") as folder:
            workbook, earlier = take_out(package, Path(folder, "input"), records)
            try:
                made = made_again(workbook, Path(folder, "out"), earlier, progress)
            except InputError as error:
                # Its own input is refused: the package was not made from it, or by another version.
                return replace(failed(package, error.problems), known_errors=errors), b""
        progress("comparing")
        return replace(compared(package, opened(made)), known_errors=errors), made
    # No verdict on the package: it can be given once the records are there.
    except RecordsMissingError:
        raise
    except InputError as error:
        return Proof(answer=Agreement.DIFFERS, reasons=tuple(error.problems)), b""


def made_again(workbook: Path, out: Path, earlier: list[Path], progress: Progress) -> bytes:
    """Return the package of a workbook."""
    since = earlier[0] if earlier else None
    # The file for a browser is not in the package, and nothing compares it.
    files = make(workbook, out, since, progress, has_page=False).files
    return files["calc-package.pdf"]


def _print(proof: Proof, written: str) -> None:
    if proof.known_errors:
        say("Known errors of the version that created the package, which may affect it:")
    for error in proof.known_errors:
        say(f"  {error.error} {error.action}")
    say(_ANSWERS[proof.answer])
    for reason in proof.reasons:
        say(f"  {reason}")
    if written:
        say("The regenerated package: ", Path(written))
    for signature in proof.signed:
        say(
            f"Signed later in the field '{signature.field}', by '{signature.signer}'. The "
            "issuer of the certificate was not checked; a PDF reader does that."
        )


MAX_KEY_BYTES = 1_000_000


def sign_package(
    file: Path, *, p12: Path, password: str | None, time_stamp: str, out: Path | None
) -> None:
    """Write the signed package, under a name of its own."""
    # The package is evidence: the signed one has a name of its own.
    target = out or file.with_name(f"{file.stem}-signed.pdf")
    with input_errors(file):
        certificate = read_file(p12, MAX_KEY_BYTES, p12.name)
        # A name that was not asked for is not followed through a link; one of --out is the user's
        # own.
        if out is None:
            check_plain(target, file.parent)
        password = _typed_password() if password is None else password
        # By file, not by name: --out may be a link to the package, or write it in other capitals.
        if target.exists() and target.samefile(file):
            raise InputError("the signed package must have a different name; use another --out")
        content = signed(read_package(file), certificate, password, time_stamp)
        write_whole(target, content)
    say(target)


def _typed_password() -> str:
    """Return the typed password; not possible without a terminal."""
    with warnings.catch_warnings():
        # Without a terminal, getpass would warn and read what others can see.
        warnings.simplefilter("error", GetPassWarning)
        try:
            password: str = click.prompt("Password", hide_input=True)
        except GetPassWarning as error:
            raise InputError(
                "cannot prompt for the password without a terminal; set ROOFSLIP_P12_PASSWORD"
            ) from error
    return password
