"""`roofslip report` of several projects, in as many processes as cores.

A project that fails stops no other. Read `report.making` first.
"""

from __future__ import annotations

import math
import os
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import click

from report.cli.terminal import (
    INPUT_ERROR,
    INTERNAL_ERROR,
    NOT_OK,
    SCHEMA_VERSION,
    Progress,
    colored,
    no_collections,
    outputs_of,
    plain,
    print_json,
    say_former,
    show_warnings,
    system_problem,
    warn_of_others,
    workbook_of,
)
from report.text.counts import numbered

if TYPE_CHECKING:
    from report.workers import WorkerProcess
    from solver.model import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportOutcome:
    """What became of one project, as finished text."""

    source: Path
    verdict: str = ""  # empty without a package
    ratios: tuple[float, ...] = ()  # D/C of its clearances; NaN without a permitted displacement
    package: str = ""  # path of the PDF
    problems: tuple[Problem, ...] = ()  # input errors
    lines: tuple[str, ...] = ()  # what was put on record in the workbook
    internal: str = ""  # traceback of an internal error; empty for none
    left: tuple[tuple[Path, ...], ...] = ()  # outputs, by folder, of another run if they are there
    seconds: float = 0.0

    @property
    def word(self) -> str:
        """The verdict, or which error there is instead."""
        count = len(self.problems)
        errors = numbered(count, "problem") if count else "internal error"
        return self.verdict or errors

    @property
    def largest(self) -> tuple[float, ...]:
        """The largest D/C alone, of which NaN is the worst; nothing without clearances."""
        # NaN compares with nothing: it is sorted by being one.
        return tuple(sorted(self.ratios, key=lambda r: (r != r, r))[-1:])


def report_several(
    sources: Sequence[Path], *, fail_on_ng: bool, quiet: bool, as_json: bool
) -> NoReturn:
    """Write the packages, print one table, and end with the exit code of the worst."""
    from report.sheet.checking.findings import grouped

    outcomes = run(sources, quiet=quiet or as_json)
    if as_json:
        print_json(document(outcomes))
    elif not quiet:
        for line in table(outcomes):
            click.echo(colored(line))
        for line in (line for outcome in outcomes for line in outcome.lines):
            click.echo(plain(line))
    for outcome in outcomes:
        problems = () if as_json else (each.line for each in grouped(outcome.problems))
        for text in (*problems, *outcome.internal.splitlines()):
            click.echo(f"{outcome.source}: {text}", err=True)
    for left in dict.fromkeys(left for outcome in outcomes for left in outcome.left):
        say_former(left)
    sys.exit(exit_code(outcomes, fail_on_ng=fail_on_ng))


def exit_code(outcomes: Sequence[ReportOutcome], *, fail_on_ng: bool) -> int:
    """Return the code of the worst outcome."""
    if any(outcome.internal for outcome in outcomes):
        return INTERNAL_ERROR
    if any(outcome.problems for outcome in outcomes):
        return INPUT_ERROR
    # A condition is not OK either.
    is_not_ok = any(outcome.verdict != "OK" for outcome in outcomes)
    return NOT_OK if fail_on_ng and is_not_ok else 0


def document(outcomes: Sequence[ReportOutcome]) -> Mapping[str, Any]:
    """Return the outcomes for JSON, with null for no value."""
    return {
        "schema_version": SCHEMA_VERSION,
        "projects": [
            {
                "source": str(outcome.source),
                "verdict": outcome.verdict or None,
                "demand_capacity": next(filter(math.isfinite, outcome.largest), None),
                "package": outcome.package or None,
                "errors": list(map(str, outcome.problems)),
                "is_internal_error": bool(outcome.internal),
                "seconds": round(outcome.seconds, 3),
            }
            for outcome in outcomes
        ],
    }


def run(sources: Sequence[Path], *, quiet: bool) -> Sequence[ReportOutcome]:
    """Make each package once, and return the outcomes in the order given."""
    from solver.model import DefectError

    books = [workbook_of(source) for source in sources]
    # A link stays one: the package lies beside it.
    places = [book.parent.resolve() / book.name for book in books]
    distinct = dict(zip(places, sources, strict=True))
    # Packages of one folder would overwrite each other in its out/.
    homes = Counter(workbook.parent for workbook in distinct if os.path.isfile(workbook))
    shared = {source for workbook, source in distinct.items() if homes[workbook.parent] > 1}
    count = min(len(distinct), os.cpu_count() or 1)
    # Taken from the end: the first project given is the first to start.
    waiting, outcomes = [*distinct.values()][::-1], dict[Path, ReportOutcome]()
    running: dict[Future[ReportOutcome], tuple[Path, WorkerProcess]] = {}
    with Progress(len(distinct), quiet=quiet) as progress, ExitStack() as stack:
        idle = [stack.enter_context(_worker()) for _ in range(count)]
        while waiting or running:
            while waiting and idle:
                source, worker = waiting.pop(), idle.pop()
                running[worker.submit(package, source, source in shared)] = source, worker
            done = len(outcomes)
            progress(f"{done} of {len(distinct)} projects done", done)
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                source, worker = running.pop(future)
                try:
                    outcomes[source] = future.result()
                except DefectError as error:
                    outcomes[source] = ReportOutcome(source=source, internal=str(error))
                    # The process that ended is gone: another takes its place.
                    worker = stack.enter_context(_worker())
                idle.append(worker)
    return [outcomes[source] for source in distinct.values()]


def _worker() -> WorkerProcess:
    from report.workers import WorkerProcess

    try:
        return WorkerProcess(show_warnings)
    except OSError as error:
        raise click.UsageError(
            f"the system starts no other process ({error.strerror}), and several projects need"
            " them; give one project at a time"
        ) from error


def package(source: Path, is_shared: bool = False) -> ReportOutcome:
    """Make the package of one project; every error is part of the outcome.

    Where its folder is that of others as well, to a folder of its own below out/.
    """
    from report.making import make
    from report.results.publish import check_of_workbook, output_folder
    from solver.model import InputError

    started, lines = time.monotonic(), list[str]()
    workbook = workbook_of(source)
    out, left = None, (outputs_of(source, None),) if is_shared else ()
    try:
        if is_shared:
            out = output_folder(None, workbook.parent, f"out/{workbook.stem}")
            check_of_workbook(out, "results.json", workbook.name)
        with no_collections():
            made = make(source, out, None, lambda _: None, on_record=lines.append)
        assessment, folder, *_ = made
        warn_of_others(folder / "calc-package.pdf")
        done = ReportOutcome(
            source=source,
            verdict=assessment.verdict.value,
            ratios=tuple(gap.demand_capacity for gap in assessment.clearances),
            package=str(folder / "calc-package.pdf"),
        )
    except InputError as error:
        done = ReportOutcome(source=source, problems=error.parts)
    except OSError as error:
        done = ReportOutcome(source=source, problems=(system_problem(error),))
    # One project that fails in the program stops no other.
    except Exception:
        done = ReportOutcome(source=source, internal=traceback.format_exc())
    # Without a package the files that are there are of an earlier run.
    if not done.verdict:
        left = (outputs_of(source, out), *left)
    return replace(done, lines=tuple(lines), left=left, seconds=time.monotonic() - started)


_COLUMNS = ("project", "verdict", "D/C", "time", "package")


def table(outcomes: Sequence[ReportOutcome]) -> Iterator[str]:
    """Return the headings and a line for each project."""
    from report.text.formats import aligned
    from report.text.units import ratio

    rows = (
        (str(o.source), o.word, "".join(map(ratio, o.largest)), f"{o.seconds:.1f} s", o.package)
        for o in outcomes
    )
    return aligned([_COLUMNS, *rows])
