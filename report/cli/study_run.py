"""Runs a study, and prints its size, progress and main result."""

from __future__ import annotations

from pathlib import Path

from report.cli.console import say
from report.cli.input_errors import input_errors, workbook_of
from report.cli.progress import Progress
from report.results.publish import check_apart, check_of_workbook, output_folder
from report.study.exports import LIBRARY
from report.study.manifest import NAME
from report.study.outputs import TABLE, make_study
from report.study.run_study import estimate, planned
from report.study.sentences import headline


def run(
    source: Path,
    out: Path | None,
    *,
    dry_run: bool,
    scheduler: str,
    allow_matched: bool,
    trust_parts: bool,
    quiet: bool,
) -> None:
    """Run the missing part of a study and publish its files; with `dry_run`, print the number."""
    folder = out or workbook_of(source).parent / "out/study"
    names = () if dry_run else ("study.pdf", "curves.csv", TABLE, LIBRARY)
    with input_errors(source, outputs=[folder / name for name in names]):
        plan, home = planned(source)
        for cell, text in plan.warnings:
            say(f"warning: {cell}: {text}", is_error=True)
        if dry_run:
            cost = estimate(plan)
            capacity_runs = f"; at most {cost.capacity_runs:,} more runs for the capacities"
            say(
                f"{cost.cases:,} cases, {cost.runs:,} runs in {cost.parts:,} batches"
                f"{capacity_runs if cost.capacity_runs else ''}"
            )
            say(f"{cost.disk_bytes / 1e6:,.1f} MB of disk space")
            return
        folder = output_folder(out, home, "out/study", (TABLE, NAME))
        # A folder that was asked for by name may have the study of another workbook.
        if out is None:
            check_of_workbook(folder, NAME, plan.workbook)
        # The table is a workbook as well: a study named study.xlsx would be replaced by its own
        # results.
        check_apart([TABLE], folder, [source, source / "input.xlsx"])
        with Progress(quiet=quiet) as progress:
            results, files = make_study(
                plan,
                folder,
                progress,
                scheduler=scheduler,
                allow_matched=allow_matched,
                trust_parts=trust_parts,
            )
    if quiet:
        return
    first, *further = headline(results)
    # The time is no result, and not in the files to read.
    seconds = results.manifest["processor_seconds"]
    for line in (f"{first}, {seconds:,.0f} s of processor time", *further):
        say(line)
    for name in files:
        say(folder / name)
