"""The command `roofslip sign`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import SOURCE, Existing

_FILE = Existing(dir_okay=False)


@click.command()
@click.argument("file", metavar="FILE.pdf", type=_FILE, is_eager=True)
@click.option("--p12", type=_FILE, is_eager=True, required=True, metavar="CERT.p12",
              help="PKCS#12 file with the private key and the certificate.")  # fmt: skip
@click.option("--password", envvar="ROOFSLIP_P12_PASSWORD",
              help="Password of CERT.p12; default: ROOFSLIP_P12_PASSWORD or a prompt.")  # fmt: skip
@click.option("--time-stamp", default="", metavar="URL",
              help="URL of a time-stamp authority (RFC 3161); PAdES B-T, not B-B.")  # fmt: skip
@click.option("--out", type=SOURCE, help="File to write; default: FILE-signed.pdf next to it.")
def sign(file: Path, **options: Any) -> None:
    """Sign a package in the field over its seal box (PAdES baseline).

    The package itself stays as it is, and verifies as before. Nothing is sent anywhere but to URL.
    """
    from report.cli.package_signature import sign_package

    sign_package(file, **options)
