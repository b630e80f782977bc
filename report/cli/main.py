"""The command line: every command by name. The modules of this room alone print and catch.

Heavy imports stay inside the commands so that `--help` is quick. Exit codes: 0 done, 2 the input is
at fault, 1 a defect of ours (with the traceback, or with the checks that failed). Read `report` for
the way from workbook to package.
"""

from __future__ import annotations

import click

from report.cli.motion import motion
from report.cli.report import check, new, report
from report.cli.slide import slide
from report.cli.verify import verify


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 96})
@click.version_option(package_name="roofslip", prog_name="roofslip")
def main() -> None:
    """Calculation packages for the seismic sliding of ballasted rooftop solar arrays.

    Begin with `roofslip new DIR`, fill DIR/input.xlsx, then run `roofslip report DIR`.
    """


for command in (check, motion, new, report, slide, verify):
    main.add_command(command)
