"""The processes of the page, and the packages and suites of motions that they generate.

They read untrusted files: what they return is JSON, and is never unpickled. Read `made`, then
`Packages`.
"""

from __future__ import annotations

import asyncio
import errno
import gc
import os
import secrets
import shutil
import tempfile
import traceback
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

from report.results.publish import OUTPUTS
from report.steps import STEPS, Step
from report.text.letter_case import capitalized
from report.web.processes import WorkerProcess, tell
from report.web.values import Values

FULL = "The disk is full. Make room there, then try it again."
INTERNAL = "An internal error; see what roofslip serve printed."

MOTIONS, SEED = 7, 1
"""Number and seed of the motions that are made for a workbook without any."""

PROJECT = "project.zip"
"""The workbook with its motions and all files beside it."""


def begun(folder: Path, told: Callable[[str], object] = lambda _: None) -> WorkerProcess:
    """Start a process whose leftover files are in a folder."""
    folder.mkdir(0o700, exist_ok=True)  # a cleaner of /tmp may have removed it
    return WorkerProcess(_prepare, told=told, within=folder)


def _prepare() -> None:
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the matrices are small; read as NumPy is loaded
    # As in `report.cli.main`: else collections take 5 ms of an answer of 40 about 30 arrays.
    gc.set_threshold(100_000, 20, 100)


def is_full(error: BaseException | None) -> bool:
    """Whether there is no disk space for the files to write."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)


def made(workbook: Path, out: Path) -> str:
    """Build a package, reporting its steps; return why it failed, in the page's terms."""
    from report.making import make

    return _failure(lambda: make(workbook, out, None, lambda step: tell(in_words(step))))


def motions_made(workbook: Path, out: Path) -> str:
    """Make motions for the site of a workbook and list them in it, likewise; zip the project."""

    def do() -> None:
        from report.project.read.read import read
        from report.project.write.filled import BEFORE
        from report.results.added_motions import add_suite, suite_rows
        from report.suite.seed_records import read_seeds
        from report.suite.suite_files import generate
        from report.suite.targets import site_targets

        sheet = read(workbook)
        targets, _ = site_targets(sheet)
        records = workbook.parent / "records"
        rows = suite_rows(sheet.book, records, MOTIONS, targets.source(SEED))
        tell("Preparing the motions")
        no_seeds, say = read_seeds(()), lambda doing: tell(capitalized(doing))
        _, files = generate(targets, MOTIONS, SEED, no_seeds, say)
        add_suite(workbook, records, rows, files)
        out.mkdir(exist_ok=True)
        # The zip itself, and what this process writes meanwhile.
        left_out = {out, Path(tempfile.gettempdir())}
        with ZipFile(out / PROJECT, "w", ZIP_DEFLATED) as archive:
            for path in sorted(workbook.parent.rglob("*")):
                if left_out.isdisjoint((path, *path.parents)) and not path.name.endswith(BEFORE):
                    archive.write(path, path.relative_to(workbook.parent))

    return _failure(do)


def _failure(do: Callable[[], object]) -> str:
    """Do something; return the reason for a failure, in the page's terms."""
    try:
        do()
    except Exception as error:
        from solver.errors import InputError

        # An error in words has the one of the system as its cause.
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


LONGEST_S = 900.0
"""Longest time of a package [s]; then its process is ended."""

TYPES = {
    ".pdf": "application/pdf",
    ".html": "text/html; charset=utf-8",
    ".xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    ".json": "application/json",
    ".dxf": "image/vnd.dxf",
    ".zip": "application/zip",
}
"""Of the files that are given away, in the order in which the page offers them."""

Task = Callable[[Path, Path], str]
"""What a process makes of a workbook: a package, `made`, or a suite, `motions_made`."""

_STEPS: Mapping[Task, int] = {made: len(STEPS), motions_made: MOTIONS + 2}


class State(StrEnum):
    """State of a package."""

    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELED = "canceled"


@dataclass(slots=True, eq=False)
class Package:
    """A package or suite: the workbook as written, beside it its records and out/.

    Attributes
    ----------
    opened : str
        What was open.
    values : mapping
        Those of the page that were written into the workbook.
    """

    opened: str
    workbook: Path
    values: Values
    task: Task
    id: str = field(default_factory=lambda: secrets.token_hex(12))
    state: State = State.RUNNING
    words: str = "Beginning"
    step: int = 0
    worker: Executor | None = None

    @property
    def out(self) -> Path:
        """Where its files are."""
        return self.workbook.parent / "out"

    @property
    def about(self) -> Mapping[str, Any]:
        """Its progress or result."""
        return {
            "id": self.id,
            "values": self.values,
            "state": self.state.value,
            "is_over": self.state is not State.RUNNING,
            "words": self.words,
            "files": [name for end in TYPES for name in OUTPUTS if name.endswith(end)],
            # One more than the steps: a bar that is full says that it is done.
            "part": self.step / (_STEPS[self.task] + 1),
        }

    def begin_step(self, words: str) -> None:
        """Take note of the next step."""
        self.words, self.step = words, self.step + 1

    def cancel(self) -> None:
        """End it, and the process that makes it."""
        if self.state is State.RUNNING:
            self.state, self.words = State.CANCELED, "The package was canceled."
            if self.worker is not None:
                self.worker.shutdown()

    async def make(self) -> None:
        """Have a process make it, unless it is canceled by then."""
        if self.state is State.RUNNING:
            problem = await self._problem()
        if self.state is State.RUNNING:
            self.begin_step(problem or "done")
            self.state = State.FAILED if problem else State.DONE

    async def _problem(self) -> str:
        """Have a process make it; return why there is none, empty if there is."""
        try:
            with begun(self.workbook.parent, self.begin_step) as self.worker:
                asked = self.worker.submit(self.task, self.workbook, self.out)
                async with asyncio.timeout(LONGEST_S):
                    return await asyncio.wrap_future(asked)
        except TimeoutError:
            return f"It took longer than {LONGEST_S / 60:.0f} minutes and was stopped."
        except Exception:  # it ended, or sent what is no answer
            return "The process that made the package ended. Try it again."


class Packages:
    """The packages and suites of a server."""

    def __init__(self) -> None:
        self._all: dict[str, Package] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def begin(self, opened: str, workbook: Path, values: Values, task: Task = made) -> Package:
        """Begin the package of a workbook that has a folder of its own, with its records.

        While another one of the project is made, that one is returned.
        """
        for other in self._all.values():
            is_same = other.task is task and other.opened == opened
            if is_same and other.state is State.RUNNING:
                shutil.rmtree(workbook.parent, ignore_errors=True)
                return other
        package = Package(opened, workbook, values, task)
        self._all[package.id] = package
        running = asyncio.create_task(package.make())
        # asyncio keeps no task alive by itself.
        self._tasks.add(running)
        running.add_done_callback(self._tasks.discard)
        return package

    def find(self, name: str) -> Package | None:
        """Return a package by its ID."""
        return self._all.get(name)

    def last(self, opened: str) -> Package | None:
        """Return the last package of what is open, unless it was canceled."""
        own = [each for each in self._all.values() if each.task is made and each.opened == opened]
        return own[-1] if own and own[-1].state is not State.CANCELED else None

    def cancel(self, *, task: Task | None = None, opened: str | None = None) -> None:
        """End what is being made: all, or packages or suites alone, or those of a project."""
        for package in self._all.values():
            if task in (None, package.task) and opened in (None, package.opened):
                package.cancel()

    async def stop(self) -> None:
        """End every package."""
        self.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)


def copied(workbook: Path, folder: Path) -> None:
    """Give a folder the files beside a workbook, without another copy where the system links."""
    here = workbook.parent
    not_copied = {here / name for name in ("out", "pages", workbook.name)}
    folder.mkdir()
    # Not `shutil.copytree`: its error no longer says that the disk is full.
    for source in sorted(here.rglob("*")):
        if not_copied.isdisjoint((source, *source.parents)):
            _link(source, folder / source.relative_to(here))


def _link(source: Path, target: Path) -> None:
    if source.is_dir():
        target.mkdir()
        return
    try:
        os.link(source, target)
    # Another file system, or one without links.
    except OSError:
        shutil.copyfile(source, target)
