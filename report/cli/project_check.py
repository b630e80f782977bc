"""Reads a project, and prints the findings on it that are known before any run."""

from __future__ import annotations

from pathlib import Path

from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.project.read.read import read


def check_project(source: Path, *, quiet: bool, as_json: bool) -> None:
    """Print the findings on a project, as lines or JSON."""
    with (
        input_errors(source, as_json=as_json),
        Progress(3, quiet=quiet or as_json) as progress,
    ):
        progress("reading the workbook")
        sheet = read(source)
        # Only here: without the solver, an error in the workbook is printed 0.4 s sooner.
        from report.cli.project_findings import findings_before_runs, print_findings

        motions, findings = findings_before_runs(sheet, progress)
    if as_json or not quiet:
        print_findings(source, sheet, motions, findings, as_json=as_json)
