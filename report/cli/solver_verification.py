"""Verifies the solver and the comparison methods, and writes the verification manual."""

from __future__ import annotations

import datetime as dt
import sys
from pathlib import Path

from report.cli.console import say
from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.manual.manual_files import files as manual_files
from report.results.publish import output_folder, publish
from report.text.counts import numbered
from solver.verification.building import recorded_buildings
from solver.verification.run import verify
from solver.verification.verification_motions import recorded_triples

# One for each call of `progress`: ten in `verify`, two in `manual_files`, the last below.
VERIFY_STEPS = (18, 2, 3, 9, 11, 5, 0.1, 5, 0.1, 0.5, 7, 33, 2)
"""Usual shares of the time of the steps that a verification reports, as with --quick."""

_DEFAULT_FOLDER = "out"


def verify_solver(out: Path | None, *, quick: bool, records: Path | None) -> None:
    """Write the manual, and print how many checks passed; exit with code 1 if any failed."""
    source = records or out or Path(_DEFAULT_FOLDER)
    with input_errors(source), Progress(VERIFY_STEPS) as progress:
        out = output_folder(out, Path(), _DEFAULT_FOLDER)
        verification = verify(
            quick=quick,
            progress=progress,
            buildings=recorded_buildings(records) if records else (),
            motions=recorded_triples(records) if records else (),
        )
        files = manual_files(verification, dt.date.today(), progress)
        progress("writing the files")
        # Before the exit code: a failed check is what the manual is read for.
        publish(files, out)
    failed = [row for row in verification.checks if not row.passed]
    passed = len(verification.checks) - len(failed)
    verdict = "FAIL" if failed else "PASS"
    say(f"{verdict}: {passed} of {len(verification.checks)} checks passed")
    if verification.left_out:
        left_out = numbered(len(verification.left_out), "check")
        say(f"{left_out} left out: SciPy is not installed; install the extra verify")
    for row in failed:
        say(
            f"  {row.section}: {row.problem}, {row.quantity}: expected {row.expected:.10g}, found "
            f"{row.computed:.10g} {row.unit}, error {row.error:.1e} exceeds "
            f"{row.tolerance:.1e}"
        )
    for name in files:
        say(out / name)
    # Without any check nothing passed either.
    if failed or not verification.checks:
        sys.exit(1)
