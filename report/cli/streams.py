"""The process of a command: its outputs, its warnings, and Ctrl+C."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from types import FrameType
from typing import Any, TextIO

import click

from report.cli.console import say


@contextmanager
def interrupts() -> Iterator[list[int]]:
    """Provide a list that grows with each Ctrl+C, which is still raised as KeyboardInterrupt."""
    received: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        received.append(number)
        signal.default_int_handler(number, frame)

    # As under nohup, or within a program that calls this one.
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield received
        return
    signal.signal(signal.SIGINT, note)
    try:
        yield received
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def say_unwritten(error: OSError) -> None:
    """Report that the output or the error output cannot be written, if possible."""
    with suppress(OSError):
        click.echo(f"The output cannot be written ({error.strerror or error}).", err=True)
    # What is still in the buffers would fail again as the process ends.
    sys.stdout = sys.stderr = open(os.devnull, "w")  # noqa: SIM115  # until the process ends


class UntilClosed:
    """An output whose reader may leave: the rest is dropped, and the work continues."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text, if there is a reader."""
        try:
            return self._stream.write(text)
        except BrokenPipeError:
            self._drop()
            return len(text)

    def flush(self) -> None:
        """Write the buffer, if there is a reader."""
        try:
            self._stream.flush()
        except BrokenPipeError:
            self._drop()

    def _drop(self) -> None:
        # The buffer still has the text; it would fail again as the process ends.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, self._stream.fileno())
        os.close(nowhere)


def set_up_console() -> None:
    """On Windows, use UTF-8 for pipes instead of the code page, and enable terminal codes."""
    if sys.platform == "win32":
        from ctypes import windll  # only Windows has it

        # STD_OUTPUT_HANDLE and STD_ERROR_HANDLE of Windows. Its code page lacks letters such as μ
        # and θ, and Python would raise UnicodeEncodeError for them in a pipe.
        for stream, handle in ((sys.stdout, -11), (sys.stderr, -12)):
            if isinstance(stream, TextIOWrapper) and not stream.isatty():
                stream.reconfigure(encoding="utf-8")
            elif stream is not None:
                # 7: processed output (1), wrap at the end of a line (2), and terminal codes (4),
                # which a console of Windows 10 has off.
                windll.kernel32.SetConsoleMode(windll.kernel32.GetStdHandle(handle), 7)


def show_warnings() -> None:
    """Print warnings to the user as one line; those to developers stay as they are."""
    usual = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *place: Any, **options: Any) -> None:
        if category is UserWarning:
            say(f"warning: {message}", is_error=True)
        else:
            usual(message, category, *place, **options)

    warnings.showwarning = show
