"""A worker: another process that runs functions for the page.

Owns what passes between the two, and that a worker ends with the block that started it, whatever
happens in either process. Knows nothing of packages. Read `WorkerProcess`.
"""

from __future__ import annotations

import json
import os
import signal
import tempfile
from collections.abc import Callable
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from functools import partial
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from pathlib import Path
from pkgutil import resolve_name
from tempfile import TemporaryDirectory
from threading import Thread
from typing import Any, ParamSpec, TypeVar, overload

from report.libraries import apart, stay_apart

_P = ParamSpec("_P")
_R = TypeVar("_R")

_MOST_JSON = 1 << 27
_TOLD, _RETURNED = "told", "returned"


class WorkerProcess(Executor):
    """Runs functions in a process of its own, in order.

    Functions are given themselves, or as a name, `module:function`, where this process has no need
    of their module. Arguments are pickled beside what is done here next: they must not change, nor
    cache anything. It reads untrusted files: what comes back is JSON and
    is never unpickled, and an exception ends the process.

    Parameters
    ----------
    prepare : callable
        What the process calls first, such as for its limits.
    told : callable
        Gets what a function tells (`tell`) before its result, in a thread of its own.
    within : Path, optional
        Where the process has its temporary files; among those of this process if not given.

    Raises
    ------
    OSError
        If the system lets no process start.
    """

    def __init__(
        self,
        prepare: Callable[[], object],
        *,
        told: Callable[[Any], object] = lambda _: None,
        within: Path | None = None,
    ) -> None:
        context = get_context("spawn")
        self._pipe, there = context.Pipe()
        self._folder = TemporaryDirectory("", "roofslip-", within, ignore_cleanup_errors=True)
        self._told = told
        about = (there, os.getcwd(), self._folder.name, prepare)
        self._process = context.Process(target=_serve, args=about)
        with apart():  # its Python would import a file multiprocessing.py of the current folder
            self._process.start()
        # Only the other process may hold its end: then its death ends every wait for it.
        there.close()
        self._asking = ThreadPoolExecutor(1)

    @overload
    def submit(self, fn: str, /, *args: Any, **kwargs: Any) -> Future[Any]: ...
    @overload
    def submit(
        self, fn: Callable[_P, _R], /, *args: _P.args, **kwargs: _P.kwargs
    ) -> Future[_R]: ...
    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Have a function run after those submitted before."""
        return self._asking.submit(self._ask, fn, args, kwargs)

    def _ask(self, *call: Any) -> Any:
        try:
            self._pipe.send(call)
            kind, value = self._message()
            while kind == _TOLD:
                self._told(value)
                kind, value = self._message()
        except (EOFError, ConnectionError) as error:
            from solver.errors import DefectError  # slow to import: the process starts before it

            self._process.join()
            raise DefectError(
                f"the process beside this one ended (exit code {self._process.exitcode})"
            ) from error
        return value

    def _message(self) -> Any:
        # The pipe of a process that ended as it began stays open on Windows.
        wait([self._pipe, self._process.sentinel])
        if not self._pipe.poll():
            raise EOFError
        return json.loads(self._pipe.recv_bytes(_MOST_JSON))

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = True) -> None:
        """End the process, in the middle of a function if need be."""
        # First, so that no function is asked for once the process has ended.
        self._asking.shutdown(wait=False, cancel_futures=True)
        self._process.kill()
        self._process.join()
        self._folder.cleanup()
        self._asking.shutdown()
        self._pipe.close()


def tell(what: Any) -> None:
    """Tell the process that asked for a function something before its result."""
    _send(_TOLD, what)


_send: Callable[[str, Any], None]
"""Sends a message to the process that asks; there is none in that process."""


def _serve(pipe: Connection, here: str, folder: str, prepare: Callable[[], object]) -> None:
    """Run the functions that arrive until the other end closes."""
    global _send
    os.chdir(here)
    _send = partial(_sent, pipe)
    tempfile.tempdir = folder  # what a killed process leaves there is removed by the other one
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # which decides what an interrupt ends
    Thread(target=_end_with_parent, daemon=True).start()
    stay_apart()
    prepare()
    try:
        while True:
            function, arguments, named = pipe.recv()
            call = resolve_name(function) if isinstance(function, str) else function
            _send(_RETURNED, call(*arguments, **named))
    except (EOFError, ConnectionError):
        return


def _sent(pipe: Connection, kind: str, value: Any) -> None:
    pipe.send_bytes(json.dumps((kind, value), allow_nan=False).encode())


def _end_with_parent() -> None:
    """End in the middle of a function where the process that asked for it has ended."""
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)
