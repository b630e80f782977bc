"""The command `roofslip verify-package`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import AS_JSON, QUIET, SOURCE


@click.command("verify-package")
@click.argument("file", metavar="FILE.pdf", type=SOURCE)
@click.option("--records", type=SOURCE, metavar="FOLDER",
              help="Of the workbook, where the package only lists its records.")  # fmt: skip
@click.option("--out", type=SOURCE,
              help="Where the package made again is written if drawings were not compared; "
              "default: FILE-again.pdf beside it.")  # fmt: skip
@QUIET
@AS_JSON
def verify_package(file: Path, **options: Any) -> None:
    """Make a package again from the input inside it, and compare the bytes.

    Exit codes: 0 the same; 4 not compared in full, as where another processor, system or version
    made it: numbers and words agree, drawings were not compared, and the package made again is
    written; 1 it differs, and where first; 2 it cannot be made again with what is given. Signatures
    that were put on after the package was written are no difference.
    """
    from report.cli.package_proof import prove

    prove(file, **options)
