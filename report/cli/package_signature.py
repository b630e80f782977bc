"""Puts the engineer's signature in the seal box of a package."""

from __future__ import annotations

import warnings
from getpass import GetPassWarning
from pathlib import Path

import click

from report.cli.input_errors import input_errors
from report.proof.opened_package import read_package
from report.proof.signatures import signed
from solver.errors import InputError
from solver.file_checks import check_plain, read_file
from solver.file_writing import write_whole

MAX_KEY_BYTES = 1_000_000


def sign_package(
    file: Path, *, p12: Path, password: str | None, time_stamp: str, out: Path | None
) -> None:
    """Write the signed package, under a name of its own."""
    # The package is evidence: the signed one has a name of its own.
    target = out or file.with_name(f"{file.stem}-signed.pdf")
    with input_errors(file):
        certificate = read_file(p12, MAX_KEY_BYTES, p12.name)
        if out is None:
            check_plain(target, file.parent)
        password = _typed_password() if password is None else password
        if target.exists() and target.samefile(file):
            raise InputError("the signed package needs a name of its own; choose another --out")
        content = signed(read_package(file), certificate, password, time_stamp)
        write_whole(target, content)
    click.echo(target)


def _typed_password() -> str:
    """Return the password that is typed; without a terminal nobody can."""
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
