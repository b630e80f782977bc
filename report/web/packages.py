"""The packages and suites that the page has made, each by a process of its own.

Canceling one ends its process (`report.web.worker`). Read `Packages.begin`.
"""

from __future__ import annotations

import asyncio
import os
import secrets
import shutil
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from report.making import OUTPUTS, STEPS
from report.web.values import Values
from report.web.worker import MOTIONS, made, making, motions_made

LONGEST_S = 900.0
"""Longest time of a package [s]; then its process is ended."""

TYPES = {
    ".pdf": "application/pdf",
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
    """What becomes of a package."""

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
        """How far it is, or what became of it."""
        return {
            "id": self.id,
            "values": self.values,
            "state": self.state.value,
            "is_over": self.state is not State.RUNNING,
            "words": self.words,
            "files": [name for end in TYPES for name in OUTPUTS if name.endswith(end)],
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
            with making(self.workbook.parent, self.begin_step) as self.worker:
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

        While another one is made, that one is returned.
        """
        for other in self._all.values():
            if other.task is task and other.state is State.RUNNING:
                shutil.rmtree(workbook.parent, ignore_errors=True)
                return other
        package = Package(opened, workbook, values, task)
        self._all[package.id] = package
        running = asyncio.create_task(package.make())
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

    def cancel(self, task: Task | None = None) -> None:
        """End what is being made: all, or packages or suites alone."""
        for package in self._all.values():
            if task in (None, package.task):
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
    except OSError:
        shutil.copyfile(source, target)
