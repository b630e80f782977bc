"""The commands `roofslip verify` (the manual), `verify-package` and `sign`.

`verify-package` makes a package again from its own input and compares; `sign` puts the engineer's
signature in its seal box.
"""

from __future__ import annotations

import datetime as dt
import os
import signal
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.options import Existing
from report.cli.terminal import (
    AS_JSON,
    DIFFERS,
    NOT_COMPARED,
    QUIET,
    SOURCE,
    Progress,
    colored,
    input_errors,
    plain,
    print_json,
    say,
)
from report.making import OUTPUTS, STEPS, make
from report.text.counts import numbered

if TYPE_CHECKING:
    from report.proof.package import Proof
    from solver.verification.evidence import Verification


# Usual shares of the time of the steps that a verification reports, as with --quick.
VERIFY_STEPS = (18, 2, 3, 9, 11, 5, 0.1, 5, 0.1, 0.5, 7, 33, 2)

_FOLDER = Existing(file_okay=False)
_USUAL = "out"


@click.command()
@click.option("--out", type=SOURCE, help="Folder for the outputs; default: out.")
@click.option("--quick", is_flag=True, help="Run fewer records, cases and settings.")
@click.option("--records", type=_FOLDER, help="Folder of recorded motions. Files with three "
              "components are run with every model; roof_575_market (ground and floor records of "
              "575 Market Street) is compared with the building model.")  # fmt: skip
def verify(out: Path | None, quick: bool, records: Path | None) -> None:
    """Check the solver and the comparison methods; write verification.pdf, its table and charts.

    The exit code is 1 if a check fails; the outputs are written in any case.
    """
    from report.results.publish import output_folder, publish

    source = records or out or Path(_USUAL)
    with input_errors(source), Progress(VERIFY_STEPS) as progress:
        out = output_folder(out, Path(), _USUAL)
        verification, files = _verification(quick, records, progress)
        progress("writing the files")
        publish(files, out)
    failed = [row for row in verification.checks if not row.passed]
    passed = len(verification.checks) - len(failed)
    verdict = "FAIL" if failed else "PASS"
    click.echo(colored(f"{verdict}: {passed} of {len(verification.checks)} checks passed"))
    if verification.left_out:
        left_out = numbered(len(verification.left_out), "check")
        click.echo(f"{left_out} left out: SciPy is not installed; install roofslip[verify]")
    for row in failed:
        click.echo(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.computed:.10g} {row.unit}, error {row.error:.1e} exceeds "
            f"{row.tolerance:.1e}"
        )
    for name in files:
        click.echo(out / name)
    # Without any check nothing passed either.
    if failed or not verification.checks:
        sys.exit(1)


def _verification(
    quick: bool, records: Path | None, progress: Callable[[str], None]
) -> tuple[Verification, Mapping[str, bytes]]:
    """Return the verification, and every output as finished bytes by file name."""
    from report.manual.render import files
    from solver.verification.building import recorded_buildings
    from solver.verification.run import verify
    from solver.verification.study import recorded_triples

    buildings = recorded_buildings(records) if records else ()
    motions = recorded_triples(records) if records else ()
    verification = verify(quick=quick, progress=progress, buildings=buildings, motions=motions)
    return verification, files(verification, dt.date.today(), progress)


# Usual time of the comparison, as a share of that of the package.
COMPARING = 0.1

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
        # Before the work, and a dangling link as well.
        if os.path.lexists(again):
            raise InputError(f"{again}: already exists; give another --out, or move the file")
        with Progress((*STEPS, COMPARING), quiet=quiet) as progress:
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
    from report.proof.package import (
        Agreement,
        Proof,
        RecordsMissingError,
        compared,
        failed,
        opened,
        take_out,
    )
    from report.provenance.known_errors import touching
    from report.results.publish import STAMP, warn_if_mixed
    from solver.model import InputError

    if os.path.lexists(file.parent / STAMP):
        warn_if_mixed(file.parent, OUTPUTS)
    try:
        package = opened(data)
        errors = tuple(touching(package.manifest.roofslip_version, package.results))
        with tempfile.TemporaryDirectory(prefix="roofslip-") as folder:
            workbook, former = take_out(package, Path(folder, "input"), records)
            try:
                made = made_again(workbook, Path(folder, "out"), former, progress)
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


def made_again(workbook: Path, out: Path, former: list[Path], progress: Progress) -> bytes:
    """Return the package of a workbook."""
    since = former[0] if former else None
    files = make(workbook, out, since, progress, has_page=False).files
    return files["calc-package.pdf"]


def _print(proof: Proof, written: str) -> None:
    if proof.known_errors:
        click.echo("Errors of the version that made the package, which it may have:")
    for error in proof.known_errors:
        click.echo(f"  {error.error} {error.action}")
    click.echo(_SAID[proof.answer])
    for reason in proof.reasons:
        say(f"  {reason}")
    if written:
        click.echo(plain(f"The package made again: {written}"))
    for signature in proof.signed:
        click.echo(
            plain(
                f"Signed since, in the field '{signature.field}', by '{signature.signer}'. Who "
                "issued the certificate was not checked: a PDF reader does."
            )
        )


_FILE = Existing(dir_okay=False)
MOST_KEY = 1_000_000


@click.command()
@click.argument("file", metavar="FILE.pdf", type=_FILE, is_eager=True)
@click.option("--p12", type=_FILE, is_eager=True, required=True, metavar="CERT.p12",
              help="PKCS#12 file with the private key and the certificate.")  # fmt: skip
@click.option("--password", envvar="ROOFSLIP_P12_PASSWORD",
              help="Of CERT.p12; without it, from ROOFSLIP_P12_PASSWORD or asked for.")  # fmt: skip
@click.option("--time-stamp", default="", metavar="URL",
              help="Of a time-stamp authority (RFC 3161): PAdES B-T instead of B-B.")  # fmt: skip
@click.option("--out", type=SOURCE, help="File to write; default: FILE-signed.pdf beside it.")
def sign(file: Path, p12: Path, password: str | None, time_stamp: str, out: Path | None) -> None:
    """Sign a package in the field over its seal box (PAdES baseline).

    The package itself stays as it is, and verifies as before. Nothing is sent anywhere but to URL.
    """
    from report.proof.package import read_package
    from report.proof.signatures import signed
    from solver.files import check_plain, read_file, write_whole
    from solver.model import InputError

    # The package is evidence: the signed one has a name of its own.
    target = out or file.with_name(f"{file.stem}-signed.pdf")
    with input_errors(file):
        certificate = read_file(p12, MOST_KEY, p12.name)
        if out is None:
            check_plain(target, file.parent)
        password = _asked() if password is None else password
        if target.exists() and target.samefile(file):
            raise InputError("the signed package needs a name of its own; choose another --out")
        content = signed(read_package(file), certificate, password, time_stamp)
        write_whole(target, content)
    click.echo(target)


def _asked() -> str:
    """Return the password that is typed; without a terminal nobody can."""
    from getpass import GetPassWarning

    from solver.model import InputError

    with warnings.catch_warnings():
        # Without a terminal, getpass would warn and read what others can see.
        warnings.simplefilter("error", GetPassWarning)
        try:
            password: str = click.prompt("Password", hide_input=True)
        except GetPassWarning as error:
            raise InputError(
                "the password cannot be asked for without a terminal; set ROOFSLIP_P12_PASSWORD"
            ) from error
    return password
