"""Warm processes for the page, and which job goes next to which of them.

A newer job of a page replaces one that still waits, if it is no quicker; quick ones go first. A
process that ends or takes too long is replaced. Knows no route and no physics. Read `Workers.ask`.
"""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from itertools import count
from typing import Any

from report.web.worker import answered, warmed
from report.workers import WorkerProcess

LONGEST_S = 120.0
"""Longest time of a job [s]; then its process is ended."""

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


class Workers:
    """The processes, and the jobs that wait for one."""

    def __init__(self, number: int, start: Callable[[bool], WorkerProcess]) -> None:
        self._number, self._start = number, start
        self._waiting: list[_Waiting] = []
        self._arrived = asyncio.Condition()
        self._orders = count()
        self._tasks: list[asyncio.Task[None]] = []
        self._warmed = asyncio.Event()

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
        # A slider that moves ends what waits of the values before. The full model and the
        # provisional answer of the same values do not end each other, whichever is asked first.
        for each in rivals:
            if each.rank < rank or (each.rank > rank and each.job["values"] == job["values"]):
                continue
            self._waiting.remove(each)
            if not each.answer.done():
                each.answer.set_exception(StaleError())
        answer: asyncio.Future[Mapping[str, Any]] = asyncio.get_running_loop().create_future()
        await self._queue(_Waiting(job, rank, origin, next(self._orders), answer))
        return await answer

    async def _work(self, warm: Mapping[str, Any], is_quick: bool) -> None:
        """Keep one process, and give it one job after the other; quick ones alone, or any."""
        if is_quick:
            # The first answer comes sooner from a process that starts alone.
            await self._warmed.wait()
        while True:
            try:
                with self._start(is_quick) as worker:
                    await self._serve(worker, warm, is_quick)
            except Exception:  # such as of a system that starts no process
                traceback.print_exc()
                self._warmed.set()
                await asyncio.sleep(_PAUSE_S)
                # Nobody else may come for the jobs that wait.
                for waiting in self._waiting:
                    if not waiting.answer.done():
                        waiting.answer.set_exception(LostError())

    async def _serve(self, worker: WorkerProcess, warm: Mapping[str, Any], is_quick: bool) -> None:
        """Give a process its jobs until it is lost, which costs a job that was tried before."""
        try:
            # Without a limit on its time: it is of no visitor, and may compile the solver.
            await _done(worker, warmed, warm, None)
        except LostError:
            await asyncio.sleep(_PAUSE_S)
            return
        finally:
            self._warmed.set()
        while True:
            waiting = await self._next(is_quick)
            waiting.tries += 1
            try:
                found = await _done(worker, answered, waiting.job, LONGEST_S)
            except LostError as error:
                if waiting.tries < _TRIES and not error.args:
                    await self._queue(waiting)
                elif not waiting.answer.done():
                    waiting.answer.set_exception(error)
                return
            if not waiting.answer.done():
                waiting.answer.set_result(found)

    async def _queue(self, waiting: _Waiting) -> None:
        self._waiting.append(waiting)
        async with self._arrived:
            self._arrived.notify_all()

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


async def _done(
    worker: WorkerProcess,
    do: Callable[[Mapping[str, Any]], Any],
    job: Mapping[str, Any],
    longest_s: float | None,
) -> Any:
    """Return what a process makes of a job."""
    try:
        # Not `wait_for`: it drops a cancellation that comes with the answer.
        async with asyncio.timeout(longest_s):
            return await asyncio.wrap_future(worker.submit(do, job))
    except TimeoutError as error:
        raise LostError(f"This took longer than {longest_s:.0f} s and was stopped.") from error
    except Exception as error:  # it ended, or sent what is no answer
        raise LostError from error
