"""Packages of the sessions: one at a time, the others in a queue with their place.

Each is made by a process of its own (`report.web.worker.made`), which ends with its canceling. Read
`Packages.begin`.
"""

from __future__ import annotations

import asyncio
import os
import secrets
import shutil
from collections.abc import Callable, Collection, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from report.making import OUTPUTS, STEPS
from report.web.sessions import Session
from report.web.values import Values
from report.web.worker import MOTIONS, made, making, motions_made

LONGEST_S = 900.0
"""Longest time of a package [s]; then its process is ended."""

KEPT = 5
"""Packages that a session keeps; older ones are removed."""


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

    QUEUED = "queued"
    RUNNING = "running"
    DONE = "done"
    FAILED = "failed"
    CANCELED = "canceled"

    @property
    def is_over(self) -> bool:
        """Whether nothing more happens."""
        return self not in (State.QUEUED, State.RUNNING)


@dataclass(slots=True, eq=False)
class Package:
    """A package or suite of a session: the workbook as written, beside it its records and out/.

    Attributes
    ----------
    opened : str
        What the session had open.
    values : mapping
        Those of the page that were written into the workbook.
    """

    ticket: str
    owner: str
    opened: str
    workbook: Path
    values: Values
    task: Task
    state: State = State.QUEUED
    words: str = "Waiting"
    step: int = 0
    worker: Executor | None = None

    @property
    def out(self) -> Path:
        """Where its files are."""
        return self.workbook.parent / "out"

    def begin_step(self, words: str) -> None:
        """Take note of the next step."""
        self.words, self.step = words, self.step + 1


class Packages:
    """The packages of all sessions."""

    def __init__(self) -> None:
        self._all: dict[str, Package] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._turn = asyncio.Lock()

    def begin(self, session: Session, workbook: Path, values: Values, task: Task = made) -> Package:
        """Queue the package of a workbook that has a folder of its own, with its records.

        While another one of the session waits or is made, that one is returned.
        """
        if (unfinished := self.unfinished(session, task)) is not None:
            shutil.rmtree(workbook.parent, ignore_errors=True)
            return unfinished
        own = self._of(session)
        for old in own[: max(len(own) - KEPT + 1, 0)]:
            del self._all[old.ticket]
            shutil.rmtree(old.workbook.parent, ignore_errors=True)
        package = Package(
            ticket=secrets.token_hex(12),
            owner=session.id,
            opened=session.opened,
            workbook=workbook,
            values=values,
            task=task,
        )
        self._all[package.ticket] = package
        running = asyncio.create_task(self._make(package))
        self._tasks.add(running)
        running.add_done_callback(self._tasks.discard)
        return package

    def unfinished(self, session: Session, task: Task = made) -> Package | None:
        """Return the package of a session that waits or is made."""
        own = (each for each in self._of(session) if each.task is task)
        return next((each for each in own if not each.state.is_over), None)

    def last(self, session: Session) -> Package | None:
        """Return the last package of what a session has open, unless it was canceled."""
        own = (each for each in self._of(session) if each.task is made)
        found = [each for each in own if each.opened == session.opened]
        return found[-1] if found and found[-1].state is not State.CANCELED else None

    def find(self, session: Session, ticket: str) -> Package | None:
        """Return a package of a session."""
        package = self._all.get(ticket)
        return package if package is not None and package.owner == session.id else None

    def about(self, package: Package) -> Mapping[str, Any]:
        """Return how far a package is, or what became of it; no part while it waits in line."""
        queued = [each for each in self._all.values() if each.state is State.QUEUED]
        is_queued = package in queued
        return {
            "ticket": package.ticket,
            "values": package.values,
            "state": package.state.value,
            "is_over": package.state.is_over,
            "words": f"In line, place {queued.index(package) + 1}" if is_queued else package.words,
            "files": [name for end in TYPES for name in OUTPUTS if name.endswith(end)],
            "part": None if is_queued else package.step / (_STEPS[package.task] + 1),
        }

    async def cancel(self, package: Package) -> None:
        """End a package, and the process that makes it."""
        if package.state.is_over:
            return
        package.state, package.words = State.CANCELED, "The package was canceled."
        if package.worker is not None:
            package.worker.shutdown()

    async def cancel_unfinished(self, session: Session, tasks: Iterable[Task] = _STEPS) -> None:
        """Cancel what waits or is made for a session: its package, its suite."""
        for task in tasks:
            if (package := self.unfinished(session, task)) is not None:
                await self.cancel(package)

    async def keep(self, owners: Collection[str]) -> None:
        """End and forget the packages of other sessions."""
        for package in [each for each in self._all.values() if each.owner not in owners]:
            await self.cancel(package)
            del self._all[package.ticket]

    async def stop(self) -> None:
        """End every package."""
        for package in self._all.values():
            await self.cancel(package)
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def _of(self, session: Session) -> list[Package]:
        return [each for each in self._all.values() if each.owner == session.id]

    async def _make(self, package: Package) -> None:
        async with self._turn:
            if package.state is not State.QUEUED:
                return
            package.state = State.RUNNING
            problem = await self._problem(package)
            if package.state is State.RUNNING:
                package.begin_step(problem or "done")
                package.state = State.FAILED if problem else State.DONE

    async def _problem(self, package: Package) -> str:
        """Have a process make a package; return why there is none, empty if there is."""
        with making(package.workbook.parent, package.begin_step) as worker:
            package.worker = worker
            asked = worker.submit(package.task, package.workbook, package.out)
            try:
                async with asyncio.timeout(LONGEST_S):
                    return await asyncio.wrap_future(asked)
            except TimeoutError:
                return f"It took longer than {LONGEST_S / 60:.0f} minutes and was stopped."
            except Exception:  # it ended, or sent what is no answer
                return "The process that made the package ended. Try it again."


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
