"""The command `roofslip sign`: the engineer's signature in the seal box of a package."""

from __future__ import annotations

import warnings
from pathlib import Path

import click

from report.cli.terminal import SOURCE, input_errors
from report.cli.values import Existing

_FILE = Existing(dir_okay=False)


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
    from report.proof.sign import signed
    from solver.files import check_plain, write_whole
    from solver.model import InputError

    target = out or file.with_name(f"{file.stem}-signed.pdf")
    with input_errors(file):
        if out is None:
            check_plain(target, file.parent)
        password = _asked() if password is None else password
        if target.exists() and target.samefile(file):
            raise InputError("the signed package needs a name of its own; choose another --out")
        content = signed(file.read_bytes(), p12.read_bytes(), password, time_stamp)
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
