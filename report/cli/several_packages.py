"""`roofslip report` of several projects, one after the other, with one table at the end.

A failing project does not stop the others. Read `report.making` first.
"""

from __future__ import annotations

import gc
import math
import os
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, NoReturn

import click

from report.cli.console import INPUT_ERROR, INTERNAL_ERROR, NOT_OK, colored, plain, print_json, say
from report.cli.input_errors import (
    SCHEMA_VERSION,
    outputs_of,
    say_earlier_outputs,
    say_problems,
    system_problem,
    workbook_of,
)
from report.cli.one_package import report_one, warn_of_other_packages
from report.cli.progress import Progress
from report.making import make
from report.results.publish import check_of_workbook, output_folder
from report.steps import STEPS, Step
from report.text.aligned import aligned
from report.text.counts import numbered
from report.text.units import ratio
from solver.errors import InputError, Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportOutcome:
    """Outcome of one project, as in JSON."""

    source: str
    verdict: str | None = None
    demand_capacity: float | None = None  # the largest; NaN without a permitted displacement
    package: str | None = None  # path of the PDF
    errors: tuple[str, ...] = ()
    is_internal_error: bool = False
    seconds: float = 0.0


def report_projects(
    sources: Sequence[Path], out: Path | None, since: Path | None, **options: bool
) -> None:
    """Make the package of one project, or those of several with one table."""
    if len(sources) == 1:
        report_one(sources[0], out, since, **options)
        return
    if out or since:
        raise click.UsageError(
            "--out and --since are of one project; leave them out, and each project is written "
            "to its own out/, or report each on its own"
        )
    report_several(sources, **options)


def report_several(
    sources: Sequence[Path], *, fail_on_ng: bool, quiet: bool, as_json: bool, has_page: bool
) -> NoReturn:
    """Write the packages, print one table, and end with the exit code of the worst."""
    books = [workbook_of(source) for source in sources]
    # A link stays one: the package lies beside it.
    paths = [book.parent.resolve() / book.name for book in books]
    distinct = dict(zip(paths, sources, strict=True))
    # Packages of one folder would overwrite each other in its out/.
    folders = Counter(workbook.parent for workbook in distinct if os.path.isfile(workbook))
    outcomes = []
    for workbook, source in distinct.items():
        is_shared = folders[workbook.parent] > 1
        outcomes.append(package(source, is_shared, quiet=quiet, as_json=as_json, has_page=has_page))
        gc.collect()  # a package leaves much that refers to itself
    for folder, count in folders.items():
        if count > 1:
            say_earlier_outputs(outputs_of(folder, None))
    if as_json:
        print_json(document(outcomes))
    elif not quiet:
        for line in table(outcomes):
            click.echo(colored(line))
    sys.exit(exit_code(outcomes, fail_on_ng=fail_on_ng))


def exit_code(outcomes: Sequence[ReportOutcome], *, fail_on_ng: bool) -> int:
    """Return the code of the worst outcome."""
    if any(outcome.is_internal_error for outcome in outcomes):
        return INTERNAL_ERROR
    if any(outcome.errors for outcome in outcomes):
        return INPUT_ERROR
    # A condition is not OK either.
    is_not_ok = any(outcome.verdict != "OK" for outcome in outcomes)
    return NOT_OK if fail_on_ng and is_not_ok else 0


def document(outcomes: Sequence[ReportOutcome]) -> Mapping[str, Any]:
    """Return the outcomes for JSON, with null for no value."""
    projects = [asdict(outcome) for outcome in outcomes]
    for project in projects:
        if not math.isfinite(project["demand_capacity"] or 0.0):
            project["demand_capacity"] = None
    return {"schema_version": SCHEMA_VERSION, "projects": projects}


def package(
    source: Path, is_shared: bool, *, quiet: bool, as_json: bool, has_page: bool
) -> ReportOutcome:
    """Make the package of one project; every error is printed and part of the outcome.

    If its folder contains other projects, it is written to its own folder below out/.
    """
    started = time.monotonic()
    lines: list[str] = []
    workbook = workbook_of(source)
    out = None
    outcome = ReportOutcome(source=str(source))
    problems: Sequence[Problem] = ()
    try:
        if is_shared:
            out = output_folder(None, workbook.parent, f"out/{workbook.stem}")
            check_of_workbook(out, "results.json", workbook.name)
        with Progress(STEPS, quiet=quiet or as_json) as progress:

            def say_step(step: Step) -> None:
                progress(f"{source}: {step}")

            made = make(source, out, None, say_step, lines.append, has_page=has_page)
        pdf = made.folder / "calc-package.pdf"
        warn_of_other_packages(pdf)
        outcome = replace(
            outcome,
            verdict=made.assessment.verdict.value,
            demand_capacity=largest(check.demand_capacity for check in made.assessment.clearances),
            package=str(pdf),
        )
    except InputError as error:
        problems = error.parts
    except OSError as error:
        problems = (system_problem(error),)
    # One project that fails in the program stops no other.
    except Exception:
        click.echo(f"{plain(source)}: {traceback.format_exc()}", err=True)
        outcome = replace(outcome, is_internal_error=True)
    if not (quiet or as_json):
        for line in lines:
            say(line)
    if problems and not as_json:
        say_problems(source, problems)
    # Without a package the files that are there are of an earlier run.
    if not outcome.verdict:
        say_earlier_outputs(outputs_of(source, out))
    seconds = round(time.monotonic() - started, 3)
    return replace(outcome, errors=tuple(map(str, problems)), seconds=seconds)


def largest(ratios: Iterable[float]) -> float | None:
    """Return the largest D/C, where NaN is the worst; nothing without clearances."""
    # NaN compares with nothing: it is sorted by being one.
    return max(ratios, key=lambda ratio: (math.isnan(ratio), ratio), default=None)


def table(outcomes: Sequence[ReportOutcome]) -> Iterator[str]:
    """Return the headings and a line for each project."""
    rows = [("project", "verdict", "D/C", "time", "package")]
    for outcome in outcomes:
        verdict = outcome.verdict or numbered(len(outcome.errors), "error")
        if outcome.is_internal_error:
            verdict = "internal error"
        ratio_text = ratio(outcome.demand_capacity) if outcome.demand_capacity is not None else ""
        time_text = f"{outcome.seconds:.1f} s"
        rows.append((outcome.source, verdict, ratio_text, time_text, outcome.package or ""))
    return aligned(rows)
