"""What the processes of the page do, within which limits: jobs of the sessions, and packages.

They read untrusted files: what they return is JSON, and is never unpickled. Read `answered`,
then `made`.
"""

from __future__ import annotations

import gc
import tempfile
import traceback
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

from report.making import Step
from report.web.limits import FULL, INTERNAL, confine, is_full
from report.words.counts import capitalized
from report.workers import WorkerProcess, tell

NICE = 5
"""How far the others give way to the process of quick jobs, as the command nice has it."""

MOTIONS, SEED = 7, 1
"""Number and seed of the motions that are made for a workbook without any."""

PROJECT = "project.zip"
"""The workbook with its motions and all files beside it."""

_OF_JOBS = {"RLIMIT_AS": 6 << 30}
_OF_PACKAGES = {"RLIMIT_AS": 8 << 30, "RLIMIT_FSIZE": 1 << 30, "RLIMIT_CPU": 900}
_NICE_OF_PACKAGES = 10
_TOO_LARGE = "this needs more memory than a session may use; drop fewer or shorter records"


def computing(folder: Path, is_quick: bool) -> WorkerProcess:
    """Start a process that computes; the others give way to that of quick jobs."""
    limits = partial(confine, 0 if is_quick else NICE, **_OF_JOBS)
    return WorkerProcess(limits, is_trusted=False, within=folder)


def making(folder: Path, told: Callable[[str], object]) -> WorkerProcess:
    """Start a process that makes a package, with what it leaves behind in a folder."""
    limits = partial(confine, _NICE_OF_PACKAGES, **_OF_PACKAGES)
    return WorkerProcess(limits, is_trusted=False, told=told, within=folder)


def warmed(job: Mapping[str, Any]) -> None:
    """Do a first job, whose answer nobody waits for."""
    answered(job)
    # What it loaded stays: searching it for garbage would hold up an answer now and then by a
    # tenth of a second.
    gc.collect()
    gc.freeze()


def answered(job: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the answer to a job, or why there is none."""
    try:
        from report.web.jobs import perform

        return perform(job)
    except MemoryError:
        return _refused(_TOO_LARGE)
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):
            return {"errno": error.errno}
        traceback.print_exc()
        return _refused(INTERNAL)


def _refused(why: str) -> Mapping[str, Any]:
    return {"problems": [], "refused": why}


def made(workbook: Path, out: Path) -> str:
    """Make a package, telling its steps; return why there is none, in the words of the page."""
    from report.making import make

    return _failure(lambda: make(workbook, out, None, lambda step: tell(in_words(step))))


def motions_made(workbook: Path, out: Path) -> str:
    """Make motions for the site of a workbook and list them in it, likewise; zip the project."""

    def do() -> None:
        from report.results.motions import add_suite, suite_rows
        from report.sheet.reading.read import read
        from report.sheet.writing.filled import BEFORE
        from report.suite.files import generate
        from report.suite.inputs import read_seeds
        from report.suite.site import site_targets

        sheet = read(workbook)
        targets, _ = site_targets(sheet)
        records = workbook.parent / "records"
        rows = suite_rows(sheet.book, records, MOTIONS, targets.source(SEED))
        tell("Preparing the motions")
        no_seeds, say = read_seeds(()), lambda doing: tell(capitalized(doing))
        _, files = generate(targets, MOTIONS, SEED, no_seeds, say)
        add_suite(workbook, records, rows, files)
        out.mkdir(exist_ok=True)
        left_out = {out, Path(tempfile.gettempdir())}
        with ZipFile(out / PROJECT, "w", ZIP_DEFLATED) as archive:
            for path in sorted(workbook.parent.rglob("*")):
                if left_out.isdisjoint((path, *path.parents)) and not path.name.endswith(BEFORE):
                    archive.write(path, path.relative_to(workbook.parent))

    return _failure(do)


def _failure(do: Callable[[], object]) -> str:
    """Do something; return why it failed, in the words of the page."""
    try:
        do()
    except MemoryError:
        return "It needs more memory than a package may use."
    except Exception as error:
        from solver.model import InputError

        if is_full(error) or is_full(error.__cause__):
            return FULL
        if isinstance(error, InputError):
            return error.problems[0]
        traceback.print_exc()
        return INTERNAL
    return ""


def in_words(step: Step) -> str:
    """Return a step as a sentence of the page; its hint is of the terminal."""
    return capitalized(str(replace(step, hint="")))
