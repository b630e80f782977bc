"""What the processes of the page do: jobs about what is open, and packages.

They read untrusted files: what they return is JSON, and is never unpickled. Read `answered`,
then `made`.
"""

from __future__ import annotations

import errno
import os
import tempfile
import traceback
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

from report.making import Step
from report.words.counts import capitalized
from report.workers import WorkerProcess, tell

FULL = "The disk is full. Make room there, then try it again."
INTERNAL = "An internal error; see what roofslip serve printed."

MOTIONS, SEED = 7, 1
"""Number and seed of the motions that are made for a workbook without any."""

PROJECT = "project.zip"
"""The workbook with its motions and all files beside it."""


def computing(folder: Path) -> WorkerProcess:
    """Start a process that computes."""
    return WorkerProcess(_prepare, is_trusted=False, within=folder)


def making(folder: Path, told: Callable[[str], object]) -> WorkerProcess:
    """Start a process that makes a package, with what it leaves behind in a folder."""
    return WorkerProcess(_prepare, is_trusted=False, told=told, within=folder)


def _prepare() -> None:
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the matrices are small; read as NumPy is loaded


def is_full(error: BaseException | None) -> bool:
    """Whether there is no room for what was to be written."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)


def answered(job: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the answer to a job, or why there is none."""
    try:
        from report.web.jobs import perform

        return perform(job)
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):
            return {"errno": error.errno}
        traceback.print_exc()
        return {"problems": [], "refused": INTERNAL}


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
