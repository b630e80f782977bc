"""The command `roofslip motion suite`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import click

from report.cli.option_types import SOURCE, Number, reading


@click.command()
@click.argument("folder", metavar="DIR", type=SOURCE)
# `--records *.AT2` comes from the shell as many words, of which an option takes the first alone.
@click.argument("more", metavar="", nargs=-1)
@click.option("--sds", "s_ds_g", type=Number("g"), help="S_DS.")
@click.option("--zh", "z_over_h", type=Number(),
              help="Height ratio z/h of the array; 1 by default.")  # fmt: skip
@click.option("--code", help="Edition for the AC156 target spectrum, e.g. asce7-16 or pv1.")
@click.option("--tail", type=click.Choice(["ac156", "1/T"]), help="Target below 1.3 Hz: the AC156 "
              "line (default) or 1/T.")  # fmt: skip
@click.option("--target", metavar="BOOK.xlsx!SHEET|CSV", help="Your own target spectrum, with "
              "columns frequency [Hz] or period [s], horizontal [g], vertical [g].")  # fmt: skip
@click.option("--count", type=click.IntRange(1, 99), default=7, show_default=True,
              help="Number of motions.")  # fmt: skip
@click.option("--seed", type=click.IntRange(0), default=1, show_default=True,
              help="The same seed gives the same files.")  # fmt: skip
@click.option("--records", metavar="FILES", multiple=True, help="Use records as seeds, not noise: "
              "one motion per file or comma-separated group. Must follow DIR.")  # fmt: skip
@click.option("--into", metavar="DIR|WORKBOOK", type=SOURCE, help="Add the motions to the Motions "
              "worksheet; DIR must be in the folder of the workbook. Without --sds, --zh, --code, "
              "--tail and --target, the Site worksheet defines the target.")  # fmt: skip
@reading
def suite(folder: Path, more: tuple[str, ...], records: tuple[str, ...], **options: Any) -> None:
    """Generate spectrum-compatible motions in DIR: x, y and z records, suite.json, suite.png.

    Each motion lasts 30 s, including a rise of 5 s and a decay of 5 s, and ends with zero velocity
    and displacement. Existing files with the same names are replaced.
    """
    if more and not records:
        raise click.UsageError(f"unexpected argument '{more[0]}'; put --records before the files")
    # Before NumPy is loaded: the motions are on all cores already.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from report.cli.motion_suite import generate_suite

    generate_suite(folder, seed_files=(*records, *more), **options)
