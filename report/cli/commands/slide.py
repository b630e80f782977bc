"""The command `roofslip slide`."""

from __future__ import annotations

from typing import Any

import click

from report.cli.options import AS_JSON, TIME_STEP, UNITS, Number


@click.command()
@click.argument("record")
@click.option("--slope-deg", required=True,
              type=Number("deg", -45.0, 45.0, is_open=True), help="Roof slope; positive if "
              "positive acceleration points downslope.")  # fmt: skip
@click.option("--mu", type=Number(low=0.0), required=True, help="Friction coefficient.")
@click.option("--transverse", metavar="RECORD", help="Second horizontal record, acting "
              "cross-slope.")  # fmt: skip
@click.option("--vertical", metavar="RECORD", help="Vertical record, positive up.")
@click.option(
    "--ppa-g", type=Number("g"), help="Scale all components so that RECORD peaks at this PPA."
)
@click.option("--factor", type=Number(), help="Scale all components by this factor.")
@click.option("--dt", "dt_s", type=TIME_STEP, help="Time step, if the record has no time column.")
@click.option("--units", type=UNITS,
              help="Units of the records, if the files do not state them.")  # fmt: skip
@AS_JSON
def slide(ppa_g: float | None, factor: float | None, **options: Any) -> None:
    """Compute the sliding of one block under one RECORD, for a quick check or in a script.

    If a file has several channels, give RECORD as "FILE | CHANNEL" (name or number).
    """
    if ppa_g is not None and factor is not None:
        raise click.UsageError("give --ppa-g or --factor, not both")
    from report.cli.one_block import slide_block

    slide_block(ppa_g=ppa_g, factor=factor, **options)
