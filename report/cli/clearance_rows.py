"""Adds the clearances of the roof plan to the sheet Clearances of a workbook."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from report.assessment.assess import assess
from report.assessment.design.arrays import ArrayAssessment
from report.assessment.plan.missing_rows import missing_rows, without_clearances
from report.cli.console import say, say_next
from report.cli.input_errors import input_errors
from report.cli.progress import Progress
from report.motions.prepare import prepare
from report.project.read.read import read_book, without_motions
from report.project.write.filled import WorkbookChange, changing, withdrawn
from solver.errors import InputError


def fill_clearances(project: Path) -> None:
    """Add a row for each pair on the plan that a package would require, and print the rows."""
    with input_errors(project), changing(project) as change:
        lines = [*add_clearances(change), *withdrawn(change)]
    for line in lines:
        say(line)
    if change.written:
        say(change.book.path, f": written: {change.areas}")
    say_next(project, change.has_formulas)


def add_clearances(change: WorkbookChange) -> Sequence[str]:
    """Add the missing rows of clearances to a workbook; return the lines to print."""
    # After `plan read` in the same change, the plan that it filled in counts, not the one on disk.
    sheet = read_book(change.book) if change.written else change.sheet_before
    not_run: list[str] = []
    without_motions(sheet)  # its errors, before any run
    arrays: Sequence[ArrayAssessment] = ()
    with Progress(1) as progress:
        try:
            to_run = without_clearances(sheet)
            shaking = prepare(to_run)
            progress("running the motions")
            arrays = assess(to_run, shaking).arrays
        except InputError as error:
            # Rows within twice the prescriptive displacement are known without a run.
            not_run = [f"cannot run the motions: {error.problems[0]}"]
    cells, lines = missing_rows(sheet, arrays)
    change.fill(cells)
    return [*not_run, *lines]
