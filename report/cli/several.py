"""`roofslip report` of several projects, one after the other, with one table at the end.

A project that fails stops no other. Read `report.making` first.
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
from typing import TYPE_CHECKING, Any, NoReturn

import click

from report.cli.terminal import (
    INPUT_ERROR,
    INTERNAL_ERROR,
    NOT_OK,
    SCHEMA_VERSION,
    Progress,
    colored,
    outputs_of,
    plain,
    print_json,
    say,
    say_former,
    say_problems,
    system_problem,
    warn_of_others,
    workbook_of,
)
from report.text.counts import numbered

if TYPE_CHECKING:
    from report.making import Step
    from solver.model import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class ReportOutcome:
    """What became of one project, as JSON has it."""

    source: str
    verdict: str | None = None
    demand_capacity: float | None = None  # the largest; NaN without a permitted displacement
    package: str | None = None  # path of the PDF
    errors: tuple[str, ...] = ()
    is_internal_error: bool = False
    seconds: float = 0.0


def report_several(
    sources: Sequence[Path], *, fail_on_ng: bool, quiet: bool, as_json: bool, has_page: bool
) -> NoReturn:
    """Write the packages, print one table, and end with the exit code of the worst."""
    books = [workbook_of(source) for source in sources]
    # A link stays one: the package lies beside it.
    places = [book.parent.resolve() / book.name for book in books]
    distinct = dict(zip(places, sources, strict=True))
    # Packages of one folder would overwrite each other in its out/.
    homes = Counter(workbook.parent for workbook in distinct if os.path.isfile(workbook))
    outcomes = []
    for workbook, source in distinct.items():
        is_shared = homes[workbook.parent] > 1
        outcomes.append(package(source, is_shared, quiet=quiet, as_json=as_json, has_page=has_page))
        gc.collect()  # a package leaves much that refers to itself
    for home, count in homes.items():
        if count > 1:
            say_former(outputs_of(home, None))
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

    Where its folder is that of others as well, to a folder of its own below out/.
    """
    from report.making import STEPS, make
    from report.results.publish import check_of_workbook, output_folder
    from solver.model import InputError

    started, lines = time.monotonic(), list[str]()
    workbook, out = workbook_of(source), None
    done = ReportOutcome(source=str(source))
    problems: Sequence[Problem] = ()
    try:
        if is_shared:
            out = output_folder(None, workbook.parent, f"out/{workbook.stem}")
            check_of_workbook(out, "results.json", workbook.name)
        with Progress(STEPS, quiet=quiet or as_json) as progress:

            def say_step(step: Step) -> None:
                progress(f"{source}: {step}")

            made = make(source, out, None, say_step, lines.append, has_page=has_page)
        assessment, folder, *_ = made
        warn_of_others(folder / "calc-package.pdf")
        done = replace(
            done,
            verdict=assessment.verdict.value,
            demand_capacity=largest(gap.demand_capacity for gap in assessment.clearances),
            package=str(folder / "calc-package.pdf"),
        )
    except InputError as error:
        problems = error.parts
    except OSError as error:
        problems = (system_problem(error),)
    # One project that fails in the program stops no other.
    except Exception:
        click.echo(f"{plain(source)}: {traceback.format_exc()}", err=True)
        done = replace(done, is_internal_error=True)
    if not (quiet or as_json):
        for line in lines:
            say(line)
    if problems and not as_json:
        say_problems(source, problems)
    # Without a package the files that are there are of an earlier run.
    if not done.verdict:
        say_former(outputs_of(source, out))
    seconds = round(time.monotonic() - started, 3)
    return replace(done, errors=tuple(map(str, problems)), seconds=seconds)


def largest(ratios: Iterable[float]) -> float | None:
    """Return the largest D/C, of which NaN is the worst; nothing without clearances."""
    # NaN compares with nothing: it is sorted by being one.
    return max(ratios, key=lambda ratio: (math.isnan(ratio), ratio), default=None)


def table(outcomes: Sequence[ReportOutcome]) -> Iterator[str]:
    """Return the headings and a line for each project."""
    from report.text.formats import aligned
    from report.text.units import ratio

    rows = [("project", "verdict", "D/C", "time", "package")]
    for one in outcomes:
        wrong = "internal error" if one.is_internal_error else numbered(len(one.errors), "problem")
        worst = "" if one.demand_capacity is None else ratio(one.demand_capacity)
        time_s = f"{one.seconds:.1f} s"
        rows.append((one.source, one.verdict or wrong, worst, time_s, one.package or ""))
    return aligned(rows)
