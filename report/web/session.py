"""The session of one engineer: open projects, and two processes that answer requests on them.

One process answers moving sliders, the other everything else, and moves if only it is free; a
process that ends or takes too long is replaced. Knows no route and no physics. Read `Session.ask`.
"""

from __future__ import annotations

import asyncio
import os
import shutil
from collections.abc import Coroutine, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field
from starlette.requests import Request

from report.project.write import template
from report.web.plan import USUAL_PX
from report.web.processes import WorkerProcess
from report.web.worker import Packages, begun

EXAMPLE, EXAMPLE_NAME = template.EXAMPLE / "input.xlsx", "example"

MOST_OPEN = 8
"""Projects that stay open beside the example; the one opened first is closed for another one."""

LONGEST_S = 120.0
"""Longest time of an answer [s]; then its process is ended."""

IN_BACKGROUND = "verdict"
"""Asked while the page rests: the quick process does it, and a move then takes the other."""

PERFORM = "report.web.jobs:perform"
"""What a process does with a job; this one does not load it."""

# The processes by name: of sliders that move, and of all else.
_QUICK, _FULL = "quick", "full"

# A job that ends two processes will end a third.
_TRIES = 2


class RefusedError(Exception):
    """Values that a workbook could not have, with each problem as data."""

    def __init__(self, sentence: str, problems: Sequence[Mapping[str, Any]]) -> None:
        super().__init__(sentence)
        self.problems = problems


class StaleError(Exception):
    """A newer request of the same page came before this one was begun."""


class LostError(Exception):
    """The process handling a request ended, or was stopped because it took too long."""


class ClosedError(Exception):
    """A page asks about a project that is no longer open."""


class Asked(BaseModel):
    """A request of the page about what is open, with the values of its sliders.

    Of two requests of a page only that with the larger number counts. A script that does not say
    which project it means asks about the one that was opened last.
    """

    model_config = ConfigDict(strict=True, frozen=True)

    page: str = Field("", max_length=100)
    n: int = Field(0, ge=-(2**53), le=2**53)
    opened: str | None = None
    values: dict[str, int | float | str] = Field({}, max_length=400)
    moving: bool = False
    whole: bool = True
    room: int = Field(USUAL_PX, le=10_000)
    array: str | None = None
    motion: str | None = None
    run: str | None = None
    cells: dict[str, str] = Field({}, max_length=5_000)


class Session:
    """What is open, the processes that compute, and the packages.

    Attributes
    ----------
    folder : Path
        Of uploads and packages; it ends with the server.
    filled : Path or None
        The last workbook whose plan was filled in from a drawing.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.packages = folder, Packages()
        self.filled: Path | None = None
        self._open = {EXAMPLE_NAME: EXAMPLE}  # by name, the one opened last at the end
        self._names: dict[str, str] = {}  # by what addresses call the project
        self._openings = 0
        self._processes: dict[str, WorkerProcess] = {}
        self._busy: set[str] = set()
        self._turns = asyncio.Condition()
        self._newest: dict[tuple[object, ...], Asked] = {}
        self._preparing: set[asyncio.Task[None]] = set()
        self._references: dict[str, Any] = {}  # of the last complete answer, by workbook

    @property
    def opened(self) -> str:
        """Unique name of the project opened last."""
        return list(self._open)[-1]

    def workbook(self, opened: str | None = None) -> Path:
        """Return the workbook of a project by its name, or of that opened last."""
        if opened is not None and opened not in self._open:
            raise ClosedError
        return self._open[opened or self.opened]

    def named(self, project: str) -> str:
        """Return the name of the project of an address; where it is not open, of the last one."""
        name = self._names.get(project, "")
        return name if name in self._open else self.opened

    def new_folder(self) -> Path:
        """Return an empty folder for an upload."""
        self._openings += 1
        self.folder.mkdir(0o700, exist_ok=True)  # a cleaner of /tmp may have removed it
        folder = self.folder / f"upload-{self._openings}"
        folder.mkdir()
        return folder

    def open(self, workbook: Path, project: str) -> None:
        """Open a workbook beside the others, by what addresses call it."""
        is_example = workbook == EXAMPLE
        name = EXAMPLE_NAME if is_example else workbook.relative_to(self.folder).parts[0]
        self._open.pop(name, None)
        self._open[name] = workbook
        self._names[project] = name
        for former in [each for each in self._open if each != EXAMPLE_NAME][:-MOST_OPEN]:
            self.packages.cancel(opened=former)
            self._references.pop(str(self._open.pop(former)), None)
            shutil.rmtree(self.folder / former, ignore_errors=True)

    def start(self) -> None:
        """Start the processes, each with the example, as the page will ask first."""
        self._busy = {_QUICK, _FULL}
        self._begin(self._warm())

    async def _warm(self) -> None:
        # The first answer comes sooner from one that starts alone.
        for name, do in ((_FULL, "state"), (_QUICK, "prepare")):
            job = {"do": do, "workbook": str(EXAMPLE)}
            with suppress(LostError):
                reply = await self._answer(job, name, longest_s=None)  # may compile the solver
                if project := reply.get("answer", {}).get("project"):
                    self._names[project["id"]] = EXAMPLE_NAME
            await self._end_turn(name)

    def prepare(self, workbook: Path) -> None:
        """Have the quick process read a workbook, while the other one computes its state."""
        self._begin(self._prepare(workbook))

    async def _prepare(self, workbook: Path) -> None:
        async with self._turns:
            await self._turns.wait_for(lambda: _QUICK not in self._busy)
            self._busy.add(_QUICK)
        with suppress(LostError):
            await self._answer({"do": "prepare", "workbook": str(workbook)}, _QUICK, LONGEST_S)
        await self._end_turn(_QUICK)

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        # asyncio keeps no task alive by itself.
        self._preparing.add(task)
        task.add_done_callback(self._preparing.discard)

    async def stop(self) -> None:
        """End every process, in the middle of a job if need be."""
        for task in self._preparing:
            task.cancel()
        await asyncio.gather(*self._preparing, return_exceptions=True)
        await self.packages.stop()
        for name in list(self._processes):
            self._end(name)

    async def ask(self, job: Mapping[str, Any], asked: Asked | None = None) -> Mapping[str, Any]:
        """Return the answer to a job, about what was opened last if it names no workbook.

        It is asked by a request of a page, which a newer one replaces, or by none. Without an
        answer it is refused, stale or lost, or the disk is full.
        """
        job = {"workbook": str(self.workbook(asked.opened if asked else None)), **job}
        if asked:
            self._note(job["do"], asked)
        name = await self._turn(job["do"], asked)
        try:
            if asked:
                job["reference"] = self._references.get(job["workbook"], {})
            reply = await self._answer(job, name, LONGEST_S)
        finally:
            await self._end_turn(name)
        if "reference" in reply:
            self._references[job["workbook"]] = reply["reference"]
        if "answer" in reply:
            answer: Mapping[str, Any] = reply["answer"]
            return answer
        if "errno" in reply:
            raise OSError(reply["errno"], os.strerror(reply["errno"]))
        first = reply["refused"] if "refused" in reply else reply["problems"][0]["text"]
        raise RefusedError(first, reply["problems"])

    async def _turn(self, kind: str, asked: Asked | None) -> str:
        """Wait until a process is free, and return its name."""
        async with self._turns:
            self._turns.notify_all()  # what this one replaces ends at once: a browser waits for six
            await self._turns.wait_for(
                lambda: self._is_stale(kind, asked) or self._free(kind, asked)
            )
            name = self._free(kind, asked)
            if name is None or self._is_stale(kind, asked):
                raise StaleError
            self._busy.add(name)
            return name

    async def _end_turn(self, name: str) -> None:
        self._busy.discard(name)
        async with self._turns:
            self._turns.notify_all()

    def _free(self, kind: str, asked: Asked | None) -> str | None:
        """Return the name of a process that may do a job now; none if all are busy."""
        if asked and asked.moving:
            able = [_QUICK, _FULL]
        else:
            able = [_QUICK if kind == IN_BACKGROUND else _FULL]
        return next((name for name in able if name not in self._busy), None)

    def _note(self, kind: str, asked: Asked) -> None:
        for key in ((asked.page, kind, asked.moving), (asked.page,)):
            if key not in self._newest or self._newest[key].n <= asked.n:
                self._newest[key] = asked

    def _is_stale(self, kind: str, asked: Asked | None) -> bool:
        """Whether its page asked the same anew since, or is at other values; a script never."""
        if asked is None or not asked.page:
            return False
        is_asked_anew = self._newest[asked.page, kind, asked.moving].n > asked.n
        # A move to other values is replaced by a move alone.
        is_elsewhere = self._newest[asked.page,].values != asked.values
        return is_asked_anew or (is_elsewhere and not asked.moving)

    async def _answer(
        self, job: Mapping[str, Any], name: str, longest_s: float | None
    ) -> Mapping[str, Any]:
        """Have a process do a job; where it ends, another one does it, once."""
        for _ in range(_TRIES):
            try:
                if name not in self._processes:
                    self._processes[name] = begun(self.folder)
                # Not `wait_for`: it drops a cancellation that comes with the answer.
                async with asyncio.timeout(longest_s):
                    asking = self._processes[name].submit(PERFORM, job)
                    return await asyncio.wrap_future(asking)
            except TimeoutError as error:
                self._end(name)
                told = f"This took longer than {longest_s:.0f} s and was stopped."
                raise LostError(told) from error
            except Exception as error:  # it ended, sent what is no answer, or does not start
                self._end(name)
                lost = error
        raise LostError from lost

    def _end(self, name: str) -> None:
        if process := self._processes.pop(name, None):
            process.shutdown()


def session_of(request: Request) -> Session:
    """Return the session of the server."""
    session: Session = request.app.state.session
    return session
