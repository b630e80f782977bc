"""The commands for verification: `roofslip verify`, `verify-package`, `sign`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.option_types import AS_JSON, QUIET, SOURCE, Existing


@click.command()
@click.option("--out", type=SOURCE, help="Folder for the outputs; default: out.")
@click.option(
    "--quick", is_flag=True, help="Run a shorter verification (fewer records, cases and settings)."
)
@click.option("--records", type=Existing(file_okay=False), help="Folder of recorded motions. Files "
              "with three components are run with every model; roof_575_market (ground and floor "
              "records of 575 Market Street) is compared with the building model.")  # fmt: skip
def verify(out: Path | None, quick: bool, records: Path | None) -> None:
    """Check the solver and the comparison methods; write verification.pdf, its table and charts.

    The exit code is 1 if a check fails; the outputs are written in any case.
    """
    from report.cli.solver_verification import verify_solver

    verify_solver(out, quick=quick, records=records)


@click.command("verify-package")
@click.argument("file", metavar="FILE.pdf", type=SOURCE)
@click.option("--records", type=SOURCE, metavar="FOLDER",
              help="Folder of the workbook, if the package only lists its records.")  # fmt: skip
@click.option("--out", type=SOURCE,
              help="Where the regenerated package is written if drawings were not compared; "
              "default: FILE-again.pdf next to it.")  # fmt: skip
@QUIET
@AS_JSON
def verify_package(file: Path, **options: Any) -> None:
    """Regenerate a package from its embedded input, and compare the two byte for byte.

    Exit codes: 0: the same. 4: not compared in full, for example because another processor, system
    or version created it; numbers and text agree, drawings were not compared, and the regenerated
    package is written. 1: different (prints the first difference). 2: cannot be regenerated from
    what is available. Signatures added later are not a difference.
    """
    from report.cli.package_proof import prove

    prove(file, **options)


_FILE = Existing(dir_okay=False)


@click.command()
@click.argument("file", metavar="FILE.pdf", type=_FILE, is_eager=True)
@click.option("--p12", type=_FILE, is_eager=True, required=True, metavar="CERT.p12",
              help="PKCS#12 file with the private key and the certificate.")  # fmt: skip
@click.option("--password", envvar="ROOFSLIP_P12_PASSWORD",
              help="Password of CERT.p12; default: ROOFSLIP_P12_PASSWORD or a prompt.")  # fmt: skip
@click.option("--time-stamp", default="", metavar="URL",
              help="URL of a time-stamp authority (RFC 3161), for PAdES B-T.")  # fmt: skip
@click.option("--out", type=SOURCE, help="File to write; default: FILE-signed.pdf next to it.")
def sign(file: Path, **options: Any) -> None:
    """Sign a package in the field over its seal box (PAdES baseline).

    The package itself is not changed and still verifies. Nothing is sent, except to URL.
    """
    from report.cli.package_proof import sign_package

    sign_package(file, **options)
