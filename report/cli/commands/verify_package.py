"""The command `roofslip verify-package`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from report.cli.options import AS_JSON, QUIET, SOURCE


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
