"""Warm processes for the page, and which job goes next to which of them.

A newer job of a page replaces one that still waits; quick ones go first. A process that ends or
takes too long is replaced. Knows no route and no physics. Read `Workers.ask`.
"""

from __future__ import annotations

import asyncio
import json
import os
import sys
from asyncio.subprocess import PIPE, Process
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from enum import IntEnum
from itertools import count
from typing import Any

LONGEST_S = 120.0
"""Longest time of a job [s]; then its process is ended."""

NICE = 5
"""How far the others give way to the process of quick jobs, as the command nice has it."""

_MOST_LINE = 1 << 27
_TRIES = 2
_PAUSE_S = 1.0  # before another try where a process ends at once


class Rank(IntEnum):
    """Which of the jobs that wait goes first."""

    MOVING = 0
    AT_REST = 1
    VIEW = 2
    READ = 3


class StaleError(Exception):
    """A newer job of the same page came before this one was begun."""


class LostError(Exception):
    """The process of a job ended, or was ended for the time it took."""


@dataclass(frozen=True, slots=True)
class JobOrigin:
    """Where a job comes from: of two with one key, only the one with the larger number counts."""

    key: tuple[str, ...]
    number: int


@dataclass(slots=True, eq=False)
class _Waiting:
    job: Mapping[str, Any]
    rank: Rank
    origin: JobOrigin
    order: int
    answer: asyncio.Future[Mapping[str, Any]] = field(repr=False)
    tries: int = 0


async def started(is_quick: bool) -> Process:
    """Start a process that computes; the others give way to that of quick jobs."""
    return await asyncio.create_subprocess_exec(
        sys.executable, "-P", "-m", "report.web.worker", "0" if is_quick else str(NICE),
        stdin=PIPE, stdout=PIPE, limit=_MOST_LINE,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
    )  # fmt: skip


class Workers:
    """The processes, and the jobs that wait for one."""

    def __init__(
        self,
        number: int,
        start: Callable[[bool], Awaitable[Process]] = started,
        longest_s: float = LONGEST_S,
    ) -> None:
        self._number, self._start, self._longest_s = number, start, longest_s
        self._waiting: list[_Waiting] = []
        self._arrived = asyncio.Condition()
        self._orders = count()
        self._tasks: list[asyncio.Task[None]] = []
        self._processes: set[Process] = set()
        self._warmed = asyncio.Event()

    @property
    def pids(self) -> list[int]:
        """Numbers of the processes that run."""
        return [process.pid for process in self._processes if process.returncode is None]

    def start(self, warm: Mapping[str, Any]) -> None:
        """Start every process with a first job, whose answer nobody waits for."""
        # The first process is kept free for sliders that move, where there is another one.
        roles = [self._number > 1, *(False for _ in range(self._number - 1))]
        self._tasks = [asyncio.create_task(self._work(warm, is_quick)) for is_quick in roles]

    async def stop(self) -> None:
        """End every process, in the middle of a job if need be."""
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        for waiting in self._waiting:
            waiting.answer.cancel()

    async def ask(self, job: Mapping[str, Any], rank: Rank, origin: JobOrigin) -> Mapping[str, Any]:
        """Return the answer to a job.

        Raises
        ------
        StaleError, LostError
        """
        rivals = [each for each in self._waiting if each.origin.key == origin.key]
        if any(each.origin.number > origin.number for each in rivals):
            raise StaleError
        for each in rivals:
            self._waiting.remove(each)
            if not each.answer.done():
                each.answer.set_exception(StaleError())
        answer: asyncio.Future[Mapping[str, Any]] = asyncio.get_running_loop().create_future()
        self._waiting.append(_Waiting(job, rank, origin, next(self._orders), answer))
        async with self._arrived:
            self._arrived.notify_all()
        return await answer

    async def _work(self, warm: Mapping[str, Any], is_quick: bool) -> None:
        """Keep one process, and give it one job after the other; quick ones alone, or any."""
        process: Process | None = None
        try:
            if is_quick:
                # The first answer comes sooner from a process that starts alone.
                await self._warmed.wait()
            while True:
                if process is None or process.returncode is not None:
                    process = await self._start(is_quick)
                    self._processes.add(process)
                    try:
                        await _exchange(process, warm, self._longest_s)
                    except LostError:
                        await asyncio.sleep(_PAUSE_S)
                    self._warmed.set()
                    continue
                waiting = await self._next(is_quick)
                await self._answer(process, waiting)
        finally:
            if process is not None:
                await _ended(process)
                self._processes.discard(process)

    async def _answer(self, process: Process, waiting: _Waiting) -> None:
        """Have one job done; where its process is lost, it waits once more."""
        waiting.tries += 1
        try:
            found = await _exchange(process, waiting.job, self._longest_s)
        except LostError as error:
            self._processes.discard(process)
            if waiting.tries < _TRIES and not error.args:
                self._waiting.append(waiting)
                async with self._arrived:
                    self._arrived.notify_all()
            elif not waiting.answer.done():
                waiting.answer.set_exception(error)
        else:
            if not waiting.answer.done():
                waiting.answer.set_result(found)

    async def _next(self, is_quick: bool) -> _Waiting:
        """Return the job that goes next, once there is one."""
        async with self._arrived:
            while True:
                self._waiting = [each for each in self._waiting if not each.answer.done()]
                ready = [e for e in self._waiting if e.rank is Rank.MOVING or not is_quick]
                if ready:
                    chosen = min(ready, key=lambda each: (each.rank, each.order))
                    self._waiting.remove(chosen)
                    return chosen
                await self._arrived.wait()


async def _exchange(
    process: Process, job: Mapping[str, Any], longest_s: float
) -> Mapping[str, Any]:
    """Send a job and return its answer; a process that fails to answer is ended."""
    assert process.stdin is not None
    assert process.stdout is not None
    try:
        process.stdin.write(json.dumps(job).encode() + b"\n")
        await process.stdin.drain()
        # Not `wait_for`: it drops a cancellation that comes with the answer.
        async with asyncio.timeout(longest_s):
            line = await process.stdout.readline()
    except TimeoutError as error:
        await _ended(process)
        raise LostError(f"This took longer than {longest_s:.0f} s and was stopped.") from error
    except (ConnectionError, ValueError):
        line = b""
    if not line.endswith(b"\n"):
        await _ended(process)
        raise LostError
    found: Mapping[str, Any] = json.loads(line)
    return found


async def _ended(process: Process) -> None:
    """End a process; wait until the system has removed it."""
    with suppress(ProcessLookupError):
        process.kill()
    await process.wait()
