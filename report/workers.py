"""A worker: a second process beside the command, on the core that it leaves idle.

Knows nothing of packages: it runs functions, one after the other, and returns their results. It
ends with the block that started it, whatever happens in either process. Read `started_worker`.
"""

from __future__ import annotations

import gc
import signal
import tempfile
import traceback
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection
from tempfile import TemporaryDirectory
from typing import Any, ParamSpec, TypeVar

_P = ParamSpec("_P")
_R = TypeVar("_R")


@contextmanager
def started_worker() -> Iterator[Executor]:
    """Yield a worker, or this one where the system does not let another start."""
    try:
        worker: Executor = WorkerProcess()
    except OSError:
        worker = SameProcess()
    with worker:
        yield worker


class SameProcess(Executor):
    """Runs each function at once, in the process that asks."""

    def submit(self, fn: Callable[_P, _R], /, *args: _P.args, **kwargs: _P.kwargs) -> Future[_R]:
        """Run a function and return its finished result; an exception is raised here."""
        done: Future[_R] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


class WorkerProcess(Executor):
    """Runs functions in a process of its own, in order.

    Functions are named by their module; arguments, results and exceptions are pickled. Arguments
    are pickled beside what the command does next: they must not change, nor cache anything. An
    exception is raised where the result is asked for.

    Raises
    ------
    OSError
        If the system lets no process start.
    """

    def __init__(self) -> None:
        context = get_context("spawn")
        self._pipe, there = context.Pipe()
        self._folder = TemporaryDirectory(prefix="roofslip-", ignore_cleanup_errors=True)
        self._process = context.Process(target=_serve, args=(there, self._folder.name), daemon=True)
        self._process.start()
        # Only the second process may hold its end: then its death ends every wait for it.
        there.close()
        self._asking = ThreadPoolExecutor(1)

    def submit(self, fn: Callable[_P, _R], /, *args: _P.args, **kwargs: _P.kwargs) -> Future[_R]:
        """Have a function run after those submitted before."""
        return self._asking.submit(self._ask, fn, args, kwargs)

    def _ask(self, *call: Any) -> Any:
        try:
            self._pipe.send(call)
            raised, result = self._pipe.recv()
        except (EOFError, ConnectionError) as error:
            from solver.model import DefectError  # slow to import: the process starts before it

            self._process.join()
            raise DefectError(
                f"the process that draws and writes ended (exit code {self._process.exitcode})"
            ) from error
        if raised:
            raise result
        return result

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = True) -> None:
        """End the process, in the middle of a function if need be."""
        # First, so that no function is asked for once the process has ended.
        self._asking.shutdown(wait=False, cancel_futures=True)
        self._process.kill()
        self._process.join()
        self._folder.cleanup()
        self._asking.shutdown()
        self._pipe.close()


def _serve(pipe: Connection, folder: str) -> None:
    """Run the functions that arrive until the other end closes."""
    tempfile.tempdir = folder  # what a killed process leaves there is removed by the command
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the command decides what an interrupt ends
    gc.disable()  # as the command does
    warnings.filterwarnings("ignore", category=UserWarning)  # the command warns
    try:
        while True:
            pipe.send(_result(pipe))
    except (EOFError, ConnectionError):
        return


def _result(pipe: Connection) -> tuple[bool, Any]:
    """Return whether the next function raised, and its result or exception."""
    try:
        function, arguments, named = pipe.recv()
        return False, function(*arguments, **named)
    except EOFError:
        raise
    except Exception as error:
        error.add_note(f"in the worker:\n{traceback.format_exc()}")
        return True, error
