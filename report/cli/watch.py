"""The command `roofslip watch`: check and report again on every save, in a process that stays warm.

Owns what counts as a save, and how long to wait for one that is not finished. Read
`report.making` first.
"""

from __future__ import annotations

import gc
import hashlib
import os
import signal
import sys
import time
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from report.cli.terminal import (
    INPUT_ERROR,
    SOURCE,
    input_errors,
    no_collections,
    outputs_of,
    plain,
    say,
    say_former,
    say_problems,
    system_problem,
    warn_of_others,
    workbook_of,
)

if TYPE_CHECKING:
    from report.assessment.project import Assessment
    from report.entities.results import Compared

SETTLE_S = 3.0
"""How long a workbook may be half saved, locked or gone [s] before that is an error."""

_POLL_S = 0.3
_MOST_CHANGES = 12
_SUFFIXES = (".tmp", ".bak", ".swp", ".lock")


@click.command()
@click.argument("source", metavar="DIR|WORKBOOK", type=SOURCE)
@click.option("--out", type=SOURCE,
              help="Output folder; default: out/ beside the input.")  # fmt: skip
@click.option("--once", is_flag=True, help="End after one round.")
def watch(source: Path, out: Path | None, once: bool) -> None:
    """Check and report on every save of the workbook or a record, until Ctrl+C.

    Prints what changed since the round before. A workbook that is half saved, locked or gone for a
    moment is read again.
    """
    from report.memoized import clear

    with input_errors(source):
        if not source.is_dir():
            settle(source)
    workbook = workbook_of(source)
    round_ = Round(workbook, out)
    try:
        if once:
            sys.exit(0 if round_.run() else INPUT_ERROR)
        found = saves(workbook, round_.folder)
        next(found)  # from here on no save is missed, whatever else is done meanwhile
        round_.run()
        click.echo(f"watching {workbook.parent}; end with Ctrl+C")
        round_.sweep()
        for names in filter(None, found):
            click.echo("")
            click.echo(plain(f"saved: {', '.join(names)}"))
            round_.run()
            round_.sweep()
    finally:
        clear()


class Round:
    """Checks and reports, and remembers the results to compare the next ones with.

    What it computes is kept, so that the next round repeats only what changed.
    """

    def __init__(self, workbook: Path, out: Path | None) -> None:
        self._workbook, self._out = workbook, out
        self.folder = out or workbook.parent / "out"
        self._before: Compared | None = None

    def run(self) -> bool:
        """Check and report once; return whether a package was written."""
        from report.results.since import former_from
        from solver.model import InputError

        started = time.monotonic()
        try:
            files = self._made()
        except (InputError, OSError) as error:
            problems = [system_problem(error)] if isinstance(error, OSError) else error.parts
            say_problems(self._workbook, problems)
            say_former(outputs_of(self._workbook, self._out))
            return False
        warn_of_others(self.folder / "calc-package.pdf")
        self._before = former_from(files["results.json"], self.folder / "results.json")
        click.echo(f"{self.folder}: written in {time.monotonic() - started:.1f} s")
        return True

    def _made(self) -> Mapping[str, bytes]:
        """Make the package, once the workbook can be read; print the verdict before it.

        Raises
        ------
        InputError
        """
        from report.making import make
        from report.memoized import new_generation

        settle(self._workbook)
        new_generation()
        with no_collections():
            _, _, files, _ = make(self._workbook, self._out, None, lambda _: None, self._print)
        return files

    def sweep(self) -> None:
        """Free what a round has left, while nothing waits for the next one."""
        with _interrupted_after():
            gc.unfreeze()  # what `no_collections` has exempted
            gc.collect()

    def _print(self, assessment: Assessment) -> None:
        from report.pages.summary import summary
        from report.results.compare import changes

        for line in summary(assessment):
            say(line)
        if self._before is not None:
            items = changes(self._before, assessment).items
            for item in items[:_MOST_CHANGES]:
                at = f" ({item.cell})" if item.cell else ""
                click.echo(plain(f"changed: {item.title}{at}: {item.before} -> {item.now}"))
            if not items:
                click.echo("changed: nothing that the package shows")
            elif len(items) > _MOST_CHANGES:
                click.echo(f"changed: {len(items) - _MOST_CHANGES} more")


@contextmanager
def _interrupted_after() -> Iterator[None]:
    """Let Ctrl+C wait until the block ends: a collection loses it where a finalizer runs."""
    interrupts: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: interrupts.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if interrupts:
        raise KeyboardInterrupt


def settle(workbook: Path) -> None:
    """Wait until a workbook can be opened, at most `SETTLE_S`.

    Raises
    ------
    InputError
        If it cannot be opened by then.
    """
    from report.sheet.reading.archive import open_book

    last = time.monotonic() + SETTLE_S
    while not _is_whole(workbook):
        if time.monotonic() > last:
            open_book(workbook)
            return
        time.sleep(_POLL_S)


def _is_whole(workbook: Path) -> bool:
    """Whether a file is there with all of its parts, as far as can be told without reading them."""
    try:
        with zipfile.ZipFile(workbook) as archive:
            return archive.testzip() is None
    except (OSError, EOFError, zipfile.BadZipFile, NotImplementedError, RuntimeError, ValueError,
            zlib.error):  # fmt: skip
        return False


def saves(workbook: Path, folder: Path) -> Iterator[list[str]]:
    """Yield the names of the files of each save beside a workbook, except in the output folder.

    None at once, when the watch has begun, and again whenever there was no save for a moment. A
    save is a file with other content, whatever its time stamp. One that is still being written is
    waited for, at most `SETTLE_S`.
    """
    # Shares over a network tell no program of a change: the folder is polled.
    top, written = workbook.parent.resolve(), folder.resolve()
    known = _settled(workbook, _files(top, written, {}), written)
    while True:
        yield []
        time.sleep(_POLL_S)
        found = _files(top, written, known)
        if found == known:
            continue
        found = _settled(workbook, found, written)
        contents = ({path: file.sha256 for path, file in files.items()} for files in (known, found))
        changed = set.symmetric_difference(*(set(content.items()) for content in contents))
        known = found
        if changed:
            yield sorted({str(path.relative_to(top)) for path, _ in changed})


@dataclass(frozen=True, slots=True)
class _File:
    """A file with what the system says of it: its content is read only where that differs."""

    stamp: tuple[int, ...]
    sha256: str


def _settled(workbook: Path, found: Mapping[Path, _File], written: Path) -> Mapping[Path, _File]:
    """Return the files once none changes any more and the workbook is whole."""
    last = time.monotonic() + SETTLE_S
    while True:
        time.sleep(_POLL_S)
        now = _files(workbook.parent.resolve(), written, found)
        if (now == found and _is_whole(workbook)) or time.monotonic() > last:
            return now
        found = now


def _files(top: Path, written: Path, known: Mapping[Path, _File]) -> Mapping[Path, _File]:
    """Return the files that may be inputs, in a folder and below it."""
    found = {}
    for place, folders, names in os.walk(top):
        folders[:] = [name for name in folders if Path(place, name) != written]
        for path in (Path(place, name) for name in names if is_input(Path(name))):
            with suppress(OSError):  # it may be gone by now
                found[path] = _file(path, known.get(path))
    return found


def _file(path: Path, known: _File | None) -> _File:
    status = path.stat()
    stamp = (status.st_mtime_ns, status.st_ctime_ns, status.st_size, status.st_ino)
    if known is not None and known.stamp == stamp:
        return known
    # A pipe or a device would be waited for.
    content = path.read_bytes() if path.is_file() else b""
    return _File(stamp, hashlib.sha256(content).hexdigest())


def is_input(path: Path) -> bool:
    """Whether a file may be an input: no lock, no temporary file, nothing hidden."""
    name = path.name
    hidden = name.startswith((".", "~$", "~")) or name.endswith("~")
    return not hidden and path.suffix.lower() not in _SUFFIXES
