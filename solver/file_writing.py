"""Atomic writes of one file or a set, by one process at a time; links are not followed.

What the files of a package are: `report.results.publish`. Read `write_all`, then `locked`.
"""

from __future__ import annotations

import os
import secrets
import shutil
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from filelock import FileLock, Timeout

from solver.errors import InputError
from solver.file_checks import check_length, check_plain

LOCK = ".roofslip-lock"
WAIT_S = 60.0
"""How long a process waits for another that writes to the same folder [s]."""

PAUSES_S = (0.1,) * 10 if sys.platform == "win32" else ()
"""Between tries of what Windows refuses while a scanner or OneDrive has a file open [s]."""


def write_whole(path: Path, content: bytes) -> None:
    """Write a file at a path that the user gave, as `write_all` does; a link there is followed."""
    # The file that a link leads to is replaced: `os.replace` would replace the link itself.
    path = Path(os.path.realpath(path))
    if not path.parent.is_dir():
        raise InputError(f"{path}: cannot be written (No such file or directory)")
    write_all({path.name: content}, path.parent)


def write_all(files: Mapping[str, bytes], folder: Path) -> None:
    """Write files to a folder by name, subfolders included: all of them or none.

    Each is written whole under a random name and then renamed, in the order given: a process that
    is killed leaves every file old or new. One that is replaced gives its permissions.

    Raises
    ------
    InputError
        If one cannot be written, or has no plain place.
    """
    # The stacks close in reverse order: replaced files are restored, then temporary files are
    # removed, and last the new folders, which are empty by then.
    with ExitStack() as added, ExitStack() as sweep, ExitStack() as undo:
        target = folder
        try:
            parts = []
            for name, content in files.items():
                target = folder / name
                check_plain(target, folder)
                part = _hidden(target.parent, sweep)
                check_length(part)
                add_folder(target.parent, added)
                parts.append(part)
                # "x" fails if the name exists, so a link placed there by someone else is never
                # followed.
                with parts[-1].open("xb") as file:
                    file.write(content)
                    file.flush()
                    # Without it, a power failure could leave the new name with no content.
                    os.fsync(file.fileno())
            # Only now, with every content on disk: a disk that is full changes nothing.
            for part, name in zip(parts, files, strict=True):
                target = folder / name
                _replace(part, target, sweep, undo)
        except OSError as error:
            close = "; close it in other programs" if isinstance(error, PermissionError) else ""
            raise InputError(
                f"{target}: cannot be written ({error.strerror}){close}. No file was changed"
            ) from error
        # Success: nothing is undone. `sweep` still removes the backups.
        undo.pop_all()
        added.pop_all()


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which ends with its process.

    Raises
    ------
    InputError
        If another process holds it for `WAIT_S`, or something else has its name.
    """
    check_length(folder / LOCK)
    check_plain(folder / LOCK, folder, in_place=True)
    lock = FileLock(folder / LOCK, timeout=WAIT_S)
    try:
        lock.acquire()
    except Timeout as error:
        raise InputError(
            f"{folder}: another command has been writing there for {WAIT_S:g} s; wait until it ends"
        ) from error
    try:
        yield
    finally:
        lock.release()


def _hidden(folder: Path, sweep: ExitStack) -> Path:
    """Return a random name in a folder; what has it at the end is removed."""
    path = folder / f".roofslip-{secrets.token_hex(8)}.part"
    sweep.callback(_persist, path.unlink, True)
    return path


def add_folder(folder: Path, undo: ExitStack) -> None:
    """Create a folder and those above it; undoing removes those that were not there, if empty."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for path in reversed(missing):
        undo.callback(_remove_empty, path)


def _remove_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()


def _replace(part: Path, target: Path, sweep: ExitStack, undo: ExitStack) -> None:
    """Put a file in its place; what was there is put back when another one cannot be written."""
    if target.exists():
        if sys.platform == "win32" and not os.access(target, os.W_OK):
            problem = "is read-only; allow changes to it, or move it away. No file was changed"
            raise InputError(f"{target}: {problem}")
        backup = _hidden(target.parent, sweep)
        if sys.platform != "win32":  # there, no link to a file that is open can be removed
            with suppress(OSError):  # a file system without hard links
                os.link(target, backup)
        if not backup.exists():
            shutil.copy2(target, backup)
        undo.callback(_put_back, backup, target, part)
        # A new file has the default permissions of the process, not those of the file that it
        # replaces.
        part.chmod(target.stat().st_mode & 0o777)
    else:
        undo.callback(_persist, target.unlink, True)
    # Not `os.rename`, which does not replace an existing file on Windows.
    _persist(os.replace, part, target)


def _put_back(backup: Path, target: Path, part: Path) -> None:
    if not part.exists():  # else it was not renamed: the target is still the former file
        _persist(os.replace, backup, target)


def _persist(act: Callable[..., object], *arguments: object) -> None:
    for pause_s in PAUSES_S:
        with suppress(PermissionError):
            act(*arguments)
            return
        time.sleep(pause_s)
    # The last attempt is outside the loop, so that its error is raised.
    act(*arguments)
