"""The command `roofslip study`: curves, fragilities and probabilities from a study workbook.

Read `make` first: one line for each step from workbook to files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from report.cli.terminal import (
    QUIET,
    SOURCE,
    Progress,
    input_errors,
    plain,
    workbook_of,
)

if TYPE_CHECKING:
    from report.study.plan import StudyPlan
    from report.study.results import StudyResults
    from report.study.run import Estimate


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE, help="Output folder; default: out/study/ beside the input.")
@click.option("--dry-run", is_flag=True, help="Print runs, parts and disk; run nothing.")
@click.option("--scheduler", metavar="tcp://HOST:PORT", default="",
              help="Run on an existing Dask cluster instead of this machine.")  # fmt: skip
@click.option("--allow-matched", is_flag=True,
              help="Export fragilities of motions matched to one spectrum, with a warning in"
              " fragility.csv.")  # fmt: skip
@click.option("--trust-parts", is_flag=True,
              help="Take over parts that are not signed with your key, of another user or machine;"
              " the results say how many.")  # fmt: skip
@QUIET
def study(
    source: Path,
    out: Path | None,
    dry_run: bool,
    quiet: bool,
    **options: Any,
) -> None:
    """Run a study workbook: write study.pdf, curves.csv, study.xlsx, fragilities and every run.

    A study that was killed goes on where it was. `roofslip new DIR --study` writes a blank
    workbook.
    """
    from report.study.manifest import NEEDED, extra

    # Before anything is imported that needs them.
    with input_errors(source):
        for name in NEEDED:
            extra(name)

    from report.results.publish import check_apart, check_of_workbook, output_folder
    from report.study.exports import LIBRARY
    from report.study.files import TABLE
    from report.study.manifest import NAME
    from report.study.run import estimate, planned

    folder = out or workbook_of(source).parent / "out/study"
    outputs = (
        () if dry_run else [folder / name for name in ("study.pdf", "curves.csv", TABLE, LIBRARY)]
    )
    with input_errors(source, outputs=outputs):
        plan, beside = planned(source)
        for cell, text in plan.warnings:
            click.echo(plain(f"warning: {cell}: {text}"), err=True)
        if dry_run:
            _print_estimate(estimate(plan))
            return
        folder = output_folder(out, beside, "out/study", (TABLE, NAME))
        # A folder that was asked for by name may have the study of another workbook.
        if out is None:
            check_of_workbook(folder, NAME, plan.workbook)
        check_apart([TABLE], folder, [source, source / "input.xlsx"])
        with Progress(quiet=quiet) as progress:
            results, files = make(plan, folder, progress, **options)
    if not quiet:
        for line in summary(results):
            click.echo(plain(line))
        for name in files:
            click.echo(folder / name)


def make(
    plan: StudyPlan,
    folder: Path,
    progress: Callable[[str], None],
    **options: Any,
) -> tuple[StudyResults, Mapping[str, bytes]]:
    """Run a study and publish its files; another run to the same folder waits until it ends.

    Options are those of `report.study.run.run_study`.
    """
    from report.project.read.study_years import YEARS
    from report.results.publish import publish
    from report.study.exports import LIBRARY
    from report.study.files import study_files
    from report.study.run import RUNS, run_study
    from solver.files import add_folder, check_plain, locked

    runs = folder / RUNS
    check_plain(runs, folder, is_folder=True)
    with ExitStack() as undo:
        # Where nothing ran, as with no cluster, nothing new stays.
        add_folder(runs, undo)
        with locked(runs):
            results = run_study(plan, folder, progress=progress, **options)
            progress("writing the report")
            files = study_files(results)
            publish(files, folder)
            # A former study may have had them: left there, they would pass for results of this one.
            for name in (LIBRARY, YEARS):
                if name not in files:
                    (folder / name).unlink(missing_ok=True)
        undo.pop_all()
    return results, files


def _print_estimate(estimate: Estimate) -> None:
    most = f"; at most {estimate.capacity_runs:,} more runs for the capacities"
    more = most if estimate.capacity_runs else ""
    click.echo(
        f"{estimate.cases:,} cases, {estimate.runs:,} runs in {estimate.parts:,} parts{more}"
    )
    click.echo(f"{estimate.disk_bytes / 1e6:,.1f} MB on disk")


def summary(results: StudyResults) -> list[str]:
    """Return what to print at the end; the time is no result and not in the files to read."""
    from report.study.wording import headline

    first, *others = headline(results)
    return [f"{first}, {results.manifest['processor_seconds']:,.0f} s of processor time", *others]
