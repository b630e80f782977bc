"""The command `roofslip sbom`: what software a package is computed by."""

from __future__ import annotations

from pathlib import Path

import click

from report.cli.terminal import SOURCE, input_errors


@click.command()
@click.option("--out", type=SOURCE, help="File to write; without it the bill is printed.")
def sbom(out: Path | None) -> None:
    """Write the software bill of materials as CycloneDX JSON.

    It lists the installed distributions that a package needs, and has no time stamp: packages print
    its SHA-256.
    """
    from report.provenance.software import sbom as bill
    from report.provenance.software import sbom_sha256
    from solver.files import write_whole

    if out is None:
        click.echo(bill().decode(), nl=False)
        return
    with input_errors(out):
        write_whole(out, bill())
    click.echo(f"{out}: SHA-256 {sbom_sha256()}")
